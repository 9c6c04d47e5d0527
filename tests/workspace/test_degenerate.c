/* Questions at the edge of what can be asked: one limit at a time, limits on one side only, machines whose legs share a joint or
 * touch, poses where a leg has no length or the machine is singular, searches that may not test enough; and what is refused. */
#define NUMBER_DOUBLE
#include "support/suite.h"
#include "workspace/box_test.h"
#include "workspace/clearance.h"
#include "workspace/flight.h"
#include "workspace/stiff.h"

static const double home[GOUGH_COMPONENTS] = {0, 0, 0, 0, 0, 0};

static gough_model *flight(void) {
    gough_model *model = calloc(1, sizeof *model);
    flight_machine(model);
    return model;
}

/* a reach without any limit */
static gough_reach unlimited(const gough_model *model) {
    gough_reach reach = flight_reach(model);
    for (int v = 0; v < GOUGH_LEGS; v++) {
        reach.limits.length[v][0] = 0, reach.limits.length[v][1] = INFINITY;
        reach.limits.base_swing[v] = reach.limits.top_swing[v] = INFINITY;
    }
    return reach;
}

static void machine_of(gough_model *model, const gough_platform *p) {
    const gough_load load = {.mass = 100, .inertia = {{10, 0, 0}, {0, 10, 0}, {0, 0, 10}}};
    const double gravity[3] = {0, 0, -9.80665};
    gough_error error = {0};
    memset(model, 0, sizeof *model);
    ck_assert_msg(gough_machine_init(&model->machine, p, &load, gravity, &error) == GOUGH_OK, "%s",
                  error.message);
}

static void refused(gough_status status, const gough_error *error, const char *part) {
    ck_assert_int_eq(status, GOUGH_ERROR_INPUT);
    ck_assert_msg(strstr(error->message, part) != NULL, "'%s' lacks '%s'", error->message, part);
}

/* ---- what is refused ---- */

static void refuse_asked(gough_model *model, double *member, double value, const char *part) {
    const double before = *member;
    gough_reach reach;
    gough_error error = {0};
    *member = value;
    refused(gough_reach_init(&reach, sizeof reach, model, &error), &error, part);
    *member = before;
}

START_TEST(numbers_out_of_range_are_refused_by_their_key) {
    gough_model *model = flight();
    gough_workspace *w = &model->workspace;
    gough_error error = {0};
    gough_reach reach;
    refuse_asked(model, &w->velocity[1], -1, "workspace.velocity must have three numbers");
    refuse_asked(model, &w->moment[2], INFINITY, "workspace.moment must have three numbers");
    refuse_asked(model, &w->force[0], NAN, "workspace.force must have three numbers");
    refuse_asked(model, &w->about[0], INFINITY, "workspace.about is not finite");
    refuse_asked(model, &w->orientation[2], NAN, "workspace.orientation is not finite");
    refuse_asked(model, &w->box[GOUGH_YAW][0], 0.1, "workspace.box.yaw must contain home");
    refuse_asked(model, &w->box[GOUGH_SURGE][1], -0.1, "workspace.box.surge must contain home");
    refuse_asked(model, &w->box[GOUGH_ROLL][1], INFINITY, "workspace.box.roll must contain home");
    refuse_asked(model, &w->least_singular_value, -0.1, "least_singular_value must be 0 or");
    refuse_asked(model, &w->least_singular_value, INFINITY, "least_singular_value must be 0 or");
    model->motion.order = (gough_order)7;
    refused(gough_reach_init(&reach, sizeof reach, model, &error), &error, "must be zyx or xyz");
    model->motion.order = GOUGH_ZYX;
    refused(gough_reach_init(&reach, 8, model, &error), &error, "another size");
    free(model);
}
END_TEST

