/* Smoothing of recorded motion without lag, (motion-8): the values of one component are replaced by
 * those of the cubic spline z, not-a-knot at both ends, that makes
 *     Σ w (z − y)² + ω_c⁻⁶ ∫ z'''² dt
 * least, with w the time that a row stands for. In the middle of an evenly sampled record that is a
 * low-pass filter of gain 1/(1 + (ω/ω_c)⁶) and phase 0. Solved in B-splines by Givens rotations, which
 * keep the digits that normal equations lose where the filter is much slower than the rows. */
#include <math.h>
#include <string.h>

#include "gough/model.h"

#define FAIL(error, ...) gough_fail(error, GOUGH_ERROR_INPUT, __VA_ARGS__)

enum {
    ORDER = 4, /* coefficients of a cubic spline that matter at one time */
    LEAST_ROWS = 4
};

static const double TURN = 6.28318530717958647693;

/* One component: times in mean steps from 0, its values, the solution, and the triangular system. */
typedef struct fit {
    size_t count;
    double step; /* mean step, in the record's unit of time */
    double *time, *value, *smooth;
    double (*row)[ORDER]; /* row i of the triangle: columns i to i + 3 */
    double *right;
} fit;

size_t gough_samples_smooth_scratch(size_t count) { return (4 + ORDER) * count; }

static fit lay_out(size_t count, const double *time, const double *value, int component,
                   double *scratch) {
    fit f = {.count = count,
             .step = (time[count - 1] - time[0]) / (double)(count - 1),
             .time = scratch,
             .value = scratch + count,
             .smooth = scratch + 2 * count,
             .right = scratch + 3 * count,
             .row = (double(*)[ORDER])(scratch + 4 * count)};
    for (size_t i = 0; i < count; i++) {
        f.time[i] = (time[i] - time[0]) / f.step;
        f.value[i] = value[i * GOUGH_COMPONENTS + (size_t)component];
    }
    return f;
}

/* Knots: the ends four times each, and between them every row but the second and the last but one. */
static double knot(const fit *f, size_t k) {
    if (k < ORDER) return f->time[0];
    return k < f->count ? f->time[k - 2] : f->time[f->count - 1];
}

/* The interval, from knot s to s + 1, in which row i lies. */
static size_t interval_of(const fit *f, size_t i) {
    const size_t s = i + 2;
    return s < 3 ? 3 : s > f->count - 1 ? f->count - 1 : s;
}

/* The four B-splines that do not vanish in interval s, at row i: those of coefficients s − 3 to s. */
static void basis(const fit *f, size_t s, size_t i, double N[ORDER]) {
    double left[ORDER], right[ORDER];
    N[0] = 1;
    for (size_t j = 1; j < ORDER; j++) {
        double carried = 0;
        left[j] = f->time[i] - knot(f, s + 1 - j);
        right[j] = knot(f, s + j) - f->time[i];
        for (size_t r = 0; r < j; r++) {
            const double part = N[r] / (right[r + 1] + left[j - r]);
            N[r] = carried + right[r + 1] * part;
            carried = left[j - r] * part;
        }
        N[j] = carried;
    }
}

/* The third derivative in interval s, constant there, as a row of the same four coefficients:
 * differences of coefficients over differences of knots, three times. */
static void third_derivative(const fit *f, size_t s, double row[ORDER]) {
    double of[ORDER][ORDER] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    for (size_t d = 1; d < ORDER; d++)
        for (size_t j = ORDER - 1; j >= d; j--) {
            const size_t k = s - 3 + j;
            const double factor = (double)(ORDER - d) / (knot(f, k + ORDER - d) - knot(f, k));
            for (size_t c = 0; c < ORDER; c++) of[j][c] = factor * (of[j][c] - of[j - 1][c]);
        }
    memcpy(row, of[ORDER - 1], sizeof of[ORDER - 1]);
}

/* Takes one equation, of coefficients from `first` on, into the triangle. Equations come in order of their
 * first coefficient, so that no row of the triangle grows beyond four. */
static void take(fit *f, size_t first, double row[ORDER], double right) {
    for (size_t j = 0; j < ORDER; j++) {
        double *mine = f->row[first + j];
        const double length = sqrt(mine[0] * mine[0] + row[j] * row[j]);
        if (!(length > 0)) continue;
        const double c = mine[0] / length, s = row[j] / length;
        for (size_t k = j; k < ORDER; k++) {
            const double above = mine[k - j], below = row[k];
            mine[k - j] = c * above + s * below;
            row[k] = c * below - s * above;
        }
        const double above = f->right[first + j];
        f->right[first + j] = c * above + s * right;
        right = c * right - s * above;
    }
}

/* Time that row i stands for, in mean steps. */
static double span_of(const fit *f, size_t i) {
    const size_t last = f->count - 1;
    if (i == 0) return f->time[1] - f->time[0];
    if (i == last) return f->time[last] - f->time[last - 1];
    return (f->time[i + 1] - f->time[i - 1]) / 2;
}

