/* The rows of a sweep for its figures, whether they are in memory or in a file that is read in parts, and what one pass over
 * them tells. */
#ifndef GOUGH_FIGURE_SWEEP_ROWS_H
#define GOUGH_FIGURE_SWEEP_ROWS_H

#include <sys/types.h>

#include "figure/builder.h"

enum {
    SWEEP_NAMES = 12,    /* columns drawn at most */
    SWEEP_VALUES = 65536 /* different values of a key that are told apart */
};

/* Some rows, in their order: `first` is the number of rows before them. */
typedef struct sweep_rows {
    const double *const *value; /* [columns asked for][count] */
    size_t first, count;
} sweep_rows;
typedef void sweep_visitor(void *context, const sweep_rows *rows);

/* What tells a file that was replaced or written to from the one that the first pass read. */
typedef struct sweep_file {
    bool known;
    dev_t device;
    ino_t node;
    off_t size;
    long long second, nanosecond; /* of the last change */
} sweep_file;

/* Index of the column of a sweep that has this name; the number of columns if no column has it. */
size_t sweep_column(const gough_table *table, const char *name);

/* Hands all rows of a table to the visitor, with these columns; without the columns a sentence that names one that is missing.
 * False if that, or the file, fails. */
bool sweep_visit(builder *b, size_t table, const char *const *names, size_t count,
                 sweep_visitor *visit, void *context);

/* Numbers of a column that are not NaN. */
typedef struct sweep_facts {
    double least, greatest;  /* +infinity and −infinity without any */
    double least_above_zero; /* +infinity without any */
} sweep_facts;
sweep_facts sweep_no_facts(void);
void sweep_note(sweep_facts *facts, double value);
/* Whether positive numbers, beside no negative one, span two decades. */
bool sweep_spans_decades(const sweep_facts *facts);
/* Whether the numbers differ by rounding only, as a side load that no swept number changes: they are drawn as the greatest, lest
 * rounding be drawn as a signal. */
bool sweep_is_level(const sweep_facts *facts);

/* The different values of a key, increasing. */
typedef struct sweep_distinct {
    double *value; /* an array of the sheet; the rest of it is work space */
    size_t count;
    size_t pending; /* behind them, in no order */
    bool more;      /* there are more than SWEEP_VALUES: `value` is then of no use */
    /* of a key whose values never go down from row to row */
    bool rising, equal_steps, equal_ratios;
    double first, second, last;
    size_t met;
} sweep_distinct;
bool sweep_distinct_begin(builder *b, sweep_distinct *d);
void sweep_distinct_add(sweep_distinct *d, const double *value, size_t count);
void sweep_distinct_end(sweep_distinct *d);
/* A grid of equal ratios, or a short list over decades. */
bool sweep_is_logarithmic(const sweep_distinct *d);

#endif
