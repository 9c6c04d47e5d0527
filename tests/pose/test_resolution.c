/* How errors of lengths move the pose: against poses found again from wrong lengths, and from machines whose joints are not where
 * they are said to be. Another road: Newton's method in rotation and position, lengths by vectors. */
#include <stdio.h>
#include <string.h>

#include "pose/pose_machines.h"
#include "support/suite.h"

enum { MACHINES = 300, ERRORS = 40 };
static const double SMALL = 1e-6;

static void random_point(dice *d, double point[3]) {
    for (int i = 0; i < 3; i++) point[i] = dice_between(d, -1, 1);
}

static void point_of(const gough_state *state, const double point[3], double out[3]) {
    for (int r = 0; r < 3; r++) {
        out[r] = state->position[r];
        for (int k = 0; k < 3; k++) out[r] += state->rotation[r][k] * point[k];
    }
}

/* displacement of the point, and the vector of the small rotation, from a to b */
static void moved(const gough_state *a, const gough_state *b, const double point[3], double by[6]) {
    double from[3], to[3], turn[3][3];

    point_of(a, point, from);
    point_of(b, point, to);
    for (int i = 0; i < 3; i++) {
        by[i] = to[i] - from[i];
        for (int j = 0; j < 3; j++) {
            turn[i][j] = 0;
            for (int k = 0; k < 3; k++) turn[i][j] += b->rotation[i][k] * a->rotation[j][k];
        }
    }
    for (int i = 0; i < 3; i++)
        by[3 + i] = (turn[(i + 2) % 3][(i + 1) % 3] - turn[(i + 1) % 3][(i + 2) % 3]) / 2;
}

