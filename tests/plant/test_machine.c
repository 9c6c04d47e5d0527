/* Machines: what follows from joints and load, and every machine that cannot be. */
#include <check.h>
#include <math.h>
#include <string.h>

#define NUMBER_QUAD
#include "kernel/principal.h"
#include "program/helpers.h"

static const double DEGREE = 3.14159265358979323846 / 180;
static const double DOWN[3] = {0, 0, -1};

static gough_load plain_load(void) {
    return (gough_load){.mass = 1, .inertia = {{0.08, 0, 0}, {0, 0.08, 0}, {0, 0, 0.15}}};
}

static gough_platform plain_platform(void) {
    return gough_platform_symmetric(1, 10 * DEGREE, 0.6, 6.4688478326275441 * DEGREE, 1);
}

static gough_machine machine_of(const gough_platform *p, const gough_load *l) {
    gough_machine m;
    gough_error error = {.message = ""};
    const gough_status status = gough_machine_init(&m, p, l, DOWN, &error);
    ck_assert_msg(status == GOUGH_OK, "%s", error.message);
    return m;
}

static void refused(const gough_platform *p, const gough_load *l, const double gravity[3],
                    const char *sentence) {
    gough_machine m, before;
    gough_error error = {.message = ""};
    memset(&m, 7, sizeof m);
    memcpy(&before, &m, sizeof m);
    ck_assert_msg(gough_machine_init(&m, p, l, gravity, &error) == GOUGH_ERROR_INPUT,
                  "accepted, for all that: %s", sentence);
    ck_assert_msg(strstr(error.message, sentence) != NULL, "%s", error.message);
    ck_assert_int_eq(memcmp(&m, &before, sizeof m), 0);
}

/* ---- principal axes ---- */

START_TEST(a_diagonal_inertia_is_left_untouched) {
    number J[3][3] = {{3, 0, 0}, {0, 1, 0}, {0, 0, 2}}, axes[3][3], moments[3];
    principal_axes(J, axes, moments);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) ck_assert(axes[i][j] == (i == j));
    ck_assert(moments[0] == 3 && moments[1] == 1 && moments[2] == 2);
}
END_TEST

/* axes·diag·axesᵀ gives the matrix back, axesᵀ·axes the identity, the determinant is +1; entries
 * from 1e-6 to 1 */
START_TEST(principal_axes_diagonalise_in_quad) {
    random_source random = random_seeded(6);
    for (int trial = 0; trial < 2000; trial++) {
        number J[3][3], axes[3][3], m[3];
        for (int i = 0; i < 3; i++)
            for (int j = 0; j <= i; j++)
                J[i][j] = J[j][i] = (number)(random_between(&random, -1, 1) *
                                             pow(10, random_between(&random, -6, 0)));
        if (trial % 10 == 0) J[1][1] = J[0][0]; /* equal diagonals: turned by 45° */
        principal_axes(J, axes, m);
        for (int i = 0; i < 3; i++) {
            for (int j = 0; j < 3; j++) {
                number back = 0, unit = 0;
                for (int k = 0; k < 3; k++) {
                    back += axes[i][k] * m[k] * axes[j][k];
                    unit += axes[k][i] * axes[k][j];
                }
                ck_assert(fabs((double)(back - J[i][j])) <= 1e-31);
                ck_assert(fabs((double)(unit - (i == j))) <= 1e-31);
            }
        }
        number det = 0;
        for (int i = 0; i < 3; i++)
            det += axes[0][i] * (axes[1][(i + 1) % 3] * axes[2][(i + 2) % 3] -
                                 axes[1][(i + 2) % 3] * axes[2][(i + 1) % 3]);
        ck_assert(fabs((double)(det - 1)) <= 1e-31);
    }
}
END_TEST

/* ---- loads: against bodies of mass points, whose moments are sums ---- */

typedef struct cloud {
    double mass[12], point[12][3];
} cloud;

