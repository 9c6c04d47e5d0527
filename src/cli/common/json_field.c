/* Values of a study as JSON, found by their key in the table of fields; in the units of the study, angles in radians. */
#include <string.h>

#include "cli/common/json.h"

/* The word of a choice, from its words "projection, none". */
static json_t *word_of(const char *range, int index) {
    for (; index > 0 && *range; index--) {
        range += strcspn(range, ",");
        range += strspn(range, ", ");
    }
    return json_stringn(range, strcspn(range, ","));
}

static json_t *numbers_of(const gough_field *field, const double *value) {
    if (field->place.count == 1) return json_number(*value);
    if (field->shape != GOUGH_SHAPE_POINTS && field->shape != GOUGH_SHAPE_INERTIA)
        return json_numbers(value, field->place.count);
    json_t *rows = json_array();
    for (size_t i = 0; i < field->place.count; i += 3)
        json_array_append_new(rows, json_numbers(value + i, 3));
    return rows;
}

/* Formulas and whole numbers, whose text is in the study, are null. */
static json_t *value_of(const gough_field *field, const gough_study *study) {
    const void *owner = field->place.owner == GOUGH_OWNER_MODEL ? (const void *)study->model
                                                                : (const void *)&study->simulation;
    const void *value = (const char *)owner + field->place.offset;
    switch (field->place.kind) {
    case GOUGH_KIND_NUMBER:
        return numbers_of(field, value);
    case GOUGH_KIND_FLAG:
        return json_boolean(*(const bool *)value);
    case GOUGH_KIND_CHOICE:
        return word_of(field->range, *(const int *)value);
    case GOUGH_KIND_FORMULA:
    case GOUGH_KIND_WHOLE:
        break;
    }
    return json_null();
}

static bool is_in_study(const gough_place *place) {
    return place->owner == GOUGH_OWNER_MODEL || place->owner == GOUGH_OWNER_SIMULATION;
}

json_t *json_field(const gough_study *study, const char *path) {
    size_t count;
    const gough_key *key = gough_study_keys(&count);
    for (size_t i = 0; i < count; i++)
        if (is_in_study(&key[i].place) && strcmp(key[i].path, path) == 0)
            return value_of(&key[i], study);
    return json_null();
}

json_t *json_section(const gough_study *study, const char *section) {
    const size_t length = strlen(section);
    json_t *object = json_object();
    size_t count;
    const gough_key *key = gough_study_keys(&count);
    for (size_t i = 0; i < count; i++) {
        const char *name = key[i].path + length + 1;
        if (strncmp(key[i].path, section, length) != 0 || key[i].path[length] != '.') continue;
        if (is_in_study(&key[i].place) && !strchr(name, '.'))
            json_object_set_new(object, name, value_of(&key[i], study));
    }
    return object;
}
