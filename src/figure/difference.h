/* Differences of runs: tables of what each further table has more than the first. */
#ifndef GOUGH_FIGURE_DIFFERENCE_H
#define GOUGH_FIGURE_DIFFERENCE_H

#include "figure/builder.h"

/* Tables of differences, and the labels that go with them. */
typedef struct difference {
    size_t count;
    gough_table **table;
    char (*text)[SHEET_TEXT];
    const char **label;
    char title[2 * SHEET_TEXT]; /* "A − B", or "differences from B" */
} difference;

/* @return GOUGH_ERROR_INPUT with a sentence for tables that have no differences row by row. Free it in each case. */
gough_status difference_make(difference *d, const gough_figure *figure,
                             const gough_table *const *tables, const char *const *labels,
                             size_t count, gough_error *error);

void difference_free(difference *d);

#endif
