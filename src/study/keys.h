/* The rules behind the table of keys: what each value looks like and where its numbers may lie. */
#ifndef STUDY_KEYS_H
#define STUDY_KEYS_H

#include <stdbool.h>

#include "gough/study.h"

typedef enum study_shape {
    SHAPE_MAPPING,
    SHAPE_MOVES, /* a list of mappings */
    SHAPE_TEXT,
    SHAPE_FILE,
    SHAPE_CHOICE, /* one of the words of the bound */
    SHAPE_NUMBER,
    SHAPE_WHOLE, /* a number without decimals */
    SHAPE_PAIR,
    SHAPE_VECTOR,
    SHAPE_GRAVITY, /* a number within the bound, or any three */
    SHAPE_NUMBER_OR_SIX,
    SHAPE_POINTS,
    SHAPE_INERTIA,
    SHAPE_FORMULA,
    SHAPE_FORMULA_OR_SIX,
    SHAPE_FORMULA_VECTOR,
    SHAPE_CONSTRAINTS, /* a choice, or a mapping */
    SHAPE_SMOOTH,      /* likewise */
    SHAPE_SWEPT        /* a mapping of paths to what they vary over */
} study_shape;

typedef struct study_bound {
    const char *text; /* as in the table; of a choice its words */
    const char *rule; /* "must be …" */
    double least, greatest;
    bool open; /* the least value itself is excluded */
} study_bound;

typedef struct study_rule {
    const char *path;
    study_shape shape;
    study_bound bound;
} study_rule;

/* How many there are. */
enum {
    STUDY_RULES = 0
#define KEY(path, shape, unit, bound, fallback, sentence) +1
#include "study/keys.def"
#undef KEY
};

const study_rule *study_rules(size_t *count);

/* The same key as the public table has it. */
const gough_key *study_rule_key(const study_rule *rule);

bool study_rule_required(const study_rule *rule);

/* "a number", "six points [x, y, z]", …: for "must be …". */
const char *study_shape_phrase(study_shape shape);

/* The rule of the key `name` in the mapping of path `parent` ("" at the root); NULL if there is none. */
const study_rule *study_rule_find(const char *parent, const char *name);

/* Whether the rule is of a key directly in the mapping of path `parent`; its name there is then *name. */
bool study_rule_in(const study_rule *rule, const char *parent, const char **name);

/* The known name nearest to a misspelled one, or NULL where none is near. */
const char *study_nearest(const char *word, const char *const *names, size_t count);

#endif