/* The smooth values for a cutoff in cycles per unit of time. */
static void solve(fit *f, double cutoff) {
    const double omega = TURN * cutoff * f->step, stiffness = 1 / (omega * omega * omega);
    double row[ORDER];
    memset(f->row, 0, f->count * sizeof f->row[0]);
    memset(f->right, 0, f->count * sizeof f->right[0]);
    size_t i = 0;
    for (size_t s = 3; s < f->count; s++) {
        const double weight = stiffness * sqrt(knot(f, s + 1) - knot(f, s));
        third_derivative(f, s, row);
        for (size_t c = 0; c < ORDER; c++) row[c] *= weight;
        take(f, s - 3, row, 0);
        for (; i < f->count && interval_of(f, i) == s; i++) {
            const double root = sqrt(span_of(f, i));
            basis(f, s, i, row);
            for (size_t c = 0; c < ORDER; c++) row[c] *= root;
            take(f, s - 3, row, root * f->value[i]);
        }
    }
    for (size_t k = f->count; k-- > 0;) {
        double sum = f->right[k];
        for (size_t c = 1; c < ORDER && k + c < f->count; c++)
            sum -= f->row[k][c] * f->right[k + c];
        f->right[k] = sum / f->row[k][0];
    }
    for (i = 0; i < f->count; i++) {
        const size_t s = interval_of(f, i);
        double sum = 0;
        basis(f, s, i, row);
        for (size_t c = 0; c < ORDER; c++) sum += row[c] * f->right[s - 3 + c];
        f->smooth[i] = sum;
    }
}

/* Whether the values have moved by no more than allowed; false where they are not finite. */
static bool within(const fit *f, double deviation, double greatest) {
    double sum = 0, most = 0;
    for (size_t i = 0; i < f->count; i++) {
        const double moved = fabs(f->smooth[i] - f->value[i]);
        sum += moved * moved;
        if (!(moved <= most)) most = moved;
    }
    return sqrt(sum / (double)f->count) <= deviation && most <= greatest;
}

/* The smooth values, all or none. */
static gough_status give_back(const fit *f, double *value, int component, gough_error *error) {
    for (size_t i = 0; i < f->count; i++)
        if (!isfinite(f->smooth[i]))
            return FAIL(error, "row %zu: the rows are too close in time to be smoothed", i + 1);
    for (size_t i = 0; i < f->count; i++)
        value[i * GOUGH_COMPONENTS + (size_t)component] = f->smooth[i];
    return GOUGH_OK;
}

static gough_status check(size_t count, const double *time, const double *value, int component,
                          gough_error *error) {
    if (component < 0 || component >= GOUGH_COMPONENTS)
        return FAIL(error, "a motion has no component %d", component);
    for (size_t i = 0; i < count; i++) {
        if (!isfinite(time[i]) || !isfinite(value[i * GOUGH_COMPONENTS + (size_t)component]))
            return FAIL(error, "row %zu: %s or its time is not finite", i + 1,
                        gough_component_name(component));
        if (i > 0 && !(time[i] > time[i - 1]))
            return FAIL(error, "row %zu: the time %.9g does not increase from %.9g before it",
                        i + 1, time[i], time[i - 1]);
    }
    return GOUGH_OK;
}

gough_status gough_samples_low_pass(size_t count, const double *time, double *value, int component,
                                    double cutoff, double *scratch, gough_error *error) {
    const gough_status status = check(count, time, value, component, error);
    if (status != GOUGH_OK) return status;
    if (!(cutoff > 0)) return FAIL(error, "the cutoff must be greater than 0, not %.9g", cutoff);
    if (count < LEAST_ROWS || !isfinite(cutoff)) return GOUGH_OK;
    fit f = lay_out(count, time, value, component, scratch);
    solve(&f, cutoff);
    return give_back(&f, value, component, error);
}

/* The strongest smoothing lies between none, where rows alternate, and a parabola through all. */
gough_status gough_samples_smooth(size_t count, const double *time, double *value, int component,
                                  double deviation, double greatest, double *cutoff,
                                  double *scratch, gough_error *error) {
    const gough_status status = check(count, time, value, component, error);
    *cutoff = INFINITY;
    if (status != GOUGH_OK) return status;
    if (!(deviation >= 0) || !(greatest >= 0))
        return FAIL(error, "the allowed change must be 0 or greater, not %.9g and %.9g", deviation,
                    greatest);
    if (count < LEAST_ROWS || !(deviation > 0) || !(greatest > 0)) return GOUGH_OK;

    fit f = lay_out(count, time, value, component, scratch);
    double low = 0.5 / (time[count - 1] - time[0]), high = 2 / f.step;
    solve(&f, high);
    if (!within(&f, deviation, greatest)) return GOUGH_OK;
    solve(&f, low);
    if (within(&f, deviation, greatest)) high = low;
    while (high > 1.005 * low) {
        const double middle = sqrt(low * high);
        solve(&f, middle);
        if (within(&f, deviation, greatest))
            high = middle;
        else
            low = middle;
    }
    solve(&f, high);
    const gough_status given = give_back(&f, value, component, error);
    if (given == GOUGH_OK) *cutoff = high;
    return given;
}
