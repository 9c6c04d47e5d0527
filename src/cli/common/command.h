/* What the verbs of the command share: options, talk, progress, the study that they read and the summary they print. */
#ifndef GOUGH_CLI_COMMAND_H
#define GOUGH_CLI_COMMAND_H

#include <argp.h>
#include <stdbool.h>
#include <stdio.h>

#include "gough/gough.h"

/* ---- verbs: each takes its own arguments, argument[0] being "gough VERB", and returns the exit code ---- */

gough_status example_verb(int count, char **argument);
gough_status check_verb(int count, char **argument);
gough_status forces_verb(int count, char **argument);
gough_status simulate_verb(int count, char **argument);
gough_status sweep_verb(int count, char **argument);
gough_status merge_verb(int count, char **argument);
gough_status plot_verb(int count, char **argument);
gough_status stability_verb(int count, char **argument);
gough_status tune_verb(int count, char **argument);
gough_status report_verb(int count, char **argument);

/* ---- options.c: the options of the command line ---- */

enum option_key {
    OPTION_OUTPUT = 'o',
    OPTION_QUIET = 'q',
    OPTION_JSON = 0x100, /* beyond characters: no short form */
    OPTION_SET,
    OPTION_PRECISION,
    OPTION_REACTIONS,
    OPTION_DIMENSIONLESS,
    OPTION_FIGURE,
    OPTION_COLUMNS,
    OPTION_FROM,
    OPTION_TO,
    OPTION_LOG,
    OPTION_LABEL,
    OPTION_TITLE,
    OPTION_THREADS,
    OPTION_LANES,
    OPTION_SHARD,
    OPTION_RUN,
    OPTION_POSE,
    OPTION_MATRIX,
    OPTION_AT,
    OPTION_SWEEP_STIFFNESS,
    OPTION_SWEEP_AMPLITUDE,
    OPTION_SWEEP_FREQUENCY,
    OPTION_SWEEP_DAMPING,
    OPTION_DEVIATION,
    OPTION_ANGLE_DEVIATION,
    OPTION_DAMPING_RATIO,
    OPTION_FEEDFORWARD,
    OPTION_MARGIN,
    OPTION_STIFFNESS,
    OPTION_ALL
};

/* Values of one axis of a map: `count` of them from `from` to `to`, by equal steps or equal ratios. */
typedef struct axis_values {
    int key; /* which option asked for it; 0: not asked for */
    double from, to;
    size_t count;
    bool logarithmic;
} axis_values;

/* What gough tune is asked for; NaN: not said. */
typedef struct tuning_request {
    double deviation, angle, ratio, margin; /* the angle in degrees */
    double from, to;                        /* of the stiffness */
    bool bounded;                           /* whether those two were said */
    int feedforward;                        /* 0 without, 1 with, 2 both */
} tuning_request;

typedef struct command_line {
    const char *verb;
    const char *output;   /* the last one; NULL: none */
    const char **outputs; /* all, where a verb takes several */
    size_t output_count;
    bool json, quiet, reactions, dimensionless, all;
    gough_precision precision;
    gough_setting *settings; /* from --set */
    size_t setting_count;
    const char **file; /* what is no option, in order */
    size_t files;
    const char **label; /* from --label */
    size_t labels;
    gough_figure figure;
    int threads, lanes;            /* 0: as many as there are */
    size_t shard, shards, one_run; /* 0: not asked for */
    bool posed, matrix;
    double pose[GOUGH_COMPONENTS]; /* from --pose: lengths and degrees, from home */
    double at;                     /* NaN: not asked for */
    axis_values stiffness, second; /* of a stability map */
    tuning_request tuning;
} command_line;

/* What a verb accepts; the text of its --help. */
typedef struct verb_usage {
    const char *verb;
    const struct argp_option *option;
    const char *arguments; /* "STUDY" */
    const char *text;
    size_t least_files, most_files;
    char *(*help_filter)(int key, const char *text, void *input);
} verb_usage;

/* Reads the command line; what is wrong with it ends the process with a sentence and exit code 2. */
command_line command_line_read(const verb_usage *usage, int count, char **argument);
void command_line_free(command_line *line);

/* ---- option_values.c: parts of option values ---- */

/* The text up to `end`, if it is one finite decimal number and nothing else. */
bool read_decimal(const char *text, const char *end, double *value);

/* "heave=0.1,yaw=10": adds to the components. Returns false with a sentence for the user. */
bool read_pose(const char *text, double pose[GOUGH_COMPONENTS], gough_error *error);

