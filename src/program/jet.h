/* Jets in t: a value with its first and second derivative, so that velocities and accelerations
 * of a formula are exact and never differenced. A text over `real` (kernel/number.h): each rule
 * is the chain or product rule of its function, (motion-2). Outside the domain of a function,
 * and where a derivative does not exist, the result is not finite. */
#ifndef GOUGH_PROGRAM_JET_H
#define GOUGH_PROGRAM_JET_H

#include "kernel/real.h"

typedef struct jet {
    real v, d, dd; /* f, f', f'' */
} jet;

static inline jet jet_constant(real c) { return (jet){c, 0, 0}; }
static inline jet jet_time(real t) { return (jet){t, 1, 0}; }
static inline jet jet_negate(jet a) { return (jet){-a.v, -a.d, -a.dd}; }
static inline jet jet_add(jet a, jet b) { return (jet){a.v + b.v, a.d + b.d, a.dd + b.dd}; }
static inline jet jet_subtract(jet a, jet b) { return (jet){a.v - b.v, a.d - b.d, a.dd - b.dd}; }

/* exactly zero: asks for a factor that vanishes, not for a small one */
static inline int jet_vanishes(real x) { return !(x < 0) && !(x > 0) && real_finite(x); }

/* c a with c independent of t; c = 0 takes infinite derivatives with it, as the derivatives of 0
 * a(t) are 0 */
static inline jet jet_scale(real c, jet a) {
    if (jet_vanishes(c)) return (jet){c * a.v, 0, 0};
    return (jet){c * a.v, c * a.d, c * a.dd};
}

static inline jet jet_multiply(jet a, jet b) {
    return (jet){a.v * b.v, a.d * b.v + a.v * b.d, a.dd * b.v + 2 * a.d * b.d + a.v * b.dd};
}

/* q = a/b from a = q b, a' = q' b + q b', a'' = q'' b + 2 q' b' + q b'' */
static inline jet jet_divide(jet a, jet b) {
    const real v = a.v / b.v;
    const real d = (a.d - v * b.d) / b.v;
    return (jet){v, d, (a.dd - 2 * d * b.d - v * b.dd) / b.v};
}

/* f(a) from f, f', f'' at a */
static inline jet jet_chain(jet a, real f, real f1, real f2) {
    return (jet){f, f1 * a.d, f1 * a.dd + f2 * a.d * a.d};
}

static inline jet jet_sin(jet a) {
    const real s = real_sin(a.v);
    return jet_chain(a, s, real_cos(a.v), -s);
}

static inline jet jet_cos(jet a) {
    const real c = real_cos(a.v);
    return jet_chain(a, c, -real_sin(a.v), -c);
}

static inline jet jet_tan(jet a) {
    const real t = real_tan(a.v), f1 = 1 + t * t;
    return jet_chain(a, t, f1, 2 * t * f1);
}

/* asin' = (1 − a²)^(−1/2), written so that nothing cancels near ±1 */
static inline jet jet_asin(jet a) {
    const real f1 = 1 / real_root((1 - a.v) * (1 + a.v));
    return jet_chain(a, real_asin(a.v), f1, a.v * f1 * f1 * f1);
}

static inline jet jet_acos(jet a) {
    const jet s = jet_asin(a);
    return (jet){real_acos(a.v), -s.d, -s.dd};
}

static inline jet jet_atan(jet a) {
    const real f1 = 1 / (1 + a.v * a.v);
    return jet_chain(a, real_atan(a.v), f1, -2 * a.v * f1 * f1);
}

/* The angle of (x, y) with r its distance, c = x/r, s = y/r:  r θ' = c y' − s x',  r' = c x' + s
 * y', and from r² θ' = x y' − y x':  θ'' = (c y'' − s x'')/r − 2 θ' r'/r. Inline, so that who wants the angle alone
 * pays for nothing else. */
