/* gough keys: the keys of a study file, from the table that its reader checks against. */
#define _GNU_SOURCE
#include <stdio.h>
#include <string.h>

#include "cli/common/json.h"
#include "cli/common/paragraph.h"
#include "cli/common/talk.h"
#include "cli/common/verb.h"

typedef struct keys_line {
    command_line line;
    bool names;
} keys_line;

enum { INDENT = 4, MOST_NAMES = 400 };

static bool chosen(const gough_key *key, const char *prefix) {
    return strncmp(key->path, prefix, strlen(prefix)) == 0;
}

static json_t *json_of(const gough_key *key) {
    json_t *object = json_object();
    const char *const member[][2] = {{"key", key->path},         {"type", key->type},
                                     {"unit", key->unit},        {"range", key->range},
                                     {"default", key->fallback}, {"sentence", key->sentence}};
    for (size_t i = 0; i < sizeof member / sizeof *member; i++)
        json_object_set_new(object, member[i][0], json_string(member[i][1]));
    return object;
}

/* The key, how its value is written, and what it is. */
static void print_key(const gough_key *key) {
    printf("%s: %s", key->path, key->type);
    if (*key->unit) printf(", %s", key->unit);
    if (*key->range) printf(", %s", key->range);
    if (strcmp(key->fallback, "required") == 0)
        fputs("; required", stdout);
    else if (*key->fallback)
        printf("; default %s", key->fallback);
    putchar('\n');
    print_paragraph(stdout, "", INDENT, "%s", key->sentence);
}

static gough_status refuse(const char *verb, const char *prefix, const gough_key *key,
                           size_t count) {
    const char *name[MOST_NAMES];
    size_t names = 0;
    for (; names < count && names < MOST_NAMES; names++) name[names] = key[names].path;
    const char *near = nearest_word(prefix, name, names);
    if (near)
        complain(verb, "no key begins with '%s'; did you mean '%s'?", prefix, near);
    else
        complain(verb, "no key begins with '%s'; 'gough keys' lists all", prefix);
    return GOUGH_ERROR_INPUT;
}

static gough_status run(const void *given) {
    const keys_line *asked = given;
    const command_line *line = &asked->line;
    const char *prefix = line->file.count ? line->file.word[0] : "";
    size_t count, found = 0;
    const gough_key *key = gough_study_keys(&count);
    json_t *list = json_array();
    for (size_t i = 0; i < count; i++) {
        if (!chosen(&key[i], prefix)) continue;
        found++;
        if (line->json)
            json_array_append_new(list, json_of(&key[i]));
        else if (asked->names)
            puts(key[i].path);
        else if (!line->quiet)
            print_key(&key[i]);
    }
    if (!found) {
        json_decref(list);
        return refuse(line->verb, prefix, key, count);
    }
    if (!line->json) {
        json_decref(list);
        return GOUGH_OK;
    }
    json_t *whole = json_object();
    json_object_set_new(whole, "keys", list);
    return json_print(whole) ? GOUGH_ERROR_FILE : GOUGH_OK;
}

static const option_group names_group = {
    (const option[]){
        {.name = "names", .read = read_flag, .text = "print the names alone, one in a line"}, {0}},
    NULL, NULL};

static const group_use groups[] = {USES_JSON, USES(names_group, keys_line, names, NULL), {0}};

extern const command_verb keys_verb;
const command_verb keys_verb = {
    .name = "keys",
    .arguments = "[PREFIX]",
    .sentence = "list the keys of a study file",
    .text =
        "List the keys of a study file that begin with PREFIX, or all: how the value of each is "
        "written, its unit, range and default, and what it is.\vgough keys control.sampling "
        "lists those of a sampled controller.",
    .words = "key",
    .most_files = 1,
    .groups = groups,
    .size = sizeof(keys_line),
    .run = run};
