/* Boxes of poses: what is certified survives poses drawn from it, travels and largest boxes are those of other ways to them:
 * limits of single poses by vectors (flight.h), and halving. */
#include <stdio.h>

#include "support/suite.h"
#include "workspace/flight.h"

/* random boxes: of those inside, no pose drawn exceeds a limit; of those outside, every pose does */
START_TEST(poses_of_tested_boxes_are_as_the_test_says) {
    gough_model *model = malloc(sizeof *model);
    dice d = {31};
    int count[GOUGH_VERDICTS] = {0, 0, 0};
    flight_machine(model);
    for (int n = 0; n < 10000; n++) {
        model->motion.order = n % 2 ? GOUGH_XYZ : GOUGH_ZYX;
        for (int k = 0; k < 3; k++) model->motion.about[k] = n % 3 ? dice_between(&d, -1, 1) : 0;
        const gough_reach reach = flight_reach(model);
        const double size = pow(10, dice_between(&d, -3, 0));
        gough_box box;
        for (int c = 0; c < GOUGH_COMPONENTS; c++) {
            const double at = dice_between(&d, -0.5, 0.5),
                         half = size * dice_between(&d, 0, c < 3 ? 0.3 : 0.2);
            box.least[c] = at - half, box.greatest[c] = at + half;
        }
        const gough_verdict verdict = gough_box_test(&reach, &box, NULL);
        count[verdict]++;
        for (int i = 0; i < 20 && verdict != GOUGH_UNDECIDED; i++) {
            double pose[GOUGH_COMPONENTS];
            flight_pick(&box, i % 2, &d, pose);
            const double over = flight_excess(model, &reach, pose);
            ck_assert_msg(verdict == GOUGH_INSIDE ? over <= 1e-10 : over > -1e-10,
                          "box %d of seed 31: verdict %d, but a pose exceeds by %g", n, verdict,
                          over);
        }
    }
    printf("boxes inside, outside, undecided: %d, %d, %d\n", count[0], count[1], count[2]);
    ck_assert(count[GOUGH_INSIDE] > 500 && count[GOUGH_OUTSIDE] > 500);
    free(model);
}
END_TEST

/* the last allowed part of a line, by steps and halving */
static double halved(const gough_model *model, const gough_reach *reach,
                     const double direction[GOUGH_COMPONENTS]) {
    double in = 0, out = 0, pose[GOUGH_COMPONENTS];
    bool beyond = false;
    while (!beyond) {
        out += 1e-3;
        for (int c = 0; c < GOUGH_COMPONENTS; c++) pose[c] = out * direction[c];
        beyond = flight_excess(model, reach, pose) > 0;
        if (!beyond) in = out;
    }
    for (int i = 0; i < 50; i++) {
        const double middle = 0.5 * (in + out);
        for (int c = 0; c < GOUGH_COMPONENTS; c++) pose[c] = middle * direction[c];
        if (flight_excess(model, reach, pose) > 0)
            out = middle;
        else
            in = middle;
    }
    return in;
}

/* the ends of travels are those of halving along each axis; those of slanted lines likewise */
START_TEST(lines_end_where_halving_finds_a_limit) {
    gough_model *model = malloc(sizeof *model);
    dice d = {33};
    flight_machine(model);
    const gough_reach reach = flight_reach(model);
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        gough_travel travel;
        ck_assert(gough_workspace_travel(&reach, c, &travel, NULL) == GOUGH_OK);
        for (int end = 0; end < 2; end++) {
            double direction[GOUGH_COMPONENTS] = {0, 0, 0, 0, 0, 0};
            direction[c] = end ? 1 : -1;
            const double in = halved(model, &reach, direction);
            ck_assert_msg(fabs(fabs(travel.end[end]) - in) < 1e-7, "%s: %.12g is not %.12g",
                          gough_component_name(c), travel.end[end], in);
            ck_assert(travel.end[end] * direction[c] > 0);
            ck_assert(travel.binding[end].bind != GOUGH_BIND_NONE);
        }
    }
    for (int n = 0; n < 40; n++) {
        const double home[GOUGH_COMPONENTS] = {0, 0, 0, 0, 0, 0};
        double direction[GOUGH_COMPONENTS];
        gough_ray ray;
        for (int c = 0; c < GOUGH_COMPONENTS; c++) direction[c] = dice_between(&d, -1, 1);
        ck_assert(gough_workspace_ray(&reach, home, direction, &ray, NULL) == GOUGH_OK);
        const double in = halved(model, &reach, direction);
        ck_assert_msg(fabs(ray.reach - in) < 1e-7, "line %d of seed 33: %.12g is not %.12g", n,
                      ray.reach, in);
    }
    free(model);
}
END_TEST

