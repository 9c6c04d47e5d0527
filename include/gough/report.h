/** @file report.h
 *  Figures of results as PNG, SVG or PDF, drawn by gnuplot, and the page. These functions run gnuplot and write files.
 *
 *  Accuracy: numbers on axes have the digits shown; lines of many rows are thinned, as gough_figure_draw() says.
 *  Overlap: no memory is written.
 *  Threads: functions may be called from several threads at once, on distinct files.
 */
#ifndef GOUGH_REPORT_H
#define GOUGH_REPORT_H

#include "gough/map.h"
#include "gough/result.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Options of a figure. */
typedef struct gough_figure {
    size_t size; /**< of this struct in bytes, from gough_figure_default(), or 0 */
    const char
        *kind; /**< name of one of gough_figure_kinds(); NULL: the one that suits the table */
    const char *title;   /**< NULL: the table's title */
    const char *columns; /**< NULL, or names separated by commas, for kind "columns" */
    double from;         /**< first t; NaN: from the beginning */
    double to;           /**< last t; NaN: to the end */
    bool logarithmic;    /**< magnitudes on a logarithmic vertical axis */
    double
        max_speed; /**< of kind "duty": limit of the leg rate that is drawn, in the unit of the first table; NaN: the table's */
    double max_force;  /**< the same of the drive force */
    const char *style; /**< NULL or "screen"; "print": lines differ by dashes too and have their
                          names at their ends, so that they are told apart without colours */
    double width;      /**< of the picture in mm, 40 to 1000; NaN: 198 mm, or 264 mm with two
                          panels beside each other */
    double font;       /**< size of the text in points, 4 to 40; NaN: 8.64, and 8 with a width.
                          Numbers on axes and keys have 11/12 of it */
    double dpi;        /**< dots per inch of a PNG, 30 to 2400; NaN: 200 */
    bool split;        /**< kinds "forces", "lengths", "rates" and "power": a panel for each leg,
                          all with one scale */
    bool difference;   /**< draw what each further table has more than the first, row by row */
} gough_figure;

/** Fills in the defaults: kind and title from the tables, all columns and times.
 *  @param size  sizeof(gough_figure)
 *  @return as gough_platform_init() */
GOUGH_API gough_status gough_figure_init(gough_figure *figure, size_t size);

/** The options that gough_figure_init() fills in. */
static inline gough_figure gough_figure_default(void) {
    gough_figure figure;
    (void)gough_figure_init(&figure, sizeof figure);
    return figure;
}

/** Kinds of figure, terminated by NULL, each "name — sentence". */
GOUGH_API const char *const *gough_figure_kinds(void);

/** Reads a table for gough_figure_draw(), as gough_table_read() does. The numbers of a large sweep stay in its file (`source`):
 *  each figure reads them in parts, so that memory does not grow with the runs. The table then has no numbers (`value` is NULL),
 *  and the file must remain as it is.
 *  @return as gough_table_read() */
GOUGH_API gough_status gough_figure_read(const gough_figure *figure, const char *path,
                                         gough_table **table, gough_error *error);

/** Draws one figure of one or several tables, compared in the same panels, to .png, .svg or .pdf. The file is complete or absent,
 *  with the same bytes each time. Legs that coincide within the errors of a run (1e-8 of the greatest) are drawn as one line;
 *  lines of many rows are thinned but keep their peaks; the motion omits components of the pose that hardly move. A sweep's picture
 *  is the same from memory and from a file; a map over 600 × 340 runs shows the greatest number of several in a cell and says so.
 *  Kind "gain" draws columns G and position_deviation, and draws rings where the column `ended`, if present, is 1.
 *  @param labels  name of each table in the key; NULL, or one of them NULL: its title
 *  @return GOUGH_OK, GOUGH_ERROR_INPUT (unknown extension, kind or column; the message suggests the nearest) or GOUGH_ERROR_FILE
 *  (gnuplot is missing or failed, the folder does not exist, the disk is full). gnuplot never executes text of the tables. */
GOUGH_API gough_status gough_figure_draw(const gough_figure *figure,
                                         const gough_table *const *tables,
                                         const char *const *labels, size_t table_count,
                                         const char *path, gough_error *error);

/** Options for drawing a stability map. */
typedef struct gough_map_figure {
    const char *title;      /**< heading; "": none */
    gough_units units;      /**< units of the map's numbers, for the titles of the axes */
    const gough_rest *rest; /**< its thresholds are drawn, in the units of the map; NULL: none */
} gough_map_figure;

/** Draws a stability map to .png, .svg or .pdf. One row: growth per period over the stiffness, and beneath it, for each mode, the
 *  intervals in which it grows. Several rows: colours for growth over both axes with the edges of the intervals; rows without
 *  results are grey. The file is complete or absent, with the same bytes each time.
 *  @return GOUGH_OK, GOUGH_ERROR_INPUT (extension unknown) or GOUGH_ERROR_FILE, as gough_figure_draw(). */
GOUGH_API gough_status gough_map_draw(const gough_map_options *options, const gough_map *map,
                                      const gough_map_figure *figure, const char *path,
                                      gough_error *error);

/** The page without data: one HTML text, built from the sources in web/. */
typedef struct gough_page_template {
    const char *text; /**< need not be terminated */
    size_t length;    /**< bytes; 0: the program was built without the page */
} gough_page_template;

/** Writes the page with data to a file, which is complete or absent.
 *  @param data,length  one JSON value, UTF-8; any text in it is escaped, so that it cannot end the HTML element that contains it
 *  @return GOUGH_OK, GOUGH_ERROR_INPUT (the template has no place for data) or GOUGH_ERROR_FILE. */
GOUGH_API gough_status gough_page_write(const gough_page_template *page, const char *data,
                                        size_t length, const char *path, gough_error *error);

#ifdef __cplusplus
}
#endif
#endif
