/* The end of a run: which limit is left, whether the pose is singular, and the sentence that says so. For scalar number types. */
#ifndef GOUGH_RUN_ENDS_H
#define GOUGH_RUN_ENDS_H

#include <string.h>

#include "gough/simulate.h"
#include "plant/roll_pitch_yaw.h"
#include "run/margins.h"

/* the sentence of an end, as gough_fail() writes it: numbers with a point, whatever the locale */
static inline void end_copy(gough_end *end, const gough_error *said) {
    memcpy(end->message, said->message, sizeof end->message);
    end->message[sizeof end->message - 1] = '\0';
}
#define end_say(end, ...)                                                                          \
    do {                                                                                           \
        gough_error said;                                                                          \
        (void)gough_fail(&said, GOUGH_ERROR_NUMERICAL, __VA_ARGS__);                               \
        end_copy(end, &said);                                                                      \
    } while (0)

/* signs of the determinants at the beginning: a run that changes them has passed a singular pose */
typedef struct {
    real pose, program;
} limits_side;

static inline real limits_sign(real determinant) { return determinant < 0 ? -1 : 1; }

static inline limits_side limits_begin(const struct system *r, const wanted *s, const signals *m) {
    return (limits_side){limits_sign(limits_pose(r, m).determinant),
                         limits_sign(s->singularity.determinant)};
}

/* the angles of the platform among its components, and their margins */
static inline void limits_angles(const limit_set *s, int order, measured *q, real margin[MARGINS]) {
    if (!limit_has(s, LIMIT_POSE_LOW)) return;
    rotation_angles(order, &q->R, q->component[0] + 3);
    for (int c = 3; c < GOUGH_COMPONENTS; c++)
        limits_component(s, 0, c, q->component[0][c], margin);
}

/* all margins, and what they are of; for scalar number types, whose reals are numbers */
static inline void limits_margins(const struct system *r, const wanted *s, const signals *m,
                                  real determinant, const limits_side *side, measured *q,
                                  real margin[MARGINS]) {
    limits_measure(r, m, q);
    limits_fill(r, m, q, margin);
    limits_angles(&r->limits, (int)r->motion->order, q, margin);
    margin[MARGIN_SINGULAR] = side->pose * determinant;
    margin[MARGIN_PROGRAM] = side->program * s->singularity.determinant;
}

/* whether margin e is one of this run */
static inline int limits_has_margin(const struct system *r, int e) {
    return e >= MARGIN_SINGULAR || limit_has(&r->limits, e / LIMIT_SIX);
}

/* first margin that is gone (not finite counts), or -1 */
static inline int limits_broken(const struct system *r, const real margin[MARGINS]) {
    for (int kind = 0; kind < LIMIT_KINDS; kind++) {
        if (!limit_has(&r->limits, kind)) continue;
        for (int e = LIMIT_SIX * kind; e < LIMIT_SIX * (kind + 1); e++)
            if (!(margin[e] >= 0)) return e;
    }
    if (!(margin[MARGIN_SINGULAR] >= 0)) return MARGIN_SINGULAR;
    return margin[MARGIN_PROGRAM] >= 0 ? -1 : MARGIN_PROGRAM;
}

/* whether a pose is nearly singular; `pose`: its pivots, which mostly tell that it is far from that */
static inline int limits_pose_nearly_singular(const struct system *r, const signals *m,
                                              const elimination *pose) {
    return !(pose->pivot_ratio >= (real)suspicious_pivots) &&
           !(legs_condition(&r->h, &m->x, &m->g) <= (real)greatest_condition);
}

/* whether the pose at t, or the pose of a program whose forces are asked for, is nearly singular */
static inline int limits_nearly_singular(struct system *r, real t, const signals *m,
                                         const elimination *pose) {
    if (limits_pose_nearly_singular(r, m, pose)) return 1;
    if (!(system_wanted(r, t)->singularity.pivot_ratio < (real)suspicious_pivots)) return 0;
    const wanted *s = system_whole(r, t);
    return !(legs_condition(&r->h, &s->x[0], &s->program) <= (real)greatest_condition);
}

