/* The limits of a study, for reading and as JSON, in units of the study. */
#ifndef GOUGH_CLI_CHECK_LIMITS_H
#define GOUGH_CLI_CHECK_LIMITS_H

#include <jansson.h>

#include "gough/gough.h"

/* Prints the limits of legs and platform that the study gives; says so if it gives none. */
void print_limits(const gough_study *study, const gough_units *unit);

/* All of them, in the units of the study; null where there is no limit. */
json_t *limits_object(const gough_study *study);

/* The least and greatest length if they are those of all legs, else two nulls. */
json_t *limits_common_length(const gough_study *study);

#endif
