/* A sheet of panels: what is drawn, before it is told to gnuplot. */
#ifndef GOUGH_FIGURE_SHEET_H
#define GOUGH_FIGURE_SHEET_H

#include "gough/report.h"

enum {
    SHEET_PANELS = 24,
    SHEET_SERIES = 64, /* in one panel */
    SHEET_TEXT = 160,
    SHEET_NOTE = 420, /* an end's whole sentence */
    SHEET_DESCRIPTION = 1600,
    SHEET_ARRAYS = 512
};

/* One line (or points on a line). The numbers belong to a table or to the sheet. */
typedef struct series {
    size_t count;
    const double *x, *y;
    char label[SHEET_TEXT]; /* "" : not in the key */
    int colour;             /* as palette.h gives it; -1: pale and wide, for the program */
    const double
        *ended; /* NULL, or 1 where a point is marked as ended early: points are drawn then */
    const char *ended_label; /* what such points are called; NULL: "ended early" */
    bool points;
    bool mark;               /* no line, but large points */
    bool loop;               /* a curve in the plane, whose abscissa goes back and forth */
    bool limit;              /* a dashed line that nothing should cross */
    bool steps;              /* a staircase: the ordinate rises where a point is */
    bool thinned;            /* of a line with more points, of which these two tell: */
    double least_above_zero; /* of the abscissas; +infinity without any */
    double logarithmic_low;  /* where a logarithmic ordinate begins; NaN without any */
} series;

/* Colours over a grid of two abscissas: cells[row · columns + column], NaN where a run ended early. */
typedef struct map {
    size_t columns, rows;
    const double *x, *y; /* the values of each column and row, increasing */
    const double *cells;
    bool logarithmic_y;
    char ordinate[SHEET_TEXT]; /* name and unit */
} map;

typedef struct panel {
    char heading[SHEET_TEXT]; /* what is drawn, above the panel */
    char unit[32];            /* as in the table: "m/s2"; "" or "1": none */
    bool logarithmic;
    double noise; /* of the numbers, in the unit: what is smaller means nothing; 0: not known */
    double least; /* a logarithmic axis begins no lower; 0: wherever the numbers do */
    bool crossed; /* lines through zero of both axes */
    int count;
    series series[SHEET_SERIES];
    bool mapped; /* `map` is drawn, and no series */
    map map;
} panel;

typedef struct sheet {
    char title[SHEET_TEXT];
    char note[SHEET_NOTE];     /* small, beside or below the title: how the run ended */
    bool alarming;             /* the note begins with a run that ended early or a limit exceeded */
    char abscissa[SHEET_TEXT]; /* name and unit of the abscissa */
    bool logarithmic_abscissa;
    bool common_key;   /* one key for all panels, above them */
    bool common_scale; /* one range of ordinates for all panels */
    int columns;       /* panels beside each other */
    bool print;        /* lines differ by dashes too and have their names at their ends */
    int width;         /* in nominal pixels; 0: what suits the panels */
    double inch;       /* size of a nominal pixel in hundredths of an inch; 0: 1 */
    double dpi;        /* of a PNG; 0: 200 */
    double from, to;   /* range of the abscissa; NaN: of the data */
    int count;
    panel panel[SHEET_PANELS];
    int arrays;
    double *array[SHEET_ARRAYS]; /* numbers that no table has, freed with the sheet */
} sheet;

/* Fills a sheet for a kind of figure (run_figures.c). @param difference  differences of the tables, which are drawn in their place;
 * NULL: the tables are drawn */
struct difference;
gough_status sheet_fill(sheet *sheet, const gough_figure *figure, const gough_table *const *tables,
                        const char *const *labels, size_t table_count,
                        const struct difference *difference, gough_error *error);

/* A sheet's own array of @p count numbers; NULL when out of memory or there are too many. */
double *sheet_array(sheet *sheet, size_t count);

/* for qsort(): numbers in rising order */
int sheet_compare_numbers(const void *a, const void *b);

void sheet_free_arrays(sheet *sheet);

/* A table of a sweep: lines over one swept key, a map over two, shares of the runs over more (sweep.c). */
bool sheet_is_sweep(const gough_table *table);

/* A table of gough tune (tuning.c). */
bool sheet_is_tuning(const gough_table *table);

/* Whether and how the table chooses its kind: name of it. */
const char *sheet_default_kind(const gough_table *table);

/* ---- drawing --------------------------------------------------------------------------------------------------- */

