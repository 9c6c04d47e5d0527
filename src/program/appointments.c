/* Corners of a study, and how closely each of its formulas must be watched. Theory: docs/theory/steppers.md. */
#define NUMBER_DOUBLE
#include "program/appointments.h"

#include <string.h>

#include "program/interval.h"

/* (step-7): a function whose second derivative is constant has sup |f''| δ² = 8 V in the middle of its rise and 4 V
 * over it; twice that leaves room for bounds that are not tight */
static const double slow = 16;

/* differences below this part of the largest so far are not watched */
static const double small_part = 1e-6;

/* the shortest piece is this part of an output step: a fifth of the narrowest pulse that must be met */
static const double least_part = 1.0 / 512;

/* A fixed step has no estimate of its error. One that is a quarter of each piece at most, and of the time between two
 * corners, is taken as it is; one that is longer is made in sixteen parts a piece, with which methods of order 4 keep three
 * digits of a pulse. */
static const double met_share = 1.0 / 4, part_share = 1.0 / 16;

/* corners nearer than this to an end of a fixed step, as a part of the step, are at that end */
static const double near_part = 1e-9;

/* ---- what a formula is like, without a time ---- */

typedef enum { CONSTANT, AFFINE, POLYNOMIAL, ANYTHING } form;

/* a value on the stack: constant β, affine α t + β, piecewise polynomial of t, anything else */
typedef struct {
    form form;
    double a, b;
} shape;

/* the earliest corner after a time, of those found so far */
typedef struct {
    double after, next;
} corner_search;

static void offer(corner_search *c, double t) {
    if (t > c->after && t < c->next) c->next = t;
}

static form joined(shape x, shape y) {
    const form more = x.form > y.form ? x.form : y.form;
    return more < POLYNOMIAL ? POLYNOMIAL : more;
}

static shape shape_of_unary(int code, shape x) {
    if (x.form == CONSTANT) {
        return (shape){CONSTANT, 0, formula_unary(code, jet_constant(x.b)).v};
    }
    if (code == FORMULA_NEGATE) return (shape){x.form, -x.a, -x.b};
    return (shape){ANYTHING, 0, 0};
}

/* a ramp begins where its argument is 0 and ends where it is the rise */
static shape shape_of_ramp(shape x, shape rise, corner_search *c) {
    if (x.form != AFFINE || rise.form != CONSTANT) return (shape){ANYTHING, 0, 0};
    offer(c, -x.b / x.a);
    offer(c, (rise.b - x.b) / x.a);
    return (shape){POLYNOMIAL, 0, 0};
}

static shape shape_of_binary(int code, shape x, shape y, corner_search *c) {
    const int affine = x.form <= AFFINE && y.form <= AFFINE;

    if (x.form == CONSTANT && y.form == CONSTANT) {
        const jet value =
            formula_binary(code, FORMULA_BOTH_CONSTANT, jet_constant(x.b), jet_constant(y.b));
        return (shape){CONSTANT, 0, value.v};
    }
    switch (code) {
    case FORMULA_ADD:
        return affine ? (shape){AFFINE, x.a + y.a, x.b + y.b} : (shape){joined(x, y), 0, 0};
    case FORMULA_SUBTRACT:
        return affine ? (shape){AFFINE, x.a - y.a, x.b - y.b} : (shape){joined(x, y), 0, 0};
    case FORMULA_MULTIPLY:
        if (x.form == CONSTANT) return (shape){y.form, x.b * y.a, x.b * y.b};
        if (y.form == CONSTANT) return (shape){x.form, x.a * y.b, x.b * y.b};
        return (shape){joined(x, y), 0, 0};
    case FORMULA_DIVIDE:
        if (y.form != CONSTANT) return (shape){ANYTHING, 0, 0};
        return (shape){x.form, x.a / y.b, x.b / y.b};
    case FORMULA_POWER:
        if (y.form == CONSTANT && y.b >= 1 && y.b <= 4 && !(floor(y.b) < y.b)) {
            return (shape){joined(x, y), 0, 0};
        }
        return (shape){ANYTHING, 0, 0};
    case FORMULA_RAMP:
        return shape_of_ramp(x, y, c);
    default:
        return (shape){ANYTHING, 0, 0};
    }
}