START_TEST(questions_that_are_none_are_refused) {
    gough_model *model = flight();
    gough_reach reach = flight_reach(model);
    const double forward[GOUGH_COMPONENTS] = {1, 0, 0, 0, 0, 0};
    for (int which = 0; which < 4; which++) {
        gough_box box = {{-0.1, 0, 0, 0, 0, 0}, {0.1, 0, 0, 0, 0, 0}};
        gough_certificate found;
        gough_largest_box largest;
        gough_envelope envelope;
        gough_binding binding;
        gough_error error = {0};
        const char *part = "must be finite, and each least at most the greatest";
        if (which == 0) box.least[1] = NAN;
        if (which == 1) box.greatest[1] = INFINITY;
        if (which == 2) box.least[1] = 0.1;
        if (which == 3) reach.order = (gough_order)9, part = "must be zyx or xyz";
        ck_assert_int_eq(gough_box_test(&reach, &box, &binding), GOUGH_UNDECIDED);
        ck_assert_int_eq(binding.bind, GOUGH_BIND_NONE);
        refused(gough_box_certify(&reach, &box, &found, &error), &error, part);
        refused(gough_workspace_envelope(&reach, &box, &envelope, &error), &error, part);
        refused(gough_workspace_box(&reach, &box, &largest, &error), &error,
                which == 3 ? part : "must be finite and contain home");
    }
    gough_travel travel;
    gough_volume volume;
    gough_ray ray;
    gough_error error = {0};
    refused(gough_workspace_travel(&reach, 0, &travel, &error), &error, "zyx or xyz");
    refused(gough_workspace_ray(&reach, home, forward, &ray, &error), &error, "zyx or xyz");
    refused(gough_workspace_volume(&reach, home, &volume, &error), &error, "zyx or xyz");
    reach.order = GOUGH_ZYX;
    refused(gough_workspace_travel(&reach, -1, &travel, &error), &error, "no component -1");
    refused(gough_workspace_travel(&reach, 6, &travel, &error), &error, "no component 6");
    refused(gough_workspace_ray(&reach, home, home, &ray, &error), &error, "other than 0");
    const double never[GOUGH_COMPONENTS] = {0, 0, NAN, 0, 0, 0};
    refused(gough_workspace_ray(&reach, never, forward, &ray, &error), &error, "a finite start");
    refused(gough_workspace_ray(&reach, home, never, &ray, &error), &error, "finite direction");
    refused(gough_workspace_volume(&reach, never + 2, &volume, &error), &error, "must be finite");
    gough_largest_box largest;
    const gough_box aside = {{-1, 0, 0.1, 0, 0, 0}, {1, 0, 0.2, 0, 0, 0}},
                    below = {{-1, 0, -0.2, 0, 0, 0}, {1, 0, -0.1, 0, 0, 0}}, nothing = {{0}, {0}};
    refused(gough_workspace_box(&reach, &aside, &largest, &error), &error, "contain home");
    refused(gough_workspace_box(&reach, &below, &largest, &error), &error, "contain home");
    refused(gough_workspace_box(&reach, &nothing, &largest, &error), &error, "have an extent");
    ck_assert_str_eq(gough_bind_name(GOUGH_BINDS), "unknown");
    ck_assert_str_eq(gough_worst_name(GOUGH_WORSTS), "unknown");
    free(model);
}
END_TEST

/* home outside: every question from home says which limit is exceeded */
START_TEST(home_outside_names_its_limit) {
    gough_model *model = flight();
    for (int which = 0; which < 3; which++) {
        gough_reach reach = unlimited(model);
        const gough_box shape = {{0, 0, -1, 0, 0, 0}, {0, 0, 1, 0, 0, 0}};
        static const char *const limit[] = {"the least length of leg 3 is exceeded",
                                            "a limit of the platform's pose is exceeded",
                                            "the least singular value is exceeded"};
        gough_largest_box largest;
        gough_travel travel;
        gough_ray ray;
        gough_error error = {0};
        if (which == 0) reach.limits.length[2][0] = 4;
        if (which == 1) reach.limits.pose[GOUGH_YAW][0] = 0.1;
        if (which == 2) reach.asked.least_singular_value = 0.99;
        ck_assert_int_eq(gough_workspace_travel(&reach, 2, &travel, &error), GOUGH_ERROR_NUMERICAL);
        ck_assert_msg(strstr(error.message, limit[which]) != NULL, "%s", error.message);
        ck_assert(fabs(travel.end[0]) + fabs(travel.end[1]) <= 0);
        ck_assert_int_eq(gough_workspace_box(&reach, &shape, &largest, &error),
                         GOUGH_ERROR_NUMERICAL);
        ck_assert_int_eq(gough_workspace_ray(&reach, home, shape.greatest, &ray, &error), GOUGH_OK);
        ck_assert(ray.reach <= 0 && ray.binding.bind == travel.binding[0].bind);
    }
    free(model);
}
END_TEST

