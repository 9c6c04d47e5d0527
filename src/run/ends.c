/* The sentence of an end: which legs exceed which limit and when, with the units that the caller names. */
#include <stdio.h>
#include <string.h>

#include "gough/simulate.h"

/* "leg 3", "legs 3 and 4", "legs 1, 3 and 5", "all six legs" */
static void name_legs(unsigned legs, char *text, size_t size) {
    int count = 0, named = 0;
    size_t used;

    for (int v = 0; v < GOUGH_LEGS; v++) count += (legs >> v & 1) != 0;
    if (count == GOUGH_LEGS) {
        snprintf(text, size, "all six legs");
        return;
    }
    snprintf(text, size, count > 1 ? "legs" : "leg");
    for (int v = 0; v < GOUGH_LEGS; v++) {
        if (!(legs >> v & 1)) continue;
        used = strlen(text);
        named++;
        snprintf(text + used, size - used, "%s%d",
                 named == 1       ? " "
                 : named == count ? " and "
                                  : ", ",
                 v + 1);
    }
}

/* the message with the time of the end and its unit in place of each "t = number" */
static void renew_time(gough_end *end, const char *unit) {
    static const char digits[] = "0123456789+-.eE";
    gough_error said;
    char *from = strstr(end->message, "t = ");

    if (from == NULL) return;
    from += strlen("t = ");
    const size_t number = strspn(from, digits), word = strlen(unit);
    if (word > 0 && strncmp(from + number, unit, word) == 0) return; /* said already */
    (void)gough_fail(&said, GOUGH_ERROR_NUMERICAL, "%.*s%.9g%s%s", (int)(from - end->message),
                     end->message, end->time, unit, from + number);
    memcpy(end->message, said.message, sizeof end->message);
    end->message[sizeof end->message - 1] = '\0';
}

/* Of which limit an end is: what follows "exceeds its …", and the unit. */
typedef struct {
    char what[64];
    const char *unit;
} limit_words;

static const char *axis_of(const gough_end *end) {
    static const char *const axis[] = {"x", "y", "z"};
    return axis[(end->component + 2) % 3];
}

/* "greatest heave", "least velocity in surge", "greatest angular velocity about z" */
static void name_component(const gough_end *end, const gough_end_words *words, limit_words *limit) {
    const char *const degree = end->least ? "least" : "greatest";
    const char *const name = gough_component_name(end->component - 1);
    const int turns = end->component > GOUGH_ROLL;
    const int second = end->cause == GOUGH_END_PLATFORM_ACCELERATION;
    const char *const rate = second ? "acceleration" : "velocity";
    const size_t size = sizeof limit->what;

    if (end->cause == GOUGH_END_PLATFORM_POSE) {
        snprintf(limit->what, size, "%s %s", degree, name);
        limit->unit = turns ? words->angle : words->length;
    } else if (turns) {
        snprintf(limit->what, size, "%s angular %s about %s", degree, rate, axis_of(end));
        limit->unit = second ? words->angular_acceleration : words->angular_speed;
    } else {
        snprintf(limit->what, size, "%s %s in %s", degree, rate, name);
        limit->unit = second ? words->acceleration : words->speed;
    }
}

/* 0 where the end is at no limit */
static int name_limit(const gough_end *end, const gough_end_words *words, limit_words *limit) {
    const char *what;

    limit->unit = words->length;
    switch (end->cause) {
    case GOUGH_END_LEG_SHORT:
        what = "least length";
        break;
    case GOUGH_END_LEG_LONG:
        what = "greatest length";
        break;
    case GOUGH_END_LEG_SPEED:
        what = "greatest speed";
        limit->unit = words->speed;
        break;
    case GOUGH_END_LEG_FORCE:
        what = end->least ? "least force" : "greatest force";
        limit->unit = words->force;
        break;
    case GOUGH_END_LEG_ACCELERATION:
        what = "greatest acceleration";
        limit->unit = words->acceleration;
        break;
    case GOUGH_END_BASE_SWING:
        what = "greatest swing at the base";
        limit->unit = words->angle;
        break;
    case GOUGH_END_TOP_SWING:
        what = "greatest swing at the top";
        limit->unit = words->angle;
        break;
    case GOUGH_END_PLATFORM_POSE:
    case GOUGH_END_PLATFORM_SPEED:
    case GOUGH_END_PLATFORM_ACCELERATION:
        name_component(end, words, limit);
        return 1;
    default:
        return 0;
    }
    snprintf(limit->what, sizeof limit->what, "%s", what);
    return 1;
}

/* "gets shorter than its", "exceed their" */
static const char *verb_of(const gough_end *end) {
    const int several = (end->legs & (end->legs - 1)) != 0;

    if (end->cause == GOUGH_END_LEG_SHORT)
        return several ? "get shorter than their" : "gets shorter than its";
    if (end->cause == GOUGH_END_LEG_LONG)
        return several ? "get longer than their" : "gets longer than its";
    if (end->least) return several ? "fall below their" : "falls below its";
    return several ? "exceed their" : "exceeds its";
}

void gough_end_say(gough_end *end, const gough_end_words *words) {
    char who[64] = "the platform";
    limit_words limit;
    gough_error said;

    if (!name_limit(end, words, &limit)) {
        renew_time(end, words->time);
        return;
    }
    if (!end->component) name_legs(end->legs, who, sizeof who);
    (void)gough_fail(&said, GOUGH_ERROR_NUMERICAL, "%s %s %s %.9g%s at t = %.9g%s", who,
                     verb_of(end), limit.what, end->limit, limit.unit, end->time, words->time);
    memcpy(end->message, said.message, sizeof end->message);
    end->message[sizeof end->message - 1] = '\0';
}
