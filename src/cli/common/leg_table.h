/* Columns of numbers with their points aligned, one row a leg. */
#ifndef GOUGH_CLI_LEG_TABLE_H
#define GOUGH_CLI_LEG_TABLE_H

#include <stdbool.h>
#include <stdio.h>

#include "gough/gough.h"

/* Ends a list of columns: a column without a head. Neighbours with the same group share one heading. */
typedef struct table_column {
    const char *group, *head;
    double value[GOUGH_LEGS + 1]; /* legs 1 … 6 and all of them together; NaN: no entry */
    int digits;                   /* significant, of the largest of the group */
} table_column;

void table_print(FILE *stream, const table_column *column, bool with_all);

#endif
