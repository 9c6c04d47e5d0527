/* Forces and moments another way than in the library, by Newton's and Euler's equations for the load as given (its tensor in the
 * top frame, not in principal axes): the legs against weight and inertia of the whole, and gough_reactions() against Lagrange's
 * equations of the three axes, I_a ë_a = Q_a + Σ_b Λ_ab e_b. Random machines in random motion under random loads. */
#include <stdio.h>
#include <stdlib.h>

#include "gough/dynamics.h"
#include "support/machines.h"
#include "support/suite.h"

static const uint64_t seed = 20261130;
enum { CASES = 500 };

typedef struct {
    double x[3];
} vec;

static vec at(const double *x) { return (vec){{x[0], x[1], x[2]}}; }
static vec sum(vec a, vec b) { return (vec){{a.x[0] + b.x[0], a.x[1] + b.x[1], a.x[2] + b.x[2]}}; }
static vec times(double s, vec a) { return (vec){{s * a.x[0], s * a.x[1], s * a.x[2]}}; }
static double inner(vec a, vec b) { return a.x[0] * b.x[0] + a.x[1] * b.x[1] + a.x[2] * b.x[2]; }
static vec outer(vec a, vec b) {
    return (vec){{a.x[1] * b.x[2] - a.x[2] * b.x[1], a.x[2] * b.x[0] - a.x[0] * b.x[2],
                  a.x[0] * b.x[1] - a.x[1] * b.x[0]}};
}
static double size(vec a) { return sqrt(inner(a, a)); }
/* a matrix, row by row, and its transpose */
static vec apply(const double *m, vec a) {
    return (vec){{inner(at(m), a), inner(at(m + 3), a), inner(at(m + 6), a)}};
}
static vec apply_back(const double *m, vec a) {
    return sum(times(a.x[0], at(m)), sum(times(a.x[1], at(m + 3)), times(a.x[2], at(m + 6))));
}

static vec random_vec(dice *d, double most) {
    return (vec){
        {dice_between(d, -most, most), dice_between(d, -most, most), dice_between(d, -most, most)}};
}

/* A machine and an instant of its motion. */
typedef struct {
    gough_machine machine;
    gough_state state;
    gough_wrench external;
    vec center; /* of mass, from the top frame's origin, base axes */
    vec joint[6], direction[6];
    double force[6];
} scene;

static scene random_scene(dice *d) {
    scene s;
    double angles[3];
    skew_machine(&s.machine);
    s.machine.load.mass = dice_between(d, 0.5, 3);
    /* a tensor that a body can have, about turned axes: its derived numbers are made anew */
    const double turn[3] = {dice_between(d, -pi, pi), dice_between(d, -pi, pi),
                            dice_between(d, -pi, pi)};
    const double J[3] = {dice_between(d, 0.1, 0.2), dice_between(d, 0.1, 0.2),
                         dice_between(d, 0.1, 0.2)};
    double axes[3][3];
    gough_rotation_from_angles(turn, axes);
    for (int r = 0; r < 3; r++) {
        s.machine.load.center_of_mass[r] = dice_between(d, -0.1, 0.1);
        for (int c = 0; c < 3; c++) {
            s.machine.load.inertia[r][c] = 0;
            for (int k = 0; k < 3; k++)
                s.machine.load.inertia[r][c] += axes[r][k] * J[k] * axes[c][k];
        }
    }
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < r; c++) s.machine.load.inertia[r][c] = s.machine.load.inertia[c][r];
    const gough_machine made = s.machine;
    ck_assert_int_eq(gough_machine_init(&s.machine, &made.platform, &made.load, made.gravity, NULL),
                     GOUGH_OK);

    for (int c = 0; c < 3; c++) {
        angles[c] = dice_between(d, -0.4, 0.4);
        s.state.position[c] = (c == 2 ? made.platform.height : 0) + dice_between(d, -0.2, 0.2);
    }
    gough_rotation_from_angles(angles, s.state.rotation);
    memcpy(s.state.velocity, random_vec(d, 2).x, sizeof s.state.velocity);
    memcpy(s.state.angular_velocity, random_vec(d, 2).x, sizeof s.state.angular_velocity);
    memcpy(s.external.force, random_vec(d, 1).x, sizeof s.external.force);
    memcpy(s.external.moment, random_vec(d, 0.5).x, sizeof s.external.moment);

    s.center = apply(s.state.rotation[0], at(s.machine.load.center_of_mass));
    for (int v = 0; v < 6; v++) {
        s.joint[v] =
            sum(at(s.state.position), apply(s.state.rotation[0], at(made.platform.top[v])));
        s.direction[v] = sum(s.joint[v], times(-1, at(made.platform.base[v])));
        s.direction[v] = times(1 / size(s.direction[v]), s.direction[v]);
        s.force[v] = dice_between(d, -2, 2);
    }
    return s;
}

