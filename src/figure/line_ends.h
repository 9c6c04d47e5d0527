/* Names at the right ends of lines, for readers who tell lines apart by neither colours nor a key. */
#ifndef GOUGH_FIGURE_LINE_ENDS_H
#define GOUGH_FIGURE_LINE_ENDS_H

#include "figure/axis_ranges.h"

/* Room in nominal pixels that the names of a sheet take at the right of its panels. */
int line_ends_room(const sheet *sheet);

/* Labels for the names of a panel's lines at their last points, moved apart where they would cover each other.
 * @param width, height  of the panel in nominal pixels; @param font  size of the text as the terminal counts it */
void line_ends_write(FILE *file, const panel *panel, range x, scaled_range y, int width, int height,
                     double font);

#endif
