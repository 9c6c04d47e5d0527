/* Following a pose to leg lengths: it comes back from lengths of random poses, each number of its certificate is true, and it
 * refuses where a singular pose lies on the way. Other roads: lengths by vectors, Newton's method in rotation and position. */
#include <stdio.h>

#include "pose/pose_machines.h"
#include "support/suite.h"

enum { MANY = 2000, STEPS = 1000 };

/* poses of a machine about home, where no singular pose is near, are those of their lengths, within the errors that are promised
 * and a few roundings of the lengths themselves */
START_TEST(poses_come_back_from_their_lengths) {
    dice d = {21};
    double worst = 0, bound = 0;
    for (int n = 0; n < MANY; n++) {
        gough_machine machine;
        gough_pose_certificate c;
        gough_error error = {0};
        double length[GOUGH_LEGS];
        family_machine(FAMILY_RINGS, &d, &machine);
        const gough_state there = random_pose(&machine, 0.12, 0.2, &d);
        gough_state pose = gough_state_home(&machine);
        lengths_by_vectors(&machine, &there, length);
        ck_assert_msg(gough_pose_from_lengths(&machine, length, STEPS, &pose, &c, &error) ==
                          GOUGH_OK,
                      "machine %d of seed 21: %s", n, error.message);
        ck_assert(c.reached == 1 && c.steps >= 1);
        const double position = pose_distance(&pose, &there);
        const double angle = pose_angle(&pose, &there);
        double condition;
        gough_conditioning(&machine, &there, &condition, NULL);
        ck_assert(position <= c.position_error + 1e-15 * condition);
        ck_assert(angle <= c.angle_error + 1e-15 * condition);
        worst = fmax(worst, fmax(position, angle) / condition);
        bound = fmax(bound, fmax(c.position_error, c.angle_error) / condition);
        ck_assert(c.unique_position > 0 && c.unique_angle > 0);
    }
    printf("error over condition: %.1e; largest bound over it %.1e\n", worst, bound);
    ck_assert_msg(worst < 2e-15 && bound < 5e-12, "%g and %g", worst, bound);
}
END_TEST

/* a way there in one call is the way in a hundred small changes, which no jump could follow */
START_TEST(one_call_is_many_small_ones) {
    dice d = {22};
    for (int n = 0; n < 60; n++) {
        gough_machine machine;
        double to[GOUGH_LEGS], length[GOUGH_LEGS];
        family_machine((family)(n % FAMILIES), &d, &machine);
        const gough_state there = random_pose(&machine, 0.3, 0.6, &d);
        gough_state once = gough_state_home(&machine), often = once;
        lengths_by_vectors(&machine, &there, to);
        const gough_status status = gough_pose_from_lengths(&machine, to, STEPS, &once, NULL, NULL);
        gough_status small = GOUGH_OK;
        for (int i = 1; i <= 400 && small == GOUGH_OK; i++) {
            for (int v = 0; v < GOUGH_LEGS; v++) {
                const double home = machine.home_length[v], part = i / 400.0;
                length[v] = sqrt(home * home + part * (to[v] * to[v] - home * home));
            }
            small = newton_by_vectors(&machine, length, &often) ? GOUGH_OK : GOUGH_ERROR_NUMERICAL;
        }
        if (status) continue;
        ck_assert(small == GOUGH_OK);
        ck_assert_msg(pose_difference(&once, &often) < 1e-9, "machine %d", n);
    }
}
END_TEST

/* whatever way the certificate allows keeps the sign of the determinant, and the pose has the lengths asked for */
START_TEST(a_certified_way_never_crosses_a_singular_pose) {
    dice d = {23};
    int refused = 0, other = 0;
    for (int n = 0; n < MANY; n++) {
        gough_machine machine;
        gough_pose_certificate c;
        double length[GOUGH_LEGS], back[GOUGH_LEGS], home, det, there_det;
        family_machine((family)(n % FAMILIES), &d, &machine);
        const gough_state there = random_pose(&machine, 0.4, 0.9, &d);
        gough_state pose = gough_state_home(&machine);
        lengths_by_vectors(&machine, &there, length);
        gough_conditioning(&machine, &pose, NULL, &home);
        gough_conditioning(&machine, &there, NULL, &there_det);
        const gough_status status =
            gough_pose_from_lengths(&machine, length, STEPS, &pose, &c, NULL);
        gough_conditioning(&machine, &pose, NULL, &det);
        ck_assert(det * home > 0);
        if (status == GOUGH_ERROR_NUMERICAL) {
            ck_assert(c.reached < 1);
            refused++;
            continue;
        }
        ck_assert(status == GOUGH_OK);
        lengths_by_vectors(&machine, &pose, back);
        for (int v = 0; v < GOUGH_LEGS; v++) ck_assert(fabs(back[v] - length[v]) < 1e-12);
        if (there_det * home < 0) {
            other++;
            ck_assert(pose_difference(&pose, &there) > 1e-6);
        }
    }
    printf("%d of %d refused; %d poses lie behind singular ones, and others were found\n", refused,
           MANY, other);
    ck_assert(refused > 0 && refused < MANY / 2 && other > 0);
}
END_TEST

