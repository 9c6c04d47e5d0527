/* Differences in quadruple precision of the run's equations of motion, along the manifold that (1.2) leaves free. */
#define NUMBER_QUAD
#include "differences.h"

#include "system/system.h"

static const gough_disturbance undisturbed;

/* lengths of the two steps between which Richardson extrapolates: errors of h⁴, some 1e-20, round-off 1e-33/h */
static const double step = 1e-5;

/* exp of the rotation vector applied to v: Rodrigues' formula by its series, |w| ≤ 1e-5 */
static vector rotated(vector w, vector v) {
    vector term = v, sum = v;

    for (int n = 1; n <= 8; n++) {
        term = scale(1 / (real)n, cross(w, term));
        sum = add(sum, term);
    }
    return sum;
}

static triad turned(vector w, const triad *q) {
    return (triad){rotated(w, q->i), rotated(w, q->j), rotated(w, q->k)};
}

static vector unit_vector(int axis) { return (vector){axis == 0, axis == 1, axis == 2}; }

/* position, triad, velocity, angular velocity */
typedef struct {
    vector rho, v, omega;
    triad q;
} moving;

static moving displaced(const moving *m, int direction, real h) {
    const vector by = scale(h, unit_vector(direction % 3));
    moving out = *m;

    switch (direction / 3) {
    case 0:
        out.rho = add(m->rho, by);
        break;
    case 1:
        out.q = turned(by, &m->q);
        break;
    case 2:
        out.v = add(m->v, by);
        break;
    default:
        out.omega = add(m->omega, by);
    }
    return out;
}

/* ρ̈ and ω̇ = ½ Σ e × ë, the terms of e × (ω × (ω × e)) being 0 in sum */
static void accelerations(struct system *r, real t, const moving *m, real out[6]) {
    const coordinates x = {m->rho, m->q}, rate = {m->v, triad_rate(&m->q, m->omega)};
    number y[STATE_SIZE], change[STATE_SIZE];
    coordinates a;

    coordinates_store(&x, y);
    coordinates_store(&rate, y + COORDINATES);
    system_rates(r, t, y, change);
    a = coordinates_load(change + COORDINATES);
    vector_store(a.rho, out);
    vector_store(angular_velocity_of(&x, &a), out + 3);
}

/* Rotation from one triad to another, as a vector: the skew part of Σ b aᵀ, sin|θ|/|θ| θ */
static vector between(const triad *a, const triad *b) {
    const vector sum = add(add(cross(a->i, b->i), cross(a->j, b->j)), cross(a->k, b->k));

    return scale((real)1 / 2, sum);
}

/* central difference of δθ by time: both move on freely for τ, turning as fast as they do at first */
static vector turning(const moving *m, int direction, real h) {
    vector sum = {0, 0, 0};

    for (int side = -1; side <= 1; side += 2) {
        for (int time = -1; time <= 1; time += 2) {
            const real tau = time * h;
            const moving other = displaced(m, direction, side * h);
            const triad a = turned(scale(tau, m->omega), &m->q),
                        b = turned(scale(tau, other.omega), &other.q);
            sum = add(sum, scale(side * time / (4 * h * h), between(&a, &b)));
        }
    }
    return sum;
}

/* δṙ, δθ̇, δv̇, δω̇ per displacement, by steps of h to both sides */
static void column(struct system *r, real t, const moving *m, int direction, real h,
                   real out[GOUGH_LINEAR]) {
    const moving plus = displaced(m, direction, h), minus = displaced(m, direction, -h);
    real up[6], down[6];

    accelerations(r, t, &plus, up);
    accelerations(r, t, &minus, down);
    vector_store(scale(1 / (2 * h), subtract(plus.v, minus.v)), out);
    vector_store(turning(m, direction, h), out + 3);
    for (int i = 0; i < 6; i++) out[6 + i] = (up[i] - down[i]) / (2 * h);
}

static moving state_of(struct system *r, real t, const gough_state *state) {
    const vector none = {0, 0, 0};
    coordinates x, rate;

    if (state == NULL) {
        x = system_wanted(r, t)->x[0], rate = system_wanted(r, t)->x[1];
    } else {
        const triad R = {
            {state->rotation[0][0], state->rotation[1][0], state->rotation[2][0]},
            {state->rotation[0][1], state->rotation[1][1], state->rotation[2][1]},
            {state->rotation[0][2], state->rotation[1][2], state->rotation[2][2]},
        };
        x = coordinates_of_top(&r->h, none, vector_of(state->position), &R);
        rate =
            rates_of_top(&r->h, &x, vector_of(state->velocity), vector_of(state->angular_velocity));
    }
    return (moving){x.rho, rate.rho, triad_angular_velocity(&x.q, &rate.q), x.q};
}

void difference_matrix(const gough_model *model, double t, const gough_state *state,
                       double matrix[GOUGH_LINEAR][GOUGH_LINEAR]) {
    gough_simulation options = gough_simulation_default();
    const system_lane lane = {&model->machine, &model->control, &undisturbed, 0, 0};
    moving m;
    struct system r;

    options.constraints = GOUGH_NONE;
    system_begin(&r, &model->motion, &options, &lane);
    m = state_of(&r, t, state);
    for (int direction = 0; direction < GOUGH_LINEAR; direction++) {
        real coarse[GOUGH_LINEAR], fine[GOUGH_LINEAR];
        column(&r, t, &m, direction, step, coarse);
        column(&r, t, &m, direction, (real)step / 2, fine);
        for (int i = 0; i < GOUGH_LINEAR; i++)
            matrix[i][direction] = (double)((4 * fine[i] - coarse[i]) / 3);
    }
}
