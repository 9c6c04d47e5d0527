/* Thinning the lines of a sweep row by row (sweep_thin.h). */
#include "figure/sweep_thin.h"

#include <math.h>
#include <stdlib.h>

void sweep_meet(sweep_ends *ends, double x, size_t row) {
    if (ends->count == 0) ends->least_above_zero = INFINITY;
    if (x > 0.0 && x < ends->least_above_zero) ends->least_above_zero = x;
    if (ends->count == 0 || x < ends->least) {
        ends->least = x;
        ends->first = row;
    }
    if (ends->count == 0 || x >= ends->greatest) {
        ends->greatest = x;
        ends->last = row;
    }
    ends->count++;
}

/* The stretch of an abscissa: the first that ends at or beyond it, else the last one. The quotient is off by rounding at most. */
static size_t stretch_of(const sweep_ends *ends, double x) {
    const double width = (ends->greatest - ends->least) / (double)SWEEP_STRETCHES;
    const double guess = width > 0.0 ? (x - ends->least) / width : 0.0;
    size_t s = guess < SWEEP_STRETCHES ? (size_t)guess : SWEEP_STRETCHES - 1;
    while (s > 0 && x <= ends->least + (double)s * width) s--;
    while (s + 1 < SWEEP_STRETCHES && !(x <= ends->least + (double)(s + 1) * width)) s++;
    return s;
}

static int compare_points(const void *a, const void *b) {
    const sweep_point *p = a, *q = b;
    if (p->x < q->x || p->x > q->x) return (p->x > q->x) - (p->x < q->x);
    return (p->row > q->row) - (p->row < q->row);
}

static bool is_before(const sweep_point *p, const sweep_point *q) {
    return compare_points(p, q) < 0;
}

/* ---- lines -------------------------------------------------------------------------------------------------------- */

enum { LEAST_DECADE = -330, DECADES = 640 };

static void count_decade(sweep_line *line, double y) {
    const double size = fabs(y);
    if (!isfinite(size) || !(size > 0.0)) return;
    const int d = (int)floor(log10(size)) - LEAST_DECADE;
    if (line->decade[d]++ == 0 || size < line->smallest[d]) line->smallest[d] = size;
}

static void put_in_stretch(struct sweep_stretch *s, const sweep_point *p) {
    if (s->met++ == 0 || is_before(p, &s->begin)) s->begin = *p;
    if (!isfinite(p->y)) return;
    const bool first = !s->finite;
    s->finite = true;
    if (first || p->y < s->least.y || (!(p->y > s->least.y) && is_before(p, &s->least)))
        s->least = *p;
    if (first || p->y > s->greatest.y || (!(p->y < s->greatest.y) && is_before(p, &s->greatest)))
        s->greatest = *p;
}

void sweep_line_add(sweep_line *line, sweep_point p) {
    count_decade(line, p.y);
    if (line->ends.count <= SWEEP_POINTS) {
        if (line->kept < SWEEP_POINTS) line->whole[line->kept++] = p;
        return;
    }
    if (p.row == line->ends.first)
        line->first = p;
    else if (p.row == line->ends.last)
        line->last = p;
    else
        put_in_stretch(&line->stretch[stretch_of(&line->ends, p.x)], &p);
}

static double logarithmic_low(const sweep_line *line) {
    size_t all = 0, met = 0;
    for (int d = 0; d < DECADES; d++) all += line->decade[d];
    for (int d = 0; d < DECADES && all > 0; d++) {
        met += line->decade[d];
        if (met > all / 25) return line->smallest[d];
    }
    return NAN;
}

size_t sweep_line_end(sweep_line *line, sweep_point point[SWEEP_POINTS], double *low) {
    *low = logarithmic_low(line);
    size_t n = 0;
    if (line->ends.count <= SWEEP_POINTS) {
        qsort(line->whole, line->kept, sizeof *line->whole, compare_points);
        for (; n < line->kept; n++) point[n] = line->whole[n];
        return n;
    }
    point[n++] = line->first;
    for (int i = 0; i < SWEEP_STRETCHES; i++) {
        const struct sweep_stretch *s = &line->stretch[i];
        if (s->met == 0) continue;
        if (!s->finite) {
            point[n++] = s->begin;
            continue;
        }
        const bool up = is_before(&s->least, &s->greatest);
        point[n++] = up ? s->least : s->greatest;
        if (s->least.row != s->greatest.row) point[n++] = up ? s->greatest : s->least;
    }
    point[n++] = line->last;
    return n;
}

/* ---- shares ------------------------------------------------------------------------------------------------------- */

void sweep_shares_add(sweep_shares *shares, double x, size_t row) {
    if (shares->ends.count <= SWEEP_POINTS) {
        if (shares->kept < SWEEP_POINTS) shares->whole[shares->kept++] = x;
        return;
    }
    if (row == shares->ends.first || row == shares->ends.last) return;
    struct sweep_share *s = &shares->stretch[stretch_of(&shares->ends, x)];
    if (s->met == 0 || x < s->least) s->least = x;
    if (s->met == 0 || x > s->greatest) s->greatest = x;
    s->met++;
}

size_t sweep_shares_end(sweep_shares *shares, double x[SWEEP_POINTS], double rank[SWEEP_POINTS]) {
    size_t n = 0, below = 1;
    if (shares->ends.count <= SWEEP_POINTS) {
        qsort(shares->whole, shares->kept, sizeof *shares->whole, sheet_compare_numbers);
        for (; n < shares->kept; n++) {
            x[n] = shares->whole[n];
            rank[n] = (double)(n + 1);
        }
        return n;
    }
    x[n] = shares->ends.least;
    rank[n++] = (double)below;
    for (int i = 0; i < SWEEP_STRETCHES; i++) {
        const struct sweep_share *s = &shares->stretch[i];
        if (s->met == 0) continue;
        x[n] = s->least;
        rank[n++] = (double)(below + 1);
        below += s->met;
        if (s->met == 1) continue;
        x[n] = s->greatest;
        rank[n++] = (double)below;
    }
    x[n] = shares->ends.greatest;
    rank[n++] = (double)(below + 1);
    return n;
}
