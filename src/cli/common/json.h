/* Small helpers over jansson: numbers that may not be finite, sentences that may be cut. */
#ifndef GOUGH_CLI_JSON_H
#define GOUGH_CLI_JSON_H

#include <jansson.h>

#include "cli/common/scale.h"
#include "gough/gough.h"

/* null for NaN and infinities, which JSON does not have */
json_t *json_number(double value);
json_t *json_numbers(const double *value, size_t count);
json_t *json_words(const char *text);

/* The units of an object's numbers: "si", "dimensionless", or the words of the five base units. */
json_t *json_units(const gough_units *units);

/* The members of a struct that have a key in the table, in its order; null for all of them without an object. */
void json_set_members(json_t *json, const void *object, const scaled_member *member, size_t count);

#define JSON_SET(json, object, table)                                                              \
    json_set_members(json, object, table, sizeof(table) / sizeof *(table))

/* Prints on standard output and lets go of the object. Returns 0, or -1 when out of memory or the output fails. */
int json_print(json_t *object);

#endif
