/* The limits of a study: each quantity of the legs for all of them or for each, each component of the platform. */
#include "cli/check/check_limits.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/common/json.h"
#include "cli/common/scale.h"

/* ---- what limits there are ---- */

#define LEGS(member, label_, sides_, unit_)                                                        \
    { #member, label_, offsetof(gough_limits, member), sides_, unit_ }

/* Of the legs: the key in the JSON, the name, the place of six numbers or pairs. */
static const struct {
    const char *key, *label;
    size_t at;
    int sides;
    gough_unit unit;
} leg_limits[] = {LEGS(length, "length limits", 2, GOUGH_UNIT_LENGTH),
                  LEGS(speed, "greatest speed", 1, GOUGH_UNIT_SPEED),
                  LEGS(force, "force limits", 2, GOUGH_UNIT_FORCE),
                  LEGS(acceleration, "greatest accel.", 1, GOUGH_UNIT_ACCELERATION),
                  LEGS(base_swing, "swing at base", 1, GOUGH_UNIT_ANGLE),
                  LEGS(top_swing, "swing at top", 1, GOUGH_UNIT_ANGLE)};
enum { FORCE_LIMITS = 2, LEG_LIMITS = sizeof leg_limits / sizeof leg_limits[0] };

/* Of the platform: six pairs, of which the last three are of angles. */
static const struct {
    const char *key, *label;
    size_t at;
    gough_unit unit, turning;
} platform_limits[] = {
    {"pose", "", offsetof(gough_limits, pose), GOUGH_UNIT_LENGTH, GOUGH_UNIT_ANGLE},
    {"speed", " velocity", offsetof(gough_limits, rate), GOUGH_UNIT_SPEED,
     GOUGH_UNIT_ANGULAR_SPEED},
    {"acceleration", " accel.", offsetof(gough_limits, second_rate), GOUGH_UNIT_ACCELERATION,
     GOUGH_UNIT_ANGULAR_ACCELERATION}};
enum { PLATFORM_LIMITS = sizeof platform_limits / sizeof platform_limits[0] };

static gough_limits limits_in_study(const gough_study *study) {
    return gough_limits_of(&study->model->machine, &study->model->motion);
}

static const double *numbers_at(const gough_limits *l, size_t at) {
    return (const double *)(const void *)((const char *)l + at);
}

/* 0 is no limit of a length, whose least value it is */
static bool is_given(const double *bound, int sides, bool length) {
    return isfinite(bound[sides - 1]) || (length && bound[0] > 0);
}

static double factor_of(const gough_study *study, gough_unit unit) {
    return gough_unit_factor(&study->units, unit);
}

/* ---- for reading ---- */

/* whether a pair has the same limit on both sides */
static bool is_even(const double bound[2]) {
    return bound[0] < 0 && !(bound[0] + bound[1] < 0 || bound[0] + bound[1] > 0);
}

/* "0.5 to 0.8", "±80", "6" without its unit */
static void print_bound(const double *bound, int sides, double factor) {
    const double low = factor * bound[0], high = factor * bound[sides - 1];
    if (sides == 1)
        printf("%.6g", high);
    else if (is_even(bound))
        printf("±%.6g", high);
    else
        printf("%.6g to %.6g", low, high);
}

/* The bounds of six legs, once if they are alike. Returns whether there are any. */
static bool print_leg_limit(const gough_limits *l, int k, double factor, const char *unit) {
    const int sides = leg_limits[k].sides;
    const double *bound = numbers_at(l, leg_limits[k].at);
    bool alike = true, given = false, even = k == FORCE_LIMITS;
    for (int v = 0; v < GOUGH_LEGS; v++) {
        even = even && is_even(bound + sides * v);
        given = given || is_given(bound + sides * v, sides, k == 0);
        for (int i = 0; i < sides; i++)
            alike = alike && nearly_same(bound[sides * v + i], bound[i]);
    }
    if (!given) return false;
    printf("  %-20s ", even ? "greatest force" : leg_limits[k].label);
    for (int v = 0; v < (alike ? 1 : GOUGH_LEGS); v++) {
        if (v) printf(v == 3 && sides == 2 ? ",\n                       " : ", ");
        if (is_given(bound + sides * v, sides, k == 0))
            print_bound(bound + sides * v + even, even ? 1 : sides, factor);
        else
            printf("none");
    }
    printf("%s\n", unit);
    return true;
}

static bool print_platform_limits(const gough_study *study, const gough_limits *l, int k,
                                  const gough_units *unit) {
    bool any = false;
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        const double *bound = numbers_at(l, platform_limits[k].at) + 2 * (ptrdiff_t)c;
        const gough_unit of =
            c >= GOUGH_ROLL ? platform_limits[k].turning : platform_limits[k].unit;
        char label[40];
        if (!isfinite(bound[0])) continue;
        any = true;
        snprintf(label, sizeof label, "%s%s", gough_component_name(c), platform_limits[k].label);
        printf("  %-20s ", label);
        print_bound(bound, 2, factor_of(study, of));
        printf("%s\n", unit_word(unit, of));
    }
    return any;
}

