/* From the path of a swept key to the key of the table, and to its place in the tree. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "study/chosen_units.h"
#include "study/motion.h"
#include "study/record_keys.h"
#include "study/sweep_plan.h"
#include "study/swept_number.h"
#include "study/value.h"

/* What a value of some shape is made of: how many numbers, at which depth of lists. */
typedef struct makeup {
    bool number, formula;
    bool alone;     /* may be one number */
    size_t list[2]; /* elements of its list and of the lists in it; 0: none */
} makeup;

static makeup makeup_of(gough_shape shape) {
    switch (shape) {
    case GOUGH_SHAPE_NUMBER:
    case GOUGH_SHAPE_NUMBER_OR_LEAST:
        return (makeup){.number = true, .alone = true};
    case GOUGH_SHAPE_PAIR:
        return (makeup){.number = true, .list = {2}};
    case GOUGH_SHAPE_VECTOR:
        return (makeup){.number = true, .list = {3}};
    case GOUGH_SHAPE_GRAVITY:
        return (makeup){.number = true, .alone = true, .list = {3}};
    case GOUGH_SHAPE_NUMBER_OR_SIX:
        return (makeup){.number = true, .alone = true, .list = {GOUGH_LEGS}};
    case GOUGH_SHAPE_PAIR_OR_SIX:
        return (makeup){.number = true, .list = {GOUGH_LEGS, 2}};
    case GOUGH_SHAPE_RANGE:
        return (makeup){.number = true, .alone = true, .list = {2}};
    case GOUGH_SHAPE_RANGE_OR_SIX:
        return (makeup){.number = true, .alone = true, .list = {GOUGH_LEGS, 2}};
    case GOUGH_SHAPE_GAINS:
        return (makeup){.number = true, .alone = true, .list = {GOUGH_LEGS, GOUGH_LEGS}};
    case GOUGH_SHAPE_POINTS:
        return (makeup){.number = true, .list = {GOUGH_LEGS, 3}};
    case GOUGH_SHAPE_INERTIA:
        return (makeup){.number = true, .list = {3, 3}};
    case GOUGH_SHAPE_FORMULA:
        return (makeup){.formula = true, .alone = true};
    case GOUGH_SHAPE_FORMULA_OR_SIX:
        return (makeup){.formula = true, .alone = true, .list = {GOUGH_LEGS}};
    case GOUGH_SHAPE_FORMULA_VECTOR:
        return (makeup){.formula = true, .list = {3}};
    default:
        return (makeup){.number = false};
    }
}

static bool is_mapping(gough_shape shape) {
    return shape == GOUGH_SHAPE_MAPPING || shape == GOUGH_SHAPE_CONSTRAINTS ||
           shape == GOUGH_SHAPE_SMOOTH || shape == GOUGH_SHAPE_UNITS || shape == GOUGH_SHAPE_AIMS ||
           shape == GOUGH_SHAPE_MOVES || shape == GOUGH_SHAPE_LOADS ||
           shape == GOUGH_SHAPE_DRIVES || shape == GOUGH_SHAPE_SAMPLES ||
           shape == GOUGH_SHAPE_COLUMN || shape == GOUGH_SHAPE_COLUMNS;
}

/* The next part of a path, cut off; NULL at its end. */
static char *take_part(char **rest) {
    char *part = *rest;
    char *dot = part ? strchr(part, '.') : NULL;
    if (dot) *dot = '\0';
    *rest = dot ? dot + 1 : NULL;
    return part;
}

/* The number of a list's element, from 1; 0 for anything else. */
static size_t number_of(const char *part) {
    const size_t length = strlen(part);
    if (length == 0 || length > 6 || part[0] == '0' || strspn(part, "0123456789") != length)
        return 0;
    return (size_t)strtol(part, NULL, 10);
}

/* Whether a path is in one of the sections that make numbers vary. */
static bool is_section(const char *path) {
    return strncmp(path, "sweep", 5) == 0 || strncmp(path, "design", 6) == 0;
}

/* The paths that can vary, without those of lists' elements. */
static const char *nearest_path(study_arena *arena, const char *path) {
    size_t keys, count = 0;
    const gough_key *key = gough_study_keys(&keys);
    const char **known = study_arena_take(arena, keys * sizeof *known);
    for (size_t i = 0; known && i < keys; i++) {
        const makeup made = makeup_of(key[i].shape);
        if ((made.number || made.formula) && !is_section(key[i].path)) known[count++] = key[i].path;
    }
    return study_nearest(path, known, count);
}

