/* The command line before the verb, and what --help says of the command as a whole. */
#ifndef GOUGH_CLI_COMMAND_TEXT_H
#define GOUGH_CLI_COMMAND_TEXT_H

#include <argp.h>
#include <stdio.h>

#include "cli/common/verb.h"

/* What --version prints: version and revision, written by the build (cmake/revision.cmake). */
extern const char command_version[];

/* The text of --help, with a line for each verb; to be freed. */
char *command_text(void);

/* The options that may stand before the verb, which are passed on to it. Their keys are their letters, or of this list. */
enum { KEY_JSON = 0x200, KEY_DIMENSIONLESS, KEY_SET };
extern const struct argp_option leading_options[];

/* Prints what `gough --help` prints. */
void print_command_help(FILE *stream);

/* The verb with this name; else the process ends with a sentence that names the nearest. */
const command_verb *find_verb(const struct argp_state *state, const char *name);

#endif
