/* The man page and the completions of the shells, written when the project is built: a template with lines @name@ in the place of
 * what follows from the tables of verbs and options. A program of its own; the command does not contain it. */
#ifndef GOUGH_CLI_MANUAL_H
#define GOUGH_CLI_MANUAL_H

#include <stdio.h>

#include "cli/common/verb.h"

enum { MOST_ENTRIES = 100 };

/* An option as its verbs share it: of one name and one text. */
typedef struct manual_entry {
    const option *option;
    const char *text;
    unsigned verbs; /* a bit for each, in the order of verb_at() */
} manual_entry;

typedef struct manual {
    manual_entry entry[MOST_ENTRIES];
    size_t entries, verbs;
} manual;

/* A line @name@ of a template, and what stands in its place. */
typedef struct manual_part {
    const char *name;
    void (*write)(FILE *stream, const manual *manual);
} manual_part;

/* Each ends with one without a name. */
extern const manual_part manual_man[], manual_bash[], manual_zsh[], manual_fish[];

/* Whether an entry belongs to a verb. */
bool manual_has(const manual_entry *entry, size_t verb);

/* The words of a list such as "double quad", with others between them. */
void manual_join(FILE *stream, const char *words, const char *between);

#endif