START_TEST(a_machine_that_is_singular_at_home_has_no_workspace) {
    gough_model *model = flight();
    gough_reach reach;
    gough_error error = {0};
    model->machine.platform.height = 0;
    for (int v = 0; v < GOUGH_LEGS; v++)
        model->machine.platform.top[v][2] = model->machine.platform.base[v][2] = 0;
    ck_assert_int_eq(gough_reach_init(&reach, sizeof reach, model, &error), GOUGH_ERROR_NUMERICAL);
    ck_assert_ptr_nonnull(strstr(error.message, "singular at home"));
    free(model);
}
END_TEST

/* ---- limits on one side, and none ---- */

/* the travel of a component ends at its own limit, wherever the other end is */
START_TEST(limits_of_components_may_have_one_side) {
    gough_model *model = flight();
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        for (int end = 0; end < 2; end++) {
            gough_reach reach = unlimited(model);
            gough_travel travel;
            reach.limits.pose[c][end] = end ? 0.07 : -0.07;
            ck_assert(gough_workspace_travel(&reach, c, &travel, NULL) == GOUGH_OK);
            ck_assert_double_eq_tol(fabs(travel.end[end]), 0.07, 1e-7);
            ck_assert_int_eq(travel.binding[end].bind, GOUGH_BIND_POSE);
            ck_assert_int_eq(travel.binding[end].which, c);
            ck_assert(fabs(travel.end[1 - end]) > 0.5);
        }
    }
    free(model);
}
END_TEST

/* nothing stops a rise; a search goes on to ten sizes of the machine, a box up to 4096 times its shape */
START_TEST(without_limits_a_search_ends_by_itself) {
    gough_model *model = flight();
    gough_reach reach = unlimited(model);
    gough_travel travel;
    gough_largest_box largest;
    gough_error error = {0};
    const gough_box shape = {{0, 0, 0, 0, 0, 0}, {0, 0, 1, 0, 0, 0}};
    ck_assert(gough_workspace_travel(&reach, GOUGH_HEAVE, &travel, NULL) == GOUGH_OK);
    ck_assert(travel.end[1] > 20 && travel.binding[1].bind == GOUGH_BIND_NONE);
    ck_assert(travel.binding[0].bind == GOUGH_BIND_SINGULAR);
    ck_assert_msg(gough_workspace_box(&reach, &shape, &largest, &error) == GOUGH_OK, "%s",
                  error.message);
    ck_assert(!(largest.upper < INFINITY) && largest.scale <= 4096 && largest.scale > 4095);
    ck_assert_int_eq(largest.binding.bind, GOUGH_BIND_NONE);
    gough_volume volume;
    ck_assert_int_eq(gough_workspace_volume(&reach, home, &volume, &error), GOUGH_ERROR_NUMERICAL);
    ck_assert_ptr_nonnull(strstr(error.message, "no limit bounds the positions"));
    free(model);
}
END_TEST

