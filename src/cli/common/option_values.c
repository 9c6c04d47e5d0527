/* Parts of option values: decimal numbers, a pose given by its components, the values of an axis. */
#define _GNU_SOURCE
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/option_values.h"
#include "cli/common/talk.h"

enum { MOST_VALUES = 10000 };

bool read_decimal(const char *text, const char *end, double *value) {
    const size_t length = (size_t)(end - text);
    return length > 0 && gough_decimal_read(text, length, value) == length && isfinite(*value);
}

/* ---- a pose ------------------------------------------------------------------------------------------------------- */

static int component_of(const char *name, size_t length) {
    int c = 0;
    while (c < GOUGH_COMPONENTS && (strlen(gough_component_name(c)) != length ||
                                    strncmp(gough_component_name(c), name, length) != 0))
        c++;
    return c;
}

static bool refuse_component(const char *option, const char *name, size_t length,
                             gough_error *error) {
    const char *known[GOUGH_COMPONENTS];
    char word[40];
    snprintf(word, sizeof word, "%.*s", (int)(length < 39 ? length : 39), name);
    for (int c = 0; c < GOUGH_COMPONENTS; c++) known[c] = gough_component_name(c);
    const char *near = nearest_word(word, known, GOUGH_COMPONENTS);
    gough_fail(error, GOUGH_ERROR_INPUT,
               "--%s has no component '%s'%s%s%s; the components are surge, sway, heave "
               "(lengths), roll, pitch and yaw (angles), in the study's units",
               option, word, near ? "; did you mean '" : "", near ? near : "", near ? "'?" : "");
    return false;
}

bool read_pose(const char *name, const char *text, double pose[GOUGH_COMPONENTS],
               gough_error *error) {
    bool given[GOUGH_COMPONENTS] = {false};
    for (const char *at = text;; at++) {
        const char *end = at + strcspn(at, ","), *equal = memchr(at, '=', (size_t)(end - at));
        double value;
        if (!equal) {
            gough_fail(error, GOUGH_ERROR_INPUT,
                       "--%s takes displacements from home, as in --%s heave=0.1,yaw=10 "
                       "(in the study's units); got '%s'",
                       name, name, text);
            return false;
        }
        const int c = component_of(at, (size_t)(equal - at));
        if (c == GOUGH_COMPONENTS) return refuse_component(name, at, (size_t)(equal - at), error);
        if (!read_decimal(equal + 1, end, &value)) {
            gough_fail(error, GOUGH_ERROR_INPUT, "--%s: %s must be a number; got '%.*s'", name,
                       gough_component_name(c), (int)(end - equal - 1), equal + 1);
            return false;
        }
        if (given[c]) {
            gough_fail(error, GOUGH_ERROR_INPUT, "--%s: %s is given twice; give it once", name,
                       gough_component_name(c));
            return false;
        }
        given[c] = true;
        pose[c] = value;
        at = end;
        if (!*at) return true;
    }
}

/* ---- an axis ------------------------------------------------------------------------------------------------------ */

static bool refuse_axis(const char *name, const char *text, const char *reason,
                        gough_error *error) {
    gough_fail(error, GOUGH_ERROR_INPUT,
               "--%s takes from:to:count or from:to:count:log%s; got '%s'", name, reason, text);
    return false;
}

/* Splits at colons; the number of pieces, at most 5. piece[i] … end[i]. */
static int split(const char *text, const char *piece[5], const char *end[5]) {
    int count = 0;
    for (const char *at = text; count < 5; at = end[count - 1] + 1) {
        piece[count] = at;
        end[count] = at + strcspn(at, ":");
        if (!*end[count++]) break;
    }
    return count;
}

bool read_axis(const char *name, const char *text, axis_values *axis, gough_error *error) {
    const char *piece[5], *end[5];
    const int pieces = split(text, piece, end);
    const bool positive = strcmp(name, "sweep-frequency") == 0 || strcmp(name, "sweep-period") == 0;
    double count;
    if (pieces < 3 || pieces > 4 || (pieces == 4 && strcmp(piece[3], "log") != 0))
        return refuse_axis(name, text, ", as in 0:2:201", error);
    if (!read_decimal(piece[0], end[0], &axis->from) ||
        !read_decimal(piece[1], end[1], &axis->to) || !read_decimal(piece[2], end[2], &count))
        return refuse_axis(name, text, ", three decimal numbers", error);
    if (!(count >= 2 && count <= MOST_VALUES) || floor(count) < count)
        return refuse_axis(name, text, ", where count is a whole number from 2 to 10000", error);
    if (!(axis->to > axis->from))
        return refuse_axis(name, text, ", where 'to' is greater than 'from'", error);
    if (axis->from < 0 || (positive && !(axis->from > 0)))
        return refuse_axis(name, text,
                           positive ? ", where all values are greater than 0"
                                    : ", where no value is below 0",
                           error);
    axis->logarithmic = pieces == 4;
    if (axis->logarithmic && !(axis->from > 0))
        return refuse_axis(name, text, "; with log all values must be greater than 0", error);
    axis->count = (size_t)count;
    return true;
}

/* ---- a span ------------------------------------------------------------------------------------------------------- */

bool read_span(const char *text, double *from, double *to, gough_error *error) {
    const char *piece[5], *end[5];
    if (split(text, piece, end) == 2 && read_decimal(piece[0], end[0], from) &&
        read_decimal(piece[1], end[1], to) && *from >= 0 && *to >= *from)
        return true;
    gough_fail(error, GOUGH_ERROR_INPUT,
               "--stiffness takes two numbers a:b with 0 <= a <= b, as in --stiffness 1:1e5; got "
               "'%s'",
               text);
    return false;
}
