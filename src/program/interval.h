/* Enclosures: between which bounds a formula and its first two derivatives lie over a whole interval of time. The rules are those
 * of jet.h, with an interval in place of each number. Bounds are not rounded outwards: they decide how closely a function must be
 * watched, for which a relative error of 1e-15 does not matter. */
#ifndef GOUGH_PROGRAM_INTERVAL_H
#define GOUGH_PROGRAM_INTERVAL_H

#include <math.h>

#include "program/program.h"

typedef struct {
    double low, high;
} interval;

typedef struct {
    interval v, d, dd; /* f, f', f'' */
} enclosure;

static const double interval_pi = 3.14159265358979323846;

/* nothing is known */
static inline interval interval_all(void) { return (interval){-INFINITY, INFINITY}; }

/* bounds that are not ordered, as those that are not numbers, bound nothing */
static inline interval interval_of(double low, double high) {
    return low <= high ? (interval){low, high} : interval_all();
}

static inline interval interval_point(double x) { return interval_of(x, x); }

static inline double interval_magnitude(interval a) { return fmax(fabs(a.low), fabs(a.high)); }

static inline interval interval_negate(interval a) { return (interval){-a.high, -a.low}; }

static inline interval interval_add(interval a, interval b) {
    return interval_of(a.low + b.low, a.high + b.high);
}

static inline interval interval_subtract(interval a, interval b) {
    return interval_add(a, interval_negate(b));
}

/* 0 times a bound that is infinite is 0: the factor vanishes, the bound only is not known */
static inline double interval_product(double a, double b) {
    const int nothing = (!(a < 0) && !(a > 0)) || (!(b < 0) && !(b > 0));
    return nothing ? 0 : a * b;
}

static inline interval interval_multiply(interval a, interval b) {
    const double p = interval_product(a.low, b.low), q = interval_product(a.low, b.high);
    const double r = interval_product(a.high, b.low), s = interval_product(a.high, b.high);
    return interval_of(fmin(fmin(p, q), fmin(r, s)), fmax(fmax(p, q), fmax(r, s)));
}

static inline interval interval_scale(double c, interval a) {
    return interval_multiply(interval_point(c), a);
}

static inline interval interval_square(interval a) {
    const double p = a.low * a.low, q = a.high * a.high;
    return interval_of(a.low < 0 && a.high > 0 ? 0 : fmin(p, q), fmax(p, q));
}

static inline interval interval_inverse(interval a) {
    return a.low > 0 || a.high < 0 ? interval_of(1 / a.high, 1 / a.low) : interval_all();
}

/* from the values of a rising function at the bounds */
static inline interval interval_rising(interval a, double (*f)(double)) {
    return interval_of(f(a.low), f(a.high));
}

static inline interval interval_sin(interval a) {
    const double turn = 2 * interval_pi, p = sin(a.low), q = sin(a.high);
    const double top = interval_pi / 2, bottom = -interval_pi / 2;
    if (!(a.high - a.low < turn)) return interval_of(-1, 1);
    const int high = top + turn * ceil((a.low - top) / turn) <= a.high;
    const int low = bottom + turn * ceil((a.low - bottom) / turn) <= a.high;
    return interval_of(low ? -1 : fmin(p, q), high ? 1 : fmax(p, q));
}

static inline interval interval_cos(interval a) {
    return interval_sin(interval_add(a, interval_point(interval_pi / 2)));
}

/* x^p */
static inline interval interval_raise(interval a, double p) {
    const double half = p / 2, whole = floor(p);
    if (p < 0) return interval_inverse(interval_raise(a, -p));
    if (whole < p) { /* defined for x >= 0 only */
        return a.high < 0 ? interval_all() : interval_of(pow(fmax(a.low, 0), p), pow(a.high, p));
    }
    const double low = pow(a.low, p), high = pow(a.high, p);
    if (floor(half) < half || !(a.low < 0)) return interval_of(low, high); /* rising */
    if (!(a.high > 0)) return interval_of(high, low);
    return interval_of(p > 0 ? 0 : 1, fmax(low, high));
}

/* ---- enclosures ---- */

static inline enclosure enclosure_constant(double c) {
    return (enclosure){interval_point(c), {0, 0}, {0, 0}};
}

static inline enclosure enclosure_negate(enclosure a) {
    return (enclosure){interval_negate(a.v), interval_negate(a.d), interval_negate(a.dd)};
}

static inline enclosure enclosure_add(enclosure a, enclosure b) {
    return (enclosure){interval_add(a.v, b.v), interval_add(a.d, b.d), interval_add(a.dd, b.dd)};
}

