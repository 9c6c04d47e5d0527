/* The units that a study chooses, and what depends on them while it is checked. */
#include "study/chosen_units.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "study/value.h"

static const char *const base_names[GOUGH_BASE_UNITS] = {[GOUGH_BASE_LENGTH] = "length",
                                                         [GOUGH_BASE_FORCE] = "force",
                                                         [GOUGH_BASE_MASS] = "mass",
                                                         [GOUGH_BASE_ANGLE] = "angle",
                                                         [GOUGH_BASE_TIME] = "time"};

gough_units study_units_of(const study_node *root) {
    const study_node *node = study_node_child(root, "units");
    gough_units units = gough_units_si();
    if (!node) return units;
    if (node->kind == STUDY_SCALAR) units.dimensionless = strcmp(node->text, "dimensionless") == 0;
    for (int b = 0; node->kind == STUDY_MAPPING && b < GOUGH_BASE_UNITS; b++) {
        const study_node *word = study_node_child(node, base_names[b]);
        if (word && word->kind == STUDY_SCALAR)
            gough_units_choose(&units, (gough_base_unit)b, word->text);
    }
    return units;
}

gough_units study_units_of_node(const study_node *node) {
    while (node->parent) node = node->parent;
    return study_units_of(node);
}

bool study_units_check(study_messages *messages, study_node *node, const char *path) {
    gough_units any = gough_units_si();
    if (strncmp(path, "units.", 6) != 0 || node->kind != STUDY_SCALAR) return false;
    const char *word = study_quote(messages->arena, node->text, node->length);
    const study_place place = study_node_place(node, node->empty);
    for (int b = 0; b < GOUGH_BASE_UNITS; b++) {
        if (!gough_units_choose(&any, (gough_base_unit)b, node->text)) continue;
        if (strcmp(base_names[b], path + 6) == 0) return false;
        study_node_say(messages, node, place, "`%s` must be a unit of %s; `%s` is one of %s", path,
                       path + 6, word, base_names[b]);
        return true;
    }
    if (!strpbrk(node->text, "/*^") && !strstr(node->text, "·")) return false;
    study_node_say(messages, node, place,
                   "`%s` must be a single unit, found `%s`; units such as N/mm follow from those "
                   "of length, force, mass, angle and time",
                   path, word);
    return true;
}

gough_bound study_units_bound(const study_node *node, const gough_key *key, char rule[STUDY_RULE]) {
    gough_bound bound = key->bound;
    const gough_unit unit = gough_unit_of_field(key->unit);
    if (unit != GOUGH_UNIT_ANGLE || !isfinite(bound.greatest)) return bound;
    const gough_units units = study_units_of_node(node), usual = gough_units_si();
    if (units.name[GOUGH_BASE_ANGLE] == usual.name[GOUGH_BASE_ANGLE]) return bound;
    const double factor = gough_unit_factor(&units, unit);
    bound.least = factor * gough_unit_read(&usual, unit, bound.least);
    bound.greatest = factor * gough_unit_read(&usual, unit, bound.greatest);
    snprintf(rule, STUDY_RULE, "%s (%.6g%s)", key->bound.rule, bound.greatest,
             gough_unit_word(&units, unit));
    bound.rule = rule;
    return bound;
}
