/* What is wrong with an option, as argp finds it, said as other errors are. */
#define _GNU_SOURCE
#include "cli/common/refusal.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/talk.h"

enum { KEY_USAGE = 0x10000, HELP_GROUP = -1 };

static const struct argp_option help_options[] = {
    {"help", 'h', NULL, 0, "print this help", HELP_GROUP},
    {NULL, '?', NULL, OPTION_HIDDEN, NULL, HELP_GROUP},
    {"usage", KEY_USAGE, NULL, 0, "print a short usage message", HELP_GROUP},
    {"version", 'V', NULL, 0, "print the version", HELP_GROUP},
    {0}};

static error_t read_help(int key, char *text, struct argp_state *state) {
    (void)text;
    switch (key) {
    case 'h':
    case '?':
        argp_help(state->root_argp, stdout, ARGP_HELP_STD_HELP, state->name);
        exit(0);
    case KEY_USAGE:
        argp_help(state->root_argp, stdout, ARGP_HELP_USAGE, state->name);
        exit(0);
    case 'V':
        puts(argp_program_version);
        exit(0);
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

const struct argp help_argp = {.options = help_options, .parser = read_help};

/* ---- what is wrong ------------------------------------------------------------------------------------------------ */

enum { MOST_NAMES = 64 };

/* The options of a command line, its own and those of help. */
typedef struct known_options {
    const struct argp_option *option[MOST_NAMES];
    size_t count;
} known_options;

static void add_options(known_options *known, const struct argp_option *option) {
    for (; option && (option->name || option->key || option->doc); option++)
        if (known->count < MOST_NAMES) known->option[known->count++] = option;
}

/* The one with this name, or the only one whose name begins so; its number of candidates. */
static const struct argp_option *find_long(const known_options *known, const char *name,
                                           size_t length, size_t *candidates) {
    const struct argp_option *found = NULL;
    *candidates = 0;
    for (size_t i = 0; i < known->count; i++) {
        const struct argp_option *o = known->option[i];
        if (!o->name || strncmp(o->name, name, length) != 0) continue;
        if (strlen(o->name) == length) {
            *candidates = 1;
            return o;
        }
        found = o;
        ++*candidates;
    }
    return found;
}

static const struct argp_option *find_letter(const known_options *known, char letter) {
    for (size_t i = 0; i < known->count; i++)
        if (known->option[i]->key == (unsigned char)letter) return known->option[i];
    return NULL;
}

static void refuse_unknown(const struct argp_state *state, const known_options *known,
                           const char *word, size_t length) {
    const char *name[MOST_NAMES];
    size_t names = 0;
    for (size_t i = 0; i < known->count; i++)
        if (known->option[i]->name) name[names++] = known->option[i]->name;
    char written[64];
    snprintf(written, sizeof written, "%.*s", (int)(length - 2), word + 2);
    const char *near = nearest_word(written, name, names);
    if (near)
        usage_error(state, "there is no option '%.*s'; did you mean '--%s'?", (int)length, word,
                    near);
    else
        usage_error(state, "there is no option '%.*s'", (int)length, word);
}

/* An option "--name" or "--name=value"; the last word of a line has no value behind it. */
static void look_at_long(const struct argp_state *state, const known_options *known,
                         const char *word, bool last) {
    const size_t length = strcspn(word, "=");
    size_t candidates;
    const struct argp_option *o = find_long(known, word + 2, length - 2, &candidates);
    if (candidates == 0) {
        refuse_unknown(state, known, word, length);
    } else if (candidates > 1) {
        char list[400] = "";
        size_t used = 0;
        for (size_t i = 0; i < known->count && used < sizeof list; i++)
            if (known->option[i]->name &&
                strncmp(known->option[i]->name, word + 2, length - 2) == 0)
                used += (size_t)snprintf(list + used, sizeof list - used, "%s--%s",
                                         used ? ", " : "", known->option[i]->name);
        usage_error(state, "'%.*s' can be any of %s", (int)length, word, list);
    } else if (o->arg && !word[length] && last) {
        usage_error(state, "--%s takes a value: --%s %s", o->name, o->name, o->arg);
    } else if (!o->arg && word[length]) {
        usage_error(state, "--%s takes no value; got '%s'", o->name, word + length + 1);
    }
}

/* A word of letters, such as -qo. */
static void look_at_letters(const struct argp_state *state, const known_options *known,
                            const char *word, bool last) {
    for (const char *letter = word + 1; *letter; letter++) {
        const struct argp_option *o = find_letter(known, *letter);
        if (!o) {
            const size_t whole = strcspn(letter, "=");
            if (letter == word + 1 && whole > 1) {
                usage_error(state, "there is no option '%s'", word);
            } else {
                usage_error(state, "there is no option '-%.*s'", 1, letter);
            }
        } else if (o->arg) {
            if (!letter[1] && last)
                usage_error(state, "-%c takes a value: -%c %s", *letter, *letter, o->arg);
            return;
        }
    }
}

void refuse_option(const struct argp_state *state) {
    known_options known = {.count = 0};
    add_options(&known, state->root_argp->options);
    add_options(&known, help_options);
    /* the word is the last that was taken, or the next if letters of it are left */
    for (int i = state->next - 1; i <= state->next && i < state->argc; i++) {
        const char *word = i > 0 ? state->argv[i] : "";
        const bool last = i + 1 == state->argc;
        if (strncmp(word, "--", 2) == 0 && word[2])
            look_at_long(state, &known, word, last);
        else if (word[0] == '-' && word[1])
            look_at_letters(state, &known, word, last);
    }
    usage_error(state, "the options cannot be read"); /* unreachable: one of them was wrong */
}