/* "a:b:n" or "a:b:n:log", as option --NAME has it. Returns false with a sentence for the user. */
bool read_axis(const char *name, const char *text, axis_values *axis, gough_error *error);

/* "a:b", two numbers. Returns false with a sentence for the user. */
bool read_span(const char *text, double *from, double *to, gough_error *error);

/* ---- talk.c: messages on standard error, and text of users in any message or summary ---- */

/* A line with text of the user in it, such as a title or the name of a file: as gough_text_show() has it, so that no byte of it
 * can drive a terminal. */
void print_line(FILE *stream, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* The title of a study as a line of its own; nothing if there is none (NULL or ""). */
void print_title(FILE *stream, const char *title);
/* Ends the process with a sentence about the command line, how to ask for help, and exit code 2. */
void usage_error(const struct argp_state *state, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
/* The same for an option that does not exist, where its name is not printable: argp would print it as it is. */
void refuse_strange_option(const struct argp *argp, int count, char **argument);
/* "gough VERB: error: …"; texts of the user likewise */
void complain(const char *verb, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* "own.yaml:12:10", the place of the key that a sentence begins with, to be freed; NULL: the study does not give it */
char *place_of(const gough_study *study, const char *sentence);
/* The same of a sentence about a study: "gough VERB: error: own.yaml:12:10: …" with the place of the key that it begins with, or
 * else the name of the study. */
void complain_of(const char *verb, const gough_study *study, const char *sentence);
/* "gough VERB: …" */
void remark(const char *verb, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Remarks, if computation shows it, that the loop of a study to be simulated is unstable (growth.c). */
void remark_growth(const char *verb, const gough_study *study, const gough_units *units);
/* whether colours may be used on a stream */
bool colourful(FILE *stream);
/* the candidate nearest to a misspelled word; NULL if none is near */
const char *nearest_word(const char *word, const char *const *candidate, size_t count);

/* ---- interrupt.c: Ctrl-C, SIGTERM and SIGHUP ---- */

/* From here on these signals say this sentence, about what is kept, before they end the process. */
void interrupt_says(const char *verb, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
/* The sentence about outputs, of which the first `written` are complete. */
void interrupt_outputs(const char *verb, const char *const *output, size_t count, size_t written);

/* ---- memory.c: when memory runs out ---- */

/* Says so and ends the process with GOUGH_ERROR_FILE; nothing half done is left. */
_Noreturn void out_of_memory(void);
/* malloc() that does not return without memory. */
void *allocate(size_t size);

/* ---- progress.c: a bar on a terminal for work over a second ---- */

typedef struct progress {
    bool wanted, shown;
    const char *verb;
    double whole;         /* duration of the run, or how many there are */
    double first;         /* what is done already at the beginning */
    const char *counted;  /* "runs", of which the rate is shown; NULL: none */
    double started, last; /* of the clock, seconds */
} progress;

progress progress_begin(const char *verb, double whole, bool quiet);
void progress_update(progress *progress, double done);
void progress_end(progress *progress);

/* ---- study and run ---- */

/* Reads the study named on the command line with its --set overrides and says what is wrong with it; an output that is the study
 * or its recorded motion is refused. */
gough_status read_study(const command_line *line, gough_study **study);

/* The sweep of a study that was read so. */
gough_status read_sweep(const command_line *line, const gough_study *study, gough_sweep **sweep);

/* Checks the outputs before a long run and refuses what would fail at its end: a file name that ends neither in .h5 nor in .csv nor
 * in `other`, a folder that does not exist, the same file twice, standard output for both a table and JSON. */
gough_status check_output(const command_line *line, const char *other);

/* "studies/heave.yaml" gives "studies/heave" and the ending; `otherwise` for standard input and other pipes, which have no name.
 * Allocated; NULL: out of memory. */
char *output_beside(const char *input, const char *ending, const char *otherwise);

/* Refuses an output that is the same file as one of the inputs, by whatever names and links. */
gough_status check_overwriting(const char *verb, const char *output, const char *const *input,
                               size_t inputs);

/* Refuses two outputs that are the same file. */
gough_status check_distinct(const command_line *line);

/* Whether one of the outputs is standard output. */
bool writes_standard(const command_line *line);

/* Whether the folder is there that a file is to go to. */
gough_status check_folder(const char *verb, const char *path);

/* forces and simulate differ in the function that they call. */
gough_status run_verb(const verb_usage *usage, bool simulated, int count, char **argument);

#endif
