/* What the program prints: sections of rows of figures, as text for people or JSON for machines. */
#ifndef BENCH_TABLE_H
#define BENCH_TABLE_H

#include <stdbool.h>

enum { TABLE_COLUMNS = 10, TABLE_ROWS = 400, TABLE_TEXT = 72 };

/* how a figure is written */
typedef enum { AS_PLAIN, AS_PERCENT, AS_ERROR } table_form;

typedef struct {
    char text[TABLE_TEXT]; /* if not empty, instead of the value */
    double value;          /* NaN: nothing to say */
} table_cell;

typedef struct {
    bool heading; /* name is a section's, column are its columns */
    char name[TABLE_TEXT];
    int cells;
    const char *column[TABLE_COLUMNS];
    table_form form[TABLE_COLUMNS];
    table_cell cell[TABLE_COLUMNS];
} table_row;

typedef struct {
    int rows;
    table_row row[TABLE_ROWS];
} table;

typedef struct {
    const char *name;
    table_form form;
} table_column;

void table_section(table *t, const char *name, int count, const table_column *column);
/* a row of the last section; cells are then set one by one, in order */
void table_begin_row(table *t, const char *format, ...) __attribute__((format(printf, 2, 3)));
void table_value(table *t, double value);
void table_word(table *t, const char *format, ...) __attribute__((format(printf, 2, 3)));

void table_print(const table *t);
void table_print_json(const table *t);

#endif
