/* All poses of six lengths: counts of all families, Dietmaier's forty, what must hold whatever the machine, and an independent
 * road: Newton's method in rotation and position from many places. */
#include <stdio.h>

#define NUMBER_DOUBLE
#define SCALAR_COMPLEX
#define ROWS_COMPLEX
#include "pose/pose_machines.h"
#include "pose/soma.h"
#include "pose/start_system.h"
#include "support/lanes.h"
#include "support/suite.h"

static gough_pose pose[GOUGH_POSES];

static gough_poses all_of(const gough_machine *machine, const double length[GOUGH_LEGS]) {
    gough_poses found;
    const gough_status status = gough_poses_all(machine, length, pose, &found, NULL);
    ck_assert(status == (found.real ? GOUGH_OK : GOUGH_ERROR_NUMERICAL));
    ck_assert(found.real + found.nonreal + found.infinite + found.singular == GOUGH_POSES);
    return found;
}

/* each pose has the lengths; signs of the determinants add up to 0; poses come in order, each once */
static void check_poses(const gough_machine *machine, const double length[GOUGH_LEGS],
                        const gough_poses *found) {
    int sum = 0;
    for (int i = 0; i < found->real; i++) {
        const gough_state at = state_of(&pose[i]);
        double back[GOUGH_LEGS], determinant, condition;
        lengths_by_vectors(machine, &at, back);
        for (int v = 0; v < GOUGH_LEGS; v++) ck_assert(fabs(back[v] - length[v]) < 5e-15 * 2);
        gough_conditioning(machine, &at, &condition, &determinant);
        ck_assert(condition <= pose[i].condition && condition >= pose[i].condition);
        ck_assert(determinant <= pose[i].determinant && determinant >= pose[i].determinant);
        ck_assert(pose[i].position_error < 1e-12 && pose[i].angle_error < 1e-12);
        sum += determinant > 0 ? 1 : -1;
        for (int j = 0; j < i; j++) {
            const gough_state other = state_of(&pose[j]);
            ck_assert(pose_distance(&at, &other) > pose[i].unique_position ||
                      pose_angle(&at, &other) > pose[i].unique_angle);
        }
    }
    ck_assert_int_eq(sum, 0);
    ck_assert_int_eq(found->nonreal % 2, 0);
}

START_TEST(counts_are_those_of_the_family) {
    static const int finite[FAMILIES] = {
        [FAMILY_GENERAL] = 40,     [FAMILY_PLANE_BASE] = 40, [FAMILY_PLANE_BOTH] = 40,
        [FAMILY_SIX_FIVE] = 40,    [FAMILY_SIX_FOUR] = 32,   [FAMILY_SIX_THREE] = 16,
        [FAMILY_THREE_THREE] = 16, [FAMILY_RINGS] = 28};
    dice d = {41};
    for (int n = 0; n < 12 * FAMILIES; n++) {
        const family which = (family)(n % FAMILIES);
        gough_machine machine;
        double length[GOUGH_LEGS];
        family_machine(which, &d, &machine);
        const gough_state at = random_pose(&machine, 0.2, 0.4, &d);
        lengths_by_vectors(&machine, &at, length);
        const gough_poses found = all_of(&machine, length);
        ck_assert_msg(found.real + found.nonreal == finite[which],
                      "machine %d of seed 41: %d real, %d not, %d at infinity, %d singular", n,
                      found.real, found.nonreal, found.infinite, found.singular);
        ck_assert(found.complete ==
                  (finite[which] == 40 ? GOUGH_COMPLETE_PROVED : GOUGH_COMPLETE_COUNTED));
        check_poses(&machine, length, &found);
        double nearest = 1;
        for (int i = 0; i < found.real; i++) {
            const gough_state there = state_of(&pose[i]);
            nearest = fmin(nearest, pose_difference(&at, &there));
        }
        ck_assert_msg(nearest < 1e-11, "machine %d of seed 41 misses its pose by %g", n, nearest);
    }
}
END_TEST

/* S R S and S p with S = diag(1, 1, −1): the image in the plane of the base */
START_TEST(plane_machines_have_poses_in_mirror_pairs) {
    dice d = {42};
    for (int n = 0; n < 10; n++) {
        gough_machine machine;
        double length[GOUGH_LEGS];
        family_machine(n < 5 ? FAMILY_PLANE_BOTH : FAMILY_RINGS, &d, &machine);
        const gough_state at = random_pose(&machine, 0.2, 0.4, &d);
        lengths_by_vectors(&machine, &at, length);
        const gough_poses found = all_of(&machine, length);
        ck_assert(found.real > 0 && found.real % 4 == 0);
        for (int i = 0; i < found.real; i++) {
            gough_state image = state_of(&pose[i]);
            double nearest = 1;
            image.position[2] = -image.position[2];
            for (int k = 0; k < 2; k++) {
                image.rotation[2][k] = -image.rotation[2][k];
                image.rotation[k][2] = -image.rotation[k][2];
            }
            for (int j = 0; j < found.real; j++) {
                const gough_state other = state_of(&pose[j]);
                nearest = fmin(nearest, pose_difference(&image, &other));
            }
            ck_assert(nearest < 1e-11);
        }
    }
}
END_TEST

