/* The command `gough`: finds the verb and passes it the rest of the command line. Exit codes are those of gough_status. */
#define _GNU_SOURCE
#include <argp.h>
#include <errno.h>
#include <fcntl.h>
#include <jansson.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "cli/common/memory.h"
#include "cli/common/refusal.h"
#include "cli/common/talk.h"
#include "cli/common/verb.h"
#include "cli/help/command_text.h"
#include "cli/sweep/sweep_crew.h"

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

/* What a command line has before its verb. */
typedef struct beginning {
    const command_verb *verb;
    int at;         /* of the verb */
    word_list word; /* options to be passed on to it */
    word_list text; /* those of them that were composed here */
} beginning;

static void pass_setting(beginning *found, const char *setting) {
    char *word = allocate(strlen(setting) + sizeof "--set=");
    strcat(strcpy(word, "--set="), setting);
    word_list_add(&found->word, word);
    word_list_add(&found->text, word);
}

static error_t read_beginning(int key, char *argument, struct argp_state *state) {
    beginning *found = state->input;
    switch (key) {
    case 'q':
        word_list_add(&found->word, "--quiet");
        return 0;
    case KEY_JSON:
        talk_in_json();
        word_list_add(&found->word, "--json");
        return 0;
    case KEY_DIMENSIONLESS:
        word_list_add(&found->word, "--dimensionless");
        return 0;
    case KEY_SET:
        pass_setting(found, argument);
        return 0;
    case ARGP_KEY_ERROR:
        refuse_option(state);
        return EINVAL;
    case ARGP_KEY_NO_ARGS:
        if (talks_in_json()) usage_error(state, "the verb is missing");
        if (the_crew.only) usage_error(state, "the verb is missing: %s", the_crew.only);
        print_command_help(stderr);
        exit(GOUGH_ERROR_INPUT);
    case ARGP_KEY_ARG:
        found->verb = find_verb(state, argument);
        if (the_crew.only && strcmp(found->verb->name, the_crew.only) != 0)
            usage_error(state, "%s has the verb '%s' only; use 'gough %s'", the_crew.command,
                        the_crew.only, argument);
        found->at = state->next - 1;
        state->next = state->argc; /* the rest belongs to the verb */
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

/* Runs the verb with the options before it and the words behind it. */
static gough_status run_verb(const beginning *found, int count, char **argument) {
    char title[32];
    snprintf(title, sizeof title, "%s %s", the_crew.command, found->verb->name);
    char **word = allocate(((size_t)count + found->word.count + 1) * sizeof *word);
    int words = 0;
    word[words++] = title;
    for (size_t i = 0; i < found->word.count; i++) word[words++] = (char *)found->word.word[i];
    for (int i = found->at + 1; i < count; i++) word[words++] = argument[i];
    word[words] = NULL;
    const gough_status status = verb_run(found->verb, words, word);
    free(word);
    return status;
}

/* An answer is written as a whole, unless someone is reading along. */
static void buffer_output(void) {
    static char buffer[1 << 18];
    if (!isatty(STDOUT_FILENO)) setvbuf(stdout, buffer, _IOFBF, sizeof buffer);
}

/* Help in lines of the terminal's width, unless the user has other wishes. */
static void shape_help(void) {
    enum { NARROW = 50, USUAL = 79, WIDE = 99 };
    struct winsize size = {0};
    int width = USUAL;
    if (isatty(STDOUT_FILENO) && ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
        width = size.ws_col - 1;
    if (width < NARROW) width = NARROW;
    if (width > WIDE) width = WIDE;
    char format[64];
    snprintf(format, sizeof format, "no-dup-args-note,rmargin=%d", width);
    setenv("ARGP_HELP_FMT", format, 0);
}

int main(int count, char **argument) {
    if (the_crew.begin) the_crew.begin(&count, &argument);
    occupy_standard_descriptors();
    buffer_output();
    json_set_alloc_funcs(allocate, free); /* no member of an object is missing for want of memory */
    atexit(close_output);
    signal(SIGXFSZ, SIG_IGN); /* a file too large is a failed write with its message, not a death */
    shape_help();
    argp_program_version = command_version;

    beginning found = {0};
    char name[16], *text = the_crew.text ? strdup(the_crew.text) : command_text();
    snprintf(name, sizeof name, "%s", the_crew.command);
    const struct argp_child children[] = {{.argp = &help_argp}, {0}};
    const struct argp argp = {.options = leading_options,
                              .parser = read_beginning,
                              .args_doc = "VERB ...",
                              .doc = text,
                              .children = children};
    if (count > 0) argument[0] = name; /* not what the caller made of it */
    argp_parse(&argp, count, argument, ARGP_IN_ORDER | ARGP_OWN_VOICE, NULL, &found);
    free(text);
    const gough_status status = run_verb(&found, count, argument);
    for (size_t i = 0; i < found.text.count; i++) free((void *)found.text.word[i]);
    free(found.text.word);
    free(found.word.word);
    return (int)status;
}
