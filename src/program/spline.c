/* The cubic spline with two continuous derivatives through samples at unequal times, not-a-knot
 * at both ends, (motion-4). */
#include <math.h>
#include <stdbool.h>

#include "gough/model.h"

#define FAIL(error, ...) gough_fail(error, GOUGH_ERROR_INPUT, __VA_ARGS__)

/* pivot and upper diagonal of each interior row of the tridiagonal matrix */
size_t gough_samples_scratch(size_t count) { return 2 * count; }

static gough_status check(const gough_samples *s, gough_error *error) {
    if (s->count < 2)
        return FAIL(error, "recorded motion needs 2 rows or more, this one has %zu", s->count);
    for (size_t i = 0; i < s->count; i++) {
        if (!isfinite(s->time[i])) return FAIL(error, "row %zu: the time is not finite", i + 1);
        for (size_t c = 0; c < GOUGH_COMPONENTS; c++)
            if (!isfinite(s->value[i * GOUGH_COMPONENTS + c]))
                return FAIL(error, "row %zu: %s is not finite", i + 1,
                            gough_component_name((int)c));
        if (i > 0 && !(s->time[i] > s->time[i - 1]))
            return FAIL(error, "row %zu: the time %.9g does not increase from %.9g before it",
                        i + 1, s->time[i], s->time[i - 1]);
    }
    return GOUGH_OK;
}

/* Mean slope of component c from row i to the next. */
static double slope(const gough_samples *s, size_t i, size_t c) {
    const double *y = s->value + i * GOUGH_COMPONENTS + c;
    return (y[GOUGH_COMPONENTS] - y[0]) / (s->time[i + 1] - s->time[i]);
}

/* Continuity of the first derivative at row i, with m the second derivatives and h the
 * intervals:
 *   h₋ m₋ + 2 (h₋ + h) m + h m₊ = 6 (slope − slope₋).
 * Not-a-knot, one cubic over the first two intervals, is m₀ = m₁ (1 + h₀/h₁) − m₂ h₀/h₁, put
 * into the row i = 1, and likewise at the other end. The matrix stays diagonally dominant for
 * any intervals. */
static void factor(const gough_samples *s, double *pivot, double *upper) {
    const size_t last = s->count - 1;
    for (size_t i = 1; i < last; i++) {
        const double before = s->time[i] - s->time[i - 1], after = s->time[i + 1] - s->time[i];
        double lower = before, diagonal = 2 * (before + after);
        upper[i] = after;
        if (i == 1) {
            diagonal += before * (1 + before / after);
            upper[i] -= before * (before / after);
        }
        if (i == last - 1) {
            diagonal += after * (1 + after / before);
            lower -= after * (after / before);
        }
        pivot[i] = i == 1 ? diagonal : diagonal - lower * (upper[i - 1] / pivot[i - 1]);
    }
}

static void solve(const gough_samples *s, const double *pivot, const double *upper, size_t c) {
    const size_t last = s->count - 1;
    double *m = s->curvature + c; /* of row i at i·GOUGH_COMPONENTS */
    const size_t row = GOUGH_COMPONENTS;
    for (size_t i = 1; i < last; i++) {
        const double before = s->time[i] - s->time[i - 1], after = s->time[i + 1] - s->time[i];
        const double lower = i == last - 1 ? before - after * (after / before) : before;
        const double right = 6 * (slope(s, i, c) - slope(s, i - 1, c));
        m[i * row] = i == 1 ? right : right - lower * (m[(i - 1) * row] / pivot[i - 1]);
    }
    for (size_t i = last - 1; i >= 1; i--) {
        if (i < last - 1) m[i * row] -= upper[i] * m[(i + 1) * row];
        m[i * row] /= pivot[i];
    }

    const double first = (s->time[1] - s->time[0]) / (s->time[2] - s->time[1]);
    const double end =
        (s->time[last] - s->time[last - 1]) / (s->time[last - 1] - s->time[last - 2]);
    m[0] = m[row] + first * (m[row] - m[2 * row]);
    m[last * row] = m[(last - 1) * row] + end * (m[(last - 1) * row] - m[(last - 2) * row]);
}

/* Second derivative of the parabola through three rows. */
static double parabola(const gough_samples *s, size_t c) {
    return 2 * (slope(s, 1, c) - slope(s, 0, c)) / (s->time[2] - s->time[0]);
}

gough_status gough_samples_prepare(const gough_samples *samples, double *scratch,
                                   gough_error *error) {
    const gough_status status = check(samples, error);
    if (status != GOUGH_OK) return status;

    const size_t count = samples->count;
    if (count > 3) {
        factor(samples, scratch, scratch + count);
        for (size_t c = 0; c < GOUGH_COMPONENTS; c++) solve(samples, scratch, scratch + count, c);
    } else {
        for (size_t c = 0; c < GOUGH_COMPONENTS; c++) {
            const double second = count == 3 ? parabola(samples, c) : 0;
            for (size_t i = 0; i < count; i++)
                samples->curvature[i * GOUGH_COMPONENTS + c] = second;
        }
    }

    for (size_t i = 0; i < count * GOUGH_COMPONENTS; i++)
        if (!isfinite(samples->curvature[i]))
            return FAIL(error, "row %zu: the rows are too close in time for their differences",
                        i / GOUGH_COMPONENTS + 1);
    return GOUGH_OK;
}
