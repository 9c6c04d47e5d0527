/* Velocities and accelerations against differences of what they are the derivatives of, along a program of all six axes; the
 * Jacobian against rates; reactions against their definition; condition against a plain eigenvalue iteration. */
#include <stdio.h>

#include "gough/dynamics.h"
#include "support/machines.h"
#include "support/suite.h"

/* Central difference of eighth order with this spacing: truncation about 1e-13 for motions of unit frequency, round-off
 * 1e-16/h about 1e-14 */
static const double spacing = 0.02;
static const double tolerance = 1e-11;
static const double weight[4] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};

/* everything of the program's top at a time, as numbers to be differenced */
enum { POSITION = 0, ROTATION = 3, VELOCITY = 12, SPIN = 15, LENGTH = 18, RATE = 24, ALL = 30 };

typedef struct {
    gough_model *model;
    gough_state state;
    gough_acceleration acceleration;
    double value[ALL], second_rate[6];
} moment;

static void at(moment *m, double t) {
    const gough_machine *machine = &m->model->machine;

    gough_program(machine, &m->model->motion, t, &m->state, &m->acceleration);
    gough_leg_kinematics(machine, &m->state, &m->acceleration, m->value + LENGTH, m->value + RATE,
                         m->second_rate);
    for (int r = 0; r < 3; r++) {
        m->value[POSITION + r] = m->state.position[r];
        m->value[VELOCITY + r] = m->state.velocity[r];
        m->value[SPIN + r] = m->state.angular_velocity[r];
        for (int c = 0; c < 3; c++) m->value[ROTATION + 3 * r + c] = m->state.rotation[r][c];
    }
}

static void difference(moment *m, double t, double rate[ALL]) {
    for (int i = 0; i < ALL; i++) rate[i] = 0;
    for (int k = 1; k <= 4; k++) {
        at(m, t + k * spacing);
        for (int i = 0; i < ALL; i++) rate[i] += weight[k - 1] * m->value[i] / spacing;
        at(m, t - k * spacing);
        for (int i = 0; i < ALL; i++) rate[i] -= weight[k - 1] * m->value[i] / spacing;
    }
    at(m, t);
}

static gough_model *moving(void) {
    gough_model *model = calloc(1, sizeof *model);

    skew_machine(&model->machine);
    set_all_axes(model);
    model->motion.about[0] = 0.2;
    model->motion.about[1] = -0.1;
    model->motion.about[2] = 0.5;
    return model;
}

START_TEST(rates_are_differences) {
    moment m = {.model = moving()};

    for (double t = 1; t < 10; t += 0.37) {
        double rate[ALL], spin[3];
        difference(&m, t, rate);
        for (int i = 0; i < 3; i++) {
            ck_assert(fabs(rate[POSITION + i] - m.state.velocity[i]) <= tolerance);
            ck_assert(fabs(rate[VELOCITY + i] - m.acceleration.linear[i]) <= tolerance);
            ck_assert(fabs(rate[SPIN + i] - m.acceleration.angular[i]) <= tolerance);
        }
        for (int i = 0; i < 6; i++) {
            ck_assert(fabs(rate[LENGTH + i] - m.value[RATE + i]) <= tolerance);
            ck_assert(fabs(rate[RATE + i] - m.second_rate[i]) <= tolerance);
        }
        /* Ṙ Rᵀ is the cross product with ω */
        for (int i = 0; i < 3; i++) {
            const int p = (i + 2) % 3, q = (i + 1) % 3;
            spin[i] = 0;
            for (int c = 0; c < 3; c++) {
                spin[i] += rate[ROTATION + 3 * p + c] * m.state.rotation[q][c];
            }
            ck_assert(fabs(spin[i] - m.state.angular_velocity[i]) <= tolerance);
        }
    }
    free(m.model);
}
END_TEST