/* no other pose is found by Newton's method from places within what is said to be unique */
START_TEST(a_pose_is_alone_where_the_certificate_says) {
    dice d = {24};
    for (int n = 0; n < 100; n++) {
        gough_machine machine;
        gough_pose_certificate c;
        double length[GOUGH_LEGS];
        family_machine((family)(n % FAMILIES), &d, &machine);
        const gough_state there = random_pose(&machine, 0.05, 0.1, &d);
        gough_state pose = gough_state_home(&machine);
        lengths_by_vectors(&machine, &there, length);
        if (gough_pose_from_lengths(&machine, length, STEPS, &pose, &c, NULL)) continue;
        for (int i = 0; i < 20; i++) {
            gough_state near = pose;
            double turn[3], R[3][3];
            for (int k = 0; k < 3; k++) {
                near.position[k] += c.unique_position * dice_between(&d, -0.5, 0.5);
                turn[k] = c.unique_angle * dice_between(&d, -0.3, 0.3);
            }
            gough_rotation_from_angles(turn, R);
            for (int r = 0; r < 3; r++)
                for (int k = 0; k < 3; k++) {
                    near.rotation[r][k] = 0;
                    for (int m = 0; m < 3; m++)
                        near.rotation[r][k] += R[r][m] * pose.rotation[m][k];
                }
            if (!newton_by_vectors(&machine, length, &near)) continue;
            const bool same = pose_difference(&pose, &near) < 1e-9;
            ck_assert(same || pose_distance(&near, &pose) > c.unique_position ||
                      pose_angle(&near, &pose) > c.unique_angle);
        }
    }
}
END_TEST

/* level symmetric rings are singular where they are turned by 90°, whatever their height */
static void turned(const gough_machine *machine, double yaw, gough_state *state) {
    const double angles[3] = {0, 0, yaw};
    *state = gough_state_home(machine);
    gough_rotation_from_angles(angles, state->rotation);
}

/* how far in yaw a record goes that turns by a constant speed within 2 units of time; the end if nothing is refused */
static double reached_yaw(const gough_machine *machine, double end, int rows, bool tubes) {
    gough_state pose = gough_state_home(machine), true_pose;
    double widest = 0, before[2][GOUGH_LEGS], length[GOUGH_LEGS], tube[GOUGH_LEGS];
    for (int i = 0; i <= rows; i++) {
        turned(machine, end * i / rows, &true_pose);
        lengths_by_vectors(machine, &true_pose, length);
        for (int v = 0; v < GOUGH_LEGS; v++) {
            if (i > 1) widest = fmax(widest, fabs(length[v] - 2 * before[0][v] + before[1][v]));
            before[1][v] = before[0][v], before[0][v] = length[v];
        }
    }
    for (int v = 0; v < GOUGH_LEGS; v++) tube[v] = tubes ? 2 * widest / 8 : 0;
    for (int i = 1; i <= rows; i++) {
        turned(machine, end * i / rows, &true_pose);
        lengths_by_vectors(machine, &true_pose, length);
        if (gough_pose_tube(machine, length, tube, 100, &pose, NULL, NULL))
            return end * (i - 1) / rows;
        if (tubes) ck_assert(pose_difference(&pose, &true_pose) < 1e-9);
    }
    return end;
}

/* With tubes a record through 90° is refused before it, and one to 85° never. Without them lengths that turn round between two
 * samples are not noticed, which this test shows: it is what tubes are for. */
