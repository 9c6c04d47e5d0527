/* The variational equations over one period: ξ̇ = A(t) ξ for all columns, some at a time, by the stepper of the runs; A by complex
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

enum { MOST_STEPS = 20000, MOST_STEPS_OF_DRIVES = 100000, FEW_PARTS = 4, FASTEST = 8 };

typedef double stage_matrix[MONODROMY_SIZE]; /* n × n, row by row */

/* where no step meets the tolerance at such a condition, a singular pose ahead is why */
static const double hindering_condition = 1e4;

/* Where a drive comes to a limit, A jumps, and no step over that time meets a tolerance: one as short as this part of the period
 * is taken all the same, and its error is as small. */
static const double kink = 1e-10;

/* a step shorter than this part of the period tells that none will do */
static const double shortest = 1e-11;

/* One way through the period. */
typedef struct {
    monodromy *m;
    double t;
    double phi[MONODROMY_SIZE]; /* of the part so far */

    /* the motion itself, where it is not the program */
    bool moving;
    int states; /* its numbers */
    double y[STATE_SIZE], rate[STATE_SIZE], size[STATE_SIZE];

    double side;                       /* of the singular surface, as the sign of a determinant */
    stage_matrix stage[DOP853_STAGES]; /* A at the stages of the step, in units of m */
    int row;                           /* the next stage */
    int columns;                       /* that are stepped together */
    const char *wrong;                 /* what is not finite */
    dop853 work;
    appointments when; /* steps over nothing in the program */
} passage;

/* ---- units ---- */

static double power_of_two(double x) { return x > 0 && real_finite(x) ? exp2(round(log2(x))) : 1; }

bool monodromy_is_whole(const gough_model *model) {
    const gough_actuators *a = &model->machine.platform.actuators;
    int kept[LINEAR_BEYOND];

    for (int v = 0; v < GOUGH_LEGS; v++)
        if (a->max_force[v][0] < a->max_force[v][1]) return true;
    return linear_beyond(&model->machine, &model->control, kept) > 0;
}

/* the decay of the quickest drive in a period decides */
static int parts_for(const gough_model *model, const gough_period *period) {
    const gough_actuators *a = &model->machine.platform.actuators;
    double fastest = 0;

    for (int v = 0; v < GOUGH_LEGS && a->kind == GOUGH_ACTUATOR_LAG; v++)
        fastest = fmax(fastest, a->time_constant[v] > 0 ? 1 / a->time_constant[v]
                                                        : 2 * REAL_PI * a->frequency[v]);
    return fastest * period->period > FASTEST * MONODROMY_PARTS ? FEW_PARTS : MONODROMY_PARTS;
}

/* of a force, which an integral is too, or of its rate */
static double unit_beyond(const monodromy *m, int place) {
    const gough_machine *machine = m->loop.machine;
    const gough_actuators *a = &machine->platform.actuators;
    const bool second = a->kind == GOUGH_ACTUATOR_LAG && !(a->time_constant[0] > 0);
    const double time = m->unit[0] / m->unit[6], force = machine->load.mass * m->unit[6] / time;

    return power_of_two(second && place / GOUGH_LEGS == 1 ? force / time : force);
}

void monodromy_begin(monodromy *m, const gough_model *model, const gough_period *period,
                     double tolerance) {
    const double length = model->machine.base_radius, gravity = model->machine.gravity_magnitude;
    const double time = gravity > 0 ? sqrt(length / gravity) : period->period / (2 * REAL_PI);

    m->loop = (linear_loop){.machine = &model->machine,
                            .motion = &model->motion,
                            .control = &model->control,
                            .whole = monodromy_is_whole(model)};
    m->n = GOUGH_LINEAR + linear_beyond(&model->machine, &model->control, m->kept);
    m->parts = parts_for(model, period);
    m->bare = false;
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
    for (int i = GOUGH_LINEAR; i < m->n; i++)
        m->unit[i] = unit_beyond(m, m->kept[i - GOUGH_LINEAR]);
}

