/* The one time loop: adaptive steps, and fixed steps divided at the times that no step may pass. Runs alone, runs in lanes, the
 * live page and the monodromy matrix all move through time by it. What a step means (constraints, limits, rows) is its caller's.
 * Text over the number type. Theory: docs/theory/steppers.md. */
#ifndef GOUGH_INTEGRATE_MARCH_H
#define GOUGH_INTEGRATE_MARCH_H

#include "integrate/dop853.h"
#include "integrate/fixed.h"
#include "integrate/rattle.h"
#include "integrate/rk4.h"

/* ---- one step ---- */

/* a stepper; MARCH_RATTLE + level is a composition of RATTLE of order 2 (level + 1) */
enum { MARCH_DOP853, MARCH_RK4, MARCH_RATTLE };

/* What moves: as rates of unknowns, and for RATTLE as a body under a wrench. */
typedef struct {
    int n; /* unknowns */
    rate_function rates;
    rattle rule;
    void *context; /* of `rates` */
} march_problem;

/* A step or part of a step, and where fixed steps lie. */
typedef struct {
    int method;
    real t0, h, t1; /* from t0, as long as h, to t1 */

    /* fixed steps: step k begins at origin + k length, and no step goes beyond `until` */
    real origin, length, until;

    /* where the part of a fixed step ends that begins at t; `end` is the end of the whole step */
    double (*part)(void *clock, double t, double end, double length);
    void *clock;
} march;

/* The step from m->t0, as long as m->h: from y0, whose rates are rate0, or from the body of RATTLE, to `raw`. Returns what an
 * implicit step leaves of its equation. */
KERNEL_INLINE number march_step(const march *m, const march_problem *p, dop853 *work,
                                rattle_state *carried, const number *y0, const number *rate0,
                                number *raw) {
    if (m->method == MARCH_RK4) {
        rk4_step(p->rates, p->context, p->n, m->t0, m->h, y0, rate0, raw);
    } else if (m->method == MARCH_DOP853) {
        for (int i = 0; i < p->n; i++) work->slope[0][i] = rate0[i];
        dop853_step(work, p->rates, p->context, p->n, m->t0, m->h, y0, raw);
    } else {
        return rattle_compose(&p->rule, m->method - MARCH_RATTLE, m->t0, m->h, carried);
    }
    return number_of(0);
}

/* ---- fixed steps ---- */

/* Makes the next part of fixed step k ready; 0 where the step is complete. A step is made in one part where no time lies in it
 * that no step may pass. */
KERNEL_INLINE int march_part(march *m, long long k, int part) {
    const double whole = (double)m->length;
    const int cut = fixed_is_short(k, whole, (double)m->until);
    const real end = cut ? m->until : m->origin + (real)(k + 1) * m->length;

    if (part > 0 && !(m->t1 < end)) return 0;
    m->t0 = part == 0 ? m->origin + (real)k * m->length : m->t1;
    const double to = m->part(m->clock, (double)m->t0, (double)end, whole);
    m->t1 = to < (double)end ? (real)to : end;
    m->h = part == 0 && !cut && !(to < (double)end) ? m->length : m->t1 - m->t0;
    return 1;
}

/* Fixed steps from number `from` up to `to`. `move` makes one part, number `part` of step k, whose times are set; a value other
 * than 0 ends the loop, and is returned. */
KERNEL_INLINE int march_fixed(march *m, long long from, long long to,
                              int (*move)(void *context, long long k, int part), void *context) {
    for (long long k = from; k < to; k++) {
        for (int part = 0; march_part(m, k, part); part++) {
            const int ended = move(context, k, part);
            if (ended) return ended;
        }
    }
    return 0;
}

/* ---- adaptive steps ---- */

/* What the adaptive loop asks of its caller. */
typedef struct {
    /* length of the next step, of which `wish` is what the last one proposes; 0 ends the loop. `rejected`: the last was too long */
    real (*length)(void *context, real wish, int rejected);
    real (*attempt)(void *context, real length); /* the step's error over its tolerance */
    int (*keep)(void *context); /* the step holds; a value other than 0 ends the loop */
} march_rules;

/* (step-2): steps until a rule ends the loop. *wish: proposed for the first step, and at the end for the next. */
KERNEL_INLINE void march_adaptive(const march_rules *rules, void *context, real *wish) {
    int rejected = 0;

    for (;;) {
        const real length = rules->length(context, *wish, rejected);
        if (!(length > 0)) return;
        const real error = rules->attempt(context, length), factor = dop853_factor(error);
        if (!(error <= 1)) {
            *wish = length * (factor < 1 ? factor : 1);
            rejected = 1;
            continue;
        }
        if (rules->keep(context)) return;
        /* a step that was cut short says nothing against a longer one */
        const real next = length * (rejected && factor > 1 ? 1 : factor);
        if (!(length < *wish) || factor < 1 || next > *wish) *wish = next;
        rejected = 0;
    }
}

#endif
