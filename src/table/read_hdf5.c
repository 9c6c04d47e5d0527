/* HDF5 in: the one-dimensional datasets of numbers in the root, in the order of their creation where the file keeps it.
 * Damaged bytes can make the HDF5 library crash or loop. A child process therefore reads the file, within limits of time
 * and memory, and hands the table over through a pipe (format: transfer.c); if it dies, the file is called damaged. */
#define _POSIX_C_SOURCE 200809L

#include <errno.h>
#include <hdf5.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "table/child_reader.h"
#include "table/table.h"

enum { COLUMN_CAP = 4096, TEXT_CAP = 1 << 16 };

/* Compressed columns may take this many times the file's size, and this much besides. */
static const size_t EXPANSION = 64, EXPANSION_BASE = (size_t)64 << 20;

typedef struct reader {
    const char *path;
    gough_table *table;
    hid_t file;
    bool in_parts;   /* columns get room for a part, and no numbers yet */
    size_t room;     /* rows that all columns together may still take */
    size_t capacity; /* of the arrays of the table */
    gough_error *error;
    gough_status status;
} reader;

static char *empty_text(void) { return calloc(1, 1); }

/* The text of a string attribute of one element as `type`, a type of text in memory without its length; "" if the library cannot
 * read it, NULL if out of memory. */
static char *read_string(hid_t attribute, hid_t type, size_t length) {
    char *several = NULL, *text;
    if (length == H5T_VARIABLE) {
        if (H5Tset_size(type, H5T_VARIABLE) < 0 || H5Aread(attribute, type, &several) < 0 ||
            !several)
            return empty_text();
        text = strndup(several, TEXT_CAP);
        H5free_memory(several);
        return text;
    }
    if (length > TEXT_CAP || H5Tset_size(type, length + 1) < 0) return empty_text();
    text = calloc(length + 2, 1);
    if (text != NULL && H5Aread(attribute, type, text) < 0) text[0] = '\0';
    return text;
}

/* The text of an attribute, "" if the file does not have it as one string; NULL if out of memory. */
static char *read_text(hid_t object, const char *name) {
    if (H5Aexists(object, name) <= 0) return empty_text();
    const hid_t attribute = H5Aopen(object, name, H5P_DEFAULT);
    const hid_t type = H5Aget_type(attribute), space = H5Aget_space(attribute);
    const hid_t plain = H5Tcopy(H5T_C_S1);
    char *text;
    if (H5Tget_class(type) == H5T_STRING && H5Sget_simple_extent_npoints(space) == 1) {
        H5Tset_cset(plain, H5Tget_cset(type));
        text = read_string(attribute, plain,
                           H5Tis_variable_str(type) > 0 ? H5T_VARIABLE : H5Tget_size(type));
    } else {
        text = empty_text();
    }
    H5Tclose(plain);
    H5Sclose(space);
    H5Tclose(type);
    H5Aclose(attribute);
    return text;
}

static double read_number(hid_t object, const char *name) {
    double value = NAN;
    if (H5Aexists(object, name) <= 0) return value;
    const hid_t attribute = H5Aopen(object, name, H5P_DEFAULT);
    const hid_t space = H5Aget_space(attribute);
    if (H5Sget_simple_extent_npoints(space) != 1 ||
        H5Aread(attribute, H5T_NATIVE_DOUBLE, &value) < 0)
        value = NAN;
    H5Sclose(space);
    H5Aclose(attribute);
    return value;
}

enum { NO_COLUMN = -1, UNREADABLE = -2 };

/* Rows of a dataset that is a column: one-dimensional, of numbers, kept in this very file; else one of the above. */
static long long column_rows(hid_t dataset) {
    const hid_t type = H5Dget_type(dataset), space = H5Dget_space(dataset);
    const hid_t creation = H5Dget_create_plist(dataset);
    const bool known = type >= 0 && space >= 0 && creation >= 0;
    const H5T_class_t kind = H5Tget_class(type);
    const bool flat = H5Sget_simple_extent_ndims(space) == 1;
    hsize_t rows = 0;
    if (flat) H5Sget_simple_extent_dims(space, &rows, NULL);
    const bool good = flat && (kind == H5T_FLOAT || kind == H5T_INTEGER) &&
                      H5Pget_layout(creation) != H5D_VIRTUAL &&
                      H5Pget_external_count(creation) == 0;
    H5Pclose(creation);
    H5Sclose(space);
    H5Tclose(type);
    if (!known) return UNREADABLE;
    return good && rows < (hsize_t)1 << 40 ? (long long)rows : NO_COLUMN;
}