/* d/dt (J ω) about the centre of mass, base axes, for an angular acceleration */
static vec spin(const scene *s, vec omega, vec alpha) {
    const double *R = s->state.rotation[0];
    const vec w = apply_back(R, omega), a = apply_back(R, alpha);
    const double *J = s->machine.load.inertia[0];
    return apply(R, sum(apply(J, a), outer(w, apply(J, w))));
}

/* acceleration of the centre of mass */
static vec center_acceleration(const scene *s, const gough_acceleration *a) {
    const vec w = at(s->state.angular_velocity);
    return sum(at(a->linear), sum(outer(at(a->angular), s->center), outer(w, outer(w, s->center))));
}

/* What the legs push on the base with, force and moment about the base frame's origin, is weight, load and inertia of the whole. */
START_TEST(the_base_carries_weight_load_and_inertia) {
    dice d = {seed};
    double worst = 0;
    for (int n = 0; n < CASES; n++) {
        const scene s = random_scene(&d);
        const vec w = at(s.state.angular_velocity),
                  random[2] = {random_vec(&d, 3), random_vec(&d, 3)};
        const vec place = sum(at(s.state.position), s.center);
        gough_acceleration a;
        double force[6], condition, pushes = 0;
        memcpy(a.linear, random[0].x, sizeof a.linear);
        memcpy(a.angular, random[1].x, sizeof a.angular);
        ck_assert_int_eq(
            gough_inverse_dynamics(&s.machine, &s.state, &a, &s.external, force, &condition),
            GOUGH_OK);

        vec on_base = {{0, 0, 0}}, turning = {{0, 0, 0}};
        for (int v = 0; v < 6; v++) {
            const vec f = times(-force[v], s.direction[v]);
            on_base = sum(on_base, f);
            turning = sum(turning, outer(at(s.machine.platform.base[v]), f));
            pushes += fabs(force[v]);
        }
        const double M = s.machine.load.mass;
        const vec inertia = times(-M, center_acceleration(&s, &a));
        const vec all = sum(inertia, sum(times(M, at(s.machine.gravity)), at(s.external.force)));
        const vec moment = sum(outer(place, all),
                               sum(at(s.external.moment), times(-1, spin(&s, w, at(a.angular)))));
        const double error =
            size(sum(on_base, times(-1, all))) + size(sum(turning, times(-1, moment)));
        /* roundings of the solution times the condition number */
        ck_assert_msg(error <= 3e-14 * condition * pushes, "seed %llu, case %d: %g",
                      (unsigned long long)seed, n, error);
        if (error / pushes > worst) worst = error / pushes;
    }
    printf("equilibrium of the whole: %.1e of the forces\n", worst);
}
END_TEST

/* generalised force on axis a of the central frame: forces at their places along it, and half the moment, (body-6) */
static vec generalised(const scene *s, const double axis_in_top[3], vec axis) {
    vec Q = times(0.5, outer(at(s->external.moment), axis));
    for (int v = 0; v < 6; v++) {
        const vec arm =
            sum(at(s->machine.platform.top[v]), times(-1, at(s->machine.load.center_of_mass)));
        Q = sum(Q, times(s->force[v] * inner(arm, at(axis_in_top)), s->direction[v]));
    }
    return Q;
}

/* Euler: J α = moments − ω × J ω, solved by Cramer's rule in the top frame; and the moments' size */
static vec angular_acceleration(const scene *s, double *moments) {
    const vec w = at(s->state.angular_velocity), none = {{0, 0, 0}};
    const double *inertia = s->machine.load.inertia[0];
    vec turning = at(s->external.moment);
    *moments = size(turning) + size(spin(s, w, none));
    for (int v = 0; v < 6; v++) {
        const vec arm = sum(s->joint[v], times(-1, sum(at(s->state.position), s->center)));
        turning = sum(turning, outer(arm, times(s->force[v], s->direction[v])));
        *moments += fabs(s->force[v]) * size(arm);
    }
    const vec rest = apply_back(s->state.rotation[0], sum(turning, times(-1, spin(s, w, none))));
    const vec J[3] = {at(inertia), at(inertia + 3), at(inertia + 6)};
    const double det = inner(J[0], outer(J[1], J[2]));
    return apply(s->state.rotation[0], sum(times(rest.x[0] / det, outer(J[1], J[2])),
                                           sum(times(rest.x[1] / det, outer(J[2], J[0])),
                                               times(rest.x[2] / det, outer(J[0], J[1])))));
}

