/* From a checked tree to the structs by the table of fields: defaults, and the values that the tree gives.
 * Numbers are in the study's units in the file, in SI or dimensionless in the structs; angles of formulas are turned into radians
 * when they are evaluated. */
#include "study/fill.h"

#include <string.h>

#include "study/value.h"

/* The struct of a study with this place; NULL if none has it. */
static void *owner_of(gough_study *study, const gough_place *place) {
    if (place->owner == GOUGH_OWNER_MODEL) return study->model;
    return place->owner == GOUGH_OWNER_SIMULATION ? &study->simulation : NULL;
}

/* ---- values ---- */

/* The numbers of a tree, one after the other; returns where the next one would be. */
static double *read_each(const study_node *node, const gough_units *units, gough_unit unit,
                         double *value) {
    if (node->kind != STUDY_LIST) {
        *value = gough_unit_read(units, unit, study_number(node));
        return value + 1;
    }
    for (const study_node *item = node->first; item; item = item->next)
        value = read_each(item, units, unit, value);
    return value;
}

void study_numbers(const study_node *list, const gough_units *units, gough_unit unit,
                   double *value) {
    read_each(list, units, unit, value);
}

/* A formula in the study's units as one in those of the run; of angles it stays, which gough_motion.angle_unit converts. */
gough_status study_formula(const study_node *node, const gough_units *units, gough_unit unit,
                           gough_formula *formula, size_t *offset, gough_error *error) {
    const double size = unit == GOUGH_UNIT_ANGLE ? 1 : gough_unit_read(units, unit, 1);
    const gough_status status =
        gough_formula_compile(formula, node->text, node->length, offset, error);
    return status ? status
                  : gough_formula_scale(formula, size, gough_unit_factor(units, GOUGH_UNIT_TIME),
                                        error);
}

/* Two limits, or one number for both signs. */
static void read_range(const study_node *node, const gough_units *units, gough_unit unit,
                       double value[2]) {
    if (node->kind == STUDY_LIST)
        read_each(node, units, unit, value);
    else
        value[1] = gough_unit_read(units, unit, study_number(node)), value[0] = -value[1];
}

/* One range for all legs, or six. */
static void read_ranges(const gough_field *field, const study_node *node, const gough_units *units,
                        gough_unit unit, double *value) {
    const bool six = node->kind == STUDY_LIST && node->count == GOUGH_LEGS;
    for (size_t v = 0; 2 * v < field->place.count; v++)
        read_range(six ? study_node_item(node, v) : node, units, unit, &value[2 * v]);
}

/* A list gives each value; a scalar is for all of them, one pair for six pairs, and a scalar in place of a pair for both signs. */
static void read_numbers(const gough_field *field, const study_node *node, const gough_units *units,
                         double *value) {
    const gough_unit unit = gough_unit_of_field(field->unit);
    const bool one_pair =
        field->shape == GOUGH_SHAPE_PAIR_OR_SIX && node->first->kind == STUDY_SCALAR;
    if (field->shape == GOUGH_SHAPE_RANGE_OR_SIX)
        read_ranges(field, node, units, unit, value);
    else if (one_pair)
        for (size_t i = 0; i < field->place.count; i += 2) read_each(node, units, unit, &value[i]);
    else if (node->kind == STUDY_LIST)
        read_each(node, units, unit, value);
    else if (field->shape == GOUGH_SHAPE_RANGE)
        read_range(node, units, unit, value);
    else
        for (size_t i = 0; i < field->place.count; i++) read_each(node, units, unit, &value[i]);
}

static void read_formulas(const gough_field *field, const study_node *node,
                          const gough_units *units, gough_formula *value) {
    const gough_unit unit = gough_unit_of_field(field->unit);
    for (size_t i = 0; i < field->place.count; i++) {
        const study_node *text = node->kind == STUDY_LIST ? study_node_item(node, i) : node;
        value[i] = gough_formula_constant(0);
        (void)study_formula(text, units, unit, &value[i], NULL, NULL);
    }
}