void print_limits(const gough_study *study, const gough_units *unit) {
    const gough_limits l = limits_in_study(study);
    bool any = false;
    for (int k = 0; k < LEG_LIMITS; k++) {
        const gough_unit of = leg_limits[k].unit;
        any |= print_leg_limit(&l, k, factor_of(study, of), unit_word(unit, of));
    }
    for (int k = 0; k < PLATFORM_LIMITS; k++) any |= print_platform_limits(study, &l, k, unit);
    if (!any) printf("  limits               none given\n");
}

/* ---- JSON ---- */

/* a bound, or [least, greatest]; null if the study gives none */
static json_t *bound_json(const double *bound, int sides, double factor) {
    const double scaled[2] = {factor * bound[0], factor * bound[sides - 1]};
    return sides == 1 ? json_number(scaled[0]) : json_numbers(scaled, 2);
}

json_t *limits_object(const gough_study *study) {
    const gough_limits l = limits_in_study(study);
    json_t *object = json_object(), *legs = json_object(), *platform = json_object();
    for (int k = 0; k < LEG_LIMITS; k++) {
        const int sides = leg_limits[k].sides;
        const double *bound = numbers_at(&l, leg_limits[k].at);
        json_t *array = json_array();
        for (int v = 0; v < GOUGH_LEGS; v++)
            json_array_append_new(
                array, bound_json(bound + sides * v, sides, factor_of(study, leg_limits[k].unit)));
        json_object_set_new(legs, leg_limits[k].key, array);
    }
    for (int k = 0; k < PLATFORM_LIMITS; k++) {
        json_t *array = json_array();
        for (int c = 0; c < GOUGH_COMPONENTS; c++)
            json_array_append_new(
                array, bound_json(numbers_at(&l, platform_limits[k].at) + 2 * (ptrdiff_t)c, 2,
                                  factor_of(study, c >= GOUGH_ROLL ? platform_limits[k].turning
                                                                   : platform_limits[k].unit)));
        json_object_set_new(platform, platform_limits[k].key, array);
    }
    double about[3];
    for (int k = 0; k < 3; k++) about[k] = factor_of(study, GOUGH_UNIT_LENGTH) * l.about[k];
    json_object_set_new(platform, "about", json_numbers(about, 3));
    json_object_set_new(object, "legs", legs);
    json_object_set_new(object, "platform", platform);
    return object;
}

json_t *limits_common_length(const gough_study *study) {
    const gough_limits l = limits_in_study(study);
    const double factor = factor_of(study, GOUGH_UNIT_LENGTH);
    double common[2] = {factor * l.length[0][0], factor * l.length[0][1]};
    for (int v = 1; v < GOUGH_LEGS; v++)
        for (int side = 0; side < 2; side++)
            if (!nearly_same(l.length[v][side], l.length[0][side])) common[0] = common[1] = NAN;
    return json_numbers(common, 2);
}
