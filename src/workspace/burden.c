/* (space-12): wrenches over a box of poses. Theory: docs/theory/workspace.md. */
#define NUMBER_DOUBLE
#include "workspace/burden.h"

#include <string.h>

static const taylor_vector NOWHERE; /* zeros */

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

/* (mass-1), (mass-2) */
static void find_resistance(burden *b, int v) {
    const leg_mass *m = &b->s->h.mass[v];
    const taylor reach = taylor_add(b->length[v], taylor_of(-m->center));
    b->turning[v] =
        taylor_add(taylor_of(m->swing), taylor_scale(m->piston, taylor_times(reach, reach)));
    b->across[v] = taylor_times(b->turning[v], taylor_times(b->inverse[v], b->inverse[v]));
    b->tilt[v] = taylor_scale(m->offset, b->inverse[v]);
    b->more[v] = taylor_less(taylor_of(m->piston + m->reflected), b->across[v]);
}

void burden_of(const space *s, const box_view *view, const taylor_vector n[LEGS], burden *b) {
    b->s = s;
    for (int k = 0; k < 3; k++) b->column[k] = box_turned(view, out_of(&view->R, unit_of(k)));
    b->center = box_turned(view, out_of(&view->R, s->h.center));
    for (int v = 0; v < LEGS; v++) {
        b->arm[v] = box_turned(view, out_of(&view->x.q, s->h.top[v]));
        b->n[v] = n[v];
        b->length[v] = box_length(view, v);
        b->inverse[v] = taylor_inverse(b->length[v]);
        find_resistance(b, v);
    }
}

static bool is_zero(const double v[3]) { return !(fabs(v[0]) + fabs(v[1]) + fabs(v[2]) > 0); }

static bool moves(const effort *e) {
    return !is_zero(e->velocity) || !is_zero(e->angular_velocity);
}

/* a + α × arm + ω × (ω × arm) */
static taylor_vector acceleration_of(const effort *e, const taylor_vector *arm) {
    taylor_vector sum = taylor_still(e->linear);
    if (!is_zero(e->angular)) {
        const taylor_vector tangent = taylor_cross_still(e->angular, arm);
        for (int i = 0; i < 3; i++) sum.x[i] = taylor_add(sum.x[i], tangent.x[i]);
    }
    if (!is_zero(e->angular_velocity)) {
        const taylor_vector across = taylor_cross_still(e->angular_velocity, arm),
                            inward = taylor_cross_still(e->angular_velocity, &across);
        for (int i = 0; i < 3; i++) sum.x[i] = taylor_add(sum.x[i], inward.x[i]);
    }
    return sum;
}

static taylor_vector velocity_of(const effort *e, const taylor_vector *arm) {
    const taylor_vector v = taylor_still(e->velocity),
                        across = taylor_cross_still(e->angular_velocity, arm);
    taylor_vector sum;
    for (int i = 0; i < 3; i++) sum.x[i] = taylor_add(v.x[i], across.x[i]);
    return sum;
}

/* J x = R J_t Rᵀ x for a vector that is the same in all poses */
static taylor_vector inertia_times(const burden *b, const double x[3]) {
    const gough_load *load = &b->s->reach->machine->load;
    taylor_vector sum = NOWHERE;
    taylor part[3];
    if (is_zero(x)) return sum;
    for (int k = 0; k < 3; k++) part[k] = taylor_dot_still(x, &b->column[k]);
    for (int r = 0; r < 3; r++) {
        taylor along = taylor_of(0);
        for (int k = 0; k < 3; k++)
            along = taylor_add(along, taylor_scale(load->inertia[r][k], part[k]));
        sum = taylor_along(&sum, along, &b->column[r]);
    }
    return sum;
}

/* adds a force at an arm */
static void add_force(const taylor_vector *arm, const taylor_vector *force, taylor wrench[6]) {
    const taylor_vector moment = taylor_cross(arm, force);
    for (int i = 0; i < 3; i++) {
        wrench[i] = taylor_add(wrench[i], force->x[i]);
        wrench[3 + i] = taylor_add(wrench[3 + i], moment.x[i]);
    }
}

/* (2.2), (2.4): M (ρ̈ − g) less the force, and J α + ω × J ω less the moment */
static void add_load(const burden *b, const effort *e, taylor wrench[6]) {
    const gough_machine *machine = b->s->reach->machine;
    const double mass = machine->load.mass;
    const taylor_vector a = acceleration_of(e, &b->center), spin = inertia_times(b, e->angular),
                        own = inertia_times(b, e->angular_velocity),
                        turn = taylor_cross_still(e->angular_velocity, &own);
    taylor_vector force;
    for (int i = 0; i < 3; i++) {
        const taylor still =
            taylor_less(taylor_scale(-mass * e->gravity, taylor_of(machine->gravity[i])),
                        taylor_of(e->force[i]));
        force.x[i] = taylor_add(taylor_scale(mass, a.x[i]), still);
        const taylor moment = taylor_add(spin.x[i], turn.x[i]);
        wrench[3 + i] = taylor_add(wrench[3 + i], taylor_add(moment, taylor_of(-e->moment[i])));
    }
    add_force(&b->center, &force, wrench);
}

