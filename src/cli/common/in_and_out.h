/* Studies in and results out, as all verbs that have them read and check them. */
#ifndef GOUGH_CLI_IN_AND_OUT_H
#define GOUGH_CLI_IN_AND_OUT_H

#include "cli/common/verb.h"

/* Reads a study and applies the --set overrides of the command line. Reports what is wrong with the study, and refuses an output
 * that is the study itself or its recorded motion. */
gough_status read_study(const command_line *line, const char *path, gough_study **study);

/* The sweep of a study that was read so. */
gough_status read_sweep(const command_line *line, const gough_study *study, gough_sweep **sweep);

/* The study with its section `design`, likewise. */
gough_status read_design(const command_line *line, const gough_study *study,
                         gough_design_study **design);

/* Checks before a long run that at most one output is given, and that it can be a study: .yaml, .yml or standard output. */
gough_status check_study_output(const command_line *line);

/* Checks the outputs before a long run and refuses what would fail at its end: a file name that ends neither in .h5 nor in .csv nor
 * in `other`, a folder that does not exist, the same file twice, standard output for both a table and JSON. */
gough_status check_output(const command_line *line, const char *other);

/* The same where outputs may be data (.csv, .h5, -) or pictures (.png, .svg, .pdf). */
gough_status check_data_and_pictures(const command_line *line);
bool is_data(const char *path);

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

#endif
