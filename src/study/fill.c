/* From a checked tree to the structs by the table of fields: defaults, and the values that the tree gives.
 * Angles are in degrees in the file and in radians in the structs; those of formulas are turned when they are evaluated. */
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
static double *read_each(const study_node *node, double factor, double *value) {
    if (node->kind != STUDY_LIST) {
        *value = study_number(node) * factor;
        return value + 1;
    }
    for (const study_node *item = node->first; item; item = item->next)
        value = read_each(item, factor, value);
    return value;
}

void study_numbers(const study_node *list, double *value) { read_each(list, 1, value); }

static gough_formula read_formula(const study_node *node) {
    gough_formula formula = gough_formula_constant(0);
    gough_formula_compile(&formula, node->text, node->length, NULL, NULL);
    return formula;
}

/* A list gives each value; a scalar is for all of them, one pair for six pairs, and a scalar in place of a pair for both signs. */
static void read_numbers(const gough_field *field, const study_node *node, double *value) {
    const double factor = strstr(field->unit, "[degrees]") ? STUDY_DEGREE : 1;
    const bool one_pair =
        field->shape == GOUGH_SHAPE_PAIR_OR_SIX && node->first && node->first->kind == STUDY_SCALAR;
    if (one_pair)
        for (size_t i = 0; i < field->place.count; i += 2) read_each(node, factor, &value[i]);
    else if (node->kind == STUDY_LIST)
        read_each(node, factor, value);
    else if (field->shape == GOUGH_SHAPE_RANGE)
        value[1] = study_number(node) * factor, value[0] = -value[1];
    else
        for (size_t i = 0; i < field->place.count; i++) read_each(node, factor, &value[i]);
}

static void read_formulas(const gough_field *field, const study_node *node, gough_formula *value) {
    for (size_t i = 0; i < field->place.count; i++)
        value[i] = read_formula(node->kind == STUDY_LIST ? study_node_item(node, i) : node);
}

static void read_value(const gough_field *field, const study_node *node, void *value) {
    switch (field->place.kind) { /* unreachable: there is a case for each kind */
    case GOUGH_KIND_NUMBER:
        read_numbers(field, node, value);
        break;
    case GOUGH_KIND_FORMULA:
        read_formulas(field, node, value);
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

static void read_field(const gough_field *field, const study_node *node, void *owner) {
    char *const start = owner;
    read_value(field, node, start + field->place.offset);
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
           (field->shape == GOUGH_SHAPE_CONSTRAINTS && node->kind == STUDY_MAPPING);
}

void study_part_read(gough_study *study, const study_node *root, unsigned part) {
    size_t count;
    const gough_key *key = gough_study_keys(&count);
    for (size_t i = 0; i < count; i++) {
        void *owner = key[i].place.part == part ? owner_of(study, &key[i].place) : NULL;
        const study_node *node = owner ? study_node_at(root, key[i].path) : NULL;
        if (node && !study_node_section(node)->wrong && !has_rule(&key[i], node))
            read_field(&key[i], node, owner);
    }
}

void study_element_read(void *element, gough_owner owner, const study_node *node) {
    size_t count;
    const gough_key *key = gough_study_keys(&count);
    for (size_t i = 0; i < count; i++) {
        if (key[i].place.owner != owner) continue;
        const study_node *value = study_node_child(node, strrchr(key[i].path, '.') + 1);
        if (value && !value->wrong) read_field(&key[i], value, element);
    }
}
