/* What `gough check` finds of a study, and the whole of it as JSON. */
#ifndef GOUGH_CLI_CHECK_JSON_H
#define GOUGH_CLI_CHECK_JSON_H

#include <jansson.h>

#include "cli/check/check_pose.h"
#include "cli/check/machine_view.h"
#include "cli/common/sampled_view.h"
#include "gough/gough.h"

/* Everything that is printed; ranges in the study's units. */
typedef struct check {
    const gough_study *study;
    const gough_sweep *sweep; /* NULL: none */
    const gough_model *model;
    const gough_machine *machine;
    machine_view view;
    const gough_units *unit;
    double least[GOUGH_COMPONENTS], greatest[GOUGH_COMPONENTS];
    pose_view pose;
    sampled_view sampled;
} check;

/* A number in the units of the study. */
double check_own(const check *c, gough_unit unit, double value);

/* Which motion the legs resist least: the largest component of its singular vector. */
const char *check_weakest_name(const machine_view *view);

/* of J, in length^3 of the study */
double check_determinant_of(const check *c);

json_t *check_object(const check *c);

#endif
