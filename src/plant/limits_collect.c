/* The limits that apply to a machine, each leg and each component of the platform by itself, and the checks of those given. */
#include <math.h>
#include <string.h>

#include "gough/sizes.h"
#include "plant/limits_check.h"

static const double HALF_TURN = 3.14159265358979323846;

/* a pair of zeros is no limit */
static bool is_given(const double pair[2]) { return fabs(pair[0]) > 0 || fabs(pair[1]) > 0; }

static void copy_pair(double to[2], const double from[2]) { to[0] = from[0], to[1] = from[1]; }

/* ---- what applies ---- */

static void collect_leg(const gough_machine *machine, int v, gough_limits *l) {
    const gough_platform *p = &machine->platform;
    const gough_leg_limits *leg = &p->legs;
    const double force = leg->max_force[v] > 0 ? leg->max_force[v] : p->force_max;
    const double home = machine->home_length[v];

    copy_pair(l->length[v], (double[]){p->length_min, p->length_max});
    if (is_given(leg->stroke[v]))
        copy_pair(l->length[v], (double[]){home + leg->stroke[v][0], home + leg->stroke[v][1]});
    if (is_given(leg->length[v])) copy_pair(l->length[v], leg->length[v]);

    copy_pair(l->force[v], (double[]){-force, force});
    if (is_given(leg->force[v])) copy_pair(l->force[v], leg->force[v]);

    l->speed[v] = leg->speed[v] > 0 ? leg->speed[v] : p->speed_max;
    l->acceleration[v] = leg->acceleration[v] > 0 ? leg->acceleration[v] : INFINITY;
    l->base_swing[v] = leg->base_swing[v] > 0 ? leg->base_swing[v] : INFINITY;
    l->top_swing[v] = leg->top_swing[v] > 0 ? leg->top_swing[v] : INFINITY;
    l->diameter[v] = leg->diameter[v];
}

static void collect_components(const double given[GOUGH_COMPONENTS][2],
                               double limit[GOUGH_COMPONENTS][2]) {
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        copy_pair(limit[c], (double[]){-INFINITY, INFINITY});
        if (is_given(given[c])) copy_pair(limit[c], given[c]);
    }
}

gough_status gough_limits_collect(const gough_machine *machine, const gough_motion *motion,
                                  gough_limits *limits, size_t size) {
    const gough_platform_limits *p = &machine->platform.limits;

    if (size != sizeof *limits) return gough_size_refuse(limits, size);
    for (int v = 0; v < GOUGH_LEGS; v++) collect_leg(machine, v, limits);
    collect_components(p->pose, limits->pose);
    collect_components(p->speed, limits->rate);
    collect_components(p->acceleration, limits->second_rate);
    memcpy(limits->about, p->about_given ? p->about : motion->about, sizeof limits->about);
    return GOUGH_OK;
}

/* ---- checks ---- */

#define FAIL(error, key, ...) gough_fail_key(error, GOUGH_ERROR_INPUT, key, __VA_ARGS__)

/* A pair of limits: finite, and the least below the greatest. `whose`: "leg 3", "heave". */
static gough_status check_pair(const double pair[2], const char *key, const char *whose,
                               gough_error *error) {
    if (!is_given(pair)) return GOUGH_OK;
    if (!isfinite(pair[0]) || !isfinite(pair[1]))
        return FAIL(error, key, "the limits of %s must be finite, not %g and %g", whose, pair[0],
                    pair[1]);
    if (!(pair[0] < pair[1]))
        return FAIL(error, key, "the least limit of %s, %g, must be below the greatest, %g", whose,
                    pair[0], pair[1]);
    return GOUGH_OK;
}

/* one number: 0 for none, else positive and at most `most` */
static gough_status check_one(double x, double most, const char *key, const char *whose,
                              gough_error *error) {
    if (x >= 0 && x <= most && isfinite(x)) return GOUGH_OK;
    if (isfinite(most))
        return FAIL(error, key, "the limit of %s must be an angle from 0 to pi, not %g", whose, x);
    return FAIL(error, key, "the limit of %s must be positive and finite, or 0 for none, not %g",
                whose, x);
}

