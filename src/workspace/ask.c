/* (space-13) … (space-15): extremes over motions and loads, at all poses of a box. Theory: docs/theory/workspace.md. */
#define NUMBER_DOUBLE
#include "workspace/ask.h"

#include <string.h>

/* linear demands: acceleration, angular acceleration, force, moment; velocities: of the origin, angular */
enum { LINEAR = 12, RATES = 6, RESULTS = 2 * LEGS, CORNERS = 1 << (RATES - 1), CLIMBS = 4 };

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

/* Greatest value so far, or with the sign −1 the least: a number that depends on the pose, and what is bounded over the box
 * only. */
typedef struct end_of_range {
    double sign;
    taylor near;
    double more; /* ≥ 0: beyond `near`, where the pose asks for it or not */
    double sure; /* ≤ 0: what may be missing of `near` */
    double
        still; /* what every pose reaches for certain: at rest, or at one corner of the velocities */
} end_of_range;

typedef struct range {
    end_of_range up, down;
} range;

/* (space-14): a part that may have either sign, as large as `size` */
static void range_either(range *r, taylor part, double size) {
    const double spread = taylor_spread(&part);
    const taylor scaled = taylor_scale(part.c < 0 ? -size : size, part);
    if (fabs(part.c) >= spread) {
        r->up.near = taylor_add(r->up.near, scaled);
        r->down.near = taylor_less(r->down.near, scaled);
    } else {
        r->up.more += size * taylor_magnitude(&part);
        r->down.more += size * taylor_magnitude(&part);
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

/* the quadratic form of the velocities, each coefficient times the greatest velocities; j ≥ k at curve_at(k, j) */
typedef struct form {
    taylor q[CURVES];
} form;

static void find_forms(const asker *a, form forms[RESULTS]) {
    effort most = effort_most(a->b->s->reach);
    memset(forms, 0, RESULTS * sizeof *forms);
    for (int j = 0; j < RATES; j++) {
        for (int k = 0; k <= j; k++) {
            const double size = *rate_demand(&most, j) * *rate_demand(&most, k);
            effort e = {.gravity = 0};
            outcome both;
            if (!(size > 0)) continue;
            *rate_demand(&e, j) = *rate_demand(&most, j);
            *rate_demand(&e, k) = *rate_demand(&most, k);
            find_outcome(a, &e, &both);
            for (int i = 0; i < RESULTS; i++) forms[i].q[curve_at(k, j)] = both.x[i];
        }
    }
    /* of the sum of two velocities the squares of both are taken off */
    for (int i = 0; i < RESULTS; i++)
        for (int j = 0; j < RATES; j++)
            for (int k = 0; k < j; k++) {
                taylor *q = &forms[i].q[curve_at(k, j)];
                const taylor own =
                    taylor_add(forms[i].q[curve_at(j, j)], forms[i].q[curve_at(k, k)]);
                if (*rate_demand(&most, j) * *rate_demand(&most, k) > 0) *q = taylor_less(*q, own);
            }
}

/* whether the product of two velocities is below 0 at a corner of their box */
static bool is_negative(int corner, int j, int k) { return (corner >> j ^ corner >> k) & 1; }

/* the parts of a form with these coefficients, at the centre and at a corner */
static double form_at(const form *f, int corner, const bool with[CURVES]) {
    double sum = 0;
    for (int j = 0; j < RATES; j++)
        for (int k = 0; k <= j; k++) {
            const int at = curve_at(k, j);
            if (with[at]) sum += is_negative(corner, j, k) ? -f->q[at].c : f->q[at].c;
        }
    return sum;
}

/* by how much a corner exceeds another anywhere, or 0: only products whose sign differs count */
static double corner_beyond(const form *f, int corner, int best, double sign,
                            const bool with[CURVES]) {
    taylor sum = taylor_of(0);
    double crude = 0;
    for (int pass = 0; pass < 2; pass++) {
        for (int j = 0; j < RATES; j++)
            for (int k = 0; k < j; k++) {
                const bool differs = is_negative(corner, j, k) != is_negative(best, j, k);
                if (!differs || !with[curve_at(k, j)]) continue;
                const taylor *q = &f->q[curve_at(k, j)];
                const double twice = is_negative(corner, j, k) ? -2 * sign : 2 * sign;
                if (pass == 0)
                    crude += twice * q->c + 2 * taylor_spread(q) + 8 * ROUNDED * fabs(q->c);
                else
                    sum = taylor_add(sum, taylor_scale(twice, *q));
            }
        if (!(crude > 0)) return 0;
    }
    return fmax(0, taylor_most(&sum));
}

/* Which coefficients have one sign over the box: the others are bounded by themselves, squares that may be below 0 left out. */
static void find_certain(const form *f, end_of_range *r, bool certain[CURVES]) {
    for (int j = 0; j < RATES; j++)
        for (int k = 0; k <= j; k++) {
            const taylor q = taylor_scale(r->sign, f->q[curve_at(k, j)]);
            const double least = taylor_least(&q), most = taylor_most(&q);
            certain[curve_at(k, j)] = least >= 0 || (j != k && most <= 0);
            if (certain[curve_at(k, j)]) continue;
            r->more += j == k ? fmax(0, most) : fmax(most, -least);
            r->sure += j == k ? fmin(0, least) : fmin(least, -most);
        }
}

/* A velocity u whose square has the coefficient −q < 0 and whose products with the others add b u, |b| ≤ B: the greatest
 * −q u² + b u is no greater than that of b u times a factor below 1, by which the products of this velocity are multiplied. */
static void ease(form *f, end_of_range *r) {
    for (int j = 0; j < RATES; j++) {
        const taylor square = taylor_scale(r->sign, f->q[curve_at(j, j)]);
        const double q = -taylor_most(&square);
        double most = 0;
        for (int k = 0; k < RATES; k++)
            if (k != j) most += taylor_magnitude(&f->q[k < j ? curve_at(k, j) : curve_at(j, k)]);
        if (!(q > 0) || !(most > 0)) continue;
        const double factor = (most > 2 * q ? 1 - q / most : most / (4 * q)) + 8 * ROUNDED;
        r->sure -= fmax(0, 1 - factor) * most;
        for (int k = 0; k < RATES; k++) {
            taylor *product = &f->q[k < j ? curve_at(k, j) : curve_at(j, k)];
            if (k != j && factor < 1) *product = taylor_scale(factor, *product);
        }
    }
}

/* What velocities add at the centre at least: from a corner on, each is put where it adds most, the others staying. */
static double climb_from(const form *f, int corner, double sign) {
    double u[RATES], sum = 0;
    for (int j = 0; j < RATES; j++) u[j] = corner >> j & 1 ? -1 : 1;
    for (int n = 0; n < CLIMBS * RATES; n++) {
        const int j = n % RATES;
        const double q = sign * f->q[curve_at(j, j)].c;
        double b = 0;
        for (int k = 0; k < RATES; k++)
            if (k != j) b += sign * u[k] * f->q[k < j ? curve_at(k, j) : curve_at(j, k)].c;
        u[j] = q < 0 ? fmin(1, fmax(-1, b / (-2 * q))) : b < 0 ? -1 : 1;
    }
    for (int j = 0; j < RATES; j++)
        for (int k = 0; k <= j; k++) sum += sign * u[j] * u[k] * f->q[curve_at(k, j)].c;
    return sum;
}

/* (space-15): a form whose squares are not below 0 is greatest at a corner */
static void add_form(const form *whole, end_of_range *r) {
    bool certain[CURVES], all[CURVES];
    double beyond = 0, spread = 0, greatest = 0, sure = 0;
    int best = 0;
    form eased = *whole;
    const form *f = &eased;
    ease(&eased, r);
    find_certain(f, r, certain);
    for (int i = 0; i < CURVES; i++) {
        spread += taylor_spread(&whole->q[i]) + 8 * ROUNDED * fabs(whole->q[i].c);
        all[i] = true;
    }
    for (int corner = 0; corner < CORNERS; corner++) {
        const double value = r->sign * form_at(f, corner, certain);
        if (corner == 0 || value > greatest) greatest = value, best = corner;
        sure = fmax(sure, r->sign * form_at(whole, corner, all) - spread);
    }
    sure = fmax(sure, climb_from(whole, best, r->sign) - spread);
    for (int corner = 0; corner < CORNERS; corner++)
        if (corner != best) beyond = fmax(beyond, corner_beyond(f, corner, best, r->sign, certain));
    r->more += beyond;
    r->still += sure;
    for (int j = 0; j < RATES; j++)
        for (int k = 0; k <= j; k++) {
            const taylor *q = &f->q[curve_at(k, j)];
            if (!certain[curve_at(k, j)]) continue;
            r->near = taylor_add(r->near, is_negative(best, j, k) ? taylor_scale(-1, *q) : *q);
        }
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
    for (int i = 0; i < RESULTS; i++)
        extreme[i] = (range){{.sign = 1, .near = still.x[i]}, {.sign = -1, .near = still.x[i]}};
    add_linear(a, extreme);
    for (int i = 0; i < RESULTS; i++) {
        extreme[i].up.still = taylor_least(&extreme[i].up.near);
        extreme[i].down.still = -taylor_most(&extreme[i].down.near);
    }
    if (!any_rate(reach)) return;
    find_forms(a, forms);
    for (int i = 0; i < RESULTS; i++)
        add_form(&forms[i], &extreme[i].up), add_form(&forms[i], &extreme[i].down);
}

/* the greatest value, or the least one turned */
static over_box over_of(const end_of_range *r) {
    const taylor near = taylor_scale(r->sign, r->near);
    const double least = taylor_least(&near), most = taylor_most(&near);
    /* what every pose reaches is near + sure too */
    const double sure = fmax(r->sure, (r->still - most) - ROUNDED * (fabs(r->still) + fabs(most)));
    return (over_box){fmax(r->still, least + r->sure), most + r->more, near, sure, r->more};
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

/* |l̇| ≤ Σ |J_k| V_k: with slopes and curvatures where J_k keeps its sign, (space-14) */
static over_box speed_of(const space *s, const stiff *J, int v) {
    effort most = effort_most(s->reach);
    range speed = {{.sign = 1, .near = taylor_of(0)}, {.sign = -1, .near = taylor_of(0)}};
    for (int j = 0; j < RATES; j++) {
        const double size = *rate_demand(&most, j) * (j < 3 ? 1 : s->h.reach);
        if (size > 0) range_either(&speed, J->row[v][j], size);
    }
    return (over_box){.least = fmax(0, taylor_least(&speed.up.near)),
                      .most = taylor_most(&speed.up.near) + speed.up.more * (1 + 8 * ROUNDED)};
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
            leg->push = over_of(&extreme[v].up), leg->pull = over_of(&extreme[v].down);
            add_friction(s->reach, v, leg->speed.most, leg);
        }
        if (parts.acceleration) {
            const over_box up = over_of(&extreme[LEGS + v].up),
                           down = over_of(&extreme[LEGS + v].down);
            leg->acceleration =
                (over_box){.least = fmax(up.least, down.least), .most = fmax(up.most, down.most)};
        }
    }
}