/* the point `about` moves by the formulas, whatever the rotation */
START_TEST(the_named_point_follows_the_formulas) {
    moment m = {.model = moving()};

    for (double t = 0; t < 5; t += 0.6) {
        double component[GOUGH_COMPONENTS][3];
        gough_motion_evaluate(&m.model->motion, t, component);
        at(&m, t);
        for (int r = 0; r < 3; r++) {
            double point = m.state.position[r];
            for (int c = 0; c < 3; c++) {
                point += m.state.rotation[r][c] * m.model->motion.about[c];
            }
            const double home = m.model->motion.about[r] + (r == 2 ? 1.2 : 0);
            ck_assert(fabs(point - home - component[r][0]) <= 1e-15);
        }
    }
    free(m.model);
}
END_TEST

START_TEST(jacobian_maps_velocities_to_rates) {
    moment m = {.model = moving()};

    for (double t = 0; t < 10; t += 0.5) {
        double J[6][6];
        at(&m, t);
        gough_jacobian(&m.model->machine, &m.state, J);
        for (int v = 0; v < 6; v++) {
            double rate = 0;
            for (int c = 0; c < 3; c++) {
                rate += J[v][c] * m.state.velocity[c] + J[v][3 + c] * m.state.angular_velocity[c];
            }
            ck_assert(fabs(rate - m.value[RATE + v]) <= 1e-14);
        }
    }
    free(m.model);
}
END_TEST

/* largest eigenvalue of a symmetric positive matrix by iteration with Rayleigh's quotient */
static double largest_eigenvalue(double a[6][6]) {
    double x[6] = {1, 0.9, 0.8, 0.7, 0.6, 0.5}, value = 0;

    for (int n = 0; n < 20000; n++) {
        double y[6], size = 0;
        for (int r = 0; r < 6; r++) {
            y[r] = 0;
            for (int c = 0; c < 6; c++) y[r] += a[r][c] * x[c];
            size += y[r] * y[r];
        }
        value = sqrt(size);
        for (int r = 0; r < 6; r++) x[r] = y[r] / value;
    }
    return value;
}

/* condition: moments about the top frame's origin over the mean distance of the top joints, by power iteration on JᵀJ and on
 * (λ − JᵀJ) */
START_TEST(condition_is_that_of_the_scaled_jacobian) {
    moment m = {.model = moving()};
    double reach = 0;

    for (int v = 0; v < 6; v++) {
        const double *t = m.model->machine.platform.top[v];
        reach += sqrt(t[0] * t[0] + t[1] * t[1] + t[2] * t[2]) / 6;
    }
    for (double t = 0; t < 3; t += 1) {
        double J[6][6], a[6][6], condition, high, low;
        at(&m, t);
        gough_jacobian(&m.model->machine, &m.state, J);
        gough_conditioning(&m.model->machine, &m.state, &condition, NULL);
        for (int r = 0; r < 6; r++) {
            for (int c = 0; c < 6; c++) {
                a[r][c] = 0;
                for (int v = 0; v < 6; v++) {
                    a[r][c] += J[v][r] * J[v][c] / ((r < 3 ? 1 : reach) * (c < 3 ? 1 : reach));
                }
            }
        }
        high = largest_eigenvalue(a);
        for (int r = 0; r < 6; r++) {
            for (int c = 0; c < 6; c++) a[r][c] = (r == c ? high : 0) - a[r][c];
        }
        low = high - largest_eigenvalue(a);
        ck_assert(fabs(condition / sqrt(high / low) - 1) <= 1e-9);
    }
    free(m.model);
}
END_TEST

START_TEST(angles_come_back_from_rotations) {
    dice d = {31};

    for (int n = 0; n < 10000; n++) {
        const double angles[3] = {dice_between(&d, -pi, pi), dice_between(&d, -pi / 2, pi / 2),
                                  dice_between(&d, -pi, pi)};
        double R[3][3], back[3];
        gough_rotation_from_angles(angles, R);
        gough_angles_from_rotation(R, back);
        for (int c = 0; c < 3; c++) ck_assert(fabs(back[c] - angles[c]) <= 1e-11);
    }
}
END_TEST