/* Follows the mappings of a path to the key of a value; what is left are numbers of elements. */
static const gough_key *walk_keys(char **rest) {
    const gough_key *key = NULL;
    const char *parent = "";
    while (*rest && (!key || is_mapping(key->shape))) {
        char *part = take_part(rest);
        if (key && (key->shape == GOUGH_SHAPE_MOVES || key->shape == GOUGH_SHAPE_LOADS)) {
            if (number_of(part) == 0) return NULL;
            parent = key->shape == GOUGH_SHAPE_MOVES ? "motion.moves.N" : "external.N";
            part = take_part(rest);
        }
        if (key && key->shape == GOUGH_SHAPE_COLUMNS) {
            if (study_quantity_of(part) < 0) return NULL;
            parent = "motion.samples.columns.KEY";
            part = take_part(rest);
        }
        /* the number of a drive, of a list of six */
        if (key && key->shape == GOUGH_SHAPE_DRIVES && number_of(part) > 0) part = take_part(rest);
        key = part ? study_key_find(parent, part) : NULL;
        if (!key) return NULL;
        parent = key->path;
    }
    return key;
}

static bool say_unknown(study_messages *messages, study_node *node, const char *path) {
    const char *nearest = nearest_path(messages->arena, path);
    study_node_say(
        messages, node, study_node_place(node, true), "`%s` is not a key of a study; %s%s%s", path,
        nearest ? "did you mean `" : "a path such as ",
        nearest ? nearest : "control.stiffness or load.mass", nearest ? "`?" : " was expected");
    return false;
}

/* `given`: the value in the study, NULL where it gives none. */
static bool say_no_number(study_messages *messages, study_node *node, const char *path,
                          const gough_key *key, const makeup *made, const study_node *given) {
    const bool lists = given && given->first
                           ? given->first->kind == STUDY_LIST
                           : made->list[1] && key->shape != GOUGH_SHAPE_PAIR_OR_SIX;
    if (made->list[0])
        study_node_say(messages, node, study_node_place(node, true),
                       "`%s` is not one number but %s: vary its elements, numbered from 1, as in "
                       "`%s.%s`",
                       path, key->type, path, lists ? "1.1" : "1");
    else
        study_node_say(messages, node, study_node_place(node, true),
                       "`%s` is not a number (%s) and cannot vary", path, key->type);
    return false;
}

/* Whether the elements that a path names can be of such a value. */
static bool check_elements(char *rest, const makeup *made, size_t *depth) {
    for (*depth = 0; rest; ++*depth) {
        const size_t number = number_of(take_part(&rest));
        if (*depth == 2 || number == 0 || number > made->list[*depth]) return false;
    }
    return true;
}

/* The node that a path leads to in the tree; the last one met where it leads nowhere, with what is left in *rest. */
static study_node *walk_tree(study_node *root, char **rest, char **missing) {
    study_node *node = root;
    *missing = NULL;
    while (*rest) {
        char *part = take_part(rest);
        study_node *next = node->kind == STUDY_LIST ? study_node_item(node, number_of(part) - 1)
                                                    : study_node_child(node, part);
        if (!next) {
            *missing = part;
            return node;
        }
        node = next;
    }
    return node;
}

/* The path of a list from that of an element, `depth` lists deep. */
static const char *list_path(study_arena *arena, const char *path, size_t depth) {
    char *list = study_arena_copy(arena, path, strlen(path));
    for (; list && depth > 0; depth--) *strrchr(list, '.') = '\0';
    return list ? list : path;
}