static inline enclosure enclosure_multiply(enclosure a, enclosure b) {
    const interval v = interval_multiply(a.v, b.v);
    const interval d = interval_add(interval_multiply(a.d, b.v), interval_multiply(a.v, b.d));
    const interval outer = interval_add(interval_multiply(a.dd, b.v), interval_multiply(a.v, b.dd));
    return (enclosure){v, d, interval_add(outer, interval_scale(2, interval_multiply(a.d, b.d)))};
}

/* f(a) from f, f', f'' over the values of a */
static inline enclosure enclosure_chain(enclosure a, interval f, interval f1, interval f2) {
    return (enclosure){
        f, interval_multiply(f1, a.d),
        interval_add(interval_multiply(f1, a.dd), interval_multiply(f2, interval_square(a.d)))};
}

static inline enclosure enclosure_inverse(enclosure a) {
    const interval f = interval_inverse(a.v), f2 = interval_square(f);
    return enclosure_chain(a, f, interval_negate(f2), interval_scale(2, interval_multiply(f2, f)));
}

/* with a half of a turn added, the cosine */
static inline enclosure enclosure_sin(enclosure a, double ahead) {
    const interval x = interval_add(a.v, interval_point(ahead)), s = interval_sin(x);
    return enclosure_chain(a, s, interval_cos(x), interval_negate(s));
}

static inline enclosure enclosure_tan(enclosure a) {
    const double half = interval_pi / 2,
                 pole = half + interval_pi * ceil((a.v.low - half) / interval_pi);
    const interval t = pole <= a.v.high ? interval_all() : interval_rising(a.v, tan);
    const interval f1 = interval_add(interval_point(1), interval_square(t));
    return enclosure_chain(a, t, f1, interval_scale(2, interval_multiply(t, f1)));
}

static inline enclosure enclosure_asin(enclosure a) {
    const interval square = interval_square(a.v);
    const interval under = interval_of(fmax(0, 1 - square.high), fmax(0, 1 - square.low));
    const interval f1 = interval_inverse(interval_rising(under, sqrt));
    const interval f2 = interval_multiply(a.v, interval_multiply(f1, interval_square(f1)));
    const interval x = interval_of(fmax(-1, a.v.low), fmin(1, a.v.high));
    return enclosure_chain(a, interval_rising(x, asin), f1, f2);
}

static inline enclosure enclosure_acos(enclosure a) {
    const enclosure half = enclosure_constant(interval_pi / 2);
    return enclosure_add(half, enclosure_negate(enclosure_asin(a)));
}

static inline enclosure enclosure_atan(enclosure a) {
    const interval f1 = interval_inverse(interval_add(interval_point(1), interval_square(a.v)));
    const interval f2 = interval_scale(-2, interval_multiply(a.v, interval_square(f1)));
    return enclosure_chain(a, interval_rising(a.v, atan), f1, f2);
}

static inline enclosure enclosure_exp(enclosure a) {
    const interval e = interval_rising(a.v, exp);
    return enclosure_chain(a, e, e, e);
}

static inline enclosure enclosure_log(enclosure a) {
    const interval f1 = interval_inverse(a.v);
    const interval f = a.v.low > 0 ? interval_rising(a.v, log) : interval_all();
    return enclosure_chain(a, f, f1, interval_negate(interval_square(f1)));
}

static inline enclosure enclosure_tanh(enclosure a) {
    const interval f = interval_rising(a.v, tanh), square = interval_square(f);
    const interval f1 = interval_of(1 - square.high, 1 - square.low);
    return enclosure_chain(a, f, f1, interval_scale(-2, interval_multiply(f, f1)));
}

/* a^p with p independent of t */
static inline enclosure enclosure_power(enclosure a, double p) {
    if (jet_vanishes(p)) return enclosure_constant(1);
    if (jet_vanishes(p - 1)) return a;
    const interval f1 = interval_scale(p, interval_raise(a.v, p - 1));
    const interval f2 = jet_vanishes(p - 2)
                            ? interval_point(2)
                            : interval_scale(p * (p - 1), interval_raise(a.v, p - 2));
    return enclosure_chain(a, interval_raise(a.v, p), f1, f2);
}

/* θ' = (x y' − y x')/r², θ'' = ((x y'' − y x'') − 2 θ' (x x' + y y'))/r² */
static inline enclosure enclosure_atan2(enclosure y, enclosure x) {
    const interval inverse =
        interval_inverse(interval_add(interval_square(x.v), interval_square(y.v)));
    const interval turn =
        interval_subtract(interval_multiply(x.v, y.d), interval_multiply(y.v, x.d));
    const interval bend =
        interval_subtract(interval_multiply(x.v, y.dd), interval_multiply(y.v, x.dd));
    const interval out = interval_add(interval_multiply(x.v, x.d), interval_multiply(y.v, y.d));
    const interval d = interval_multiply(turn, inverse);
    const interval second = interval_subtract(bend, interval_scale(2, interval_multiply(d, out)));
    return (enclosure){interval_of(-interval_pi, interval_pi), d,
                       interval_multiply(second, inverse)};
}

