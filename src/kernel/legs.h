/* Six extensible legs between base and load: lengths, rates, resultant, the six equations, (2.1)–(2.7).
 * Base axes unless a comment says central axes (those of the triad). Theory: docs/theory/legs.md. */
#ifndef GOUGH_KERNEL_LEGS_H
#define GOUGH_KERNEL_LEGS_H

#include "kernel/body.h"
#include "kernel/friction.h"
#include "kernel/leg_mass.h"
#include "kernel/solve.h"

enum { LEGS = 6 };

/* The machine as the equations see it. */
typedef struct {
    body load;
    vector gravity;
    vector base[LEGS]; /* base joints b_ν */
    vector arm[LEGS];  /* (x, y, z)_ν: top joints from the centre of mass, central axes */
    vector top[LEGS];  /* top joints from the top frame's origin, central axes */
    vector center;     /* centre of mass, top frame */
    triad axes;        /* central axes in the top frame */
    number reach; /* mean distance of the top joints from the top frame's origin: scales moments */
    leg_mass mass[LEGS];
    friction dry[LEGS];
} hexapod;

/* What the legs are in one pose, and in one motion. */
typedef struct {
    number length[LEGS]; /* (legs-2) */
    vector n[LEGS];      /* (legs-3) */
    number rate[LEGS];   /* (legs-4) */
} legs;

/* axes: columns are the central axes in the top frame; moments: second moments along them. Legs without mass and friction */
static inline void hexapod_setup(hexapod *h, const double base[LEGS][3], const double top[LEGS][3],
                                 double mass, const double center_of_mass[3], number axes[3][3],
                                 const number moments[3], const double gravity[3]) {
    static const double none[3] = {0, 0, 0};

    h->axes = (triad){{axes[0][0], axes[1][0], axes[2][0]},
                      {axes[0][1], axes[1][1], axes[2][1]},
                      {axes[0][2], axes[1][2], axes[2][2]}};
    h->load = body_of(number_of(mass), moments[0], moments[1], moments[2]);
    h->gravity = vector_of(gravity);
    h->center = vector_of(center_of_mass);

    h->reach = number_of(0);
    for (int v = 0; v < LEGS; v++) {
        h->base[v] = vector_of(base[v]);
        h->top[v] = onto(&h->axes, vector_of(top[v]));
        h->arm[v] = onto(&h->axes, subtract(vector_of(top[v]), h->center));
        h->reach = h->reach + norm(h->top[v]) / number_of(LEGS);
        h->mass[v] = leg_mass_of(none, none, 0);
        h->dry[v] = friction_none();
    }
}

/* (legs-1), (legs-2), (legs-3): ℓ = ρ + x i + y j + z k − b, l = |ℓ|, n = ℓ/l. All legs go through each step together: roots
 * and quotients take long, and six at a time hide it */
KERNEL_INLINE void legs_at(const hexapod *h, const coordinates *x, legs *g) {
    vector l[LEGS];
    number square[LEGS], inverse[LEGS];

    for (int v = 0; v < LEGS; v++) {
        l[v] = subtract(add(x->rho, out_of(&x->q, h->arm[v])), h->base[v]);
        square[v] = dot(l[v], l[v]);
    }
    for (int v = 0; v < LEGS; v++) g->length[v] = number_root(square[v]);
    for (int v = 0; v < LEGS; v++) inverse[v] = number_of(1) / g->length[v];
    for (int v = 0; v < LEGS; v++) g->n[v] = scale(inverse[v], l[v]);
}

/* top joint v less a point that is at rest, in coordinates, or its velocity or acceleration in their derivatives */
KERNEL_SMALL vector joint_of(const hexapod *h, const coordinates *x, int v) {
    return add(x->rho, out_of(&x->q, h->arm[v]));
}

/* (legs-4): l̇ = n·(ρ̇ + x i̇ + y j̇ + z k̇), of leg v */
KERNEL_SMALL number leg_rate(const hexapod *h, const coordinates *rate, int v, vector n) {
    return dot(n, joint_of(h, rate, v));
}

KERNEL_SMALL void legs_rates(const hexapod *h, const coordinates *rate, legs *g) {
    for (int v = 0; v < LEGS; v++) g->rate[v] = leg_rate(h, rate, v, g->n[v]);
}

