/* Ranges of the axes of a sheet, from its data. */
#ifndef GOUGH_FIGURE_AXIS_RANGES_H
#define GOUGH_FIGURE_AXIS_RANGES_H

#include "figure/sheet.h"

typedef struct range {
    double low, high;
} range;

/* A range in thousands, thousandths and so on of a panel's unit: values are divided by 1000 to the power. */
typedef struct scaled_range {
    range range;
    int power;
} scaled_range;

/* The abscissa that all panels of a sheet share. */
range sheet_abscissa(const sheet *sheet);

/* The ordinate of a panel with lines or a map. */
scaled_range panel_ordinate(const panel *panel);

/* The colours of a panel with a map. */
scaled_range panel_colours(const panel *panel);

/* What is drawn of an ordinate: its magnitude on a logarithmic axis. */
double panel_drawn(const panel *panel, double value);

/* A logarithmic panel whose numbers are all noise becomes a linear one, in which they lie at zero. */
void panel_settle_scale(panel *panel);

#endif
