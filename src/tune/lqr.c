/* Gains of least cost: the Riccati equation of the errors of the legs, by the stable subspace of its Hamiltonian. Theory:
 * docs/theory/tuning.md. */
#include <lapacke.h>
#include <math.h>
#include <string.h>

#include "base/quantity.h"
#include "tune/gains.h"

enum {
    N = GOUGH_LEGS,
    STATES = 2 * GOUGH_LEGS,
    ALL = 4 * GOUGH_LEGS,
    WORK = 2048,
    REFINEMENTS = 4
};

/* what may be left of the equation, over its terms */
static const double greatest_residual = 1e-12;

/* a real part below this part of the largest |λ| counts as 0: rounding moves a double eigenvalue on the axis by that much */
static const double on_axis = 1e-7;

typedef double state_matrix[STATES][STATES];

/* (tune-8): ẋ = A x + B u of x = (y, ẏ), y = S⁻¹ e, in which ÿ = −(ΓS y + ΔS ẏ + u): B Bᵀ has one block, 1, however close the
 * pose is to a singular one. In a unit of time in which the gains of y and ẏ are alike by the closed form of one mode, with costs
 * divided by their size, so that P is near 1. */
typedef struct {
    state_matrix A, Q;
    double effort; /* of B Bᵀ */
    double time;
} scaled_problem;

/* False if nothing is there: no load to hold and no weight. */
static bool scale(gains_plant *plant, const double weight[2], scaled_problem *p) {
    const double mobility = gains_size(plant->mobility);
    leg_matrix spring, square;

    memset(p, 0, sizeof *p);
    gains_product(plant->geometric, plant->mobility, spring);
    gains_product(plant->mobility, plant->mobility, square);
    const double fall = gains_size(spring), q1 = sqrt(weight[0]) * mobility,
                 q2 = sqrt(weight[1]) * mobility;
    const double stiff = fall + hypot(fall, q1), damped = hypot(sqrt(2 * stiff), q2);
    if (!(stiff > 0)) return false;
    const double time = damped / stiff, effort = damped * time;
    p->time = time, p->effort = effort;
    for (int i = 0; i < N; i++) {
        p->A[i][N + i] = 1;
        for (int j = 0; j < N; j++) {
            p->A[N + i][j] = -spring[i][j] * time * time;
            p->A[N + i][N + j] = -plant->viscous[i] * plant->mobility[i][j] * time;
            p->Q[i][j] = weight[0] * square[i][j] / effort * pow(time, 4);
            p->Q[N + i][N + j] = weight[1] * square[i][j] / effort * (time * time);
        }
    }
    return true;
}

static lapack_logical decays(const double *re, const double *im) {
    (void)im;
    return *re < 0;
}

/* [A −BBᵀ; −Q −Aᵀ] in Schur form, the decaying part first. False if it is not half of it, beyond rounding. */
static bool stable_subspace(scaled_problem *p, double vectors[ALL * ALL]) {
    double h[ALL * ALL] = {0}, re[ALL], im[ALL], work[WORK], largest = 0;
    lapack_logical side[ALL];
    lapack_int half = 0;

    for (int i = 0; i < STATES; i++) {
        for (int j = 0; j < STATES; j++) {
            h[i + ALL * j] = p->A[i][j];
            h[STATES + i + ALL * (STATES + j)] = -p->A[j][i];
            h[STATES + i + ALL * j] = -p->Q[i][j];
        }
    }
    for (int i = N; i < STATES; i++) h[i + ALL * (STATES + i)] = -p->effort;
    if (LAPACKE_dgees_work(LAPACK_COL_MAJOR, 'V', 'S', decays, ALL, h, ALL, &half, re, im, vectors,
                           ALL, work, WORK, side) != 0)
        return false;
    for (int k = 0; k < ALL; k++) largest = fmax(largest, hypot(re[k], im[k]));
    for (int k = 0; k < ALL; k++) {
        if (!(fabs(re[k]) > on_axis * largest)) return false;
    }
    return half == STATES;
}

