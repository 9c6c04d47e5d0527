/* Designs at the edge of what can be searched for: worst poses between the corners of the box, which only a certificate finds;
 * requirements that no design meets; starts without a value; and what is refused.
 * Label: standard. */
#include <math.h>
#include <string.h>

#include "design/jack.h"
#include "support/suite.h"

static jack one;

/* ---- models of the table that goes up and down, changed after they are made ---- */

typedef void changer(jack *j);
static changer *change;

static gough_status make_changed(void *context, const double *value, const gough_model **model,
                                 gough_error *error) {
    gough_design_request plain = jack_request(&(jack){.longest = 0});
    jack *j = context;
    gough_design_maker *make = plain.make;
    const gough_status status = make(j, value, model, error);
    if (!status) change(j);
    return status;
}

static gough_design_request changed_request(changer *by) {
    gough_design_request r = jack_request(&one);
    change = by;
    r.make = make_changed;
    return r;
}

static void weightless(jack *j) { memset(j->model.machine.gravity, 0, 3 * sizeof(double)); }
static void endless(jack *j) { j->model.workspace.box[GOUGH_YAW][1] = INFINITY; }
static void aside(jack *j) { j->model.workspace.box[GOUGH_YAW][0] = 0.1; }
static void below(jack *j) { j->model.workspace.box[GOUGH_YAW][1] = -0.1; }
static void through_singular(jack *j) {
    j->model.workspace.box[GOUGH_YAW][0] = -2, j->model.workspace.box[GOUGH_YAW][1] = 2;
}
static void up_to_singular(jack *j) {
    j->model.workspace.box[GOUGH_YAW][0] = -1.5, j->model.workspace.box[GOUGH_YAW][1] = 1.5;
}
static void pulled(jack *j) {
    j->model.workspace.acceleration[2] = 15;
    for (int v = 0; v < GOUGH_LEGS; v++) {
        j->model.machine.platform.legs.force[v][0] = -400;
        j->model.machine.platform.legs.force[v][1] = INFINITY;
        j->model.machine.platform.legs.top_swing[v] = 0.2;
    }
}

/* ---- worst poses between corners ---- */

/* A table that turns: its legs are shortest where the yaw brings a top joint over its base joint, within the box. Numbers: the
 * radius of the base, of which the top has a part. */
static const double PART = 0.7, HEIGHT = 1, TWIST = 25 * pi / 180;
typedef struct turning {
    gough_model model;
    double least; /* length of the legs */
} turning;

static gough_status make_turning(void *context, const double *value, const gough_model **model,
                                 gough_error *error) {
    turning *t = context;
    gough_platform p =
        gough_platform_symmetric(value[0], 20 * pi / 180, PART * value[0], 15 * pi / 180, HEIGHT);
    const gough_load load = {.mass = 1, .inertia = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    const double gravity[3] = {0, 0, -1};
    for (int v = 0; v < GOUGH_LEGS; v++) p.legs.length[v][0] = t->least, p.legs.length[v][1] = 10;
    memset(&t->model.motion, 0, sizeof t->model.motion);
    t->model.workspace = (gough_workspace){.box = {[GOUGH_YAW] = {-1.6 * TWIST, 1.6 * TWIST}}};
    *model = &t->model;
    return gough_machine_init(&t->model.machine, &p, &load, gravity, error);
}

/* the least footprint is where the legs over their base joints have their least length, √(h² + (1 − part)² r²); at the corners
 * they are longer */
START_TEST(poses_between_corners_are_found_by_the_certificate) {
    static turning t = {.least = 1.02};
    gough_design_request r = gough_design_request_default();
    gough_design_result d;
    gough_error error = {.message = ""};
    r.keys = 1, r.least[0] = 0.3, r.greatest[0] = 2, r.start[0] = 1;
    r.make = make_turning, r.context = &t;
    r.evaluations = 100;
    memset(r.weight, 0, sizeof r.weight);
    r.weight[GOUGH_AIM_FOOTPRINT] = 1;
    ck_assert_msg(gough_design(&r, &d, &error) == GOUGH_OK, "%s", error.message);
    const double best = sqrt(1.02 * 1.02 - HEIGHT * HEIGHT) / (1 - PART);
    ck_assert_msg(d.value[0] >= best && d.value[0] < 1.03 * best, "%.9g, best %.9g", d.value[0],
                  best);
    ck_assert(d.found && d.certificate.verdict == GOUGH_INSIDE && d.evaluations > 100);
    ck_assert_int_eq(d.active[0].binding.bind, GOUGH_BIND_SHORTEST);
}
END_TEST

/* ---- what no design meets ---- */

static gough_design_result unmet(const gough_design_request *r, const char *part) {
    gough_design_result d;
    gough_error error = {.message = ""};
    ck_assert_int_eq(gough_design(r, &d, &error), GOUGH_ERROR_NUMERICAL);
    ck_assert_msg(strstr(error.message, part) != NULL, "'%s' lacks '%s'", error.message, part);
    ck_assert(!d.found);
    return d;
}

START_TEST(a_box_through_a_singular_pose_is_met_by_no_design) {
    gough_design_request r = changed_request(through_singular);
    const gough_design_result d = unmet(&r, "a pose of it is singular");
    ck_assert(!(d.excess < INFINITY) && d.scale > 0.5 && d.scale < 0.8);
}
END_TEST

START_TEST(a_greater_singular_value_than_there_is_is_met_by_no_design) {
    gough_design_request r = jack_request(&one);
    r.least_singular_value = 1.5;
    const gough_design_result d = unmet(&r, "the nearest exceed a limit");
    ck_assert(d.excess > 0 && d.excess < 1 && d.scale <= 0);
    ck_assert_int_eq(d.certificate.binding.bind, GOUGH_BIND_SINGULAR_VALUE);
}
END_TEST

START_TEST(a_box_beside_a_singular_pose_is_certified_or_said_not_to_be) {
    gough_design_request r = changed_request(up_to_singular);
    gough_design_result d;
    gough_error error = {.message = ""};
    const gough_status status = gough_design(&r, &d, &error);
    ck_assert(status == GOUGH_OK ? d.certificate.verdict == GOUGH_INSIDE
                                 : strstr(error.message, "could not be certified") != NULL);
}
END_TEST

/* ---- starts without a value ---- */

START_TEST(a_start_without_its_aim_is_refused_or_searched_from) {
    gough_design_request r = jack_request(&one);
    gough_design_result d;
    gough_error error = {.message = ""};
    /* at height 0 the machine is flat, and singular */
    r.start[0] = 0;
    ck_assert_msg(gough_design(&r, &d, &error) == GOUGH_OK, "%s", error.message);
    ck_assert(d.found && isnan(d.objective[0]) && isnan(d.aim[GOUGH_AIM_FORCE][0]));
    ck_assert(!d.start_meets && d.aim[GOUGH_AIM_FORCE][1] > 0);
    r.weight[GOUGH_AIM_STROKE] = 1;
    ck_assert_int_eq(gough_design(&r, &d, &error), GOUGH_ERROR_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "is not finite, as a pose is singular"));
    r = changed_request(weightless);
    ck_assert_int_eq(gough_design(&r, &d, &error), GOUGH_ERROR_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "the force of the study as written is 0"));
    r = jack_request(&one), one.refuse_above = 0.9;
    ck_assert_int_eq(gough_design(&r, &d, &error), GOUGH_ERROR_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "the height 1 is refused"));
}
END_TEST

