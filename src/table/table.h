/* What the files of this room share: the table being filled, and the output that is complete or absent. */
#ifndef GOUGH_TABLE_TABLE_H
#define GOUGH_TABLE_TABLE_H

#include "gough/result.h"

/* Filled columns only, each an array that grows by doubling. `quad` is used where the first row came in 33 digits. */
struct gough_result {
    char *title, *text;
    const char *verb;
    gough_units units;
    gough_quad time; /* unit of the output in 33 digits */
    int columns;
    int column[GOUGH_COLUMNS];    /* enum gough_column of each filled column */
    double factor[GOUGH_COLUMNS]; /* from units of the run to those of the output */
    gough_quad quad_factor[GOUGH_COLUMNS];
    size_t rows, capacity, row_limit;
    bool in_quad;
    double *value[GOUGH_COLUMNS];
    gough_quad *quad[GOUGH_COLUMNS];
    gough_end end;
    double tolerance, step, max_speed, max_force; /* as in gough_table */
};

/* Units of the output in 33 digits, and factors to them from units of the run.
 * base_radius, gravity: of the machine, for a unit of time √(R_b/g) beyond the double that `units` holds. */
typedef struct result_scale {
    gough_units units;
    gough_quad base[GOUGH_BASE_UNITS]; /* one of each in units of the run */
    gough_quad turn;                   /* what radians are multiplied by */
} result_scale;
result_scale result_scale_of(const gough_units *units, double base_radius, double gravity);
gough_quad result_factor(const result_scale *scale, gough_unit unit);

/* ---- output, complete or absent (output.c) ------------------------------------------------------------------- */

typedef struct result_output {
    const char *path; /* as the user gave it, for messages */
    char *final;      /* what will be renamed over; NULL: written in place (stdout, device, FIFO) */
    char *beside;     /* the file being written in the same folder; NULL: it has no name yet */
    int file;
    bool standard;
    size_t held;
    char buffer[1 << 16];
} result_output;

gough_status result_output_open(result_output *output, const char *path, gough_error *error);
gough_status result_output_add(result_output *output, const void *bytes, size_t length,
                               gough_error *error);
/* Flushes, syncs, closes and renames, each checked. The output is closed in every case. */
gough_status result_output_finish(result_output *output, gough_error *error);
/* Closes and removes what was written so far. */
void result_output_abandon(result_output *output);

/* ---- formats -------------------------------------------------------------------------------------------------- */

gough_status result_write_csv(const gough_result *result, const char *path, gough_error *error);
gough_status result_write_hdf5(const gough_result *result, const char *path, gough_error *error);

/* A file of columns of any kind. */
typedef struct result_column {
    const char *name, *unit, *long_name;
    bool whole;        /* whole numbers, stored as such */
    const char *flags; /* NULL, or words for the numbers from 0, separated by spaces */
    int flag_count;
} result_column;
typedef struct result_attribute {
    const char *name, *text; /* text NULL: a number */
    double number;
} result_attribute;
typedef struct result_file {
    const result_column *column; /* the first is the dimension of the others */
    int columns;
    size_t rows;
    const result_attribute *attribute;
    int attributes;
    /* Numbers of a column in rows first … first + count − 1; NULL: they cannot be read. Asked for in stretches of rows, all columns
     * of a stretch before the next; valid until the next stretch. */
    const double *(*values)(void *context, int column, size_t first, size_t count);
    void *context;
} result_file;
/* Puts the attributes "tolerance", "step", "max_speed" and "max_force" of a run, each if it is not NaN, into an array with room for
 * all. @return how many there are */
enum { RESULT_SETTINGS = 4 };
int result_put_settings(const double setting[RESULT_SETTINGS], result_attribute *attribute);
gough_status result_write_hdf5_file(const result_file *file, const char *path, gough_error *error);

/* Readers fill a table whose fields are all zero; the caller frees it, also after an error. */
gough_status result_read_csv(const char *path, const char *text, size_t length, gough_table *table,
                             gough_error *error);
gough_status result_read_hdf5(const char *path, gough_table *table, gough_error *error);

/* Makes room for the columns and rows of a table; false when out of memory. */
bool result_table_shape(gough_table *table, size_t columns, size_t rows);
/* Texts that the format did not bring become empty; false when out of memory. */
bool result_complete_texts(gough_table *table);
/* Numbers that are not known become NaN. */
void result_blank_numbers(gough_table *table);

/* ---- parts of a table (scan_table.c) ------------------------------------------------------------------------------- */

enum { RESULT_PART = 16384 }; /* rows of a part at most */

/* Reading a table in parts: `wanted` and `sink` as gough_table_scan() has them. */
typedef struct result_scan {
    const char *path;
    const char *const *wanted;
    gough_table_sink sink;
    void *context;
    bool stopped;     /* the sink wants no more */
    gough_table part; /* its columns are the wanted ones of the table that is read */
} result_scan;
/* Makes `part` of a table whose columns have room for a part each, and hands over the names. False when out of memory. */
bool result_scan_begin(result_scan *scan, const gough_table *table);
void result_scan_part(result_scan *scan, size_t rows);
void result_scan_end(result_scan *scan);

/* Readers in parts, for ordinary files. The caller clears `table`, also after an error. */
gough_status result_scan_csv(int file, result_scan *scan, gough_table *table, gough_error *error);
gough_status result_scan_hdf5(result_scan *scan, gough_table *table, gough_error *error);

/* ---- what readers share (read_table.c) ------------------------------------------------------------------------------ */

/* Whether a file begins like HDF5; it must be an ordinary one. */
bool result_is_hdf5(int file);
/* A file that is something else than a table. */
gough_status result_other_kind(const char *path, const char *kind, gough_error *error);
/* Frees all that a table has. */
void result_table_clear(gough_table *table);

#endif