/* Elements vary only in lists that the study gives; a number alone may be left out of the file. */
static bool check_place(study_messages *messages, study_node *root, study_node *node,
                        const char *path, size_t depth) {
    char *copy = study_arena_copy(messages->arena, path, strlen(path)), *rest = copy, *missing;
    if (!copy) return false;
    const bool move = strncmp(path, "motion.moves.", 13) == 0;
    const bool load = strncmp(path, "external.", 9) == 0;
    const study_node *found = walk_tree(root, &rest, &missing);
    if (!missing && found->kind != STUDY_SCALAR && depth > 0) {
        study_node_say(messages, node, study_node_place(node, true),
                       "`%s` is a list in this study; vary an element of it, as in `%s.1`", path,
                       path);
        return false;
    }
    if (missing && found->kind == STUDY_LIST && number_of(missing) == 0) {
        study_node_say(messages, node, study_node_place(node, true),
                       "`%s`: `%s` is a list in this study; vary the number of one leg, as in "
                       "`%s.1%s`",
                       path, found->key->text, found->key->text, path + strlen(found->key->text));
        return false;
    }
    const bool drive = strncmp(path, "actuators.", 10) == 0 && path[10] <= '9'; /* a number */
    if (!missing || (depth == 0 && !move && !drive)) return true;
    if (depth == 0 && found->parent && !found->key && found->kind == STUDY_MAPPING) return true;
    const bool none = load && (found == root || found == study_node_child(root, "external"));
    const char *list = move                  ? "motion.moves"
                       : none                ? "external"
                       : drive && depth == 0 ? "actuators"
                                             : list_path(messages->arena, path, depth);
    study_node_say(messages, node, study_node_place(node, true),
                   "`%s`: the study has no list `%s` with such an element; add it to the study",
                   path, list);
    return false;
}

/* The bound of a key in the units of the study. */
static const gough_bound *bound_of(study_arena *arena, const study_node *node,
                                   const gough_key *key) {
    gough_bound *bound = study_arena_take(arena, sizeof *bound);
    char *rule = study_arena_take(arena, STUDY_RULE);
    if (!bound || !rule) return &key->bound;
    *bound = study_units_bound(node, key, rule);
    return bound;
}

study_node *study_node_named(study_arena *arena, study_node *root, const char *path) {
    char *rest = study_arena_copy(arena, path, strlen(path)), *missing = NULL;
    study_node *node = rest ? walk_tree(root, &rest, &missing) : NULL;
    return missing ? NULL : node;
}

bool study_target_find(study_messages *messages, study_node *root, study_axis *axis) {
    const char *path = axis->key.path;
    char *copy = study_arena_copy(messages->arena, path, strlen(path)), *rest = copy;
    if (!copy) return false;
    static const gough_bound any = {"", -INFINITY, INFINITY, false};
    const gough_key *key = walk_keys(&rest);
    if (!key || is_section(path)) return say_unknown(messages, axis->node, path);
    const makeup made = makeup_of(key->shape);
    size_t depth;
    const study_node *given = study_node_named(messages->arena, root, path);
    if (!made.number && !made.formula)
        return say_no_number(messages, axis->node, path, key, &made, given);
    if (!check_elements(rest, &made, &depth)) return say_unknown(messages, axis->node, path);
    if (depth == 0 && !made.alone)
        return say_no_number(messages, axis->node, path, key, &made, given);
    const bool free = (depth > 0 && key->shape == GOUGH_SHAPE_GRAVITY) ||
                      (depth == 2 && key->shape == GOUGH_SHAPE_GAINS);
    axis->bound = made.formula ? NULL : free ? &any : bound_of(messages->arena, axis->node, key);
    axis->key.unit = key->unit;
    axis->touches = key->place.part | key->place.also;
    if (axis->touches & (GOUGH_PART_MACHINE | GOUGH_PART_EXTERNAL) && study_moves_depend(root))
        axis->touches |= GOUGH_PART_MOTION;
    return check_place(messages, root, axis->node, path, depth);
}

static study_node *make_child(study_arena *arena, study_node *parent, const char *name,
                              study_kind kind) {
    study_node *child = study_node_new(arena, kind, parent->place);
    study_node *key = study_node_new(arena, STUDY_SCALAR, parent->place);
    if (!child || !key) return NULL;
    key->text = name;
    key->length = strlen(name);
    child->key = key;
    study_node_append(parent, child);
    return child;
}

study_node *study_plan_target(study_arena *arena, study_node *root, const study_axis *axis,
                              bool *made) {
    char *rest = study_arena_copy(arena, axis->key.path, strlen(axis->key.path)), *missing;
    *made = false;
    if (!rest) return NULL;
    study_node *node = walk_tree(root, &rest, &missing);
    *made = missing != NULL;
    while (node && missing) {
        node->kind = STUDY_MAPPING;
        node = make_child(arena, node, missing, rest ? STUDY_MAPPING : STUDY_SCALAR);
        missing = take_part(&rest);
    }
    return node;
}
