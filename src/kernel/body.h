/* A rigid body in redundant coordinates (ρ, i, j, k): accelerations and multipliers, (1.1)–(1.6).
 * Vectors in base axes; moments and second moments in the central frame. Theory: docs/theory/body.md. */
#ifndef GOUGH_KERNEL_BODY_H
#define GOUGH_KERNEL_BODY_H

#include "kernel/triad.h"

/* (1.1): the centre of mass and the triad; also their rates and accelerations */
typedef struct {
    vector rho;
    triad q;
} coordinates;

typedef struct {
    number mass;
    number Ix, Iy, Iz; /* second moments ∫x²dm …, (body-2) */
    number inverse_mass;
    number xy, yz, zx; /* reciprocals of the principal moments: 1/(I_x + I_y) … */
} body;

static inline body body_of(number mass, number Ix, number Iy, number Iz) {
    const number one = number_of(1);

    return (body){mass, Ix, Iy, Iz, one / mass, one / (Ix + Iy), one / (Iy + Iz), one / (Iz + Ix)};
}

/* (1.4): M ρ̈ = F, gravity not in F */
KERNEL_SMALL vector body_acceleration(const body *b, vector F, vector gravity) {
    return along(gravity, b->inverse_mass, F);
}

/* what ï, j̈, k̈ have along the other two axes */
typedef struct {
    number i_j, i_k, j_k, j_i, k_i, k_j;
} triad_bends;

/* second derivatives of the triad: along each axis itself −ė·ė, which keeps it of unit length */
KERNEL_INLINE triad triad_bent(const triad *q, const triad *rate, const triad_bends *t) {
    triad a;

    a.i = scale(-dot(rate->i, rate->i), q->i);
    a.i = along(a.i, t->i_j, q->j);
    a.i = along(a.i, t->i_k, q->k);

    a.j = scale(-dot(rate->j, rate->j), q->j);
    a.j = along(a.j, t->j_k, q->k);
    a.j = along(a.j, t->j_i, q->i);

    a.k = scale(-dot(rate->k, rate->k), q->k);
    a.k = along(a.k, t->k_i, q->i);
    a.k = along(a.k, t->k_j, q->j);
    return a;
}

/* (1.5), (body-4), with L the moment about the centre of mass along i, j, k */
KERNEL_INLINE triad triad_acceleration(const body *b, const triad *q, const triad *rate, vector L) {
    const number two = number_of(2);
    const number ij = two * b->xy * dot(rate->i, rate->j), z = L.z * b->xy;
    const number jk = two * b->yz * dot(rate->j, rate->k), x = L.x * b->yz;
    const number ki = two * b->zx * dot(rate->k, rate->i), y = L.y * b->zx;
    const triad_bends t = {z - b->Iy * ij,  -y - b->Iz * ki, x - b->Iz * jk,
                           -z - b->Ix * ij, y - b->Ix * ki,  -x - b->Iy * jk};

    return triad_bent(q, rate, &t);
}

/* Baumgarte's terms, (body-6): each constraint g = e_a·e_b − δ_ab then obeys g̈ + 2αġ + β²g = 0. What Λ adds to ë_a along
 * e_b is −I_b/(I_a + I_b) (2αġ + β²g), and half of it along e_a itself; no division by a single second moment */
static inline void triad_stabilise(const body *b, const triad *q, const triad *rate, number alpha,
                                   number beta, triad *a) {
    const number one = number_of(1), half = number_of(0.5), p = number_of(2) * alpha,
                 s = beta * beta;
    const number ii = p * number_of(2) * dot(q->i, rate->i) + s * (dot(q->i, q->i) - one);
    const number jj = p * number_of(2) * dot(q->j, rate->j) + s * (dot(q->j, q->j) - one);
    const number kk = p * number_of(2) * dot(q->k, rate->k) + s * (dot(q->k, q->k) - one);
    const number ij =
        (p * (dot(q->i, rate->j) + dot(rate->i, q->j)) + s * dot(q->i, q->j)) / (b->Ix + b->Iy);
    const number jk =
        (p * (dot(q->j, rate->k) + dot(rate->j, q->k)) + s * dot(q->j, q->k)) / (b->Iy + b->Iz);
    const number ki =
        (p * (dot(q->k, rate->i) + dot(rate->k, q->i)) + s * dot(q->k, q->i)) / (b->Iz + b->Ix);

    a->i = along(along(along(a->i, -half * ii, q->i), -b->Iy * ij, q->j), -b->Iz * ki, q->k);
    a->j = along(along(along(a->j, -half * jj, q->j), -b->Iz * jk, q->k), -b->Ix * ij, q->i);
    a->k = along(along(along(a->k, -half * kk, q->k), -b->Ix * ki, q->i), -b->Iy * jk, q->j);
}

/* (2.4) solved for the moment: L_x = (I_y + I_z) j̈·k + 2 I_z j̇·k̇ and so on */
static inline vector body_moment(const body *b, const triad *q, const triad *rate, const triad *a) {
    const number two = number_of(2);
    return (vector){
        (b->Iy + b->Iz) * dot(a->j, q->k) + two * b->Iz * dot(rate->j, rate->k),
        (b->Iz + b->Ix) * dot(a->k, q->i) + two * b->Ix * dot(rate->k, rate->i),
        (b->Ix + b->Iy) * dot(a->i, q->j) + two * b->Iy * dot(rate->i, rate->j),
    };
}

/* (body-6): multipliers Λ_ii, Λ_jj, Λ_kk, Λ_ij, Λ_jk, Λ_ki from the generalised forces Q on i, j, k; multiplied through by
 * I_a I_b, so that a flat body divides by no zero */
static inline void body_reactions(const body *b, const triad *q, const triad *rate, const triad *Q,
                                  number reactions[6]) {
    const number two = number_of(2);

    reactions[0] = -dot(Q->i, q->i) - b->Ix * dot(rate->i, rate->i);
    reactions[1] = -dot(Q->j, q->j) - b->Iy * dot(rate->j, rate->j);
    reactions[2] = -dot(Q->k, q->k) - b->Iz * dot(rate->k, rate->k);

    reactions[3] = -(dot(Q->i, q->j) * b->Iy + dot(Q->j, q->i) * b->Ix +
                     two * b->Ix * b->Iy * dot(rate->i, rate->j)) *
                   b->xy;
    reactions[4] = -(dot(Q->j, q->k) * b->Iz + dot(Q->k, q->j) * b->Iy +
                     two * b->Iy * b->Iz * dot(rate->j, rate->k)) *
                   b->yz;
    reactions[5] = -(dot(Q->k, q->i) * b->Ix + dot(Q->i, q->k) * b->Iz +
                     two * b->Iz * b->Ix * dot(rate->k, rate->i)) *
                   b->zx;
}

#endif
