/* The rows of a sweep for its figures: one pass at a time, over numbers in memory or in a file. */
#define _POSIX_C_SOURCE 200809L
#include "figure/sweep_rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

size_t sweep_column(const gough_table *table, const char *name) {
    size_t c = 0;
    while (c < table->columns && strcmp(table->name[c], name) != 0) c++;
    return c;
}

/* ---- a pass ------------------------------------------------------------------------------------------------------- */

typedef struct pass {
    const char *const *names;
    size_t count;
    const double **value; /* of each name in a part */
    size_t first;
    bool changed; /* the file has other columns than when it was opened */
    sweep_visitor *visit;
    void *context;
} pass;

/* A gough_table_sink. */
static int take_part(void *context, const gough_table *part) {
    pass *p = context;
    for (size_t i = 0; i < p->count; i++) {
        const size_t c = sweep_column(part, p->names[i]);
        p->changed = c == part->columns;
        if (p->changed) return 1;
        p->value[i] = part->value[c];
    }
    const sweep_rows rows = {p->value, p->first, part->rows};
    if (part->rows > 0) p->visit(p->context, &rows);
    p->first += part->rows;
    return 0;
}

/* Whether the file of a table is the one that the first pass read; the first pass always finds it so. */
static bool is_same_file(builder *b, size_t table) {
    sweep_file *seen = &b->files[table];
    struct stat about;
    if (stat(b->tables[table]->source, &about) != 0) return true; /* the reader tells why */
    const sweep_file now = {.known = true,
                            .device = about.st_dev,
                            .node = about.st_ino,
                            .size = about.st_size,
                            .second = about.st_mtim.tv_sec,
                            .nanosecond = about.st_mtim.tv_nsec};
    if (!seen->known) *seen = now;
    return seen->device == now.device && seen->node == now.node && seen->size == now.size &&
           seen->second == now.second && seen->nanosecond == now.nanosecond;
}

bool sweep_visit(builder *b, size_t table, const char *const *names, size_t count,
                 sweep_visitor *visit, void *context) {
    const gough_table *t = b->tables[table];
    for (size_t i = 0; i < count && b->status == GOUGH_OK; i++)
        if (sweep_column(t, names[i]) == t->columns) (void)builder_column(b, table, names[i]);
    const char **wanted = calloc(count + 1, sizeof *wanted);
    const double **value = calloc(count + 1, sizeof *value);
    if (value == NULL || wanted == NULL)
        builder_fail(b, GOUGH_ERROR_FILE, "out of memory for this figure");
    if (b->status == GOUGH_OK) {
        pass p = {.names = names, .count = count, .value = value};
        p.visit = visit, p.context = context;
        memcpy(wanted, names, count * sizeof *wanted);
        p.changed = t->source != NULL && !is_same_file(b, table);
        if (t->source == NULL)
            take_part(&p, t);
        else if (!p.changed)
            b->status = gough_table_scan(t->source, wanted, take_part, &p, b->error);
        if (b->status == GOUGH_OK && p.changed)
            b->status = gough_fail(b->error, GOUGH_ERROR_FILE,
                                   "%s: has changed while it was being read", t->source);
    }
    free(wanted);
    free(value);
    return b->status == GOUGH_OK;
}

/* ---- facts -------------------------------------------------------------------------------------------------------- */

sweep_facts sweep_no_facts(void) { return (sweep_facts){INFINITY, -INFINITY, INFINITY}; }

void sweep_note(sweep_facts *facts, double value) {
    if (value < facts->least) facts->least = value;
    if (value > facts->greatest) facts->greatest = value;
    if (value > 0.0 && value < facts->least_above_zero) facts->least_above_zero = value;
}

bool sweep_spans_decades(const sweep_facts *facts) {
    return !(facts->least < 0.0) && facts->greatest > 100.0 * facts->least_above_zero;
}

static const double same_share = 1e-9;

bool sweep_is_level(const sweep_facts *facts) {
    return facts->greatest - facts->least <=
           same_share * fmax(fabs(facts->least), fabs(facts->greatest));
}

/* ---- different values --------------------------------------------------------------------------------------------- */

enum { PENDING = 4096, FEW_VALUES = 50 };

bool sweep_distinct_begin(builder *b, sweep_distinct *d) {
    *d = (sweep_distinct){.rising = true, .equal_steps = true, .equal_ratios = true};
    if (b->status == GOUGH_OK) d->value = sheet_array(b->sheet, SWEEP_VALUES + PENDING);
    if (d->value == NULL) builder_fail(b, GOUGH_ERROR_FILE, "out of memory for this figure");
    return d->value != NULL;
}

/* Brings the pending values into the order. */
static void settle(sweep_distinct *d) {
    const size_t all = d->count + d->pending;
    qsort(d->value, all, sizeof *d->value, sheet_compare_numbers);
    d->count = d->pending = 0;
    for (size_t i = 0; i < all; i++)
        if (d->count == 0 || d->value[i] > d->value[d->count - 1])
            d->value[d->count++] = d->value[i];
    d->more = d->count > SWEEP_VALUES;
}

static bool is_known(const sweep_distinct *d, double value) {
    size_t low = 0, high = d->count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (d->value[middle] < value)
            low = middle + 1;
        else
            high = middle;
    }
    return low < d->count && !(d->value[low] > value);
}

static bool same_step(double step, double first) {
    return fabs(step - first) <= 1e-6 * fabs(first);
}

/* A value that differs from the one before it. */
static void follow(sweep_distinct *d, double value) {
    if (d->met > 0 && !(value > d->last)) d->rising = false;
    if (d->met == 0) d->first = value;
    if (d->met == 1) d->second = value;
    if (d->met > 1) {
        d->equal_steps = d->equal_steps && same_step(value - d->last, d->second - d->first);
        d->equal_ratios = d->equal_ratios && same_step(value / d->last, d->second / d->first);
    }
    d->last = value;
    d->met++;
}

void sweep_distinct_add(sweep_distinct *d, const double *value, size_t count) {
    for (size_t i = 0; i < count; i++) {
        if (isnan(value[i]) || (d->met > 0 && !(value[i] < d->last) && !(value[i] > d->last)))
            continue;
        follow(d, value[i]);
        if (d->more || is_known(d, value[i])) continue;
        d->value[d->count + d->pending++] = value[i];
        if (d->pending == PENDING) settle(d);
    }
}

void sweep_distinct_end(sweep_distinct *d) {
    if (!d->more) settle(d);
}

static bool equal_steps(const double *value, size_t count, bool ratios) {
    for (size_t i = 1; i < count; i++) {
        const double first = ratios ? value[1] / value[0] : value[1] - value[0];
        const double step = ratios ? value[i] / value[i - 1] : value[i] - value[i - 1];
        if (!same_step(step, first)) return false;
    }
    return true;
}

bool sweep_is_logarithmic(const sweep_distinct *d) {
    if (d->more) return d->rising && d->first > 0.0 && !d->equal_steps && d->equal_ratios;
    const double *value = d->value;
    if (d->count < 3 || !(value[0] > 0.0) || equal_steps(value, d->count, false)) return false;
    return equal_steps(value, d->count, true) ||
           (d->count <= FEW_VALUES && value[d->count - 1] / value[0] >= 30.0);
}