static void to_units(const monodromy *m, stage_matrix A) {
    for (int i = 0; i < m->n; i++)
        for (int j = 0; j < m->n; j++) A[m->n * i + j] *= m->unit[j] / m->unit[i];
}

static void to_identity(int n, double phi[MONODROMY_SIZE]) {
    for (int i = 0; i < n * n; i++) phi[i] = i % (n + 1) == 0;
}

void monodromy_multiply(int n, const double *a, const double *b, double *c) {
    for (int column = 0; column < n; column++) {
        double *out = c + column * n;
        for (int i = 0; i < n; i++) out[i] = 0;
        for (int k = 0; k < n; k++) {
            const double weight = b[column * n + k];
            for (int i = 0; i < n; i++) out[i] += a[k * n + i] * weight;
        }
    }
}

void monodromy_product(const monodromy *m, double product[MONODROMY_SIZE]) {
    double before[MONODROMY_SIZE];

    to_identity(m->n, product);
    for (int part = 0; part < m->parts; part++) {
        memcpy(before, product, sizeof before);
        monodromy_multiply(m->n, m->factor[part], before, product);
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

/* the rate_function of some columns */
static void deviation_rates(void *context, real t, const number *y, number *rate) {
    passage *p = context;
    const double *A = p->stage[p->row++];
    const int n = p->m->n;

    (void)t;
    for (int column = 0; column < p->columns * n; column += n) {
        for (int i = 0; i < n; i++) {
            double sum = 0;
            for (int j = 0; j < n; j++) sum += A[n * i + j] * y[column + j];
            rate[column + i] = sum;
        }
    }
}

/* the rate_function of the motion, which leaves A behind */
static void motion_rates(void *context, real t, const number *y, number *rate) {
    passage *p = context;
    double *A = p->stage[p->row++];
    const char *wrong =
        linear_complex.flow(&p->m->loop, t, y, rate, p->m->kept, p->m->n, p->m->bare ? NULL : A);

    if (wrong != NULL) p->wrong = wrong;
    if (!p->m->bare) to_units(p->m, A);
}

/* A at the stages of a step from t to t + h: the first is known, the last is at its end */
static double stages_of_program(passage *p, double h) {
    double t[DOP853_STAGES];
    linear_matrix A[DOP853_STAGES];

    for (int row = 0; row < DOP853_STAGES; row++) t[row] = p->t + dop853_c[row] * h;
    p->wrong = linear_complex.along(&p->m->loop, t + 1, DOP853_STAGES - 1, A + 1);
    for (int row = 1; row < DOP853_STAGES; row++) {
        memcpy(p->stage[row], A[row], sizeof A[row]);
        to_units(p->m, p->stage[row]);
    }
    return 0;
}

static double stages_of_motion(passage *p, double h, double *after) {
    memcpy(p->work.slope[0], p->rate, sizeof p->rate);
    p->row = 1;
    dop853_step(&p->work, motion_rates, p, p->states, p->t, h, p->y, after);
    return dop853_error(&p->work, p->states, h, p->y, after, p->size, p->m->tolerance);
}

/* Tries a step; returns its error over the tolerance. */
static double try_step(passage *p, double h, double *phi, double *y) {
    const int n = p->m->n, together = n > GOUGH_LINEAR ? 1 : 2;
    double size[STATE_SIZE];
    double worst = p->moving ? stages_of_motion(p, h, y) : stages_of_program(p, h);

    for (int i = 0; i < together * n; i++) size[i] = 1;
    p->columns = together;
    for (int column = 0; column < n && !p->m->bare; column += together) {
        const double *from = p->phi + column * n;
        double *to = phi + column * n, error;
        p->row = 0;
        deviation_rates(p, p->t, from, p->work.slope[0]);
        dop853_step(&p->work, deviation_rates, p, together * n, p->t, h, from, to);
        error = dop853_error(&p->work, together * n, h, from, to, size, p->m->tolerance);
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
    const int n = p->m->n;

    for (int row = 0; row < DOP853_STAGES && !p->m->bare; row++) {
        for (int i = 0; i < n; i++)
            p->m->trace += h * dop853_a[DOP853_STAGES][row] * p->stage[row][(n + 1) * i];
    }
    if (!p->m->bare) memcpy(p->phi, phi, (size_t)(n * n) * sizeof *phi);
    p->t = t;
    p->m->steps++;
    if (p->moving) {
        coordinates x = coordinates_load(y), rate = coordinates_load(y + COORDINATES);
        coordinates_project(&x, &rate);
        coordinates_store(&x, p->y);
        coordinates_store(&rate, p->y + COORDINATES);
        memcpy(p->y + MOTION, y + MOTION, (size_t)(p->states - MOTION) * sizeof *y);
        p->row = 0;
        motion_rates(p, p->t, p->y, p->rate);
    } else {
        memcpy(p->stage[0], p->stage[DOP853_STAGES - 1], sizeof(stage_matrix));
    }
    return check_pose(p, error);
}

static size_t most_steps(const monodromy *m) {
    return m->n > GOUGH_LINEAR ? MOST_STEPS_OF_DRIVES : MOST_STEPS;
}

static gough_status stuck(const passage *p, gough_error *error) {
    if (p->wrong != NULL)
        return gough_fail(error, GOUGH_ERROR_INPUT, "%s is not finite near t = %.9g" IN_TIME,
                          p->wrong, p->t);
    if (!(condition_now(p, NULL) <= hindering_condition))
        return say_singular(p, condition_now(p, NULL), error);
    if (p->m->steps >= most_steps(p->m) && p->m->n > GOUGH_LINEAR)
        return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                          "one period needs more than %d steps, because it is long beside the lag "
                          "of the drives or the legs are stiff; shorten the period, or give slower "
                          "drives or none that lag",
                          MOST_STEPS_OF_DRIVES);
    if (p->m->steps >= most_steps(p->m))
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
    double end;                                /* of the part */
    double phi[MONODROMY_SIZE], y[STATE_SIZE]; /* at the end of the step being tried */
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
    if ((rejected && w->step < shortest * p->m->period) || p->m->steps >= most_steps(p->m)) {
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
    const monodromy *m = w->p->m;
    const double error = try_step(w->p, step, w->phi, w->y);

    if (w->p->wrong != NULL) return NAN;
    return m->loop.whole && step < kink * m->period && error > 1 ? 0 : error;
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
    if (!p->m->bare) to_identity(p->m->n, p->phi);
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
    for (int part = 0; part < m->parts; part++) {
        const double end = m->start + m->period * (part + 1) / m->parts;
        const gough_status status = pass(p, end, &h, error);
        if (status != GOUGH_OK) return status;
        if (!m->bare) memcpy(m->factor[part], p->phi, (size_t)(m->n * m->n) * sizeof *p->phi);
    }
    return GOUGH_OK;
}

gough_status monodromy_of_program(monodromy *m, gough_error *error) {
    passage p = {.m = m, .t = m->start};
    linear_matrix A;
    const char *wrong = linear_complex.along(&m->loop, &m->start, 1, &A);
    const gough_status status = linear_check(&m->loop, m->start, NULL, A, wrong, error);

    if (status != GOUGH_OK) return status;
    memcpy(p.stage[0], A, sizeof A);
    to_units(m, p.stage[0]);
    return go_round(&p, error);
}

gough_status monodromy_of_motion(monodromy *m, double y[STATE_SIZE], gough_error *error) {
    passage p = {.m = m, .t = m->start, .moving = true};
    gough_status status;

    for (int i = 0; i < COORDINATES; i++) {
        p.size[i] = i < 3 ? m->unit[0] : 1;
        p.size[COORDINATES + i] = i < 3 ? m->unit[6] : m->unit[9];
    }
    p.states = linear_complex.states(&m->loop);
    for (int i = MOTION; i < p.states; i++) p.size[i] = unit_beyond(m, i - MOTION);
    memcpy(p.y, y, sizeof p.y);
    motion_rates(&p, p.t, p.y, p.rate);
    if (p.wrong != NULL) return stuck(&p, error);
    status = go_round(&p, error);
    memcpy(y, p.y, sizeof p.y);
    return status;
}