/* a pull that falls with the height binds from below */
START_TEST(limits_of_force_and_swing_bind) {
    gough_design_request r = changed_request(pulled);
    gough_design_result d;
    gough_error error = {.message = ""};
    memset(r.weight, 0, sizeof r.weight);
    r.weight[GOUGH_AIM_STROKE] = 1;
    r.evaluations = 0;
    ck_assert_msg(gough_design(&r, &d, &error) == GOUGH_OK, "%s", error.message);
    ck_assert_uint_ge(d.evaluations, 300);
    /* the certificate is about the limit; the bound of the worst value lies within 1 % of the value */
    ck_assert(d.envelope.of[GOUGH_WORST_PULL].sampled >= -400 &&
              d.envelope.of[GOUGH_WORST_PULL].bound >= -404.5);
    ck_assert(d.actives > 0);
    memset(r.weight, 0, sizeof r.weight);
    r.weight[GOUGH_AIM_FOOTPRINT] = 1;
    r.evaluations = 10;
    ck_assert_msg(gough_design(&r, &d, &error) == GOUGH_OK, "%s", error.message);
}
END_TEST

/* ---- what is refused ---- */

START_TEST(numbers_that_are_not_finite_are_refused) {
    gough_design_request r = jack_request(&one);
    r.greatest[0] = INFINITY;
    jack_refuse(r, "two finite bounds");
    r = jack_request(&one), r.least[0] = -1e308, r.greatest[0] = 1e308;
    jack_refuse(r, "two finite bounds");
    r = jack_request(&one), r.weight[2] = INFINITY;
    jack_refuse(r, "design.minimize must have weights");
    r = jack_request(&one), r.telescope = INFINITY;
    jack_refuse(r, "design.telescope must be 0 or greater");
    r = jack_request(&one), r.least_singular_value = INFINITY;
    jack_refuse(r, "design.least_singular_value must be 0 or greater");
    r = jack_request(&one), r.least_singular_value = -1;
    jack_refuse(r, "design.least_singular_value must be 0 or greater");
    r = jack_request(&one), r.evaluations = 1000001;
    jack_refuse(r, "design.evaluations must be from 10 to 1000000");
    jack_refuse(changed_request(endless), "workspace.box is missing or is no box about home");
    jack_refuse(changed_request(aside), "workspace.box is missing or is no box about home");
    jack_refuse(changed_request(below), "workspace.box is missing or is no box about home");
    ck_assert(gough_design_request_init(&r, 8) != GOUGH_OK);
    ck_assert_str_eq(gough_aim_name(GOUGH_AIMS), "unknown");
    ck_assert_str_eq(gough_active_name(GOUGH_ACTIVE_KINDS), "unknown");
}
END_TEST

/* ---- stopped ---- */

static int stop_late(void *context, double part) {
    (void)part;
    return one.made > *(size_t *)context;
}

/* wherever a search is stopped, it ends soon and says so */
START_TEST(a_search_stops_wherever_it_is) {
    for (size_t made = 20; made < 260; made += 60) {
        gough_design_request r = jack_request(&one);
        gough_design_result d;
        gough_error error = {.message = ""};
        one.made = 0;
        r.evaluations = 200;
        r.progress = stop_late, r.progress_context = &made;
        const gough_status status = gough_design(&r, &d, &error);
        ck_assert(status == GOUGH_OK || strcmp(error.message, "the search was stopped") == 0);
        if (status != GOUGH_OK) ck_assert_uint_le(one.made, made + 60);
    }
}
END_TEST

int main(void) {
    return SUITE_RUN("unmet", 60, poses_between_corners_are_found_by_the_certificate,
                     a_box_through_a_singular_pose_is_met_by_no_design,
                     a_greater_singular_value_than_there_is_is_met_by_no_design,
                     a_box_beside_a_singular_pose_is_certified_or_said_not_to_be,
                     a_start_without_its_aim_is_refused_or_searched_from,
                     limits_of_force_and_swing_bind, numbers_that_are_not_finite_are_refused,
                     a_search_stops_wherever_it_is);
}