static gough_load load_of_cloud(random_source *random, cloud *c, double flatness) {
    gough_load load = {.mass = 0};
    double rotation[3][3];
    /* a random rotation from a quaternion */
    double q[4], square = 0;
    for (int i = 0; i < 4; i++) {
        q[i] = random_between(random, -1, 1);
        square += q[i] * q[i];
    }
    for (int i = 0; i < 4; i++) q[i] /= sqrt(square);
    const double w = q[0], x = q[1], y = q[2], z = q[3];
    const double turned[3][3] = {
        {1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
        {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
        {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
    memcpy(rotation, turned, sizeof rotation);
    for (int n = 0; n < 12; n++) {
        const double local[3] = {random_between(random, -1, 1), random_between(random, -1, 1),
                                 flatness * random_between(random, -1, 1)};
        c->mass[n] = random_between(random, 0.1, 1);
        load.mass += c->mass[n];
        for (int i = 0; i < 3; i++) {
            c->point[n][i] = 0;
            for (int j = 0; j < 3; j++) c->point[n][i] += rotation[i][j] * local[j];
        }
    }
    for (int n = 0; n < 12; n++)
        for (int i = 0; i < 3; i++)
            load.center_of_mass[i] += c->mass[n] * c->point[n][i] / load.mass;
    for (int n = 0; n < 12; n++) {
        double p[3], norm2 = 0;
        for (int i = 0; i < 3; i++) {
            p[i] = c->point[n][i] -= load.center_of_mass[i];
            norm2 += p[i] * p[i];
        }
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                load.inertia[i][j] += c->mass[n] * ((i == j ? norm2 : 0) - p[i] * p[j]);
    }
    return load;
}

START_TEST(second_moments_are_those_of_the_mass_points) {
    random_source random = random_seeded(7);
    const gough_platform p = plain_platform();
    for (int trial = 0; trial < 200; trial++) {
        cloud c;
        const gough_load load = load_of_cloud(&random, &c, 0.5);
        const gough_machine m = machine_of(&p, &load);
        for (int a = 0; a < 3; a++) {
            for (int b = 0; b < 3; b++) {
                double sum = 0; /* ∫ab dm in the central frame */
                for (int n = 0; n < 12; n++) {
                    double on_a = 0, on_b = 0;
                    for (int i = 0; i < 3; i++) {
                        on_a += m.principal_axes[i][a] * c.point[n][i];
                        on_b += m.principal_axes[i][b] * c.point[n][i];
                    }
                    sum += c.mass[n] * on_a * on_b;
                }
                ck_assert(fabs(sum - (a == b ? m.second_moments[a] : 0)) <= 1e-14 * 12);
            }
        }
    }
}
END_TEST

START_TEST(a_flat_body_is_accepted_with_a_vanishing_moment) {
    random_source random = random_seeded(8);
    const gough_platform p = plain_platform();
    gough_load load = plain_load();
    load.inertia[2][2] = 0.16;
    gough_machine m = machine_of(&p, &load);
    ck_assert(fabs(m.second_moments[2]) <= 0);
    for (int trial = 0; trial < 200; trial++) {
        cloud c;
        load = load_of_cloud(&random, &c, 0);
        m = machine_of(&p, &load);
        const double least =
            fmin(m.second_moments[0], fmin(m.second_moments[1], m.second_moments[2]));
        ck_assert(fabs(least) <= 0);
    }
}
END_TEST

/* ---- platforms ---- */

START_TEST(symmetric_joints_lie_where_the_angles_say) {
    const gough_platform p = gough_platform_symmetric(2, 15 * DEGREE, 0.5, 20 * DEGREE, 1.5);
    static const double BASE[] = {15, 105, 135, 225, 255, 345},
                        TOP[] = {40, 80, 160, 200, 280, 320};
    for (int n = 0; n < GOUGH_LEGS; n++) {
        const double base[3] = {2 * cos(BASE[n] * DEGREE), 2 * sin(BASE[n] * DEGREE), 0};
        const double top[3] = {0.5 * cos(TOP[n] * DEGREE), 0.5 * sin(TOP[n] * DEGREE), 0};
        for (int a = 0; a < 3; a++) {
            ck_assert(fabs(p.base[n][a] - base[a]) <= 2e-15);
            ck_assert(fabs(p.top[n][a] - top[a]) <= 2e-15);
        }
    }
    ck_assert(p.height >= 1.5 && p.height <= 1.5);
    ck_assert(isinf(p.length_max) && isinf(p.speed_max) && isinf(p.force_max));
    ck_assert(fabs(p.length_min) <= 0);
}
END_TEST

START_TEST(the_study_machine_has_its_lengths_and_radius) {
    const gough_platform p = plain_platform();
    const gough_load load = plain_load();
    const gough_machine m = machine_of(&p, &load);
    for (int n = 0; n < GOUGH_LEGS; n++)
        ck_assert(fabs(m.home_length[n] - sqrt(1.49)) <= 1e-15); /* h₀ = 1, d = 0.7 */
    ck_assert(fabs(m.base_radius - 1) <= 0);
    ck_assert(fabs(m.gravity_magnitude - 1) <= 0);
    ck_assert(fabs(m.second_moments[0] - 0.075) <= 1e-17);
    ck_assert(fabs(m.second_moments[2] - 0.005) <= 1e-17);
}
END_TEST

/* JᵀJ of a symmetric hexapod about the top centre, moments per top radius r, from its closed
 * form: blocks (x, θy), (y, −θx) and the single z and ψ give all six singular values */
static double closed_form_condition(double R, double r, double delta, double h) {
    const double d2 = R * R + r * r - 2 * R * r * cos(delta), l2 = h * h + d2;
    const double q = r * r - r * R * cos(delta);
    const double xx = 3 * d2 / l2, tt = 3 * h * h / l2, xt = 3 * h * q / l2 / r;
    const double zz = 6 * h * h / l2, pp = 6 * R * R * sin(delta) * sin(delta) / l2;
    const double mean = (xx + tt) / 2, half = sqrt((xx - tt) * (xx - tt) / 4 + xt * xt);
    const double high = fmax(mean + half, fmax(zz, pp)), low = fmin(mean - half, fmin(zz, pp));
    return sqrt(high / low);
}

START_TEST(condition_at_home_is_that_of_the_closed_form) {
    random_source random = random_seeded(9);
    const gough_load load = plain_load();
    for (int trial = 0; trial < 100; trial++) {
        const double R = random_between(&random, 0.5, 3), r = random_between(&random, 0.3, 2);
        const double b = random_between(&random, 2, 28), t = random_between(&random, 2, 28);
        const double h = random_between(&random, 0.4, 3);
        const gough_platform p = gough_platform_symmetric(R, b * DEGREE, r, t * DEGREE, h);
        const gough_machine m = machine_of(&p, &load);
        const double right = closed_form_condition(R, r, (60 - b - t) * DEGREE, h);
        ck_assert(fabs(m.home_condition / right - 1) <= 1e-12 * right);
    }
}
END_TEST

START_TEST(the_radius_of_general_joints_is_their_mean_distance) {
    gough_platform p = plain_platform();
    const gough_load load = plain_load();
    p.base_radius = 0;
    for (int n = 0; n < GOUGH_LEGS; n++) p.base[n][0] += 5, p.top[n][0] += 5;
    const gough_machine m = machine_of(&p, &load);
    ck_assert(fabs(m.base_radius - 1) <= 1e-15);
}
END_TEST

/* the smallest and the largest have no 15 digits to be rounded to */
START_TEST(a_machine_of_any_size_has_its_radius) {
    static const double SIZE[] = {1e-10, 1e-6, 1e6, 1e17};
    const gough_load load = plain_load();
    for (size_t i = 0; i < sizeof SIZE / sizeof SIZE[0]; i++) {
        gough_platform p = gough_platform_symmetric(SIZE[i], 10 * DEGREE, 0.6 * SIZE[i],
                                                    6.4688478326275441 * DEGREE, SIZE[i]);
        p.base_radius = 0;
        const gough_machine m = machine_of(&p, &load);
        ck_assert(fabs(m.base_radius - SIZE[i]) <= 1e-15 * SIZE[i]);
    }
}
END_TEST

START_TEST(a_home_pose_alone_singular_is_accepted) {
    gough_platform p = plain_platform();
    const gough_load load = plain_load();
    p.height = 0;
    const gough_machine m = machine_of(&p, &load);
    ck_assert(isinf(m.home_condition) && m.home_condition > 0);
}
END_TEST

START_TEST(machines_that_share_single_joints_are_accepted) {
    const gough_load load = plain_load();
    /* 6-3: top pairs meet */
    gough_platform p = gough_platform_symmetric(1, 10 * DEGREE, 0.6, 0, 1);
    machine_of(&p, &load);
    /* 3-3, the octahedron: base pairs meet too */
    p = gough_platform_symmetric(1, 0, 0.6, 0, 1);
    machine_of(&p, &load);
}
END_TEST

START_TEST(general_machines_are_accepted) {
    random_source random = random_seeded(10);
    for (int trial = 0; trial < 500; trial++) {
        gough_platform p = plain_platform();
        cloud c;
        const gough_load load = load_of_cloud(&random, &c, 0.7);
        for (int n = 0; n < GOUGH_LEGS; n++) {
            for (int a = 0; a < 3; a++) {
                p.base[n][a] = random_between(&random, -1, 1);
                p.top[n][a] = random_between(&random, -1, 1);
            }
        }
        p.height = 2;
        machine_of(&p, &load);
    }
}
END_TEST

/* ---- machines that cannot be ---- */

START_TEST(similar_hexagons_are_refused) {
    const gough_load load = plain_load();
    random_source random = random_seeded(11);
    for (int trial = 0; trial < 50; trial++) {
        const double b = random_between(&random, 2, 58), r = random_between(&random, 0.2, 0.9);
        /* δ = 60° − b − t = 0 */
        const gough_platform p = gough_platform_symmetric(1, b * DEGREE, r, (60 - b) * DEGREE,
                                                          random_between(&random, 0.3, 2));
        refused(&p, &load, DOWN, "singular in every pose");
    }
    /* irregular similar hexagons are singular everywhere when their corners lie on a conic ... */
    static const double ANGLE[] = {10, 55, 140, 200, 260, 330};
    gough_platform p = plain_platform();
    for (int n = 0; n < GOUGH_LEGS; n++) {
        p.base[n][0] = 1.3 * cos(ANGLE[n] * DEGREE);
        p.base[n][1] = 0.9 * sin(ANGLE[n] * DEGREE);
        for (int a = 0; a < 3; a++) p.top[n][a] = p.base[n][a] / 2;
    }
    refused(&p, &load, DOWN, "singular in every pose");
    /* ... and not otherwise */
    p.base[0][0] += 0.3;
    p.top[0][0] += 0.15;
    machine_of(&p, &load);
    /* δ = π: each leg to the opposite joint */
    p = gough_platform_symmetric(1, 30 * DEGREE, 0.5, 30 * DEGREE, 1);
    for (int n = 0; n < GOUGH_LEGS; n++)
        for (int a = 0; a < 3; a++) p.top[n][a] = -p.base[n][a] / 2;
    refused(&p, &load, DOWN, "singular in every pose");
}
END_TEST

START_TEST(joints_on_a_line_are_refused) {
    const gough_load load = plain_load();
    for (int side = 0; side < 2; side++) {
        gough_platform p = plain_platform();
        double(*joint)[3] = side == 0 ? p.base : p.top;
        const char *sentence =
            side == 0 ? "all base joints lie on one line" : "all top joints lie on one line";
        for (int n = 0; n < GOUGH_LEGS; n++)
            for (int a = 0; a < 3; a++) joint[n][a] = 0.1 * (n + 1) * (a + 1) - a;
        refused(&p, &load, DOWN, sentence);
        for (int n = 0; n < GOUGH_LEGS; n++)
            for (int a = 0; a < 3; a++) joint[n][a] = 0.5;
        refused(&p, &load, DOWN, sentence);
    }
}
END_TEST

START_TEST(legs_sharing_both_joints_are_refused) {
    gough_platform p = plain_platform();
    const gough_load load = plain_load();
    memcpy(p.base[4], p.base[1], sizeof p.base[4]);
    machine_of(&p, &load);
    memcpy(p.top[4], p.top[1], sizeof p.top[4]);
    refused(&p, &load, DOWN, "legs 2 and 5 share both joints");
}
END_TEST

START_TEST(a_leg_of_no_length_is_refused) {
    gough_platform p = plain_platform();
    const gough_load load = plain_load();
    p.base[2][0] = p.top[2][0], p.base[2][1] = p.top[2][1], p.base[2][2] = p.top[2][2] + p.height;
    refused(&p, &load, DOWN, "leg 3 has zero length at home");
}
END_TEST

static const struct {
    double inertia[3][3];
    const char *sentence;
} BAD_INERTIA[] = {
    {{{1, 0, 0}, {0, 1, 0}, {0, 0, 2.1}}, "the greatest exceeds the sum of the other two"},
    {{{1, 0, 0}, {0, 3.1, 0}, {0, 0, 2}}, "the greatest exceeds the sum of the other two"},
    {{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, "each must be positive"},
    {{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}},
     "each must be positive"}, /* a rod: nothing resists its spin */
    {{{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}, "each must be positive"},
    {{{1, 2, 0}, {2, 1, 0}, {0, 0, 1}}, "each must be positive"},
    {{{1, 0.5, 0}, {0.4, 1, 0}, {0, 0, 1}}, "row 2, column 1 is 0.4"},
    {{{NAN, 0, 0}, {0, 1, 0}, {0, 0, 1}}, "inertia is not finite"},
    {{{1, 0, 0}, {0, 1, 0}, {0, INFINITY, 1}}, "inertia is not finite"},
};

START_TEST(an_inertia_that_no_body_has_is_refused) {
    const gough_platform p = plain_platform();
    gough_load load = plain_load();
    memcpy(load.inertia, BAD_INERTIA[_i].inertia, sizeof load.inertia);
    refused(&p, &load, DOWN, BAD_INERTIA[_i].sentence);
}
END_TEST

START_TEST(numbers_out_of_range_are_refused) {
    static const double BAD[] = {NAN, INFINITY, -INFINITY};
    const gough_platform good = plain_platform();
    const gough_load good_load = plain_load();
    for (int i = 0; i < 3; i++) {
        gough_platform p = good;
        p.base[3][1] = BAD[i];
        refused(&p, &good_load, DOWN, "y of base joint 4 is not finite");
        p = good;
        p.top[0][2] = BAD[i];
        refused(&p, &good_load, DOWN, "z of top joint 1 is not finite");
        p = good;
        p.height = BAD[i];
        refused(&p, &good_load, DOWN, "height is not finite");
        p = good;
        p.base_radius = BAD[i];
        refused(&p, &good_load, DOWN, "base radius");
        gough_load load = good_load;
        load.mass = BAD[i];
        refused(&good, &load, DOWN, "the mass of the load must be positive");
        load = good_load;
        load.center_of_mass[2] = BAD[i];
        refused(&good, &load, DOWN, "centre of mass is not finite");
        for (int r = 0; r < 3; r++) {
            load = good_load;
            load.inertia[r][r] = BAD[i];
            refused(&good, &load, DOWN, "the load's inertia is not finite");
        }
        p = good;
        p.length_min = BAD[i];
        refused(&p, &good_load, DOWN, "least leg length");
        refused(&good, &good_load, (double[3]){0, BAD[i], 0}, "gravity is not finite");
    }
    gough_load load = good_load;
    load.mass = 0;
    refused(&good, &load, DOWN, "the mass of the load must be positive");
    gough_platform p = good;
    p.base_radius = -1;
    refused(&p, &good_load, DOWN, "base radius");
    p = good;
    p.length_min = -1;
    refused(&p, &good_load, DOWN, "least leg length");
    p.length_min = 2, p.length_max = 1;
    refused(&p, &good_load, DOWN, "must exceed the least");
    p = good;
    p.speed_max = 0;
    refused(&p, &good_load, DOWN, "leg speed");
    p = good;
    p.force_max = NAN;
    refused(&p, &good_load, DOWN, "leg force");
    p = good;
    for (int n = 0; n < GOUGH_LEGS; n++) p.base[n][0] = n % 2 == 0 ? 1e308 : -1e308;
    refused(&p, &good_load, DOWN, "too far apart");
}
END_TEST

START_TEST(no_gravity_is_accepted) {
    const gough_platform p = plain_platform();
    const gough_load load = plain_load();
    gough_machine m;
    ck_assert_int_eq(gough_machine_init(&m, &p, &load, (double[3]){0, 0, 0}, NULL), GOUGH_OK);
    ck_assert(fabs(m.gravity_magnitude) <= 0);
}
END_TEST

static void add_tests(TCase *tests) {
    tcase_add_test(tests, a_diagonal_inertia_is_left_untouched);
    tcase_add_test(tests, principal_axes_diagonalise_in_quad);
    tcase_add_test(tests, second_moments_are_those_of_the_mass_points);
    tcase_add_test(tests, a_flat_body_is_accepted_with_a_vanishing_moment);
    tcase_add_test(tests, symmetric_joints_lie_where_the_angles_say);
    tcase_add_test(tests, the_study_machine_has_its_lengths_and_radius);
    tcase_add_test(tests, condition_at_home_is_that_of_the_closed_form);
    tcase_add_test(tests, the_radius_of_general_joints_is_their_mean_distance);
    tcase_add_test(tests, a_machine_of_any_size_has_its_radius);
    tcase_add_test(tests, a_home_pose_alone_singular_is_accepted);
    tcase_add_test(tests, machines_that_share_single_joints_are_accepted);
    tcase_add_test(tests, general_machines_are_accepted);
    tcase_add_test(tests, similar_hexagons_are_refused);
    tcase_add_test(tests, joints_on_a_line_are_refused);
    tcase_add_test(tests, legs_sharing_both_joints_are_refused);
    tcase_add_test(tests, a_leg_of_no_length_is_refused);
    tcase_add_loop_test(tests, an_inertia_that_no_body_has_is_refused, 0,
                        (int)(sizeof BAD_INERTIA / sizeof BAD_INERTIA[0]));
    tcase_add_test(tests, numbers_out_of_range_are_refused);
    tcase_add_test(tests, no_gravity_is_accepted);
}

int main(void) {
    Suite *suite = suite_create("machine");
    TCase *tests = tcase_create("machine");
    tcase_set_timeout(tests, 60);
    add_tests(tests);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? 0 : 1;
}
