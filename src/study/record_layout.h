/* How a record of motion is written: what stands between its cells, which line names the columns, in which units they are, and
 * where the numbers begin. Found from its first lines, as far as the study does not say it.
 *
 * A record is lines of cells. Before the first row of numbers there may be any lines, among them a row of names and below it a row
 * of units; lines that begin with the comment's mark do not count. Each row has one cell for each column. */
#ifndef STUDY_RECORD_LAYOUT_H
#define STUDY_RECORD_LAYOUT_H

#include "study/record_keys.h"
#include "study/record_lines.h"

typedef struct study_layout {
    char separator;      /* ',', ';', '\t', or ' ' for blanks and tabs */
    char decimal;        /* '.' or ',' */
    const char *comment; /* the mark of a line that does not count; NULL: # or % */
    size_t columns;
    const char **name;     /* of each column, without quotes; NULL: no row names them */
    const char **unit;     /* of each column, as the row of units or the name has it; "": none */
    size_t first;          /* number of the line of the first row of numbers, from 1 */
    study_place place;     /* of the row of names, or of the first row */
    const char **place_of; /* where each name stands in the text of the place */
    bool named, units_row;
    bool any; /* a row of numbers was found */
} study_layout;

/* Finds it. The lines are taken from the first; some are left to be taken. False where an error was said: the file has no rows of
 * cells at all. */
bool study_layout_find(study_lines *lines, const study_record_keys *keys, study_layout *layout);

/* Whether a line does not count because of the mark that it begins with. */
bool study_layout_leaves_out(const study_layout *layout, gough_piece line);

/* The number of a cell, which may stand in quotes; as study_decimal_read(). text, if not NULL: the number with a decimal point, 64
 * bytes, which is empty if it is longer. */
int study_layout_number(const study_layout *layout, gough_piece cell, double *value, char *text);

/* A name without its quotes, and without the mark of a comment before it. */
gough_piece study_name_bare(gough_piece cell);

/* The unit at the end of a name: "m" in "Heave (m)", "heave [m]", "heave_m"; empty if it has none that is known or in brackets. The
 * name is cut before it. */
gough_piece study_name_unit(gough_piece *name);

/* Whether it is the same text but for capitals, blanks and underscores. */
bool study_name_is(gough_piece name, const char *known);

#endif
