/* What is said on standard error: complaints and remarks, and the word that was perhaps meant. */
#define _GNU_SOURCE
#include "cli/command.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bool colourful(FILE *stream) {
    const char *refused = getenv("NO_COLOR");
    const char *terminal = getenv("TERM");
    return !(refused && *refused) && terminal && strcmp(terminal, "dumb") != 0 &&
           isatty(fileno(stream));
}

static void say(const char *verb, bool wrong, const char *format, va_list list) {
    fflush(stdout); /* keep the order where both streams go to one place */
    fputs("gough", stderr);
    if (verb) fprintf(stderr, " %s", verb);
    if (wrong)
        fputs(colourful(stderr) ? ": \033[1;31merror:\033[0m " : ": error: ", stderr);
    else
        fputs(": ", stderr);
    vfprintf(stderr, format, list);
    fputc('\n', stderr);
}

void complain(const char *verb, const char *format, ...) {
    va_list list;
    va_start(list, format);
    say(verb, true, format, list);
    va_end(list);
}

void remark(const char *verb, const char *format, ...) {
    va_list list;
    va_start(list, format);
    say(verb, false, format, list);
    va_end(list);
}

/* Levenshtein's distance of two short words, row by row. */
static size_t distance(const char *a, const char *b) {
    enum { LONGEST = 40 };
    size_t row[LONGEST + 1], m = strlen(a), n = strlen(b);
    if (m > LONGEST || n > LONGEST) return LONGEST;

    for (size_t j = 0; j <= n; j++) row[j] = j;
    for (size_t i = 1; i <= m; i++) {
        size_t diagonal = row[0];
        row[0] = i;
        for (size_t j = 1; j <= n; j++) {
            const size_t changed = diagonal + (a[i - 1] != b[j - 1]);
            const size_t shorter = (row[j] < row[j - 1] ? row[j] : row[j - 1]) + 1;
            diagonal = row[j];
            row[j] = changed < shorter ? changed : shorter;
        }
    }
    return row[n];
}

const char *nearest_word(const char *word, const char *const *candidate, size_t count) {
    const char *best = NULL;
    size_t least = strlen(word) / 3 + 2; /* farther off, it is another word */
    for (size_t i = 0; i < count; i++) {
        const size_t d = distance(word, candidate[i]);
        if (d < least) least = d, best = candidate[i];
    }
    return best;
}
