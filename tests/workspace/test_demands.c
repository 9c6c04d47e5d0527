/* Motions and loads asked for over boxes of poses, with legs that have mass: forces, rates and accelerations of the legs by
 * gough_inverse_dynamics() and gough_leg_kinematics() at single poses; clearance by points of the legs; volumes by chance.
 * Label: standard.
 * Sanitized: campaign: it evaluates a million poses. */
#include <stdio.h>

#include "support/suite.h"
#include "workspace/flight.h"

/* of boxes that are inside, no motion drawn exceeds a limit */
START_TEST(motions_of_tested_boxes_keep_the_limits) {
    gough_model *model = malloc(sizeof *model);
    dice d = {41};
    int count[GOUGH_VERDICTS] = {0, 0, 0};
    flight_demands(model);
    const gough_reach reach = flight_reach(model);
    for (int n = 0; n < 1500; n++) {
        const double size = pow(10, dice_between(&d, -3, -0.5));
        gough_box box;
        for (int c = 0; c < GOUGH_COMPONENTS; c++) {
            const double at = dice_between(&d, -0.25, 0.25),
                         half = size * dice_between(&d, 0, c < 3 ? 0.3 : 0.2);
            box.least[c] = at - half, box.greatest[c] = at + half;
        }
        const gough_verdict verdict = gough_box_test(&reach, &box, NULL);
        count[verdict]++;
        for (int i = 0; i < 40 && verdict == GOUGH_INSIDE; i++) {
            double pose[GOUGH_COMPONENTS];
            flight_load load;
            flight_pick(&box, i % 2, &d, pose);
            flight_draw(model, pose, i % 4 < 2, &d, &load);
            ck_assert_msg(flight_over(&reach, &load) <= 1e-10, "box %d of seed 41: %g", n,
                          flight_over(&reach, &load));
            ck_assert(flight_excess(model, &reach, pose) <= 1e-10);
        }
    }
    printf("boxes inside, outside, undecided: %d, %d, %d\n", count[0], count[1], count[2]);
    ck_assert(count[GOUGH_INSIDE] > 100 && count[GOUGH_OUTSIDE] > 100);
    free(model);
}
END_TEST

/* without velocities, the worst forces at one pose are those of the best of all corners of what is asked for */
START_TEST(worst_forces_at_a_pose_are_those_of_a_corner) {
    gough_model *model = malloc(sizeof *model);
    dice d = {42};
    flight_demands(model);
    for (int k = 0; k < 3; k++)
        model->workspace.velocity[k] = model->workspace.angular_velocity[k] = 0;
    const gough_reach reach = flight_reach(model);
    for (int n = 0; n < 5; n++) {
        gough_envelope envelope;
        gough_box one;
        double push = -INFINITY, pull = INFINITY, second = 0;
        for (int c = 0; c < GOUGH_COMPONENTS; c++)
            one.least[c] = one.greatest[c] = dice_between(&d, -0.2, 0.2);
        ck_assert(gough_workspace_envelope(&reach, &one, &envelope, NULL) == GOUGH_OK);
        for (int i = 0; i < 20000; i++) {
            flight_load load;
            flight_draw(model, one.least, true, &d, &load);
            for (int v = 0; v < GOUGH_LEGS; v++) {
                push = fmax(push, load.force[v]), pull = fmin(pull, load.force[v]);
                second = fmax(second, fabs(load.second_rate[v]));
            }
        }
        const gough_extreme *e = envelope.of;
        ck_assert_msg(fabs(e[GOUGH_WORST_PUSH].bound - push) < 1e-9 * push, "%.15g is not %.15g",
                      e[GOUGH_WORST_PUSH].bound, push);
        ck_assert_msg(fabs(e[GOUGH_WORST_PULL].bound - pull) < 1e-9 * push, "%.15g is not %.15g",
                      e[GOUGH_WORST_PULL].bound, pull);
        ck_assert_msg(fabs(e[GOUGH_WORST_ACCELERATION].bound - second) < 1e-9 * second,
                      "%.15g is not %.15g", e[GOUGH_WORST_ACCELERATION].bound, second);
        ck_assert(fabs(e[GOUGH_WORST_PUSH].sampled - push) < 1e-9 * push);
    }
    free(model);
}
END_TEST

