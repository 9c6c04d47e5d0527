/* Ranges of the axes of a sheet. Each axis is at least so wide that noise of the run, if there is nothing else, lies on a straight
 * line. */
#include "figure/axis_ranges.h"

#include <math.h>
#include <stdlib.h>

/* An axis is at least this many times as wide as the noise of what it shows: noise is then below a pixel or two. */
static const double least_width = 100.0;
/* And this share of its greatest number, which hides the rounding of numbers whose noise is not known. */
static const double least_share = 1e-9;

static void widen(range *r, double value) {
    if (!isfinite(value)) return;
    if (!(value >= r->low)) r->low = value;
    if (!(value <= r->high)) r->high = value;
}

static range empty_range(void) { return (range){NAN, NAN}; }

static bool has_map(const sheet *s) { return s->count > 0 && s->panel[0].mapped; }

/* From edge to edge of a map's cells. */
static range cell_range(const double *centre, size_t count, bool logarithmic) {
    double low, high;
    range r;
    sheet_cell(centre, count, 0, logarithmic, &r.low, &high);
    sheet_cell(centre, count, count - 1, logarithmic, &low, &r.high);
    return r;
}

static range range_of_abscissae(const sheet *s) {
    range r = empty_range();
    for (int p = 0; p < s->count; p++) {
        for (int i = 0; i < s->panel[p].count; i++) {
            const series *line = &s->panel[p].series[i];
            if (line->thinned && s->logarithmic_abscissa) widen(&r, line->least_above_zero);
            for (size_t k = 0; k < line->count; k++) {
                if (!s->logarithmic_abscissa || line->x[k] > 0.0) widen(&r, line->x[k]);
            }
        }
    }
    return r;
}

range sheet_abscissa(const sheet *s) {
    if (has_map(s))
        return cell_range(s->panel[0].map.x, s->panel[0].map.columns, s->logarithmic_abscissa);
    range r = range_of_abscissae(s);
    if (isfinite(s->from) && (!s->logarithmic_abscissa || s->from > 0.0)) r.low = s->from;
    if (isfinite(s->to) && (!s->logarithmic_abscissa || s->to > 0.0)) r.high = s->to;
    if (!(r.high > r.low)) {
        const double centre = isfinite(r.low) ? r.low : s->logarithmic_abscissa ? 1.0 : 0.0;
        const double half = 0.5 * fmax(fabs(centre), 1.0);
        r = s->logarithmic_abscissa ? (range){centre / 10.0, centre * 10.0}
                                    : (range){centre - half, centre + half};
    } else if (s->logarithmic_abscissa) {
        r = (range){r.low / 1.4, r.high * 1.4};
    }
    return r;
}

double panel_drawn(const panel *p, double value) { return p->logarithmic ? fabs(value) : value; }

int sheet_compare_numbers(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Where a logarithmic axis begins for a line: below all but 1/25 of its positive numbers. The rest are a start from nothing
 * and passages through zero, which would otherwise take up most of the panel. NaN without any. */
static double logarithmic_low(const series *line) {
    if (line->thinned) return line->logarithmic_low;
    double *sorted = malloc((line->count > 0 ? line->count : 1) * sizeof *sorted);
    if (sorted == NULL) return NAN;
    size_t count = 0;
    for (size_t k = 0; k < line->count; k++) {
        const double size = fabs(line->y[k]);
        if (isfinite(size) && size > 0.0) sorted[count++] = size;
    }
    qsort(sorted, count, sizeof *sorted, sheet_compare_numbers);
    const double low = count > 0 ? sorted[count / 25] : NAN;
    free(sorted);
    return low;
}

static range range_of_lines(const panel *p) {
    range r = empty_range();
    for (int i = 0; i < p->count; i++) {
        const series *line = &p->series[i];
        const double low = p->logarithmic ? logarithmic_low(line) : -INFINITY;
        widen(&r, low);
        if (line->steps) widen(&r, 0.0); /* a staircase begins there */
        for (size_t k = 0; k < line->count; k++) {
            if (panel_drawn(p, line->y[k]) >= low) widen(&r, panel_drawn(p, line->y[k]));
        }
    }
    return r;
}

static double greatest_of(range r) { return fmax(fabs(r.low), fabs(r.high)); }

void panel_settle_scale(panel *p) {
    if (!p->logarithmic || p->mapped || p->count == 0) return;
    const range r = range_of_lines(p);
    if (!isfinite(r.low) || greatest_of(r) <= p->noise) p->logarithmic = false;
}

/* Whole decades, at least two, at most fourteen. */
static range whole_decades(range r) {
    if (!isfinite(r.low)) return (range){1e-16, 1.0};
    double low = floor(log10(r.low)), high = ceil(log10(r.high));
    if (high - low < 2.0) high = low + 2.0;
    if (high - low > 14.0) low = high - 14.0;
    high = fmin(high, 308.0);
    low = fmax(fmin(low, 306.0), -300.0);
    return (range){pow(10.0, low), pow(10.0, high)};
}

/* Room above and below the numbers. Where they do not vary by more than their noise, a constant stands in the middle of an axis
 * that shows a tenth of it, and noise about zero in the middle of one that shows much more. */
static range padded(range r, double noise) {
    const double least = least_width * noise;
    if (!isfinite(r.low)) return least > 0.0 ? (range){-least, least} : (range){-1.0, 1.0};
    const double greatest = greatest_of(r), span = r.high - r.low;
    if (span > fmax(least_share * greatest, least))
        return (range){r.low - 0.06 * span, r.high + 0.06 * span};
    const double half = fmax(0.5 * span + 0.05 * greatest, 0.5 * least);
    const double middle = greatest < least ? 0.0 : 0.5 * (r.low + r.high);
    return half > 0.0 ? (range){middle - half, middle + half} : (range){-1.0, 1.0};
}

/* Exponent of 1000 that brings numbers up to the greatest between 0.01 and 10 000; 0 where they are, or nearly all are 0. */
static int power_of(double greatest) {
    if (!isfinite(greatest) || greatest < 1e-18) return 0;
    return greatest >= 1e4 || greatest < 1e-2 ? (int)floor(log10(greatest) / 3.0 + 1e-9) : 0;
}

/* Scaled first, so that the greatest numbers there are have a width. */
static scaled_range scaled(range r, double noise, bool pad) {
    const int power = power_of(fmax(greatest_of(r), 0.5 * least_width * noise));
    const double unit = pow(1000.0, power);
    const range inner = {r.low / unit, r.high / unit};
    return (scaled_range){pad ? padded(inner, noise / unit) : inner, power};
}

scaled_range panel_ordinate(const panel *p) {
    if (p->mapped)
        return (scaled_range){cell_range(p->map.y, p->map.rows, p->map.logarithmic_y), 0};
    range r = range_of_lines(p);
    if (p->logarithmic && r.low < p->least) r.low = p->least;
    return p->logarithmic ? (scaled_range){whole_decades(r), 0} : scaled(r, p->noise, true);
}

scaled_range panel_colours(const panel *p) {
    const map *m = &p->map;
    range r = empty_range();
    for (size_t i = 0; i < m->columns * m->rows; i++)
        if (!p->logarithmic || m->cells[i] > 0.0) widen(&r, m->cells[i]);
    if (p->logarithmic) return (scaled_range){whole_decades(r), 0};
    return scaled(r, p->noise, !(r.high - r.low > least_width * p->noise));
}
