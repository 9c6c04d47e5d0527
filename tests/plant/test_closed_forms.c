/* The equations against closed forms of the symmetric hexapod (docs/theory/stability.md), 100 random geometries each. */
#include <complex.h>
#include <stdio.h>
#include <stdlib.h>

#include "plant/plant_complex.h"
#include "support/machines.h"
#include "support/suite.h"

static const uint64_t seed = 20260401;

/* relative tolerance of the closed forms: a dozen roundings of each side */
static const double closed = 1e-12;

static int near(double a, double b, double tolerance, double scale) {
    return fabs(a - b) <= tolerance * scale;
}

/* (stab-1): F = M (z̈ + g) l/(6h) */
START_TEST(force_in_heave) {
    dice d = {seed};

    for (int i = 0; i < 100; i++) {
        gough_machine machine;
        const symmetric s = random_symmetric(&d, &machine);
        gough_state state = gough_state_home(&machine);
        gough_acceleration a = {{0, 0, dice_between(&d, -5, 5)}, {0, 0, 0}};
        double force[6], condition, l, want;

        state.velocity[2] = dice_between(&d, -2, 2);
        ck_assert_int_eq(gough_inverse_dynamics(&machine, &state, &a, NULL, force, &condition),
                         GOUGH_OK);
        l = sqrt(s.h * s.h + s.R * s.R + s.r * s.r - 2 * s.R * s.r * cos(s.delta));
        want = s.M * (a.linear[2] + s.g) * l / (6 * s.h);
        for (int v = 0; v < 6; v++) {
            ck_assert_msg(near(force[v], want, closed, s.M * (s.g + fabs(a.linear[2])) * l / s.h),
                          "seed %llu run %d leg %d: %.17g, not %.17g", (unsigned long long)seed, i,
                          v + 1, force[v], want);
        }
    }
}
END_TEST

static double determinant(double m[6][6]) {
    double det = 1;

    for (int c = 0; c < 6; c++) {
        int p = c;
        for (int r = c + 1; r < 6; r++) {
            if (fabs(m[r][c]) > fabs(m[p][c])) p = r;
        }
        for (int k = 0; k < 6; k++) {
            const double x = m[c][k];
            m[c][k] = m[p][k];
            m[p][k] = x;
        }
        if (p != c) det = -det;
        det *= m[c][c];
        for (int r = c + 1; r < 6; r++) {
            const double f = m[r][c] / m[c][c];
            for (int k = c; k < 6; k++) m[r][k] -= f * m[c][k];
        }
    }
    return det;
}

/* (stab-2): |det J| = 54 (hRr sin δ)³ |cos ψ| / (l₊³ l₋³), level top turned by ψ */
START_TEST(determinant_of_the_jacobian) {
    dice d = {seed + 1};

    for (int i = 0; i < 100; i++) {
        gough_machine machine;
        const symmetric s = random_symmetric(&d, &machine);
        const double yaw = dice_between(&d, -1.4, 1.4), angles[3] = {0, 0, yaw};
        gough_state state = gough_state_home(&machine);
        double J[6][6], scaled, plus, minus, want;

        gough_rotation_from_angles(angles, state.rotation);
        gough_jacobian(&machine, &state, J);
        plus = s.R * s.R + s.r * s.r + s.h * s.h - 2 * s.R * s.r * cos(s.delta - yaw);
        minus = s.R * s.R + s.r * s.r + s.h * s.h - 2 * s.R * s.r * cos(s.delta + yaw);
        want = 54 * pow(s.h * s.R * s.r * sin(s.delta), 3) * cos(yaw) / pow(plus * minus, 1.5);
        ck_assert_msg(near(fabs(determinant(J)), fabs(want), closed, want),
                      "run %d: %.17g, not %.17g", i, fabs(determinant(J)), want);
        gough_conditioning(&machine, &state, NULL, &scaled);
        ck_assert(near(fabs(scaled) * pow(s.r, 3), want, 100 * closed, want));
    }
}
END_TEST

