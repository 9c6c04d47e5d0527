/* Keys of the study file: the table of fields as the reader asks it. */
#include "study/keys.h"

#include <string.h>

#include "gough/text.h"

const gough_key *gough_study_keys(size_t *count) {
    size_t fields, keys = 0;
    const gough_field *field = gough_fields(&fields);
    while (field[keys].is_key) keys++; /* the last fields are no keys */
    *count = keys;
    return field;
}

bool study_key_required(const gough_key *key) { return strcmp(key->fallback, "required") == 0; }

const char *study_shape_phrase(gough_shape shape) {
    static const char *const phrases[] = {
        [GOUGH_SHAPE_MAPPING] = "a mapping of keys to values",
        [GOUGH_SHAPE_MOVES] = "a list of moves such as {start: 1, duration: 2, heave: 0.1}",
        [GOUGH_SHAPE_LOADS] = "a list of 1 to 8 loads such as {force: [0, 0, 30]}",
        [GOUGH_SHAPE_TEXT] = "text",
        [GOUGH_SHAPE_FILE] = "the name of a file",
        [GOUGH_SHAPE_CHOICE] = "a word",
        [GOUGH_SHAPE_NUMBER] = "a number",
        [GOUGH_SHAPE_NUMBER_OR_LEAST] = "a number or the word least",
        [GOUGH_SHAPE_PAIR] = "a list of two numbers",
        [GOUGH_SHAPE_VECTOR] = "a list of three numbers",
        [GOUGH_SHAPE_GRAVITY] = "a number or a list of three numbers",
        [GOUGH_SHAPE_NUMBER_OR_SIX] = "a number or a list of six numbers",
        [GOUGH_SHAPE_PAIR_OR_SIX] = "a list of two numbers or a list of six such pairs",
        [GOUGH_SHAPE_RANGE] = "a number or a list of two numbers",
        [GOUGH_SHAPE_DRIVES] =
            "a mapping such as {kind: lag, time_constant: 0.005} or a list of six",
        [GOUGH_SHAPE_RANGE_OR_SIX] = "a number, a list of two numbers, or a list of six of these",
        [GOUGH_SHAPE_GAINS] = "a number, a list of six numbers or a 6×6 matrix [[…], …]",
        [GOUGH_SHAPE_POINTS] = "a list of six points [x, y, z]",
        [GOUGH_SHAPE_INERTIA] = "a list of three numbers or a 3×3 matrix [[…], […], […]]",
        [GOUGH_SHAPE_FORMULA] = "a formula",
        [GOUGH_SHAPE_FORMULA_OR_SIX] = "a formula or a list of six formulas",
        [GOUGH_SHAPE_FORMULA_VECTOR] = "a list of three formulas",
        [GOUGH_SHAPE_CONSTRAINTS] = "a word or {baumgarte: [alpha, beta]}",
        [GOUGH_SHAPE_SMOOTH] = "rounding, none or a mapping such as {heave: 0.0001}",
        [GOUGH_SHAPE_UNITS] = "si, dimensionless or a mapping such as {length: mm, force: N}",
        [GOUGH_SHAPE_WHOLE] = "a whole number",
        [GOUGH_SHAPE_SWEPT] = "a mapping such as {control.stiffness: [10, 20, 50]}",
        [GOUGH_SHAPE_VARIED] = "a mapping such as {platform.top.radius: [0.8, 1.9]}",
        [GOUGH_SHAPE_AIMS] =
            "force, stroke, speed, footprint or a mapping such as {force: 1, stroke: 0.5}",
        [GOUGH_SHAPE_SAMPLES] =
            "the name of a file or a mapping such as {file: log.csv, columns: {heave: 2}}",
        [GOUGH_SHAPE_COLUMN] =
            "the name or number of a column or a mapping such as {column: 2, unit: mm}",
        [GOUGH_SHAPE_COLUMNS] = "a mapping such as {heave: {column: 2, unit: mm}}",
    };
    return phrases[shape];
}

bool study_key_in(const gough_key *key, const char *parent, const char **name) {
    const size_t length = strlen(parent);
    const char *rest = key->path;
    if (length) {
        if (strncmp(rest, parent, length) != 0 || rest[length] != '.') return false;
        rest += length + 1;
    }
    *name = rest;
    return !strchr(rest, '.');
}

const gough_key *study_key_find(const char *parent, const char *name) {
    size_t keys;
    const gough_key *key = gough_study_keys(&keys);
    for (size_t i = 0; i < keys; i++) {
        const char *known;
        if (study_key_in(&key[i], parent, &known) && strcmp(known, name) == 0) return &key[i];
    }
    return NULL;
}

const char *study_nearest(const char *word, const char *const *names, size_t count) {
    const int nearest = gough_word_nearest(word, strlen(word), names, count);
    return nearest < 0 ? NULL : names[nearest];
}
