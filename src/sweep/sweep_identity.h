/* What a sweep's records depend on besides the text of its study, and which columns a sweep can have. */
#ifndef GOUGH_SWEEP_SWEEP_IDENTITY_H
#define GOUGH_SWEEP_SWEEP_IDENTITY_H

#include <stdbool.h>
#include <stdint.h>

#include "gough/sweep.h"

/* Digest of the keys and of the values that they take. value: scratch, a number for each key. */
uint64_t sweep_plan_digest(const gough_sweep *sweep, double *value);

/* Digest of numbers that this build computes for the study, along its program or in motion. */
uint64_t sweep_numerics_digest(const gough_study *study, bool forces);

/* Whether a study has a number of that path, with that unit. */
bool sweep_column_known(const char *path, const char *label, const gough_units *units);

#endif
