/* What `gough check` tells about moves whose durations follow from limits, in the study's units. */
#ifndef GOUGH_CLI_CHECK_MOVES_H
#define GOUGH_CLI_CHECK_MOVES_H

#include "cli/common/json.h"

/* One line for each such move: its times, and what keeps it from being faster. */
void moves_print(FILE *stream, const gough_study *study, const gough_units *units);

/* all moves; NULL if the motion has none */
json_t *moves_array(const gough_study *study);

#endif
