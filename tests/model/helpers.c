/* What the tests of this room share. */
#define _POSIX_C_SOURCE 200809L
#include "model/helpers.h"

#include <check.h>
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
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

/* made for the occasion in a folder of its own, as few systems have one installed; glibc keeps
 * what it has read */
void locale_with_comma(void) {
    char folder[] = "/tmp/gough-locale-XXXXXX", command[200];
    ck_assert_ptr_nonnull(mkdtemp(folder));
    snprintf(command, sizeof command, "localedef -i de_DE -f UTF-8 %s/de_DE.UTF-8", folder);
    ck_assert_msg(system(command) == 0, "localedef failed: Debian's package locales has it");
    ck_assert_int_eq(setenv("LOCPATH", folder, 1), 0);
    ck_assert_ptr_nonnull(setlocale(LC_ALL, "de_DE.UTF-8"));
    snprintf(command, sizeof command, "rm -r %s", folder);
    ck_assert_int_eq(system(command), 0);
    ck_assert_str_eq(localeconv()->decimal_point, ",");
}

void locale_reset(void) {
    setlocale(LC_ALL, "C");
    unsetenv("LOCPATH");
}
