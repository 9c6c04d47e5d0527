/* Any bytes as a CSV table: they end in a table as long as they say or in a message with its place. */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "table/table.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char *text = calloc(size + 1, 1);
    gough_table *table = calloc(1, sizeof *table);
    if (text == NULL || table == NULL) abort();
    memcpy(text, data, size);
    gough_error error = {.message = ""};
    const gough_status status = result_read_csv("fuzz.csv", text, size, table, &error);
    if (status == GOUGH_OK && (table->columns == 0 || table->rows > size)) abort();
    if (status != GOUGH_OK && strncmp(error.message, "fuzz.csv:", 9) != 0) abort();
    gough_table_free(table);
    free(text);
    return 0;
}
