/* What `gough check` tells about recorded motion, in the study's units. */
#ifndef GOUGH_CLI_CHECK_RECORD_H
#define GOUGH_CLI_CHECK_RECORD_H

#include "cli/common/json.h"

/* One line for each column: its step, the accelerations of rounding and of the motion, and its smoothing. */
void record_print(FILE *stream, const gough_record *record, const gough_units *units);

json_t *record_object(const gough_record *record);

#endif