static double size_of(const double v[3]) { return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/* the pose of lengths that are off by so much */
static void found_with(const gough_machine *machine, const gough_state *there,
                       const double off[GOUGH_LEGS], const double point[3], double by[6]) {
    double length[GOUGH_LEGS];
    gough_state pose = *there;

    lengths_by_vectors(machine, there, length);
    for (int v = 0; v < GOUGH_LEGS; v++) length[v] += off[v];
    ck_assert(newton_by_vectors(machine, length, &pose));
    moved(there, &pose, point, by);
}

/* a machine and a pose far enough from singular ones */
static gough_state any_pose(dice *d, int n, gough_machine *machine) {
    gough_state there;
    double condition;

    do {
        family_machine((family)(n % FAMILIES), d, machine);
        there = random_pose(machine, 0.2, 0.3, d);
        gough_conditioning(machine, &there, &condition, NULL);
    } while (!(condition < 100));
    return there;
}

static gough_resolution resolution_at(const gough_machine *machine, const gough_state *there,
                                      const double point[3], const double off[GOUGH_LEGS]) {
    gough_resolution r;
    gough_error error = {0};

    ck_assert_msg(gough_pose_resolution(machine, there, point, off, &r, &error) == GOUGH_OK, "%s",
                  error.message);
    return r;
}

/* what is of second order, and rounding of Newton's method */
static double slack_of(const gough_resolution *r) {
    const double first = r->position + r->angle + SMALL * r->condition;

    return r->condition * (first * first + 1e-14);
}

/* the map's columns are what a small change of one length makes; no errors within the bounds make more than the worst; those that
 * are named make it, in the direction named */
START_TEST(poses_of_wrong_lengths_are_where_it_says) {
    dice d = {61};
    double near = 0;

    for (int n = 0; n < MACHINES; n++) {
        gough_machine machine;
        double point[3], by[6], off[GOUGH_LEGS] = {0}, each[GOUGH_LEGS];
        const gough_state there = any_pose(&d, n, &machine);
        random_point(&d, point);
        for (int v = 0; v < GOUGH_LEGS; v++) each[v] = SMALL * dice_between(&d, 0, 1);
        const gough_resolution r = resolution_at(&machine, &there, point, each);
        const double slack = slack_of(&r);
        for (int v = 0; v < GOUGH_LEGS; v++) {
            off[v] = SMALL;
            found_with(&machine, &there, off, point, by);
            off[v] = 0;
            for (int i = 0; i < 6; i++) ck_assert(fabs(by[i] - r.map[i][v] * SMALL) < slack);
        }
        for (int k = 0; k < ERRORS; k++) {
            for (int v = 0; v < GOUGH_LEGS; v++) off[v] = each[v] * dice_between(&d, -1, 1);
            if (k % 2) /* at a corner */
                for (int v = 0; v < GOUGH_LEGS; v++) off[v] = off[v] > 0 ? each[v] : -each[v];
            found_with(&machine, &there, off, point, by);
            for (int i = 0; i < 6; i++) ck_assert(fabs(by[i]) < r.component[i] + slack);
            ck_assert(size_of(by) < r.position + slack && size_of(by + 3) < r.angle + slack);
            near = fmax(near, size_of(by) / r.position);
        }
        found_with(&machine, &there, r.position_lengths, point, by);
        for (int i = 0; i < 3; i++) ck_assert(fabs(by[i] - r.position * r.direction[i]) < slack);
        found_with(&machine, &there, r.angle_lengths, point, by);
        for (int i = 0; i < 3; i++) ck_assert(fabs(by[3 + i] - r.angle * r.axis[i]) < slack);
        for (int v = 0; v < GOUGH_LEGS; v++) {
            ck_assert(fabs(fabs(r.position_lengths[v]) - each[v]) < 1e-20);
            ck_assert(fabs(fabs(r.angle_lengths[v]) - each[v]) < 1e-20);
        }
    }
    printf("errors drawn at random reach %.3g of the worst\n", near);
    ck_assert(near > 0.99 && near < 1 + 1e-4);
}
END_TEST

/* joints that are off by up to ε in any direction, found again as if they were where they are said to be */
START_TEST(joints_out_of_place_are_errors_of_lengths) {
    dice d = {62};
    double near = 0;

    for (int n = 0; n < MACHINES; n++) {
        gough_machine machine;
        double point[3], by[6], off[GOUGH_LEGS];
        const gough_state there = any_pose(&d, n, &machine);
        random_point(&d, point);
        for (int v = 0; v < GOUGH_LEGS; v++) off[v] = 2 * SMALL;
        const gough_resolution r = resolution_at(&machine, &there, point, off);
        for (int k = 0; k < ERRORS; k++) {
            gough_machine built = machine;
            double length[GOUGH_LEGS];
            for (int v = 0; v < GOUGH_LEGS; v++) {
                /* along the leg, outwards or inwards at random, or anywhere */
                double leg[3], at[3], random[2][3];
                point_of(&there, machine.platform.top[v], at);
                for (int i = 0; i < 3; i++) leg[i] = at[i] - machine.platform.base[v][i];
                const double sign = k % 2 && dice_between(&d, -1, 1) < 0 ? -1 : 1;
                random_point(&d, random[0]);
                random_point(&d, random[1]);
                for (int i = 0; i < 3; i++) {
                    double top = 0;
                    for (int j = 0; j < 3; j++)
                        top += there.rotation[j][i] * sign * leg[j] / size_of(leg);
                    built.platform.base[v][i] +=
                        SMALL * (k < ERRORS / 2 ? -sign * leg[i] / size_of(leg)
                                                : random[0][i] / size_of(random[0]));
                    built.platform.top[v][i] +=
                        SMALL * (k < ERRORS / 2 ? top : random[1][i] / size_of(random[1]));
                }
            }
            gough_state pose = there;
            lengths_by_vectors(&built, &there, length);
            ck_assert(newton_by_vectors(&machine, length, &pose));
            moved(&there, &pose, point, by);
            const double slack = slack_of(&r);
            ck_assert_msg(size_of(by) < r.position + slack && size_of(by + 3) < r.angle + slack,
                          "machine %d, error %d: %g of %g, %g of %g", n, k, size_of(by), r.position,
                          size_of(by + 3), r.angle);
            near = fmax(near, size_of(by) / r.position);
        }
    }
    printf("joints out of place reach %.3g of the worst\n", near);
    ck_assert(near > 0.95);
}
END_TEST

START_TEST(what_cannot_be_answered_is_refused) {
    const double point[3] = {0, 0, 0};
    double off[GOUGH_LEGS] = {1, 1, 1, 1, 1, 1};
    gough_machine machine;
    gough_resolution r;
    gough_error error = {0};
    dice d = {63};

    family_machine(FAMILY_RINGS, &d, &machine);
    gough_state state = gough_state_home(&machine);
    off[2] = -1;
    ck_assert(gough_pose_resolution(&machine, &state, point, off, &r, &error) == GOUGH_ERROR_INPUT);
    ck_assert(strstr(error.message, "leg 3") != NULL);
    off[2] = 0;
    ck_assert(gough_pose_resolution(&machine, &state, point, off, &r, NULL) == GOUGH_OK);
    const double nowhere[3] = {0, NAN, 0};
    ck_assert(gough_pose_resolution(&machine, &state, nowhere, off, &r, &error) ==
              GOUGH_ERROR_INPUT);
    /* half a turn less a quarter: the pose of rings turned by 90 degrees is singular */
    gough_platform p = gough_platform_symmetric(1, 0.3, 0.6, 0.3, 1.2);
    const gough_load load = {.mass = 1, .inertia = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    const double gravity[3] = {0, 0, -1};
    ck_assert(gough_machine_init(&machine, &p, &load, gravity, &error) == GOUGH_OK);
    const double turn[3][3] = {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}};
    state = gough_state_home(&machine);
    memcpy(state.rotation, turn, sizeof turn);
    ck_assert(gough_pose_resolution(&machine, &state, point, off, &r, &error) ==
              GOUGH_ERROR_NUMERICAL);
    ck_assert(strstr(error.message, "singular") != NULL);
    state.rotation[0][0] = 0.3;
    ck_assert(gough_pose_resolution(&machine, &state, point, off, &r, &error) == GOUGH_ERROR_INPUT);
    for (int v = 0; v < GOUGH_LEGS; v++) off[v] = 0;
    state = gough_state_home(&machine);
    ck_assert(gough_pose_resolution(&machine, &state, point, off, &r, NULL) == GOUGH_OK);
    ck_assert(!(r.position > 0) && !(size_of(r.direction) > 0) && !(r.angle > 0));
}
END_TEST

int main(void) {
    return SUITE_RUN("resolution", 60, poses_of_wrong_lengths_are_where_it_says,
                     joints_out_of_place_are_errors_of_lengths, what_cannot_be_answered_is_refused);
}
