/** @file report.h
 *  Figures of results as PNG, SVG or PDF, drawn by gnuplot, and the page. This room runs a program and writes files.
 */
#ifndef GOUGH_REPORT_H
#define GOUGH_REPORT_H

#include "gough/map.h"
#include "gough/result.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What to draw. */
typedef struct gough_figure {
    const char
        *kind; /**< NULL: chosen by the table; else the name of one of gough_figure_kinds() */
    const char *title;   /**< NULL: the table's title */
    const char *columns; /**< NULL, or names separated by commas, for kind "columns" */
    double from;         /**< first t; NaN: from the beginning */
    double to;           /**< last t; NaN: to the end */
    bool logarithmic;    /**< logarithmic ordinate, of magnitudes */
} gough_figure;

/** Everything from the tables, nothing chosen. */
GOUGH_API gough_figure gough_figure_default(void);

/** Kinds of figure, terminated by NULL, each "name — sentence". */
GOUGH_API const char *const *gough_figure_kinds(void);

/** Draws one figure of one or several tables (compared in the same panels) to .png, .svg or .pdf. Complete or absent, the same
 *  bytes each time. Legs that coincide within 1e-9 are one line; lines of many rows are thinned, their peaks kept; components
 *  of the pose that hardly move beside the others are left out of the motion. Kind "gain" draws columns G and
 *  position_deviation, and rings points whose column `ended`, if there is one, is 1.
 *  @param labels  what each table is called in the key; NULL, or one of them NULL: its title
 *  @return GOUGH_OK, GOUGH_ERROR_INPUT (extension, kind or column unknown, the nearest named) or GOUGH_ERROR_FILE (gnuplot is
 *  missing or failed, the folder does not exist, the disk is full). Text of the tables is never executed. */
GOUGH_API gough_status gough_figure_draw(const gough_figure *figure,
                                         const gough_table *const *tables,
                                         const char *const *labels, size_t table_count,
                                         const char *path, gough_error *error);

/** How a stability map is drawn. */
typedef struct gough_map_figure {
    const char *title;      /**< heading; "": none */
    gough_units units;      /**< that the map's numbers are in, for the titles of the axes */
    const gough_rest *rest; /**< its thresholds are drawn, in the units of the map; NULL: none */
} gough_map_figure;

/** Draws a stability map to .png, .svg or .pdf. One row: growth per period over the stiffness, and beneath it, for each mode, the
 *  intervals in which it grows. Several: colours for growth over both axes with the edges of the intervals; rows without
 *  values are grey. Complete or absent, the same bytes each time.
 *  @return GOUGH_OK, GOUGH_ERROR_INPUT (extension unknown) or GOUGH_ERROR_FILE, as gough_figure_draw(). */
GOUGH_API gough_status gough_map_draw(const gough_map_options *options, const gough_map *map,
                                      const gough_map_figure *figure, const char *path,
                                      gough_error *error);

/** The page without data, as the build makes it from the sources in web/: one HTML text. */
typedef struct gough_page_template {
    const char *text; /**< need not be terminated */
    size_t length;    /**< bytes; 0: the program was built without the page */
} gough_page_template;

/** Writes the page with data to a file, complete or absent.
 *  @param data,length  one JSON value, UTF-8; text in it, whatever it is, stays text: it cannot end the element that holds it
 *  @return GOUGH_OK, GOUGH_ERROR_INPUT (a template without a place for data) or GOUGH_ERROR_FILE. */
GOUGH_API gough_status gough_page_write(const gough_page_template *page, const char *data,
                                        size_t length, const char *path, gough_error *error);

#ifdef __cplusplus
}
#endif
#endif
