/* The options that the command and every verb have, --help, --usage and --version; and errors of a command line, which read like
 * all other errors. */
#ifndef GOUGH_CLI_REFUSAL_H
#define GOUGH_CLI_REFUSAL_H

#include <argp.h>

/* argp writes nothing about errors and ends no process: its parsers call usage_error() and refuse_option(). */
#define ARGP_OWN_VOICE (ARGP_NO_ERRS | ARGP_NO_EXIT | ARGP_NO_HELP)

/* -h, --help, --usage, -V and --version: to be the child of a command line. */
extern const struct argp help_argp;

/* To be called at ARGP_KEY_ERROR: ends the process with a sentence about the first option that is unknown, ambiguous, lacks its
 * value or has one that it does not take. */
void refuse_option(const struct argp_state *state);

#endif