/* The cause of an end at a limit of this kind. */
static inline gough_cause limits_kind_cause(int kind) {
    static const gough_cause cause[LIMIT_KINDS] = {
        [LIMIT_SHORT] = GOUGH_END_LEG_SHORT,
        [LIMIT_LONG] = GOUGH_END_LEG_LONG,
        [LIMIT_SPEED] = GOUGH_END_LEG_SPEED,
        [LIMIT_FORCE] = GOUGH_END_LEG_FORCE,
        [LIMIT_PULL] = GOUGH_END_LEG_FORCE,
        [LIMIT_ACCELERATION] = GOUGH_END_LEG_ACCELERATION,
        [LIMIT_BASE_SWING] = GOUGH_END_BASE_SWING,
        [LIMIT_TOP_SWING] = GOUGH_END_TOP_SWING,
        [LIMIT_POSE_LOW] = GOUGH_END_PLATFORM_POSE,
        [LIMIT_POSE_HIGH] = GOUGH_END_PLATFORM_POSE,
        [LIMIT_RATE_LOW] = GOUGH_END_PLATFORM_SPEED,
        [LIMIT_RATE_HIGH] = GOUGH_END_PLATFORM_SPEED,
        [LIMIT_SECOND_LOW] = GOUGH_END_PLATFORM_ACCELERATION,
        [LIMIT_SECOND_HIGH] = GOUGH_END_PLATFORM_ACCELERATION,
    };

    return cause[kind];
}

static inline gough_cause limits_cause(const struct system *r, int e) {
    const gough_machine *machine = r->lane[0].machine;

    if (e >= MARGIN_SINGULAR) return GOUGH_END_SINGULAR;
    if (e < LIMIT_SIX * LIMIT_LONG &&
        !(r->limits.given.length[e][0] > leg_no_length * machine->base_radius))
        return GOUGH_END_LEG_NO_LENGTH;
    return limits_kind_cause(e / LIMIT_SIX);
}

/* whether the limit of margin e is a least value; of lengths the cause tells */
static inline int limits_is_least(int e) {
    const int kind = e / LIMIT_SIX;

    return kind == LIMIT_PULL || kind == LIMIT_POSE_LOW || kind == LIMIT_RATE_LOW ||
           kind == LIMIT_SECOND_LOW;
}

/* the limit of margin e */
static inline double limits_of(const struct system *r, int e) {
    const gough_limits *l = &r->limits.given;
    const int kind = e / LIMIT_SIX, i = e % LIMIT_SIX;

    switch (kind) {
    case LIMIT_SHORT:
    case LIMIT_LONG:
        return l->length[i][kind == LIMIT_LONG];
    case LIMIT_SPEED:
        return l->speed[i];
    case LIMIT_FORCE:
    case LIMIT_PULL:
        return l->force[i][kind == LIMIT_FORCE];
    case LIMIT_ACCELERATION:
        return l->acceleration[i];
    case LIMIT_BASE_SWING:
        return l->base_swing[i];
    case LIMIT_TOP_SWING:
        return l->top_swing[i];
    case LIMIT_POSE_LOW:
    case LIMIT_POSE_HIGH:
        return l->pose[i][kind == LIMIT_POSE_HIGH];
    case LIMIT_RATE_LOW:
    case LIMIT_RATE_HIGH:
        return l->rate[i][kind == LIMIT_RATE_HIGH];
    default:
        return l->second_rate[i][kind == LIMIT_SECOND_HIGH];
    }
}

/* within this share of its limit a leg counts as at it too: legs that move alike reach it together but for round-off, and but
 * for what a stepper's tolerance leaves */
static const double limits_together = 1e-6;

