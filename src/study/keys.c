/* The table of keys, spelled out for people and for the checks from the one list in keys.def. */
#include "study/keys.h"

#include <math.h>
#include <string.h>

#include "gough/text.h"

#define NAME_MAPPING "mapping"
#define NAME_MOVES "list of mappings"
#define NAME_TEXT "text"
#define NAME_FILE "file"
#define NAME_CHOICE "choice"
#define NAME_NUMBER "number"
#define NAME_PAIR "two numbers"
#define NAME_VECTOR "three numbers"
#define NAME_GRAVITY "number or three numbers"
#define NAME_NUMBER_OR_SIX "number or six numbers"
#define NAME_POINTS "six points"
#define NAME_INERTIA "three numbers or 3×3 matrix"
#define NAME_FORMULA "formula"
#define NAME_FORMULA_OR_SIX "formula or six formulas"
#define NAME_FORMULA_VECTOR "three formulas"
#define NAME_CONSTRAINTS "choice or mapping"
#define NAME_SMOOTH "choice or mapping"
#define NAME_WHOLE "whole number"
#define NAME_SWEPT "mapping of paths"

#define TEXT_ANY ""
#define TEXT_ABOVE_ZERO "> 0"
#define TEXT_NOT_NEGATIVE ">= 0"
#define TEXT_HALF_ANGLE "0 to 60"
#define TEXT_TOLERANCE "1e-30 to 0.1"
#define TEXT_GRAVITY ">= 0 as a number"
#define TEXT_UNITS "si, dimensionless"
#define TEXT_FEEDFORWARD "program, none"
#define TEXT_METHOD "dop853, rk4, rattle2, rattle4, rattle6, rattle8"
#define TEXT_CONSTRAINTS "projection, none"
#define TEXT_SMOOTH "rounding, none"
#define TEXT_SEED "0 to 9007199254740992"
#define TEXT_RUNS "1 to 100000000"
#define TEXT_STEPS "2 to 100000000"
#define TEXT_COMBINE "product, zip"
#define TEXT_SCALE "lin, log"

#define BOUND_ANY                                                                                  \
    { TEXT_ANY, "", -INFINITY, INFINITY, false }
#define BOUND_ABOVE_ZERO                                                                           \
    { TEXT_ABOVE_ZERO, "greater than 0", 0, INFINITY, true }
#define BOUND_NOT_NEGATIVE                                                                         \
    { TEXT_NOT_NEGATIVE, "0 or greater", 0, INFINITY, false }
#define BOUND_HALF_ANGLE                                                                           \
    { TEXT_HALF_ANGLE, "from 0 to 60 degrees", 0, 60, false }
#define BOUND_TOLERANCE                                                                            \
    { TEXT_TOLERANCE, "from 1e-30 to 0.1", 1e-30, 0.1, false }
#define BOUND_GRAVITY                                                                              \
    { TEXT_GRAVITY, "0 or greater, downwards (or a vector [x, y, z])", 0, INFINITY, false }
#define BOUND_UNITS                                                                                \
    { TEXT_UNITS, "", -INFINITY, INFINITY, false }
#define BOUND_FEEDFORWARD                                                                          \
    { TEXT_FEEDFORWARD, "", -INFINITY, INFINITY, false }
#define BOUND_METHOD                                                                               \
    { TEXT_METHOD, "", -INFINITY, INFINITY, false }
#define BOUND_CONSTRAINTS                                                                          \
    { TEXT_CONSTRAINTS, "", -INFINITY, INFINITY, false }
#define BOUND_SMOOTH                                                                               \
    { TEXT_SMOOTH, "", -INFINITY, INFINITY, false }
#define BOUND_SEED                                                                                 \
    { TEXT_SEED, "a whole number from 0 to 9007199254740992", 0, 0x1p53, false }
#define BOUND_RUNS                                                                                 \
    { TEXT_RUNS, "a whole number from 1 to 100000000", 1, 1e8, false }
#define BOUND_STEPS                                                                                \
    { TEXT_STEPS, "a whole number from 2 to 100000000", 2, 1e8, false }
#define BOUND_COMBINE                                                                              \
    { TEXT_COMBINE, "", -INFINITY, INFINITY, false }
#define BOUND_SCALE                                                                                \
    { TEXT_SCALE, "", -INFINITY, INFINITY, false }

#define KEY(path, shape, unit, bound, fallback, sentence)                                          \
    {path, NAME_##shape, unit, TEXT_##bound, fallback, sentence},
static const gough_key public_keys[] = {
#include "study/keys.def"
};
#undef KEY

#define KEY(path, shape, unit, bound, fallback, sentence) {path, SHAPE_##shape, BOUND_##bound},
static const study_rule rules[] = {
#include "study/keys.def"
};
#undef KEY

const gough_key *gough_study_keys(size_t *count) {
    if (count) *count = STUDY_RULES;
    return public_keys;
}

const study_rule *study_rules(size_t *count) {
    *count = STUDY_RULES;
    return rules;
}

const gough_key *study_rule_key(const study_rule *rule) { return &public_keys[rule - rules]; }

bool study_rule_required(const study_rule *rule) {
    return strcmp(study_rule_key(rule)->fallback, "required") == 0;
}

const char *study_shape_phrase(study_shape shape) {
    static const char *const phrases[] = {
        [SHAPE_MAPPING] = "a mapping of keys to values",
        [SHAPE_MOVES] = "a list of moves such as {start: 1, duration: 2, heave: 0.1}",
        [SHAPE_TEXT] = "text",
        [SHAPE_FILE] = "the name of a file",
        [SHAPE_CHOICE] = "a word",
        [SHAPE_NUMBER] = "a number",
        [SHAPE_PAIR] = "a list of two numbers",
        [SHAPE_VECTOR] = "a list of three numbers",
        [SHAPE_GRAVITY] = "a number or a list of three numbers",
        [SHAPE_NUMBER_OR_SIX] = "a number or a list of six numbers",
        [SHAPE_POINTS] = "a list of six points [x, y, z]",
        [SHAPE_INERTIA] = "a list of three numbers or a 3×3 matrix [[…], […], […]]",
        [SHAPE_FORMULA] = "a formula",
        [SHAPE_FORMULA_OR_SIX] = "a formula or a list of six formulas",
        [SHAPE_FORMULA_VECTOR] = "a list of three formulas",
        [SHAPE_CONSTRAINTS] = "a word or {baumgarte: [alpha, beta]}",
        [SHAPE_SMOOTH] = "rounding, none or a mapping such as {heave: 0.0001}",
        [SHAPE_WHOLE] = "a whole number",
        [SHAPE_SWEPT] = "a mapping such as {control.stiffness: [10, 20, 50]}",
    };
    return phrases[shape];
}

bool study_rule_in(const study_rule *rule, const char *parent, const char **name) {
    const size_t length = strlen(parent);
    const char *rest = rule->path;
    if (length) {
        if (strncmp(rest, parent, length) != 0 || rest[length] != '.') return false;
        rest += length + 1;
    }
    *name = rest;
    return !strchr(rest, '.');
}

const study_rule *study_rule_find(const char *parent, const char *name) {
    for (size_t i = 0; i < STUDY_RULES; i++) {
        const char *known;
        if (study_rule_in(&rules[i], parent, &known) && strcmp(known, name) == 0) return &rules[i];
    }
    return NULL;
}

const char *study_nearest(const char *word, const char *const *names, size_t count) {
    const int nearest = gough_word_nearest(word, strlen(word), names, count);
    return nearest < 0 ? NULL : names[nearest];
}