/* The form of a formula. Its corners are offered to the search. */
static form formula_form(const gough_formula *f, corner_search *c) {
    shape stack[GOUGH_FORMULA_DEPTH + 1] = {{CONSTANT, 0, 0}};
    int top = -1;

    for (int i = 0; i < f->count; i++) {
        const int code = f->operation[i].code;
        if (code == FORMULA_TIME) {
            stack[++top] = (shape){AFFINE, 1, 0};
        } else if (code < FORMULA_NEGATE) {
            stack[++top] =
                (shape){CONSTANT, 0, code == FORMULA_PI ? interval_pi : f->operation[i].value};
        } else if (code < FORMULA_ADD) {
            stack[top] = shape_of_unary(code, stack[top]);
        } else {
            top--;
            stack[top] = shape_of_binary(code, stack[top], stack[top + 1], c);
        }
    }
    return stack[0].form;
}

/* ---- the formulas of a study ---- */

/* formula number i of a disturbance */
static const gough_formula *disturbing(const gough_disturbance *d, int i) {
    if (i < GOUGH_LEGS) return &d->leg_force[i];
    if (i == GOUGH_LEGS) return &d->vertical_force;
    i -= GOUGH_LEGS + 1;
    return i < 3 ? &d->force[i] : &d->moment[i - 3];
}
enum { DISTURBING = GOUGH_LEGS + 7 };

/* formula number i of a machine's external loads, six of each */
static const gough_formula *loading(const gough_machine *m, int i) {
    const gough_external *e = &m->external[i / 6];

    return i % 6 < 3 ? &e->force[i % 6] : &e->moment[i % 6 - 3];
}
static int loadings(const gough_machine *m) { return m ? 6 * (int)m->externals : 0; }

static void watch(appointments *a, const gough_formula *formula) {
    corner_search none = {0, 0};

    if (formula_form(formula, &none) != ANYTHING) return;
    a->formula[a->functions++] = formula;
}

static void watch_all(appointments *a) {
    const gough_motion *m = a->motion;

    a->functions = a->recorded = 0;
    if (m && m->kind == GOUGH_MOTION_SAMPLES) {
        a->recorded = 1;
        for (int c = 0; c < GOUGH_COMPONENTS; c++) a->formula[c] = NULL;
        a->functions = GOUGH_COMPONENTS;
    } else if (m && m->kind == GOUGH_MOTION_FORMULAS) {
        for (int c = 0; c < GOUGH_COMPONENTS; c++) watch(a, &m->formula[c]);
    }
    a->paced = a->functions;
    for (int i = 0; a->disturbance && i < DISTURBING; i++) watch(a, disturbing(a->disturbance, i));
    for (int i = 0; i < loadings(a->machine); i++) watch(a, loading(a->machine, i));
}

/* the time of function i in a unit of time */
static double pace_of(const appointments *a, int i) { return i < a->paced ? a->pace : 1; }

static bool noisy(const gough_noise *n) {
    return n->interval > 0 && (n->leg_force > 0 || n->force > 0 || n->moment > 0);
}

/* whether two formulas are the same, or both do not depend on time */
static bool alike(const gough_formula *f, const gough_formula *g) {
    corner_search none = {0, 0};
    bool same = f->count == g->count;

    for (int k = 0; same && k < f->count; k++) {
        same = f->operation[k].code == g->operation[k].code &&
               memcmp(&f->operation[k].value, &g->operation[k].value, sizeof(double)) == 0;
    }
    return same || (formula_form(f, &none) == CONSTANT && formula_form(g, &none) == CONSTANT);
}

bool appointments_same(const gough_disturbance *one, const gough_disturbance *two) {
    if (one == two) return true;
    if (noisy(&one->noise) != noisy(&two->noise)) return false;
    for (int i = 0; i < DISTURBING; i++) {
        if (!alike(disturbing(one, i), disturbing(two, i))) return false;
    }
    return true;
}

bool appointments_same_loads(const gough_machine *one, const gough_machine *two) {
    if (one->external == two->external) return true;
    if (one->externals != two->externals) return false;
    for (int i = 0; i < loadings(one); i++) {
        if (!alike(loading(one, i), loading(two, i))) return false;
    }
    return true;
}

/* ---- corners ---- */