START_TEST(forces_accelerate_as_newton_and_euler_say) {
    dice d = {seed + 3};
    double worst[2] = {0, 0};
    for (int n = 0; n < CASES; n++) {
        const scene s = random_scene(&d);
        gough_acceleration a;
        double moments, forces = size(at(s.external.force));
        ck_assert_int_eq(gough_forward_dynamics(&s.machine, &s.state, s.force, &s.external, &a),
                         GOUGH_OK);
        vec want = sum(at(s.machine.gravity), times(1 / s.machine.load.mass, at(s.external.force)));
        for (int v = 0; v < 6; v++) {
            want = sum(want, times(s.force[v] / s.machine.load.mass, s.direction[v]));
            forces += fabs(s.force[v]);
        }
        const vec alpha = angular_acceleration(&s, &moments);
        const double scale = moments / 0.1; /* the least moment of inertia */
        const double off[2] = {size(sum(center_acceleration(&s, &a), times(-1, want))) /
                                   (forces / s.machine.load.mass + scale),
                               size(sum(at(a.angular), times(-1, alpha))) / scale};
        for (int k = 0; k < 2; k++) {
            ck_assert_msg(off[k] <= 1e-14, "seed %llu, case %d: %g", (unsigned long long)(seed + 3),
                          n, off[k]);
            worst[k] = fmax(worst[k], off[k]);
        }
    }
    printf("accelerations: %.1e and %.1e of what the legs give\n", worst[0], worst[1]);
}
END_TEST

START_TEST(reactions_close_the_equations_of_the_axes) {
    static const int pair[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
    dice d = {seed + 1};
    for (int n = 0; n < CASES; n++) {
        const scene s = random_scene(&d);
        const vec w = at(s.state.angular_velocity);
        const gough_machine *m = &s.machine;
        double reactions[6], in_top[3][3], moments;
        vec e[3], Q[3];
        ck_assert_int_eq(gough_reactions(m, &s.state, s.force, &s.external, reactions), GOUGH_OK);

        const vec alpha = angular_acceleration(&s, &moments);
        for (int a = 0; a < 3; a++) {
            for (int c = 0; c < 3; c++) in_top[a][c] = m->principal_axes[c][a];
            e[a] = apply(s.state.rotation[0], at(in_top[a]));
            Q[a] = generalised(&s, in_top[a], e[a]);
        }
        for (int k = 0; k < 6; k++) {
            for (int mirror = 0; mirror < 2; mirror++) {
                const int a = pair[k][mirror], b = pair[k][1 - mirror];
                const vec second = sum(outer(alpha, e[a]), outer(w, outer(w, e[a])));
                const double want = m->second_moments[a] * inner(second, e[b]) - inner(Q[a], e[b]);
                ck_assert_msg(fabs(reactions[k] - want) <= 1e-14 * moments,
                              "seed %llu, case %d, reaction %d: %.17g, not %.17g",
                              (unsigned long long)(seed + 1), n, k, reactions[k], want);
            }
        }
    }
}
END_TEST

/* the force of the wrench acts at the centre of mass */
START_TEST(a_force_at_the_centre_of_mass_has_no_reactions) {
    dice d = {seed + 2};
    scene s = random_scene(&d);
    double with[6], without[6];
    gough_reactions(&s.machine, &s.state, s.force, &s.external, with);
    memset(s.external.force, 0, sizeof s.external.force);
    gough_reactions(&s.machine, &s.state, s.force, &s.external, without);
    ck_assert_int_eq(memcmp(with, without, sizeof with), 0);
    memset(s.external.moment, 0, sizeof s.external.moment);
    gough_reactions(&s.machine, &s.state, s.force, &s.external, with);
    gough_reactions(&s.machine, &s.state, s.force, NULL, without);
    ck_assert_int_eq(memcmp(with, without, sizeof with), 0);
}
END_TEST

int main(void) {
    return SUITE_RUN("plant/reactions", 60, forces_accelerate_as_newton_and_euler_say,
                     the_base_carries_weight_load_and_inertia,
                     reactions_close_the_equations_of_the_axes,
                     a_force_at_the_centre_of_mass_has_no_reactions);
}
