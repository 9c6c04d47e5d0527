/* Columns of numbers as the page has them, compressed and complete to the bit. */
#ifndef GOUGH_CLI_PACKED_H
#define GOUGH_CLI_PACKED_H

#include <jansson.h>
#include <stddef.h>

/* Bytes as base64. */
json_t *base64(const unsigned char *bytes, size_t count);

/* Doubles as base64, least significant byte first whatever the machine's order. */
json_t *base64_of_numbers(const double *value, size_t count);

/* Adds the column's numbers to its object: `rows`, `order` and `packed`, as packed.c describes. */
void pack_numbers(json_t *object, const double *value, size_t count);

#endif