/* of the program, in its own time */
static void offer_program(const gough_motion *m, corner_search *c) {
    if (m->kind == GOUGH_MOTION_SAMPLES) {
        offer(c, m->samples.time[0]);
        offer(c, m->samples.time[m->samples.count - 1]);
    } else if (m->kind == GOUGH_MOTION_MOVES) {
        for (size_t i = 0; i < m->moves; i++) {
            offer(c, m->move[i].start);
            offer(c, m->move[i].start + m->move[i].duration);
        }
    } else {
        for (int i = 0; i < GOUGH_COMPONENTS; i++) (void)formula_form(&m->formula[i], c);
    }
}

static void offer_noise(const gough_noise *n, corner_search *c) {
    if (!noisy(n)) return;
    const double knot = floor(c->after / n->interval);
    offer(c, (knot + 1) * n->interval);
    offer(c, (knot + 2) * n->interval); /* where the first is `after` itself but for rounding */
}

double appointments_corner(appointments *a, double t) {
    const double after = t + a->slack * fmax(1, t / a->duration);

    if (after >= a->asked && after < a->corner) return a->corner;
    corner_search c = {after, INFINITY};
    if (a->disturbance) {
        for (int i = 0; i < DISTURBING; i++) {
            (void)formula_form(disturbing(a->disturbance, i), &c);
        }
        offer_noise(&a->disturbance->noise, &c);
    }
    for (int i = 0; i < loadings(a->machine); i++) (void)formula_form(loading(a->machine, i), &c);
    if (a->motion && a->pace > 0) {
        corner_search own = {after * a->pace, INFINITY};
        offer_program(a->motion, &own);
        offer(&c, own.next / a->pace);
    }
    if (a->corner <= after) a->before = a->corner;
    a->asked = after;
    a->corner = c.next;
    return c.next;
}

/* ---- pieces ---- */

/* values of all functions at t */
static void values(const appointments *a, double t, double value[APPOINTMENT_FUNCTIONS]) {
    jet component[GOUGH_COMPONENTS];

    if (a->recorded) samples_jets(&a->motion->samples, a->pace * t, component);
    for (int i = 0; i < a->functions; i++) {
        value[i] = a->formula[i] ? formula_jet(a->formula[i], pace_of(a, i) * t).v : component[i].v;
    }
}

/* the first row of a record after a time, or the last row */
static size_t row_after(const gough_samples *s, double t) {
    size_t low = 0, high = s->count - 1;

    while (high - low > 1) { /* time[low] <= t */
        const size_t middle = low + (high - low) / 2;
        if (s->time[middle] > t) {
            high = middle;
        } else {
            low = middle;
        }
    }
    return high;
}

/* whether |f''| of a recorded component is over `bound` anywhere in a time: it is linear between rows */
static int record_bends(const gough_samples *s, int component, double from, double to,
                        double bound) {
    jet at[GOUGH_COMPONENTS];

    samples_jets(s, from, at);
    if (fabs(at[component].dd) > bound) return 1;
    samples_jets(s, to, at);
    if (fabs(at[component].dd) > bound) return 1;
    for (size_t i = row_after(s, from); i < s->count && s->time[i] < to; i++) {
        if (fabs(s->curvature[i * GOUGH_COMPONENTS + (size_t)component]) > bound) return 1;
    }
    return 0;
}

/* a piece, and what the functions are at its end and in its middle */
typedef struct {
    double from, to;
    double middle[APPOINTMENT_FUNCTIONS], last[APPOINTMENT_FUNCTIONS];
} appointment_piece;

/* (step-7) for one function on a piece */
static int bends(const appointments *a, int i, const appointment_piece *p, double bound) {
    const double pace = pace_of(a, i), from = pace * p->from, to = pace * p->to;

    if (a->formula[i] == NULL) {
        return record_bends(&a->motion->samples, i, from, to, bound / (pace * pace));
    }
    const enclosure e = formula_enclose(a->formula[i], from, to);
    return !(pace * pace * interval_magnitude(e.dd) <= bound);
}

/* whether all functions are slow on a piece that begins where the known ones end */
static int quiet(appointments *a, const appointment_piece *p) {
    const double length = p->to - p->from;

    for (int i = 0; i < a->functions; i++) {
        const double x = a->reached[i], y = p->middle[i], z = p->last[i];
        const double change = fmax(fmax(fabs(x - y), fabs(y - z)), fabs(x - z));
        if (change > a->size[i] && isfinite(change)) a->size[i] = change;
        const double least = small_part * a->size[i];
        if (bends(a, i, p, slow * (change > least ? change : least) / (length * length))) return 0;
    }
    return 1;
}