/* positions between limits of the platform, all of which are regular: the volume of a block */
START_TEST(limits_of_the_platform_alone_have_a_block_for_volume) {
    gough_model *model = flight();
    const double half[3] = {0.3, 0.2, 0.1};
    gough_reach reach = unlimited(model);
    gough_volume volume;
    for (int k = 0; k < 3; k++)
        reach.limits.pose[k][0] = -half[k], reach.limits.pose[k][1] = half[k];
    for (int v = 0; v < GOUGH_LEGS; v++) reach.limits.length[v][0] = 0.1;
    ck_assert(gough_workspace_volume(&reach, home, &volume, NULL) == GOUGH_OK);
    ck_assert_double_eq_tol(volume.value, 8 * 0.3 * 0.2 * 0.1, 1e-9);
    ck_assert(volume.greatest - volume.least < 1e-9 && !volume.exact);
    /* of another point, which the top carries with it: the block is moved, and no bound of the extent */
    const double orientation[3] = {0.1, -0.2, 0.3};
    for (int k = 0; k < 3; k++) reach.about[k] = 0.2 * k;
    for (int v = 0; v < GOUGH_LEGS; v++) reach.limits.length[v][1] = 4;
    ck_assert(gough_workspace_volume(&reach, orientation, &volume, NULL) == GOUGH_OK);
    ck_assert(volume.least <= 8 * 0.3 * 0.2 * 0.1 && volume.greatest >= 8 * 0.3 * 0.2 * 0.1);
    ck_assert_double_eq_tol(volume.value, 8 * 0.3 * 0.2 * 0.1, 0.05 * volume.value);
    model->workspace.about_given = true, model->workspace.about[1] = 0.4;
    reach = flight_reach(model);
    ck_assert_double_eq_tol(reach.about[1], 0.4, 1e-15);
    free(model);
}
END_TEST

/* ---- one limit at a time, against worst values of single poses ---- */

enum { ONLY_SPEED, ONLY_ACCELERATION, ONLY_PUSH, ONLY_PULL, ONLY_VALUE, ONLY_CLEARANCE, ONLYS };
static const gough_worst measured[ONLYS] = {GOUGH_WORST_SPEED,          GOUGH_WORST_ACCELERATION,
                                            GOUGH_WORST_PUSH,           GOUGH_WORST_PULL,
                                            GOUGH_WORST_SINGULAR_VALUE, GOUGH_WORST_CLEARANCE};

/* a single limit, so that a value is `spare` inside of it */
static void set_only(gough_reach *reach, int only, double value, double spare) {
    for (int v = 0; v < GOUGH_LEGS; v++) {
        gough_limits *l = &reach->limits;
        if (only == ONLY_SPEED) l->speed[v] = value * (1 + spare);
        if (only == ONLY_ACCELERATION) l->acceleration[v] = value * (1 + spare);
        if (only == ONLY_PUSH) l->force[v][1] = value * (1 + spare);
        if (only == ONLY_PULL) l->force[v][0] = value - fabs(value) * spare;
        if (only == ONLY_CLEARANCE) l->diameter[v] = value * (1 - spare);
    }
    if (only == ONLY_VALUE) reach->asked.least_singular_value = value * (1 - spare);
}

START_TEST(each_limit_by_itself_is_that_of_the_worst_value) {
    gough_model *model = calloc(1, sizeof *model);
    dice d = {81};
    flight_demands(model);
    for (int n = 0; n < 60; n++) {
        const int only = n % ONLYS;
        gough_reach reach = unlimited(model);
        gough_binding binding;
        gough_envelope e;
        gough_box one;
        set_only(&reach, -1, 0, 0);
        for (int v = 0; v < GOUGH_LEGS; v++) {
            gough_limits *l = &reach.limits;
            l->speed[v] = l->acceleration[v] = l->force[v][1] = INFINITY;
            l->force[v][0] = -INFINITY, l->diameter[v] = 0;
        }
        for (int c = 0; c < GOUGH_COMPONENTS; c++)
            one.least[c] = one.greatest[c] = dice_between(&d, -0.2, 0.2);
        ck_assert(gough_workspace_envelope(&reach, &one, &e, NULL) == GOUGH_OK);
        const gough_extreme *x = &e.of[measured[only]];
        set_only(&reach, only, x->bound, 1e-9);
        ck_assert_msg(gough_box_test(&reach, &one, NULL) == GOUGH_INSIDE, "limit %d at pose %d",
                      only, n);
        set_only(&reach, only, x->sampled, -1e-9);
        ck_assert_msg(gough_box_test(&reach, &one, &binding) == GOUGH_OUTSIDE,
                      "limit %d at pose %d", only, n);
        /* a volume that nothing limits but this and long legs is decided too */
        gough_volume volume;
        for (int v = 0; v < GOUGH_LEGS; v++) reach.limits.length[v][1] = 3.2;
        set_only(&reach, only, x->sampled, 0.2);
        reach.most_tests = 1200;
        if (n < ONLYS) {
            ck_assert(gough_workspace_volume(&reach, home, &volume, NULL) == GOUGH_OK);
            ck_assert(volume.least <= volume.value && volume.value <= volume.greatest);
            ck_assert(!volume.exact && volume.greatest > 0);
        }
    }
    free(model);
}
END_TEST

