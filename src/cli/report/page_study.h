/* What the page shows of one study, as JSON; and the template that it is put into. */
#ifndef GOUGH_CLI_PAGE_STUDY_H
#define GOUGH_CLI_PAGE_STUDY_H

#include <jansson.h>

#include "cli/common/verb.h"

/* carried inside the command; length 0 where it was built without the page */
gough_page_template page_template(void);

/* How much of a run the page has. */
typedef struct page_options {
    bool thin; /* pose, rates, forces and drift alone: the page computes the other columns */
} page_options;

/* Everything that can be computed of a study: machine, program, run, stability. Allocated; *object is set wherever there is
 * something to show.
 * @return GOUGH_OK; GOUGH_ERROR_NUMERICAL where a run ended early, which the page then says; else an error that was said. */
gough_status page_study(const command_line *line, const page_options *options, gough_study *study,
                        json_t **object);

#endif
