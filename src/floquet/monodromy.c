/* The variational equations over one period: ξ̇ = A(t) ξ for twelve columns, in pairs, by the stepper of the runs; A by complex
 * steps at the times of its stages. Theory: docs/theory/floquet.md. */
#define NUMBER_DOUBLE
#include "floquet/monodromy.h"
#include "base/quantity.h"

#include <string.h>

#include "base/limits.h"
#include "integrate/march.h"
#include "plant/hexapod.h"
#include "plant/state.h"
#include "program/appointments.h"

enum { N = GOUGH_LINEAR, PAIR = 2 * N, PAIRS = N / 2, MOST_STEPS = 20000 };

/* where no step meets the tolerance at such a condition, a singular pose ahead is why */
static const double hindering_condition = 1e4;

/* a step shorter than this part of the period tells that none will do */
static const double shortest = 1e-11;

/* One way through the period. */
typedef struct {
    monodromy *m;
    double t;
    double phi[MONODROMY_SIZE]; /* of the part so far */

    /* the motion itself, where it is not the program */
    bool moving;
    double y[MOTION], rate[MOTION], size[MOTION];

    double side;                        /* of the singular surface, as the sign of a determinant */
    linear_matrix stage[DOP853_STAGES]; /* A at the stages of the step, in units of m */
    int row;                            /* the next stage */
    const char *wrong;                  /* what is not finite */
    dop853 work;
    appointments when; /* steps over nothing in the program */
} passage;

/* ---- units ---- */

static double power_of_two(double x) { return x > 0 && real_finite(x) ? exp2(round(log2(x))) : 1; }

void monodromy_begin(monodromy *m, const gough_model *model, const gough_period *period,
                     double tolerance) {
    const double length = model->machine.base_radius, gravity = model->machine.gravity_magnitude;
    const double time = gravity > 0 ? sqrt(length / gravity) : period->period / (2 * REAL_PI);

    m->loop = (linear_loop){&model->machine, &model->motion, &model->control, false, 0};
    m->start = period->start;
    m->period = period->period;
    m->tolerance = tolerance;
    m->steps = 0;
    m->trace = 0;
    for (int i = 0; i < 3; i++) {
        m->unit[i] = power_of_two(length);
        m->unit[3 + i] = 1;
        m->unit[6 + i] = power_of_two(length / time);
        m->unit[9 + i] = power_of_two(1 / time);
    }
}

static void to_units(const monodromy *m, linear_matrix A) {
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) A[i][j] *= m->unit[j] / m->unit[i];
}

static void to_identity(double phi[MONODROMY_SIZE]) {
    for (int i = 0; i < MONODROMY_SIZE; i++) phi[i] = i % (N + 1) == 0;
}

void monodromy_multiply(const double *a, const double *b, double *c) {
    for (int column = 0; column < N; column++) {
        double *out = c + column * N;
        for (int i = 0; i < N; i++) out[i] = 0;
        for (int k = 0; k < N; k++) {
            const double weight = b[column * N + k];
            for (int i = 0; i < N; i++) out[i] += a[k * N + i] * weight;
        }
    }
}

void monodromy_product(const monodromy *m, double product[MONODROMY_SIZE]) {
    double before[MONODROMY_SIZE];

    to_identity(product);
    for (int part = 0; part < MONODROMY_PARTS; part++) {
        memcpy(before, product, sizeof before);
        monodromy_multiply(m->factor[part], before, product);
    }
}

/* ---- states ---- */

void monodromy_unfold(const gough_machine *machine, const gough_state *state, double y[MOTION]) {
    const vector none = {0, 0, 0};
    const double(*r)[3] = state->rotation;
    const triad R = {
        {r[0][0], r[1][0], r[2][0]}, {r[0][1], r[1][1], r[2][1]}, {r[0][2], r[1][2], r[2][2]}};
    coordinates x, rate;
    hexapod h;

    hexapod_of_machine(&h, machine);
    x = coordinates_of_top(&h, none, vector_of(state->position), &R);
    rate = rates_of_top(&h, &x, vector_of(state->velocity), vector_of(state->angular_velocity));
    coordinates_store(&x, y);
    coordinates_store(&rate, y + COORDINATES);
}

void monodromy_fold(const gough_machine *machine, const double y[MOTION], gough_state *state) {
    const coordinates x = coordinates_load(y), rate = coordinates_load(y + COORDINATES);
    hexapod h;
    vector p, v;
    triad R, turn;

    hexapod_of_machine(&h, machine);
    top_of_coordinates(&h, &x, &p, &R);
    top_of_coordinates(&h, &rate, &v, &turn);
    const vector axis[3] = {R.i, R.j, R.k};
    vector_store(p, state->position);
    vector_store(v, state->velocity);
    vector_store(angular_velocity_of(&x, &rate), state->angular_velocity);
    for (int c = 0; c < 3; c++) {
        state->rotation[0][c] = axis[c].x;
        state->rotation[1][c] = axis[c].y;
        state->rotation[2][c] = axis[c].z;
    }
}

