/* gough example: prints a ready study file, or lists them. */
#define _GNU_SOURCE
#include <jansson.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/in_and_out.h"
#include "cli/common/talk.h"
#include "cli/example/embedded.h"

/* The name to type: without the ending of a study file. */
static size_t stem_length(const embedded_file *file) {
    const char *ending = strrchr(file->name, '.');
    return ending && strcmp(ending, ".yaml") == 0 ? (size_t)(ending - file->name)
                                                  : strlen(file->name);
}

/* What an example is about: the title of a study, else the first line of comment. */
static size_t subject(const embedded_file *file, const char **start) {
    const char *line = file->text;
    for (; *line; line += strcspn(line, "\n"), line += *line == '\n') {
        const char *at = NULL;
        if (strncmp(line, "title:", 6) == 0)
            at = line + 6;
        else if (strncmp(line, "# ", 2) == 0 && !strstr(file->name, ".yaml"))
            at = line + 2;
        if (!at) continue;
        at += strspn(at, " \"'");
        size_t length = strcspn(at, "\n");
        while (length && strchr(" \"'\r", at[length - 1])) length--;
        *start = at;
        return length;
    }
    *start = "";
    return 0;
}

static gough_status list_examples(const command_line *line) {
    json_t *list = json_array();
    if (!line->json) printf("Examples, printed by 'gough example NAME':\n\n");
    for (const embedded_file *file = embedded_files; file->name; file++) {
        const char *about;
        const size_t length = subject(file, &about), stem = stem_length(file);
        if (line->json)
            json_array_append_new(
                list, json_pack("{s:s%, s:s%}", "name", file->name, stem, "title", about, length));
        else
            printf("  %-*.*s  %.*s\n", 22, (int)stem, file->name, (int)length, about);
    }
    if (line->json) {
        json_dumpf(list, stdout, JSON_INDENT(2) | JSON_PRESERVE_ORDER);
        putchar('\n');
    }
    json_decref(list);
    return GOUGH_OK;
}

static const embedded_file *find_example(const char *name) {
    for (const embedded_file *file = embedded_files; file->name; file++) {
        const size_t stem = stem_length(file);
        if (strcmp(name, file->name) == 0) return file;
        if (strlen(name) == stem && strncmp(name, file->name, stem) == 0) return file;
    }
    return NULL;
}

/* "'flight-design', 'flight-simulator'": the examples whose names contain a word, and how many they are. */
static size_t containing(const char *word, char *list, size_t size) {
    size_t count = 0, used = 0;
    for (const embedded_file *file = embedded_files; file->name; file++) {
        const size_t stem = stem_length(file);
        if (strlen(word) < 3 || !memmem(file->name, stem, word, strlen(word))) continue;
        if (used < size)
            used += (size_t)snprintf(list + used, size - used, "%s'%.*s'", count ? ", " : "",
                                     (int)stem, file->name);
        count++;
    }
    return count;
}

static void complain_of_unknown(const char *name) {
    char list[300];
    const size_t alike = containing(name, list, sizeof list);
    if (alike > 0 && alike < 6) {
        complain("example",
                 alike == 1 ? "there is no example '%s'; did you mean %s?"
                            : "there is no example '%s'; did you mean one of %s?",
                 name, list);
        return;
    }
    const char *known[64];
    size_t count = 0;
    for (const embedded_file *file = embedded_files; file->name && count < 64; file++)
        known[count++] = file->name;
    char full[80];
    snprintf(full, sizeof full, "%.60s%s", name, strchr(name, '.') ? "" : ".yaml");
    const char *near = nearest_word(full, known, count);
    if (near)
        complain("example", "there is no example '%s'; did you mean '%s'?", name, near);
    else
        complain("example", "there is no example '%s'; 'gough example' lists them", name);
}

static gough_status run(const void *given) {
    const command_line *line = given;
    gough_status status = GOUGH_OK;
    if (line->file.count == 0) return list_examples(line);
    const embedded_file *file = find_example(line->file.word[0]);
    gough_error error = {0};
    if (!file) {
        complain_of_unknown(line->file.word[0]);
        status = GOUGH_ERROR_INPUT;
    } else if (line->outputs.count == 0) {
        fwrite(file->text, 1, file->length, stdout);
    } else {
        status = check_distinct(line);
    }
    for (size_t i = 0; i < line->outputs.count && !status; i++) {
        const char *path = line->outputs.word[i];
        status = gough_write_file(path, file->text, file->length, &error);
        if (status)
            complain("example", "%s", error.message);
        else if (!line->quiet && strcmp(path, "-") != 0)
            remark("example", "wrote %s", path);
    }
    return status;
}

static const group_use groups[] = {
    USES_OUTPUT("write the example to FILE instead of standard output; may be given several times"),
    USES_JSON,
    {0}};

extern const command_verb example_verb;
const command_verb example_verb = {
    .name = "example",
    .arguments = "[NAME]",
    .words = "example",
    .sentence = "print an example study to start from, or list them",
    .text = "Print an example study to start from; without NAME, list the examples.\vNAME without "
            "an ending is a study, such as 'flight-simulator'; with one it is a file that belongs "
            "to a study, such as 'ship-deck.awk', the script that computes its data.",
    .most_files = 1,
    .groups = groups,
    .size = sizeof(command_line),
    .run = run};