/* a known load, in axes of the base or of the top, on a point or at the centre of mass, by the dynamics of a single state */
START_TEST(known_loads_count_among_the_forces) {
    gough_model *model = calloc(1, sizeof *model);
    dice d = {82};
    for (int n = 0; n < 20; n++) {
        gough_external load = {.at_given = n & 1, .turns = n & 2};
        gough_envelope e;
        const gough_acceleration still = {{0, 0, 0}, {0, 0, 0}};
        gough_wrench wrench;
        gough_state s;
        gough_box one;
        double force[GOUGH_LEGS], most = -INFINITY, least = INFINITY;
        flight_machine(model);
        for (int k = 0; k < 3; k++) {
            load.force[k] = gough_formula_constant(dice_between(&d, -3e4, 3e4));
            load.moment[k] = gough_formula_constant(dice_between(&d, -3e4, 3e4));
            load.at[k] = dice_between(&d, -1, 1);
        }
        for (int c = 0; c < GOUGH_COMPONENTS; c++)
            one.least[c] = one.greatest[c] = dice_between(&d, -0.2, 0.2);
        model->machine.externals = 1, model->machine.external = &load;
        const gough_reach reach = flight_reach(model);
        flight_state(model, one.least, &s);
        ck_assert(gough_external_wrench(&model->machine, &s, 0, &wrench) == GOUGH_OK);
        ck_assert(gough_inverse_dynamics(&model->machine, &s, &still, &wrench, force, NULL) ==
                  GOUGH_OK);
        for (int v = 0; v < GOUGH_LEGS; v++)
            most = fmax(most, force[v]), least = fmin(least, force[v]);
        ck_assert(gough_workspace_envelope(&reach, &one, &e, NULL) == GOUGH_OK);
        ck_assert_double_eq_tol(e.of[GOUGH_WORST_PUSH].sampled, most, 1e-9 * 3e4);
        ck_assert_double_eq_tol(e.of[GOUGH_WORST_PULL].sampled, least, 1e-9 * 3e4);
        ck_assert(e.of[GOUGH_WORST_PUSH].bound >= most && e.of[GOUGH_WORST_PULL].bound <= least);
    }
    free(model);
}
END_TEST

/* ---- machines of which legs meet ---- */

/* three joints of the base and three of the top, each with two legs: these are not tested for clearance, the others are */
START_TEST(legs_that_share_a_joint_are_not_tested) {
    gough_model *model = calloc(1, sizeof *model);
    gough_platform p = gough_platform_symmetric(1.2, 10 * pi / 180, 0.9, 10 * pi / 180, 1);
    gough_envelope e;
    double least = INFINITY;
    const gough_box one = {{0.05, 0, 0.1, 0.1, 0, 0}, {0.05, 0, 0.1, 0.1, 0, 0}};
    for (int v = 0; v < GOUGH_LEGS; v++) {
        const int at = v / 2, end = (v + 1) % 6 / 2;
        const double a = at * 2 * pi / 3, b = end * 2 * pi / 3 - pi / 3;
        p.base[v][0] = 1.2 * cos(a), p.base[v][1] = 1.2 * sin(a);
        p.top[v][0] = 0.9 * cos(b), p.top[v][1] = 0.9 * sin(b);
        p.legs.diameter[v] = 0.05;
    }
    machine_of(model, &p);
    const gough_reach reach = flight_reach(model);
    ck_assert_int_eq(gough_box_test(&reach, &one, NULL), GOUGH_INSIDE);
    ck_assert(gough_workspace_envelope(&reach, &one, &e, NULL) == GOUGH_OK);
    for (int v = 0; v < GOUGH_LEGS; v++)
        for (int w = v + 1; w < GOUGH_LEGS; w++)
            if (v / 2 != w / 2 && (v + 1) % 6 / 2 != (w + 1) % 6 / 2)
                least = fmin(least, flight_distance(model, one.least, v, w) - 0.05);
    ck_assert_double_eq_tol(e.of[GOUGH_WORST_CLEARANCE].sampled, least, 1e-3);
    ck_assert(e.of[GOUGH_WORST_CLEARANCE].sampled > 0.1);
    free(model);
}
END_TEST

