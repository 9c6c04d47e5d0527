/* Small helpers over jansson: numbers that may not be finite, sentences that may be cut. */
#ifndef GOUGH_CLI_JSON_H
#define GOUGH_CLI_JSON_H

#include <jansson.h>

#include "cli/run/run_report.h"

/* null for NaN and infinities, which JSON does not have */
json_t *json_number(double value);
json_t *json_numbers(const double *value, size_t count);
json_t *json_words(const char *text);

/* ---- json_field.c: values of a study by the table of fields, angles in radians ---- */

/* The value of the key "load.mass"; choices as their words, points and matrices as rows. Null where the key has no number. */
json_t *json_field(const gough_study *study, const char *path);

/* All keys directly in a section such as "control", by their names. */
json_t *json_section(const gough_study *study, const char *section);

/* The summary of forces and simulate. */
json_t *run_report_json(const run_report *report);

/* Prints on standard output and lets go of the object. Returns 0, or -1 when out of memory or the output fails. */
int json_print(json_t *object);

#endif
