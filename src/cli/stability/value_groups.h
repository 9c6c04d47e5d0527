/* Tables of eigenvalues and multipliers: values alike together, named by what moves. */
#ifndef GOUGH_CLI_VALUE_GROUPS_H
#define GOUGH_CLI_VALUE_GROUPS_H

#include "cli/stability/stability_report.h"

/* What a table of eigenvalues or multipliers is made of. */
typedef struct mode_value {
    double value[2];
    const gough_mode *mode;
} mode_value;

typedef struct value_group {
    double value[2];                           /* not below the real axis */
    const gough_mode *mode[GOUGH_LINEAR_MOST]; /* of the values alike */
    int count;
} value_group;

/* Groups of equal values; of conjugates the upper one stands for both. Eigenvalues are rounded in proportion to the largest of
 * them, multipliers each in proportion to itself. */
int group_values(const mode_value *value, size_t count, bool multipliers,
                 value_group group[GOUGH_LINEAR_MOST]);

/* Width of the column of names. */
int name_width(const value_group *group, int groups);

/* "yaw", "sway–tilt ×2"; this and the next two return the width printed */
int print_name(FILE *stream, const value_group *group, int width);

/* A number, or a dash where it says nothing. */
int print_cell(FILE *stream, double value, int width);

/* A heading in a cell; where it would touch the one before, the cell is wider. */
int print_heading(FILE *stream, const char *what, const char *unit, int width);

/* What moves, at the end of a line that has `used` columns, or on one of its own. */
void print_moves(FILE *stream, const stability_report *report, const value_group *group, int used);

#endif
