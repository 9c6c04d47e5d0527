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

void gough_end_say(gough_end *end, const char *length, const char *speed, const char *force,
                   const char *time) {
    const int several = (end->legs & (end->legs - 1)) != 0;
    const char *verb = several ? "exceed their" : "exceeds its", *what = NULL, *unit = length;
    gough_error said;
    char legs[64];

    switch (end->cause) {
    case GOUGH_END_LEG_SHORT:
        verb = several ? "get shorter than their" : "gets shorter than its";
        what = "least length";
        break;
    case GOUGH_END_LEG_LONG:
        verb = several ? "get longer than their" : "gets longer than its";
        what = "greatest length";
        break;
    case GOUGH_END_LEG_SPEED:
        what = "greatest speed";
        unit = speed;
        break;
    case GOUGH_END_LEG_FORCE:
        what = "greatest force";
        unit = force;
        break;
    default:
        renew_time(end, time);
        return;
    }
    name_legs(end->legs, legs, sizeof legs);
    (void)gough_fail(&said, GOUGH_ERROR_NUMERICAL, "%s %s %s %.9g%s at t = %.9g%s", legs, verb,
                     what, end->limit, unit, end->time, time);
    memcpy(end->message, said.message, sizeof end->message);
    end->message[sizeof end->message - 1] = '\0';
}