/* P = U₂ U₁⁻¹, made symmetric, of the vectors (U₁, U₂) */
static bool solution(const double vectors[ALL * ALL], state_matrix P) {
    double first[STATES * STATES], second[STATES * STATES]; /* transposed: U₁ᵀ Pᵀ = U₂ᵀ */
    lapack_int pivot[STATES];

    for (int i = 0; i < STATES; i++) {
        for (int j = 0; j < STATES; j++) {
            first[j + STATES * i] = vectors[i + ALL * j];
            second[j + STATES * i] = vectors[STATES + i + ALL * j];
        }
    }
    if (LAPACKE_dgesv_work(LAPACK_COL_MAJOR, STATES, STATES, first, STATES, pivot, second,
                           STATES) != 0)
        return false;
    for (int i = 0; i < STATES; i++) {
        for (int j = 0; j < STATES; j++)
            P[i][j] = 0.5 * (second[i + STATES * j] + second[j + STATES * i]);
    }
    return true;
}

/* (tune-9): R = AᵀP + PA − PBBᵀP + Q; returns its size over the sum of those of its terms */
static double residual_of(scaled_problem *p, state_matrix P, state_matrix R) {
    double rest = 0, sizes = 0;

    for (int i = 0; i < STATES; i++) {
        for (int j = 0; j < STATES; j++) {
            double across = 0, cost = 0;
            for (int k = 0; k < STATES; k++) across += p->A[k][i] * P[k][j] + P[i][k] * p->A[k][j];
            for (int k = N; k < STATES; k++) cost += P[i][k] * p->effort * P[k][j];
            R[i][j] = across - cost + p->Q[i][j];
            rest = hypot(rest, R[i][j]);
            sizes = hypot(sizes, fabs(across) + fabs(cost) + fabs(p->Q[i][j]));
        }
    }
    return sizes > 0 ? rest / sizes : (double)NAN;
}

/* a' b c, or a b c', by columns */
static void sandwich(const double *a, bool first_turned, const double *b, const double *c,
                     double *out) {
    double half[STATES * STATES];

    for (int i = 0; i < STATES; i++) {
        for (int j = 0; j < STATES; j++) {
            half[i + STATES * j] = 0;
            for (int k = 0; k < STATES; k++)
                half[i + STATES * j] +=
                    (first_turned ? a[k + STATES * i] : a[i + STATES * k]) * b[k + STATES * j];
        }
    }
    for (int i = 0; i < STATES; i++) {
        for (int j = 0; j < STATES; j++) {
            out[i + STATES * j] = 0;
            for (int k = 0; k < STATES; k++)
                out[i + STATES * j] +=
                    half[i + STATES * k] * (first_turned ? c[k + STATES * j] : c[j + STATES * k]);
        }
    }
}

/* Newton's step of (tune-9): P + X, LᵀX + XL = −R with L = A − BBᵀP in Schur form */
static bool newton_step(scaled_problem *p, state_matrix P, state_matrix R) {
    double loop[STATES * STATES], U[STATES * STATES], x[STATES * STATES], re[STATES], im[STATES],
        work[WORK], size;
    lapack_int none = 0;

    for (int i = 0; i < STATES; i++) {
        for (int j = 0; j < STATES; j++) {
            loop[i + STATES * j] = p->A[i][j] - (i < N ? 0 : p->effort * P[i][j]);
            x[i + STATES * j] = -0.5 * (R[i][j] + R[j][i]);
        }
    }
    if (LAPACKE_dgees_work(LAPACK_COL_MAJOR, 'V', 'N', NULL, STATES, loop, STATES, &none, re, im, U,
                           STATES, work, WORK, NULL) != 0)
        return false;
    sandwich(U, true, x, U, x);
    if (LAPACKE_dtrsyl_work(LAPACK_COL_MAJOR, 'T', 'N', 1, STATES, STATES, loop, STATES, loop,
                            STATES, x, STATES, &size) < 0 ||
        !(size > 0))
        return false;
    sandwich(U, false, x, U, x);
    for (int i = 0; i < STATES; i++) {
        for (int j = 0; j < STATES; j++)
            P[i][j] += 0.5 * (x[i + STATES * j] + x[j + STATES * i]) / size;
    }
    return true;
}