START_TEST(records_are_refused_before_a_singular_pose) {
    const double degree = pi / 180;
    dice d = {25};
    int unnoticed = 0;
    for (int n = 0; n < 8; n++) {
        gough_machine machine;
        gough_state right;
        double condition;
        family_machine(FAMILY_RINGS, &d, &machine);
        turned(&machine, 90 * degree, &right);
        gough_conditioning(&machine, &right, &condition, NULL);
        ck_assert(condition > 1e12);
        for (int rate = 200; rate <= 2000; rate *= 10) {
            ck_assert(reached_yaw(&machine, 85 * degree, rate, true) >= 85 * degree);
            for (int end = 91; end <= 95; end += 2) {
                const double yaw = reached_yaw(&machine, end * degree, rate, true);
                ck_assert(yaw < 90 * degree && yaw > (rate == 200 ? 87 : 89) * degree);
                unnoticed += reached_yaw(&machine, end * degree, rate, false) >= end * degree;
            }
        }
    }
    printf("without tubes, %d of 48 records pass the singular pose\n", unnoticed);
    ck_assert(unnoticed > 0);
}
END_TEST

/* the straight line of squares to a pose behind a singular one ends there: where it is lost, least singular values are small */
START_TEST(a_way_is_lost_at_a_singular_pose) {
    dice d = {26};
    gough_machine machine;
    gough_state pose, behind;
    gough_pose_certificate c;
    gough_error error = {0};
    double length[GOUGH_LEGS], condition;
    family_machine(FAMILY_RINGS, &d, &machine);
    pose = gough_state_home(&machine);
    turned(&machine, pi / 2, &behind);
    lengths_by_vectors(&machine, &behind, length);
    ck_assert(gough_pose_from_lengths(&machine, length, STEPS, &pose, &c, &error) ==
              GOUGH_ERROR_NUMERICAL);
    ck_assert(strstr(error.message, "singular pose") != NULL);
    ck_assert(c.reached > 0.999 && c.reached < 1);
    gough_conditioning(&machine, &pose, &condition, NULL);
    ck_assert(condition > 1e3);
    /* from the pose behind there is no step at all */
    ck_assert(gough_pose_from_lengths(&machine, length, STEPS, &behind, &c, &error) ==
              GOUGH_ERROR_NUMERICAL);
    ck_assert(c.steps == 0 && c.reached == 0);
}
END_TEST

START_TEST(a_limit_of_steps_is_kept) {
    dice d = {27};
    gough_machine machine;
    gough_pose_certificate c;
    gough_error error = {0};
    double length[GOUGH_LEGS];
    family_machine(FAMILY_RINGS, &d, &machine);
    const gough_state there = random_pose(&machine, 0.2, 0.3, &d);
    lengths_by_vectors(&machine, &there, length);
    gough_state pose = gough_state_home(&machine), whole = pose;
    ck_assert(gough_pose_from_lengths(&machine, length, 1, &pose, &c, &error) ==
              GOUGH_ERROR_NUMERICAL);
    ck_assert(c.steps == 1 && c.reached > 0 && c.reached < 1 && c.margin < 0);
    ck_assert(strstr(error.message, "1 certified steps reach only") != NULL);
    /* from where it came it goes on to the same pose */
    for (int n = 0; n < 50 && c.reached < 1; n++)
        gough_pose_from_lengths(&machine, length, 1, &pose, &c, NULL);
    ck_assert(gough_pose_from_lengths(&machine, length, STEPS, &whole, NULL, NULL) == GOUGH_OK);
    ck_assert(pose_difference(&pose, &whole) < 1e-12);
}
END_TEST

/* the largest change in one step is where the margin says, for a straight line of lengths of which parts are tried */
START_TEST(the_margin_is_that_of_one_step) {
    dice d = {28};
    for (int n = 0; n < 50; n++) {
        gough_machine machine;
        gough_pose_certificate c;
        double length[GOUGH_LEGS], at[GOUGH_LEGS];
        family_machine(FAMILY_RINGS, &d, &machine);
        const gough_state there = random_pose(&machine, 0.1, 0.1, &d);
        gough_state pose = gough_state_home(&machine);
        lengths_by_vectors(&machine, &there, length);
        if (gough_pose_from_lengths(&machine, length, STEPS, &pose, &c, NULL)) continue;
        const double limit = 1 / (1 - c.margin); /* part of the squares with a margin of 0 */
        for (int side = 0; side < 2; side++) {
            const double part = limit * (side ? 1.001 : 0.97);
            pose = gough_state_home(&machine);
            for (int v = 0; v < GOUGH_LEGS; v++) {
                const double home = machine.home_length[v];
                at[v] = sqrt(home * home + part * (length[v] * length[v] - home * home));
            }
            gough_pose_from_lengths(&machine, at, 1, &pose, &c, NULL);
            ck_assert_msg((c.reached < 1) == side, "machine %d, side %d, margin %g", n, side,
                          c.margin);
        }
    }
}
END_TEST