static const char *leg_name(int v) {
    static const char *const name[GOUGH_LEGS] = {"leg 1", "leg 2", "leg 3",
                                                 "leg 4", "leg 5", "leg 6"};
    return name[v];
}

static gough_status check_length(const gough_leg_limits *leg, int v, double home,
                                 gough_error *error) {
    const char *const length = "platform.legs.length", *const stroke = "platform.legs.stroke";
    gough_status status = check_pair(leg->length[v], length, leg_name(v), error);

    if (status == GOUGH_OK) status = check_pair(leg->stroke[v], stroke, leg_name(v), error);
    if (status != GOUGH_OK) return status;
    if (is_given(leg->length[v]) && is_given(leg->stroke[v]))
        return FAIL(error, stroke, "leg %d has limits of its length and of its stroke: give one",
                    v + 1);
    if (leg->length[v][0] < 0)
        return FAIL(error, length, "the least length of leg %d must be 0 or positive, not %g",
                    v + 1, leg->length[v][0]);
    if (home + leg->stroke[v][0] < 0)
        return FAIL(error, stroke,
                    "the stroke of leg %d begins at %g, but its length at home is only %g", v + 1,
                    leg->stroke[v][0], home);
    return GOUGH_OK;
}

/* how far something may be from its place or value */
static gough_status check_tolerance(double x, const char *key, const char *what, int v,
                                    gough_error *error) {
    if (x >= 0 && isfinite(x)) return GOUGH_OK;
    return FAIL(error, key, "the %s of %s must be 0 or positive and finite, not %g", what,
                leg_name(v), x);
}

static gough_status check_leg(const gough_leg_limits *leg, int v, double home, gough_error *error) {
    const struct {
        double x, most;
        const char *key;
    } one[] = {{leg->speed[v], INFINITY, "platform.legs.max_speed"},
               {leg->max_force[v], INFINITY, "platform.legs.max_force"},
               {leg->acceleration[v], INFINITY, "platform.legs.max_acceleration"},
               {leg->diameter[v], INFINITY, "platform.legs.diameter"},
               {leg->base_swing[v], HALF_TURN, "platform.joints.base_swing"},
               {leg->top_swing[v], HALF_TURN, "platform.joints.top_swing"}};
    gough_status status = check_length(leg, v, home, error);

    if (status == GOUGH_OK)
        status = check_pair(leg->force[v], "platform.legs.force", leg_name(v), error);
    for (size_t i = 0; i < sizeof one / sizeof one[0] && status == GOUGH_OK; i++)
        status = check_one(one[i].x, one[i].most, one[i].key, leg_name(v), error);
    if (status == GOUGH_OK && is_given(leg->force[v]) && leg->max_force[v] > 0)
        return FAIL(error, "platform.legs.max_force",
                    "leg %d has both limits of its force and a greatest one: give one", v + 1);
    return status;
}

gough_status limits_check(const gough_platform *platform, const double home_length[GOUGH_LEGS],
                          gough_error *error) {
    const gough_platform_limits *p = &platform->limits;
    gough_status status = GOUGH_OK;

    for (int v = 0; v < GOUGH_LEGS && status == GOUGH_OK; v++)
        status = check_leg(&platform->legs, v, home_length[v], error);
    for (int v = 0; v < GOUGH_LEGS && status == GOUGH_OK; v++) {
        const gough_tolerances *t = &platform->tolerances;
        status = check_tolerance(t->joint[v], "platform.joints.tolerance",
                                 "tolerance of the joints", v, error);
        if (status == GOUGH_OK)
            status =
                check_tolerance(t->length[v], "pose.length_error", "error of the length", v, error);
    }
    for (int c = 0; c < GOUGH_COMPONENTS && status == GOUGH_OK; c++) {
        const char *const name = gough_component_name(c);
        status = check_pair(p->pose[c], "platform.limits", name, error);
        if (status == GOUGH_OK)
            status = check_pair(p->speed[c], "platform.limits.speed", name, error);
        if (status == GOUGH_OK)
            status = check_pair(p->acceleration[c], "platform.limits.acceleration", name, error);
    }
    for (int a = 0; a < 3 && status == GOUGH_OK; a++)
        if (!isfinite(p->about[a]))
            return FAIL(error, "platform.limits.about",
                        "the point that the platform's limits concern is not finite");
    return status;
}
