/* A sampled loop about its periodic motion: the state before a sample that comes back after a period, by Newton's method, and the
 * multipliers of its deviations. Theory: docs/theory/loop.md. */
#include <lapacke.h>
#include <math.h>
#include <string.h>

#include "base/quantity.h"
#include "floquet/loads.h"
#include "floquet/orbit.h"
#include "floquet/sampled_flow.h"
#include "plant/can_move.h"
#include "program/program_valid.h"

enum { MOST_SAMPLES = 20000, MOST_STEPS = 30, SEARCHING = 16 };

/* of the steps */
static const double tolerance = 1e-13;

/* relative: a period counts as whole samples, a delay as whole periods */
static const double slack = 1e-9;

/* Newton's step, in the units of the deviation, below which the motion is found; below which it may stay where rounding stops the
 * steps from shrinking; beyond which it would lead elsewhere; and by what factor each must be shorter than the last, after the
 * first ones: near a resonance these have to search */
static const double closed = 1e-11, nearly_closed = 1e-8, farthest = 0.5, shrinks = 0.8;

typedef double whole_matrix[SAMPLED_ROWS * SAMPLED_ROWS];

typedef struct {
    linear_loop loop;
    sampled_layout layout;
    double start;
    size_t samples, steps;
    double unit[SAMPLED_ROWS]; /* of a deviation's numbers */
    sampled_map map;           /* of the whole period */
} orbit;

/* ---- what is to be found ------------------------------------------------------------------------------------------- */

static gough_status check(const gough_model *model, const gough_period *period,
                          gough_error *error) {
    const double T = model->control.sampling.period, samples = period->period / T;

    if (period->resting)
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "the program is at rest from t = %.9g" IN_TIME
                          ", so it has no period and no multipliers; compute "
                          "the stability at rest in that pose (gough_sampled_at_rest())",
                          period->start);
    if (!(samples < MOST_SAMPLES + 0.5))
        return gough_fail_key(error, GOUGH_ERROR_INPUT, "control.sampling.period",
                              "the program's period of %.9g" IN_TIME
                              " has more than %d samples of %.9g" IN_TIME
                              ": stability about the program is computed for no more; use a longer "
                              "period of sampling",
                              period->period, (int)MOST_SAMPLES, T);
    const double whole = fmax(1, round(samples));
    if (!(fabs(samples - whole) <= slack * whole))
        return gough_fail_key(error, GOUGH_ERROR_INPUT, "control.sampling.period",
                              "the program's period of %.9g" IN_TIME
                              " is not a whole number of samples of %.9g" IN_TIME
                              ", so the sampled loop has no periodic motion; the nearest period of "
                              "sampling is %.17g" IN_TIME,
                              period->period, T, period->period / whole);
    return GOUGH_OK;
}

static void lay_out(orbit *o, const gough_model *model, const gough_period *period) {
    const gough_control *c = &model->control;
    const double T = c->sampling.period, periods = c->sampling.delay / T,
                 whole = floor(periods + slack);
    const bool differences = c->sampling.velocity == GOUGH_VELOCITY_DIFFERENCE;
    const gough_actuators *a = &model->machine.platform.actuators;
    sampled_layout *l = &o->layout;

    memset(o, 0, sizeof *o);
    o->loop = (linear_loop){&model->machine, &model->motion, c, false, 0};
    o->samples = (size_t)fmax(1, round(period->period / T));
    o->start = ceil(period->start / T - slack) * T;
    l->period = period->period / (double)o->samples;
    l->whole = (int)whole;
    l->rest = periods - whole > slack ? c->sampling.delay - whole * T : 0;
    l->waiting = l->whole + (l->rest > 0);
    l->drive = a->kind != GOUGH_ACTUATOR_LAG ? 0 : a->time_constant[0] > 0 ? 6 : 12;
    l->n = GOUGH_LINEAR + l->drive + GOUGH_LEGS * l->waiting;
    for (int v = 0; v < GOUGH_LEGS; v++) {
        l->used[v] = differences;
        l->used[GOUGH_LEGS + v] = differences && c->sampling.cutoff > 0;
        l->used[2 * GOUGH_LEGS + v] = c->integral[v] > 0;
    }
    for (int m = 0; m < SAMPLED_MEMORY; m++) l->n += l->used[m];
}

