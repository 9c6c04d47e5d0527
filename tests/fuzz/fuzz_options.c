/* Any bytes as the value of an option (a pose, an axis, a span, a number, columns of a figure) are read, or end in a sentence. */
#define _POSIX_C_SOURCE 200809L
#include <math.h>

#include "cli/common/option_values.h"
#include "figure/sheet.h"
#include "file.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void require(bool condition) {
    if (!condition) abort();
}

/* What is read is finite, and what is not read says so in text that is safe to show. */
static void check(bool good, const gough_error *error) {
    char shown[4 * sizeof error->message];
    require(good == (error->message[0] == '\0'));
    gough_text_show(error->message, strlen(error->message), shown, sizeof shown);
    for (const char *at = shown; *at; at++) require((unsigned char)*at >= ' ' && *at != 0x7f);
}

static void try_ranges(const char *text) {
    static const char *const axes[] = {"sweep-stiffness", "sweep-frequency"};
    double pose[GOUGH_COMPONENTS] = {0}, from = 0, to = 0, number = 0;
    gough_error error = {0};
    check(read_pose("pose", text, pose, &error), &error);
    for (int c = 0; c < GOUGH_COMPONENTS; c++) require(isfinite(pose[c]));
    for (int i = 0; i < 2; i++) {
        axis_values axis = {0};
        error.message[0] = '\0';
        const bool good = read_axis(axes[i], text, &axis, &error);
        check(good, &error);
        require(!good || (axis.from >= 0 && axis.to > axis.from && isfinite(axis.to) &&
                          axis.count >= 2 && axis.count <= 10000));
    }
    error.message[0] = '\0';
    const bool span = read_span(text, &from, &to, &error);
    check(span, &error);
    require(!span || (from >= 0 && from <= to && isfinite(to)));
    if (read_decimal(text, text + strlen(text), &number)) require(isfinite(number));
}

static void try_columns(const char *text) {
    static const char csv[] = "t,x,y,f1,f2,ex\n0,1,2,3,4,5\n1,2,3,4,5,6\n2,1,0,nan,inf,1e-300\n";
    static gough_table *table;
    sheet *drawn = calloc(1, sizeof *drawn);
    gough_error error = {0};
    char path[100];
    require(drawn != NULL);
    if (!table)
        require(gough_table_read(fuzz_file(path, "one", csv, sizeof csv - 1), &table, &error) ==
                GOUGH_OK);
    gough_figure figure = gough_figure_default();
    const gough_table *const tables[] = {table};
    figure.columns = figure.title = text;
    const gough_status status = sheet_fill(drawn, &figure, tables, NULL, 1, NULL, &error);
    require(status == GOUGH_OK || (status == GOUGH_ERROR_INPUT && error.message[0]));
    sheet_free_arrays(drawn);
    free(drawn);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char *text = calloc(size + 1, 1);
    require(text != NULL);
    memcpy(text, data, size);
    try_ranges(text);
    try_columns(text);
    free(text);
    return 0;
}
