/* The end of a run: which limit is left, whether the pose is singular, and the sentence that says so. For scalar number types. */
#ifndef GOUGH_RUN_ENDS_H
#define GOUGH_RUN_ENDS_H

#include <string.h>

#include "gough/simulate.h"
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

/* all margins; for scalar number types, whose reals are numbers */
static inline void limits_margins(const struct system *r, const wanted *s, const signals *m,
                                  real determinant, const limits_side *side, real margin[MARGINS]) {
    limits_legs(r, m, margin);
    margin[MARGIN_POSE] = side->pose * determinant;
    margin[MARGIN_PROGRAM] = side->program * s->singularity.determinant;
}

/* first margin that is gone (not finite counts), or -1 */
static inline int limits_broken(const real margin[MARGINS], int from, int to) {
    for (int e = from; e < to; e++) {
        if (!(margin[e] >= 0)) return e;
    }
    return -1;
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

static inline gough_cause limits_cause(const struct system *r, int margin) {
    const gough_machine *machine = r->lane[0].machine;

    if (margin >= MARGIN_POSE) return GOUGH_END_SINGULAR;
    if (margin >= MARGIN_FORCE) return GOUGH_END_LEG_FORCE;
    if (margin >= MARGIN_SPEED) return GOUGH_END_LEG_SPEED;
    if (margin >= MARGIN_LONG) return GOUGH_END_LEG_LONG;
    return machine->platform.length_min > leg_no_length * machine->base_radius
               ? GOUGH_END_LEG_SHORT
               : GOUGH_END_LEG_NO_LENGTH;
}

/* within this share of its limit a leg counts as at it too: legs that move alike reach it together but for round-off, and but
 * for what a stepper's tolerance leaves */
static const double limits_together = 1e-6;

static inline double limits_of(const struct system *r, gough_cause cause) {
    const gough_platform *p = &r->lane[0].machine->platform;

    switch (cause) {
    case GOUGH_END_LEG_SHORT:
        return p->length_min;
    case GOUGH_END_LEG_LONG:
        return p->length_max;
    case GOUGH_END_LEG_SPEED:
        return p->speed_max;
    case GOUGH_END_LEG_FORCE:
        return p->force_max;
    default:
        return 0;
    }
}

/* the legs at the limit that margin e belongs to: bit v for leg v + 1, e's own among them */
static inline unsigned limits_together_at(const real margin[MARGINS], int e) {
    const int first = e - e % LEGS;
    unsigned which = 1u << e % LEGS;

    for (int v = 0; v < LEGS; v++) {
        if (!(margin[first + v] > (real)limits_together)) which |= 1u << v;
    }
    return which;
}

static inline int limits_lowest(unsigned which) {
    int leg = 1;

    while (leg < LEGS && !(which >> (leg - 1) & 1)) leg++;
    return leg;
}

/* which: bit v for leg v + 1, at least one */
static inline void limits_say(const struct system *r, gough_cause cause, unsigned which, double t,
                              gough_end *end) {
    end->cause = cause;
    end->time = t;
    end->leg = limits_lowest(which);
    end->legs = which;
    end->limit = limits_of(r, cause);
    if (cause == GOUGH_END_LEG_NO_LENGTH) {
        end_say(end, "leg %d has no length at t = %.9g: its joints meet, so it has no direction",
                end->leg, t);
        return;
    }
    gough_end_say(end, "", "", "", "");
}

/* an end of another kind than a leg's */
static inline void limits_no_leg(gough_end *end, gough_cause cause, double t) {
    end->cause = cause;
    end->time = t;
    end->leg = 0;
    end->legs = 0;
    end->limit = 0;
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
    if (e >= MARGIN_POSE) {
        limits_say_singular(e == MARGIN_PROGRAM, (double)t, end);
    } else {
        limits_say(r, limits_cause(r, e), limits_together_at(margin, e), (double)t, end);
    }
}

static inline gough_status limits_fault(const struct system *r, gough_end *end) {
    limits_no_leg(end, GOUGH_END_NOT_FINITE, (double)r->fault.time);
    end_say(end, "%s (value or derivatives) is not finite at t = %.9g", r->fault.what, end->time);
    return GOUGH_ERROR_INPUT;
}

#endif
