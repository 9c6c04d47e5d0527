/* The program at a time t: formulas on a small stack of jets (jet.h), minimum-jerk moves,
 * splines through samples. A text over `real`: compiled for double and for quad. The numbers of
 * a study stay doubles; π has all digits of real. */
#ifndef GOUGH_PROGRAM_PROGRAM_H
#define GOUGH_PROGRAM_PROGRAM_H

#include "gough/model.h"
#include "program/jet.h"

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

/* times that a formula is evaluated at together, at most: finding out what an operation is, is shared by them */
enum { FORMULA_TIMES = 16 };
typedef struct {
    real v[FORMULA_TIMES], d[FORMULA_TIMES], dd[FORMULA_TIMES];
} formula_row;

KERNEL_INLINE jet formula_get(const formula_row *a, int k) {
    return (jet){a->v[k], a->d[k], a->dd[k]};
}

KERNEL_INLINE void formula_put(formula_row *a, int k, jet x) {
    a->v[k] = x.v;
    a->d[k] = x.d;
    a->dd[k] = x.dd;
}

#define FORMULA_EACH(result)                                                                       \
    for (int k = 0; k < count; k++) formula_put(a, k, (result))
#define FORMULA_A formula_get(a, k)
#define FORMULA_B formula_get(b, k)

/* a becomes the function of a */
KERNEL_INLINE void formula_unaries(int code, int count, formula_row *a) {
    switch (code) {
    case FORMULA_NEGATE:
        FORMULA_EACH(jet_negate(FORMULA_A));
        break;
    case FORMULA_SIN:
        FORMULA_EACH(jet_sin(FORMULA_A));
        break;
    case FORMULA_COS:
        FORMULA_EACH(jet_cos(FORMULA_A));
        break;
    case FORMULA_TAN:
        FORMULA_EACH(jet_tan(FORMULA_A));
        break;
    case FORMULA_ASIN:
        FORMULA_EACH(jet_asin(FORMULA_A));
        break;
    case FORMULA_ACOS:
        FORMULA_EACH(jet_acos(FORMULA_A));
        break;
    case FORMULA_ATAN:
        FORMULA_EACH(jet_atan(FORMULA_A));
        break;
    case FORMULA_EXP:
        FORMULA_EACH(jet_exp(FORMULA_A));
        break;
    case FORMULA_LOG:
        FORMULA_EACH(jet_log(FORMULA_A));
        break;
    case FORMULA_ROOT:
        FORMULA_EACH(jet_root(FORMULA_A));
        break;
    default:
        FORMULA_EACH(jet_tanh(FORMULA_A));
    }
}

/* a becomes a combined with b */
KERNEL_INLINE void formula_binaries(int code, int constant, int count, formula_row *a,
                                    const formula_row *b) {
    switch (code) {
    case FORMULA_ADD:
        FORMULA_EACH(jet_add(FORMULA_A, FORMULA_B));
        break;
    case FORMULA_SUBTRACT:
        FORMULA_EACH(jet_subtract(FORMULA_A, FORMULA_B));
        break;
    case FORMULA_MULTIPLY:
        if (constant & FORMULA_FIRST_CONSTANT) {
            FORMULA_EACH(jet_scale(FORMULA_A.v, FORMULA_B));
        } else if (constant & FORMULA_SECOND_CONSTANT) {
            FORMULA_EACH(jet_scale(FORMULA_B.v, FORMULA_A));
        } else {
            FORMULA_EACH(jet_multiply(FORMULA_A, FORMULA_B));
        }
        break;
    case FORMULA_DIVIDE:
        FORMULA_EACH(jet_divide(FORMULA_A, FORMULA_B));
        break;
    case FORMULA_POWER:
        if (constant & FORMULA_SECOND_CONSTANT) {
            FORMULA_EACH(jet_power(FORMULA_A, FORMULA_B.v));
        } else {
            FORMULA_EACH(jet_general_power(FORMULA_A, FORMULA_B));
        }
        break;
    case FORMULA_ATAN2:
        FORMULA_EACH(jet_atan2(FORMULA_A, FORMULA_B));
        break;
    default:
        FORMULA_EACH(jet_ramp(FORMULA_A, FORMULA_B));
    }
}

static inline jet formula_unary(int code, jet x) {
    formula_row a;
    formula_put(&a, 0, x);
    formula_unaries(code, 1, &a);
    return formula_get(&a, 0);
}

static inline jet formula_binary(int code, int constant, jet x, jet y) {
    formula_row a, b;
    formula_put(&a, 0, x);
    formula_put(&b, 0, y);
    formula_binaries(code, constant, 1, &a, &b);
    return formula_get(&a, 0);
}

/* A compiled formula with its derivatives at `count` times; an empty one is 0. The compiler has bounded its stack, in which
 * each value is a row of times. */
