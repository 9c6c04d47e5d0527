/* When and how a program repeats itself: a period is proposed by its formulas or given, and then verified on the program
 * itself, with both derivatives. Angles in radians; degrees in sentences. Theory: docs/theory/floquet.md. */
#define NUMBER_DOUBLE
#include <math.h>

#include "base/quantity.h"
#include "floquet/formula_rates.h"
#include "gough/floquet.h"
#include "kernel/real.h"
#include "program/angles.h"
#include "program/program.h"
#include "program/program_valid.h"

/* What is compared: in each of some periods, chosen denser at the beginning, a number of moments spread by the golden ratio. */
enum { MOMENTS = 32, DENSE = 16, SURE = 3, ORDERS = 3 };

/* repetition is asked for up to this part of the largest value, and of each derivative */
static const double same = 1e-12;

/* and where the arguments of sines are rounded to no better than this, nothing can be told */
static const double roughest = 1e-8;

/* recorded motion closes up to the accuracy of its spline at the ends: value, rate, acceleration */
static const double same_record[ORDERS] = {1e-6, 1e-4, 1e-2};

/* A program looked at in windows of one supposed period: window k is [kT, (k + 1)T]. */
typedef struct {
    const gough_motion *motion;
    double T;
    double fastest;          /* the fastest angular rate that is known of */
    double far;              /* the window that all others are compared with */
    double scale[2][ORDERS]; /* largest values: of lengths, of angles */
} windows;

/* How far a window is from another. */
typedef struct {
    double ratio;    /* to what is let pass; at most 1 where they agree */
    double by;       /* the difference itself */
    double t, later; /* between which times */
    int component, order;
} difference;

static const char *const order_name[ORDERS] = {"value", "rate", "acceleration"};

static double moment(const windows *w, double window, int i) {
    const double place = (i + 0.5) * 0.61803398874989485 + window * 0.41421356237309515;

    return w->T * (place - floor(place));
}

static void enlarge(windows *w, double window) {
    double c[GOUGH_COMPONENTS][ORDERS];

    for (int i = 0; i < MOMENTS; i++) {
        gough_motion_evaluate(w->motion, window * w->T + moment(w, window, i), c);
        for (int k = 0; k < GOUGH_COMPONENTS; k++) {
            double *scale = w->scale[k >= GOUGH_ROLL];
            for (int o = 0; o < ORDERS; o++)
                if (isfinite(c[k][o])) scale[o] = fmax(scale[o], fabs(c[k][o]));
        }
    }
}

/* dense at first, then each a fifth further */
static double next_window(double window) {
    return window < DENSE ? window + 1 : ceil(window * 1.2);
}

static void set_windows(windows *w, const gough_motion *motion, const rates *found, double T,
                        double reach) {
    *w = (windows){.motion = motion, .T = T, .fastest = 2 * REAL_PI / T};
    for (size_t i = 0; i < found->count; i++) w->fastest = fmax(w->fastest, found->rate[i]);
    w->far = ceil(fmax(reach / w->fastest, 1.5 * found->latest + 4 * T) / T);
}

static void measure(windows *w) {
    for (double k = 0; k < w->far; k = next_window(k)) enlarge(w, k);
    enlarge(w, w->far);
    for (int group = 0; group < 2; group++) {
        const double rate = 2 * REAL_PI / w->T;
        for (int o = 1; o < ORDERS; o++)
            w->scale[group][o] = fmax(w->scale[group][o], rate * w->scale[group][o - 1]);
    }
}

/* (floquet-3): a part of the scale, and the rounding of the argument ωt of the fastest sine */
static double tolerance(const windows *w, double t) {
    return same + 4 * REAL_EPSILON * w->fastest * t;
}

static void compare(const windows *w, double t, double u, difference *worst) {
    double a[GOUGH_COMPONENTS][ORDERS], b[GOUGH_COMPONENTS][ORDERS];

    gough_motion_evaluate(w->motion, t, a);
    gough_motion_evaluate(w->motion, u, b);
    for (int k = 0; k < GOUGH_COMPONENTS; k++) {
        for (int o = 0; o < ORDERS; o++) {
            const double by = fabs(a[k][o] - b[k][o]);
            const double let_pass = tolerance(w, fmax(t, u)) * w->scale[k >= GOUGH_ROLL][o];
            const double ratio = by <= 0 ? 0 : isfinite(by) ? by / let_pass : INFINITY;
            if (ratio > worst->ratio)
                *worst = (difference){ratio, by, fmin(t, u), fmax(t, u), k, o};
        }
    }
}

/* a window against one that begins at time `other` */
static difference against(const windows *w, double window, double other) {
    difference worst = {.t = window * w->T};

    for (int i = 0; i < MOMENTS; i++) {
        const double u = moment(w, window, i);
        compare(w, window * w->T + u, other + u, &worst);
    }
    return worst;
}

