/* A pose of the machine at rest: legs, condition, stiffness and compliance. */
#ifndef GOUGH_CLI_CHECK_POSE_H
#define GOUGH_CLI_CHECK_POSE_H

#include <jansson.h>
#include <stdbool.h>
#include <stdio.h>

#include "gough/gough.h"

typedef struct pose_view {
    bool asked;                    /* by --pose; else home */
    double pose[GOUGH_COMPONENTS]; /* surge … yaw, in the study's units */
    bool found;
    gough_stiffness at; /* if found */
    gough_error why;    /* if not */
} pose_view;

/* Fills in what follows from `asked` and `pose`. */
void pose_view_find(const gough_model *model, const gough_units *unit, pose_view *view);

void pose_view_print(FILE *stream, const gough_model *model, const gough_units *unit,
                     const pose_view *view);

json_t *pose_view_object(const gough_model *model, const gough_units *unit, const pose_view *view);

#endif
