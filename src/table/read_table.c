/* Reading a table: HDF5 is told from CSV by its first bytes, whatever the file is called. */
#define _POSIX_C_SOURCE 200809L

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "table/table.h"

/* Most text held in memory: a pipe at standard input may never end. */
static const size_t FILE_CAP = (size_t)4 << 30, STREAM_CAP = (size_t)256 << 20;

static const char hdf5_signature[8] = {'\x89', 'H', 'D', 'F', '\r', '\n', '\x1a', '\n'};

void result_table_clear(gough_table *table) {
    for (size_t c = 0; c < table->columns; c++) {
        free(table->name[c]);
        free(table->unit[c]);
        if (table->value != NULL) free(table->value[c]);
    }
    free(table->name);
    free(table->unit);
    free(table->value);
    free(table->title);
    free(table->verb);
    free(table->end_cause);
    free(table->end_message);
    free(table->source);
}

void gough_table_free(gough_table *table) {
    if (table == NULL) return;
    result_table_clear(table);
    free(table);
}

const double *gough_table_column(const gough_table *table, const char *name) {
    for (size_t c = 0; c < table->columns && table->value != NULL; c++) {
        if (strcmp(table->name[c], name) == 0) return table->value[c];
    }
    return NULL;
}

bool result_table_shape(gough_table *table, size_t columns, size_t rows) {
    table->name = calloc(columns, sizeof *table->name);
    table->unit = calloc(columns, sizeof *table->unit);
    table->value = calloc(columns, sizeof *table->value);
    if (table->name == NULL || table->unit == NULL || table->value == NULL) return false;
    table->columns = columns;
    table->rows = rows;
    for (size_t c = 0; c < columns; c++) {
        table->value[c] = calloc(rows > 0 ? rows : 1, sizeof(double));
        if (table->value[c] == NULL) return false;
    }
    return true;
}

/* Everything from `file`, of about `size` bytes, as a terminated text of `length` bytes; NULL with errno set: EFBIG beyond the
 * cap. */
static char *read_text(int file, size_t size, size_t cap, size_t *length) {
    errno = EFBIG;
    if (size > cap) return NULL;
    size_t capacity = size + 4096, used = 0;
    char *text = malloc(capacity);
    while (text != NULL) {
        const ssize_t got = read(file, text + used, capacity - used - 1);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) break;
        used += (size_t)got;
        if (got == 0) {
            text[used] = '\0';
            *length = used;
            return text;
        }
        if (used > cap) {
            errno = EFBIG;
            break;
        }
        if (capacity - used - 1 > 0) continue;
        char *more = realloc(text, 2 * capacity);
        if (more == NULL) break;
        text = more;
        capacity *= 2;
    }
    free(text);
    return NULL;
}

static gough_status read_csv_file(int file, const struct stat *about, const char *path,
                                  gough_table *table, gough_error *error) {
    const bool ordinary = S_ISREG(about->st_mode);
    const size_t cap = ordinary ? FILE_CAP : STREAM_CAP;
    size_t length = 0;
    char *text = read_text(file, ordinary ? (size_t)about->st_size : 0, cap, &length);
    if (text == NULL && errno == EFBIG)
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "%s: is larger than %zu MiB, the most that can be read", path, cap >> 20);
    if (text == NULL)
        return gough_fail(error, GOUGH_ERROR_FILE, "%s: cannot read: %s", path, strerror(errno));
    if (length >= sizeof hdf5_signature &&
        memcmp(text, hdf5_signature, sizeof hdf5_signature) == 0) {
        free(text);
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "%s: is HDF5 through a pipe, which cannot be read; give the file itself "
                          "or a table as CSV",
                          path);
    }
    const gough_status status = result_read_csv(path, text, length, table, error);
    free(text);
    return status;
}

bool result_is_hdf5(int file) {
    char start[sizeof hdf5_signature];
    return pread(file, start, sizeof start, 0) == sizeof start &&
           memcmp(start, hdf5_signature, sizeof start) == 0;
}

gough_status result_other_kind(const char *path, const char *kind, gough_error *error) {
    return gough_fail(error, GOUGH_ERROR_INPUT,
                      "%s: is %s; a table of results is needed, as -o of `gough simulate` and "
                      "other verbs writes",
                      path, kind);
}

static gough_status read_file(int file, const char *path, gough_table *table, gough_error *error) {
    struct stat about;
    if (fstat(file, &about) != 0)
        return gough_fail(error, GOUGH_ERROR_FILE, "%s: cannot read: %s", path, strerror(errno));
    if (S_ISDIR(about.st_mode))
        return gough_fail(error, GOUGH_ERROR_FILE, "%s: is a folder, not a result", path);

    if (S_ISREG(about.st_mode) && result_is_hdf5(file))
        return result_read_hdf5(file == STDIN_FILENO ? "/dev/stdin" : path, table, error);
    const char *other = gough_input_kind(file, GOUGH_INPUT_CSV);
    if (other) return result_other_kind(path, other, error);
    return read_csv_file(file, &about, path, table, error);
}

void result_blank_numbers(gough_table *table) {
    table->end_time = table->tolerance = table->step = NAN;
    table->max_speed = table->max_force = NAN;
}

bool result_complete_texts(gough_table *table) {
    bool good = true;
    char **texts[] = {&table->title, &table->verb, &table->end_cause, &table->end_message};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        if (*texts[i] == NULL) *texts[i] = calloc(1, 1);
        good = good && *texts[i] != NULL;
    }
    for (size_t c = 0; c < table->columns; c++) {
        if (table->unit[c] == NULL) table->unit[c] = calloc(1, 1);
        good = good && table->unit[c] != NULL;
    }
    return good;
}

gough_status gough_table_read(const char *path, gough_table **table, gough_error *error) {
    *table = NULL;
    const bool standard = strcmp(path, "-") == 0;
    const int file = gough_open_input(path, error);
    if (file < 0) return GOUGH_ERROR_FILE;

    gough_status status = GOUGH_ERROR_FILE;
    gough_table *read = calloc(1, sizeof *read);
    if (read == NULL) {
        status = gough_fail(error, GOUGH_ERROR_FILE, "%s: out of memory", path);
    } else {
        result_blank_numbers(read);
        status = read_file(file, standard ? "standard input" : path, read, error);
        if (status == GOUGH_OK && !result_complete_texts(read))
            status = gough_fail(error, GOUGH_ERROR_FILE, "%s: out of memory", path);
    }
    if (!standard) close(file);
    if (status == GOUGH_OK)
        *table = read;
    else
        gough_table_free(read);
    return status;
}
