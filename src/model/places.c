/* The places of all fields, and their defaults. */
#include "model/places.h"

_Static_assert(sizeof(gough_method) == sizeof(int) && sizeof(gough_constraints) == sizeof(int) &&
                   sizeof(gough_precision) == sizeof(int) &&
                   sizeof(gough_motion_kind) == sizeof(int) && sizeof(gough_order) == sizeof(int) &&
                   sizeof(gough_actuator_kind) == sizeof(int) &&
                   sizeof(gough_velocity) == sizeof(int),
               "choices are read and written as int");

#define KEY(path, shape, unit, bound, fallback, sentence, ...) {REST_OF(fallback), __VA_ARGS__},
#define MEMBER(path, ...) {__VA_ARGS__},

static const gough_place places[] = {
#include "model/fields.def"
};

const gough_place *gough_places(size_t *count) {
    *count = sizeof places / sizeof places[0];
    return places;
}

static void reset_value(const gough_place *p, size_t i, void *value) {
    const double usual = p->usual[i > 0];

    switch (p->kind) {
    case GOUGH_KIND_NUMBER:
        ((double *)value)[i] = usual;
        break;
    case GOUGH_KIND_FORMULA:
        ((gough_formula *)value)[i] = gough_formula_constant(usual);
        break;
    case GOUGH_KIND_FLAG:
        ((bool *)value)[i] = usual > 0;
        break;
    case GOUGH_KIND_CHOICE:
        ((int *)value)[i] = (int)usual;
        break;
    case GOUGH_KIND_WHOLE:
        ((uint64_t *)value)[i] = (uint64_t)usual;
        break;
    }
}

void gough_place_reset(const gough_place *place, void *owner) {
    if (place->owner == GOUGH_OWNER_NONE) return;
    char *const start = owner;
    for (size_t i = 0; i < place->count; i++) reset_value(place, i, start + place->offset);
    if (place->given) *(bool *)(start + place->given) = false;
}
