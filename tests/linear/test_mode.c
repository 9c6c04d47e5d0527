/* Modes: their names, the size and phase of their shapes, and shapes that have one eigenvalue. */
#include "linear/mode.h"

#include "support/machines.h"
#include "support/suite.h"

static void near(double found, double right, double tolerance) {
    ck_assert_msg(fabs(found - right) <= tolerance, "%.17g, not %.17g", found, right);
}

START_TEST(modes_are_named_by_what_moves) {
    static const struct {
        double complex shape[6];
        const char *name;
    } modes[] = {
        {{1}, "sway"},
        {{0, -3}, "sway"},
        {{0, 0, 1e-200}, "heave"},
        {{0, 0, 0, 1e200}, "tilt"},
        {{0, 0, 0, 0, -1}, "tilt"},
        {{0, 0, 0, 0, 0, 2}, "yaw"},
        {{1, 0, 0, 0, 1}, "sway–tilt"},
        {{0, 0, 1, 0, 0, 1}, "heave–yaw"},
        {{1, 1, 1, 1, 1, 1}, "sway–heave–tilt–yaw"},
        {{0, 0, 1, 0.05}, "heave"}, /* 0.08 · 0.0025 of it */
        {{0, 0, 1, 0.2}, "heave–tilt"},
        {{0}, "none"},
        {{(double complex)NAN, 1}, "none"},
        {{(double complex)INFINITY, 1}, "none"},
    };
    gough_machine machine;
    gough_mode mode;

    paper_machine(&machine);
    for (size_t i = 0; i < sizeof modes / sizeof modes[0]; i++) {
        mode_of(&machine, modes[i].shape, &mode);
        ck_assert_msg(strcmp(mode.name, modes[i].name) == 0, "%zu: %s, not %s", i, mode.name,
                      modes[i].name);
        if (strcmp(mode.name, "none") == 0) continue;
        near(mode.share[0] + mode.share[1] + mode.share[2] + mode.share[3], 1, 1e-15);
    }
    skew_machine(&machine); /* of mass 1.3 and J_x = 0.11 */
    mode_of(&machine, (const double complex[6]){0, 0, I, 1}, &mode);
    near(mode.share[1], 1.3 / 1.41, 1e-15);
    near(mode.share[2], 0.11 / 1.41, 1e-15);
}
END_TEST

/* the largest share made real and positive, whatever factor the shape comes with */
START_TEST(size_and_phase_of_a_shape_do_not_matter) {
    const double complex shape[6] = {0.1, 0.3 * I, 2 - I, 0.5, 0, 0.01 * I};
    gough_machine machine;
    gough_mode one, other;

    skew_machine(&machine);
    mode_of(&machine, shape, &one);
    ck_assert(fabs(one.shape[2][0] - 1) <= 0 && fabs(one.shape[2][1]) <= 0);
    for (int k = 0; k < 20; k++) {
        double complex turned[6];
        for (int a = 0; a < 6; a++) turned[a] = 1e3 * cexp(I * (double)k) * shape[a];
        mode_of(&machine, turned, &other);
        for (int a = 0; a < 6; a++) {
            near(other.shape[a][0], one.shape[a][0], 1e-15);
            near(other.shape[a][1], one.shape[a][1], 1e-15);
        }
    }
}
END_TEST

/* any mixture of two shapes of a symmetric machine, with surge and pitch in one and sway and roll in the other, gives them back;
 * the shape of another eigenvalue between them stays as it is */
START_TEST(mixed_shapes_are_told_apart) {
    const double complex surge[6] = {1, 0, 0, 0, -0.3 + 0.1 * I, 0},
                         sway[6] = {0, 1, 0, 0.3 - 0.1 * I, 0, 0}, yaw[6] = {0, 1e-3, 0, 0, 0, 1};
    const double complex value[3] = {I, 2 * I, I + 1e-12};
    gough_machine machine;
    dice d = {5};

    paper_machine(&machine);
    for (int k = 0; k < 20; k++) {
        const double complex a = dice_between(&d, -1, 1) + I * dice_between(&d, -1, 1),
                             b = dice_between(&d, -1, 1) + I * dice_between(&d, -1, 1);
        double complex shape[3][6];
        gough_mode one, other;
        for (int i = 0; i < 6; i++) {
            shape[0][i] = a * surge[i] + b * sway[i];
            shape[1][i] = yaw[i];
            shape[2][i] = 2 * surge[i] - (3 + a) * sway[i];
        }
        mode_separate(&machine, 3, value, 1e-10, shape);
        mode_of(&machine, shape[0], &one);
        mode_of(&machine, shape[2], &other);
        for (int i = 0; i < 6; i++) {
            /* the mixtures may be nearly alike, which costs digits */
            near(one.shape[i][0], creal(surge[i]), 1e-12);
            near(one.shape[i][1], cimag(surge[i]), 1e-12);
            near(other.shape[i][0], creal(sway[i]), 1e-12);
            near(other.shape[i][1], cimag(sway[i]), 1e-12);
            ck_assert(cabs(shape[1][i] - yaw[i]) <= 0);
        }
    }
}
END_TEST

/* a defective matrix has fewer shapes than equal eigenvalues: nothing to tell apart, and nothing is made up */
START_TEST(shapes_that_are_one_stay_one) {
    const double complex value[3] = {0, 0, 0};
    double complex shape[3][6] = {{1, 2, 0, 0, 1}, {1, 2, 1e-9, 0, 1}, {0, 0, 0, 0, 0, 1}};
    gough_machine machine;
    gough_mode mode;

    paper_machine(&machine);
    mode_separate(&machine, 3, value, 1e-10, shape);
    mode_of(&machine, shape[0], &mode);
    near(mode.shape[0][0], 0.5, 1e-12);
    mode_of(&machine, shape[1], &mode);
    near(mode.shape[0][0], 0.5, 1e-8);
    mode_of(&machine, shape[2], &mode);
    ck_assert_str_eq(mode.name, "yaw");
}
END_TEST

int main(void) {
    return SUITE_RUN("mode", 60, modes_are_named_by_what_moves,
                     size_and_phase_of_a_shape_do_not_matter, mixed_shapes_are_told_apart,
                     shapes_that_are_one_stay_one);
}
