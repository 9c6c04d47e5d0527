/* Reading a table in parts: as read_table.c, with memory for one part only. */
#define _POSIX_C_SOURCE 200809L

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "table/table.h"

static bool is_wanted(const result_scan *scan, const char *name) {
    if (scan->wanted == NULL) return true;
    for (const char *const *word = scan->wanted; *word != NULL; word++)
        if (strcmp(*word, name) == 0) return true;
    return false;
}

bool result_scan_begin(result_scan *scan, const gough_table *table) {
    gough_table *part = &scan->part;
    *part = *table;
    part->rows = part->columns = 0;
    part->name = calloc(table->columns + 1, sizeof *part->name);
    part->unit = calloc(table->columns + 1, sizeof *part->unit);
    part->value = calloc(table->columns + 1, sizeof *part->value);
    if (part->name == NULL || part->unit == NULL || part->value == NULL) return false;
    for (size_t c = 0; c < table->columns; c++) {
        if (!is_wanted(scan, table->name[c])) continue;
        part->name[part->columns] = table->name[c];
        part->unit[part->columns] = table->unit[c];
        part->value[part->columns++] = table->value[c];
    }
    result_scan_part(scan, 0);
    return true;
}

void result_scan_part(result_scan *scan, size_t rows) {
    if (scan->stopped) return;
    scan->part.rows = rows;
    scan->stopped = scan->sink(scan->context, &scan->part) != 0;
}

void result_scan_end(result_scan *scan) {
    free(scan->part.name);
    free(scan->part.unit);
    free(scan->part.value);
    scan->part = (gough_table){.rows = 0};
}

/* What cannot be read in parts is one part. */
static gough_status scan_whole(result_scan *scan, const char *path, gough_error *error) {
    gough_table *table;
    const gough_status status = gough_table_read(path, &table, error);
    if (status != GOUGH_OK) return status;
    const bool good = result_scan_begin(scan, table);
    if (good && table->rows > 0) result_scan_part(scan, table->rows);
    gough_table_free(table);
    return good ? GOUGH_OK : gough_fail(error, GOUGH_ERROR_FILE, "%s: out of memory", path);
}

static gough_status scan_file(int file, result_scan *scan, gough_error *error) {
    gough_table table = {.rows = 0};
    result_blank_numbers(&table);
    const gough_status status = result_is_hdf5(file) ? result_scan_hdf5(scan, &table, error)
                                                     : result_scan_csv(file, scan, &table, error);
    result_table_clear(&table);
    return status;
}

gough_status gough_table_scan(const char *path, const char *const *wanted, gough_table_sink sink,
                              void *context, gough_error *error) {
    result_scan scan = {.path = path, .wanted = wanted, .sink = sink, .context = context};
    struct stat about;
    gough_status status = GOUGH_OK;
    if (strcmp(path, "-") == 0 || stat(path, &about) != 0 || !S_ISREG(about.st_mode)) {
        status = scan_whole(&scan, path, error);
    } else {
        const int file = gough_open_input(path, error);
        if (file < 0) return GOUGH_ERROR_FILE;
        const char *other = result_is_hdf5(file) ? NULL : gough_input_kind(file, GOUGH_INPUT_CSV);
        status =
            other != NULL ? result_other_kind(path, other, error) : scan_file(file, &scan, error);
        close(file);
    }
    result_scan_end(&scan);
    return status;
}
