/* A table of a sweep, written from its records. */
#ifndef GOUGH_SWEEP_SWEEP_TABLE_H
#define GOUGH_SWEEP_SWEEP_TABLE_H

#include "sweep/sweep_part.h"

/* Writes .h5, .csv or "-" from the records of parts that follow each other; complete or absent. */
gough_status sweep_table_write(const sweep_part *part, size_t parts, const char *path,
                               gough_error *error);

/* Sums up parts that follow each other. */
gough_status sweep_table_sum(const sweep_part *part, size_t parts, gough_sweep_summary *summary,
                             gough_error *error);

#endif
