/* Parts of option values: numbers, a pose, an axis, a span. */
#ifndef GOUGH_CLI_OPTION_VALUES_H
#define GOUGH_CLI_OPTION_VALUES_H

#include <stdbool.h>
#include <stddef.h>

#include "gough/gough.h"

/* Values of one axis of a map: `count` of them from `from` to `to`, by equal steps or equal ratios. */
typedef struct axis_values {
    const char *option; /* which option asked for it, without --; NULL: not asked for */
    double from, to;
    size_t count;
    bool logarithmic;
} axis_values;

/* The text up to `end`, if it is one finite decimal number and nothing else. */
bool read_decimal(const char *text, const char *end, double *value);

/* "heave=0.1,yaw=10", as option --NAME has it: adds to the components. Returns false with a sentence for the user. */
bool read_pose(const char *name, const char *text, double pose[GOUGH_COMPONENTS],
               gough_error *error);

/* "a:b:n" or "a:b:n:log", as option --NAME has it. Returns false with a sentence for the user. */
bool read_axis(const char *name, const char *text, axis_values *axis, gough_error *error);

/* "a:b", two numbers. Returns false with a sentence for the user. */
bool read_span(const char *text, double *from, double *to, gough_error *error);

#endif