/* (legs-6): ṅ = (v − l̇ n)/l, l̈ = n·a + l |ṅ|² */
static inline void legs_second_rates(const hexapod *h, const coordinates *rate,
                                     const coordinates *acceleration, const legs *g,
                                     number second_rate[LEGS]) {
    for (int v = 0; v < LEGS; v++) {
        const vector velocity = joint_of(h, rate, v), a = joint_of(h, acceleration, v);
        const vector turn =
            scale(number_of(1) / g->length[v], along(velocity, -g->rate[v], g->n[v]));

        second_rate[v] = dot(g->n[v], a) + g->length[v] * dot(turn, turn);
    }
}

/* What the legs do to the load: F = Σ u n, and the generalised forces on i, j, k, Q_i = Σ x u n …; base axes */
typedef struct {
    vector F;
    triad Q;
} push;

static inline push push_none(void) {
    const vector zero = {number_of(0), number_of(0), number_of(0)};

    return (push){zero, {zero, zero, zero}};
}

/* a force on top joint v */
KERNEL_SMALL void push_add(push *p, const hexapod *h, int v, vector f) {
    p->F = add(p->F, f);
    p->Q.i = along(p->Q.i, h->arm[v].x, f);
    p->Q.j = along(p->Q.j, h->arm[v].y, f);
    p->Q.k = along(p->Q.k, h->arm[v].z, f);
}

static inline push push_sum(const push *a, const push *b) {
    return (push){add(a->F, b->F), {add(a->Q.i, b->Q.i), add(a->Q.j, b->Q.j), add(a->Q.k, b->Q.k)}};
}

/* (2.6) in central axes: L_x = Σ (y F_z − z F_y) = Q_j·k − Q_k·j … */
KERNEL_SMALL vector push_moment(const push *p, const triad *q) {
    return (vector){
        dot(p->Q.j, q->k) - dot(p->Q.k, q->j),
        dot(p->Q.k, q->i) - dot(p->Q.i, q->k),
        dot(p->Q.i, q->j) - dot(p->Q.j, q->i),
    };
}

KERNEL_INLINE push legs_push(const hexapod *h, const legs *g, const number u[LEGS]) {
    push p = push_none();

    for (int v = 0; v < LEGS; v++) push_add(&p, h, v, scale(u[v], g->n[v]));
    return p;
}

/* (legs-7): the matrix of (2.5) and (2.6) for the legs' forces u, central axes; moments about the point from which the six
 * `arm` are measured, divided by the reach so that all entries are of one size */
static inline void legs_equations(const hexapod *h, const coordinates *x, const legs *g,
                                  const vector *arm, number a[6][6]) {
    for (int v = 0; v < LEGS; v++) {
        const vector n = onto(&x->q, g->n[v]);
        const vector m = scale(number_of(1) / h->reach, cross(arm[v], n));

        a[0][v] = n.x, a[1][v] = n.y, a[2][v] = n.z;
        a[3][v] = m.x, a[4][v] = m.y, a[5][v] = m.z;
    }
}

/* (legs-8): condition of the Jacobian about the top frame's origin, moment columns divided by the reach */
static inline number legs_condition(const hexapod *h, const coordinates *x, const legs *g) {
    number a[6][6], largest, smallest;

    legs_equations(h, x, g, h->top, a);
    singular_values(a, &largest, &smallest);
    return largest / smallest;
}

/* (legs-8): determinant of the same matrix, and the ratio of its pivots */
static inline elimination legs_determinant(const hexapod *h, const coordinates *x, const legs *g) {
    number a[6][6];

    legs_equations(h, x, g, h->top, a);
    return solve_six(a, NULL, 0);
}

/* Generalised forces on i, j, k with a moment m on the load (base axes) besides, as ½ m × e */
static inline triad push_generalised(const push *p, const triad *q, vector moment) {
    const vector half = scale(number_of(0.5), moment);

    return (triad){add(p->Q.i, cross(half, q->i)), add(p->Q.j, cross(half, q->j)),
                   add(p->Q.k, cross(half, q->k))};
}

#endif