KERNEL_INLINE jet jet_atan2(jet y, jet x) {
    const real r = real_hypot(x.v, y.v), c = x.v / r, s = y.v / r;
    const real d = (c * y.d - s * x.d) / r, growth = (c * x.d + s * y.d) / r;
    return (jet){real_atan2(y.v, x.v), d, (c * y.dd - s * x.dd) / r - 2 * d * growth};
}

static inline jet jet_exp(jet a) {
    const real e = real_exp(a.v);
    return (jet){e, e * a.d, e * (a.d * a.d + a.dd)};
}

static inline jet jet_log(jet a) {
    const real d = a.d / a.v;
    return (jet){real_log(a.v), d, a.dd / a.v - d * d};
}

/* r = √a from a' = 2 r r', a'' = 2 r'² + 2 r r'' */
static inline jet jet_root(jet a) {
    const real v = real_root(a.v), d = a.d / (2 * v);
    return (jet){v, d, (a.dd - 2 * d * d) / (2 * v)};
}

/* tanh' = 4 e/(1 + e)², e = exp(−2|a|): 1 − tanh² would cancel */
static inline jet jet_tanh(jet a) {
    const real v = real_tanh(a.v), e = real_exp(-2 * real_magnitude(a.v));
    const real f1 = 4 * e / ((1 + e) * (1 + e));
    return jet_chain(a, v, f1, -2 * v * f1);
}

/* x^p for a number p: a product where p is a small whole number, so that squares and cubes are
 * exact to rounding for either sign of x; beyond 16 pow is the more accurate */
static inline real real_raise(real x, real p) {
    const real size = real_magnitude(p);
    if (jet_vanishes(p - 2)) return x * x; /* the most usual power: what follows, in short */
    if (!(size <= 16) || (real)(int)size < size) return real_pow(x, p);
    real product = 1, square = x;
    for (int n = (int)size; n > 0; n /= 2) {
        if (n % 2 == 1) product = product * square;
        square = square * square;
    }
    return p < 0 ? 1 / product : product;
}

/* a^p with p independent of t: a', a'' times p a^(p−1), a'² times p (p − 1) a^(p−2). The last
 * term is left out where its factor vanishes with p: and where a' = 0, for p > 1, because a ≥ 0
 * with a bounded a'' has a'² ≤ 2 a max a'', so that the term goes to 0 with a. */
static inline jet jet_power(jet a, real p) {
    if (jet_vanishes(p)) return jet_constant(1 + (a.v - a.v));
    if (jet_vanishes(p - 1)) return a;
    const real f1 = p * real_raise(a.v, p - 1);
    jet power = {real_raise(a.v, p), f1 * a.d, f1 * a.dd};
    if (!(p > 1 && jet_vanishes(a.d))) power.dd += p * (p - 1) * real_raise(a.v, p - 2) * a.d * a.d;
    return power;
}

/* a^b = exp(b log a), for a > 0 */
static inline jet jet_general_power(jet a, jet b) {
    const jet e = jet_multiply(b, jet_log(a));
    const real v = real_pow(a.v, b.v);
    return (jet){v, v * e.d, v * (e.d * e.d + e.dd)};
}

/* (motion-3): 10 s³ − 15 s⁴ + 6 s⁵, rising from 0 at s ≤ 0 to 1 at s ≥ 1 with two continuous
 * derivatives: the rise of least mean square jerk that starts and ends at rest */
static inline jet jet_smooth_step(jet s) {
    if (s.v <= 0) return jet_constant(0);
    if (s.v >= 1) return jet_constant(1);
    const real q = s.v * (1 - s.v);
    return jet_chain(s, s.v * s.v * s.v * (10 + s.v * (6 * s.v - 15)), 30 * q * q,
                     60 * q * (1 - 2 * s.v));
}

/* (motion-5): rises from 0 at a ≤ 0 to 1 at a ≥ rise; a rise that is not positive has no
 * meaning, so the result is not a number */
static inline jet jet_ramp(jet a, jet rise) {
    if (!(rise.v > 0)) return (jet){(real)NAN, (real)NAN, (real)NAN};
    return jet_smooth_step(jet_divide(a, rise));
}

#endif