KERNEL_INLINE void formula_evaluate(const gough_formula *f, int count, const real *t,
                                    formula_row *out) {
    formula_row stack[GOUGH_FORMULA_DEPTH + 1];
    formula_row *a = stack;

    FORMULA_EACH(jet_constant(0));
    for (int i = 0; i < f->count; i++) {
        const int code = f->operation[i].code, constant = f->operation[i].constant;
        if (code < FORMULA_NEGATE) {
            const real given = code == FORMULA_PI ? REAL_PI : (real)f->operation[i].value;
            if (i > 0) a++;
            FORMULA_EACH(code == FORMULA_TIME ? jet_time(t[k]) : jet_constant(given));
        } else if (code < FORMULA_ADD) {
            formula_unaries(code, count, a);
            if (constant) FORMULA_EACH(jet_constant(FORMULA_A.v));
        } else {
            a--;
            formula_binaries(code, constant, count, a, a + 1);
            if (constant == FORMULA_BOTH_CONSTANT) FORMULA_EACH(jet_constant(FORMULA_A.v));
        }
    }
    for (int k = 0; k < count; k++) formula_put(out, k, FORMULA_A);
}

static inline jet formula_alone(const gough_formula *f, real t) {
    formula_row x;
    formula_evaluate(f, 1, &t, &x);
    return formula_get(&x, 0);
}

/* at one time; an empty formula is 0 */
KERNEL_INLINE jet formula_jet(const gough_formula *f, real t) {
    return f->count == 0 ? jet_constant(0) : formula_alone(f, t);
}

/* at `count` times */
static inline void formula_jets(const gough_formula *f, int count, const real *t,
                                formula_row *out) {
    formula_evaluate(f, count, t, out);
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
    return jet_constant(from + (t - t)); /* NaN if the time is NaN or infinite */
}

/* Least duration of a move by a distance, (motion-13): the smooth step σ of (motion-3) has at most the slope 15/8, in the middle,
 * and the second derivative 10/√3, at τ = 1/2 ∓ 1/√12. A limit of 0 means that there is no limit. */
static inline real move_duration_by_speed(real distance, real speed) {
    return speed > 0 ? (real)15 / 8 * distance / speed : 0;
}

static inline real move_duration_by_acceleration(real distance, real acceleration) {
    return acceleration > 0 ? real_root(10 / real_root((real)3) * distance / acceleration) : 0;
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

/* The same larger by the amplitude and faster by the frequency, (motion-6): a f(w t). */
static inline jet motion_scaled(const gough_motion *m, jet f) {
    const real a = (real)m->amplitude, w = (real)m->frequency;
    return m->scaled ? (jet){a * f.v, a * w * f.d, a * w * w * f.dd} : f;
}

static inline real motion_time(const gough_motion *m, real t) {
    return m->scaled ? (real)m->frequency * t : t;
}

/* Surge, sway, heave, roll, pitch, yaw with their derivatives at t, angles in radians. */
static inline void motion_components(const gough_motion *m, real t, jet out[GOUGH_COMPONENTS]) {
    const real inner = motion_time(m, t);
    if (m->kind == GOUGH_MOTION_SAMPLES) {
        samples_jets(&m->samples, inner, out);
    } else if (m->kind == GOUGH_MOTION_MOVES) {
        for (int c = 0; c < GOUGH_COMPONENTS; c++) out[c] = moves_jet(m, c, inner);
    } else if (m->kind != GOUGH_MOTION_FORMULAS) {
        /* no kind of motion: not finite */
        for (int c = 0; c < GOUGH_COMPONENTS; c++) out[c] = (jet){NAN, NAN, NAN};
    } else {
        const real unit = motion_angle_unit(m);
        for (int c = 0; c < GOUGH_COMPONENTS; c++) out[c] = formula_jet(&m->formula[c], inner);
        for (int c = GOUGH_ROLL; c < GOUGH_COMPONENTS; c++) out[c] = jet_scale(unit, out[c]);
    }
    for (int c = 0; c < GOUGH_COMPONENTS && m->scaled; c++) out[c] = motion_scaled(m, out[c]);
}

/* The same at `count` times, a row of times for each component. */
static inline void motion_components_at(const gough_motion *m, int count, const real *t,
                                        formula_row out[GOUGH_COMPONENTS]) {
    const real unit = motion_angle_unit(m);
    real inner[FORMULA_TIMES];
    for (int k = 0; k < count && m->kind != GOUGH_MOTION_FORMULAS; k++) {
        jet component[GOUGH_COMPONENTS];
        motion_components(m, t[k], component);
        for (int c = 0; c < GOUGH_COMPONENTS; c++) formula_put(&out[c], k, component[c]);
    }
    if (m->kind != GOUGH_MOTION_FORMULAS) return;
    for (int k = 0; k < count; k++) inner[k] = motion_time(m, t[k]);
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        formula_row *a = &out[c];
        if (m->formula[c].count > 0) {
            formula_jets(&m->formula[c], count, inner, a);
            if (c >= GOUGH_ROLL) FORMULA_EACH(jet_scale(unit, FORMULA_A));
            if (m->scaled) FORMULA_EACH(motion_scaled(m, FORMULA_A));
        } else { /* the same at all times */
            const jet still = jet_constant(0);
            const jet all = motion_scaled(m, c >= GOUGH_ROLL ? jet_scale(unit, still) : still);
            for (int k = 0; k < FORMULA_TIMES; k++) formula_put(a, k, all);
        }
    }
}

/* the components at time k of such rows */
static inline void motion_components_of(const formula_row rows[GOUGH_COMPONENTS], int k,
                                        jet component[GOUGH_COMPONENTS]) {
    for (int c = 0; c < GOUGH_COMPONENTS; c++) component[c] = formula_get(&rows[c], k);
}

#endif
