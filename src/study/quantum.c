/* The step in which a column of numbers is written: from its text, and from the values where they are counts of an
 * instrument in other units. */
#include "study/quantum.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    EXACT_DIGITS = 15, /* so many, and the text says all that a double holds */
    LEAST_GAPS = 16,   /* that must agree, for counts to be believed */
    NEAR = 50, /* gaps of more counts than this are left out: a small error of the step adds up */
    LEAST_REVERSALS =
        4 /* third differences of either sign; values that follow a parabola have none */
};

void study_digits_take(study_digits *column, const char *text, size_t length) {
    int place = 0, digits = 0;
    bool point = false;
    for (size_t i = 0; i < length; i++) {
        const char c = text[i];
        if (c == 'e' || c == 'E') {
            const long power = strtol(text + i + 1, NULL, 10);
            place += power > 400 ? 400 : power < -400 ? -400 : (int)power;
            break;
        }
        if (c == '.') point = true;
        if (c < '0') continue; /* the point or a sign */
        if (point) place--;
        if (digits > 0 || c != '0') digits++;
    }
    if (!column->any || place < column->place) column->place = place;
    if (digits > column->digits) column->digits = digits;
    column->any = true;
}

/* The step of one value, from its text: its last digit, but no finer than the column's digits allow. */
static double step_of(const study_digits *column, double value) {
    int place = column->place;
    if (fabs(value) > 0) {
        const int last = (int)floor(log10(fabs(value))) - column->digits + 1;
        if (last > place) place = last;
    }
    return pow(10, place);
}

static int compare(const void *left, const void *right) {
    const double a = *(const double *)left, b = *(const double *)right;
    return (a > b) - (a < b);
}

/* Gaps between neighbouring values in order, those that rounding of the text may have made left out. */
static size_t find_gaps(double *sorted, size_t count, double tolerance) {
    size_t gaps = 0;
    qsort(sorted, count, sizeof *sorted, compare);
    double before = sorted[0];
    for (size_t i = 1; i < count; i++) {
        const double gap = sorted[i] - before;
        if (!(gap > tolerance)) continue;
        before = sorted[i];
        sorted[gaps++] = gap;
    }
    return gaps;
}

/* The step of which all near gaps are whole multiples; 0: there is none. */
static double common_step(const double *gap, size_t gaps, double tolerance) {
    double least = INFINITY, sum = 0, counts = 0;
    size_t agree = 0;
    for (size_t i = 0; i < gaps; i++) least = fmin(least, gap[i]);
    if (!(least > 20 * tolerance)) return 0;
    for (size_t i = 0; i < gaps; i++) {
        const double n = rint(gap[i] / least);
        if (n > 3) continue;
        sum += gap[i];
        counts += n;
    }
    const double step = sum / counts;
    for (size_t i = 0; i < gaps; i++) {
        const double n = rint(gap[i] / step);
        if (n > NEAR) continue;
        if (!(fabs(gap[i] - n * step) <= 0.1 * step)) return 0;
        agree++;
    }
    return agree >= LEAST_GAPS && 2 * agree >= gaps ? step : 0;
}

/* Whether the values jitter as counts do: third differences of both signs. Straight lines and parabolas may be whole
 * multiples of a number without being rounded to it. */
static bool jitters(const double *value, size_t stride, size_t count, double step) {
    size_t up = 0, down = 0;
    for (size_t i = 3; i < count; i++) {
        const double *v = value + i * stride;
        const double third = v[0] - 3 * *(v - stride) + 3 * *(v - 2 * stride) - *(v - 3 * stride);
        up += third > 0.5 * step;
        down += third < -0.5 * step;
    }
    return up >= LEAST_REVERSALS && down >= LEAST_REVERSALS;
}