static difference against_far(const windows *w, double window) {
    return against(w, window, w->far * w->T);
}

/* the far window against its first moment: whether the program rests there */
static difference against_rest(const windows *w) {
    const double begin = w->far * w->T;
    double c[GOUGH_COMPONENTS][ORDERS];
    difference worst = {.t = begin};

    for (int i = 0; i < MOMENTS; i++) {
        const double t = begin + moment(w, w->far, i);
        compare(w, begin, t, &worst);
        gough_motion_evaluate(w->motion, t, c);
        for (int k = 0; k < GOUGH_COMPONENTS; k++) {
            for (int o = 1; o < ORDERS; o++) {
                const double by = fabs(c[k][o]);
                const double ratio = by / (tolerance(w, t) * w->scale[k >= GOUGH_ROLL][o]);
                if (ratio > worst.ratio) worst = (difference){ratio, by, t, t, k, o};
            }
        }
    }
    return worst;
}

/* The first window from which on all agree with the far one, or −1 with the difference that remains. */
static double settled(const windows *w, difference *remains) {
    double fails = -1, passes = w->far, k = 0;
    int agree = 0;

    /* of a part of the period only some windows agree; two next to each other do not */
    *remains = against(w, w->far, (w->far + 1) * w->T);
    if (!(remains->ratio <= 1)) return -1;
    for (; k < w->far; k = next_window(k)) {
        const difference d = against_far(w, k);
        if (d.ratio <= 1) {
            if (agree++ == 0) passes = k;
            continue;
        }
        fails = k;
        agree = 0;
        *remains = d;
    }
    if (agree < SURE) return -1;
    while (passes - fails > 1.5) {
        const double middle = floor((fails + passes) / 2);
        if (against_far(w, middle).ratio <= 1)
            passes = middle;
        else
            fails = middle;
    }
    return passes;
}

typedef enum { RESTS, REPEATS, NEITHER, TOO_LATE } outcome;

/* What the program comes to, seen in windows of T. The nearest far window that settles it is taken, as rounding of ωt grows. */
static outcome look(const gough_motion *motion, const rates *found, double T, windows *w,
                    gough_period *period, difference *remains) {
    static const double reach[] = {1e3, 1e4, 1e5};

    for (size_t i = 0; i < sizeof reach / sizeof reach[0]; i++) {
        double first;
        set_windows(w, motion, found, T, reach[i]);
        if (!(tolerance(w, w->far * T) <= roughest)) return TOO_LATE;
        measure(w);
        first = settled(w, remains);
        if (first < 0) continue;
        first = fmax(first, ceil(found->latest / T - 1e-9));
        *period = (gough_period){.start = first * T, .period = T};
        if (against_rest(w).ratio > 1) return REPEATS;
        *period = (gough_period){.resting = true, .start = first * T};
        return RESTS;
    }
    return NEITHER;
}

/* T over small primes, as long as that is a period too: sin² has half the period of sin */
static void shorten(const gough_motion *motion, const rates *found, windows *w,
                    gough_period *period) {
    static const double prime[] = {2, 3, 5, 7, 11, 13};

    for (size_t i = 0; i < sizeof prime / sizeof prime[0];) {
        const double T = period->period / prime[i], far = w->far * w->T;
        gough_period shorter;
        difference remains;
        windows closer;
        if (against(w, w->far, far + T).ratio <= 1 &&
            look(motion, found, T, &closer, &shorter, &remains) == REPEATS) {
            *period = shorter;
            *w = closer;
        } else {
            i++;
        }
    }
}

/* ---- sentences ---- */

static double shown(const difference *d) {
    return d->component >= GOUGH_ROLL ? d->by * 180 / REAL_PI : d->by;
}
static const char *unit(const difference *d) {
    static const char *const of_length[ORDERS] = {IN_LENGTH, IN_SPEED, IN_ACCELERATION};
    static const char *const of_angle[ORDERS] = {IN_DEGREES " (degrees)",
                                                 IN_DEGREES_PER_TIME " (degrees)",
                                                 IN_DEGREES_PER_TIME_SQUARED " (degrees)"};
    return d->component >= GOUGH_ROLL ? of_angle[d->order] : of_length[d->order];
}

static gough_status check_finite(const windows *w, gough_error *error) {
    double c[GOUGH_COMPONENTS][ORDERS];

    for (double k = 0; k <= w->far; k = k < w->far ? fmin(next_window(k), w->far) : k + 1) {
        for (int i = 0; i < MOMENTS; i++) {
            const double t = k * w->T + moment(w, k, i);
            gough_motion_evaluate(w->motion, t, c);
            for (int component = 0; component < GOUGH_COMPONENTS; component++) {
                if (isfinite(c[component][0] + c[component][1] + c[component][2])) continue;
                return gough_fail(error, GOUGH_ERROR_INPUT,
                                  "motion.%s is not finite at t = %.9g" IN_TIME
                                  ", so its stability cannot be computed",
                                  gough_component_name(component), t);
            }
        }
    }
    return GOUGH_OK;
}