/* P by the stable subspace, refined while that helps. Returns what is left of the equation. */
static double refine(scaled_problem *p, state_matrix P) {
    state_matrix R, next;
    double left = residual_of(p, P, R);

    for (int k = 0; k < REFINEMENTS; k++) {
        memcpy(next, P, sizeof next);
        if (!newton_step(p, next, R)) break;
        const double now = residual_of(p, next, R);
        if (!(now < left)) break;
        left = now;
        memcpy(P, next, sizeof next);
    }
    return left;
}

/* u = P₂₁ y + P₂₂ ẏ, so G = P₂₁ S⁻¹ and D = P₂₂ S⁻¹ */
static void gains_of(gains_plant *plant, scaled_problem *p, state_matrix P, gough_gains *gains) {
    const double unit = p->effort / (p->time * p->time);

    for (int i = 0; i < N; i++) {
        for (int j = 0; j < N; j++) {
            double stiffness = 0, damping = 0;
            for (int k = 0; k < N; k++) {
                stiffness += P[N + i][k] * plant->inertia[k][j];
                damping += P[N + i][N + k] * plant->inertia[k][j];
            }
            gains->stiffness[i][j] = stiffness * unit;
            gains->damping[i][j] = damping * unit * p->time;
        }
    }
}

static gough_status refuse(const double weight[2], gough_error *error) {
    return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                      "no gains of least cost make every deviation die out with the weights "
                      "(%.9g" IN_STIFFNESS ")^2 of errors of length and (%.9g" IN_DAMPING
                      ")^2 of their rates: some mode neither grows nor decays and hardly counts in "
                      "the cost; increase the weights",
                      sqrt(weight[0]), sqrt(weight[1]));
}

static gough_status check_weights(const double weight[2], gough_error *error) {
    static const char *const of[2] = {"errors of length", "errors of the rate"};
    static const char *const unit[2] = {"stiffness", "damping"};

    for (int k = 0; k < 2; k++) {
        if (weight[k] >= 0 && isfinite(weight[k])) continue;
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "the weight of %s must be 0 or more and finite, not %.9g (in the unit of "
                          "%s squared)",
                          of[k], weight[k], unit[k]);
    }
    return GOUGH_OK;
}

gough_status gough_gains_by_lqr(const gough_model *model, const double component[GOUGH_COMPONENTS],
                                double length_weight, double rate_weight, gough_gains *gains,
                                gough_error *error) {
    const double weight[2] = {length_weight, rate_weight};
    double vectors[ALL * ALL];
    state_matrix P;
    gains_plant plant;
    scaled_problem p;
    gough_status status = check_weights(weight, error);

    memset(gains, 0, sizeof *gains);
    if (status == GOUGH_OK) status = gains_plant_find(model, component, &plant, error);
    if (status != GOUGH_OK) return status;
    if (!scale(&plant, weight, &p)) return refuse(weight, error);
    for (int i = 0; i < STATES; i++) {
        for (int j = 0; j < STATES; j++) {
            if (!isfinite(p.A[i][j]) || !isfinite(p.Q[i][j])) return gains_fail(error);
        }
    }
    if (!stable_subspace(&p, vectors)) return refuse(weight, error);
    if (!solution(vectors, P)) return gains_fail(error);
    gains->residual = refine(&p, P);
    gains_of(&plant, &p, P, gains);
    if (!(gains->residual <= greatest_residual))
        return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                          "the gains of least cost are found only to %.2g of the terms of their "
                          "equation: the weights (%.9g" IN_STIFFNESS ")^2 and (%.9g" IN_DAMPING
                          ")^2, or the machine's numbers, differ too much in size",
                          gains->residual, sqrt(length_weight), sqrt(rate_weight));
    if (!gains_poles_find(&plant, gains)) return gains_fail(error);
    /* they come first that decay slowest */
    return gains->pole[0].value[0] < 0 ? GOUGH_OK : refuse(weight, error);
}
