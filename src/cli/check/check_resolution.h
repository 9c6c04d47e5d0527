/* How well a pose is known: what errors of lengths and joints make of it. */
#ifndef GOUGH_CLI_CHECK_RESOLUTION_H
#define GOUGH_CLI_CHECK_RESOLUTION_H

#include <jansson.h>
#include <stdio.h>

#include "gough/gough.h"

/* The errors of the study in a pose of its machine: how the pose moves for each unit of length, then, where the study gives
 * them, for one count of the encoders, errors of lengths, tolerances of joints. */
void resolution_print(FILE *stream, const gough_model *model, const gough_units *unit,
                      const gough_state *state);

json_t *resolution_object(const gough_model *model, const gough_units *unit,
                          const gough_state *state);

#endif
