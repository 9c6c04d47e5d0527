/* Very many machines and very many warm starts: counts of general machines, and no departure from the certified way.
 * Label: campaign: it takes some minutes. The numbers of machines and of solves can be raised by POSE_CAMPAIGN, a factor.
 * Not sanitized: the other tests of poses run the same functions under sanitizers. */
#include <stdio.h>

#include "pose/pose_machines.h"
#include "support/suite.h"

enum { MACHINES = 20000, SOLVES = 2000000 };

static int times(int count) {
    const char *factor = getenv("POSE_CAMPAIGN");
    return count * (factor ? atoi(factor) : 1);
}

/* of general machines 40 roots are certified in 99.99 %, and the others are said not to be proved; each count is even and signs of
 * the determinants add up to 0 */
START_TEST(general_machines_have_forty_poses) {
    static gough_pose pose[GOUGH_POSES];
    const int machines = times(MACHINES);
    dice d = {61};
    int proved = 0, again = 0;
    for (int n = 0; n < machines; n++) {
        gough_machine machine;
        gough_poses found;
        double length[GOUGH_LEGS];
        int sum = 0;
        family_machine(FAMILY_GENERAL, &d, &machine);
        const gough_state at = random_pose(&machine, 0.4, 0.8, &d);
        lengths_by_vectors(&machine, &at, length);
        ck_assert(gough_poses_all(&machine, length, pose, &found, NULL) == GOUGH_OK);
        again += found.mixings > 1;
        if (found.complete != GOUGH_COMPLETE_PROVED) continue;
        proved++;
        double nearest = 1;
        for (int i = 0; i < found.real; i++) {
            const gough_state there = state_of(&pose[i]);
            nearest = fmin(nearest, pose_difference(&at, &there));
            sum += pose[i].determinant > 0 ? 1 : -1;
        }
        ck_assert_msg(nearest < 1e-8, "machine %d of seed 61: proved, but its pose is missing", n);
        ck_assert(found.real + found.nonreal == 40 && found.real % 2 == 0 && sum == 0);
    }
    printf("%d of %d proved; %d followed by several mixings\n", proved, machines, again);
    ck_assert((machines - proved) * 10000LL <= machines);
}
END_TEST

/* from one pose to another near it: what is certified is that other one, or that one lies outside what is unique */
START_TEST(warm_starts_do_not_depart) {
    const int solves = times(SOLVES);
    dice d = {62};
    int refused = 0, elsewhere = 0;
    gough_machine machine;
    for (int n = 0; n < solves; n++) {
        gough_pose_certificate c;
        double length[GOUGH_LEGS], turn[3], R[3][3];
        if (n % 1000 == 0) family_machine((family)(n / 1000 % FAMILIES), &d, &machine);
        gough_state pose = random_pose(&machine, 0.5, 1, &d), there = pose;
        const double size = n % 2 ? 0.01 : 0.05;
        for (int k = 0; k < 3; k++) {
            there.position[k] += dice_between(&d, -size, size);
            turn[k] = dice_between(&d, -size, size);
        }
        gough_rotation_from_angles(turn, R);
        for (int r = 0; r < 3; r++)
            for (int k = 0; k < 3; k++) {
                there.rotation[r][k] = 0;
                for (int m = 0; m < 3; m++) there.rotation[r][k] += R[r][m] * pose.rotation[m][k];
            }
        gough_leg_kinematics(&machine, &there, NULL, length, NULL, NULL);
        const gough_status status = gough_pose_from_lengths(&machine, length, 200, &pose, &c, NULL);
        refused += status != GOUGH_OK;
        if (status) continue;
        const double apart = pose_distance(&pose, &there), angle = pose_angle(&pose, &there);
        /* lengths have roundings too, and the condition multiplies them */
        if (apart < 1e-9 && angle < 1e-9) continue;
        elsewhere++;
        ck_assert_msg(apart > c.unique_position || angle > c.unique_angle ||
                          (apart < 1e-5 && angle < 1e-5),
                      "solve %d of seed 62: %g and %g away", n, apart, angle);
    }
    printf("%d of %d refused; %d end at another pose than the one behind\n", refused, solves,
           elsewhere);
    ck_assert(refused < solves / 50 && elsewhere < solves / 50);
}
END_TEST

int main(void) {
    return SUITE_RUN("many", 1500, general_machines_have_forty_poses, warm_starts_do_not_depart);
}
