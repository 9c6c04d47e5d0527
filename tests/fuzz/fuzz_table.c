/* Any bytes as a CSV table: they end in a table as long as they say or in a message with its place. */
#define _POSIX_C_SOURCE 200809L
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "file.h"
#include "table/table.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* How many rows parts bring. */
static int count_rows(void *context, const gough_table *part) {
    *(size_t *)context += part->rows;
    return 0;
}

/* The same bytes in parts, as a file: the same end, and as many rows. */
static void scan(const uint8_t *data, size_t size, gough_status whole, size_t rows) {
    char path[100];
    gough_error error = {.message = ""};
    size_t met = 0;
    result_scan parts = {.path = "fuzz.csv", .sink = count_rows, .context = &met};
    gough_table table = {.rows = 0};
    fuzz_file(path, "one", size > 0 ? (const void *)data : "", size);
    const int file = open(path, O_RDONLY);
    if (file < 0) abort();
    const gough_status status = result_scan_csv(file, &parts, &table, &error);
    if (status != whole || (status == GOUGH_OK && met != rows)) abort();
    if (status != GOUGH_OK && strncmp(error.message, "fuzz.csv:", 9) != 0) abort();
    result_scan_end(&parts);
    result_table_clear(&table);
    close(file);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char *text = calloc(size + 1, 1);
    gough_table *table = calloc(1, sizeof *table);
    if (text == NULL || table == NULL) abort();
    memcpy(text, data, size);
    gough_error error = {.message = ""};
    const gough_status status = result_read_csv("fuzz.csv", text, size, table, &error);
    if (status == GOUGH_OK && (table->columns == 0 || table->rows > size)) abort();
    if (status != GOUGH_OK && strncmp(error.message, "fuzz.csv:", 9) != 0) abort();
    scan(data, size, status, table->rows);
    gough_table_free(table);
    free(text);
    return 0;
}
