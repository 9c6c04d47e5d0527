/* A stability map made drawable: how fast deviations grow over stiffness and second axis, between grid points too, with the edges
 * of its intervals followed from row to row. */
#ifndef GOUGH_FIGURE_TONGUES_H
#define GOUGH_FIGURE_TONGUES_H

#include "gough/report.h"

/* Growth at one stiffness of a row. `level` is ln(growth per period), or the growth rate where all rows rest; 0 where nothing
 * grows. */
typedef struct field_node {
    double x, level;
} field_node;

/* An interval of row `row` that goes on as one of row + 1; -1: it begins or ends between them. */
typedef struct field_pair {
    size_t row;
    int low, high; /* numbers in the lists of row and row + 1 */
} field_pair;

typedef struct field {
    const gough_map_options *options;
    const gough_map *map;
    size_t rows;
    bool resting;     /* levels are growth rates */
    double greatest;  /* of the levels */
    field_node *node; /* [row][nodes] by rising x */
    size_t nodes;     /* room in each row */
    size_t *count;    /* nodes of each row */
    field_pair *pair; /* by rising row */
    size_t pairs;
    size_t *first; /* of each row, the number of its first pair; and their count */
} field;

/* False when out of memory. Free it in every case. */
bool field_make(field *f, const gough_map_options *options, const gough_map *map);
void field_free(field *f);

const gough_interval *field_interval(const field *f, size_t row, int number);

/* The level in a row, linear between nodes. */
double field_level(const field *f, size_t row, double x);

/* Whether a point of the grid has no values; whether rows that have some lack them at a point. */
bool field_gap(const field *f, size_t row, size_t column);
bool field_has_gaps(const field *f);

/* Whether another interval of the row holds x in its inside. */
bool field_covered(const field *f, size_t row, int number, double x);

/* Colours of the plane: width × height pixels of red, green, blue, first the row at the top. */
typedef struct field_view {
    int width, height;
    double low_x, high_x, low_y, high_y;
} field_view;
void field_paint(const field *f, const field_view *view, unsigned char *pixel);

/* 0 … 1 along the scale of colours, and the colour there. */
double field_shade(const field *f, double level);
void field_colour(double shade, unsigned char rgb[3]);

#endif
