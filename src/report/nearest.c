/* The nearest of some names to what was typed: Levenshtein distance, row by row. */
#include "nearest.h"

#include <string.h>

enum { LONGEST = 60 };

static size_t lesser(size_t a, size_t b) { return a < b ? a : b; }

static size_t distance(const char *a, size_t a_length, const char *b, size_t b_length) {
    size_t row[LONGEST + 1];
    for (size_t j = 0; j <= b_length; j++) row[j] = j;
    for (size_t i = 1; i <= a_length; i++) {
        size_t diagonal = row[0];
        row[0] = i;
        for (size_t j = 1; j <= b_length; j++) {
            const size_t replaced = diagonal + (a[i - 1] != b[j - 1]);
            diagonal = row[j];
            row[j] = lesser(replaced, lesser(row[j], row[j - 1]) + 1);
        }
    }
    return row[b_length];
}

int nearest_name(const char *text, const char *const *names, size_t count) {
    const size_t length = strlen(text);
    if (length > LONGEST) return -1;
    size_t best = length / 3 > 2 ? length / 3 : 2;
    int nearest = -1;
    for (size_t i = 0; i < count; i++) {
        const size_t name_length = strcspn(names[i], " ");
        if (name_length > LONGEST) continue;
        const size_t d = distance(text, length, names[i], name_length);
        if (d < best || (d == best && nearest < 0)) {
            best = d;
            nearest = (int)i;
        }
    }
    return nearest;
}