/* single precision gives the pose of double within its own bounds */
START_TEST(single_precision_is_within_its_bounds) {
    dice d = {29};
    double worst = 0, bound = 0;
    for (int n = 0; n < 500; n++) {
        gough_machine machine;
        gough_pose_certificate c;
        gough_error error = {0};
        double length[GOUGH_LEGS];
        float lengths[GOUGH_LEGS];
        family_machine(FAMILY_RINGS, &d, &machine);
        const gough_state there = random_pose(&machine, 0.1, 0.2, &d);
        gough_state pose = gough_state_home(&machine);
        gough_pose_single single = {{0, 0, 1.2F}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
        lengths_by_vectors(&machine, &there, length);
        for (int v = 0; v < GOUGH_LEGS; v++) {
            lengths[v] = (float)length[v];
            length[v] = (double)lengths[v]; /* both follow to what float can say */
        }
        ck_assert(gough_pose_from_lengths(&machine, length, STEPS, &pose, NULL, NULL) == GOUGH_OK);
        ck_assert_msg(gough_pose_from_lengths_single(&machine, lengths, STEPS, &single, &c,
                                                     &error) == GOUGH_OK,
                      "machine %d: %s", n, error.message);
        gough_state found = {.velocity = {0}};
        double condition;
        for (int r = 0; r < 3; r++) {
            found.position[r] = (double)single.position[r];
            for (int k = 0; k < 3; k++) found.rotation[r][k] = (double)single.rotation[r][k];
        }
        ck_assert(pose_distance(&found, &pose) <= c.position_error + 1e-7);
        ck_assert(pose_angle(&found, &pose) <= c.angle_error + 1e-7);
        gough_conditioning(&machine, &pose, &condition, NULL);
        worst = fmax(worst, pose_difference(&found, &pose) / condition);
        bound = fmax(bound, c.position_error / condition);
    }
    printf("single precision, over condition: error %.1e, largest bound %.1e\n", worst, bound);
    ck_assert_msg(worst < 1e-6 && bound < 3e-3, "%g and %g", worst, bound);
}
END_TEST

START_TEST(rejects_what_is_no_length_or_no_rotation) {
    dice d = {30};
    gough_machine machine;
    family_machine(FAMILY_RINGS, &d, &machine);
    const double bad[] = {0, -1, NAN, INFINITY};
    double length[GOUGH_LEGS], tube[GOUGH_LEGS] = {0};
    float lengths[GOUGH_LEGS] = {1, 1, 1, 1, 1, 1};
    gough_state pose = gough_state_home(&machine), before = pose;
    gough_pose_single single = {{0, 0, 1}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    gough_error error;
    for (int n = 0; n < 4; n++) {
        memcpy(length, machine.home_length, sizeof length);
        length[3] = bad[n];
        ck_assert(gough_pose_from_lengths(&machine, length, 1, &pose, NULL, &error) ==
                  GOUGH_ERROR_INPUT);
        ck_assert(strstr(error.message, "leg 4") != NULL);
        lengths[2] = (float)bad[n];
        ck_assert(gough_pose_from_lengths_single(&machine, lengths, 1, &single, NULL, NULL) ==
                  GOUGH_ERROR_INPUT);
        memcpy(length, machine.home_length, sizeof length);
        tube[1] = n == 0 ? -1e-9 : bad[n];
        ck_assert(gough_pose_tube(&machine, length, tube, 1, &pose, NULL, &error) ==
                  GOUGH_ERROR_INPUT);
        ck_assert(strstr(error.message, "tube of leg 2") != NULL);
    }
    ck_assert(gough_pose_from_lengths(&machine, length, 0, &pose, NULL, &error) ==
              GOUGH_ERROR_INPUT);
    ck_assert(memcmp(&pose, &before, sizeof pose) == 0);
    pose.rotation[0][0] = 1.01;
    ck_assert(gough_pose_from_lengths(&machine, length, 1, &pose, NULL, &error) ==
              GOUGH_ERROR_INPUT);
    ck_assert(strstr(error.message, "not a rotation") != NULL);
}
END_TEST

int main(void) {
    return SUITE_RUN(
        "follow", 60, poses_come_back_from_their_lengths, one_call_is_many_small_ones,
        a_certified_way_never_crosses_a_singular_pose, a_pose_is_alone_where_the_certificate_says,
        records_are_refused_before_a_singular_pose, a_way_is_lost_at_a_singular_pose,
        a_limit_of_steps_is_kept, the_margin_is_that_of_one_step,
        single_precision_is_within_its_bounds, rejects_what_is_no_length_or_no_rotation);
}
