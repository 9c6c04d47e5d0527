/* What a verb of the command is: its words, its options in groups, and the function that does its work. The line in verbs.def
 * names it; --help, the man page, the completions and the reading of the command line follow from the structs here. */
#ifndef GOUGH_CLI_VERB_H
#define GOUGH_CLI_VERB_H

#include <argp.h>
#include <stdbool.h>
#include <stddef.h>

#include "gough/gough.h"

/* ---- options ---- */

typedef struct command_option option;

/* Stores the value of an option in the struct of its group; NULL for one that takes none. What is wrong with it ends the process
 * by usage_error(). */
typedef void option_reader(const struct argp_state *state, const option *option, const char *text,
                           void *group);

struct command_option {
    const char *name;  /* "output", for --output */
    char letter;       /* 'o', for -o; 0: none */
    const char *value; /* "FILE"; NULL: it takes none */
    const char *
        choices; /* what the shells complete: "double quad", or one of those below; NULL: nothing */
    bool many;   /* it may be given several times */
    option_reader *read;
    size_t at; /* of the value in the group's struct, where the reader is one of those below */
    const char *text; /* NULL: each verb has words of its own for it */
};

/* choices that are not words */
#define CHOICES_FILES "FILES"
#define CHOICES_FIGURES "FIGURES"
#define CHOICES_KEYS "KEYS"

option_reader read_flag; /* a bool */
option_reader read_word; /* a const char *, as it is */
option_reader read_time; /* a double, a time as in column t */

/* A whole number of 1 or more. */
size_t read_count(const struct argp_state *state, const char *name, const char *text);

/* Options that are always together, and how their struct begins and ends: all zeros, and with nothing to be freed, if NULL. */
typedef struct option_group {
    const option *option; /* ends with one without a name */
    void (*begin)(void *group);
    void (*end)(void *group);
} option_group;

/* A group among the options of a verb. */
typedef struct group_use {
    const option_group *group;
    size_t at;        /* of the group's struct in the line of the verb */
    const char *text; /* of its option that has no text */
} group_use;

/* ---- the command line ---- */

typedef struct setting_list {
    gough_setting *list;
    size_t count;
} setting_list;

typedef struct word_list {
    const char **word;
    size_t count;
} word_list;

/* Adds a word, which must live as long as the list; without memory the process ends. */
void word_list_add(word_list *list, const char *word);

/* What all verbs know, and the first member of the line of each. */
typedef struct command_line {
    const char *verb;
    word_list file; /* what is no option, in order */
    bool quiet;
    bool json;
    bool dimensionless;
    setting_list settings; /* from --set */
    word_list outputs;     /* from -o */
} command_line;

/* ---- groups that verbs share; those with a text in brackets are worded by the verb ---- */

extern const option_group quiet_group;         /* bool; every verb has it */
extern const option_group json_group;          /* bool */
extern const option_group dimensionless_group; /* bool [text] */
extern const option_group settings_group;      /* setting_list */
extern const option_group output_group;        /* word_list [text] */
extern const option_group threads_group;       /* int, 0: one for each processor */
extern const option_group lanes_group; /* int, 0: as many as the processor supports [text] */
extern const option_group title_group; /* const char *, NULL: not given [text] */

#define USES_JSON                                                                                  \
    { &json_group, offsetof(command_line, json), NULL }
#define USES_SETTINGS                                                                              \
    { &settings_group, offsetof(command_line, settings), NULL }
#define USES_DIMENSIONLESS(text)                                                                   \
    { &dimensionless_group, offsetof(command_line, dimensionless), text }
#define USES_OUTPUT(text)                                                                          \
    { &output_group, offsetof(command_line, outputs), text }
#define USES(group, type, member, text)                                                            \
    { &group, offsetof(type, member), text }

/* of verbs that write one table */
#define TABLE_OUTPUT                                                                               \
    "write the table to FILE: .h5 or .csv by its ending; - is CSV on standard output; may be "     \
    "given several times"

/* ---- verbs ---- */

typedef struct command_verb {
    const char *name;
    const char *arguments; /* "STUDY", as in --help */
    const char *sentence;  /* what it does, in the list of verbs */
    const char *text;      /* the text of --help before \v and after the options */
    const char *endings;   /* of files that are its arguments: "yaml yml"; NULL: they are words */
    const char *words;     /* what these are: "example", of those that _gough_examples() lists */
    size_t least_files, most_files;
    const group_use *groups; /* ends with one without a group */
    size_t size;             /* of its line, a struct that begins with a command_line */
    gough_status (*run)(const void *line);
    char *(*help_filter)(int key, const char *text, void *input); /* of argp; NULL: none */
} command_verb;

/* Reads the command line of a verb, argument[0] being "gough VERB", and runs it. What is wrong with the line ends the process with
 * a sentence and exit code 2. */
gough_status verb_run(const command_verb *verb, int count, char **argument);

/* The n-th of the options of a verb with its group, counted from 0; NULL: there are no more. */
const option *verb_option(const command_verb *verb, size_t n, const group_use **use);

/* What an option does, in the words of a verb. */
const char *option_text(const option *option, const group_use *use);

/* All verbs, one after the other; NULL beyond the last. */
const command_verb *verb_at(size_t n);

#endif
