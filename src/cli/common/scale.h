/* Numbers of a struct turned from units of the run into units of the output, by a table of what they measure. What the units are is
 * in src/table/units.c. */
#ifndef GOUGH_CLI_SCALE_H
#define GOUGH_CLI_SCALE_H

#include <stddef.h>

#include "gough/gough.h"

/* `count` doubles of a struct, one after the other, of one unit. */
typedef struct scaled_member {
    size_t at;
    size_t count;
    gough_unit unit;
    const char *key; /* in JSON (json_set_members()); NULL: not there */
} scaled_member;

/* a member that is a double or an array of them */
#define SCALED(type, member, what)                                                                 \
    {                                                                                              \
        offsetof(type, member), sizeof(((type *)0)->member) / sizeof(double), GOUGH_UNIT_##what,   \
            NULL                                                                                   \
    }

/* the same with its key in JSON */
#define KEYED(type, member, what, key)                                                             \
    { offsetof(type, member), sizeof(((type *)0)->member) / sizeof(double), GOUGH_UNIT_##what, key }

/* Scales the members of a struct that a table names. */
void scale_members(void *object, const scaled_member *member, size_t count,
                   const gough_units *units);

#define SCALE(object, table, units)                                                                \
    scale_members(object, table, sizeof(table) / sizeof *(table), units)

/* ---- units as words: " m" in SI, "" where numbers have no unit; they follow a number ---- */

const char *unit_word(const gough_units *units, gough_unit unit);

/* "length [m]", or "length" without a unit */
typedef struct table_heading {
    char text[32];
} table_heading;
table_heading heading_of(const char *what, const char *unit);

/* What the numbers mean, for the head of a summary: "SI units", "lengths in R_b …", "lengths in mm …". */
typedef struct units_words {
    char text[100];
} units_words;
units_words units_sentence(const gough_study *study, const gough_units *units);

/* The unit of a component of a pose or a motion, surge … yaw. */
gough_unit component_unit(int component);

/* A number of the run in the units of the output. */
double in_units(const gough_units *units, gough_unit unit, double value);

/* Whether two numbers are the same but for rounding. */
bool nearly_same(double a, double b);

/* The same for two: the least and the greatest of something. */
typedef struct two_numbers {
    double value[2];
} two_numbers;
two_numbers two_in_units(const gough_units *units, gough_unit unit, double first, double second);

#endif
