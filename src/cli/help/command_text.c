/* The text of `gough --help`, and which verb a word means. */
#define _GNU_SOURCE
#include "cli/help/command_text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/memory.h"
#include "cli/common/refusal.h"
#include "cli/common/talk.h"
#include "cli/common/verb.h"

enum { LIST_WIDTH = 24 }; /* columns of "gough example NAME" in the list of verbs */

static const char before[] = "Dynamics and control of Stewart-Gough platforms.\n\n";

static const char after[] =
    "\n'gough help VERB' describes each verb. Options that stand before the verb are passed on to "
    "it:\v"
    "Exit status: 0 success; 1 the run stopped early (a leg limit, a singular pose, no "
    "convergence; its results up to that time are complete) or there is no solution; 2 the study "
    "or the command line is invalid; 3 reading or writing failed.\n"
    "\n"
    "First steps:\n"
    "  gough example own-machine > mine.yaml   a study to change into yours\n"
    "  gough check mine.yaml                   which machine it describes\n"
    "  gough forces mine.yaml -o forces.h5     the forces that its motion needs\n"
    "  gough plot forces.h5                    a picture of them\n"
    "  gough report mine.yaml                  a page of the machine in motion";

const struct argp_option leading_options[] = {
    {"quiet", 'q', NULL, 0, "print errors only", 0},
    {"json", KEY_JSON, NULL, 0, "print the results, and errors, as JSON", 0},
    {"dimensionless", KEY_DIMENSIONLESS, NULL, 0, "print without dimensions", 0},
    {"set", KEY_SET, "KEY=VALUE", 0, "override a key of the study; may be repeated", 0},
    {0}};

char *command_text(void) {
    char *text = NULL;
    size_t length = 0;
    FILE *stream = open_memstream(&text, &length);
    if (!stream) out_of_memory();
    fputs(before, stream);
    for (size_t n = 0; verb_at(n); n++) {
        /* an argument that may be left out without its brackets */
        const char *arguments = verb_at(n)->arguments + (*verb_at(n)->arguments == '[');
        const int named = fprintf(stream, "  gough %s %.*s", verb_at(n)->name,
                                  (int)strcspn(arguments, "]"), arguments);
        fprintf(stream, "%*s%s\n", LIST_WIDTH + 2 - named, "", verb_at(n)->sentence);
    }
    fputs(after, stream);
    if (fclose(stream) != 0) out_of_memory();
    return text;
}

void print_command_help(FILE *stream) {
    char *text = command_text(), name[] = "gough";
    const struct argp_child children[] = {{.argp = &help_argp}, {0}};
    const struct argp argp = {
        .options = leading_options, .args_doc = "VERB ...", .doc = text, .children = children};
    argp_help(&argp, stream, ARGP_HELP_STD_HELP, name);
    free(text);
}

const command_verb *find_verb(const struct argp_state *state, const char *name) {
    enum { MOST_VERBS = 40 };
    const char *known[MOST_VERBS];
    size_t verbs = 0;
    for (; verbs < MOST_VERBS && verb_at(verbs); verbs++) {
        known[verbs] = verb_at(verbs)->name;
        if (strcmp(name, known[verbs]) == 0) return verb_at(verbs);
    }
    const char *near = nearest_word(name, known, verbs);
    if (near) usage_error(state, "there is no verb '%s'; did you mean '%s'?", name, near);
    usage_error(state, "there is no verb '%s'", name);
    return NULL;
}
