/* A sampled loop about its periodic motion: the state before a sample that comes back after a period, by Newton's method, and the
 * multipliers of its deviations. Theory: docs/theory/loop.md. */
#include <lapacke.h>
#include <math.h>
#include <string.h>

#include "base/limits.h"
#include "base/quantity.h"
#include "floquet/loads.h"
#include "floquet/orbit.h"
#include "floquet/sampled_orbit.h"
#include "plant/can_move.h"
#include "program/program_valid.h"

enum { MOST_SAMPLES = 20000, MOST_PERIODS = 16, MOST_STEPS = 30, SEARCHING = 16, MOST_CHORDS = 12 };

const double sampled_tolerance = 1e-13;

/* relative: a number of samples counts as whole, a delay as whole periods */
static const double slack = 1e-9;

/* Newton's step, in the units of the deviation, below which the motion is found; below which it may stay where rounding stops the
 * steps from shrinking; beyond which it would lead elsewhere; and by what factor each must be shorter than the last, after the
 * first ones: near a resonance these have to search */
static const double closed = 1e-11, nearly_closed = 1e-8, farthest = 0.5, shrinks = 0.8;

/* a multiplier below this share of the largest is the rounding of the product of all samples, and not listed */
static const double least_share = 1e-9;

/* steps by the matrix of another stiffness are worth taking only while each is shorter than the last by this factor */
static const double chord_shrinks = 0.4;

/* ---- what is to be found ------------------------------------------------------------------------------------------- */

bool sampled_fit(gough_sampling *sampling, double period, size_t *samples, size_t *periods) {
    const double own = sampling->period, ratio = period / own;
    double whole = fmax(1, round(ratio)), over = 1;

    for (int q = 1; q <= MOST_PERIODS; q++) {
        const double near = round(q * ratio);
        if (!(near >= 1 && fabs(q * ratio - near) <= slack * near)) continue;
        whole = near, over = q;
        break;
    }
    sampling->period = over * period / whole;
    *samples = (size_t)fmin(whole, MOST_SAMPLES + 1);
    *periods = (size_t)over;
    if (fabs(over * ratio - whole) <= slack * whole) return false;
    sampling->delay *= sampling->period / own;
    sampling->preview *= sampling->period / own;
    return true;
}

static gough_status check(const sampled_orbit *o, const gough_sampling *own,
                          const gough_period *period, gough_error *error) {
    if (!(2 * period->period >= own->period) && o->adjusted)
        return gough_fail_key(error, GOUGH_ERROR_INPUT, "control.sampling.period",
                              "the controller's period of %.9g" IN_TIME
                              " is longer than two periods of the program, of %.9g" IN_TIME
                              ", and no whole number of it fills up to %d of these; use a shorter "
                              "period of sampling",
                              own->period, period->period, (int)MOST_PERIODS);
    if (o->samples > MOST_SAMPLES)
        return gough_fail_key(error, GOUGH_ERROR_INPUT, "control.sampling.period",
                              "%zu period%s of the program, of %.9g" IN_TIME
                              ", %s more than %d samples of %.9g" IN_TIME
                              ": stability about the program is computed for no more; use a longer "
                              "period of sampling",
                              o->periods, o->periods == 1 ? "" : "s", period->period,
                              o->periods == 1 ? "has" : "have", (int)MOST_SAMPLES, own->period);
    return GOUGH_OK;
}

static gough_status check_period(const gough_period *period, gough_error *error) {
    if (period->resting)
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "the program is at rest from t = %.9g" IN_TIME
                          ", so it has no period and no multipliers; compute "
                          "the stability at rest in that pose (gough_sampled_at_rest())",
                          period->start);
    if (!(period->period > 0 && isfinite(period->period) && isfinite(period->start)))
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "a period must be positive and finite, not %g" IN_TIME, period->period);
    return GOUGH_OK;
}

