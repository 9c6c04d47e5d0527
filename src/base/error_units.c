/* Sentences of errors in the units of a study: each number that the library has marked with its unit is written anew. */
#include <string.h>

#include "gough/units.h"

/* In the order of the sentence: what was carried into it comes last. */
static void sort(gough_error *error) {
    for (int i = 1; i < error->quantities; i++)
        for (int k = i; k > 0 && error->quantity[k].at < error->quantity[k - 1].at; k--) {
            const gough_quantity other = error->quantity[k];
            error->quantity[k] = error->quantity[k - 1];
            error->quantity[k - 1] = other;
        }
}

void gough_error_say(gough_error *error, const gough_units *units) {
    sort(error);
    const gough_error old = *error;
    gough_error number;
    size_t used = 0;
    int from = 0;
    error->quantities = 0;
    if (units->dimensionless) return;
    for (int q = 0; q <= old.quantities; q++) {
        const gough_quantity *one = &old.quantity[q];
        const int until = q < old.quantities ? one->at : (int)strlen(old.message);
        const char *word = "";
        number.message[0] = '\0';
        if (q < old.quantities) {
            const gough_unit unit = (gough_unit)one->unit;
            word = gough_unit_word(units, unit);
            gough_fail(&number, old.status, "%.*g", one->digits,
                       gough_unit_factor(units, unit) * one->value);
        }
        const size_t room = sizeof error->message - used;
        gough_error part;
        gough_fail(&part, old.status, "%.*s%s%s", until - from, old.message + from, number.message,
                   word);
        const size_t length = strlen(part.message) < room - 1 ? strlen(part.message) : room - 1;
        memcpy(error->message + used, part.message, length);
        used += length;
        error->message[used] = '\0';
        if (q < old.quantities) from = one->at + one->length;
    }
}
