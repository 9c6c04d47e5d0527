/* The parts of a study's loop besides stiffness and damping of single legs: matrices of gains, integral, samples, drives. */
#ifndef GOUGH_CLI_CHECK_LOOP_H
#define GOUGH_CLI_CHECK_LOOP_H

#include <jansson.h>

#include "gough/gough.h"

/* " on the diagonal of a 6x6 matrix" where a gain is one, else "". */
const char *loop_matrix_words(const gough_control *control,
                              const double cross[GOUGH_LEGS][GOUGH_LEGS]);

/* Lines of the section "Control": the integral, and what a sampled controller measures. */
void print_loop(const gough_study *study, const gough_units *unit);

/* The section "Drives"; nothing where all are ideal and without limits. */
void print_drives(const gough_study *study, const gough_units *unit);

/* The same as JSON. */
json_t *control_object(const gough_study *study, const gough_units *unit);
json_t *drives_object(const gough_study *study, const gough_units *unit);

#endif
