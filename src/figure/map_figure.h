/* Pictures of stability maps: what those of one axis and of two share. Positions are nominal pixels from the upper left. */
#ifndef GOUGH_FIGURE_MAP_FIGURE_H
#define GOUGH_FIGURE_MAP_FIGURE_H

#include "figure/sheet.h"
#include "figure/tongues.h"

enum {
    STABILITY_WIDTH = 780,
    STABILITY_TITLE = 14,
    STABILITY_TEXT = 12,
    STABILITY_SMALL = 11,
    STABILITY_TOP = 68,  /* of a panel without thresholds: below title and explanation */
    STABILITY_BELOW = 62 /* numbers and title of the abscissa */
};

typedef struct stability_pen {
    FILE *file;
    const char *folder;
    sheet_format format;
    const gough_map_figure *figure;
    const field *field;
    int height;                               /* of the sheet */
    int left, top, panel_width, panel_height; /* of the panel */
    field_view view;                          /* its ranges */
} stability_pen;

extern const char stability_ink[];

/* Title, explanation (that of the dashes is added), settings that hold for the whole sheet. */
void stability_write_frame(const stability_pen *pen, const char *explanation);

/* Margins of a plot: the panel's, or part of the sheet below it. */
void stability_write_margins(const stability_pen *pen, int top, int height);

/* The abscissa: stiffness, with its title or without. */
void stability_write_abscissa(const stability_pen *pen, bool titled);

/* How a title names the unit of a stiffness or a damping: numbers without one may still be in units of the machine. */
typedef struct stability_words {
    char text[48];
} stability_words;
stability_words stability_unit(const stability_pen *pen, gough_unit unit, const char *own);

/* Dashed lines at the thresholds at rest, from the panel's top by so many pixels, their names above it. */
void stability_write_thresholds(const stability_pen *pen, int height);

double stability_screen_x(double x);
double stability_screen_y(const stability_pen *pen, double y);
double stability_size(const stability_pen *pen, double pixels);

/* A number on the scale of growth: 0 … 1 along it, and its text. */
enum { STABILITY_TICS = 20 };
typedef struct stability_tic {
    double shade;
    char text[24];
} stability_tic;

/* As many as stand apart by so much of the scale: growth per period, or growth rate where all rests. */
int stability_list_tics(const field *field, double apart, stability_tic tic[STABILITY_TICS]);

/* From value to pixel. */
double stability_place_x(const stability_pen *pen, double value);
double stability_place_y(const stability_pen *pen, double value);

/* A file of data in the folder; NULL when it cannot be opened. */
FILE *stability_open(const stability_pen *pen, const char *name);

/* The two kinds of picture; false where a file could not be written. */
bool stability_write_plane(stability_pen *pen);
bool stability_write_line(stability_pen *pen);

/* How many lanes of modes a picture of one axis has below its panel. */
int stability_lanes(const field *field);

#endif
