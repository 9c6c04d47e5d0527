/* gough help: what the command or one of its verbs is for. */
#include <stdio.h>

#include "cli/common/verb.h"
#include "cli/help/command_text.h"

static gough_status run(const void *given) {
    const command_line *line = given;
    if (line->file.count == 0) {
        print_command_help(stdout);
        return GOUGH_OK;
    }
    char own[] = "gough help", title[40], help[] = "--help";
    const struct argp_state state = {.name = own};
    const command_verb *verb = find_verb(&state, line->file.word[0]);
    snprintf(title, sizeof title, "gough %s", verb->name);
    return verb_run(verb, 2, (char *[]){title, help, NULL});
}

static const group_use groups[] = {{0}};

extern const command_verb help_verb;
const command_verb help_verb = {.name = "help",
                                .arguments = "[VERB]",
                                .sentence = "describe the command or a verb",
                                .text = "Describe the command, or VERB and its options.",
                                .words = "verb",
                                .most_files = 1,
                                .groups = groups,
                                .size = sizeof(command_line),
                                .run = run};
