/* CSV: one header row, comma, LF, 17 significant digits (36 where the run was in quadruple precision), the same bytes in
 * every locale. */
#define _POSIX_C_SOURCE 200809L

#include <locale.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "table/table.h"

enum { NUMBER_SIZE = 64 };

#if defined(__SIZEOF_FLOAT128__)
/* libquadmath's header is GCC's own; declared here so that Clang finds it too */
extern int quadmath_snprintf(char *text, size_t size, const char *format, ...);
static int print_quad(char text[NUMBER_SIZE], gough_quad value) {
    return quadmath_snprintf(text, NUMBER_SIZE, "%.36Qg", value);
}
#else
static int print_quad(char text[NUMBER_SIZE], gough_quad value) {
    return snprintf(text, NUMBER_SIZE, "%.36Lg", value);
}
#endif

/* A number and the separator after it; the sign of a NaN says nothing and is left out. */
static size_t print_number(const gough_result *result, int i, size_t row, char separator,
                           char text[NUMBER_SIZE]) {
    const double value = result->value[i][row];
    int length;
    if (isnan(value))
        length = snprintf(text, NUMBER_SIZE, "nan");
    else if (result->in_quad)
        length = print_quad(text, result->quad[i][row]);
    else
        length = snprintf(text, NUMBER_SIZE, "%.17g", value);
    text[length] = separator;
    return (size_t)length + 1;
}

static gough_status write_table(const gough_result *result, result_output *output,
                                gough_error *error) {
    char text[NUMBER_SIZE];
    gough_status status = GOUGH_OK;
    for (int i = 0; i < result->columns && status == GOUGH_OK; i++) {
        const char *name = gough_column(result->column[i])->name;
        const int length =
            snprintf(text, sizeof text, "%s%c", name, i + 1 < result->columns ? ',' : '\n');
        status = result_output_add(output, text, (size_t)length, error);
    }
    for (size_t r = 0; r < result->rows; r++) {
        for (int i = 0; i < result->columns && status == GOUGH_OK; i++) {
            const size_t length =
                print_number(result, i, r, i + 1 < result->columns ? ',' : '\n', text);
            status = result_output_add(output, text, length, error);
        }
    }
    return status;
}

gough_status result_write_csv(const gough_result *result, const char *path, gough_error *error) {
    result_output *output = malloc(sizeof *output);
    const locale_t plain = newlocale(LC_NUMERIC_MASK, "C", (locale_t)0);
    if (output == NULL || plain == (locale_t)0) {
        free(output);
        if (plain != (locale_t)0) freelocale(plain);
        return gough_fail(error, GOUGH_ERROR_FILE, "%s: out of memory", path);
    }
    const locale_t before = uselocale(plain);
    gough_status status = result_output_open(output, path, error);
    if (status == GOUGH_OK) {
        status = write_table(result, output, error);
        if (status == GOUGH_OK)
            status = result_output_finish(output, error);
        else
            result_output_abandon(output);
    }
    uselocale(before);
    freelocale(plain);
    free(output);
    return status;
}
