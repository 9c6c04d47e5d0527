/* The YAML of a study as a tree whose every node knows its place. */
#ifndef STUDY_TREE_H
#define STUDY_TREE_H

#include <stdbool.h>

#include "study/messages.h"

typedef enum study_kind { STUDY_SCALAR, STUDY_LIST, STUDY_MAPPING } study_kind;

typedef enum study_quoting {
    STUDY_PLAIN,
    STUDY_SINGLE_QUOTED,
    STUDY_DOUBLE_QUOTED,
    STUDY_BLOCK /* | or > */
} study_quoting;

typedef struct study_node {
    study_kind kind;
    study_quoting quoting;
    bool empty;        /* a scalar of which nothing is written */
    bool in_flow;      /* inside braces or brackets */
    bool wrong;        /* an error was said about it or about something in it */
    study_place place; /* of its first byte; of a quoted scalar the one after the quote */
    size_t end;        /* offset after its last byte */
    const char *text;  /* of a scalar, terminated, without NUL in it */
    size_t length;
    const char *meant;      /* the key that an unknown one is most like */
    struct study_node *key; /* its name, where it stands in a mapping */
    struct study_node *parent, *first, *last, *next;
    size_t count;  /* of children */
    size_t number; /* of the node among its parent's children, from 1 */
} study_node;

/* Parses the text of a guarded source from `begin`. NULL where it is empty or an error was said. */
study_node *study_tree_parse(study_messages *messages, const study_source *source, size_t begin);

study_node *study_node_new(study_arena *arena, study_kind kind, study_place place);
void study_node_append(study_node *parent, study_node *child);
void study_node_remove(study_node *parent, study_node *child);

/* The first child of that name; NULL if no child has it, or if parent is NULL or no mapping. */
study_node *study_node_child(const study_node *parent, const char *name);

/* Follows the keys of a path such as "control.stiffness" from a mapping: the last node that exists on the way, or NULL; *rest
 * is the part of the path that is missing, "" if nothing is. */
study_node *study_node_follow(const study_node *root, const char *path, const char **rest);

/* The node at the end of such a path, or NULL if the tree has no such node. */
study_node *study_node_at(const study_node *root, const char *path);

/* The child of the root that a node other than the root is in, or is. */
const study_node *study_node_section(const study_node *node);

/* Whether a misspelled child of the mapping stands for that name, so that it need not be called missing too. */
bool study_node_meant(const study_node *parent, const char *name);

/* The n-th child from 0; NULL beyond the last. */
study_node *study_node_item(const study_node *parent, size_t n);

/* Where messages about a node point: at its key if `name`, else at its value. */
study_place study_node_place(const study_node *node, bool name);

/* Place of the character that stands for byte `offset` of a scalar's text. */
study_place study_scalar_place(const study_node *node, size_t offset);

/* Says an error at a place in or about the node and marks the node and all above it as wrong. */
void study_node_say(study_messages *messages, study_node *node, study_place place,
                    const char *format, ...) __attribute__((format(printf, 4, 5)));

void study_node_mark(study_node *node);

#endif