typedef enum sheet_format { SHEET_PNG, SHEET_SVG, SHEET_PDF } sheet_format;

/* How large a picture is drawn, and what it shows in words. */
typedef struct sheet_facts {
    int width, height; /* in nominal pixels */
    double
        inch; /* of a nominal pixel, in hundredths of an inch; 0: 1, and an SVG has no size on paper */
    double dpi;                                      /* of a PNG; 0: 200 */
    char title[SHEET_TEXT], text[SHEET_DESCRIPTION]; /* "": not known */
} sheet_facts;

/* Writes the script "script", which leaves the picture "figure", and the data that it names into a folder, and tells the size. */
typedef gough_status (*sheet_writer)(const void *content, sheet_format format, const char *folder,
                                     sheet_facts *size, gough_error *error);

/* Draws what a writer writes, in a folder that is gone afterwards, and takes the picture to its path, complete or not at all
 * (figure.c). */
gough_status sheet_draw(sheet_writer write, const void *content, const char *path,
                        gough_error *error);

/* Writes a sheet's script and data (script.c). */
gough_status sheet_write_script(const sheet *sheet, sheet_format format, const char *folder,
                                sheet_facts *size, gough_error *error);

/* What scripts of other figures share with it: a terminal of so many nominal pixels, and a size of text in nominal pixels as the
 * terminal counts fonts. */
void sheet_write_terminal(FILE *file, sheet_format format, const sheet_facts *facts);
double sheet_font_size(sheet_format format, double pixels);

/* Edges of the n-th cell of a map: halfway to its neighbours, by ratio on a logarithmic axis (map.c). */
void sheet_cell(const double *centre, size_t count, size_t n, bool logarithmic, double *low,
                double *high);

/* Cells of a map for gnuplot: x, y, ends in x and in y, number, 1 where the cell has no number (map.c). */
bool sheet_write_map(const map *map, bool logarithmic_x, double scale, const char *path);

/* Thins a line for drawing: in each of @p buckets stretches of the abscissa the least and the greatest value stay, in
 * order. Returns the count of points kept, whose indices go to @p index (room for 2·buckets + 2); a line with no more
 * points than that is kept whole. Points that are not finite stand for gaps and are kept once per stretch. */
size_t sheet_thin(const double *x, const double *y, size_t count, size_t buckets, size_t *index);

/* Thins a curve in the plane: a point stays if it is further from the last one kept than a share of what the curve spans in x or
 * in y. Returns the count of points kept, whose indices go to @p index (room for @p count). */
size_t sheet_thin_loop(const double *x, const double *y, size_t count, double share, size_t *index);

/* Text as gnuplot may have it between single quotes: apostrophes become typographic ones (gnuplot takes a doubled quote at
 * the beginning of a string for its end), control characters and broken UTF-8 are replaced; cut to @p characters. */
void sheet_quote(char *quoted, size_t size, const char *text, size_t characters);

/* Bytes of the first line of a text that is broken at spaces into lines of at most that many characters; a longer word is a line of
 * its own. The line's last space belongs to it. */
size_t sheet_line(const char *text, size_t characters);

/* "m/s2" with a power of 1000 as a label: " (mm/s²)", " (10⁻⁶ °)"; power is the exponent of 1000. */
void sheet_unit_label(char *label, size_t size, const char *unit, int power);

/* Last touches to what gnuplot drew (touch.c): a PDF without its date, so that the same figure is the same bytes; an SVG whose
 * fonts have substitutes where DejaVu is not installed, as a new text for the caller to free. */
void sheet_blank_date(char *bytes, size_t length);

/* Adds to the note which lines others cover (covered.c). */
void sheet_note_covered(sheet *sheet);

/* What a sheet shows in words; and an SVG with these words as its title and description: a new text for the caller to free, NULL
 * when out of memory (alternative_text.c). */
void sheet_describe(const sheet *sheet, sheet_facts *facts);
char *sheet_set_words(const char *bytes, size_t *length, const sheet_facts *facts);

/* An SVG with its size on paper in the place of that in pixels: a new text for the caller to free; NULL when out of memory. */
char *sheet_set_size(const char *bytes, size_t *length, const sheet_facts *facts);
char *sheet_name_fonts(const char *bytes, size_t *length);

/* Runs gnuplot on "script" in the folder (gnuplot.c). */
gough_status sheet_run_gnuplot(const char *folder, gough_error *error);

#endif