/* the box is certified, so poses drawn from it keep all limits; the pose that stops it does not; the gap is small */
START_TEST(largest_box_is_free_and_no_larger_one_is) {
    gough_model *model = malloc(sizeof *model);
    dice d = {32};
    gough_largest_box largest;
    gough_certificate found;
    gough_error error = {0};
    gough_box shape;
    flight_machine(model);
    const gough_reach reach = flight_reach(model);
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        gough_travel travel;
        ck_assert(gough_workspace_travel(&reach, c, &travel, NULL) == GOUGH_OK);
        shape.least[c] = travel.end[0], shape.greatest[c] = travel.end[1];
    }
    ck_assert_msg(gough_workspace_box(&reach, &shape, &largest, &error) == GOUGH_OK, "%s",
                  error.message);
    printf("scale %.8g, upper %.8g, %zu boxes, stopped by %s of %d\n", largest.scale, largest.upper,
           largest.tests, gough_bind_name(largest.binding.bind), largest.binding.which + 1);
    ck_assert(largest.scale > 0.1 && largest.upper < 1);
    ck_assert(largest.scale < largest.upper && largest.scale >= largest.upper * (1 - 1e-4));
    for (int n = 0; n < 100000; n++) {
        double pose[GOUGH_COMPONENTS];
        flight_pick(&largest.box, n % 2, &d, pose);
        ck_assert_msg(flight_excess(model, &reach, pose) <= 1e-10, "pose %d of seed 32", n);
    }
    ck_assert(flight_excess(model, &reach, largest.pose) > 0);
    ck_assert(gough_box_certify(&reach, &largest.box, &found, NULL) == GOUGH_OK);
    ck_assert(found.verdict == GOUGH_INSIDE);
    for (int c = 0; c < GOUGH_COMPONENTS; c++)
        largest.box.least[c] *= 1.01, largest.box.greatest[c] *= 1.01;
    ck_assert(gough_box_certify(&reach, &largest.box, &found, NULL) == GOUGH_OK);
    ck_assert(found.verdict == GOUGH_OUTSIDE && flight_excess(model, &reach, found.pose) > 0);
    free(model);
}
END_TEST

/* a box of heave alone ends where the longest leg does: all legs of a symmetric machine, by Pythagoras */
START_TEST(box_of_one_component_ends_with_its_travel) {
    gough_model *model = malloc(sizeof *model);
    const double turn = 40 * pi / 180, flat = 0.9 * 0.9 + 0.6 * 0.6 - 2 * 0.9 * 0.6 * cos(turn);
    const gough_platform ring =
        gough_platform_symmetric(0.9, 10 * pi / 180, 0.6, 10 * pi / 180, 0.5);
    const gough_load load = {.mass = 10, .inertia = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    const double gravity[3] = {0, 0, -9.80665};
    gough_largest_box largest;
    gough_error error = {0};
    for (int sign = -1; sign <= 1; sign += 2) {
        /* an end that is 0 may have either sign */
        const double none = sign * 0.0, end = sqrt(0.81 - flat) - 0.5;
        const gough_box shape = {{-none, -none, -0.2, -none, -none, -none},
                                 {none, none, 0.2, none, none, none}};
        gough_platform p = ring;
        memset(model, 0, sizeof *model);
        for (int v = 0; v < GOUGH_LEGS; v++) p.legs.length[v][0] = 0.01, p.legs.length[v][1] = 0.9;
        ck_assert_msg(gough_machine_init(&model->machine, &p, &load, gravity, &error) == GOUGH_OK,
                      "%s", error.message);
        const gough_reach reach = flight_reach(model);
        ck_assert_msg(gough_workspace_box(&reach, &shape, &largest, &error) == GOUGH_OK, "%s",
                      error.message);
        ck_assert_msg(fabs(largest.upper - end / 0.2) < 1e-9, "%.9g is not %.9g", largest.upper,
                      end / 0.2);
        ck_assert(largest.scale < largest.upper && largest.scale >= largest.upper * (1 - 1e-4));
        ck_assert(largest.binding.bind == GOUGH_BIND_LONGEST);
        for (int c = 0; c < GOUGH_COMPONENTS; c++)
            ck_assert(c == 2 ||
                      (!signbit(largest.box.least[c]) && !signbit(largest.box.greatest[c])));
    }
    free(model);
}
END_TEST

int main(void) {
    return SUITE_RUN("workspace", 120, poses_of_tested_boxes_are_as_the_test_says,
                     lines_end_where_halving_finds_a_limit,
                     largest_box_is_free_and_no_larger_one_is,
                     box_of_one_component_ends_with_its_travel);
}
