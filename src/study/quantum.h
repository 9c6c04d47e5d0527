/* The step in which a column of numbers is written: 0.0001 where it has four decimals. */
#ifndef STUDY_QUANTUM_H
#define STUDY_QUANTUM_H

#include <stdbool.h>
#include <stddef.h>

/* What the cells of a column look like. Zero-filled: no cell yet. */
typedef struct study_digits {
    bool any;
    int place;  /* power of ten of the last digit, the smallest of all cells */
    int digits; /* from the first digit that is not 0 to the last, the largest of all cells */
} study_digits;

/* Takes the text of one cell, a decimal number that was read before. */
void study_digits_take(study_digits *column, const char *text, size_t length);

typedef struct study_quantum {
    double greatest; /* the largest step; 0: the values are as exact as numbers are */
    double mean;     /* root mean square of the steps of all rows */
} study_quantum;

/* The steps of a column's values, count of them and `stride` apart. Cells with a fixed number of decimals have all the same
 * step, cells with a fixed number of digits have larger steps where values are larger. Counts of an instrument, whole
 * multiples of a step that is no power of ten, are found from the values. scratch: count doubles. */
study_quantum study_quantum_find(const study_digits *column, const double *value, size_t stride,
                                 size_t count, double *scratch);

/* The times of a record. */
typedef struct study_clock {
    double interval; /* between rows that follow one another */
    double step;     /* in which times are written; 0: exact, as far as can be known */
    bool even;       /* rows come at whole multiples of the interval, within the step */
} study_clock;

/* scratch: count doubles. Times increase; there are two or more. */
study_clock study_clock_find(const study_digits *column, const double *time, size_t count,
                             double *scratch);

/* Puts the times of an even clock on whole multiples of its interval; the first and last stay. */
void study_clock_set(const study_clock *clock, double *time, size_t count);

#endif
