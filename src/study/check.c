/* Walks a study's tree against the table of keys: unknown, duplicate and missing keys, shapes, counts and ranges. */
#include "study/check.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "study/chosen_units.h"
#include "study/record_keys.h"
#include "study/value.h"

static void check_mapping(study_messages *messages, study_node *node, const char *parent);

/* The names known in a mapping, in memory of the arena. */
static const char **names_in(study_arena *arena, const char *parent, size_t *count) {
    size_t keys;
    const gough_key *key = gough_study_keys(&keys);
    const char **names = study_arena_take(arena, keys * sizeof *names);
    *count = 0;
    for (size_t i = 0; names && i < keys; i++)
        if (study_key_in(&key[i], parent, &names[*count])) ++*count;
    return names;
}

static const char *join(study_arena *arena, const char *const *names, size_t count) {
    size_t length = 1;
    for (size_t i = 0; i < count; i++) length += strlen(names[i]) + 2;
    char *list = study_arena_take(arena, length);
    if (!list) return "";
    for (size_t i = 0; i < count; i++) {
        if (i) strcat(list, ", ");
        strcat(list, names[i]);
    }
    return list;
}

/* The paths of all keys of that name, for one in a mapping that does not have it: "`load.mass`"; NULL if there are none. */
static const char *elsewhere(study_arena *arena, const char *name) {
    size_t keys, count = 0, length = 1;
    const gough_key *key = gough_study_keys(&keys);
    const char **path = study_arena_take(arena, keys * sizeof *path);
    for (size_t i = 0; path && i < keys; i++) {
        const char *dot = strrchr(key[i].path, '.');
        if (strcmp(dot ? dot + 1 : key[i].path, name) == 0) path[count++] = key[i].path;
    }
    for (size_t i = 0; i < count; i++) length += strlen(path[i]) + sizeof "``, ";
    char *list = count ? study_arena_take(arena, length) : NULL;
    for (size_t i = 0, at = 0; list && i < count; i++)
        at += (size_t)sprintf(list + at, "%s`%s`", i ? ", " : "", path[i]);
    return list;
}

/* Whether the node is the part after the comma of a formula cut in a flow mapping. */
static bool follows_cut(const study_node *before, const study_node *node) {
    return before && before->wrong && before->in_flow && before->kind == STUDY_SCALAR &&
           node->empty && strchr(before->text, '(') && strchr(node->key->text, ')');
}

static void say_unknown(study_messages *messages, const study_node *before, study_node *node,
                        const char *path) {
    size_t count;
    const char **names = names_in(messages->arena, path, &count);
    const char *key = study_quote(messages->arena, node->key->text, node->key->length);
    const char *nearest = study_nearest(node->key->text, names, count);
    const char *others = elsewhere(messages->arena, node->key->text);
    const char *and = others ? "; keys of that name elsewhere: " : "";
    const study_place place = study_node_place(node, true);
    if (follows_cut(before, node)) {
        study_node_mark(node);
    } else if (nearest) {
        node->meant = nearest;
        study_node_say(messages, node, place, "unknown key `%s`; did you mean `%s`?%s%s", key,
                       nearest, others ? " Keys of that name elsewhere: " : "",
                       others ? others : "");
    } else {
        study_node_say(messages, node, place, "unknown key `%s`; known here: %s%s%s", key,
                       join(messages->arena, names, count), and, others ? others : "");
    }
}

/* Checks the items of a list of `count` of them one by one. */
static bool check_count(study_messages *messages, study_node *node, size_t count,
                        const char *phrase) {
    if (node->kind != STUDY_LIST) {
        study_say_shape(messages, node, phrase);
        return false;
    }
    if (node->count == count) return true;
    study_node_say(messages, node, study_node_place(node, false),
                   "`%s` must be %s, found a list of %zu", study_node_path(messages->arena, node),
                   phrase, node->count);
    return false;
}

static bool check_numbers(study_messages *messages, study_node *node, size_t count,
                          const gough_bound *bound, const char *phrase) {
    if (!check_count(messages, node, count, phrase)) return false;
    bool good = true;
    for (study_node *item = node->first; item; item = item->next)
        if (!study_check_number(messages, item, bound)) good = false;
    return good;
}