/* (stab-4): JᵀJ about the centre of the top joints */
START_TEST(stiffness_of_the_legs) {
    dice d = {seed + 2};

    for (int i = 0; i < 100; i++) {
        gough_machine machine;
        const symmetric s = random_symmetric(&d, &machine);
        const gough_state state = gough_state_home(&machine);
        const double d2 = s.R * s.R + s.r * s.r - 2 * s.R * s.r * cos(s.delta);
        const double l2 = s.h * s.h + d2, q = s.r * s.r - s.r * s.R * cos(s.delta);
        double J[6][6], want[6][6] = {{0}};

        want[0][0] = want[1][1] = 3 * d2 / l2;
        want[2][2] = 6 * s.h * s.h / l2;
        want[3][3] = want[4][4] = 3 * s.r * s.r * s.h * s.h / l2;
        want[5][5] = 6 * pow(s.R * s.r * sin(s.delta), 2) / l2;
        want[0][4] = want[4][0] = -3 * s.h * q / l2;
        want[1][3] = want[3][1] = 3 * s.h * q / l2;
        gough_jacobian(&machine, &state, J);
        for (int r = 0; r < 6; r++) {
            for (int c = 0; c < 6; c++) {
                double sum = 0;
                for (int v = 0; v < 6; v++) sum += J[v][r] * J[v][c];
                ck_assert_msg(near(sum, want[r][c], closed, 6 * fmax(1, s.R * s.R)),
                              "run %d entry %d %d: %.17g, not %.17g", i, r, c, sum, want[r][c]);
            }
        }
    }
}
END_TEST

/* (stab-7): λ² = g d²/(h l²), heave under constant forces: the derivative of the acceleration by an imaginary step */
START_TEST(growth_rate_in_heave) {
    const double step = 1e-30;
    dice d = {seed + 3};

    for (int i = 0; i < 100; i++) {
        gough_machine machine;
        const symmetric s = random_symmetric(&d, &machine);
        const double d2 = s.R * s.R + s.r * s.r - 2 * s.R * s.r * cos(s.delta);
        const double l2 = s.h * s.h + d2, want = s.g * d2 / (s.h * l2);
        const double complex none[3] = {0, 0, 0};
        double complex state[24] = {0}, force[6], rest[12] = {0}, a[12];

        state[2] = s.h + s.c;
        /* the central axes may be any that fit: their triad at home */
        for (int c = 0; c < 3; c++) {
            for (int r = 0; r < 3; r++) state[3 + 3 * c + r] = machine.principal_axes[r][c];
        }
        dynamics_complex.forces(&machine, state, rest, force);
        state[2] += step * I;
        dynamics_complex.accelerations(&machine, state, force, none, none, a);
        ck_assert_msg(near(cimag(a[2]) / step, want, closed, fmax(want, s.g / s.h)),
                      "run %d: %.17g, not %.17g", i, cimag(a[2]) / step, want);
    }
}
END_TEST

/* (legs-8): singular exactly where a closed form says so: a yaw of 90 degrees, and its sign changes there */
START_TEST(singular_at_a_quarter_turn) {
    dice d = {seed + 4};

    for (int i = 0; i < 100; i++) {
        gough_machine machine;
        gough_state state;
        double angles[3] = {0, 0, pi / 2}, condition, before, after;

        (void)random_symmetric(&d, &machine);
        state = gough_state_home(&machine);
        gough_rotation_from_angles(angles, state.rotation);
        gough_conditioning(&machine, &state, &condition, NULL);
        ck_assert(condition > 1e13);
        angles[2] = pi / 2 - 1e-3;
        gough_rotation_from_angles(angles, state.rotation);
        gough_conditioning(&machine, &state, NULL, &before);
        angles[2] = pi / 2 + 1e-3;
        gough_rotation_from_angles(angles, state.rotation);
        gough_conditioning(&machine, &state, NULL, &after);
        ck_assert(before * after < 0);
    }
}
END_TEST

int main(void) {
    return SUITE_RUN("closed forms", 60, force_in_heave, determinant_of_the_jacobian,
                     stiffness_of_the_legs, growth_rate_in_heave, singular_at_a_quarter_turn);
}
