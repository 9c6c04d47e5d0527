/* Numbers of a struct turned from units of the run into units of the output, by a table of their dimensions: the one place of the
 * command in which units are scaled. */
#ifndef GOUGH_CLI_SCALE_H
#define GOUGH_CLI_SCALE_H

#include <stddef.h>

#include "gough/gough.h"

/* One unit of a quantity is length^l · mass^m · time^t, or a degree. */
typedef struct dimension {
    signed char length, mass, time, degrees;
} dimension;

extern const dimension DIMENSION_LENGTH, DIMENSION_TIME, DIMENSION_RATE, DIMENSION_ANGLE,
    DIMENSION_SPEED, DIMENSION_FORCE, DIMENSION_POWER, DIMENSION_ENERGY, DIMENSION_STIFFNESS,
    DIMENSION_DAMPING;

/* One unit of the output in units of the run; of an angle 1. */
double scale_unit(const gough_units *units, dimension d);

/* What a number of this dimension is multiplied by to be in units of the output; radians become degrees. */
double scale_factor(const gough_units *units, dimension d);

/* `count` doubles of a struct, one after the other, of one dimension. */
typedef struct scaled_member {
    size_t at;
    size_t count;
    const dimension *dimension;
} scaled_member;

/* a member that is a double or an array of them */
#define SCALED(type, member, what)                                                                 \
    { offsetof(type, member), sizeof(((type *)0)->member) / sizeof(double), &DIMENSION_##what }

/* Scales the members of a struct that a table names. */
void scale_members(void *object, const scaled_member *member, size_t count,
                   const gough_units *units);

#define SCALE(object, table, units)                                                                \
    scale_members(object, table, sizeof(table) / sizeof *(table), units)

#endif