static gough_status too_late(const windows *w, gough_error *error) {
    return gough_fail(
        error, GOUGH_ERROR_INPUT,
        "the motion would have to be followed to t = %.3g" IN_TIME " to check that it repeats "
        "with the period %.9g" IN_TIME "; at such times its fastest sine, of angular frequency "
        "%.9g" IN_RATE ", has no accurate digits left",
        w->far * w->T, w->T, w->fastest);
}

static gough_status not_periodic(const windows *w, const difference *d, bool proposed,
                                 gough_error *error) {
    if (check_finite(w, error) != GOUGH_OK) return GOUGH_ERROR_INPUT;
    if (!proposed)
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "motion.%s neither comes to rest nor repeats: it has no sine or cosine "
                          "of a multiple of t, and from t = %.6g" IN_TIME " to %.6g" IN_TIME
                          " its %s changes by %.3g%s; "
                          "write it with sines or cosines, or give motion.period",
                          gough_component_name(d->component), d->t, d->later, order_name[d->order],
                          shown(d), unit(d));
    return gough_fail(error, GOUGH_ERROR_INPUT,
                      "motion.%s does not repeat: its sines have the common period %.9g" IN_TIME
                      ", but from "
                      "t = %.6g" IN_TIME " to %.6g" IN_TIME
                      ", a whole number of periods later, its %s changes by "
                      "%.3g%s; remove trends and terms that die out too slowly",
                      gough_component_name(d->component), w->T, d->t, d->later,
                      order_name[d->order], shown(d), unit(d));
}

static gough_status no_common_period(const double apart[2], gough_error *error) {
    return gough_fail(
        error, GOUGH_ERROR_INPUT,
        "the motion has no period: the ratio of its angular frequencies %.9g" IN_RATE " and "
        "%.9g" IN_RATE " is not one of whole numbers up to 1000; choose frequencies in a simple "
        "ratio or, if one of them dies out, give motion.period",
        apart[0], apart[1]);
}

/* by how much the program misses after the period given, from `start` on */
static gough_status wrong_period(const windows *given, double start, const gough_period *right,
                                 gough_error *error) {
    const double T = given->T;
    difference d = {.t = start};

    for (int i = 0; i < MOMENTS; i++)
        compare(given, start + moment(given, 0, i), start + moment(given, 0, i) + T, &d);
    if (right != NULL)
        return gough_fail(
            error, GOUGH_ERROR_INPUT,
            "motion.period = %.16g" IN_TIME " is not a period of motion.%s: after it, the %s "
            "differs by %.3g%s (at t = %.6g" IN_TIME "); the period found from the formulas is "
            "%.16g" IN_TIME ": give that, or omit motion.period",
            T, gough_component_name(d.component), order_name[d.order], shown(&d), unit(&d), d.t,
            right->period);
    return gough_fail(error, GOUGH_ERROR_INPUT,
                      "motion.period = %.16g" IN_TIME
                      " is not a period of motion.%s: after it, the %s differs by %.3g%s "
                      "(at t = %.6g" IN_TIME "); no other period was found from its formulas",
                      T, gough_component_name(d.component), order_name[d.order], shown(&d),
                      unit(&d), d.t);
}

/* ---- the kinds of motion ---- */

static gough_status period_of_formulas(const gough_motion *motion, gough_period *period,
                                       gough_error *error) {
    const bool given = motion->period > 0;
    double T, cycles, apart[2];
    difference remains = {.ratio = 0};
    gough_period other;
    outcome seen;
    windows w;
    rates found;

    rates_of_motion(motion, &found);
    const bool common = rates_common_period(&found, &T, &cycles, apart);
    const bool proposed = common && T > 0;
    if (given) {
        seen = look(motion, &found, motion->period, &w, period, &remains);
        if (seen == TOO_LATE) return too_late(&w, error);
        if (seen != NEITHER) return GOUGH_OK;
        if (check_finite(&w, error) != GOUGH_OK) return GOUGH_ERROR_INPUT;
        const windows wrong = w;
        if (proposed && look(motion, &found, T, &w, &other, &remains) == REPEATS) {
            shorten(motion, &found, &w, &other);
            return wrong_period(&wrong, other.start, &other, error);
        }
        return wrong_period(&wrong, wrong.far * wrong.T, NULL, error);
    }

    /* without a period proposed it can only come to rest: looked at in windows of the slowest sine, or of the unit of time */
    if (!proposed) T = found.count > 0 ? 2 * REAL_PI / fmin(apart[0], apart[1]) : 1;
    seen = look(motion, &found, T, &w, period, &remains);
    if (seen == RESTS) return GOUGH_OK;
    if (seen == TOO_LATE) return too_late(&w, error);
    if (!common) return no_common_period(apart, error);
    if (seen == NEITHER || !proposed) return not_periodic(&w, &remains, proposed, error);
    shorten(motion, &found, &w, period);
    return GOUGH_OK;
}

