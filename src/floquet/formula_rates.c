/* Rates of a formula: each value on its stack is followed as ωt + what stays bounded, exactly where it is a line in t. Theory:
 * docs/theory/floquet.md. */
#define NUMBER_DOUBLE
#include "floquet/formula_rates.h"

#include <math.h>

#include "program/program.h"

/* frequencies are given as decimal numbers: ratios as near as this to a fraction are meant to be it */
static const double same_rate = 1e-13, same_ratio = 1e-12;
enum { GREATEST_DENOMINATOR = 1000 };

/* A value on the stack: a line in t, whose value at 0 and slope are exact; or slope · t + what stays bounded; or neither. */
typedef struct {
    bool line, bounded;
    double start, slope;
} trend;

static const trend unknown = {false, false, 0, 0}, level = {false, true, 0, 0};

static bool is_constant(trend a) { return a.line && !(a.slope < 0) && !(a.slope > 0); }
static bool is_level(trend a) { return a.bounded && !(a.slope < 0) && !(a.slope > 0); }

static trend line(double start, double slope) {
    if (!isfinite(start) || !isfinite(slope)) return unknown;
    return (trend){true, true, start, slope};
}

static trend times(trend a, double factor) {
    if (a.line) return line(a.start * factor, a.slope * factor);
    a.slope *= factor;
    return isfinite(a.slope) ? a : unknown;
}

static trend sum(trend a, trend b) {
    if (!a.bounded || !b.bounded) return unknown;
    if (a.line && b.line) return line(a.start + b.start, a.slope + b.slope);
    return (trend){false, true, 0, a.slope + b.slope};
}

static trend product(trend a, trend b) {
    if (is_constant(a)) return times(b, a.start);
    if (is_constant(b)) return times(a, b.start);
    return is_level(a) && is_level(b) ? level : unknown;
}

static void note_rate(rates *found, double rate) {
    rate = fabs(rate);
    if (!(rate > 0) || !isfinite(rate)) return;
    for (size_t i = 0; i < found->count; i++)
        if (fabs(found->rate[i] - rate) <= same_rate * rate) return;
    if (found->count < RATES_MOST) found->rate[found->count++] = rate;
}

/* a line that passes `value` at some time t > 0: what hangs on it has an event there */
static void note_event(rates *found, trend a, double value) {
    const double t = (value - a.start) / a.slope;

    if (a.line && isfinite(t)) found->latest = fmax(found->latest, t);
}

static trend unary(int code, trend a, rates *found) {
    const jet at = {a.start, 0, 0};

    if (is_constant(a)) return line(formula_unary(code, at).v, 0);
    switch (code) {
    case FORMULA_NEGATE:
        return times(a, -1);
    case FORMULA_SIN:
    case FORMULA_COS:
    case FORMULA_TAN:
        if (a.bounded) note_rate(found, a.slope);
        return level;
    case FORMULA_EXP:
        note_event(found, a, 0);
        return a.bounded && a.slope <= 0 ? level : unknown;
    case FORMULA_ATAN:
    case FORMULA_TANH:
        note_event(found, a, 0);
        return level;
    case FORMULA_ASIN:
    case FORMULA_ACOS:
        return level;
    default: /* log, sqrt */
        return is_level(a) ? level : unknown;
    }
}

static trend binary(int code, trend a, trend b, rates *found) {
    const jet first = {a.start, 0, 0}, second = {b.start, 0, 0};

    if (is_constant(a) && is_constant(b))
        return line(formula_binary(code, FORMULA_BOTH_CONSTANT, first, second).v, 0);
    switch (code) {
    case FORMULA_ADD:
        return sum(a, b);
    case FORMULA_SUBTRACT:
        return sum(a, times(b, -1));
    case FORMULA_MULTIPLY:
        return product(a, b);
    case FORMULA_DIVIDE:
        if (is_constant(b)) return times(a, 1 / b.start);
        return is_level(a) ? level : unknown;
    case FORMULA_POWER:
        if (is_constant(b) && !(b.start < 1) && !(b.start > 1)) return a;
        return is_level(a) && is_level(b) ? level : unknown;
    case FORMULA_RAMP:
        note_event(found, a, 0);
        if (is_constant(b)) note_event(found, a, b.start);
        return level;
    default: /* atan2 */
        return level;
    }
}

static void follow(const gough_formula *f, rates *found) {
    trend stack[GOUGH_FORMULA_DEPTH + 1];
    int top = 0;

    for (int i = 0; i < f->count; i++) {
        const int code = f->operation[i].code;
        if (code == FORMULA_NUMBER) {
            stack[top++] = line(f->operation[i].value, 0);
        } else if (code == FORMULA_TIME) {
            stack[top++] = line(0, 1);
        } else if (code == FORMULA_PI) {
            stack[top++] = line(REAL_PI, 0);
        } else if (code < FORMULA_ADD) {
            stack[top - 1] = unary(code, stack[top - 1], found);
        } else {
            stack[top - 2] = binary(code, stack[top - 2], stack[top - 1], found);
            top--;
        }
    }
}

void rates_of_motion(const gough_motion *motion, rates *found) {
    found->count = 0;
    found->latest = 0;
    for (int c = 0; c < GOUGH_COMPONENTS; c++) follow(&motion->formula[c], found);
    if (!motion->scaled) return;
    for (size_t i = 0; i < found->count; i++) found->rate[i] *= motion->frequency;
    found->latest /= motion->frequency;
}

/* the fraction next to a ratio between 0 and 1, by its continued fraction; 0: none is near enough */
static long denominator_of(double ratio) {
    double rest = ratio;
    long p0 = 0, q0 = 1, p1 = 1, q1 = 0; /* of the two convergents before */

    while (q1 <= GREATEST_DENOMINATOR && rest < 1e15) {
        const double whole = floor(rest);
        const double p = whole * (double)p1 + (double)p0, q = whole * (double)q1 + (double)q0;
        if (q > GREATEST_DENOMINATOR) return 0;
        p0 = p1, q0 = q1, p1 = (long)p, q1 = (long)q;
        if (p1 > 0 && fabs((double)p1 / (double)q1 - ratio) <= same_ratio * ratio) return q1;
        rest = 1 / (rest - whole);
    }
    return 0;
}

static long greatest_divisor(long a, long b) {
    while (b > 0) {
        const long rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

bool rates_common_period(const rates *found, double *period, double *cycles, double apart[2]) {
    double fastest = 0;
    long multiple = 1;

    *period = *cycles = 0;
    for (size_t i = 0; i < found->count; i++) fastest = fmax(fastest, found->rate[i]);
    for (size_t i = 0; i < found->count; i++) {
        const long denominator = denominator_of(found->rate[i] / fastest);
        if (denominator > 0)
            multiple = multiple / greatest_divisor(multiple, denominator) * denominator;
        if (denominator > 0 && multiple <= GREATEST_DENOMINATOR) continue;
        apart[0] = fastest;
        apart[1] = found->rate[i];
        return false;
    }
    if (found->count == 0) return true;
    *cycles = (double)multiple;
    *period = 2 * REAL_PI * *cycles / fastest;
    return true;
}