static bool grow(reader *r) {
    gough_table *table = r->table;
    if (table->columns < r->capacity) return true;
    const size_t capacity = r->capacity == 0 ? 64 : 2 * r->capacity;
    char **name = realloc(table->name, capacity * sizeof *name);
    if (name == NULL) return false;
    table->name = name;
    char **unit = realloc(table->unit, capacity * sizeof *unit);
    if (unit == NULL) return false;
    table->unit = unit;
    double **value = realloc(table->value, capacity * sizeof *value);
    if (value == NULL) return false;
    table->value = value;
    r->capacity = capacity;
    return true;
}

static gough_status fail_column(const reader *r, const char *name) {
    return gough_fail(r->error, GOUGH_ERROR_INPUT,
                      "%s: column %.60s cannot be read; the file is damaged", r->path, name);
}

static gough_status read_column(reader *r, hid_t dataset, const char *name) {
    gough_table *table = r->table;
    const long long found = column_rows(dataset);
    if (found == UNREADABLE) return fail_column(r, name);
    if (found < 0) return GOUGH_OK;
    const size_t rows = (size_t)found;
    if (table->columns == COLUMN_CAP)
        return gough_fail(r->error, GOUGH_ERROR_INPUT, "%s: more than %d columns", r->path,
                          (int)COLUMN_CAP);
    if (table->columns > 0 && rows != table->rows)
        return gough_fail(r->error, GOUGH_ERROR_INPUT,
                          "%s: column %.60s has %zu rows, but %.60s has %zu; all columns of a "
                          "table must have the same length",
                          r->path, name, rows, table->name[0], table->rows);
    if (rows > r->room)
        return gough_fail(
            r->error, GOUGH_ERROR_INPUT,
            "%s: column %.60s claims to have %zu rows, more than a file of this size can hold",
            r->path, name, rows);
    r->room -= rows;

    const size_t held = r->in_parts ? RESULT_PART : rows > 0 ? rows : 1;
    double *value = calloc(held, sizeof *value);
    char *own_name = strdup(name), *unit = read_text(dataset, "units");
    if (value == NULL || own_name == NULL || unit == NULL || !grow(r)) {
        free(value);
        free(own_name);
        free(unit);
        return gough_fail(r->error, GOUGH_ERROR_FILE, "%s: out of memory", r->path);
    }
    table->rows = rows;
    table->name[table->columns] = own_name;
    table->unit[table->columns] = unit;
    table->value[table->columns++] = value;
    if (rows > 0 && !r->in_parts &&
        H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, value) < 0)
        return fail_column(r, name);
    return GOUGH_OK;
}

/* An H5L_iterate_t: links to other files and to groups are passed over. */
static herr_t visit(hid_t group, const char *name, const H5L_info_t *link, void *context) {
    reader *r = context;
    if (link->type != H5L_TYPE_HARD) return 0;
    const hid_t object = H5Oopen(group, name, H5P_DEFAULT);
    if (object < 0) {
        r->status = gough_fail(r->error, GOUGH_ERROR_INPUT,
                               "%s: '%.60s' cannot be opened; the file is damaged", r->path, name);
        return -1;
    }
    if (H5Iget_type(object) == H5I_DATASET) r->status = read_column(r, object, name);
    H5Oclose(object);
    return r->status == GOUGH_OK ? 0 : -1;
}

static gough_status read_root(reader *r) {
    gough_table *table = r->table;
    table->title = read_text(r->file, "title");
    table->verb = read_text(r->file, "verb");
    table->end_cause = read_text(r->file, "end_cause");
    table->end_message = read_text(r->file, "end_message");
    table->end_time = read_number(r->file, "end_time");
    table->tolerance = read_number(r->file, "tolerance");
    table->step = read_number(r->file, "step");
    table->max_speed = read_number(r->file, "max_speed");
    table->max_force = read_number(r->file, "max_force");
    if (table->title == NULL || table->verb == NULL || table->end_cause == NULL ||
        table->end_message == NULL)
        return gough_fail(r->error, GOUGH_ERROR_FILE, "%s: out of memory", r->path);

    hsize_t from = 0;
    r->status = GOUGH_OK;
    herr_t done = H5Literate(r->file, H5_INDEX_CRT_ORDER, H5_ITER_INC, &from, visit, r);
    if (done < 0 && r->status == GOUGH_OK && table->columns == 0) {
        from = 0;
        done = H5Literate(r->file, H5_INDEX_NAME, H5_ITER_INC, &from, visit, r);
    }
    if (r->status != GOUGH_OK) return r->status;
    if (done < 0)
        return gough_fail(r->error, GOUGH_ERROR_INPUT,
                          "%s: its contents cannot be listed; the file is damaged", r->path);
    if (table->columns == 0)
        return gough_fail(r->error, GOUGH_ERROR_INPUT,
                          "%s: has no one-dimensional dataset of numbers in its root group",
                          r->path);
    return GOUGH_OK;
}