static void lay_out(sampled_orbit *o, const gough_model *model, const gough_period *period) {
    const gough_control *c = &o->control;
    const double T = c->sampling.period, periods = c->sampling.delay / T,
                 whole = floor(periods + slack);
    const bool differences = c->sampling.velocity == GOUGH_VELOCITY_DIFFERENCE;
    const gough_actuators *a = &model->machine.platform.actuators;
    sampled_layout *l = &o->layout;

    memset(l, 0, sizeof *l);
    o->loop = (linear_loop){&model->machine, &model->motion, c, false, 0, false};
    o->start = ceil(period->start / T - slack) * T;
    l->period = T;
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
static void measure(sampled_orbit *o, const gough_period *period) {
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

void sampled_multiply(int n, int columns, const double *a, double *product) {
    double column[SAMPLED_ROWS];

    for (int j = 0; j < columns; j++) {
        for (int i = 0; i < n; i++) column[i] = product[columns * i + j];
        for (int i = 0; i < n; i++) {
            double sum = 0;
            for (int k = 0; k < n; k++) sum += a[n * i + k] * column[k];
            product[columns * i + j] = sum;
        }
    }
}

double sampled_determinant(const sampled_orbit *o, const sampled_state *state, double *condition) {
    double determinant;
    gough_state pose;

    monodromy_fold(o->loop.machine, state->y, &pose);
    gough_conditioning(o->loop.machine, &pose, condition, &determinant);
    return determinant;
}

bool sampled_keeps_its_side(const sampled_orbit *o, const sampled_state *state, double side) {
    double condition;
    const double determinant = sampled_determinant(o, state, &condition);

    return condition <= greatest_condition && determinant * side > 0;
}

/* From `state` over all samples, to where it is after them; with their matrix, if that is wanted, in the map */
static gough_status go_round(sampled_orbit *o, bool wanted, sampled_state *state,
                             gough_error *error) {
    const int n = o->layout.n;
    const double side = sampled_determinant(o, state, NULL);
    sampled_matrix one;

    o->map.n = n;
    o->steps = 0;
    for (int i = 0; i < n * n && wanted; i++) o->map.matrix[i] = i % (n + 1) == 0;
    for (size_t k = 0; k < o->samples; k++) {
        const double t = o->start + (double)k * o->layout.period;
        const char *wrong = sampled_flow(&o->loop, &o->layout, t, sampled_tolerance, state,
                                         wanted ? one : NULL, &o->steps);
        if (wrong != NULL)
            return gough_fail(error, GOUGH_ERROR_INPUT, "%s is not finite near t = %.9g" IN_TIME,
                              wrong, t);
        if (wanted) sampled_multiply(n, n, one, o->map.matrix);
        if (!sampled_keeps_its_side(o, state, side))
            return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                              "by t = %.9g" IN_TIME " the platform has left the program for a "
                              "singular pose: the loop does not hold it, and there are no "
                              "multipliers about a motion that it does not follow",
                              t + o->layout.period);
    }
    return GOUGH_OK;
}

void sampled_compare(const sampled_layout *l, const sampled_state *from, const sampled_state *to,
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

void sampled_change(const sampled_layout *l, const double *deviation, sampled_state *state) {
    int row = GOUGH_LINEAR;

    orbit_change(state->y, deviation, state->y);
    for (int i = 0; i < l->drive; i++) state->y[MOTION + i] += deviation[row++];
    for (int m = 0; m < SAMPLED_MEMORY; m++)
        if (l->used[m]) state->memory[m] += deviation[row++];
    for (int i = 0; i < GOUGH_LEGS * l->waiting; i++)
        state->waiting[i / GOUGH_LEGS][i % GOUGH_LEGS] += deviation[row++];
}

bool sampled_factor(sampled_orbit *o) {
    const int n = o->layout.n;
    lapack_int pivot[SAMPLED_ROWS];

    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++)
            o->factors[i + n * j] = (i == j) - o->map.matrix[n * i + j] * o->unit[j] / o->unit[i];
    }
    if (LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, n, n, o->factors, n, pivot) != 0) return false;
    for (int i = 0; i < n; i++) o->pivot[i] = (int)pivot[i];
    return true;
}

double sampled_newton_step(const sampled_orbit *o, double *step) {
    const int n = o->layout.n;
    lapack_int pivot[SAMPLED_ROWS] = {0};
    double largest = 0;

    for (int i = 0; i < n; i++) {
        step[i] /= o->unit[i];
        pivot[i] = (lapack_int)o->pivot[i];
    }
    if (LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, 'N', n, 1, o->factors, n, pivot, step, n) != 0)
        return INFINITY;
    for (int i = 0; i < n; i++) {
        if (!(fabs(step[i]) <= largest)) largest = fabs(step[i]);
        step[i] *= o->unit[i];
    }
    return isfinite(largest) ? largest : INFINITY;
}

/* a Newton step from a state; size: how large it is */
static gough_status improve(sampled_orbit *o, sampled_state *state, double *size,
                            gough_error *error) {
    double step[SAMPLED_ROWS];
    sampled_state after = *state;
    const gough_status status = go_round(o, true, &after, error);

    if (status != GOUGH_OK) return status;
    sampled_compare(&o->layout, state, &after, step);
    *size = sampled_factor(o) ? sampled_newton_step(o, step) : INFINITY;
    if (*size > closed && *size <= farthest) sampled_change(&o->layout, step, state);
    return GOUGH_OK;
}

/* Steps by the matrix that was found last, each of which costs a small part of one with its own matrix. Returns whether they led
 * to the motion. */
static bool draw_near(sampled_orbit *o, double before, sampled_state *state) {
    double step[SAMPLED_ROWS];

    for (int k = 0; k < MOST_CHORDS; k++) {
        sampled_state after = *state;
        if (go_round(o, false, &after, NULL) != GOUGH_OK) return false;
        sampled_compare(&o->layout, state, &after, step);
        const double size = sampled_newton_step(o, step);
        if (size <= closed) return true;
        if (!(size <= chord_shrinks * before)) return size <= nearly_closed;
        sampled_change(&o->layout, step, state);
        before = size;
    }
    return false;
}

