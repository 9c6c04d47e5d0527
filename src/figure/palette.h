/* Colours of lines, by what the line is of: one table for figures and page, palette.def. */
#ifndef GOUGH_FIGURE_PALETTE_H
#define GOUGH_FIGURE_PALETTE_H

#include <stddef.h>

/* Indices of colours: legs from 0 to 5; axes from 0 to 2; tables or lines of no certain kind from 0 on. Beyond six tables the
 * colours come again, in another round. */
int colour_of_leg(int leg);
int colour_of_axis(int axis);
int colour_of_table(size_t number);

/* A colour as "#rrggbb", and how many times all colours have come before. */
const char *colour_text(int index);
int colour_round(int index);

#endif