static void read_value(const gough_field *field, const study_node *node, const gough_units *units,
                       void *value) {
    switch (field->place.kind) { /* unreachable: there is a case for each kind */
    case GOUGH_KIND_NUMBER:
        read_numbers(field, node, units, value);
        break;
    case GOUGH_KIND_FORMULA:
        read_formulas(field, node, units, value);
        break;
    case GOUGH_KIND_FLAG:
        *(bool *)value = study_choice_index(field->range, node->text) == 0;
        break;
    case GOUGH_KIND_CHOICE:
        *(int *)value = study_choice_index(field->range, node->text);
        break;
    case GOUGH_KIND_WHOLE:
        *(uint64_t *)value = (uint64_t)study_number(node);
        break;
    }
}

static void read_field(const gough_field *field, const study_node *node, const gough_units *units,
                       void *owner) {
    char *const start = owner;
    if (field->shape == GOUGH_SHAPE_NUMBER_OR_LEAST && study_is_least(node)) return;
    read_value(field, node, units, start + field->place.offset);
    if (field->place.given) *(bool *)(start + field->place.given) = true;
}

/* ---- parts ---- */

void study_part_reset(gough_study *study, unsigned part) {
    size_t count;
    const gough_field *field = gough_fields(&count);
    for (size_t i = 0; i < count; i++) {
        void *owner = owner_of(study, &field[i].place);
        if (owner && field[i].place.part == part) gough_place_reset(&field[i].place, owner);
    }
}

/* Whether a value is not simply read but follows a rule, which its reader knows. */
static bool has_rule(const gough_field *field, const study_node *node) {
    return field->shape == GOUGH_SHAPE_GRAVITY || field->shape == GOUGH_SHAPE_INERTIA ||
           (field->shape == GOUGH_SHAPE_GAINS && node->first && node->first->kind == STUDY_LIST) ||
           (field->shape == GOUGH_SHAPE_CONSTRAINTS && node->kind == STUDY_MAPPING);
}

void study_part_read(gough_study *study, const study_node *root, unsigned part) {
    size_t count;
    const gough_key *key = gough_study_keys(&count);
    for (size_t i = 0; i < count; i++) {
        void *owner = key[i].place.part == part ? owner_of(study, &key[i].place) : NULL;
        const study_node *node = owner ? study_node_at(root, key[i].path) : NULL;
        if (node && !study_node_section(node)->wrong && !has_rule(&key[i], node))
            read_field(&key[i], node, &study->units, owner);
    }
}

void study_element_read(void *element, gough_owner owner, const gough_units *units,
                        const study_node *node) {
    size_t count;
    const gough_key *key = gough_study_keys(&count);
    for (size_t i = 0; i < count; i++) {
        if (key[i].place.owner != owner) continue;
        const study_node *value = study_node_child(node, strrchr(key[i].path, '.') + 1);
        if (value) read_field(&key[i], value, units, element);
    }
}

/* ---- drives ---- */

/* A key of drives as that of one leg, from 1. */
static gough_field field_of_leg(const gough_key *key, const study_node *value, size_t leg) {
    gough_field one = *key;
    one.shape = study_shape_of(value, key);
    if (one.place.kind != GOUGH_KIND_NUMBER) return one;
    one.place.count /= GOUGH_LEGS;
    one.place.offset += (leg - 1) * one.place.count * sizeof(double);
    return one;
}

void study_drives_read(gough_study *study, const study_node *list) {
    size_t count;
    const gough_key *key = gough_study_keys(&count);
    for (size_t i = 0; i < count; i++) {
        if (strncmp(key[i].path, "actuators.", 10) != 0) continue;
        for (const study_node *drive = list->first; drive; drive = drive->next) {
            const study_node *value = study_node_child(drive, key[i].path + 10);
            if (!value) continue;
            const gough_field one = field_of_leg(&key[i], value, drive->number);
            read_field(&one, value, &study->units, study->model);
        }
    }
}
