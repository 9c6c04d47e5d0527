/* The section `design` of a study: checked beyond the table of keys. */
#include "study/design_plan.h"

#include <math.h>
#include <string.h>

#include "study/swept_number.h"
#include "study/value.h"

/* The requirement may not vary: a search would make it as small as it can. */
static bool is_requirement(study_messages *messages, study_node *node, const char *path) {
    if (strncmp(path, "workspace.", 10) != 0) return false;
    study_node_say(messages, node, study_node_place(node, true),
                   "`%s` belongs to the requirement that a design must meet, and cannot vary",
                   path);
    return true;
}

/* The study's own value, from which the search starts. */
static bool find_start(study_messages *messages, study_node *root, const study_axis *axis,
                       double *start) {
    const char *path = axis->key.path;
    const study_node *node = study_node_named(messages->arena, root, path);
    if (node && node->kind == STUDY_SCALAR) *start = study_number(node);
    if (node && node->kind == STUDY_SCALAR && isfinite(*start)) return true;
    if (node && node->wrong) return false;
    if (!node)
        study_node_say(messages, axis->node, study_node_place(axis->node, true),
                       "the study does not give `%s`; give it a number, from which the search "
                       "starts",
                       path);
    else
        study_node_say(messages, axis->node, study_node_place(axis->node, true),
                       "`%s` is not a number in this study; the search starts from a number", path);
    return false;
}

/* Both bounds must be numbers that the key may have. */
static bool check_bounds(study_messages *messages, const study_axis *axis) {
    bool good = true;
    for (study_node *item = axis->node->first; item && axis->bound; item = item->next)
        if (!study_check_number(messages, item, axis->bound)) good = false;
    return good;
}

static bool read_key(study_messages *messages, study_node *root, study_node *node,
                     study_design *design) {
    study_axis *axis = &design->axis[design->keys];
    gough_design_key *key = &design->key[design->keys];
    *axis = (study_axis){.node = node};
    axis->key.path = node->key->text;
    if (!study_target_find(messages, root, axis)) return false;
    if (is_requirement(messages, node, axis->key.path)) return false;
    *key = (gough_design_key){.path = axis->key.path, .unit = axis->key.unit};
    if (!find_start(messages, root, axis, &key->start)) return false;
    if (!check_bounds(messages, axis)) return false;
    key->least = study_number(node->first);
    key->greatest = study_number(node->first->next);
    return true;
}

static void read_weights(study_messages *messages, study_node *minimize, study_design *design) {
    double sum = 0;
    for (int k = 0; k < GOUGH_AIMS; k++) {
        const char *name = gough_aim_name((gough_aim)k);
        const study_node *weight = study_node_child(minimize, name);
        design->weight[k] = weight ? study_number(weight) : 0;
        if (minimize && minimize->kind == STUDY_SCALAR)
            design->weight[k] = strcmp(minimize->text, name) == 0 ? 1 : 0;
        sum += design->weight[k];
    }
    if (!minimize) design->weight[GOUGH_AIM_FORCE] = 1;
    if (minimize && !(sum > 0))
        study_node_say(messages, minimize, study_node_place(minimize, true),
                       "`design.minimize` needs a weight greater than 0, as in {force: 1}");
}

static void check_box(study_messages *messages, study_node *root, study_node *design) {
    const study_node *box = study_node_at(root, "workspace.box");
    if (box && (box->wrong || box->count > 0)) return;
    study_node_say(messages, design, study_node_place(design, true),
                   "`workspace.box` is missing: it is the requirement that a design must meet, as "
                   "in workspace: {box: {heave: 0.2, yaw: 10}}");
}

static void read_options(study_node *section, study_design *design) {
    const study_node *telescope = study_node_child(section, "telescope"),
                     *value = study_node_child(section, "least_singular_value"),
                     *seed = study_node_child(section, "seed"),
                     *evaluations = study_node_child(section, "evaluations");
    design->telescope = telescope ? study_number(telescope) : NAN;
    design->least_singular_value = value ? study_number(value) : 0;
    design->seed = seed ? (uint32_t)study_number(seed) : 0;
    design->evaluations = evaluations ? (size_t)study_number(evaluations) : 0;
}

bool study_design_make(study_messages *messages, study_node *root, study_design *design) {
    study_node *section = study_node_child(root, "design");
    *design = (study_design){.axis = NULL};
    if (!section || section->wrong) return false;
    study_node *vary = study_node_child(section, "vary");
    const size_t before = messages->count;
    if (vary->count > GOUGH_DESIGN_KEYS) {
        study_node_say(messages, vary, study_node_place(vary, true),
                       "`design.vary` has %zu keys; at most %d can vary", vary->count,
                       GOUGH_DESIGN_KEYS);
        return false;
    }
    design->axis = study_arena_take(messages->arena, vary->count * sizeof *design->axis);
    design->key = study_arena_take(messages->arena, vary->count * sizeof *design->key);
    if (!design->axis || !design->key) return false;
    for (study_node *node = vary->first; node; node = node->next)
        if (read_key(messages, root, node, design)) design->keys++;
    read_weights(messages, study_node_child(section, "minimize"), design);
    read_options(section, design);
    check_box(messages, root, section);
    return messages->count == before;
}
