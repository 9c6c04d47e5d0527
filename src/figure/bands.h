/* Lines that go up and down faster than a picture shows: bands from the least to the greatest number. */
#ifndef GOUGH_FIGURE_BANDS_H
#define GOUGH_FIGURE_BANDS_H

#include <stdio.h>

#include "figure/axis_ranges.h"

/* Whether a line has more than two periods in a pixel of a panel of that many pixels, between these abscissas. */
bool band_needed(const panel *panel, const series *line, range x, int pixels);

/* Whether a panel has such a line. */
bool band_in_panel(const panel *panel, range x, int pixels);

/* Writes for each pixel the abscissa, the least and the greatest number; a blank line where a pixel has no number.
 * @return the lines written with numbers */
size_t band_write(FILE *file, const panel *panel, const series *line, range x, int pixels,
                  double scale);

#endif
