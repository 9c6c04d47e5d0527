/* Values of a study by their keys in the table of fields. */
#ifndef GOUGH_CLI_STUDY_FIELDS_H
#define GOUGH_CLI_STUDY_FIELDS_H

#include <jansson.h>
#include <stdio.h>

#include "gough/gough.h"

/* ---- as JSON, in the units of the study, angles in radians ---- */

/* The value of the key "load.mass"; choices as their words, points and matrices as rows. Null where the key has no number. */
json_t *json_field(const gough_study *study, const char *path);

/* All keys directly in a section such as "control", by their names. */
json_t *json_section(const gough_study *study, const char *section);

/* ---- as text ---- */

/* The value of a key with its unit: "9.81 m/s^2", "1, 2, 3 m", "dop853"; angles in degrees. Nothing where the key has no value. */
void print_field(FILE *stream, const gough_study *study, const char *path);

#endif
