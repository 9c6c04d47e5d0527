/* (space-13) … (space-15): extremes over motions and loads, at all poses of a box. Theory: docs/theory/workspace.md. */
#define NUMBER_DOUBLE
#include "workspace/ask.h"

#include <string.h>

/* linear demands: acceleration, angular acceleration, force, moment; velocities: of the origin, angular */
enum { LINEAR = 12, RATES = 6, RESULTS = 2 * LEGS, CORNERS = 1 << (RATES - 1) };

/* forces of the six legs, then second rates of their lengths */
typedef struct outcome {
    taylor x[RESULTS];
} outcome;

typedef struct asker {
    const burden *b;
    const stiff *J;
    taylor D[6][6];            /* J J_c⁻¹ − 1 */
    double size[6][6], norm;   /* moduli of it, and the greatest sum over a column */
    double cube[6], fourth[6]; /* sums over a row of the cube and the fourth power of |D|ᵀ */
    asked_parts parts;
} asker;

/* ---- (space-13): f = u − Dᵀu + (Dᵀ)²u − (Dᵀ)³u + (Dᵀ)⁴f with u = J_c⁻ᵀ w ---- */

static void asker_begin(asker *a, const burden *b, const stiff *J, asked_parts parts) {
    *a = (asker){.b = b, .J = J, .parts = parts};
    for (int i = 0; i < 6 && parts.force; i++) {
        for (int j = 0; j < 6; j++) {
            taylor sum = taylor_of(i == j ? -1 : 0);
            for (int m = 0; m < 6; m++)
                sum = taylor_add(sum, taylor_scale(J->inverse[m][j], J->row[i][m]));
            a->D[i][j] = sum;
            a->size[i][j] = taylor_magnitude(&sum);
        }
    }
    double sum[6];
    for (int j = 0; j < 6; j++) {
        sum[j] = 0;
        for (int i = 0; i < 6; i++) sum[j] += a->size[i][j];
        a->norm = bound_of(a->norm, sum[j]);
    }
    double square[6] = {0};
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++) square[i] += a->size[j][i] * sum[j] * (1 + 8 * ROUNDED);
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++) a->cube[i] += a->size[j][i] * square[j] * (1 + 8 * ROUNDED);
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++) a->fourth[i] += a->size[j][i] * a->cube[j] * (1 + 8 * ROUNDED);
}

/* Dᵀ x */
static void turned_by(const asker *a, const taylor x[6], taylor to[6]) {
    for (int i = 0; i < 6; i++) {
        to[i] = taylor_of(0);
        for (int j = 0; j < 6; j++) to[i] = taylor_add(to[i], taylor_times(a->D[j][i], x[j]));
    }
}

static void solve_forces(const asker *a, const taylor wrench[6], taylor f[6]) {
    taylor u[6];
    double greatest = 0;
    for (int i = 0; i < 6; i++) {
        u[i] = taylor_of(0);
        for (int m = 0; m < 6; m++)
            u[i] = taylor_add(u[i], taylor_scale(a->J->inverse[m][i], wrench[m]));
        greatest = bound_of(greatest, taylor_magnitude(&u[i]));
    }
    const double most = a->norm < 1 ? greatest / (1 - a->norm) * (1 + 4 * ROUNDED) : INFINITY;
    taylor once[6], twice[6];
    turned_by(a, u, once);
    turned_by(a, once, twice);
    double size[6];
    for (int j = 0; j < 6; j++) size[j] = taylor_magnitude(&twice[j]);
    for (int i = 0; i < 6; i++) {
        /* what is left: (Dᵀ)³ f, or (Dᵀ)³ u and (Dᵀ)⁴ f */
        double third = 0;
        for (int j = 0; j < 6; j++) third += a->size[j][i] * size[j];
        const double rest = fmin(a->cube[i] * most, third + a->fourth[i] * most);
        f[i] = taylor_add(taylor_less(u[i], once[i]), twice[i]);
        f[i].r = bound_of(0, f[i].r + rest * (1 + 16 * ROUNDED));
    }
}

