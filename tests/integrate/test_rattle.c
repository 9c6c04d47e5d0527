/* RATTLE alone, on bodies without legs: what a free tumbling body must keep, a flat body, a known precession, and time run back. */
#define NUMBER_DOUBLE
#include <stdio.h>

#include "integrate/rattle.h"
#include "support/suite.h"

static void nothing_acts(void *context, real t, const coordinates *x, number wrench[6],
                         number damping[6][6]) {
    (void)context, (void)t, (void)x, (void)damping;
    for (int i = 0; i < 6; i++) wrench[i] = 0;
}

static rattle_state tumbling(void) {
    rattle_state s = {.x = {{0.1, 0.2, 0.3}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                      .velocity = {0.02, -0.01, 0.03},
                      .omega = {0.6, 0.5, 0.7}};
    return s;
}

/* J Ω in base axes, from the triad and its rates by their own definition: Σ I e × ė */
static vector angular_momentum(const body *b, const rattle_state *s) {
    const triad rate = triad_rate(&s->x.q, out_of(&s->x.q, s->omega));
    vector sum = scale(b->Ix, cross(s->x.q.i, rate.i));

    sum = along(sum, b->Iy, cross(s->x.q.j, rate.j));
    return along(sum, b->Iz, cross(s->x.q.k, rate.k));
}

/* T = ½ Σ I ė², (body-2) */
static double energy(const body *b, const rattle_state *s) {
    const triad rate = triad_rate(&s->x.q, out_of(&s->x.q, s->omega));

    return (b->Ix * dot(rate.i, rate.i) + b->Iy * dot(rate.j, rate.j) +
            b->Iz * dot(rate.k, rate.k)) /
           2;
}

typedef struct {
    double triad, energy, momentum;
} kept;

static kept tumble(const body *b, int level, double duration, double h) {
    const rattle method = {b, NULL, nothing_acts, NULL, 0};
    const long steps = lround(duration / h);
    rattle_state s = tumbling();
    kept worst = {0, 0, 0};

    rattle_begin(&method, 0, &s);
    const double e0 = energy(b, &s);
    const vector m0 = angular_momentum(b, &s);
    for (long k = 0; k < steps; k++) {
        ck_assert(rattle_compose(&method, level, (double)k * h, h, &s) < 1e-12);
        worst.triad = fmax(worst.triad, triad_violation(&s.x.q));
        worst.energy = fmax(worst.energy, fabs(energy(b, &s) / e0 - 1));
        worst.momentum =
            fmax(worst.momentum, norm(subtract(angular_momentum(b, &s), m0)) / norm(m0));
        /* a maximum would pass over what is not a number */
        ck_assert(isfinite(energy(b, &s)));
        ck_assert(isfinite(norm(angular_momentum(b, &s))));
        ck_assert(isfinite(norm(s.x.q.i) + norm(s.x.q.j) + norm(s.x.q.k)));
    }
    return worst;
}

/* energy is kept to h² only between; the discrete Moser–Veselov flow keeps it exactly up to round-off for a free body */
START_TEST(keeps_a_free_tumbling_body) {
    const body b = body_of(1.5, 0.095, 0.055, 0.025);
    const kept worst = tumble(&b, 0, 200, 0.05);

    printf("free body, 200 units, rattle2 at 0.05: constraint %.1e, energy %.1e, momentum %.1e\n",
           worst.triad, worst.energy, worst.momentum);
    ck_assert(worst.triad <= 1e-14);
    ck_assert(worst.energy <= 1e-13);
    ck_assert(worst.momentum <= 1e-13);
}
END_TEST

/* some I = 0: nothing divides by it */
START_TEST(keeps_a_flat_body) {
    const body b = body_of(1, 0.05, 0.03, 0);

    for (int level = 0; level < 4; level++) {
        const kept worst = tumble(&b, level, 50, 0.05);
        ck_assert(worst.triad <= 1e-14);
        ck_assert(worst.momentum <= 1e-13);
        ck_assert(worst.energy <= 1e-12);
    }
}
END_TEST

/* an axisymmetric body: Ω_z constant, (Ω_x, Ω_y) turns at (J_x − J_z)/J_x Ω_z; the order-8 composition against it */
START_TEST(precesses_as_euler_says) {
    const body b = body_of(1, 0.04, 0.04, 0.02); /* J = 0.06, 0.06, 0.08 */
    const rattle method = {&b, NULL, nothing_acts, NULL, 0};
    rattle_state s = tumbling();
    const vector start = s.omega;

    rattle_begin(&method, 0, &s);
    for (int k = 0; k < 100; k++) (void)rattle_compose(&method, 3, k * 0.1, 0.1, &s);
    const double angle = (0.08 - 0.06) / 0.06 * start.z * 10;
    ck_assert(fabs(s.omega.z - start.z) <= 1e-13);
    ck_assert(fabs(s.omega.x - (start.x * cos(angle) - start.y * sin(angle))) <= 1e-11);
    ck_assert(fabs(s.omega.y - (start.x * sin(angle) + start.y * cos(angle))) <= 1e-11);
    ck_assert(fabs(s.x.rho.z - (0.3 + 10 * 0.03)) <= 1e-13);
}
END_TEST

/* pulls the body back and damps it, in all six freedoms, coupled */
static void spring_and_damper(void *context, real t, const coordinates *x, number wrench[6],
                              number damping[6][6]) {
    const double strength = *(const double *)context;

    wrench[0] = -x->rho.x + 0.1 * sin(t);
    wrench[1] = -2 * x->rho.y;
    wrench[2] = -3 * x->rho.z;
    /* torque that turns k to the vertical, on the body's axes: 0.2 k × z */
    wrench[3] = 0.2 * x->q.j.z;
    wrench[4] = -0.2 * x->q.i.z;
    wrench[5] = 0;
    for (int i = 0; i < 6; i++) {
        for (int j = 0; j < 6; j++) damping[i][j] = strength * (i == j ? 0.05 : 0.005);
    }
}

/* a symmetric step run back with −h returns, with damping too */
START_TEST(runs_back_to_where_it_began) {
    const body b = body_of(1.5, 0.095, 0.055, 0.025);
    double strength = 1;
    const rattle method = {&b, NULL, spring_and_damper, &strength, 1};
    rattle_state s = tumbling();
    const rattle_state start = s;

    rattle_begin(&method, 0, &s);
    for (int k = 0; k < 40; k++) (void)rattle_step(&method, k * 0.05, 0.05, &s);
    ck_assert(norm(subtract(s.omega, start.omega)) > 0.05);
    for (int k = 40; k > 0; k--) (void)rattle_step(&method, k * 0.05, -0.05, &s);
    ck_assert(norm(subtract(s.omega, start.omega)) <= 1e-12);
    ck_assert(norm(subtract(s.velocity, start.velocity)) <= 1e-12);
    ck_assert(norm(subtract(s.x.q.i, start.x.q.i)) <= 1e-12);
    ck_assert(norm(subtract(s.x.rho, start.x.rho)) <= 1e-12);
}
END_TEST

/* a step of more than half a turn has no solution, and says so */
START_TEST(reports_a_step_too_long) {
    const body b = body_of(1.5, 0.095, 0.055, 0.025);
    const rattle method = {&b, NULL, nothing_acts, NULL, 0};
    rattle_state s = tumbling();

    s.omega = (vector){30, 20, 25};
    rattle_begin(&method, 0, &s);
    ck_assert(!(rattle_step(&method, 0, 0.5, &s) <= 1e-6));
}
END_TEST

int main(void) {
    return SUITE_RUN("rattle", 60, keeps_a_free_tumbling_body, keeps_a_flat_body,
                     precesses_as_euler_says, runs_back_to_where_it_began, reports_a_step_too_long);
}