/* ---- a step ---- */

/* the rate_function of a pair of columns */
static void deviation_rates(void *context, real t, const number *y, number *rate) {
    passage *p = context;
    double(*A)[N] = p->stage[p->row++];

    (void)t;
    for (int column = 0; column < PAIR; column += N) {
        for (int i = 0; i < N; i++) {
            double sum = 0;
            for (int j = 0; j < N; j++) sum += A[i][j] * y[column + j];
            rate[column + i] = sum;
        }
    }
}

/* the rate_function of the motion, which leaves A behind */
static void motion_rates(void *context, real t, const number *y, number *rate) {
    passage *p = context;
    const char *wrong = linear_complex.flow(&p->m->loop, t, y, rate, p->stage[p->row]);

    if (wrong != NULL) p->wrong = wrong;
    to_units(p->m, p->stage[p->row++]);
}

/* A at the stages of a step from t to t + h: the first is known, the last is at its end */
static double stages_of_program(passage *p, double h) {
    double t[DOP853_STAGES];

    for (int row = 0; row < DOP853_STAGES; row++) t[row] = p->t + dop853_c[row] * h;
    p->wrong = linear_complex.along(&p->m->loop, t + 1, DOP853_STAGES - 1, p->stage + 1);
    for (int row = 1; row < DOP853_STAGES; row++) to_units(p->m, p->stage[row]);
    return 0;
}

static double stages_of_motion(passage *p, double h, double *after) {
    memcpy(p->work.slope[0], p->rate, sizeof p->rate);
    p->row = 1;
    dop853_step(&p->work, motion_rates, p, MOTION, p->t, h, p->y, after);
    return dop853_error(&p->work, MOTION, h, p->y, after, p->size, p->m->tolerance);
}

/* Tries a step; returns its error over the tolerance. */
static double try_step(passage *p, double h, double *phi, double *y) {
    static const double size[PAIR] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1,
                                      1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
    double worst = p->moving ? stages_of_motion(p, h, y) : stages_of_program(p, h);

    for (int pair = 0; pair < PAIRS; pair++) {
        const double *from = p->phi + pair * PAIR;
        double *to = phi + pair * PAIR, error;
        p->row = 0;
        deviation_rates(p, p->t, from, p->work.slope[0]);
        dop853_step(&p->work, deviation_rates, p, PAIR, p->t, h, from, to);
        error = dop853_error(&p->work, PAIR, h, from, to, size, p->m->tolerance);
        if (!(error <= worst)) worst = error;
    }
    return worst;
}

/* the determinant of the program's pose where the period begins: the side of the singular surface to be kept to */
static double side_of_program(const monodromy *m) {
    gough_acceleration acceleration;
    gough_state state;
    double side;

    gough_program(m->loop.machine, m->loop.motion, m->start, &state, &acceleration);
    gough_conditioning(m->loop.machine, &state, NULL, &side);
    return side;
}

static double condition_now(const passage *p, double *determinant) {
    gough_acceleration acceleration;
    double condition;
    gough_state state;

    if (p->moving)
        monodromy_fold(p->m->loop.machine, p->y, &state);
    else
        gough_program(p->m->loop.machine, p->m->loop.motion, p->t, &state, &acceleration);
    gough_conditioning(p->m->loop.machine, &state, &condition, determinant);
    return condition;
}

static gough_status say_singular(const passage *p, double condition, gough_error *error) {
    return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                      "by t = %.9g" IN_TIME
                      " the %s has reached a singular or nearly singular pose "
                      "(condition %.3g); choose a motion that avoids it",
                      p->t, p->moving ? "platform" : "program", condition);
}

/* Stops at a pose that is singular or nearly so, and beyond one: a motion through it cannot be run. */
static gough_status check_pose(passage *p, gough_error *error) {
    double determinant;
    const double condition = condition_now(p, &determinant);

    if (condition <= greatest_condition && determinant * p->side > 0) return GOUGH_OK;
    return say_singular(p, condition, error);
}

/* the accepted step: trace, motion projected, A at the new beginning */
static gough_status settle(passage *p, double t, double h, const double *phi, const double *y,
                           gough_error *error) {
    for (int row = 0; row < DOP853_STAGES; row++) {
        for (int i = 0; i < N; i++)
            p->m->trace += h * dop853_a[DOP853_STAGES][row] * p->stage[row][i][i];
    }
    memcpy(p->phi, phi, sizeof p->phi);
    p->t = t;
    p->m->steps++;
    if (p->moving) {
        coordinates x = coordinates_load(y), rate = coordinates_load(y + COORDINATES);
        coordinates_project(&x, &rate);
        coordinates_store(&x, p->y);
        coordinates_store(&rate, p->y + COORDINATES);
        p->row = 0;
        motion_rates(p, p->t, p->y, p->rate);
    } else {
        memcpy(p->stage[0], p->stage[DOP853_STAGES - 1], sizeof(linear_matrix));
    }
    return check_pose(p, error);
}

