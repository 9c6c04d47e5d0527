/* What the parts of gough design share: what was asked for and found, in units of the run. */
#ifndef GOUGH_CLI_DESIGN_VERB_H
#define GOUGH_CLI_DESIGN_VERB_H

#include "cli/workspace/workspace_verb.h"

typedef struct design_answer {
    const gough_study *study;
    const gough_units *unit;
    const gough_design_key *key;
    size_t keys;
    gough_design_request request;
    gough_design_result result;
    gough_reach reach; /* of the study as written, for what is asked for */
    gough_error error;
    gough_status status;
} design_answer;

/* Whether several aims are weighed against each other; if not, the aim that is. */
bool design_weighs(const design_answer *answer);
gough_aim design_aim(const design_answer *answer);
gough_unit aim_unit(gough_aim aim);

/* The word of a key's unit in the study, as unit_word(). */
const char *key_word(const design_answer *answer, size_t key);

/* The answer of gough workspace that has the same envelope. */
workspace_answer design_workspace(const design_answer *answer);

void design_print(const design_answer *answer);
int design_print_json(const design_answer *answer);

#endif
