/* A sampled controller at home for reading. */
#ifndef GOUGH_CLI_CHECK_SAMPLING_H
#define GOUGH_CLI_CHECK_SAMPLING_H

#include "cli/common/sampled_view.h"

/* Lines of the section "Control"; nothing for a continuous controller. */
void print_sampling(const gough_study *study, const gough_units *unit, const sampled_view *view);

#endif