/* A list of lists of numbers, each of three or as many as there are of them. */
static void check_rows(study_messages *messages, study_node *node, size_t count, bool square,
                       const char *phrase) {
    static const gough_bound any = {"", -INFINITY, INFINITY, false};
    const bool long_rows = square && count == GOUGH_LEGS;
    if (!check_count(messages, node, count, phrase)) return;
    for (study_node *row = node->first; row; row = row->next)
        check_numbers(messages, row, long_rows ? GOUGH_LEGS : 3, &any,
                      long_rows ? "a list of six numbers" : "a list of three numbers");
}

/* A pair of limits, the least first. */
static void check_limits(study_messages *messages, study_node *pair, const gough_bound *bound,
                         const char *phrase) {
    if (!check_numbers(messages, pair, 2, bound, phrase)) return;
    if (study_number(pair->first) < study_number(pair->first->next)) return;
    study_node_say(messages, pair, study_node_place(pair, false),
                   "`%s` must be [least, greatest], the first below the second",
                   study_node_path(messages->arena, pair));
}

/* One pair of limits for all legs, or six. */
static void check_pairs(study_messages *messages, study_node *node, const gough_key *key) {
    const char *phrase = study_shape_phrase(key->shape);
    if (node->kind != STUDY_LIST || !node->first || node->first->kind == STUDY_SCALAR) {
        check_limits(messages, node, &key->bound, phrase);
        return;
    }
    if (!check_count(messages, node, GOUGH_LEGS, phrase)) return;
    for (study_node *pair = node->first; pair; pair = pair->next)
        check_limits(messages, pair, &key->bound, "a list of two numbers");
}

/* A pair of limits, or a number x for the pair −x, x. */
static void check_range(study_messages *messages, study_node *node, const gough_key *key,
                        const char *phrase) {
    if (node->kind == STUDY_LIST) {
        check_limits(messages, node, &key->bound, phrase);
        return;
    }
    if (node->kind != STUDY_SCALAR || node->length == 0) {
        study_say_shape(messages, node, phrase);
        return;
    }
    if (!study_check_number(messages, node, &key->bound) || study_number(node) > 0) return;
    study_node_say(messages, node, study_node_place(node, false),
                   "`%s` as one number means both signs and must be greater than 0, found `%s`; a "
                   "range is [least, greatest]",
                   study_node_path(messages->arena, node),
                   study_quote(messages->arena, node->text, node->length));
}

/* Such a range for all legs, or six. */
static void check_ranges(study_messages *messages, study_node *node, const gough_key *key) {
    const bool six = node->kind == STUDY_LIST && node->first &&
                     (node->count == GOUGH_LEGS || node->first->kind == STUDY_LIST);
    const char *phrase = study_shape_phrase(key->shape);
    if (!six) {
        check_range(messages, node, key, phrase);
        return;
    }
    if (!check_count(messages, node, GOUGH_LEGS, phrase)) return;
    for (study_node *item = node->first; item; item = item->next)
        check_range(messages, item, key, study_shape_phrase(GOUGH_SHAPE_RANGE));
}

static void check_formulas(study_messages *messages, study_node *node, size_t count,
                           const char *phrase) {
    bool good = true;
    /* a formula cut at its comma explains why the list is too long */
    for (study_node *item = node->kind == STUDY_LIST ? node->first : NULL; item && good;
         item = item->next)
        if (node->count != count && item->kind == STUDY_SCALAR && item->in_flow &&
            strchr(item->text, '('))
            good = study_check_formula(messages, item);
    if (!good || !check_count(messages, node, count, phrase)) return;
    for (study_node *item = node->first; item; item = item->next)
        study_check_formula(messages, item);
}

/* A list of mappings whose keys are those of the path `element`; an item such as `example`. */
static void check_mappings(study_messages *messages, study_node *node, size_t most,
                           const char *phrase, const char *element, const char *example) {
    if (node->kind != STUDY_LIST || node->count == 0 || node->count > most) {
        study_say_shape(messages, node, phrase);
        return;
    }
    for (study_node *item = node->first; item; item = item->next)
        if (item->kind == STUDY_MAPPING)
            check_mapping(messages, item, element);
        else
            study_say_shape(messages, item, example);
}

