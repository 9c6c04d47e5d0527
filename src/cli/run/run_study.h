/* What forces and simulate share: their options, and the run of a study with its table and summary. */
#ifndef GOUGH_CLI_RUN_STUDY_H
#define GOUGH_CLI_RUN_STUDY_H

#include "cli/common/from_lengths.h"

typedef struct run_options {
    gough_precision precision; /* GOUGH_DOUBLE unless the option or the study has more digits */
    bool reactions, joints, actuators;
} run_options;

typedef struct run_line {
    command_line line;
    run_options run;
    bool all;            /* forces only */
    lengths_asked start; /* simulate only */
} run_line;

extern const option_group run_group; /* run_options */

#define RUN_GROUPS                                                                                 \
    USES_OUTPUT(TABLE_OUTPUT), USES_JSON, USES_SETTINGS, USES(run_group, run_line, run, NULL),     \
        USES_DIMENSIONLESS("print table and summary in units of R_b, M and sqrt(R_b/g)")

/* forces and simulate differ in the function that they call. */
gough_status run_study(const run_line *line, bool simulated);

#endif
