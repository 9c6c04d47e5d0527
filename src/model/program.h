/* The program at a time t: formulas on a small stack of jets (jet.h), minimum-jerk moves,
 * splines through samples. A text over `real`: compiled for double and for quad. The numbers of
 * a study stay doubles; π has all digits of real. */
#ifndef GOUGH_MODEL_PROGRAM_H
#define GOUGH_MODEL_PROGRAM_H

#include "gough/model.h"
#include "model/jet.h"

/* ---- formulas ---- */

enum formula_code {
    /* no operand */
    FORMULA_NUMBER,
    FORMULA_TIME,
    FORMULA_PI,
    /* one */
    FORMULA_NEGATE,
    FORMULA_SIN,
    FORMULA_COS,
    FORMULA_TAN,
    FORMULA_ASIN,
    FORMULA_ACOS,
    FORMULA_ATAN,
    FORMULA_EXP,
    FORMULA_LOG,
    FORMULA_ROOT,
    FORMULA_TANH,
    /* two */
    FORMULA_ADD,
    FORMULA_SUBTRACT,
    FORMULA_MULTIPLY,
    FORMULA_DIVIDE,
    FORMULA_POWER,
    FORMULA_ATAN2,
    FORMULA_RAMP
};

/* Which operands of an operation do not depend on t: what is constant by its form, not by chance
 * at one t. */
enum { FORMULA_FIRST_CONSTANT = 1, FORMULA_SECOND_CONSTANT = 2, FORMULA_BOTH_CONSTANT = 3 };

static inline jet formula_unary(int code, jet a) {
    switch (code) {
    case FORMULA_NEGATE:
        return jet_negate(a);
    case FORMULA_SIN:
        return jet_sin(a);
    case FORMULA_COS:
        return jet_cos(a);
    case FORMULA_TAN:
        return jet_tan(a);
    case FORMULA_ASIN:
        return jet_asin(a);
    case FORMULA_ACOS:
        return jet_acos(a);
    case FORMULA_ATAN:
        return jet_atan(a);
    case FORMULA_EXP:
        return jet_exp(a);
    case FORMULA_LOG:
        return jet_log(a);
    case FORMULA_ROOT:
        return jet_root(a);
    default:
        return jet_tanh(a);
    }
}

static inline jet formula_binary(int code, int constant, jet a, jet b) {
    switch (code) {
    case FORMULA_ADD:
        return jet_add(a, b);
    case FORMULA_SUBTRACT:
        return jet_subtract(a, b);
    case FORMULA_MULTIPLY:
        if (constant & FORMULA_FIRST_CONSTANT) return jet_scale(a.v, b);
        if (constant & FORMULA_SECOND_CONSTANT) return jet_scale(b.v, a);
        return jet_multiply(a, b);
    case FORMULA_DIVIDE:
        return jet_divide(a, b);
    case FORMULA_POWER:
        return constant & FORMULA_SECOND_CONSTANT ? jet_power(a, b.v) : jet_general_power(a, b);
    case FORMULA_ATAN2:
        return jet_atan2(a, b);
    default:
        return jet_ramp(a, b);
    }
}

/* A compiled formula of one operation or more with its derivatives at t. The compiler has bounded its stack. */
static inline jet formula_evaluate(const gough_formula *f, real t) {
    jet below[GOUGH_FORMULA_DEPTH + 1],
        x = jet_constant(0); /* the stack but for its top, and its top */
    int depth = 0;
    for (int i = 0; i < f->count; i++) {
        const int code = f->operation[i].code, constant = f->operation[i].constant;
        if (code < FORMULA_NEGATE) {
            below[depth++] = x;
            x = code == FORMULA_NUMBER ? jet_constant((real)f->operation[i].value)
                : code == FORMULA_TIME ? jet_time(t)
                                       : jet_constant(REAL_PI);
        } else if (code < FORMULA_ADD) {
            x = formula_unary(code, x);
            if (constant) x = jet_constant(x.v);
        } else {
            x = formula_binary(code, constant, below[--depth], x);
            if (constant == FORMULA_BOTH_CONSTANT) x = jet_constant(x.v);
        }
    }
    return x;
}

/* an empty formula is 0 */
KERNEL_INLINE jet formula_jet(const gough_formula *f, real t) {
    return f->count == 0 ? jet_constant(0) : formula_evaluate(f, t);
}

/* ---- moves ---- */

