/* What the tests of this room share. */
#include "program/helpers.h"

#include <check.h>
#include <string.h>

gough_formula formula_of(const char *text) {
    gough_formula f;
    gough_error error = {.message = ""};
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