static void say_duplicate(study_messages *messages, study_node *node, const study_node *first);

static void check_whole(study_messages *messages, study_node *node, const gough_bound *bound) {
    if (!study_check_number(messages, node, bound)) return;
    const double value = study_number(node);
    if (value - floor(value) > 0)
        study_node_say(messages, node, study_node_place(node, false), "`%s` must be %s, found %s",
                       study_node_path(messages->arena, node), bound->rule, node->text);
}

/* What each path varies over; whether there is such a path is found with the plan. */
static void check_swept(study_messages *messages, study_node *node) {
    static const gough_bound any = {"", -INFINITY, INFINITY, false};
    if (node->kind != STUDY_MAPPING || node->count == 0) {
        study_say_shape(messages, node, study_shape_phrase(GOUGH_SHAPE_SWEPT));
        return;
    }
    for (study_node *swept = node->first; swept; swept = swept->next) {
        const study_node *first = study_node_child(node, swept->key->text);
        if (first != swept)
            say_duplicate(messages, swept, first);
        else if (swept->kind == STUDY_MAPPING)
            check_mapping(messages, swept, "sweep.keys.KEY");
        else if (swept->kind == STUDY_LIST && swept->count > 0)
            check_numbers(messages, swept, swept->count, &any, "a list of numbers");
        else
            study_say_shape(messages, swept,
                            "a list of numbers, {from: 1, to: 10, steps: 10}, {uniform: [low, "
                            "high]} or {normal: [mean, deviation]}");
    }
}

/* Between which numbers each path varies; whether there is such a path is found with the plan. */
static void check_varied(study_messages *messages, study_node *node) {
    static const gough_bound any = {"", -INFINITY, INFINITY, false};
    if (node->kind != STUDY_MAPPING || node->count == 0) {
        study_say_shape(messages, node, study_shape_phrase(GOUGH_SHAPE_VARIED));
        return;
    }
    for (study_node *varied = node->first; varied; varied = varied->next) {
        const study_node *first = study_node_child(node, varied->key->text);
        if (first != varied)
            say_duplicate(messages, varied, first);
        else
            check_limits(messages, varied, &any, "a list of two numbers");
    }
}

/* A number, a list of numbers, or lists of them. */
static void check_numeric(study_messages *messages, study_node *node, const gough_key *key) {
    static const gough_bound any = {"", -INFINITY, INFINITY, false};
    const gough_shape shape = study_shape_of(node, key);
    const char *phrase = study_shape_phrase(shape);
    const bool single = node->kind == STUDY_SCALAR && node->length > 0;
    const bool rows = node->kind == STUDY_LIST && node->first && node->first->kind == STUDY_LIST;
    char rule[STUDY_RULE];
    const gough_bound bound = study_units_bound(node, key, rule);
    gough_key own = *key; /* in the units of the study */
    own.bound = bound;
    if (shape == GOUGH_SHAPE_WHOLE) {
        check_whole(messages, node, &key->bound);
    } else if (shape == GOUGH_SHAPE_NUMBER_OR_LEAST && study_is_least(node)) {
        return;
    } else if (shape == GOUGH_SHAPE_NUMBER || shape == GOUGH_SHAPE_NUMBER_OR_LEAST ||
               (single && (shape == GOUGH_SHAPE_GRAVITY || shape == GOUGH_SHAPE_NUMBER_OR_SIX ||
                           shape == GOUGH_SHAPE_GAINS))) {
        study_check_number(messages, node, &bound);
    } else if (shape == GOUGH_SHAPE_PAIR_OR_SIX) {
        check_pairs(messages, node, &own);
    } else if (shape == GOUGH_SHAPE_RANGE) {
        check_range(messages, node, &own, phrase);
    } else if (shape == GOUGH_SHAPE_RANGE_OR_SIX) {
        check_ranges(messages, node, &own);
    } else if (shape == GOUGH_SHAPE_POINTS) {
        check_rows(messages, node, GOUGH_LEGS, false, phrase);
    } else if (shape == GOUGH_SHAPE_GAINS && rows) {
        check_rows(messages, node, GOUGH_LEGS, true, phrase);
    } else if (shape == GOUGH_SHAPE_INERTIA && rows) {
        check_rows(messages, node, 3, true, phrase);
    } else if (shape == GOUGH_SHAPE_GRAVITY || shape == GOUGH_SHAPE_INERTIA) {
        check_numbers(messages, node, 3, &any, phrase);
    } else {
        const size_t count = shape == GOUGH_SHAPE_PAIR     ? 2
                             : shape == GOUGH_SHAPE_VECTOR ? 3
                                                           : GOUGH_LEGS;
        check_numbers(messages, node, count, &bound, phrase);
    }
}