/* R_b, √(g R_b), M g and the like for each number */
static void measure(orbit *o, const gough_period *period) {
    const gough_machine *machine = o->loop.machine;
    const double length = machine->base_radius, gravity = machine->gravity_magnitude;
    const double time = gravity > 0 ? sqrt(length / gravity) : period->period;
    const double force = machine->load.mass * length / (time * time);
    const double memory[3] = {length, length / time, force};
    int row = 0;

    for (; row < GOUGH_LINEAR; row++)
        o->unit[row] = (row % 6 < 3 ? length : 1) / (row < 6 ? 1 : time);
    for (int i = 0; i < o->layout.drive; i++) o->unit[row++] = i < 6 ? force : force / time;
    for (int m = 0; m < SAMPLED_MEMORY; m++)
        if (o->layout.used[m]) o->unit[row++] = memory[m / GOUGH_LEGS];
    while (row < o->layout.n) o->unit[row++] = force;
}

/* ---- once round ------------------------------------------------------------------------------------------------------ */

static void multiply(int n, const double *a, double *product) {
    double column[SAMPLED_ROWS];

    for (int j = 0; j < n; j++) {
        for (int i = 0; i < n; i++) column[i] = product[n * i + j];
        for (int i = 0; i < n; i++) {
            double sum = 0;
            for (int k = 0; k < n; k++) sum += a[n * i + k] * column[k];
            product[n * i + j] = sum;
        }
    }
}

/* from `state` over all samples, to where it is after them; the matrix of the period in the map */
static gough_status go_round(orbit *o, sampled_state *state, gough_error *error) {
    const int n = o->layout.n;
    whole_matrix one;

    o->map.n = n;
    o->steps = 0;
    for (int i = 0; i < n * n; i++) o->map.matrix[i] = i % (n + 1) == 0;
    for (size_t k = 0; k < o->samples; k++) {
        const double t = o->start + (double)k * o->layout.period;
        const char *wrong = sampled_flow(&o->loop, &o->layout, t, tolerance, state, one, &o->steps);
        if (wrong != NULL)
            return gough_fail(error, GOUGH_ERROR_INPUT, "%s is not finite near t = %.9g" IN_TIME,
                              wrong, t);
        multiply(n, one, o->map.matrix);
    }
    for (int i = 0; i < n * n; i++) {
        if (!isfinite(o->map.matrix[i]))
            return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                              "the deviations grow beyond the range of numbers within one period, "
                              "so there are no multipliers");
    }
    return GOUGH_OK;
}

/* numbers of a deviation from one state to another, or a state changed by them */
static void compare(const sampled_layout *l, const sampled_state *from, const sampled_state *to,
                    double *deviation) {
    int row = GOUGH_LINEAR;

    orbit_difference(from->y, to->y, deviation);
    for (int i = 0; i < l->drive; i++) deviation[row++] = to->y[MOTION + i] - from->y[MOTION + i];
    for (int m = 0; m < SAMPLED_MEMORY; m++)
        if (l->used[m]) deviation[row++] = to->memory[m] - from->memory[m];
    for (int i = 0; i < GOUGH_LEGS * l->waiting; i++)
        deviation[row++] = to->waiting[i / GOUGH_LEGS][i % GOUGH_LEGS] -
                           from->waiting[i / GOUGH_LEGS][i % GOUGH_LEGS];
}

static void change(const sampled_layout *l, const double *deviation, sampled_state *state) {
    int row = GOUGH_LINEAR;

    orbit_change(state->y, deviation, state->y);
    for (int i = 0; i < l->drive; i++) state->y[MOTION + i] += deviation[row++];
    for (int m = 0; m < SAMPLED_MEMORY; m++)
        if (l->used[m]) state->memory[m] += deviation[row++];
    for (int i = 0; i < GOUGH_LEGS * l->waiting; i++)
        state->waiting[i / GOUGH_LEGS][i % GOUGH_LEGS] += deviation[row++];
}