static void find_outcome(const asker *a, const effort *e, outcome *to) {
    taylor wrench[6];
    for (int i = 0; i < RESULTS; i++) to->x[i] = taylor_of(0);
    if (a->parts.force) {
        burden_wrench(a->b, e, wrench);
        solve_forces(a, wrench, to->x);
    }
    for (int v = 0; v < LEGS && a->parts.acceleration; v++)
        to->x[LEGS + v] = burden_second_rate(a->b, e, v);
}

/* ---- extremes ---- */

/* Greatest and least value so far: numbers that depend on the pose, and what is bounded over the box only. */
typedef struct range {
    taylor up, down;
    double more, less; /* ≥ 0: added above, taken away below, where the pose asks for it or not */
    double sure_more, sure_less; /* of this, what is there in every pose */
} range;

/* (space-14): a part that may have either sign, as large as `size` */
static void range_either(range *r, taylor part, double size) {
    const double spread = taylor_spread(&part);
    const taylor scaled = taylor_scale(part.c < 0 ? -size : size, part);
    if (fabs(part.c) >= spread) {
        r->up = taylor_add(r->up, scaled);
        r->down = taylor_less(r->down, scaled);
    } else {
        r->more += size * taylor_magnitude(&part);
        r->less += size * taylor_magnitude(&part);
    }
}

static double *linear_demand(effort *e, int j) {
    double *const at[] = {e->linear, e->angular, e->force, e->moment};
    return &at[j / 3][j % 3];
}
static double *rate_demand(effort *e, int j) {
    double *const at[] = {e->velocity, e->angular_velocity};
    return &at[j / 3][j % 3];
}

static void add_linear(const asker *a, range extreme[RESULTS]) {
    effort most = effort_most(a->b->s->reach);
    for (int j = 0; j < LINEAR; j++) {
        const double size = *linear_demand(&most, j);
        effort one = {.gravity = 0};
        outcome column;
        if (!(size > 0)) continue;
        *linear_demand(&one, j) = 1;
        find_outcome(a, &one, &column);
        for (int i = 0; i < RESULTS; i++) range_either(&extreme[i], column.x[i], size);
    }
}

/* the quadratic form of the velocities, half of its matrix, each times the greatest velocities */
typedef struct form {
    double c[RATES][RATES], spread;
} form;

static void find_forms(const asker *a, form forms[RESULTS]) {
    effort most = effort_most(a->b->s->reach);
    outcome own[RATES];
    memset(forms, 0, RESULTS * sizeof *forms);
    for (int j = 0; j < RATES; j++) {
        for (int k = j; k >= 0; k--) {
            const double size = *rate_demand(&most, j) * *rate_demand(&most, k);
            effort e = {.gravity = 0};
            outcome both;
            if (!(size > 0)) continue;
            *rate_demand(&e, j) = *rate_demand(&e, k) = 1;
            find_outcome(a, &e, &both);
            if (j == k) own[j] = both;
            for (int i = 0; i < RESULTS; i++) {
                taylor x = both.x[i];
                if (j != k) x = taylor_less(x, taylor_add(own[j].x[i], own[k].x[i]));
                forms[i].c[j][k] = size * x.c;
                forms[i].spread += size * (taylor_spread(&x) + ROUNDED * fabs(x.c));
            }
        }
    }
}

/* the form at a corner of the box of velocities; `whole`: with the squares that are below 0 (sign 1) or above (sign −1) */
static double form_at(const form *f, int corner, double sign, bool whole) {
    double sum = 0;
    for (int j = 0; j < RATES; j++) {
        const double square = f->c[j][j];
        if (whole || sign * square > 0) sum += square;
        for (int k = 0; k < j; k++) sum += ((corner >> j ^ corner >> k) & 1 ? -1 : 1) * f->c[j][k];
    }
    return sum;
}

