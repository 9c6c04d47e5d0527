/* Reads the command line of a verb by its groups of options; argp does the rest. */
#define _GNU_SOURCE
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/memory.h"
#include "cli/common/option_values.h"
#include "cli/common/refusal.h"
#include "cli/common/talk.h"
#include "cli/common/verb.h"

enum { MOST_COUNTED = 100000000, FIRST_KEY = 0x100 /* beyond characters: no short form */ };

/* ---- readers ------------------------------------------------------------------------------------------------------ */

static void *member(void *group, const option *o) { return (char *)group + o->at; }

void read_flag(const struct argp_state *state, const option *o, const char *text, void *group) {
    (void)state, (void)text;
    *(bool *)member(group, o) = true;
}

void read_word(const struct argp_state *state, const option *o, const char *text, void *group) {
    (void)state;
    *(const char **)member(group, o) = text;
}

void read_time(const struct argp_state *state, const option *o, const char *text, void *group) {
    if (!read_decimal(text, text + strlen(text), member(group, o)))
        usage_error(state, "--%s takes a number, a time as in column t; got '%s'", o->name, text);
}

size_t read_count(const struct argp_state *state, const char *name, const char *text) {
    size_t value = 0;
    const size_t digits = strspn(text, "0123456789");
    for (size_t i = 0; i < digits && value < MOST_COUNTED; i++)
        value = 10 * value + (size_t)(text[i] - '0');
    if (digits == 0 || text[digits] || value < 1 || value > MOST_COUNTED)
        usage_error(state, "--%s takes a whole number of 1 or more; got '%s'", name, text);
    return value;
}

/* an int */
static void read_counts(const struct argp_state *state, const option *o, const char *text,
                        void *group) {
    *(int *)member(group, o) = (int)read_count(state, o->name, text);
}

/* ---- lists -------------------------------------------------------------------------------------------------------- */

void word_list_add(word_list *list, const char *word) {
    list->word = reallocate(list->word, (list->count + 1) * sizeof *list->word);
    list->word[list->count++] = word;
}

static void add_output(const struct argp_state *state, const option *o, const char *text,
                       void *group) {
    (void)state, (void)o;
    word_list_add(group, text);
}

static void free_words(void *group) {
    word_list *list = group;
    free(list->word);
}

/* KEY=VALUE */
static void add_setting(const struct argp_state *state, const option *o, const char *text,
                        void *group) {
    setting_list *settings = group;
    const char *equal = strchr(text, '=');
    (void)o;
    if (!equal || equal == text) {
        usage_error(state, "--set takes KEY=VALUE, as in --set control.stiffness=50; got '%s'",
                    text);
        return;
    }
    const size_t length = (size_t)(equal - text);
    char *key = allocate(length + 1);
    memcpy(key, text, length);
    key[length] = '\0';
    settings->list = reallocate(settings->list, (settings->count + 1) * sizeof *settings->list);
    settings->list[settings->count++] = (gough_setting){.key = key, .value = equal + 1};
}

static void free_settings(void *group) {
    setting_list *settings = group;
    for (size_t i = 0; i < settings->count; i++) free((void *)settings->list[i].key);
    free(settings->list);
}

/* ---- shared groups ------------------------------------------------------------------------------------------------ */

#define GROUP(name, begin, end, ...)                                                               \
    const option_group name = {(const option[]){{__VA_ARGS__}, {0}}, begin, end}

GROUP(quiet_group, NULL, NULL, .name = "quiet", .letter = 'q', .read = read_flag,
      .text = "print errors only");
GROUP(json_group, NULL, NULL, .name = "json", .read = read_flag,
      .text = "print the results as JSON");
GROUP(dimensionless_group, NULL, NULL, .name = "dimensionless", .read = read_flag);
GROUP(settings_group, NULL, free_settings, .name = "set", .value = "KEY=VALUE",
      .choices = CHOICES_KEYS, .many = true, .read = add_setting,
      .text = "override a key of the study, as in --set control.stiffness=50; may be repeated");
GROUP(output_group, NULL, free_words, .name = "output", .letter = 'o', .value = "FILE",
      .choices = CHOICES_FILES, .many = true, .read = add_output);
GROUP(threads_group, NULL, NULL, .name = "threads", .value = "N", .read = read_counts,
      .text = "threads (default: one for each processor)");
GROUP(lanes_group, NULL, NULL, .name = "lanes", .value = "N", .choices = "1 2 4 8",
      .read = read_counts);
GROUP(title_group, NULL, NULL, .name = "title", .value = "TEXT", .read = read_word);