START_TEST(dietmaier_has_forty_real_poses) {
    gough_machine machine;
    double length[GOUGH_LEGS], printed[DIETMAIER_POSES][9];
    dietmaier_machine(&machine, length, printed);
    const gough_poses found = all_of(&machine, length);
    ck_assert_int_eq(found.real, 40);
    ck_assert(found.complete == GOUGH_COMPLETE_PROVED);
    check_poses(&machine, length, &found);
    for (int n = 0; n < DIETMAIER_POSES; n++) {
        double nearest = 1;
        for (int i = 0; i < found.real; i++) {
            double worst = 0;
            for (int k = 0; k < 3; k++) {
                worst = fmax(worst, fabs(pose[i].position[k] - printed[n][k]));
                worst = fmax(worst, fabs(pose[i].rotation[k][0] - printed[n][3 + k]));
                worst = fmax(worst, fabs(pose[i].rotation[k][1] - printed[n][6 + k]));
            }
            nearest = fmin(nearest, worst);
        }
        ck_assert_msg(nearest < 1e-9, "pose %d of the paper is missed by %g", n, nearest);
    }
}
END_TEST

/* what Newton's method in (R, p) finds from random places are poses found, and it finds all of them */
START_TEST(newton_from_many_places_finds_the_same_poses) {
    enum { STARTS = 3000 };
    dice d = {43};
    for (int n = 0; n < FAMILIES; n++) {
        gough_machine machine;
        double length[GOUGH_LEGS];
        int seen[GOUGH_POSES] = {0}, missing = 0;
        family_machine((family)n, &d, &machine);
        gough_state at = random_pose(&machine, 0.2, 0.4, &d);
        lengths_by_vectors(&machine, &at, length);
        const gough_poses found = all_of(&machine, length);
        for (int i = 0; i < STARTS; i++) {
            const double angles[3] = {dice_between(&d, -pi, pi), dice_between(&d, -1.5, 1.5),
                                      dice_between(&d, -pi, pi)};
            gough_rotation_from_angles(angles, at.rotation);
            for (int k = 0; k < 3; k++) at.position[k] = dice_between(&d, -1.8, 1.8);
            if (!newton_by_vectors(&machine, length, &at)) continue;
            bool known = false;
            for (int j = 0; j < found.real && !known; j++) {
                const gough_state other = state_of(&pose[j]);
                known = pose_difference(&at, &other) < 1e-8;
                seen[j] |= known;
            }
            ck_assert_msg(known, "machine %d of seed 43: start %d ends elsewhere", n, i);
        }
        for (int j = 0; j < found.real; j++) missing += !seen[j];
        ck_assert_msg(missing == 0, "machine %d: Newton's method finds %d of %d poses not", n,
                      missing, found.real);
    }
}
END_TEST

/* near a singular pose all stay certified; at it, what is not is said */
START_TEST(singular_poses_are_no_proof) {
    dice d = {44};
    gough_machine machine;
    gough_poses found;
    double length[GOUGH_LEGS];
    family_machine(FAMILY_RINGS, &d, &machine);
    gough_state at = gough_state_home(&machine);
    gough_rotation_from_angles((const double[3]){0, 0, pi / 2 - 1e-4}, at.rotation);
    lengths_by_vectors(&machine, &at, length);
    found = all_of(&machine, length);
    ck_assert_int_eq(found.real + found.nonreal, 28);
    ck_assert(found.complete == GOUGH_COMPLETE_COUNTED);
    gough_rotation_from_angles((const double[3]){0, 0, pi / 2}, at.rotation);
    lengths_by_vectors(&machine, &at, length);
    found = all_of(&machine, length);
    ck_assert(found.real + found.nonreal < 28 && found.singular > 0);
    ck_assert(found.complete == GOUGH_COMPLETE_NO);
}
END_TEST

/* the lengths of a leg that reaches nowhere */
START_TEST(lengths_without_a_pose_are_said_to_have_none) {
    dice d = {45};
    gough_machine machine;
    gough_poses found;
    gough_error error = {0};
    double length[GOUGH_LEGS];
    family_machine(FAMILY_GENERAL, &d, &machine);
    memcpy(length, machine.home_length, sizeof length);
    length[2] = 10;
    ck_assert(gough_poses_all(&machine, length, pose, &found, &error) == GOUGH_ERROR_NUMERICAL);
    ck_assert(found.real == 0 && found.nonreal == 40);
    ck_assert(found.complete == GOUGH_COMPLETE_PROVED);
    ck_assert_str_eq(error.message,
                     "no pose of this machine has these lengths: all 40 are complex");
    length[2] = NAN;
    ck_assert(gough_poses_all(&machine, length, pose, &found, &error) == GOUGH_ERROR_INPUT);
    ck_assert(strstr(error.message, "leg 3") != NULL);
}
END_TEST

