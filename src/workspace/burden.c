/* (space-12): wrenches over a box of poses. Theory: docs/theory/workspace.md. */
#define NUMBER_DOUBLE
#include "workspace/burden.h"

#include <string.h>

static const affine_vector NOWHERE; /* zeros */

/* the axis k of the top frame, in central axes as the hexapod has its joints */
static vector unit_of(int k) { return (vector){k == 0, k == 1, k == 2}; }

effort effort_most(const gough_reach *reach) {
    const gough_workspace *w = &reach->asked;
    effort e = {.gravity = 0};
    memcpy(e.linear, w->acceleration, sizeof e.linear);
    memcpy(e.angular, w->angular_acceleration, sizeof e.angular);
    memcpy(e.velocity, w->velocity, sizeof e.velocity);
    memcpy(e.angular_velocity, w->angular_velocity, sizeof e.angular_velocity);
    memcpy(e.force, w->force, sizeof e.force);
    memcpy(e.moment, w->moment, sizeof e.moment);
    return e;
}

static affine length_of(const box_view *view, int v) {
    const double l = view->g.length[v];
    affine a = {l, {0, 0, 0, 0, 0, 0}, 0};
    double bound[2], first = 0;
    box_lengths(view, v, bound);
    box_length_slopes(view, v, a.g);
    for (int k = 0; k < SIDES; k++) first += fabs(a.g[k]);
    /* what is not first order */
    a.r = fmax(0, fmax(bound[1] - l, l - bound[0]) - first) + ROUNDED * l;
    return a;
}

/* (mass-1), (mass-2) */
static void find_resistance(burden *b, int v) {
    const leg_mass *m = &b->s->h.mass[v];
    const affine reach = affine_add(b->length[v], affine_of(-m->center));
    b->turning[v] =
        affine_add(affine_of(m->swing), affine_scale(m->piston, affine_times(reach, reach)));
    b->across[v] = affine_times(b->turning[v], affine_times(b->inverse[v], b->inverse[v]));
    b->tilt[v] = affine_scale(m->offset, b->inverse[v]);
    b->more[v] = affine_less(affine_of(m->piston + m->reflected), b->across[v]);
}

void burden_of(const space *s, const box_view *view, const affine_vector n[LEGS], burden *b) {
    b->s = s;
    for (int k = 0; k < 3; k++) b->column[k] = box_turned(view, out_of(&view->R, unit_of(k)));
    b->center = box_turned(view, out_of(&view->R, s->h.center));
    for (int v = 0; v < LEGS; v++) {
        b->arm[v] = box_turned(view, out_of(&view->x.q, s->h.top[v]));
        b->n[v] = n[v];
        b->length[v] = length_of(view, v);
        b->inverse[v] = affine_inverse(b->length[v]);
        find_resistance(b, v);
    }
}

static bool is_zero(const double v[3]) { return !(fabs(v[0]) + fabs(v[1]) + fabs(v[2]) > 0); }

static bool moves(const effort *e) {
    return !is_zero(e->velocity) || !is_zero(e->angular_velocity);
}

/* a + α × arm + ω × (ω × arm) */
static affine_vector acceleration_of(const effort *e, const affine_vector *arm) {
    affine_vector sum = affine_still(e->linear);
    if (!is_zero(e->angular)) {
        const affine_vector tangent = affine_cross_still(e->angular, arm);
        for (int i = 0; i < 3; i++) sum.x[i] = affine_add(sum.x[i], tangent.x[i]);
    }
    if (!is_zero(e->angular_velocity)) {
        const affine_vector across = affine_cross_still(e->angular_velocity, arm),
                            inward = affine_cross_still(e->angular_velocity, &across);
        for (int i = 0; i < 3; i++) sum.x[i] = affine_add(sum.x[i], inward.x[i]);
    }
    return sum;
}

static affine_vector velocity_of(const effort *e, const affine_vector *arm) {
    const affine_vector v = affine_still(e->velocity),
                        across = affine_cross_still(e->angular_velocity, arm);
    affine_vector sum;
    for (int i = 0; i < 3; i++) sum.x[i] = affine_add(v.x[i], across.x[i]);
    return sum;
}

/* J x = R J_t Rᵀ x for a vector that is the same in all poses */
static affine_vector inertia_times(const burden *b, const double x[3]) {
    const gough_load *load = &b->s->reach->machine->load;
    affine_vector sum = NOWHERE;
    affine part[3];
    if (is_zero(x)) return sum;
    for (int k = 0; k < 3; k++) part[k] = affine_dot_still(x, &b->column[k]);
    for (int r = 0; r < 3; r++) {
        affine along = affine_of(0);
        for (int k = 0; k < 3; k++)
            along = affine_add(along, affine_scale(load->inertia[r][k], part[k]));
        sum = affine_along(&sum, along, &b->column[r]);
    }
    return sum;
}

/* adds a force at an arm */
static void add_force(const affine_vector *arm, const affine_vector *force, affine wrench[6]) {
    const affine_vector moment = affine_cross(arm, force);
    for (int i = 0; i < 3; i++) {
        wrench[i] = affine_add(wrench[i], force->x[i]);
        wrench[3 + i] = affine_add(wrench[3 + i], moment.x[i]);
    }
}