/* ---- the options of a verb ---------------------------------------------------------------------------------------- */

static const group_use quiet_use = {&quiet_group, offsetof(command_line, quiet), NULL};

const option *verb_option(const command_verb *verb, size_t n, const group_use **use) {
    for (const group_use *u = verb->groups;; u++) {
        *use = u->group ? u : &quiet_use;
        for (const option *o = (*use)->group->option; o->name; o++)
            if (n-- == 0) return o;
        if (!u->group) return NULL;
    }
}

const char *option_text(const option *o, const group_use *use) {
    return o->text ? o->text : use->text;
}

/* ---- reading ------------------------------------------------------------------------------------------------------ */

enum { MOST_OPTIONS = 40 };

typedef struct reader {
    const command_verb *verb;
    command_line *line;
} reader;

/* By its letter, or by its number among the options of the verb. */
static int key_of(const option *o, size_t n) { return o->letter ? o->letter : FIRST_KEY + (int)n; }

static bool is_standard_input(const char *path) {
    return strcmp(path, "-") == 0 || strcmp(path, "/dev/stdin") == 0 ||
           strcmp(path, "/dev/fd/0") == 0 || strcmp(path, "/proc/self/fd/0") == 0;
}

/* The second reader of standard input would find it empty. */
static void refuse_twice(struct argp_state *state, const command_line *line, const char *path) {
    for (size_t i = 0; is_standard_input(path) && i < line->file.count; i++)
        if (is_standard_input(line->file.word[i]))
            usage_error(state, "standard input can be read only once; it is given as '%s' and '%s'",
                        line->file.word[i], path);
}

static error_t read_option(int key, char *text, struct argp_state *state) {
    const reader *r = state->input;
    command_line *line = r->line;
    if (key == ARGP_KEY_ERROR) refuse_option(state);
    if (key == ARGP_KEY_ARG) {
        refuse_twice(state, line, text);
        if (line->file.count == r->verb->most_files)
            usage_error(state, "too many arguments, starting with '%s'", text);
        word_list_add(&line->file, text);
        return 0;
    }
    if (key == ARGP_KEY_END) {
        if (line->file.count < r->verb->least_files)
            usage_error(state, "%s is missing", r->verb->arguments);
        return 0;
    }
    const group_use *use;
    const option *o;
    for (size_t n = 0; (o = verb_option(r->verb, n, &use)); n++) {
        if (key != key_of(o, n)) continue;
        o->read(state, o, text, (char *)line + use->at);
        return 0;
    }
    return ARGP_ERR_UNKNOWN;
}

static void begin_groups(const command_verb *verb, command_line *line) {
    for (const group_use *use = verb->groups; use->group; use++)
        if (use->group->begin) use->group->begin((char *)line + use->at);
}

static void end_groups(const command_verb *verb, command_line *line) {
    for (const group_use *use = verb->groups; use->group; use++)
        if (use->group->end) use->group->end((char *)line + use->at);
    free_words(&line->file);
}

/* Messages about the command line itself are JSON too if it asks for JSON. */
static void begin_talk(const command_verb *verb, int count, char **argument) {
    bool knows = false;
    for (const group_use *use = verb->groups; use->group; use++) knows |= use->group == &json_group;
    for (int i = 1; knows && i < count; i++)
        if (strcmp(argument[i], "--json") == 0) talk_in_json();
}

gough_status verb_run(const command_verb *verb, int count, char **argument) {
    struct argp_option known[MOST_OPTIONS + 1] = {{0}};
    const group_use *use;
    const option *o;
    for (size_t n = 0; (o = verb_option(verb, n, &use)); n++) {
        if (n == MOST_OPTIONS) abort(); /* unreachable: a verb with more needs more room here */
        known[n] = (struct argp_option){o->name, key_of(o, n), o->value, 0, option_text(o, use), 0};
    }
    const struct argp_child children[] = {{.argp = &help_argp}, {0}};
    const struct argp argp = {.options = known,
                              .children = children,
                              .parser = read_option,
                              .args_doc = verb->arguments,
                              .doc = verb->text,
                              .help_filter = verb->help_filter};
    command_line *line = allocate(verb->size);
    memset(line, 0, verb->size);
    line->verb = verb->name;
    begin_groups(verb, line);
    begin_talk(verb, count, argument);
    argp_parse(&argp, count, argument, ARGP_OWN_VOICE, NULL, &(reader){verb, line});
    const gough_status status = verb->run(line);
    end_groups(verb, line);
    free(line);
    return status;
}
