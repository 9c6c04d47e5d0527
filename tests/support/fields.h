/* Values of fields compared to the bit, by the table of fields. */
#ifndef TESTS_SUPPORT_FIELDS_H
#define TESTS_SUPPORT_FIELDS_H

#include <string.h>

#include "gough/fields.h"
#include "gough/simulate.h"

/* Bytes of one value. */
static inline size_t field_value_size(const gough_place *place) {
    static const size_t size[] = {[GOUGH_KIND_NUMBER] = sizeof(double),
                                  [GOUGH_KIND_FORMULA] = sizeof(gough_formula),
                                  [GOUGH_KIND_FLAG] = sizeof(bool),
                                  [GOUGH_KIND_CHOICE] = sizeof(int),
                                  [GOUGH_KIND_WHOLE] = sizeof(uint64_t)};
    return size[place->kind];
}

/* Operations beyond the last are no part of a formula. */
static inline bool formula_same(const gough_formula *a, const gough_formula *b) {
    bool same = a->count == b->count;
    for (int i = 0; same && i < a->count; i++)
        same = a->operation[i].code == b->operation[i].code &&
               a->operation[i].constant == b->operation[i].constant &&
               memcmp(&a->operation[i].value, &b->operation[i].value, sizeof(double)) == 0;
    return same;
}

/* Whether a field has the same values in two structs. */
static inline bool field_same(const gough_place *place, const void *a, const void *b) {
    const size_t size = field_value_size(place);
    const char *x = (const char *)a + place->offset, *y = (const char *)b + place->offset;
    bool same = true;
    for (size_t i = 0; same && i < place->count; i++, x += size, y += size)
        same = place->kind == GOUGH_KIND_FORMULA ? formula_same((const void *)x, (const void *)y)
                                                 : memcmp(x, y, size) == 0;
    return same;
}

/* The path of the first field of an owner that differs between two structs; NULL if all are the same. */
static inline const char *field_differs(gough_owner owner, const void *a, const void *b) {
    size_t count;
    const gough_field *field = gough_fields(&count);
    for (size_t i = 0; i < count; i++)
        if (field[i].place.owner == owner && !field_same(&field[i].place, a, b))
            return field[i].path;
    return NULL;
}

#endif
