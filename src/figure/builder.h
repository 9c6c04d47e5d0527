/* Putting lines of tables into the panels of a sheet. */
#ifndef GOUGH_FIGURE_BUILDER_H
#define GOUGH_FIGURE_BUILDER_H

#include "figure/sheet.h"

/* What a kind of figure works with. A call that fails leaves its sentence in `error` and its status in `status`; later calls
 * then do nothing. */
typedef struct builder {
    sheet *sheet;
    const gough_figure *figure;
    const gough_table *const *tables;
    const char *const *labels; /* may be NULL */
    size_t table_count;
    const gough_table *const
        *measured; /* tables that tell the size of the machine and the errors of
                                           the runs: `tables`, or those whose differences these are */
    size_t measured_count;
    gough_error *error;
    gough_status status;
    char label[SHEET_TEXT]; /* of builder_label() */
    struct sweep_file *
        files; /* of the tables that are read in parts, as the first pass found them; sweep_rows.h */
} builder;

/* Several tables are compared: a colour then means a table. */
bool builder_compares(const builder *b);
/* What a table is called: its label, its title, with its number where that is another's too. Valid until the next call. */
const char *builder_label(builder *b, size_t table);

/* The column, or NULL with a sentence that names it. */
const double *builder_column(builder *b, size_t table, const char *name);
/* Unit of a column in the tables that have it; "" where they differ. */
const char *builder_unit(const builder *b, const char *name);

/* Titles the abscissa with words for a column, and its unit. */
void builder_abscissa(builder *b, const char *words, const char *column);

/* Whether tables are compared whose columns are in different units. */
bool builder_mixes_units(const builder *b);

panel *builder_panel(builder *b, const char *heading, const char *unit, bool logarithmic);
/* A panel in the unit of a column, with the noise of its numbers. */
panel *builder_panel_of(builder *b, const char *heading, const char *column, bool logarithmic);

/* Below what size a number of a column is an error of the run; 0 where that is not known (noise.c). */
double builder_noise(const builder *b, const char *column);

/* Adds a line over the column `abscissa` within the figure's range. */
series *builder_line(builder *b, panel *p, size_t table, const char *abscissa, const double *y,
                     const char *label, int colour);

/* An array of the sheet with one number for each row of a table. */
double *builder_array(builder *b, size_t table);

/* Title and note of the sheet (titles.c). */
void builder_title(builder *b);

/* The unit of a column in words; of a table without dimensions "M g", "√(R_b/g)" (dimensionless.c). */
const char *builder_unit_words(const builder *b, const char *column);

/* Least and greatest finite number of a column, NaN without one. */
void builder_extremes(const gough_table *table, const double *value, double *least,
                      double *greatest);

/* Leg lines l1 … l6, dl1 …, f1 … or p1 … in one panel, with limits, or in a panel for each leg (leg_lines.c). */
void builder_add_legs(builder *b, const char *heading, const char *prefix);

/* Group of each leg of a table for figures: its own number, or that of the first leg with the same numbers within the noise; and
 * how the key names a group (leg_lines.c). */
void builder_group_legs(const gough_table *table, const double *const column[GOUGH_LEGS],
                        double noise, int group[GOUGH_LEGS]);
void builder_name_group(const int group[GOUGH_LEGS], int number, char *label, size_t size);

/* Drive force over leg rate (duty_figure.c). */
void builder_fill_duty(builder *b);

/* A table of a sweep (sweep.c). */
void builder_fill_sweep(builder *b);

/* A table of gough tune (tuning.c). */
void builder_fill_tuning(builder *b);

gough_status builder_fail(builder *b, gough_status status, const char *sentence);

#endif
