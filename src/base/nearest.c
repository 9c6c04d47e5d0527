/* The nearest of some names to a misspelt word: Damerau and Levenshtein's distance, row by row of the table of distances between
 * the beginnings of both. */
#include <string.h>

#include "gough/text.h"

enum { LONGEST = 60, LEAST_BEGUN = 3 };

static char lower(char c) { return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c; }

static size_t lesser(size_t a, size_t b) { return a < b ? a : b; }

static size_t distance(const char *a, size_t m, const char *b, size_t n) {
    size_t before[LONGEST + 1], above[LONGEST + 1], row[LONGEST + 1];
    for (size_t j = 0; j <= n; j++) above[j] = before[j] = j;
    for (size_t i = 1; i <= m; i++) {
        const char own = lower(a[i - 1]);
        row[0] = i;
        for (size_t j = 1; j <= n; j++) {
            const char other = lower(b[j - 1]);
            row[j] = lesser(lesser(above[j], row[j - 1]) + 1, above[j - 1] + (own != other));
            if (i > 1 && j > 1 && own == lower(b[j - 2]) && lower(a[i - 2]) == other)
                row[j] = lesser(row[j], before[j - 2] + 1);
        }
        memcpy(before, above, sizeof above);
        memcpy(above, row, sizeof row);
    }
    return above[n];
}

/* The only name that begins with the word; -1: none or several do, or the word says too little. */
static int begun(const char *word, size_t length, const char *const *names, size_t count) {
    int found = -1;
    for (size_t i = 0; i < count && length >= LEAST_BEGUN; i++) {
        size_t same = 0;
        while (same < length && lower(word[same]) == lower(names[i][same])) same++;
        if (same < length || strcspn(names[i], " ") > LONGEST) continue;
        if (found >= 0) return -1;
        found = (int)i;
    }
    return found;
}

int gough_word_nearest(const char *word, size_t length, const char *const *names, size_t count) {
    size_t least = length / 3 + 2; /* farther off, it is another word */
    int nearest = -1;
    if (length > LONGEST) return -1;
    for (size_t i = 0; i < count; i++) {
        const size_t n = strcspn(names[i], " "), longer = n > length ? n : length;
        if (n > LONGEST) continue;
        const size_t d = distance(word, length, names[i], n);
        if (d >= least || 2 * d > longer) continue;
        least = d;
        nearest = (int)i;
    }
    return nearest < 0 ? begun(word, length, names, count) : nearest;
}
