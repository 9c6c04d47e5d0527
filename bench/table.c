/* Rows of figures as aligned text and as JSON. */
#include "bench/table.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static table_row *next_row(table *t) {
    if (t->rows == TABLE_ROWS) {
        fprintf(stderr, "bench: no room for more than %d rows\n", TABLE_ROWS);
        exit(70);
    }
    table_row *row = &t->row[t->rows++];
    memset(row, 0, sizeof *row);
    return row;
}

void table_section(table *t, const char *name, int count, const table_column *column) {
    table_row *row = next_row(t);

    row->heading = true;
    row->cells = count;
    snprintf(row->name, sizeof row->name, "%s", name);
    for (int c = 0; c < count; c++) {
        row->column[c] = column[c].name;
        row->form[c] = column[c].form;
    }
}

void table_begin_row(table *t, const char *format, ...) {
    table_row *row = next_row(t);
    va_list arguments;

    va_start(arguments, format);
    vsnprintf(row->name, sizeof row->name, format, arguments);
    va_end(arguments);
}

void table_value(table *t, double value) {
    table_row *row = &t->row[t->rows - 1];

    if (row->cells < TABLE_COLUMNS) row->cell[row->cells++].value = value;
}

void table_word(table *t, const char *format, ...) {
    table_row *row = &t->row[t->rows - 1];
    va_list arguments;

    if (row->cells == TABLE_COLUMNS) return;
    row->cell[row->cells].value = NAN;
    va_start(arguments, format);
    vsnprintf(row->cell[row->cells++].text, TABLE_TEXT, format, arguments);
    va_end(arguments);
}

/* three digits, no exponent where people would not expect one */
static void write_cell(char text[TABLE_TEXT], const table_cell *cell, table_form form) {
    const double x = cell->value, size = fabs(x);

    if (cell->text[0]) {
        snprintf(text, TABLE_TEXT, "%s", cell->text);
    } else if (!isfinite(x)) {
        snprintf(text, TABLE_TEXT, "-");
    } else if (form == AS_ERROR) {
        snprintf(text, TABLE_TEXT, "%.1e", x);
    } else if (form == AS_PERCENT) {
        snprintf(text, TABLE_TEXT, "%.1f %%", 100 * x);
    } else if (size >= 99.95 || fabs(x - round(x)) < 1e-12) {
        snprintf(text, TABLE_TEXT, "%.0f", x);
    } else {
        snprintf(text, TABLE_TEXT, "%.*f", size >= 9.995 ? 1 : size >= 0.9995 ? 2 : 3, x);
    }
}

static int longer(int width, const char *text) {
    int length = 0;

    for (; *text; text++) length += (*text & 0xc0) != 0x80; /* characters of UTF-8 */
    return length > width ? length : width;
}

static void print_padded(const char *text, int width, bool left) {
    const int space = width - longer(0, text);

    if (left) fputs(text, stdout);
    printf("%*s", space > 0 ? space : 0, "");
    if (!left) fputs(text, stdout);
}

static void print_section(const table_row *heading, int rows) {
    int width[TABLE_COLUMNS] = {0}, name = longer(0, heading->name);
    char text[TABLE_TEXT];

    for (int c = 0; c < heading->cells; c++) width[c] = longer(0, heading->column[c]);
    for (int r = 1; r <= rows; r++) {
        name = longer(name, heading[r].name);
        for (int c = 0; c < heading[r].cells; c++) {
            write_cell(text, &heading[r].cell[c], heading->form[c]);
            width[c] = longer(width[c], text);
        }
    }
    printf("\n");
    for (int r = 0; r <= rows; r++) {
        print_padded(heading[r].name, name, true);
        for (int c = 0; c < heading[r].cells; c++) {
            if (r > 0) write_cell(text, &heading[r].cell[c], heading->form[c]);
            printf("  ");
            print_padded(r == 0 ? heading->column[c] : text, width[c], false);
        }
        printf("\n");
    }
}

/* rows that follow a heading */
static int rows_of(const table *t, int heading) {
    int rows = 0;

    while (heading + rows + 1 < t->rows && !t->row[heading + rows + 1].heading) rows++;
    return rows;
}

void table_print(const table *t) {
    for (int i = 0; i < t->rows; i += rows_of(t, i) + 1) print_section(&t->row[i], rows_of(t, i));
}

static void print_string(const char *text) {
    putchar('"');
    for (; *text; text++) {
        if (*text == '"' || *text == '\\') putchar('\\');
        putchar(*text);
    }
    putchar('"');
}

static void print_json_row(const table_row *heading, const table_row *row) {
    printf("    {\"section\": ");
    print_string(heading->name);
    printf(", \"row\": ");
    print_string(row->name);
    for (int c = 0; c < row->cells; c++) {
        const table_cell *cell = &row->cell[c];
        printf(", ");
        print_string(heading->column[c]);
        printf(": ");
        if (cell->text[0]) {
            print_string(cell->text);
        } else if (isfinite(cell->value)) {
            printf("%.17g", cell->value);
        } else {
            printf("null");
        }
    }
    printf("}");
}

void table_print_json(const table *t) {
    const char *separator = "\n";
    const table_row *heading = NULL;

    printf("{\"figures\": [");
    for (int i = 0; i < t->rows; i++) {
        if (t->row[i].heading) {
            heading = &t->row[i];
            continue;
        }
        printf("%s", separator);
        print_json_row(heading, &t->row[i]);
        separator = ",\n";
    }
    printf("\n]}\n");
}