/* (floquet-7): solves (1 − Φ) step = missing, in the units of the deviation. Returns the size of the step, or INFINITY if the
 * equations have no solution. */
static double newton_step(const orbit *o, double *step) {
    const int n = o->layout.n;
    whole_matrix a;
    lapack_int pivot[SAMPLED_ROWS];
    double largest = 0;

    for (int i = 0; i < n; i++) {
        step[i] /= o->unit[i];
        for (int j = 0; j < n; j++)
            a[i + n * j] = (i == j) - o->map.matrix[n * i + j] * o->unit[j] / o->unit[i];
    }
    if (LAPACKE_dgesv_work(LAPACK_COL_MAJOR, n, 1, a, n, pivot, step, n) != 0) return INFINITY;
    for (int i = 0; i < n; i++) {
        if (!(fabs(step[i]) <= largest)) largest = fabs(step[i]);
        step[i] *= o->unit[i];
    }
    return isfinite(largest) ? largest : INFINITY;
}

/* Newton's method from the program; on return the matrix is that of the motion found */
static gough_status close_motion(orbit *o, sampled_state *state, gough_error *error) {
    double step[SAMPLED_ROWS], before = farthest / shrinks;

    for (int k = 0; k < MOST_STEPS; k++) {
        sampled_state after = *state;
        const gough_status status = go_round(o, &after, error);
        if (status != GOUGH_OK) return status;
        compare(&o->layout, state, &after, step);
        const double size = newton_step(o, step);
        if (size <= closed) return GOUGH_OK;
        if (size <= nearly_closed && !(size <= shrinks * before)) return GOUGH_OK;
        if (!(size <= farthest) || (k >= SEARCHING && !(size <= shrinks * before))) break;
        change(&o->layout, step, state);
        before = size;
    }
    return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                      "no periodic motion of the sampled loop was found near the program: the "
                      "loop is too weak, or the program excites the platform at a natural "
                      "frequency; increase control.stiffness, add control.damping, or shorten "
                      "control.sampling.period");
}

/* ---- the multipliers ---------------------------------------------------------------------------------------------------- */

static gough_status prepare(const gough_model *model, const gough_period **period,
                            gough_period *found, gough_error *error) {
    const gough_sampling *s = &model->control.sampling;
    gough_status status = motion_check(&model->motion, error);

    if (status == GOUGH_OK) status = machine_can_move(&model->machine, error);
    if (status == GOUGH_OK) status = gough_control_check(&model->control, error);
    if (status == GOUGH_OK) status = sampled_check(s, error);
    if (status == GOUGH_OK && *period == NULL) {
        status = gough_motion_period(&model->motion, found, error);
        *period = found;
    }
    if (status == GOUGH_OK) status = check(model, *period, error);
    if (status == GOUGH_OK) status = loads_check(&model->machine, *period, false, error);
    return status;
}

gough_status gough_floquet_sampled(const gough_model *model, const gough_period *period,
                                   gough_sampled_floquet *floquet, gough_error *error) {
    gough_period found;
    sampled_state state;
    orbit o;
    gough_status status = prepare(model, &period, &found, error);

    memset(floquet, 0, sizeof *floquet);
    if (status != GOUGH_OK) return status;
    lay_out(&o, model, period);
    measure(&o, period);
    sampled_begin(&o.loop, &o.layout, o.start, &state);
    status = close_motion(&o, &state, error);
    if (status != GOUGH_OK) return status;
    floquet->listed =
        (size_t)sampled_multipliers(&model->machine, &o.map, GOUGH_SAMPLED, floquet->multiplier);
    if (floquet->listed == 0)
        return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                          "the deviations grow beyond the range of numbers within one period, so "
                          "there are no multipliers");
    floquet->start = o.start;
    floquet->period = period->period;
    floquet->samples = o.samples;
    floquet->steps = o.steps;
    floquet->size = (size_t)o.layout.n;
    monodromy_fold(&model->machine, state.y, &floquet->state);
    floquet->growth = hypot(floquet->multiplier[0].value[0], floquet->multiplier[0].value[1]);
    floquet->stable = floquet->growth <= 1 + GOUGH_GROWTH_LIMIT;
    return GOUGH_OK;
}
