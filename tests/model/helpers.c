/* What the tests of this room share. */
#include "model/helpers.h"

#include <check.h>
#include <locale.h>
#include <stdio.h>
#include <string.h>

random_source random_seeded(uint64_t seed) {
    return (random_source){seed * 0x9e3779b97f4a7c15u | 1};
}

uint64_t random_bits(random_source *source) {
    source->state ^= source->state << 13;
    source->state ^= source->state >> 7;
    source->state ^= source->state << 17;
    return source->state * 0x2545f4914f6cdd1du;
}

double random_between(random_source *source, double low, double high) {
    return low + (high - low) * (double)(random_bits(source) >> 11) * 0x1p-53;
}

gough_formula formula_of(const char *text) {
    gough_formula f;
    gough_error error = {GOUGH_OK, ""};
    const gough_status status = gough_formula_compile(&f, text, strlen(text), NULL, &error);
    ck_assert_msg(status == GOUGH_OK, "%s: %s", text, error.message);
    return f;
}

double value_of(const char *text, double t) {
    const gough_formula f = formula_of(text);
    double jet[3];
    gough_formula_evaluate(&f, t, jet);
    return jet[0];
}

bool locale_with_comma(void) {
    static const char *const NAMES[] = {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8",
                                        "fr_FR.utf8",  "de_DE",      "fr_FR"};
    for (size_t i = 0; i < sizeof NAMES / sizeof NAMES[0]; i++)
        if (setlocale(LC_ALL, NAMES[i]) != NULL && localeconv()->decimal_point[0] == ',')
            return true;
    setlocale(LC_ALL, "C");
    return false;
}

void locale_reset(void) { setlocale(LC_ALL, "C"); }
