/* What check and stability tell about a sampled controller at rest. */
#ifndef GOUGH_CLI_SAMPLED_VIEW_H
#define GOUGH_CLI_SAMPLED_VIEW_H

#include <jansson.h>
#include <stdio.h>

#include "gough/gough.h"

typedef struct sampled_view {
    bool found; /* the rest holds */
    gough_sampled_rest rest;
    gough_sampled_margins margins;
    gough_error why; /* if nothing was found; in the study's units */
} sampled_view;

/* At rest in a pose, component from home in units of the run (NULL: home). Not found, without a sentence, if the controller is
 * continuous. */
void sampled_view_find(const gough_study *study, const double *component, sampled_view *view);

/* Window of the stiffness, longest period and delay, gains that reach furthest: lines with labels of 20 columns. */
void sampled_view_print(FILE *stream, const gough_study *study, const gough_units *unit,
                        const sampled_view *view);

/* The object `sampling`; null if nothing was found. */
json_t *sampled_view_object(const gough_units *unit, const sampled_view *view);

#endif