static gough_status period_of_moves(const gough_motion *motion, gough_period *period) {
    double end = 0;

    for (size_t i = 0; i < motion->moves; i++)
        end = fmax(end, motion->move[i].start + motion->move[i].duration);
    *period =
        (gough_period){.resting = true, .start = motion->scaled ? end / motion->frequency : end};
    return GOUGH_OK;
}

static bool record_rests(const gough_samples *s) {
    for (size_t i = GOUGH_COMPONENTS; i < s->count * GOUGH_COMPONENTS; i++)
        if (fabs(s->value[i] - s->value[i - GOUGH_COMPONENTS]) > 0) return false;
    return true;
}

/* the components of a record as its spline has them: about turned axes where it has those */
static void recorded(const gough_motion *motion, double t, double out[GOUGH_COMPONENTS][ORDERS]) {
    jet component[GOUGH_COMPONENTS];

    motion_components(motion, t, component);
    for (int k = 0; k < GOUGH_COMPONENTS; k++) {
        out[k][0] = component[k].v;
        out[k][1] = component[k].d;
        out[k][2] = component[k].dd;
    }
}

/* the last period of the record, whose end must meet its beginning */
static gough_status period_of_record(const gough_motion *motion, gough_period *period,
                                     gough_error *error) {
    const gough_samples *s = &motion->samples;
    const double speed = motion->scaled ? motion->frequency : 1;
    const double first = s->time[0] / speed, last = s->time[s->count - 1] / speed;
    const double T = motion->period, start = last - T;
    double a[GOUGH_COMPONENTS][ORDERS], b[GOUGH_COMPONENTS][ORDERS];
    windows w = {.motion = motion, .T = T};
    const bool turned = motion_frame(motion).axes != NULL;

    *period = (gough_period){.resting = record_rests(s), .start = fmax(first, 0)};
    if (period->resting) return GOUGH_OK;
    if (!(T > 0))
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "the period of recorded motion cannot be found from formulas; give "
                          "motion.period, and a record whose last period ends as it begins");
    if (start < fmax(first, 0) - 1e-9 * T)
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "motion.period = %.9g" IN_TIME
                          " is longer than the record, which extends from t = %.9g" IN_TIME
                          " to %.9g" IN_TIME,
                          T, first, last);
    *period = (gough_period){.start = fmax(start, fmax(first, 0)), .period = T};
    w.far = 0;
    for (int i = 0; i < MOMENTS; i++) {
        recorded(motion, period->start + moment(&w, 0, i), a);
        for (int k = 0; k < GOUGH_COMPONENTS; k++)
            for (int o = 0; o < ORDERS; o++)
                w.scale[k >= GOUGH_ROLL][o] = fmax(w.scale[k >= GOUGH_ROLL][o], fabs(a[k][o]));
    }
    recorded(motion, period->start, a);
    recorded(motion, last, b);
    for (int k = 0; k < GOUGH_COMPONENTS; k++) {
        for (int o = 0; o < ORDERS; o++) {
            const difference d = {0, fabs(a[k][o] - b[k][o]), period->start, last, k, o};
            if (d.by <= same_record[o] * w.scale[k >= GOUGH_ROLL][o]) continue;
            return gough_fail(
                error, GOUGH_ERROR_INPUT,
                "the record does not repeat: at its end, t = %.9g" IN_TIME ", the %s of %s "
                "%sdiffers by %.3g%s from that a period of %.9g" IN_TIME " earlier; give a "
                "record that closes, or the correct period",
                last, order_name[o], gough_component_name(k),
                turned && k >= GOUGH_ROLL ? "about turned axes " : "", shown(&d), unit(&d), T);
        }
    }
    return GOUGH_OK;
}

gough_status gough_motion_period(const gough_motion *motion, gough_period *period,
                                 gough_error *error) {
    const gough_status status = motion_check(motion, error);

    if (status != GOUGH_OK) return status;
    if (motion->kind == GOUGH_MOTION_MOVES) return period_of_moves(motion, period);
    if (motion->kind == GOUGH_MOTION_SAMPLES) return period_of_record(motion, period, error);
    return period_of_formulas(motion, period, error);
}
