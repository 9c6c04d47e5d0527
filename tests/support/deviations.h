/* Small deviations of a top from a state: ξ = (δr, δθ, δv, δω) of the centre of mass, base axes, written once more for tests. */
#ifndef TESTS_SUPPORT_DEVIATIONS_H
#define TESTS_SUPPORT_DEVIATIONS_H

#include "gough/dynamics.h"

static inline void cross_product(const double a[3], const double b[3], double out[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

/* R turned by a small rotation θ: (1 + [θ] + [θ]²/2) R, exact to θ³ */
static inline void turn(double R[3][3], const double theta[3]) {
    for (int c = 0; c < 3; c++) {
        const double e[3] = {R[0][c], R[1][c], R[2][c]};
        double once[3], twice[3];
        cross_product(theta, e, once);
        cross_product(theta, once, twice);
        for (int r = 0; r < 3; r++) R[r][c] = e[r] + once[r] + twice[r] / 2;
    }
}

/* R c of the centre of mass */
static inline void arm_of(const gough_machine *machine, const gough_state *s, double arm[3]) {
    for (int r = 0; r < 3; r++) {
        arm[r] = 0;
        for (int c = 0; c < 3; c++) arm[r] += s->rotation[r][c] * machine->load.center_of_mass[c];
    }
}

/* centre of mass and its velocity */
static inline void mass_center(const gough_machine *machine, const gough_state *s, double r[3],
                               double v[3]) {
    double arm[3], swing[3];

    arm_of(machine, s, arm);
    cross_product(s->angular_velocity, arm, swing);
    for (int i = 0; i < 3; i++) r[i] = s->position[i] + arm[i], v[i] = s->velocity[i] + swing[i];
}

/* the state with ξ added: of the top from centre of mass and rotation */
static inline gough_state changed(const gough_machine *machine, const gough_state *s,
                                  const double xi[12]) {
    gough_state out = *s;
    double r[3], v[3], arm[3], swing[3];

    mass_center(machine, s, r, v);
    turn(out.rotation, xi + 3);
    for (int i = 0; i < 3; i++) out.angular_velocity[i] += xi[9 + i];
    arm_of(machine, &out, arm);
    cross_product(out.angular_velocity, arm, swing);
    for (int i = 0; i < 3; i++) {
        out.position[i] = r[i] + xi[i] - arm[i];
        out.velocity[i] = v[i] + xi[6 + i] - swing[i];
    }
    return out;
}

/* ξ from a to b, to first order */
static inline void difference(const gough_machine *machine, const gough_state *a,
                              const gough_state *b, double xi[12]) {
    double ra[3], va[3], rb[3], vb[3];

    mass_center(machine, a, ra, va);
    mass_center(machine, b, rb, vb);
    for (int i = 0; i < 3; i++) {
        xi[i] = rb[i] - ra[i];
        xi[3 + i] = 0;
        xi[6 + i] = vb[i] - va[i];
        xi[9 + i] = b->angular_velocity[i] - a->angular_velocity[i];
    }
    for (int c = 0; c < 3; c++) {
        const double e[3] = {a->rotation[0][c], a->rotation[1][c], a->rotation[2][c]};
        const double f[3] = {b->rotation[0][c], b->rotation[1][c], b->rotation[2][c]};
        double turned[3];
        cross_product(e, f, turned);
        for (int i = 0; i < 3; i++) xi[3 + i] += turned[i] / 2;
    }
}

#endif