/* with the legs' forces of inverse dynamics, the multipliers are those that the motion asks for: Λ_ii = −Q_i·i − I_x i̇² */
START_TEST(reactions_at_rest_are_the_forces_moments) {
    gough_machine machine;
    double force[6], condition, r[6], want[3] = {0, 0, 0};
    const gough_acceleration rest = {{0, 0, 0}, {0, 0, 0}};
    gough_state home;

    paper_machine(&machine);
    home = gough_state_home(&machine);
    ck_assert_int_eq(gough_inverse_dynamics(&machine, &home, &rest, NULL, force, &condition),
                     GOUGH_OK);
    gough_reactions(&machine, &home, force, NULL, r);
    /* at home and at rest Q_i·i = Σ x F_x and so on, forces along the legs */
    for (int v = 0; v < 6; v++) {
        for (int c = 0; c < 3; c++) {
            const double *t = machine.platform.top[v], *b = machine.platform.base[v];
            const double n = (t[c] + (c == 2 ? 1 : 0) - b[c]) / machine.home_length[v];
            want[c] -= t[c] * force[v] * n;
        }
    }
    for (int c = 0; c < 3; c++) ck_assert(fabs(r[c] - want[c]) <= 1e-15);
    for (int c = 3; c < 6; c++) ck_assert(fabs(r[c]) <= 1e-15);
}
END_TEST

/* a mirror is orthonormal, and no rotation all the same */
START_TEST(a_matrix_that_is_no_rotation_is_refused_and_nothing_is_written) {
    static const double BAD[][3][3] = {{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}},
                                       {{1, 1e-5, 0}, {0, 1, 0}, {0, 0, 1}},
                                       {{1, 0, 0}, {0, NAN, 0}, {0, 0, 1}}};
    const double push[6] = {1, 1, 1, 1, 1, 1};
    const gough_acceleration rest = {{0, 0, 0}, {0, 0, 0}};
    gough_machine machine;

    paper_machine(&machine);
    for (size_t i = 0; i < sizeof BAD / sizeof BAD[0]; i++) {
        double out[36], jacobian[6][6];
        gough_acceleration acceleration = {{7, 7, 7}, {7, 7, 7}};
        gough_state state = gough_state_home(&machine);

        memcpy(state.rotation, BAD[i], sizeof state.rotation);
        for (int k = 0; k < 36; k++) out[k] = jacobian[k / 6][k % 6] = 7;
        ck_assert_int_eq(gough_angles_from_rotation(state.rotation, out), GOUGH_ERROR_INPUT);
        ck_assert_int_eq(gough_leg_kinematics(&machine, &state, &rest, out, out + 6, out + 12),
                         GOUGH_ERROR_INPUT);
        ck_assert_int_eq(gough_jacobian(&machine, &state, jacobian), GOUGH_ERROR_INPUT);
        ck_assert_int_eq(gough_conditioning(&machine, &state, out, out + 1), GOUGH_ERROR_INPUT);
        ck_assert_int_eq(gough_inverse_dynamics(&machine, &state, &rest, NULL, out, out + 6),
                         GOUGH_ERROR_INPUT);
        ck_assert_int_eq(gough_forward_dynamics(&machine, &state, push, NULL, &acceleration),
                         GOUGH_ERROR_INPUT);
        ck_assert_int_eq(gough_reactions(&machine, &state, push, NULL, out), GOUGH_ERROR_INPUT);
        for (int k = 0; k < 36; k++) ck_assert(out[k] == 7 && jacobian[k / 6][k % 6] == 7);
        for (int k = 0; k < 3; k++) {
            ck_assert(acceleration.linear[k] == 7 && acceleration.angular[k] == 7);
        }
    }
}
END_TEST