/* machines in which each pose is singular: similar hexagons; corners and middles of the sides of two equilateral triangles, corners
 * joined to middles (M. Griffis and J. Duffy) */
START_TEST(machines_that_are_always_singular_are_no_machines) {
    gough_platform platform[2];
    const gough_load load = {.mass = 1, .inertia = {{0.08, 0, 0}, {0, 0.08, 0}, {0, 0, 0.15}}};
    platform[0] = gough_platform_symmetric(1, 20 * pi / 180, 0.6, 40 * pi / 180, 1.2);
    platform[1] = gough_platform_default();
    platform[1].height = 1.2;
    for (int v = 0; v < GOUGH_LEGS; v++) {
        for (int ring = 0; ring < 2; ring++) {
            const int n = v + ring; /* corners are even, and twice as far out as the middles */
            const double r = (n % 2 ? 0.5 : 1.0) * (ring ? 0.6 : 1), angle = n * pi / 3;
            double *joint = ring ? platform[1].top[v] : platform[1].base[v];
            joint[0] = r * cos(angle), joint[1] = r * sin(angle);
        }
    }
    for (int n = 0; n < 2; n++) {
        gough_machine machine;
        gough_error error = {0};
        ck_assert(gough_machine_init(&machine, &platform[n], &load, (double[3]){0, 0, -1},
                                     &error) == GOUGH_ERROR_INPUT);
        ck_assert(strstr(error.message, "singular in every pose") != NULL);
    }
}
END_TEST

/* ---- the stored system ---- */

static scalar product(const scalar *a, const double (*b)[2], int count) {
    scalar sum = {0, 0};
    for (int k = 0; k < count; k++) sum = plus(sum, times(a[k], (scalar){b[k][0], b[k][1]}));
    return sum;
}

START_TEST(stored_roots_are_forty_roots) {
    for (int i = 0; i < PATHS; i++) {
        const double(*at)[2] = start_root[i].x;
        scalar x[SOMA], Y[PRODUCTS];
        double size = 0;
        for (int k = 0; k < SOMA; k++) {
            x[k] = (scalar){at[k][0], at[k][1]};
            size += square_magnitude(x[k]);
        }
        ck_assert(fabs(size - 1) < 1e-14);
        ck_assert(magnitude(product(x, at + 4, 4)) < 1e-14);
        for (int n = 0; n < PRODUCTS; n++) Y[n] = scalar_of(0);
        soma_products(x, x, Y);
        for (int v = 0; v < PATH_ROWS; v++)
            ck_assert(magnitude(product(Y, start_system.c[v], PRODUCTS)) < 1e-14);
        for (int j = 0; j < i; j++) { /* |x* z| is 1 for the same point */
            scalar dot = {0, 0};
            for (int k = 0; k < SOMA; k++) {
                const scalar z = {start_root[j].x[k][0], start_root[j].x[k][1]};
                dot = plus(dot, times(conjugate(x[k]), z));
            }
            ck_assert(sqrt(1 - square_magnitude(dot)) > 0.4);
        }
    }
}
END_TEST

START_TEST(paths_have_the_same_bits_in_all_lanes) {
    static path_end one[PATHS], many[PATHS];
    path_system to = start_system;
    dice d = {46};
    for (int v = 0; v < PATH_ROWS; v++) {
        for (int n = 0; n < PRODUCTS; n++) {
            to.c[v][n][0] = dice_between(&d, -0.4, 0.4);
            to.c[v][n][1] = dice_between(&d, -0.4, 0.4);
        }
    }
    path_track_1(&start_system, &to, start_root, PATHS, one);
    for (int i = 0; i < PATHS; i++) ck_assert(one[i].left <= 0);
    for (int width = 2; width <= 8; width *= 2) {
        if (!has_lanes(width)) continue;
        memset(many, 0, sizeof many);
#if defined(__x86_64__)
        if (width == 8) path_track_8(&start_system, &to, start_root, PATHS, many);
        if (width == 4) path_track_4(&start_system, &to, start_root, PATHS, many);
#endif
        if (width == 2) path_track_2(&start_system, &to, start_root, PATHS, many);
        if (many[0].steps == 0) continue;
        for (int i = 0; i < PATHS; i++) {
            ck_assert(memcmp(&one[i].at, &many[i].at, sizeof one[i].at) == 0);
            ck_assert_int_eq(one[i].steps, many[i].steps);
        }
    }
    /* fewer paths than lanes */
    path_track_2(&start_system, &to, start_root + 5, 1, many);
    ck_assert(memcmp(&one[5].at, &many[0].at, sizeof one[0].at) == 0);
}
END_TEST

int main(void) {
    return SUITE_RUN("all", 60, counts_are_those_of_the_family,
                     plane_machines_have_poses_in_mirror_pairs, dietmaier_has_forty_real_poses,
                     newton_from_many_places_finds_the_same_poses, singular_poses_are_no_proof,
                     lengths_without_a_pose_are_said_to_have_none,
                     machines_that_are_always_singular_are_no_machines,
                     stored_roots_are_forty_roots, paths_have_the_same_bits_in_all_lanes);
}
