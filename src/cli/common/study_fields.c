/* Values of a study, found by their key in the table of fields: as JSON and as text. */
#include "cli/common/study_fields.h"

#include <string.h>

#include "cli/common/json.h"
#include "cli/common/scale.h"

/* The word of a choice, from its words "projection, none". */
static const char *word_of(const char *range, int index, size_t *length) {
    for (; index > 0 && *range; index--) {
        range += strcspn(range, ",");
        range += strspn(range, ", ");
    }
    *length = strcspn(range, ",");
    return range;
}

static json_t *numbers_of(const gough_field *field, const gough_units *units, const double *value) {
    enum { MOST = 18 };
    double number[MOST];
    for (size_t i = 0; i < field->place.count && i < MOST; i++)
        number[i] = in_units(units, gough_unit_of_field(field->unit), value[i]);
    if (field->place.count == 1) return json_number(*number);
    if (field->shape != GOUGH_SHAPE_POINTS && field->shape != GOUGH_SHAPE_INERTIA)
        return json_numbers(number, field->place.count);
    json_t *rows = json_array();
    for (size_t i = 0; i < field->place.count; i += 3)
        json_array_append_new(rows, json_numbers(number + i, 3));
    return rows;
}

static const void *place_in(const gough_field *field, const gough_study *study) {
    const void *owner = field->place.owner == GOUGH_OWNER_MODEL ? (const void *)study->model
                                                                : (const void *)&study->simulation;
    return (const char *)owner + field->place.offset;
}

/* Formulas and whole numbers, whose text is in the study, are null. */
static json_t *value_of(const gough_field *field, const gough_study *study) {
    const void *value = place_in(field, study);
    size_t length;
    const char *word;
    switch (field->place.kind) {
    case GOUGH_KIND_NUMBER:
        return numbers_of(field, &study->units, value);
    case GOUGH_KIND_FLAG:
        return json_boolean(*(const bool *)value);
    case GOUGH_KIND_CHOICE:
        word = word_of(field->range, *(const int *)value, &length);
        return json_stringn(word, length);
    case GOUGH_KIND_FORMULA:
    case GOUGH_KIND_WHOLE:
        break;
    }
    return json_null();
}

static bool is_in_study(const gough_place *place) {
    return place->owner == GOUGH_OWNER_MODEL || place->owner == GOUGH_OWNER_SIMULATION;
}

static const gough_field *find_field(const char *path) {
    size_t count;
    const gough_key *key = gough_study_keys(&count);
    for (size_t i = 0; i < count; i++)
        if (is_in_study(&key[i].place) && strcmp(key[i].path, path) == 0) return &key[i];
    return NULL;
}

json_t *json_field(const gough_study *study, const char *path) {
    const gough_field *field = find_field(path);
    return field ? value_of(field, study) : json_null();
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

void print_field(FILE *stream, const gough_study *study, const char *path) {
    const gough_field *field = find_field(path);
    const gough_units *own = &study->units;
    if (!field) return;
    const gough_unit unit = gough_unit_of_field(field->unit);
    const void *value = place_in(field, study);
    if (field->place.kind == GOUGH_KIND_CHOICE) {
        size_t length;
        const char *word = word_of(field->range, *(const int *)value, &length);
        fprintf(stream, "%.*s", (int)length, word);
    }
    if (field->place.kind != GOUGH_KIND_NUMBER) return;
    for (size_t i = 0; i < field->place.count; i++) /* no "-0" */
        fprintf(stream, "%s%.6g", i ? ", " : "",
                in_units(own, unit, ((const double *)value)[i]) + 0.0);
    fputs(unit_word(own, unit), stream);
}