/* Opens the file of a reader and reads its root. The caller closes the file if it is at least 0. */
static gough_status open_root(reader *r) {
    struct stat about;
    r->file = -1;
    if (stat(r->path, &about) != 0)
        return gough_fail(r->error, GOUGH_ERROR_FILE, "%s: cannot read: %s", r->path,
                          strerror(errno));
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    H5PLset_loading_state(0); /* no filter code from elsewhere */
    r->room = ((size_t)about.st_size * EXPANSION + EXPANSION_BASE) / sizeof(double);
    r->file = H5Fopen(r->path, H5F_ACC_RDONLY, H5P_DEFAULT);
    if (r->file < 0)
        return gough_fail(r->error, GOUGH_ERROR_INPUT,
                          "%s: begins like an HDF5 file but cannot be opened as one; it is damaged "
                          "or incomplete",
                          r->path);
    return read_root(r);
}

/* Runs in the child. */
static gough_status read_whole(const char *path, gough_table *table, gough_error *error) {
    reader r = {.path = path, .table = table, .error = error};
    const gough_status status = open_root(&r);
    if (r.file >= 0) H5Fclose(r.file);
    return status;
}

/* ---- in parts ------------------------------------------------------------------------------------------------------ */

/* Rows first … first + count − 1 of a column; false if they cannot be read. */
static bool read_part(hid_t dataset, size_t first, size_t count, double *value) {
    const hsize_t from = first, length = count;
    const hid_t space = H5Dget_space(dataset), memory = H5Screate_simple(1, &length, NULL);
    const bool good = space >= 0 && memory >= 0 &&
                      H5Sselect_hyperslab(space, H5S_SELECT_SET, &from, NULL, &length, NULL) >= 0 &&
                      H5Dread(dataset, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, value) >= 0;
    H5Sclose(memory);
    H5Sclose(space);
    return good;
}

static gough_status read_parts(const reader *r, result_scan *scan, const hid_t *dataset) {
    const gough_table *part = &scan->part;
    for (size_t first = 0; first < r->table->rows && !scan->stopped; first += RESULT_PART) {
        const size_t left = r->table->rows - first, rows = left < RESULT_PART ? left : RESULT_PART;
        for (size_t c = 0; c < part->columns; c++)
            if (!read_part(dataset[c], first, rows, part->value[c]))
                return fail_column(r, part->name[c]);
        result_scan_part(scan, rows);
    }
    return GOUGH_OK;
}

/* Runs in the child, whose sink is the pipe. */
static gough_status scan_whole(result_scan *scan, gough_table *table, gough_error *error) {
    reader r = {.path = scan->path, .table = table, .in_parts = true, .error = error};
    gough_status status = open_root(&r);
    hid_t *dataset = calloc(table->columns + 1, sizeof *dataset);
    if (status == GOUGH_OK &&
        (dataset == NULL || !result_scan_begin(scan, table))) /* HDF5 brings all texts */
        status = gough_fail(error, GOUGH_ERROR_FILE, "%s: out of memory", r.path);
    size_t open = 0;
    for (; status == GOUGH_OK && open < scan->part.columns; open++)
        dataset[open] = H5Dopen2(r.file, scan->part.name[open], H5P_DEFAULT);
    if (status == GOUGH_OK) status = read_parts(&r, scan, dataset);
    while (open > 0) H5Dclose(dataset[--open]);
    free(dataset);
    if (r.file >= 0) H5Fclose(r.file);
    return status;
}

gough_status result_scan_hdf5(result_scan *scan, gough_table *table, gough_error *error) {
    return result_scan_in_child(scan_whole, scan, table, error);
}

gough_status result_read_hdf5(const char *path, gough_table *table, gough_error *error) {
    return result_read_in_child(read_whole, path, table, error);
}