/* (2.2), (2.4): M (ρ̈ − g) less the force, and J α + ω × J ω less the moment */
static void add_load(const burden *b, const effort *e, affine wrench[6]) {
    const gough_machine *machine = b->s->reach->machine;
    const double mass = machine->load.mass;
    const affine_vector a = acceleration_of(e, &b->center), spin = inertia_times(b, e->angular),
                        own = inertia_times(b, e->angular_velocity),
                        turn = affine_cross_still(e->angular_velocity, &own);
    affine_vector force;
    for (int i = 0; i < 3; i++) {
        const affine still =
            affine_less(affine_scale(-mass * e->gravity, affine_of(machine->gravity[i])),
                        affine_of(e->force[i]));
        force.x[i] = affine_add(affine_scale(mass, a.x[i]), still);
        const affine moment = affine_add(spin.x[i], turn.x[i]);
        wrench[3 + i] = affine_add(wrench[3 + i], affine_add(moment, affine_of(-e->moment[i])));
    }
    add_force(&b->center, &force, wrench);
}

/* (mass-3): what the motion of leg v adds, but for its acceleration */
static affine_vector swing_of_leg(const burden *b, const effort *e, int v) {
    const leg_mass *m = &b->s->h.mass[v];
    const affine l = b->length[v], inverse = b->inverse[v];
    const affine_vector *n = &b->n[v], speed = velocity_of(e, &b->arm[v]);
    const affine rate = affine_dot(n, &speed);
    affine_vector turn = affine_along(&speed, affine_scale(-1, rate), n);
    for (int i = 0; i < 3; i++) turn.x[i] = affine_times(inverse, turn.x[i]);

    const affine weight =
        affine_add(affine_of(m->piston * m->center), affine_scale(m->reflected, l));
    const affine outward = affine_times(weight, affine_dot(&turn, &turn));
    const affine side = affine_less(affine_scale(m->piston, affine_add(l, affine_of(-m->center))),
                                    affine_times(b->turning[v], inverse));
    const affine sideways = affine_scale(2, affine_times(affine_times(rate, inverse), side));
    const affine_vector f = affine_along(&NOWHERE, outward, n);
    return affine_along(&f, sideways, &turn);
}

/* (mass-3): the force that the top gives leg v, but for the leg force */
static affine_vector force_of_leg(const burden *b, const effort *e, int v) {
    const double *g0 = b->s->reach->machine->gravity;
    const double g[3] = {e->gravity * g0[0], e->gravity * g0[1], e->gravity * g0[2]};
    const affine_vector a = acceleration_of(e, &b->arm[v]), *n = &b->n[v];
    const affine along = affine_add(affine_times(b->more[v], affine_dot(n, &a)),
                                    affine_times(b->tilt[v], affine_dot_still(g, n)));
    const affine hanging = affine_add(affine_of(b->s->h.mass[v].piston), b->tilt[v]);
    affine_vector f = moves(e) ? swing_of_leg(b, e, v) : NOWHERE;

    f = affine_along(&f, b->across[v], &a);
    f = affine_along(&f, along, n);
    for (int i = 0; i < 3 && e->gravity > 0; i++)
        f.x[i] = affine_less(f.x[i], affine_scale(g[i], hanging));
    return f;
}

/* a vector given in the top frame, over the box */
static affine_vector turned_of(const burden *b, const double v[3]) {
    affine_vector sum = NOWHERE;
    for (int k = 0; k < 3; k++) sum = affine_along(&sum, affine_of(v[k]), &b->column[k]);
    return sum;
}

/* (law-4): what a known load, as it is at t = 0, takes off the legs */
static void add_external(const burden *b, const gough_external *load, affine wrench[6]) {
    const affine_vector at = load->at_given ? turned_of(b, load->at) : b->center;
    double force[3], moment[3], jet[3];
    for (int k = 0; k < 3; k++) {
        gough_formula_evaluate(&load->force[k], 0, jet), force[k] = -jet[0];
        gough_formula_evaluate(&load->moment[k], 0, jet), moment[k] = -jet[0];
    }
    const affine_vector F = load->turns ? turned_of(b, force) : affine_still(force),
                        M = load->turns ? turned_of(b, moment) : affine_still(moment);
    add_force(&at, &F, wrench);
    for (int i = 0; i < 3; i++) wrench[3 + i] = affine_add(wrench[3 + i], M.x[i]);
}

void burden_wrench(const burden *b, const effort *e, affine wrench[6]) {
    for (int i = 0; i < 6; i++) wrench[i] = affine_of(0);
    add_load(b, e, wrench);
    for (size_t k = 0; k < b->s->reach->machine->externals && e->gravity > 0; k++)
        add_external(b, &b->s->reach->machine->external[k], wrench);
    const bool swung = e->gravity > 0 || moves(e) || !is_zero(e->linear) || !is_zero(e->angular);
    for (int v = 0; v < LEGS && swung && b->s->reach->machine->platform.legs_have_mass; v++) {
        const affine_vector f = force_of_leg(b, e, v);
        add_force(&b->arm[v], &f, wrench);
    }
    for (int i = 3; i < 6; i++) wrench[i] = affine_scale(1 / b->s->h.reach, wrench[i]);
}

/* l̈ = n·a + l |ṅ|², l ṅ = v − l̇ n */
affine burden_second_rate(const burden *b, const effort *e, int v) {
    const affine_vector a = acceleration_of(e, &b->arm[v]);
    if (!moves(e)) return affine_dot(&b->n[v], &a);
    const affine_vector speed = velocity_of(e, &b->arm[v]);
    const affine rate = affine_dot(&b->n[v], &speed);
    const affine_vector across = affine_along(&speed, affine_scale(-1, rate), &b->n[v]);
    return affine_add(affine_dot(&b->n[v], &a),
                      affine_times(b->inverse[v], affine_dot(&across, &across)));
}