/* (space-15): a form whose squares are not below 0 is greatest at a corner, and rest is one of the velocities */
static void add_form(const form *f, range *r) {
    double most = 0, least = 0, sure_most = 0, sure_least = 0;
    for (int corner = 0; corner < CORNERS; corner++) {
        most = fmax(most, form_at(f, corner, 1, false));
        least = fmin(least, form_at(f, corner, -1, false));
        sure_most = fmax(sure_most, form_at(f, corner, 1, true));
        sure_least = fmin(sure_least, form_at(f, corner, -1, true));
    }
    r->more += most + f->spread, r->less += f->spread - least;
    r->sure_more = fmax(0, sure_most - f->spread), r->sure_less = fmax(0, -sure_least - f->spread);
}

static bool any_rate(const gough_reach *reach) {
    effort most = effort_most(reach);
    bool any = false;
    for (int j = 0; j < RATES; j++) any |= *rate_demand(&most, j) > 0;
    return any;
}

static void find_ranges(const asker *a, range extreme[RESULTS]) {
    const gough_reach *reach = a->b->s->reach;
    const effort rest = {.gravity = 1};
    outcome still;
    form forms[RESULTS];
    find_outcome(a, &rest, &still);
    memset(extreme, 0, RESULTS * sizeof *extreme);
    for (int i = 0; i < RESULTS; i++) extreme[i].up = extreme[i].down = still.x[i];
    add_linear(a, extreme);
    if (!any_rate(reach)) return;
    find_forms(a, forms);
    for (int i = 0; i < RESULTS; i++) add_form(&forms[i], &extreme[i]);
}

static over_box upper(const range *r) {
    return (over_box){taylor_least(&r->up) + r->sure_more, taylor_most(&r->up) + r->more, r->up,
                      r->sure_more, r->more};
}
static over_box lower_turned(const range *r) {
    return (over_box){r->sure_less - taylor_most(&r->down), r->less - taylor_least(&r->down),
                      taylor_scale(-1, r->down), r->sure_less, r->less};
}

/* (mass-13): what friction of a moving leg adds at most to a force that lies between two */
static void add_friction(const gough_reach *reach, int v, double speed, asked_of_leg *a) {
    const gough_machine *machine = reach->machine;
    const gough_friction *f = &machine->platform.friction;
    const double dry = machine->breakaway[v] + f->viscous[v] * speed,
                 loss = 1 / f->efficiency[v] - 1;
    const double most = fmax(fabs(a->push.most), fabs(a->pull.most));
    if (!any_rate(reach)) return;
    a->push.most += dry + loss * most, a->push.above += dry + loss * most;
    a->pull.most += dry + loss * most, a->pull.above += dry + loss * most;
}

/* |l̇| ≤ Σ |J_k| V_k */
static over_box speed_of(const space *s, const stiff *J, int v) {
    effort most = effort_most(s->reach);
    over_box speed = {.least = 0, .most = 0};
    for (int j = 0; j < RATES; j++) {
        const taylor *x = &J->row[v][j];
        const double size = *rate_demand(&most, j) * (j < 3 ? 1 : s->h.reach);
        speed.most += size * taylor_magnitude(x) * (1 + 8 * ROUNDED);
        speed.least += size * fmax(0, fabs(x->c) - taylor_spread(x)) * (1 - 8 * ROUNDED);
    }
    return speed;
}

void asked_of(const space *s, const box_view *view, const taylor_vector n[LEGS], const stiff *J,
              asked_parts parts, asked_of_leg asked[LEGS]) {
    burden b;
    asker a;
    range extreme[RESULTS];
    memset(asked, 0, LEGS * sizeof *asked);
    if (parts.force || parts.acceleration) {
        burden_of(s, view, n, &b);
        asker_begin(&a, &b, J, parts);
        find_ranges(&a, extreme);
    }
    for (int v = 0; v < LEGS; v++) {
        asked_of_leg *leg = &asked[v];
        leg->speed = speed_of(s, J, v);
        if (parts.force) {
            leg->push = upper(&extreme[v]), leg->pull = lower_turned(&extreme[v]);
            add_friction(s->reach, v, leg->speed.most, leg);
        }
        if (parts.acceleration) {
            const over_box up = upper(&extreme[LEGS + v]), down = lower_turned(&extreme[LEGS + v]);
            leg->acceleration =
                (over_box){.least = fmax(up.least, down.least), .most = fmax(up.most, down.most)};
        }
    }
}