/* finds the next piece */
static void look_on(appointments *a) {
    appointment_piece p;

    if (a->waiting == 0) { /* a duration more */
        if (!a->begun) values(a, a->looked, a->reached);
        a->begun = 1;
        a->pending[a->waiting++] = a->looked + a->duration;
    }
    p.from = a->looked;
    p.to = a->pending[a->waiting - 1];
    values(a, p.to, p.last);
    for (;;) {
        const double half = (p.from + p.to) / 2;
        if (p.to - p.from <= a->least || a->waiting == APPOINTMENT_DEPTH) break;
        values(a, half, p.middle);
        if (quiet(a, &p)) break;
        a->pending[a->waiting++] = p.to = half;
        memcpy(p.last, p.middle, (size_t)a->functions * sizeof p.last[0]);
    }
    a->piece[a->known].from = p.from;
    a->piece[a->known].to = p.to;
    a->looked = p.to;
    memcpy(a->reached, p.last, (size_t)a->functions * sizeof p.last[0]);
    a->known++;
    a->waiting--;
}

/* forgets the pieces that end before t */
static void forget(appointments *a, double t) {
    int gone = 0;

    while (gone < a->known && a->piece[gone].to <= t) gone++;
    if (gone == 0) return;
    a->known -= gone;
    memmove(a->piece, a->piece + gone, (size_t)a->known * sizeof a->piece[0]);
}

double appointments_step(appointments *a, double t, double h, double share) {
    double step = h;
    int i = 0;

    if (a->functions == 0) return h;
    forget(a, t);
    for (;;) {
        if (i == APPOINTMENT_AHEAD) return fmin(step, a->looked - t);
        if (i == a->known) {
            look_on(a);
            if (a->looked <= t) {
                a->known--;
                continue;
            }
        }
        const double from = a->piece[i].from, to = a->piece[i].to;
        step = fmin(step, fmax(from - t, share * (to - from)));
        if (to >= t + step) return step;
        i++;
    }
}

/* the longest part from t, h at most, with which pieces, and the time between two corners, in which a ramp or a move has all of
 * its change, are made in 1/share parts */
static double longest_part(appointments *a, double t, double h, double share) {
    const double between = fmax(share * (a->corner - a->before), near_part * h);
    return fmin(appointments_step(a, t, h, share), between);
}

double appointments_part(appointments *a, double t, double end, double h) {
    double stop = end, corner, part;

    if (end <= a->clear && h <= a->longest) return end;
    corner = appointments_corner(a, t + near_part * h);
    if (corner < end - near_part * h) stop = corner;
    if (longest_part(a, t, h, met_share) < h * (1 - near_part)) {
        part = longest_part(a, t, h, part_share);
        if (a->recorded) { /* parts end at rows, where the third derivative jumps */
            const gough_samples *s = &a->motion->samples;
            const double row = s->time[row_after(s, a->pace * (t + near_part * h))] / a->pace;
            if (row > t + near_part * h) part = fmin(part, row - t);
        }
        if (part < (stop - t) * (1 - near_part)) {
            return t + (2 * part < stop - t ? part : (stop - t) / 2);
        }
        return stop;
    }
    a->clear = met_share * (corner - a->before) >= h ? corner : t;
    a->longest = h;
    if (a->functions > 0) {
        const double length = a->piece[0].to - a->piece[0].from;
        a->clear = met_share * length >= h ? fmin(a->clear, a->piece[0].to) : t;
    }
    return stop;
}

void appointments_begin(appointments *a, const gough_motion *motion,
                        const gough_disturbance *disturbance, const gough_machine *machine,
                        double from, double duration, double output_step) {
    a->motion = motion;
    a->disturbance = disturbance;
    a->machine = machine;
    a->duration = duration;
    a->least = least_part * output_step;
    a->slack = 1e-13 * duration;
    a->pace = motion && motion->scaled ? motion->frequency : 1;
    a->corner = a->asked = -INFINITY;
    a->before = -INFINITY;
    a->clear = a->longest = 0;
    a->looked = from;
    a->waiting = a->known = a->begun = 0;
    for (int i = 0; i < APPOINTMENT_FUNCTIONS; i++) a->size[i] = 0;
    watch_all(a);
}