/* (motion-3) at one s in [0, 1]: value, and the derivatives */
static inline double interval_step(double s) { return s * s * s * (10 + s * (6 * s - 15)); }
static inline double interval_step1(double s) { return 30 * s * s * (1 - s) * (1 - s); }
static inline double interval_step2(double s) { return 60 * s * (1 - s) * (1 - 2 * s); }

/* bounds of a function over [low, high] whose extremes inside can be at `a` and `b` only */
static inline interval interval_extremes(double (*f)(double), double low, double high, double a,
                                         double b) {
    double least = fmin(f(low), f(high)), most = fmax(f(low), f(high));
    const double at[2] = {a, b};
    for (int i = 0; i < 2; i++) {
        if (!(at[i] > low && at[i] < high)) continue;
        least = fmin(least, f(at[i]));
        most = fmax(most, f(at[i]));
    }
    return interval_of(least, most);
}

/* (motion-5) */
static inline enclosure enclosure_ramp(enclosure a, enclosure rise) {
    const enclosure s = enclosure_multiply(a, enclosure_inverse(rise));
    const double low = fmin(fmax(s.v.low, 0), 1), high = fmin(fmax(s.v.high, 0), 1);
    const double bend = sqrt(3) / 6; /* 0.5 ∓ √3/6: where the second derivative is greatest */
    return enclosure_chain(s, interval_of(interval_step(low), interval_step(high)),
                           interval_extremes(interval_step1, low, high, 0.5, 0.5),
                           interval_extremes(interval_step2, low, high, 0.5 - bend, 0.5 + bend));
}

/* ---- formulas ---- */

static inline enclosure enclosure_unary(int code, enclosure a) {
    switch (code) {
    case FORMULA_NEGATE:
        return enclosure_negate(a);
    case FORMULA_SIN:
        return enclosure_sin(a, 0);
    case FORMULA_COS:
        return enclosure_sin(a, interval_pi / 2);
    case FORMULA_TAN:
        return enclosure_tan(a);
    case FORMULA_ASIN:
        return enclosure_asin(a);
    case FORMULA_ACOS:
        return enclosure_acos(a);
    case FORMULA_ATAN:
        return enclosure_atan(a);
    case FORMULA_EXP:
        return enclosure_exp(a);
    case FORMULA_LOG:
        return enclosure_log(a);
    case FORMULA_ROOT:
        return enclosure_power(a, 0.5);
    default:
        return enclosure_tanh(a);
    }
}

static inline enclosure enclosure_binary(int code, int constant, enclosure a, enclosure b) {
    switch (code) {
    case FORMULA_ADD:
        return enclosure_add(a, b);
    case FORMULA_SUBTRACT:
        return enclosure_add(a, enclosure_negate(b));
    case FORMULA_MULTIPLY:
        return enclosure_multiply(a, b);
    case FORMULA_DIVIDE:
        return enclosure_multiply(a, enclosure_inverse(b));
    case FORMULA_POWER:
        if (constant & FORMULA_SECOND_CONSTANT) return enclosure_power(a, b.v.low);
        return enclosure_exp(enclosure_multiply(b, enclosure_log(a)));
    case FORMULA_ATAN2:
        return enclosure_atan2(a, b);
    default:
        return enclosure_ramp(a, b);
    }
}

/* A formula over the times from `from` to `to` */
static inline enclosure formula_enclose(const gough_formula *f, double from, double to) {
    const enclosure time = {{from, to}, {1, 1}, {0, 0}};
    enclosure stack[GOUGH_FORMULA_DEPTH + 1] = {{{0, 0}, {0, 0}, {0, 0}}};
    int top = -1;

    for (int i = 0; i < f->count; i++) {
        const int code = f->operation[i].code, constant = f->operation[i].constant;
        if (code < FORMULA_NEGATE) {
            const double given = code == FORMULA_PI ? interval_pi : f->operation[i].value;
            stack[++top] = code == FORMULA_TIME ? time : enclosure_constant(given);
            continue;
        }
        if (code < FORMULA_ADD) {
            stack[top] = enclosure_unary(code, stack[top]);
            if (!constant) continue;
        } else {
            top--;
            stack[top] = enclosure_binary(code, constant, stack[top], stack[top + 1]);
            if (constant != FORMULA_BOTH_CONSTANT) continue;
        }
        stack[top].d = stack[top].dd = (interval){0, 0};
    }
    return stack[0];
}

#endif
