/* Limits that more than one room keeps: each stands here once, with its reason. */
#ifndef GOUGH_BASE_LIMITS_H
#define GOUGH_BASE_LIMITS_H

#include "gough/dynamics.h"

/* the condition of the six equations of the leg forces from which a pose counts as singular: half of the digits are lost */
static const double greatest_condition = GOUGH_GREATEST_CONDITION;

/* base radii up to which a leg has no length, and thus no direction */
static const double leg_no_length = 1e-9;

/* a determinant that changes by less than one part in so many of itself in a step does not pass zero within it */
static const double determinant_ease = 8;

#endif