study_quantum study_quantum_find(const study_digits *column, const double *value, size_t stride,
                                 size_t count, double *scratch) {
    const bool exact = column->digits >= EXACT_DIGITS;
    study_quantum found = {0, 0};
    double largest = 0;
    for (size_t i = 0; i < count; i++) {
        const double v = value[i * stride], step = exact ? 0 : step_of(column, v);
        largest = fmax(largest, fabs(v));
        found.greatest = fmax(found.greatest, step);
        found.mean += step * step;
        scratch[i] = v;
    }
    found.mean = sqrt(found.mean / (double)count);

    const double tolerance = 1e-15 * largest + 1.01 * found.greatest;
    const size_t gaps = find_gaps(scratch, count, tolerance);
    const double counts = common_step(scratch, gaps, tolerance);
    if (counts > 2 * found.greatest && jitters(value, stride, count, counts))
        found = (study_quantum){counts, counts};
    return found;
}

/* ---- times ------------------------------------------------------------------------------------------------------- */

/* Whether all intervals are whole multiples of the shortest, half of them and more it itself, up to rounding of numbers. */
static bool on_a_grid(const double *time, size_t count, double *shortest) {
    const double noise = 4e-16 * fmax(fabs(time[0]), fabs(time[count - 1]));
    size_t equal = 0;
    *shortest = INFINITY;
    for (size_t i = 1; i < count; i++) *shortest = fmin(*shortest, time[i] - time[i - 1]);
    for (size_t i = 1; i < count; i++) {
        const double n = rint((time[i] - time[i - 1]) / *shortest);
        equal += n < 1.5;
        if (!(fabs(time[i] - time[i - 1] - n * *shortest) <= n * noise + 1e-9 * *shortest))
            return false;
    }
    return 2 * equal >= count - 1;
}

/* Intervals from the first row to the last, if rows are `interval` apart or a whole multiple of it. */
static double intervals_in(const double *time, size_t count, double interval) {
    double sum = 0;
    for (size_t i = 1; i < count; i++) sum += fmax(1, rint((time[i] - time[i - 1]) / interval));
    return sum;
}

/* How far the times are from whole multiples of the interval. */
static double unevenness(const double *time, size_t count, double interval) {
    double sum = 0, most = 0;
    for (size_t i = 1; i < count; i++) {
        sum += fmax(1, rint((time[i] - time[i - 1]) / interval));
        most = fmax(most, fabs(time[i] - time[0] - sum * interval));
    }
    return most;
}

/* Times of 0.013, 0.027, 0.04: equal intervals or, where rows are lost, whole multiples, rounded to the step. */
static bool are_rounded(study_clock *clock, const double *time, size_t count, double near) {
    const double interval = (time[count - 1] - time[0]) / intervals_in(time, count, near);
    if (!(unevenness(time, count, interval) <= 1.01 * clock->step)) return false;
    clock->interval = interval;
    clock->even = true;
    return true;
}

study_clock study_clock_find(const study_digits *column, const double *time, size_t count,
                             double *scratch) {
    const bool exact = column->digits >= EXACT_DIGITS;
    const double whole = time[count - 1] - time[0], mean = whole / (double)(count - 1);
    study_clock clock = {.interval = mean};
    double shortest;
    const bool grid = on_a_grid(time, count, &shortest);
    if (!exact) clock.step = fmax(step_of(column, time[0]), step_of(column, time[count - 1]));

    if (!(grid && mean < 1.0000001 * shortest) && !exact &&
        unevenness(time, count, mean) <= 1.01 * clock.step) {
        are_rounded(&clock, time, count, mean);
        return clock;
    }
    if (grid) {
        clock.interval = whole / intervals_in(time, count, shortest);
        clock.step = 0;
        clock.even = true;
        return clock;
    }
    for (size_t i = 1; i < count; i++) scratch[i - 1] = time[i] - time[i - 1];
    qsort(scratch, count - 1, sizeof *scratch, compare);
    /* the median is the interval within the step, however many rows are lost */
    if (!exact) are_rounded(&clock, time, count, scratch[(count - 1) / 2]);
    return clock;
}

void study_clock_set(const study_clock *clock, double *time, size_t count) {
    double sum = 0;
    for (size_t i = 1; i + 1 < count; i++) {
        sum += fmax(1, rint((time[i] - time[i - 1]) / clock->interval));
        time[i] = time[0] + sum * clock->interval;
    }
}
