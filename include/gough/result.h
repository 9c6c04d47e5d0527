/** @file result.h
 *  Results: tables in memory, written as HDF5 or CSV files that are complete or absent. These functions allocate and write files.
 *
 *  Accuracy: doubles keep their bits in HDF5, and in CSV, which has 17 digits; a change of units costs two roundings.
 *  Overlap: nothing that a table owns may be passed where it is written.
 *  Threads: functions may be called from several threads at once on distinct tables and files, except with HDF5, whose library
 *  may be built for one thread only.
 */
#ifndef GOUGH_RESULT_H
#define GOUGH_RESULT_H

#include <stdio.h>

#include "gough/simulate.h"
#include "gough/study.h"
#include "gough/units.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Rows in memory, in the units of the output: the study's, dimensionless on request. Opaque. */
typedef struct gough_result gough_result;

/** The unit of a column. @param column  GOUGH_T … GOUGH_RZX; GOUGH_UNIT_NONE for any other */
GOUGH_API gough_unit gough_unit_of_column(int column);

/** Units of a study's output: its own (SI if it was made without), or with @p dimensionless R_b, M and √(R_b/g), angles in
 *  degrees (for a dimensionless study with R_b = M = g = 1 these are the same).
 *  @return GOUGH_ERROR_INPUT if gravity is 0, which leaves no unit of time. */
GOUGH_API gough_status gough_units_of_study(const gough_study *study, bool dimensionless,
                                            gough_units *units, gough_error *error);

/** An empty table for a verb ("forces" or "simulate") of a study. NULL if out of memory. */
GOUGH_API gough_result *gough_result_new(const gough_study *study, const char *verb,
                                         const gough_units *units);

/** A gough_sink: @p result is a gough_result. It stores quads if the first row has them.
 *  @return nonzero if out of memory, or if the table would take more than a quarter of the machine's memory. */
GOUGH_API int gough_result_add(void *result, const gough_row *row);

/** How the run ended, its time in units of the run: attributes end_time, end_cause and end_message of HDF5. */
GOUGH_API void gough_result_set_end(gough_result *result, const gough_end *end);

/** Writes the table: .h5 (HDF5) or .csv by extension, "-" means CSV on standard output. CSV has 17 significant digits, 36 if the
 *  rows have quads; HDF5 has doubles, on a dimension scale t, and opens as netCDF-4. The same table gives the same bytes, in
 *  every locale. The file is complete or absent, as with gough_write_file().
 *  @return GOUGH_OK, GOUGH_ERROR_INPUT (unknown extension), GOUGH_ERROR_FILE. */
GOUGH_API gough_status gough_result_write(const gough_result *result, const char *path,
                                          gough_error *error);

/** One column of a table in memory, with its numbers as they are written. */
typedef struct gough_result_column {
    const char *name;      /**< as in the header row */
    const char *long_name; /**< description, as in HDF5 */
    char unit[24];         /**< "m/s", "degree", "1" … */
    const double *value;   /**< [rows]; valid until a row is added or the table freed */
    size_t rows;           /**< rows so far */
} gough_result_column;

/** The column at @p index, counted from 0. @return false beyond the last column; nothing is then written. */
GOUGH_API bool gough_result_column_at(const gough_result *result, int index,
                                      gough_result_column *column);

/** Frees a table; NULL is allowed. */
GOUGH_API void gough_result_free(gough_result *result);