/* one leg upright, another level: they cross at right angles, in numbers without rounding */
START_TEST(legs_that_cross_have_no_distance) {
    gough_model *model = calloc(1, sizeof *model);
    gough_platform p = gough_platform_symmetric(3, 8 * pi / 180, 2, 10 * pi / 180, 2);
    const double base[2][3] = {{0, 0, 0}, {-1, 0, 1}}, top[2][3] = {{0, 0, 0}, {1, 0, -1}};
    for (int v = 0; v < 2; v++)
        memcpy(p.base[v], base[v], sizeof base[v]), memcpy(p.top[v], top[v], sizeof top[v]);
    machine_of(model, &p);
    const gough_reach reach = flight_reach(model);
    const gough_box one = {{0}, {0}};
    taylor_vector n[LEGS];
    box_view view;
    space s;
    double bound[2];
    space_begin(&s, &reach);
    box_view_of(&s, &one, &view);
    for (int v = 0; v < LEGS; v++) n[v] = box_direction(&view, v);
    clearance_of(&s, &view, n, 0, 1, INFINITY, bound);
    ck_assert(bound[0] >= 0 && bound[0] <= 0 && bound[1] < 1e-12);
    free(model);
}
END_TEST

/* ---- numbers without a bound ---- */

/* 0 · ∞ is no bound: what has none keeps none, whatever it is multiplied by */
START_TEST(what_has_no_bound_keeps_none) {
    const taylor none = taylor_inverse((taylor){.c = 1, .g = {2}, .varies = true}),
                 root = taylor_root((taylor){.c = -1, .varies = true}), zero = taylor_of(0);
    const taylor all[] = {taylor_times(zero, none), taylor_times(none, zero), taylor_scale(0, none),
                          taylor_add(none, root),   taylor_times(none, none), taylor_inverse(none),
                          taylor_root(none),        taylor_times(root, zero)};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        ck_assert_msg(isfinite(all[i].c) && !(all[i].r < INFINITY) && !isnan(all[i].r),
                      "number %zu", i);
        ck_assert(!(taylor_least(&all[i]) > -INFINITY) && !(taylor_most(&all[i]) < INFINITY));
        ck_assert(!isnan(taylor_least(&all[i])) && !isnan(taylor_most(&all[i])));
    }
    ck_assert(!(bound_of(1, NAN) < INFINITY) && !(bound_of(INFINITY, 1) < INFINITY));
}
END_TEST

/* a cell with a base joint in it: the leg has no length there and no direction, so no limit of swing is known to be kept. The leg
 * lies in a plane x = const, where 0 · ∞ came out as a bound. */
START_TEST(cells_around_a_joint_keep_no_swing) {
    gough_model *model = calloc(1, sizeof *model);
    gough_platform p = gough_platform_symmetric(1, 8 * pi / 180, 0.8, 10 * pi / 180, 1);
    const double a[3] = {0.5, 0.25, 0}, b[3] = {0.5, 0.5, 0};
    memcpy(p.base[0], a, sizeof a), memcpy(p.top[0], b, sizeof b);
    machine_of(model, &p);
    gough_reach reach = unlimited(model);
    reach.limits.base_swing[0] = 0.3;
    /* brings top joint 1 to its base joint */
    const gough_box box = {{-0.25, -0.5, -1.25, 0, 0, 0}, {0.25, 0, -0.75, 0, 0, 0}};
    box_view view;
    space s;
    space_begin(&s, &reach);
    box_view_of(&s, &box, &view);
    s.parts_wanted = true;
    const judge j = box_judge(&s, &view);
    ck_assert_int_ne(j.verdict, GOUGH_INSIDE);
    ck_assert_msg(!(j.in > 0) && !(j.out > 0), "%g, %g", j.in, j.out);
    ck_assert(isfinite(box_direction(&view, 0).x[0].c));
    free(model);
}
END_TEST