static gough_status stuck(const passage *p, gough_error *error) {
    if (p->wrong != NULL)
        return gough_fail(error, GOUGH_ERROR_INPUT, "%s is not finite near t = %.9g" IN_TIME,
                          p->wrong, p->t);
    if (!(condition_now(p, NULL) <= hindering_condition))
        return say_singular(p, condition_now(p, NULL), error);
    if (p->m->steps >= MOST_STEPS)
        return gough_fail(
            error, GOUGH_ERROR_NUMERICAL,
            "one period needs more than %d steps, because it is long or the legs are stiff, and "
            "the platform oscillates very often in it; shorten the period or reduce the stiffness",
            MOST_STEPS);
    return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                      "at t = %.9g" IN_TIME
                      " no step meets the tolerance: the motion is not smooth there, or "
                      "a leg has no length; a larger tolerance may help",
                      p->t);
}

/* ---- steps through a part of the period ---- */

typedef struct {
    passage *p;
    double end;                            /* of the part */
    double phi[MONODROMY_SIZE], y[MOTION]; /* at the end of the step being tried */
    double step,
        count; /* its length, and how many such steps the rest of the part is divided into */
    gough_status status;
    gough_error *error;
} part_of_period;

/* the next step, an even part of what is left; 0 at the end of the part, and where no step will do */
static double part_length(void *context, double wish, int rejected) {
    part_of_period *w = context;
    passage *p = w->p;

    if (!(p->t < w->end)) return 0;
    p->wrong = rejected && w->step < shortest * p->m->period ? p->wrong : NULL;
    if ((rejected && w->step < shortest * p->m->period) || p->m->steps >= MOST_STEPS) {
        w->status = stuck(p, w->error);
        return 0;
    }
    const double left = w->end - p->t, most = appointments_step(&p->when, p->t, left, 1);
    w->count = ceil(left / fmin(wish, most) * (1 - 1e-9));
    w->step = left / w->count;
    return w->step;
}

static double part_attempt(void *context, double step) {
    part_of_period *w = context;
    const double error = try_step(w->p, step, w->phi, w->y);

    return w->p->wrong == NULL ? error : NAN;
}

static int part_keep(void *context) {
    part_of_period *w = context;
    const double t = w->count > 1 ? w->p->t + w->step : w->end;

    w->status = settle(w->p, t, w->step, w->phi, w->y, w->error);
    return w->status != GOUGH_OK;
}

/* one part of the period; *h is the step proposed, at first and for the next part */
static gough_status pass(passage *p, double end, double *h, gough_error *error) {
    static const march_rules rules = {part_length, part_attempt, part_keep};
    part_of_period w;

    w.p = p;
    w.end = end;
    w.step = w.count = 0;
    w.status = GOUGH_OK;
    w.error = error;
    to_identity(p->phi);
    march_adaptive(&rules, &w, h);
    return w.status;
}

static gough_status go_round(passage *p, gough_error *error) {
    monodromy *m = p->m;
    double h = m->period / (4 * MONODROMY_PARTS);

    m->steps = 0;
    m->trace = 0;
    p->side = side_of_program(m);
    appointments_begin(&p->when, m->loop.motion, NULL, m->loop.machine, m->start, m->period,
                       m->period / MONODROMY_PARTS);
    if (check_pose(p, error) != GOUGH_OK) return GOUGH_ERROR_NUMERICAL;
    for (int part = 0; part < MONODROMY_PARTS; part++) {
        const double end = m->start + m->period * (part + 1) / MONODROMY_PARTS;
        const gough_status status = pass(p, end, &h, error);
        if (status != GOUGH_OK) return status;
        memcpy(m->factor[part], p->phi, sizeof p->phi);
    }
    return GOUGH_OK;
}

gough_status monodromy_of_program(monodromy *m, gough_error *error) {
    passage p = {.m = m, .t = m->start};
    const char *wrong = linear_complex.along(&m->loop, &m->start, 1, p.stage);
    const gough_status status = linear_check(&m->loop, m->start, NULL, p.stage[0], wrong, error);

    if (status != GOUGH_OK) return status;
    to_units(m, p.stage[0]);
    return go_round(&p, error);
}

gough_status monodromy_of_motion(monodromy *m, double y[MOTION], gough_error *error) {
    passage p = {.m = m, .t = m->start, .moving = true};
    gough_status status;

    for (int i = 0; i < COORDINATES; i++) {
        p.size[i] = i < 3 ? m->unit[0] : 1;
        p.size[COORDINATES + i] = i < 3 ? m->unit[6] : m->unit[9];
    }
    memcpy(p.y, y, sizeof p.y);
    motion_rates(&p, p.t, p.y, p.rate);
    if (p.wrong != NULL) return stuck(&p, error);
    status = go_round(&p, error);
    memcpy(y, p.y, sizeof p.y);
    return status;
}
