/* gough tune --poles and --lqr: matrices of gains. */
#ifndef GOUGH_CLI_TUNE_GAINS_H
#define GOUGH_CLI_TUNE_GAINS_H

#include "cli/common/verb.h"

/* What is asked for; numbers in the study's units, NaN: not given. */
typedef struct gains_options {
    double poles[2]; /* frequency in cycles per unit of time, damping ratio */
    double lqr[2];   /* weights of lengths and of rates */
    bool posed;
    double pose[GOUGH_COMPONENTS]; /* from home */
} gains_options;

extern const option_group gains_group;

/* What is wrong with the options of --poles and --lqr on their own, as a sentence; NULL if nothing is. */
bool gains_asked(const gains_options *asked);
const char *gains_contradiction(const gains_options *asked);

/* Finds the gains for a study and prints them. */
gough_status gains_answer(const command_line *line, const gains_options *asked,
                          const gough_study *study);

#endif