/* turned by 90° about the vertical the legs of this machine no longer hold it */
START_TEST(forces_at_a_singular_pose_are_a_numerical_error) {
    const gough_acceleration rest = {{0, 0, 0}, {0, 0, 0}};
    const double angles[3] = {0, 0, pi / 2};
    double force[6], condition, determinant;
    gough_machine machine;
    gough_state state;

    paper_machine(&machine);
    state = gough_state_home(&machine);
    gough_rotation_from_angles(angles, state.rotation);
    ck_assert_int_eq(gough_conditioning(&machine, &state, NULL, &determinant), GOUGH_OK);
    ck_assert(fabs(determinant) <= 1e-15);
    ck_assert_int_eq(gough_inverse_dynamics(&machine, &state, &rest, NULL, force, &condition),
                     GOUGH_ERROR_NUMERICAL);
    ck_assert(condition > GOUGH_GREATEST_CONDITION);
    ck_assert_int_eq(gough_inverse_dynamics(&machine, &state, &rest, NULL, force, NULL),
                     GOUGH_ERROR_NUMERICAL);
}
END_TEST

START_TEST(numbers_that_are_not_finite_are_a_numerical_error) {
    const double push[6] = {1, 1, INFINITY, 1, 1, 1};
    const gough_acceleration bad = {{0, 0, NAN}, {0, 0, 0}};
    gough_acceleration acceleration;
    double force[6], condition;
    gough_machine machine;
    gough_state home;

    paper_machine(&machine);
    home = gough_state_home(&machine);
    ck_assert_int_eq(gough_inverse_dynamics(&machine, &home, &bad, NULL, force, &condition),
                     GOUGH_ERROR_NUMERICAL);
    ck_assert(condition < GOUGH_GREATEST_CONDITION);
    ck_assert_int_eq(gough_forward_dynamics(&machine, &home, push, NULL, &acceleration),
                     GOUGH_ERROR_NUMERICAL);
}
END_TEST

/* Hamilton's product */
static void product(const double p[4], const double q[4], double to[4]) {
    to[0] = p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3];
    to[1] = p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2];
    to[2] = p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1];
    to[3] = p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0];
}

/* columns of R are q e q* of the axes, for a unit q; multiples of q give the same R, also at the ends of the range of numbers */
START_TEST(a_quaternion_turns_vectors_by_products) {
    static const double size[] = {1, 16384, 1e-300, 1e300};
    dice d = {17};
    for (int n = 0; n < 400; n++) {
        double q[4], back[4], R[3][3], square = 0;
        for (int i = 0; i < 4; i++) q[i] = dice_between(&d, -1, 1), square += q[i] * q[i];
        for (int i = 0; i < 4; i++) q[i] /= sqrt(square), back[i] = i == 0 ? q[i] : -q[i];
        const double f = size[n % 4], far[4] = {f * q[0], f * q[1], f * q[2], f * q[3]};
        ck_assert_int_eq(gough_rotation_of_quaternion(far, R), GOUGH_OK);
        for (int c = 0; c < 3; c++) {
            const double axis[4] = {0, c == 0, c == 1, c == 2};
            double half[4], turned[4];
            product(q, axis, half), product(half, back, turned);
            for (int r = 0; r < 3; r++) ck_assert_double_eq_tol(R[r][c], turned[1 + r], 1e-14);
        }
    }
    const double none[][4] = {{0, 0, 0, 0}, {1, NAN, 0, 0}, {0, 0, 0, INFINITY}};
    for (int i = 0; i < 3; i++) {
        double R[3][3] = {{7}};
        ck_assert_int_eq(gough_rotation_of_quaternion(none[i], R), GOUGH_ERROR_INPUT);
        ck_assert(R[0][0] == 7 && R[2][2] == 0);
    }
}
END_TEST

int main(void) {
    return SUITE_RUN("kinematics", 30, a_quaternion_turns_vectors_by_products,
                     rates_are_differences, the_named_point_follows_the_formulas,
                     jacobian_maps_velocities_to_rates, condition_is_that_of_the_scaled_jacobian,
                     angles_come_back_from_rotations, reactions_at_rest_are_the_forces_moments,
                     a_matrix_that_is_no_rotation_is_refused_and_nothing_is_written,
                     forces_at_a_singular_pose_are_a_numerical_error,
                     numbers_that_are_not_finite_are_a_numerical_error);
}