/* the legs at the limit that margin e belongs to: bit v for leg v + 1, e's own among them; 0 for a limit of the platform */
static inline unsigned limits_together_at(const struct system *r, const real margin[MARGINS],
                                          int e) {
    const int first = e - e % LIMIT_SIX;
    const double limit = limits_of(r, e);
    unsigned which = 1u << e % LIMIT_SIX;

    if (e / LIMIT_SIX >= LIMIT_LEG_KINDS) return 0;
    for (int v = 0; v < LEGS; v++) {
        const double other = limits_of(r, first + v);
        if (other < limit || other > limit) continue;
        if (!(margin[first + v] > (real)limits_together)) which |= 1u << v;
    }
    return which;
}

static inline int limits_lowest(unsigned which) {
    int leg = 1;

    while (leg < LEGS && !(which >> (leg - 1) & 1)) leg++;
    return leg;
}

/* an end of another kind than a limit */
static inline void limits_no_leg(gough_end *end, gough_cause cause, double t) {
    *end = (gough_end){.cause = cause, .time = t};
}

/* both joints of leg v meet */
static inline void limits_say_no_length(int v, double t, gough_end *end) {
    limits_no_leg(end, GOUGH_END_LEG_NO_LENGTH, t);
    end->leg = v + 1;
    end->legs = 1u << v;
    end_say(end, "leg %d has no length at t = %.9g: its joints meet, so it has no direction",
            end->leg, t);
}

/* the end at the limit of margin e; which: the legs at it, bit v for leg v + 1 */
static inline void limits_say(const struct system *r, int e, unsigned which, double t,
                              gough_end *end) {
    static const gough_end_words none = {"", "", "", "", "", "", "", ""};
    const gough_cause cause = limits_cause(r, e);

    if (cause == GOUGH_END_LEG_NO_LENGTH) {
        limits_say_no_length(limits_lowest(which) - 1, t, end);
        end->legs = which;
        return;
    }
    limits_no_leg(end, cause, t);
    end->leg = which ? limits_lowest(which) : 0;
    end->legs = which;
    end->component = which ? 0 : e % LIMIT_SIX + 1;
    end->least = limits_is_least(e) != 0;
    end->limit = limits_of(r, e);
    gough_end_say(end, &none);
}

static inline void limits_say_singular(int of_program, double t, gough_end *end) {
    limits_no_leg(end, GOUGH_END_SINGULAR, t);
    end_say(end,
            "%s is singular at t = %.9g: there the six legs cannot carry every load, and leg "
            "forces are not defined",
            of_program ? "the program's pose" : "the pose", t);
}

/* the end where margin e is the first of those that are gone */
static inline void limits_end(const struct system *r, const real margin[MARGINS], int e, real t,
                              gough_end *end) {
    if (e >= MARGIN_SINGULAR) {
        limits_say_singular(e == MARGIN_PROGRAM, (double)t, end);
    } else {
        limits_say(r, e, limits_together_at(r, margin, e), (double)t, end);
    }
}

static inline gough_status limits_fault(const struct system *r, gough_end *end) {
    limits_no_leg(end, GOUGH_END_NOT_FINITE, (double)r->fault.time);
    end_say(end, "%s (value or derivatives) is not finite at t = %.9g", r->fault.what, end->time);
    return GOUGH_ERROR_INPUT;
}

/* the same at a sample at t, which may ask for the program of a later time: then nothing is wrong with the run up to t */
static inline gough_status limits_fault_ahead(const struct system *r, real t, gough_end *end) {
    if (!(r->fault.time > t)) return limits_fault(r, end);
    limits_no_leg(end, GOUGH_END_NOT_FINITE, (double)t);
    end_say(end,
            "%s (value or derivatives) is not finite at t = %.9g, whose program force the preview "
            "of the sample at t = %.9g asks for",
            r->fault.what, (double)r->fault.time, end->time);
    return GOUGH_ERROR_INPUT;
}

#endif