/* a way through a singular pose: forces have no bound, however often it is halved */
START_TEST(forces_have_no_bound_through_a_singular_pose) {
    gough_model *model = calloc(1, sizeof *model);
    const gough_platform p = gough_platform_symmetric(1, 10 * pi / 180, 0.6, 10 * pi / 180, 0.7);
    const gough_box box = {{0, 0, 0, 0, 0, 0}, {0, 0, 0, 0, 0, 2}};
    gough_error error = {0};
    gough_envelope e;
    machine_of(model, &p);
    gough_reach reach = flight_reach(model);
    ck_assert_int_eq(gough_workspace_envelope(&reach, &box, &e, &error), GOUGH_ERROR_NUMERICAL);
    ck_assert_ptr_nonnull(strstr(error.message, "may contain a singular pose"));
    ck_assert(!isfinite(e.of[GOUGH_WORST_PUSH].bound) && isfinite(e.of[GOUGH_WORST_LONGEST].bound));
    ck_assert(e.of[GOUGH_WORST_SINGULAR_VALUE].bound <= 0);
    gough_certificate found;
    reach.asked.least_singular_value = 0;
    ck_assert(gough_box_certify(&reach, &box, &found, NULL) == GOUGH_OK);
    ck_assert_int_eq(found.verdict, GOUGH_OUTSIDE);
    free(model);
}
END_TEST

/* ---- searches that may not test enough ---- */

START_TEST(searches_give_up_when_their_tests_are_used) {
    gough_model *model = flight();
    gough_reach reach = flight_reach(model);
    const gough_box shape = {{-1, -1, -1, -0.3, -0.3, -0.3}, {1, 1, 1, 0.3, 0.3, 0.3}};
    gough_largest_box largest;
    gough_certificate found;
    gough_travel travel;
    gough_volume volume;
    gough_box part = shape;
    ck_assert(gough_workspace_box(&reach, &shape, &largest, NULL) == GOUGH_OK);
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        part.least[c] = largest.box.least[c] * 0.999;
        part.greatest[c] = largest.box.greatest[c] * 0.999;
    }
    reach.most_tests = 20;
    ck_assert(gough_box_certify(&reach, &part, &found, NULL) == GOUGH_OK);
    ck_assert_int_eq(found.verdict, GOUGH_UNDECIDED);
    ck_assert(found.binding.bind != GOUGH_BIND_NONE && found.tests < 100);
    ck_assert(gough_workspace_travel(&reach, 0, &travel, NULL) == GOUGH_OK);
    ck_assert(travel.tests <= 41 && travel.end[1] > 0 && travel.end[1] < 2);
    const double upper = largest.upper;
    ck_assert(gough_workspace_box(&reach, &shape, &largest, NULL) == GOUGH_OK);
    ck_assert(largest.scale <= 0 && fabs(largest.upper - upper) < 1e-3 * upper);
    reach.most_tests = 1200;
    ck_assert(gough_workspace_box(&reach, &shape, &largest, NULL) == GOUGH_OK);
    ck_assert_msg(largest.scale > 0 && largest.scale < upper, "%g of %g", largest.scale, upper);
    reach.most_tests = 10;
    ck_assert(gough_workspace_volume(&reach, home, &volume, NULL) == GOUGH_OK);
    ck_assert(volume.least < volume.value && volume.value < volume.greatest);
    free(model);
}
END_TEST

int main(void) {
    return SUITE_RUN(
        "degenerate", 60, numbers_out_of_range_are_refused_by_their_key,
        questions_that_are_none_are_refused, home_outside_names_its_limit,
        a_machine_that_is_singular_at_home_has_no_workspace, limits_of_components_may_have_one_side,
        without_limits_a_search_ends_by_itself,
        limits_of_the_platform_alone_have_a_block_for_volume,
        each_limit_by_itself_is_that_of_the_worst_value, known_loads_count_among_the_forces,
        legs_that_share_a_joint_are_not_tested, legs_that_cross_have_no_distance,
        what_has_no_bound_keeps_none, cells_around_a_joint_keep_no_swing,
        forces_have_no_bound_through_a_singular_pose, searches_give_up_when_their_tests_are_used);
}
