/* Transition matrices of the linear loop over a number type: steps of Dormand and Prince's method for several stiffnesses side by
 * side, and products over the parts of a period of what was found at a few of them. Theory: docs/theory/floquet.md. */
#include <string.h>

#include "integrate/dop853.h"
#include "map/lane_matrices_table.h"

typedef struct {
    number stiffness;
    number phi[GOUGH_LINEAR][GOUGH_LINEAR]; /* [column][row] */
} group;

/* A at the stages of a step, for the lanes' G: the rows of the angle's rate, and those of the accelerations */
typedef struct {
    number turn[STAGES][3][3];
    number acceleration[STAGES][6][GOUGH_LINEAR];
    int stage;
} lane_step;

static void group_begin(void *memory, const double *stiffness) {
    group *g = memory;

    for (int i = 0; i < NUMBER_WIDTH; i++) number_put(&g->stiffness, i, stiffness[i]);
    for (int j = 0; j < GOUGH_LINEAR; j++) {
        for (int i = 0; i < GOUGH_LINEAR; i++) g->phi[j][i] = number_of(i == j);
    }
}

/* (floquet-20): A = base + G gain */
static void prepare_step(const group *g, const loop_step *s, lane_step *l) {
    for (int k = 0; k < STAGES; k++) {
        for (int i = 0; i < 3; i++) {
            for (int j = 0; j < 3; j++) l->turn[k][i][j] = number_of(s->base[k][3 + i][3 + j]);
        }
        for (int i = 0; i < 6; i++) {
            for (int j = 0; j < GOUGH_LINEAR; j++)
                l->acceleration[k][i][j] = number_of(s->base[k][6 + i][j]);
            for (int j = 0; j < 6; j++) {
                l->acceleration[k][i][j] =
                    l->acceleration[k][i][j] + g->stiffness * number_of(s->gain[k][i][j]);
            }
        }
    }
}

/* (stab-13), a column of Φ: the rate_function of a step, whose stages come in their order */
static void column_rate(void *context, real t, const number *y, number *rate) {
    lane_step *l = context;
    const int k = l->stage++;

    (void)t;
    for (int i = 0; i < 3; i++) {
        rate[i] = y[6 + i];
        rate[3 + i] = y[9 + i];
        for (int j = 0; j < 3; j++) rate[3 + i] = rate[3 + i] + l->turn[k][i][j] * y[3 + j];
    }
    for (int i = 0; i < 6; i++) {
        number sum = l->acceleration[k][i][0] * y[0];
        for (int j = 1; j < GOUGH_LINEAR; j++) sum = sum + l->acceleration[k][i][j] * y[j];
        rate[6 + i] = sum;
    }
}

static void group_advance(void *memory, const loop_step *step, double h) {
    group *g = memory;
    lane_step l;
    dop853 s;

    prepare_step(g, step, &l);
    for (int j = 0; j < GOUGH_LINEAR; j++) {
        number out[GOUGH_LINEAR];
        l.stage = 0;
        column_rate(&l, 0, g->phi[j], s.slope[0]);
        dop853_step(&s, column_rate, &l, GOUGH_LINEAR, 0, h, g->phi[j], out);
        for (int i = 0; i < GOUGH_LINEAR; i++) g->phi[j][i] = out[i];
    }
}

static void put_out(number phi[GOUGH_LINEAR][GOUGH_LINEAR], double (*out)[MATRIX]) {
    for (int lane = 0; lane < NUMBER_WIDTH; lane++) {
        for (int j = 0; j < GOUGH_LINEAR; j++) {
            for (int i = 0; i < GOUGH_LINEAR; i++)
                out[lane][GOUGH_LINEAR * j + i] = number_lane(phi[j][i], lane);
        }
    }
}

static void group_store(void *memory, double (*phi)[MATRIX]) {
    put_out(((group *)memory)->phi, phi);
}

/* (floquet-21): ℓ_i(x) = (2/N) Σ' T_k(x_i) T_k(x), what the value at each point weighs at x */
static void weights_at(const transitions *t, const double *stiffness, number weight[NODES]) {
    number G = number_of(0), x, before, now;

    for (int lane = 0; lane < NUMBER_WIDTH; lane++) number_put(&G, lane, stiffness[lane]);
    x = number_of(2) * G / number_of(t->top) - number_of(1);
    before = number_of(1), now = x;
    for (int i = 0; i < NODES; i++) weight[i] = number_of(0.5);
    for (int k = 1; k < NODES; k++) {
        const number next = number_of(2) * x * now - before;
        for (int i = 0; i < NODES; i++) weight[i] = weight[i] + number_of(t->cosine[k][i]) * now;
        before = now, now = next;
    }
    for (int i = 0; i < NODES; i++) weight[i] = weight[i] * number_of(2.0 / NODES);
}

/* product = part · phi */
static void multiply(const number part[MATRIX], number phi[GOUGH_LINEAR][GOUGH_LINEAR],
                     number product[GOUGH_LINEAR][GOUGH_LINEAR]) {
    for (int j = 0; j < GOUGH_LINEAR; j++) {
        for (int i = 0; i < GOUGH_LINEAR; i++) product[j][i] = part[i] * phi[j][0];
        for (int k = 1; k < GOUGH_LINEAR; k++) {
            for (int i = 0; i < GOUGH_LINEAR; i++)
                product[j][i] = product[j][i] + part[GOUGH_LINEAR * k + i] * phi[j][k];
        }
    }
}

static void compose(const transitions *t, const double *stiffness, double (*out)[MATRIX]) {
    number weight[NODES], part[MATRIX];
    number phi[GOUGH_LINEAR][GOUGH_LINEAR], product[GOUGH_LINEAR][GOUGH_LINEAR];

    weights_at(t, stiffness, weight);
    for (size_t p = 0; p < t->parts; p++) {
        for (int e = 0; e < MATRIX; e++) part[e] = weight[0] * number_of(t->phi[p][0][e]);
        for (int i = 1; i < NODES; i++) {
            for (int e = 0; e < MATRIX; e++)
                part[e] = part[e] + weight[i] * number_of(t->phi[p][i][e]);
        }
        if (p == 0) {
            memcpy(phi, part, sizeof phi);
        } else {
            multiply(part, phi, product);
            memcpy(phi, product, sizeof phi);
        }
    }
    put_out(phi, out);
}