/* A mapping, or for some keys a word in its place. */
static void check_mapping_or_word(study_messages *messages, study_node *node,
                                  const gough_key *key) {
    if (node->kind == STUDY_MAPPING)
        check_mapping(messages, node, key->path);
    else if (node->kind == STUDY_SCALAR && node->length > 0 && key->shape != GOUGH_SHAPE_MAPPING)
        study_check_choice(messages, node, key->range);
    else
        study_say_shape(messages, node, study_shape_phrase(key->shape));
}

/* One mapping for all legs, or six; all of them say the same keys. */
static void check_drives(study_messages *messages, study_node *node, const gough_key *key) {
    static const char example[] = "a mapping such as {kind: lag, time_constant: 0.005}";
    if (node->kind == STUDY_MAPPING)
        check_mapping(messages, node, key->path);
    else if (node->kind == STUDY_LIST && node->count == GOUGH_LEGS)
        check_mappings(messages, node, GOUGH_LEGS, example, key->path, example);
    else if (node->kind == STUDY_LIST && node->count > 0)
        check_count(messages, node, GOUGH_LEGS, study_shape_phrase(key->shape));
    else
        study_say_shape(messages, node, study_shape_phrase(key->shape));
}

/* A column of a record: its name or number, or a mapping with keys of the path `parent`. */
static void check_column(study_messages *messages, study_node *node, const char *parent) {
    if (node->kind == STUDY_MAPPING && node->count > 0)
        check_mapping(messages, node, parent);
    else if (node->kind == STUDY_SCALAR && node->length > 0)
        study_check_text(messages, node, GOUGH_SHAPE_FILE);
    else
        study_say_shape(messages, node, study_shape_phrase(GOUGH_SHAPE_COLUMN));
}

/* The columns of a record by what they are. */
static void check_columns(study_messages *messages, study_node *node) {
    const char *names[STUDY_QUANTITIES];
    for (int q = 0; q < STUDY_QUANTITIES; q++) names[q] = study_quantity_name(q);
    if (node->kind != STUDY_MAPPING || node->count == 0) {
        study_say_shape(messages, node, study_shape_phrase(GOUGH_SHAPE_COLUMNS));
        return;
    }
    for (study_node *column = node->first; column; column = column->next) {
        const study_node *first = study_node_child(node, column->key->text);
        if (study_quantity_of(column->key->text) < 0) {
            const char *nearest = study_nearest(column->key->text, names, STUDY_QUANTITIES);
            study_node_say(messages, column, study_node_place(column, true),
                           "unknown key `%s`; %s%s%s",
                           study_quote(messages->arena, column->key->text, column->key->length),
                           nearest ? "did you mean `" : "known here: ",
                           nearest ? nearest : join(messages->arena, names, STUDY_QUANTITIES),
                           nearest ? "`?" : "");
        } else if (first != column) {
            say_duplicate(messages, column, first);
        } else {
            check_column(messages, column, "motion.samples.columns.KEY");
        }
    }
}

/* A file or column alone, or a mapping about it. */
static void check_record(study_messages *messages, study_node *node, const gough_key *key) {
    if (key->shape == GOUGH_SHAPE_COLUMNS)
        check_columns(messages, node);
    else if (key->shape == GOUGH_SHAPE_COLUMN)
        check_column(messages, node, key->path);
    else if (node->kind == STUDY_MAPPING && node->count > 0)
        check_mapping(messages, node, key->path);
    else if (node->kind == STUDY_SCALAR && node->length > 0)
        study_check_text(messages, node, GOUGH_SHAPE_FILE);
    else
        study_say_shape(messages, node, study_shape_phrase(key->shape));
}

