/* Thinning of long lines for drawing, so that no peak is lost and a vector file stays small. */
#include <math.h>

#include "figure/sheet.h"

/* Keeps the least and the greatest point of [begin, end), in order; a stretch without a finite point keeps its first. */
static size_t keep_extremes(const double *y, size_t begin, size_t end, size_t *index) {
    size_t least = end, greatest = end;
    for (size_t i = begin; i < end; i++) {
        if (!isfinite(y[i])) continue;
        if (least == end || y[i] < y[least]) least = i;
        if (greatest == end || y[i] > y[greatest]) greatest = i;
    }
    if (least == end) {
        index[0] = begin;
        return 1;
    }
    index[0] = least < greatest ? least : greatest;
    if (least == greatest) return 1;
    index[1] = least < greatest ? greatest : least;
    return 2;
}

static double span_of(const double *value, size_t count) {
    double least = INFINITY, greatest = -INFINITY;
    for (size_t i = 0; i < count; i++) {
        if (!isfinite(value[i])) continue;
        least = fmin(least, value[i]);
        greatest = fmax(greatest, value[i]);
    }
    return greatest > least ? greatest - least : 0;
}

size_t sheet_thin_loop(const double *x, const double *y, size_t count, double share,
                       size_t *index) {
    const double width = share * span_of(x, count), height = share * span_of(y, count);
    size_t kept = 0;
    for (size_t i = 0; i < count; i++) {
        const size_t last = kept > 0 ? index[kept - 1] : 0;
        const bool near = kept > 0 && i + 1 < count && fabs(x[i] - x[last]) <= width &&
                          fabs(y[i] - y[last]) <= height;
        if (!near) index[kept++] = i;
    }
    return kept;
}

size_t sheet_thin(const double *x, const double *y, size_t count, size_t buckets, size_t *index) {
    size_t kept = 0;
    if (count <= 2 * buckets + 2) {
        for (; kept < count; kept++) index[kept] = kept;
        return kept;
    }

    const double width = (x[count - 1] - x[0]) / (double)buckets;
    index[kept++] = 0;
    size_t begin = 1;
    for (size_t b = 0; b < buckets && begin < count - 1; b++) {
        const double limit = x[0] + (double)(b + 1) * width;
        size_t end = begin;
        while (end < count - 1 && (x[end] <= limit || b + 1 == buckets)) end++;
        if (end > begin) kept += keep_extremes(y, begin, end, index + kept);
        begin = end;
    }
    index[kept++] = count - 1;
    return kept;
}