/* Newton's method from a state; on return the matrix is that of the motion found, and the state its state */
static gough_status close_motion(sampled_orbit *o, sampled_state *state, gough_error *error) {
    double before = farthest / shrinks, size = INFINITY;

    for (int k = 0; k < MOST_STEPS; k++) {
        sampled_state start = *state;
        const gough_status status = improve(o, state, &size, error);
        if (status != GOUGH_OK) return status;
        if (size <= nearly_closed && !(size > closed && size <= shrinks * before)) {
            *state = start; /* of which the matrix is */
            return GOUGH_OK;
        }
        if (!(size <= farthest) || (k >= SEARCHING && !(size <= shrinks * before))) break;
        before = size;
    }
    return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                      "no periodic motion of the sampled loop was found near the program: the "
                      "loop is too weak, or the program excites the platform at a natural "
                      "frequency; increase control.stiffness, add control.damping, or shorten "
                      "control.sampling.period");
}

/* With a table of all samples about the program their states are found together. Else, and where that fails, the first step is
 * Newton's from the program, and its matrix does for all but the last; where it does not, each step gets its own. Where runs of a
 * period lead nowhere, the period is divided; with a table all samples have been tried apart already. */
gough_status sampled_orbit_find(sampled_orbit *o, gough_error *error) {
    sampled_state first;
    double size;
    gough_status status;

    if (o->table != NULL && sampled_shoot(o, &o->state) &&
        close_motion(o, &o->state, NULL) == GOUGH_OK)
        return GOUGH_OK;
    sampled_begin(&o->loop, &o->layout, o->start, &first);
    o->state = first;
    status = improve(o, &o->state, &size, error);
    if (status == GOUGH_OK) {
        if (size > closed && size <= farthest && draw_near(o, size, &o->state) &&
            close_motion(o, &o->state, NULL) == GOUGH_OK)
            return GOUGH_OK;
        o->state = first;
        status = close_motion(o, &o->state, error);
    }
    if (status != GOUGH_ERROR_NUMERICAL || o->table != NULL) return status;
    return sampled_join(o, &o->state) ? GOUGH_OK : status;
}

gough_status sampled_orbit_begin(sampled_orbit *o, const gough_model *model,
                                 const gough_period *period, gough_error *error) {
    gough_status status = check_period(period, error);

    if (status != GOUGH_OK) return status;
    o->table = NULL;
    o->control = model->control;
    o->adjusted = sampled_fit(&o->control.sampling, period->period, &o->samples, &o->periods);
    status = check(o, &model->control.sampling, period, error);
    if (status == GOUGH_OK) status = sampled_check(&o->control.sampling, error);
    if (status == GOUGH_OK) status = loads_check(&model->machine, period, error);
    if (status != GOUGH_OK) return status;
    lay_out(o, model, period);
    measure(o, period);
    return GOUGH_OK;
}

/* ---- the multipliers ---------------------------------------------------------------------------------------------------- */

static gough_status prepare(const gough_model *model, const gough_period **period,
                            gough_period *found, gough_error *error) {
    gough_status status = motion_check(&model->motion, error);

    if (status == GOUGH_OK) status = machine_can_move(&model->machine, error);
    if (status == GOUGH_OK) status = gough_control_check(&model->control, error);
    if (status == GOUGH_OK) status = sampled_check(&model->control.sampling, error);
    if (status == GOUGH_OK && *period == NULL) {
        status = gough_motion_period(&model->motion, found, error);
        *period = found;
    }
    return status;
}

int sampled_orbit_multipliers(const sampled_orbit *o, gough_multiplier list[GOUGH_SAMPLED]) {
    int listed = sampled_multipliers(o->loop.machine, &o->map, GOUGH_SAMPLED, list);
    const double largest = listed > 0 ? hypot(list[0].value[0], list[0].value[1]) : 0;

    while (listed > 1 &&
           !(hypot(list[listed - 1].value[0], list[listed - 1].value[1]) > least_share * largest))
        listed--;
    return listed;
}

gough_status gough_floquet_sampled(const gough_model *model, const gough_period *period,
                                   gough_sampled_floquet *floquet, gough_error *error) {
    gough_period found;
    sampled_orbit o;
    gough_status status = prepare(model, &period, &found, error);

    memset(floquet, 0, sizeof *floquet);
    if (status == GOUGH_OK) status = sampled_orbit_begin(&o, model, period, error);
    if (status == GOUGH_OK) status = sampled_orbit_find(&o, error);
    if (status != GOUGH_OK) return status;
    floquet->listed = (size_t)sampled_orbit_multipliers(&o, floquet->multiplier);
    if (floquet->listed == 0)
        return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                          "the deviations grow beyond the range of numbers within one period, so "
                          "there are no multipliers");
    floquet->start = o.start;
    floquet->period = period->period;
    floquet->periods = o.periods;
    floquet->samples = o.samples;
    floquet->sampling = o.layout.period;
    floquet->adjusted = o.adjusted;
    floquet->steps = o.steps;
    floquet->size = (size_t)o.layout.n;
    monodromy_fold(&model->machine, o.state.y, &floquet->state);
    floquet->growth = hypot(floquet->multiplier[0].value[0], floquet->multiplier[0].value[1]);
    floquet->stable = floquet->growth <= 1 + GOUGH_GROWTH_LIMIT;
    return GOUGH_OK;
}