/** A table read back, from HDF5 or CSV, written by this program or any other (a CSV with a header row). */
typedef struct gough_table {
    size_t rows;       /**< rows of numbers */
    size_t columns;    /**< number of columns */
    char **name;       /**< [columns] */
    char **unit;       /**< [columns]; "" if unknown */
    double **value;    /**< [columns][rows] */
    char *title;       /**< "" if unknown */
    char *verb;        /**< "" if unknown */
    char *end_cause;   /**< word of gough_cause_name(); "" if unknown */
    char *end_message; /**< the end as a sentence; NULL or "" if unknown */
    double end_time;   /**< in the table's unit of time; NaN if unknown */
    double tolerance;  /**< of the adaptive stepper; NaN if unknown or if steps were fixed */
    double step;       /**< fixed step in the table's unit of time; NaN if unknown or adaptive */
    double
        max_speed; /**< greatest leg rate that the study allows all legs; NaN if unknown or not limited */
    double max_force; /**< the same of the drive force, push and pull */
    char *
        source; /**< NULL; of a table that a figure reads in parts (gough_figure_read()): its file, which has the numbers */
} gough_table;

/** Reads a table; HDF5 is recognised by its first bytes; "-" means CSV on standard input. HDF5 is read in a child process with
 *  limits of time and memory, so that a file which crashes the HDF5 library still gives a message.
 *  @param[out] table  set on GOUGH_OK, else NULL
 *  @return GOUGH_OK, GOUGH_ERROR_INPUT (not a table; for CSV with the place: `file:line:column: …`), GOUGH_ERROR_FILE,
 *  for any bytes. */
GOUGH_API gough_status gough_table_read(const char *path, gough_table **table, gough_error *error);
/** Called with some rows of a table, in order: names, units and texts as in the file, `rows` the number of rows of this part. The
 *  part is valid during the call. A value other than 0 ends the reading. */
typedef int (*gough_table_sink)(void *context, const gough_table *part);

/** Reads a table in parts of at most 16384 rows, so that memory does not grow with the rows. The first call of @p sink has the
 *  names and no rows. A file that is not an ordinary one, such as a pipe, is read whole and then is one part.
 *  @param wanted  columns to read, NULL behind the last, in any order, which may be missing in the file; NULL: all columns. A part
 *  has its columns in the order of the file. Numbers of other columns are not read
 *  @return as gough_table_read(), also if the sink ended the reading. Parts may have been handed over before an error. */
GOUGH_API gough_status gough_table_scan(const char *path, const char *const *wanted,
                                        gough_table_sink sink, void *context, gough_error *error);

/** Frees a table; NULL is allowed. */
GOUGH_API void gough_table_free(gough_table *table);

/** A table of zeros with unnamed columns, without tolerance, step and end; the caller fills it. Free it with gough_table_free().
 *  @return NULL if out of memory. */
GOUGH_API gough_table *gough_table_new(const char *title, const char *verb, size_t columns,
                                       size_t rows);

/** Names a column and its unit ("" or "1": none).
 *  @return its numbers, to be filled, which are written with all their digits; NULL if out of memory */
GOUGH_API double *gough_table_name(gough_table *table, size_t column, const char *name,
                                   const char *unit);

/** Writes a table: .h5 or .csv by extension, "-" CSV on standard output, as gough_result_write() does. HDF5 also has the table's
 *  tolerance and step, if they are known.
 *  @param study  text of the study, kept in HDF5; NULL: none
 *  @return GOUGH_OK, GOUGH_ERROR_INPUT (unknown extension), GOUGH_ERROR_FILE. */
GOUGH_API gough_status gough_table_write(const gough_table *table, const char *study,
                                         const char *path, gough_error *error);

/** Numbers of a column by its name, with all digits of the file; NULL if absent. */
GOUGH_API const double *gough_table_column(const gough_table *table, const char *name);

/** Writes bytes to a file that is complete or absent: writes a temporary file beside it, checks write, fsync and close, then
 *  renames it. A replaced file keeps its permissions, a link stays a link. "-" means standard output, which like devices and
 *  FIFOs is written in place.
 *  @return GOUGH_OK, or GOUGH_ERROR_FILE with a sentence that names the path. */
GOUGH_API gough_status gough_write_file(const char *path, const void *bytes, size_t length,
                                        gough_error *error);

#ifdef __cplusplus
}
#endif
#endif