/* (mass-3): what the motion of leg v adds, but for its acceleration */
static taylor_vector swing_of_leg(const burden *b, const effort *e, int v) {
    const leg_mass *m = &b->s->h.mass[v];
    const taylor l = b->length[v], inverse = b->inverse[v];
    const taylor_vector *n = &b->n[v], speed = velocity_of(e, &b->arm[v]);
    const taylor rate = taylor_dot(n, &speed);
    taylor_vector turn = taylor_along(&speed, taylor_scale(-1, rate), n);
    for (int i = 0; i < 3; i++) turn.x[i] = taylor_times(inverse, turn.x[i]);

    const taylor weight =
        taylor_add(taylor_of(m->piston * m->center), taylor_scale(m->reflected, l));
    const taylor outward = taylor_times(weight, taylor_dot(&turn, &turn));
    const taylor side = taylor_less(taylor_scale(m->piston, taylor_add(l, taylor_of(-m->center))),
                                    taylor_times(b->turning[v], inverse));
    const taylor sideways = taylor_scale(2, taylor_times(taylor_times(rate, inverse), side));
    const taylor_vector f = taylor_along(&NOWHERE, outward, n);
    return taylor_along(&f, sideways, &turn);
}

/* (mass-3): the force that the top gives leg v, but for the leg force */
static taylor_vector force_of_leg(const burden *b, const effort *e, int v) {
    const double *g0 = b->s->reach->machine->gravity;
    const double g[3] = {e->gravity * g0[0], e->gravity * g0[1], e->gravity * g0[2]};
    const taylor_vector a = acceleration_of(e, &b->arm[v]), *n = &b->n[v];
    const taylor along = taylor_add(taylor_times(b->more[v], taylor_dot(n, &a)),
                                    taylor_times(b->tilt[v], taylor_dot_still(g, n)));
    const taylor hanging = taylor_add(taylor_of(b->s->h.mass[v].piston), b->tilt[v]);
    taylor_vector f = moves(e) ? swing_of_leg(b, e, v) : NOWHERE;

    f = taylor_along(&f, b->across[v], &a);
    f = taylor_along(&f, along, n);
    for (int i = 0; i < 3 && e->gravity > 0; i++)
        f.x[i] = taylor_less(f.x[i], taylor_scale(g[i], hanging));
    return f;
}

/* a vector given in the top frame, over the box */
static taylor_vector turned_of(const burden *b, const double v[3]) {
    taylor_vector sum = NOWHERE;
    for (int k = 0; k < 3; k++) sum = taylor_along(&sum, taylor_of(v[k]), &b->column[k]);
    return sum;
}

/* (law-4): what a known load, as it is at t = 0, takes off the legs */
static void add_external(const burden *b, const gough_external *load, taylor wrench[6]) {
    const taylor_vector at = load->at_given ? turned_of(b, load->at) : b->center;
    double force[3], moment[3], jet[3];
    for (int k = 0; k < 3; k++) {
        gough_formula_evaluate(&load->force[k], 0, jet), force[k] = -jet[0];
        gough_formula_evaluate(&load->moment[k], 0, jet), moment[k] = -jet[0];
    }
    const taylor_vector F = load->turns ? turned_of(b, force) : taylor_still(force),
                        M = load->turns ? turned_of(b, moment) : taylor_still(moment);
    add_force(&at, &F, wrench);
    for (int i = 0; i < 3; i++) wrench[3 + i] = taylor_add(wrench[3 + i], M.x[i]);
}

void burden_wrench(const burden *b, const effort *e, taylor wrench[6]) {
    for (int i = 0; i < 6; i++) wrench[i] = taylor_of(0);
    add_load(b, e, wrench);
    for (size_t k = 0; k < b->s->reach->machine->externals && e->gravity > 0; k++)
        add_external(b, &b->s->reach->machine->external[k], wrench);
    const bool swung = e->gravity > 0 || moves(e) || !is_zero(e->linear) || !is_zero(e->angular);
    for (int v = 0; v < LEGS && swung && b->s->reach->machine->platform.legs_have_mass; v++) {
        const taylor_vector f = force_of_leg(b, e, v);
        add_force(&b->arm[v], &f, wrench);
    }
    for (int i = 3; i < 6; i++) wrench[i] = taylor_scale(1 / b->s->h.reach, wrench[i]);
}

/* l̈ = n·a + l |ṅ|², l ṅ = v − l̇ n */
taylor burden_second_rate(const burden *b, const effort *e, int v) {
    const taylor_vector a = acceleration_of(e, &b->arm[v]);
    if (!moves(e)) return taylor_dot(&b->n[v], &a);
    const taylor_vector speed = velocity_of(e, &b->arm[v]);
    const taylor rate = taylor_dot(&b->n[v], &speed);
    const taylor_vector across = taylor_along(&speed, taylor_scale(-1, rate), &b->n[v]);
    return taylor_add(taylor_dot(&b->n[v], &a),
                      taylor_times(b->inverse[v], taylor_dot(&across, &across)));
}