static void check_value(study_messages *messages, study_node *node, const gough_key *key) {
    const char *phrase = study_shape_phrase(key->shape);
    const bool single = node->kind == STUDY_SCALAR && node->length > 0;
    switch (key->shape) {
    case GOUGH_SHAPE_MAPPING:
    case GOUGH_SHAPE_CONSTRAINTS:
    case GOUGH_SHAPE_SMOOTH:
    case GOUGH_SHAPE_UNITS:
    case GOUGH_SHAPE_AIMS:
        check_mapping_or_word(messages, node, key);
        break;
    case GOUGH_SHAPE_MOVES:
        check_mappings(messages, node, SIZE_MAX, phrase, "motion.moves.N",
                       "a mapping such as {start: 1, duration: 2, heave: 0.1}");
        break;
    case GOUGH_SHAPE_LOADS:
        check_mappings(messages, node, GOUGH_EXTERNALS, phrase, "external.N",
                       "a mapping such as {force: [0, 0, 30]}");
        break;
    case GOUGH_SHAPE_DRIVES:
        check_drives(messages, node, key);
        break;
    case GOUGH_SHAPE_TEXT:
    case GOUGH_SHAPE_FILE:
        study_check_text(messages, node, key->shape);
        break;
    case GOUGH_SHAPE_CHOICE:
        if (!study_units_check(messages, node, key->path))
            study_check_choice(messages, node, key->range);
        break;
    case GOUGH_SHAPE_SAMPLES:
    case GOUGH_SHAPE_COLUMN:
    case GOUGH_SHAPE_COLUMNS:
        check_record(messages, node, key);
        break;
    case GOUGH_SHAPE_SWEPT:
        check_swept(messages, node);
        break;
    case GOUGH_SHAPE_VARIED:
        check_varied(messages, node);
        break;
    case GOUGH_SHAPE_FORMULA:
        study_check_formula(messages, node);
        break;
    case GOUGH_SHAPE_FORMULA_OR_SIX:
        if (single)
            study_check_formula(messages, node);
        else
            check_formulas(messages, node, GOUGH_LEGS, phrase);
        break;
    case GOUGH_SHAPE_FORMULA_VECTOR:
        check_formulas(messages, node, 3, phrase);
        break;
    default: /* numbers, and lists of them */
        check_numeric(messages, node, key);
        break;
    }
}

/* Says which required keys a mapping lacks. */
static void check_missing(study_messages *messages, study_node *node, const char *parent) {
    size_t keys;
    const gough_key *key = gough_study_keys(&keys);
    for (size_t i = 0; i < keys; i++) {
        const char *name;
        if (!study_key_required(&key[i]) || !study_key_in(&key[i], parent, &name)) continue;
        if (study_node_child(node, name) || study_node_meant(node, name)) continue;
        const bool top = !node->parent;
        study_node_say(messages, node, study_node_place(node, true), "`%s%s%s` is missing: %s",
                       top ? "" : study_node_path(messages->arena, node), top ? "" : ".", name,
                       key[i].sentence);
    }
}

static void say_duplicate(study_messages *messages, study_node *node, const study_node *first) {
    size_t line, column;
    const study_node *name = first->key;
    study_place_find(name->place, &line, &column);
    study_node_say(messages, node, study_node_place(node, true),
                   "duplicate key `%s`: it is already set in line %zu", name->text, line);
}

static void check_mapping(study_messages *messages, study_node *node, const char *parent) {
    const study_node *before = NULL;
    for (study_node *child = node->first; child; before = child, child = child->next) {
        const gough_key *key = study_key_find(parent, child->key->text);
        const study_node *first = study_node_child(node, child->key->text);
        if (!key)
            say_unknown(messages, before, child, parent);
        else if (first != child)
            say_duplicate(messages, child, first);
        else
            check_value(messages, child, key);
    }
    check_missing(messages, node, parent);
}

void study_check(study_messages *messages, study_node *root) {
    if (root->kind == STUDY_MAPPING)
        check_mapping(messages, root, "");
    else
        study_node_say(
            messages, root, study_node_place(root, false),
            "a study is a mapping that begins with keys such as `title:` and `platform:`");
}
