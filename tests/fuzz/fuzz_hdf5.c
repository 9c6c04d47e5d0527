/* Any bytes behind the signature of HDF5 as a result file: they end in a table or in a message with the name of the file. */
#define _POSIX_C_SOURCE 200809L
#include "file.h"
#include "table/table.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static int count_part(void *context, const gough_table *part) {
    size_t *parts = context;
    for (size_t c = 0; c < part->columns; c++)
        for (size_t r = 0; r < part->rows; r++) (void)(part->value[c][r] > 0);
    (*parts)++;
    return 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static const unsigned char signature[8] = {0x89, 'H', 'D', 'F', '\r', '\n', 0x1a, '\n'};
    unsigned char *bytes = malloc(size + sizeof signature);
    char path[100];
    gough_error error = {0};
    gough_table *table = NULL;
    if (!bytes) abort();
    memcpy(bytes, data, size);
    if (size < sizeof signature) size = sizeof signature;
    memcpy(bytes, signature, sizeof signature);
    fuzz_file(path, "one", bytes, size);
    const gough_status status = gough_table_read(path, &table, &error);
    if ((status == GOUGH_OK) != (table != NULL)) abort();
    if (status != GOUGH_OK && !strstr(error.message, path)) abort();
    for (size_t c = 0; table && c < table->columns; c++) {
        if (!table->name[c] || !table->unit[c]) abort();
        for (size_t r = 0; r < table->rows; r++) (void)(table->value[c][r] > 0);
    }
    /* read in parts it ends as it does whole */
    size_t parts = 0;
    const gough_status scanned = gough_table_scan(path, NULL, count_part, &parts, &error);
    if (scanned != GOUGH_OK && !strstr(error.message, path)) abort();
    if (scanned != status || (table != NULL && parts == 0)) abort();
    gough_table_free(table);
    free(bytes);
    return 0;
}
