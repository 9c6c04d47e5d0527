/* The table of fields: each line of fields.def with its words. */
#include "base/unit_words.h"
#include "model/places.h"

/* ---- shapes and bounds by name ---- */

#define TYPE_MAPPING "mapping"
#define TYPE_MOVES "list of mappings"
#define TYPE_LOADS "list of mappings"
#define TYPE_TEXT "text"
#define TYPE_FILE "file"
#define TYPE_CHOICE "choice"
#define TYPE_NUMBER "number"
#define TYPE_PAIR "two numbers"
#define TYPE_NUMBER_OR_LEAST "number or least"
#define TYPE_VECTOR "three numbers"
#define TYPE_GRAVITY "number or three numbers"
#define TYPE_NUMBER_OR_SIX "number or six numbers"
#define TYPE_PAIR_OR_SIX "two numbers or six pairs"
#define TYPE_RANGE "number or two numbers"
#define TYPE_DRIVES "mapping or six mappings"
#define TYPE_RANGE_OR_SIX "number, two numbers or six of these"
#define TYPE_GAINS "number, six numbers or 6×6 matrix"
#define TYPE_POINTS "six points"
#define TYPE_INERTIA "three numbers or 3×3 matrix"
#define TYPE_FORMULA "formula"
#define TYPE_FORMULA_OR_SIX "formula or six formulas"
#define TYPE_FORMULA_VECTOR "three formulas"
#define TYPE_CONSTRAINTS "choice or mapping"
#define TYPE_SMOOTH "choice or mapping"
#define TYPE_UNITS "choice or mapping"
#define TYPE_WHOLE "whole number"
#define TYPE_SWEPT "mapping of paths"
#define TYPE_VARIED "mapping of paths"
#define TYPE_AIMS "choice or mapping"
#define TYPE_SAMPLES "file or mapping"
#define TYPE_COLUMN "column or mapping"
#define TYPE_COLUMNS "mapping of columns"

#define BOUND(text, rule, least, greatest, open)                                                   \
    .range = text, .bound = {rule, least, greatest, open}
#define WORDS(text) BOUND(text, "", -INFINITY, INFINITY, false)

#define BOUND_ANY WORDS("")
#define BOUND_ABOVE_ZERO BOUND("> 0", "greater than 0", 0, INFINITY, true)
#define BOUND_NOT_NEGATIVE BOUND(">= 0", "0 or greater", 0, INFINITY, false)
#define BOUND_NOT_NEGATIVE_AS_NUMBERS                                                              \
    BOUND(">= 0 outside a matrix", "0 or greater", 0, INFINITY, false)
#define BOUND_HALF_ANGLE BOUND("0 to 60", "from 0 to 60 degrees", 0, 60, false)
#define BOUND_SWING BOUND("> 0 to 180", "greater than 0, and at most 180 degrees", 0, 180, true)
#define BOUND_HALF_TURN BOUND("-180 to 180", "from -180 to 180 degrees", -180, 180, false)
#define BOUND_QUARTER_TURN BOUND("-90 to 90", "from -90 to 90 degrees", -90, 90, false)
#define BOUND_TOLERANCE BOUND("1e-30 to 0.1", "from 1e-30 to 0.1", 1e-30, 0.1, false)
#define BOUND_GRAVITY                                                                              \
    BOUND(">= 0 as a number", "0 or greater, downwards (or a vector [x, y, z])", 0, INFINITY, false)
#define BOUND_SEED                                                                                 \
    BOUND("0 to 9007199254740992", "a whole number from 0 to 9007199254740992", 0, 0x1p53, false)
#define BOUND_SEED_32                                                                              \
    BOUND("0 to 4294967295", "a whole number from 0 to 4294967295", 0, 4294967295, false)
#define BOUND_RUNS BOUND("1 to 100000000", "a whole number from 1 to 100000000", 1, 1e8, false)
#define BOUND_STEPS BOUND("2 to 100000000", "a whole number from 2 to 100000000", 2, 1e8, false)
#define BOUND_EVALUATIONS                                                                          \
    BOUND("10 to 1000000", "a whole number from 10 to 1000000", 10, 1e6, false)
#define BOUND_UNITS WORDS("si, dimensionless")
#define BOUND_LENGTHS WORDS(WORDS_OF(LENGTHS))
#define BOUND_FORCES WORDS(WORDS_OF(FORCES))
#define BOUND_MASSES WORDS(WORDS_OF(MASSES))
#define BOUND_ANGLES WORDS(WORDS_OF(ANGLES))
#define BOUND_TIMES WORDS(WORDS_OF(TIMES))
#define BOUND_FEEDFORWARD WORDS("program, none")
#define BOUND_KNOWN WORDS("false, true")
#define BOUND_EFFICIENCY BOUND("> 0, <= 1", "greater than 0, and at most 1", 0, 1, true)
#define BOUND_ACTUATORS WORDS("ideal, lag")
#define BOUND_LAW WORDS("leg")
#define BOUND_VELOCITY WORDS("exact, difference")
#define BOUND_AXES WORDS("top, base")
#define BOUND_ORDER WORDS("zyx, xyz")
#define BOUND_METHOD WORDS("dop853, rk4, rattle2, rattle4, rattle6, rattle8")
#define BOUND_CONSTRAINTS WORDS("projection, none")
#define BOUND_SMOOTH WORDS("rounding, none")
#define BOUND_COMBINE WORDS("product, zip")
#define BOUND_SCALE WORDS("lin, log")
#define BOUND_SKIP BOUND("0 to 100000", "a whole number from 0 to 100000", 0, 1e5, false)
#define BOUND_SEPARATOR WORDS("comma, semicolon, tab, blanks")
#define BOUND_DECIMAL WORDS("point, comma")
#define BOUND_FIRST WORDS("first")
#define BOUND_ROTATION WORDS("angles, quaternion, matrix")
#define BOUND_AIMS WORDS("force, stroke, speed, footprint")

/* ---- the table ---- */

#define KEY(path_, shape_, unit_, bound_, fallback_, sentence_, ...)                               \
    {.path = path_,                                                                                \
     .type = TYPE_##shape_,                                                                        \
     .unit = unit_,                                                                                \
     .sentence = sentence_,                                                                        \
     .is_key = true,                                                                               \
     .shape = GOUGH_SHAPE_##shape_,                                                                \
     BOUND_##bound_,                                                                               \
     .fallback = FIRST_OF(fallback_),                                                              \
     .place = {REST_OF(fallback_), __VA_ARGS__}},
#define MEMBER(path_, ...) {path_, "", "", "", "", "", .place = {__VA_ARGS__}},

static const gough_field fields[] = {
#include "model/fields.def"
};

const gough_field *gough_fields(size_t *count) {
    if (count) *count = sizeof fields / sizeof fields[0];
    return fields;
}