/* Component c after the moves up to t: between moves and after the last the targets hold. */
static inline jet moves_jet(const gough_motion *m, int c, real t) {
    real from = 0;
    for (size_t i = 0; i < m->moves; i++) {
        const gough_move *move = &m->move[i];
        if (!move->given[c]) continue;
        const real start = (real)move->start, duration = (real)move->duration;
        const real target = (real)move->target[c];
        if (t < start + duration) {
            const jet s = {(t - start) / duration, 1 / duration, 0};
            jet component = jet_scale(target - from, jet_smooth_step(s));
            component.v += from;
            return component;
        }
        from = target;
    }
    return jet_constant(from + (t - t)); /* not a number at a time that is none */
}

/* ---- samples ---- */

/* All six components of the spline at t, (motion-4). In the interval of length h between rows i
 * and i + 1, with a + b = 1 and b h the time since row i:  y = a y₀ + b y₁ + ((a³ − a) y₀'' +
 * (b³ − b) y₁'') h²/6. */
static inline void samples_jets(const gough_samples *s, real t, jet out[GOUGH_COMPONENTS]) {
    const size_t last = s->count - 1;
    if (t < (real)s->time[0] || t > (real)s->time[last]) {
        const double *held = s->value + (t < (real)s->time[0] ? 0 : last) * GOUGH_COMPONENTS;
        for (int c = 0; c < GOUGH_COMPONENTS; c++) out[c] = jet_constant((real)held[c]);
        return;
    }

    size_t low = 0, high = last; /* time[low] <= t <= time[high] */
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (t < (real)s->time[middle])
            high = middle;
        else
            low = middle;
    }

    const real h = (real)s->time[high] - (real)s->time[low];
    const real a = ((real)s->time[high] - t) / h, b = (t - (real)s->time[low]) / h;
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        const size_t k = low * GOUGH_COMPONENTS + (size_t)c, l = k + GOUGH_COMPONENTS;
        const real y0 = (real)s->value[k], y1 = (real)s->value[l];
        const real m0 = (real)s->curvature[k], m1 = (real)s->curvature[l];
        out[c].v = a * y0 + b * y1 + ((a * a - 1) * a * m0 + (b * b - 1) * b * m1) * h * h / 6;
        out[c].d = (y1 - y0) / h + ((1 - 3 * a * a) * m0 + (3 * b * b - 1) * m1) * h / 6;
        out[c].dd = a * m0 + b * m1;
    }
}

/* ---- the six components ---- */

/* Factor from a formula's angles to radians. Where it is the double next to π/180, degrees are
 * meant and π/180 is taken with all digits of real. */
static inline real motion_angle_unit(const gough_motion *m) {
    const double degree = 3.14159265358979323846 / 180, unit = m->angle_unit;
    if (fabs(unit - degree) < 1e-17) return REAL_PI / 180;
    return fabs(unit) > 0 ? (real)unit : 1;
}

/* Surge, sway, heave, roll, pitch, yaw with their derivatives at t, angles in radians, as given. */
static inline void motion_unscaled(const gough_motion *m, real t, jet out[GOUGH_COMPONENTS]) {
    if (m->kind == GOUGH_MOTION_SAMPLES) {
        samples_jets(&m->samples, t, out);
        return;
    }
    if (m->kind == GOUGH_MOTION_MOVES) {
        for (int c = 0; c < GOUGH_COMPONENTS; c++) out[c] = moves_jet(m, c, t);
        return;
    }
    for (int c = 0; c < GOUGH_COMPONENTS; c++) out[c] = formula_jet(&m->formula[c], t);
    const real unit = motion_angle_unit(m);
    for (int c = GOUGH_ROLL; c < GOUGH_COMPONENTS; c++) out[c] = jet_scale(unit, out[c]);
}

/* The same larger by the amplitude and faster by the frequency, (motion-6): a f(w t). */
static inline void motion_components(const gough_motion *m, real t, jet out[GOUGH_COMPONENTS]) {
    const real a = (real)m->amplitude, w = (real)m->frequency;
    if (!m->scaled) {
        motion_unscaled(m, t, out);
        return;
    }
    motion_unscaled(m, w * t, out);
    for (int c = 0; c < GOUGH_COMPONENTS; c++)
        out[c] = (jet){a * out[c].v, a * w * out[c].d, a * w * w * out[c].dd};
}

#endif