/* the certified box of all demands, drawn from 10^5 times; worst values over it */
START_TEST(certified_box_survives_its_motions) {
    gough_model *model = malloc(sizeof *model);
    dice d = {43};
    gough_largest_box largest;
    gough_envelope envelope;
    gough_error error = {0};
    gough_box shape = {{-1, -1, -1, -0.5, -0.5, -0.5}, {1, 1, 1, 0.5, 0.5, 0.5}};
    double push = -INFINITY, pull = INFINITY, speed = 0, shortest = INFINITY, longest = 0;
    flight_demands(model);
    gough_reach reach = flight_reach(model);
    reach.most_tests = 300000;
    ck_assert_msg(gough_workspace_box(&reach, &shape, &largest, &error) == GOUGH_OK, "%s",
                  error.message);
    printf("scale %.8g, upper %.8g, %zu boxes, stopped by %s of %d\n", largest.scale, largest.upper,
           largest.tests, gough_bind_name(largest.binding.bind), largest.binding.which + 1);
    ck_assert(largest.scale > 0.02 && largest.scale >= largest.upper * (1 - 0.02));
    ck_assert_msg(gough_workspace_envelope(&reach, &largest.box, &envelope, &error) == GOUGH_OK,
                  "%s", error.message);
    for (int n = 0; n < 100000; n++) {
        double pose[GOUGH_COMPONENTS], length[GOUGH_LEGS];
        flight_load load;
        gough_state s;
        flight_pick(&largest.box, n % 2, &d, pose);
        flight_draw(model, pose, n % 4 < 2, &d, &load);
        ck_assert_msg(flight_over(&reach, &load) <= 1e-10 &&
                          flight_excess(model, &reach, pose) <= 1e-10,
                      "pose %d of seed 43", n);
        flight_state(model, pose, &s);
        gough_leg_kinematics(&model->machine, &s, NULL, length, NULL, NULL);
        for (int v = 0; v < GOUGH_LEGS; v++) {
            push = fmax(push, load.force[v]), pull = fmin(pull, load.force[v]);
            speed = fmax(speed, fabs(load.rate[v]));
            shortest = fmin(shortest, length[v]), longest = fmax(longest, length[v]);
        }
    }
    const gough_extreme *e = envelope.of;
    for (int i = 0; i < GOUGH_WORSTS; i++)
        printf("%-15s %12.7g %12.7g\n", gough_worst_name(i), e[i].bound, e[i].sampled);
    printf("drawn: push %g, pull %g, speed %g; %zu boxes\n", push, pull, speed, envelope.tests);
    ck_assert(push <= e[GOUGH_WORST_PUSH].bound && pull >= e[GOUGH_WORST_PULL].bound);
    ck_assert(speed <= e[GOUGH_WORST_SPEED].bound && longest <= e[GOUGH_WORST_LONGEST].bound);
    ck_assert(shortest >= e[GOUGH_WORST_SHORTEST].bound);
    ck_assert(e[GOUGH_WORST_PUSH].bound <= 1.02 * e[GOUGH_WORST_PUSH].sampled);
    ck_assert(e[GOUGH_WORST_LONGEST].bound <= 1.0002 * longest);
    free(model);
}
END_TEST

/* a distance of legs that is certified is kept by points of both */
START_TEST(clearance_is_that_of_points_of_the_legs) {
    gough_model *model = malloc(sizeof *model);
    dice d = {44};
    flight_demands(model);
    memset(&model->workspace, 0, sizeof model->workspace);
    gough_reach reach = flight_reach(model);
    reach.most_tests = 100000;
    for (int n = 0; n < 6; n++) {
        gough_envelope envelope;
        gough_box box;
        double least = INFINITY, nearest = INFINITY;
        for (int c = 0; c < GOUGH_COMPONENTS; c++) {
            const double at = dice_between(&d, -0.2, 0.2);
            box.least[c] = at - 0.02, box.greatest[c] = at + 0.02;
        }
        ck_assert(gough_workspace_envelope(&reach, &box, &envelope, NULL) == GOUGH_OK);
        const gough_extreme *e = &envelope.of[GOUGH_WORST_CLEARANCE];
        for (int i = 0; i < 12; i++) {
            double pose[GOUGH_COMPONENTS];
            flight_pick(&box, true, &d, pose);
            for (int v = 0; v < GOUGH_LEGS; v++) {
                least = fmin(least, flight_distance(model, pose, v, (v + 1) % GOUGH_LEGS) - 0.2);
                if (i > 0) continue;
                nearest =
                    fmin(nearest, flight_distance(model, e->pose, v, (v + 1) % GOUGH_LEGS) - 0.2);
            }
        }
        ck_assert_msg(least >= e->bound && fabs(nearest - e->sampled) < 1e-3,
                      "%g and %g, %g and %g", least, e->bound, nearest, e->sampled);
        ck_assert(e->sampled - e->bound < 0.2 * e->sampled + 0.003);
    }
    free(model);
}
END_TEST

/* the share of positions in a box that are allowed, by 200 000 draws, times its volume; and the bounds */
START_TEST(volume_is_that_of_positions_drawn) {
    gough_model *model = malloc(sizeof *model);
    dice d = {45};
    flight_machine(model);
    for (int which = 0; which < 2; which++) {
        const double orientation[3] = {0.1, -0.05, which * 0.2};
        gough_reach reach = flight_reach(model);
        gough_volume volume;
        enum { DRAWS = 200000 };
        int in = 0;
        if (which == 0)
            for (int v = 0; v < GOUGH_LEGS; v++)
                reach.limits.base_swing[v] = reach.limits.top_swing[v] = INFINITY;
        ck_assert(gough_workspace_volume(&reach, orientation, &volume, NULL) == GOUGH_OK);
        for (int n = 0; n < DRAWS; n++) {
            double pose[GOUGH_COMPONENTS];
            for (int k = 0; k < 3; k++) pose[k] = dice_between(&d, -2.5, 2.5);
            memcpy(pose + 3, orientation, sizeof orientation);
            in += flight_excess(model, &reach, pose) <= 0;
        }
        const double part = (double)in / DRAWS, drawn = 125 * part,
                     deviation = 125 * sqrt(part * (1 - part) / DRAWS);
        printf("volume %.7g in %.5g to %.5g; drawn %.5g ± %.2g\n", volume.value, volume.least,
               volume.greatest, drawn, deviation);
        ck_assert(volume.exact == (which == 0));
        ck_assert(volume.least < volume.value && volume.value < volume.greatest);
        ck_assert(volume.greatest - volume.least <= 0.2 * volume.greatest);
        ck_assert(fabs(volume.value - drawn) < 4 * deviation + (which ? 0.02 * drawn : 0));
    }
    free(model);
}
END_TEST

int main(void) {
    return SUITE_RUN("demands", 120, motions_of_tested_boxes_keep_the_limits,
                     worst_forces_at_a_pose_are_those_of_a_corner,
                     certified_box_survives_its_motions, clearance_is_that_of_points_of_the_legs,
                     volume_is_that_of_positions_drawn);
}
