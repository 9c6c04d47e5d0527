/* gough check of a file of recorded motion. */
#ifndef GOUGH_CLI_CHECK_FILE_H
#define GOUGH_CLI_CHECK_FILE_H

#include <jansson.h>

#include "cli/common/in_and_out.h"

/* Whether a name is that of a table in text, not of a study: it ends in .csv, .tsv, .txt, .dat or .asc. */
bool is_motion_file(const char *path);

/* Describes the file; as JSON the object joins `list`, or is printed if that is NULL. */
gough_status check_motion_file(const command_line *line, const char *path, json_t *list);

#endif
