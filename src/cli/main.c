/* The command `gough`: finds the verb and passes it the rest of the command line. Exit codes are those of gough_status. */
#define _GNU_SOURCE
#include <argp.h>
#include <fcntl.h>
#include <jansson.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/common/memory.h"
#include "cli/common/talk.h"
#include "cli/common/verb.h"

enum { LIST_WIDTH = 24 }; /* columns of "gough example NAME" in the list of verbs */

static const char before[] = "Dynamics and control of Stewart-Gough platforms.\n\n";

static const char after[] =
    "\n'gough VERB --help' describes each verb.\vExit status: 0 success; 1 the run stopped early "
    "(a "
    "leg limit, a singular pose, no convergence; its results up to that time are complete) or "
    "there is no solution; 2 the study or the command line is invalid; 3 reading or writing "
    "failed.\n"
    "\n"
    "First steps:\n"
    "  gough example paper-heave > heave.yaml\n"
    "  gough check heave.yaml\n"
    "  gough forces heave.yaml -o heave.h5\n"
    "  gough plot heave.h5";

/* The text of --help, with a line for each verb; an argument that may be left out without its brackets. */
static char *make_text(void) {
    char *text = NULL;
    size_t length = 0;
    FILE *stream = open_memstream(&text, &length);
    if (!stream) out_of_memory();
    fputs(before, stream);
    for (size_t n = 0; verb_at(n); n++) {
        const char *arguments = verb_at(n)->arguments + (*verb_at(n)->arguments == '[');
        const int named = fprintf(stream, "  gough %s %.*s", verb_at(n)->name,
                                  (int)strcspn(arguments, "]"), arguments);
        fprintf(stream, "%*s%s\n", LIST_WIDTH + 2 - named, "", verb_at(n)->sentence);
    }
    fputs(after, stream);
    if (fclose(stream) != 0) out_of_memory();
    return text;
}

/* Opens /dev/null for a standard descriptor that is closed, in the mode that makes its use fail, so that no result file gets its
 * number. */
static void occupy_standard_descriptors(void) {
    for (int descriptor = 0; descriptor <= 2; descriptor++)
        if (fcntl(descriptor, F_GETFD) == -1)
            (void)!open("/dev/null", descriptor == 0 ? O_WRONLY : O_RDONLY);
}

/* Closes standard output: a failed write must not end with exit code 0. */
static void close_output(void) {
    const bool failed = ferror(stdout) != 0;
    if (fclose(stdout) != 0 || failed) {
        complain(NULL, "cannot write to standard output");
        _exit(GOUGH_ERROR_FILE);
    }
}

static error_t read_verb(int key, char *argument, struct argp_state *state) {
    const command_verb **found = state->input;
    if (key == ARGP_KEY_NO_ARGS) {
        argp_state_help(state, stderr, ARGP_HELP_USAGE | ARGP_HELP_DOC | ARGP_HELP_EXIT_ERR);
        return EINVAL;
    }
    if (key != ARGP_KEY_ARG) return ARGP_ERR_UNKNOWN;

    enum { MOST_VERBS = 40 };
    const char *name[MOST_VERBS];
    size_t verbs = 0;
    for (; verbs < MOST_VERBS && verb_at(verbs); verbs++) {
        name[verbs] = verb_at(verbs)->name;
        if (strcmp(argument, name[verbs]) == 0) *found = verb_at(verbs);
    }
    if (!*found) {
        const char *near = nearest_word(argument, name, verbs);
        usage_error(state,
                    near ? "there is no verb '%s'; did you mean '%s'?" : "there is no verb '%s'",
                    argument, near);
    }
    state->next = state->argc; /* the rest belongs to the verb */
    return 0;
}

/* An answer is written as a whole, unless someone is reading along. */
static void buffer_output(void) {
    static char buffer[1 << 18];
    if (!isatty(STDOUT_FILENO)) setvbuf(stdout, buffer, _IOFBF, sizeof buffer);
}

int main(int count, char **argument) {
    occupy_standard_descriptors();
    buffer_output();
    json_set_alloc_funcs(allocate, free); /* no member of an object is missing for want of memory */
    atexit(close_output);
    signal(SIGXFSZ, SIG_IGN); /* a file too large is a failed write with its message, not a death */
    argp_program_version = "gough " GOUGH_VERSION;
    argp_err_exit_status = GOUGH_ERROR_INPUT;

    const command_verb *found = NULL;
    char name[] = "gough", *text = make_text();
    const struct argp argp = {.parser = read_verb, .args_doc = "VERB ...", .doc = text};
    if (count > 0) argument[0] = name; /* not what the caller made of it */
    int leading = 1;                   /* options that stand before the verb */
    while (leading < count && argument[leading][0] == '-') leading++;
    refuse_strange_option(&argp, leading, argument);
    argp_parse(&argp, count, argument, ARGP_IN_ORDER, NULL, &found);
    free(text);

    int first = 1; /* only options that end the process stand before the verb */
    while (first < count && strcmp(argument[first], found->name) != 0) first++;
    char title[32];
    snprintf(title, sizeof title, "gough %s", found->name);
    argument[first] = title;
    return (int)verb_run(found, count - first, argument + first);
}
