/* Overrides: the value is YAML, the key a dotted path with elements of lists by number from 1. */
#include "study/overrides.h"

#include <stdio.h>
#include <string.h>

#include "study/keys.h"
#include "study/source.h"
#include "study/value.h"

/* The setting as a text "key=value" to point into. */
static study_source *source_of(study_arena *arena, const gough_setting *setting, int rank) {
    const size_t key = strlen(setting->key), value = strlen(setting->value);
    study_source *source = study_arena_take(arena, sizeof *source);
    char *text = study_arena_take(arena, key + value + 2);
    char *name = study_arena_take(arena, 4 * key + sizeof "--set ");
    if (!source || !text || !name) return NULL;
    memcpy(text, setting->key, key);
    text[key] = '=';
    memcpy(text + key + 1, setting->value, value);
    sprintf(name, "--set %s", study_printable(arena, setting->key));
    *source = (study_source){name, text, key + value + 1, rank, true, 0, 0};
    return source;
}

/* Where the path of a swept key ends, that begins there: at the end, or before what such a key has. */
static size_t swept_end(const study_source *source, size_t begin, size_t end) {
    static const char *const names[] = {".from", ".to", ".steps", ".scale", ".uniform", ".normal"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        const size_t length = strlen(names[i]);
        if (end - begin > length && memcmp(source->text + end - length, names[i], length) == 0)
            return end - length;
    }
    return end;
}

/* Whether the node is that of `name` in a section of the study. */
static bool is_keys(const study_node *node, const char *section, const char *name) {
    return node->key && strcmp(node->key->text, name) == 0 && node->parent->key &&
           strcmp(node->parent->key->text, section) == 0 && !node->parent->parent->parent;
}

/* The next part of a path as a node that can be a key; below sweep.keys and design.vary that is a whole path. */
static study_node *next_part(study_arena *arena, const study_source *source, size_t *at, size_t end,
                             const study_node *parent) {
    const size_t begin = *at;
    if (is_keys(parent, "sweep", "keys")) *at = swept_end(source, begin, end);
    if (is_keys(parent, "design", "vary")) *at = end;
    while (*at < end && source->text[*at] != '.') ++*at;
    study_node *part = study_node_new(arena, STUDY_SCALAR, (study_place){source, begin});
    if (!part) return NULL;
    part->length = *at - begin;
    part->end = *at;
    part->text = study_arena_copy(arena, source->text + begin, part->length);
    if (!part->text) return NULL;
    if (*at < end) ++*at;
    return part;
}

/* The child of a list by its number, with an error where there is none. */
static study_node *item_of(study_messages *messages, study_node *list, const study_node *part) {
    size_t number = 0;
    for (size_t i = 0; i < part->length && number < 1000000; i++) {
        const char c = part->text[i];
        number = c >= '0' && c <= '9' ? 10 * number + (size_t)(c - '0') : 1000000;
    }
    study_node *item = number ? study_node_item(list, number - 1) : NULL;
    if (!item)
        study_say(messages, GOUGH_ERROR_INPUT, part->place,
                  "there is no element `%s` in this list of %zu, numbered from 1",
                  study_quote(messages->arena, part->text, part->length), list->count);
    return item;
}

/* The last child of that name, as a duplicate is an error anyway; a new mapping where there is none. */
static study_node *child_of(study_arena *arena, study_node *mapping, study_node *part) {
    study_node *child = study_node_child(mapping, part->text);
    if (child) return child;
    child = study_node_new(arena, STUDY_MAPPING, part->place);
    if (!child) return NULL;
    child->key = part;
    study_node_append(mapping, child);
    return child;
}

static bool is_number(const study_node *part) {
    return strspn(part->text, "0123456789") == part->length;
}

/* Walks to the node that the path names, creating what is not there; a scalar on the way gives way to a mapping. */
static study_node *find(study_messages *messages, study_node *root, const study_source *source,
                        size_t end) {
    study_node *node = root;
    for (size_t at = 0; node && at < end;) {
        study_node *part = next_part(messages->arena, source, &at, end, node);
        if (!part) return NULL;
        if (node->kind == STUDY_LIST) {
            node = item_of(messages, node, part);
        } else if (node->kind == STUDY_SCALAR && is_number(part)) {
            study_say(messages, GOUGH_ERROR_INPUT, part->place,
                      "`%s` is the number of a list element, but there is no list here; set the "
                      "whole list",
                      part->text);
            return NULL;
        } else {
            node->kind = STUDY_MAPPING;
            node = child_of(messages->arena, node, part);
            if (node && at == end) node->key = part;
        }
    }
    return node;
}

/* The path of a node as the table of keys has it: with N for the number of a move or a load. */
static bool is_known(study_arena *arena, const study_node *node) {
    const study_node *parent = node->parent;
    const char *path = !parent->parent ? ""
                       : parent->key   ? study_node_path(arena, parent)
                       : strcmp(parent->parent->key->text, "external") == 0  ? "external.N"
                       : strcmp(parent->parent->key->text, "actuators") == 0 ? "actuators"
                                                                             : "motion.moves.N";
    return study_key_find(path, node->key->text) != NULL;
}

/* Puts the new value where the old one is; no value takes the key away. */
static void replace(study_arena *arena, study_node *old, study_node *value,
                    const study_source *source) {
    study_node *parent = old->parent, *key = old->key, *next = old->next;
    const size_t number = old->number;
    if (!value) {
        /* what was only made on the way and is no known key stays, for the check to say so */
        if (!key || old->place.source != source || is_known(arena, old))
            study_node_remove(parent, old);
        return;
    }
    *old = *value;
    old->parent = parent;
    old->key = key;
    old->next = next;
    old->number = number;
    for (study_node *child = old->first; child; child = child->next) child->parent = old;
}

void study_setting_apply(study_messages *messages, study_node *root, const gough_setting *setting,
                         int rank) {
    const study_source *source = source_of(messages->arena, setting, rank);
    if (!source || !study_source_guard(messages, source, 0)) return;
    const size_t end = strlen(setting->key);
    const bool broken = end == 0 || source->text[0] == '.' || source->text[end - 1] == '.';
    if (broken || strstr(setting->key, "..")) {
        study_say(messages, GOUGH_ERROR_INPUT, (study_place){source, 0},
                  "a key such as control.stiffness was expected before the =");
        return;
    }
    const size_t before = messages->count;
    study_node *value = study_tree_parse(messages, source, end + 1);
    if (messages->count != before) return;
    study_node *node = find(messages, root, source, end);
    if (node) replace(messages->arena, node, value, source);
}
