/* The names that a formula may use, and the nearest one to a name that it may not. */
#define NUMBER_DOUBLE
#include "model/words.h"

#include <string.h>

#include "model/program.h"

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
    for (int i = 0; i < WORD_COUNT; i++)
        if (WORDS[i].code == code) return &WORDS[i];
    return NULL;
}

static char lower(char c) { return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c; }

/* Fewest insertions, deletions and replacements that lead from a to b, capital letters counting
 * as small ones; b is at most NAME_MAX_LENGTH long. Row by row of the table of distances between
 * the beginnings of both. */
static size_t edit_distance(const char *a, size_t a_length, const char *b, size_t b_length) {
    size_t row[NAME_MAX_LENGTH + 1];
    for (size_t j = 0; j <= b_length; j++) row[j] = j;
    for (size_t i = 1; i <= a_length; i++) {
        size_t diagonal = row[0];
        row[0] = i;
        for (size_t j = 1; j <= b_length; j++) {
            const size_t replaced = diagonal + (lower(a[i - 1]) != lower(b[j - 1]));
            const size_t shorter = (row[j] < row[j - 1] ? row[j] : row[j - 1]) + 1;
            diagonal = row[j];
            row[j] = replaced < shorter ? replaced : shorter;
        }
    }
    return row[b_length];
}

void gough_word_hint_(const char *name, size_t length, char hint[80]) {
    const char *meant = NULL;
    hint[0] = '\0';
    if (length > NAME_MAX_LENGTH) return;

    /* half of the longer name may differ, but never all of it */
    size_t least = 3;
    for (int i = 0; i < WORD_COUNT; i++) {
        const size_t word_length = strlen(WORDS[i].name);
        const size_t distance = edit_distance(name, length, WORDS[i].name, word_length);
        const size_t longer = length > word_length ? length : word_length;
        if (distance < least && 2 * distance <= longer && distance < longer) {
            least = distance;
            meant = WORDS[i].name;
        }
    }
    for (size_t i = 0; i < sizeof ELSEWHERE / sizeof ELSEWHERE[0]; i++)
        if (equals(ELSEWHERE[i][0], name, length)) meant = ELSEWHERE[i][1];
    if (meant == NULL) return;
    strcpy(hint, ": did you mean '");
    strcat(hint, meant);
    strcat(hint, "'?");
}
