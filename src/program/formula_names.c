/* The names that a formula may use, and the nearest one to a name that it may not. */
#define NUMBER_DOUBLE
#include "program/formula_names.h"

#include <string.h>

#include "gough/text.h"
#include "program/program.h"

static const gough_word_ WORDS[] = {
    {"t", FORMULA_TIME, 0, "t"},
    {"pi", FORMULA_PI, 0, "pi"},
    {"sin", FORMULA_SIN, 1, "sin(x)"},
    {"cos", FORMULA_COS, 1, "cos(x)"},
    {"tan", FORMULA_TAN, 1, "tan(x)"},
    {"asin", FORMULA_ASIN, 1, "asin(x)"},
    {"acos", FORMULA_ACOS, 1, "acos(x)"},
    {"atan", FORMULA_ATAN, 1, "atan(x)"},
    {"atan2", FORMULA_ATAN2, 2, "atan2(y, x)"},
    {"exp", FORMULA_EXP, 1, "exp(x)"},
    {"log", FORMULA_LOG, 1, "log(x)"},
    {"sqrt", FORMULA_ROOT, 1, "sqrt(x)"},
    {"tanh", FORMULA_TANH, 1, "tanh(x)"},
    {"ramp", FORMULA_RAMP, 2, "ramp(t, T)"},
};
enum { WORD_COUNT = sizeof WORDS / sizeof WORDS[0], NAME_MAX_LENGTH = 12 };

/* What other languages call it, and how it is written here. */
static const char *const ELSEWHERE[][2] = {
    {"ln", "log(x)"},
    {"arcsin", "asin(x)"},
    {"arccos", "acos(x)"},
    {"arctan", "atan(x)"},
    {"pow", "x^p"},
    {"power", "x^p"},
    {"e", "exp(1)"},
    {"root", "sqrt(x)"},
    {"arctan2", "atan2(y, x)"},
    {"time", "t"},
    {"x", "t"},
    {"step", "ramp(t, T)"},
    {"sinh", "(exp(x) - exp(-x))/2"},
    {"cosh", "(exp(x) + exp(-x))/2"},
};

static int equals(const char *word, const char *name, size_t length) {
    return strlen(word) == length && memcmp(word, name, length) == 0;
}

const gough_word_ *gough_find_word_(const char *name, size_t length) {
    for (int i = 0; i < WORD_COUNT; i++)
        if (equals(WORDS[i].name, name, length)) return &WORDS[i];
    return NULL;
}

const gough_word_ *gough_word_of_(int code) {
    for (int i = 0; i < WORD_COUNT; i++) /* unreachable: each code is one of them */
        if (WORDS[i].code == code) return &WORDS[i];
    return NULL;
}

void gough_word_hint_(const char *name, size_t length, char hint[80]) {
    const char *names[WORD_COUNT], *meant = NULL;
    hint[0] = '\0';
    if (length > NAME_MAX_LENGTH) return;

    for (int i = 0; i < WORD_COUNT; i++) names[i] = WORDS[i].name;
    const int nearest = gough_word_nearest(name, length, names, WORD_COUNT);
    if (nearest >= 0) meant = names[nearest];
    for (size_t i = 0; i < sizeof ELSEWHERE / sizeof ELSEWHERE[0]; i++)
        if (equals(ELSEWHERE[i][0], name, length)) meant = ELSEWHERE[i][1];
    if (meant == NULL) return;
    strcpy(hint, ": did you mean '");
    strcat(hint, meant);
    strcat(hint, "'?");
}
