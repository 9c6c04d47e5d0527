/* The search with a continuous controller whose loop has states of its own, drives that lag and integrals: damping ratios of all
 * its poles, the damping for a ratio, and the stiffness from which the loop at home is no longer held. Theory:
 * docs/theory/tuning.md. */
#include <lapacke.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/quantity.h"
#include "control/program_lack.h"
#include "linear/linear.h"
#include "tune/tune.h"

enum { MOST = GOUGH_LINEAR_MOST, WORK = 8 * MOST, MOST_STEPS = 100, PER_DECADE = 40 };

/* the upper edge, relative */
static const double edge_width = 1e-12;

/* Of the program's period, times the rate at which the drives follow: a longer one takes too many steps to be looked at some
 * times; and a shorter one than the second few enough to be looked at for each point of the curve, if the motion is near the
 * program. */
static const double most_followed = 1e4, cheap = 128;

static const double two_pi = 6.283185307179586;

/* a loop at rest but for its gains */
typedef struct {
    gough_motion motion;
    gough_control control;
    linear_loop loop;
    double mass, quick;
    int kept[LINEAR_BEYOND], size;
} states;

double tune_quickest_drive(const gough_machine *machine) {
    const gough_actuators *a = &machine->platform.actuators;
    double quick = 0;

    for (int v = 0; v < GOUGH_LEGS && a->kind == GOUGH_ACTUATOR_LAG; v++)
        quick = fmax(quick, a->time_constant[v] > 0
                                ? 1 / a->time_constant[v]
                                : two_pi * a->frequency[v] * fmax(1, 2 * a->damping_ratio[v]));
    return quick;
}

/* all poles; false if they cannot be computed */
static bool poles_now(const states *s, double re[MOST], double im[MOST]) {
    const int n = s->size;
    double A[MOST * MOST], a[MOST * MOST], none = 0, work[WORK];

    linear_complex.whole(&s->loop, 0, NULL, s->kept, n, A);
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++) {
            if (!isfinite(A[n * i + j])) return false;
            a[i + n * j] = A[n * i + j];
        }
    }
    return LAPACKE_dgeev_work(LAPACK_COL_MAJOR, 'N', 'N', n, a, n, re, im, &none, 1, &none, 1, work,
                              WORK) == 0;
}

/* smallest −Re s/|s| */
static double ratio_now(void *loop) {
    const states *s = loop;
    double re[MOST], im[MOST], least = INFINITY;

    if (!poles_now(s, re, im)) return NAN;
    for (int k = 0; k < s->size; k++) {
        const double size = hypot(re[k], im[k]);
        least = fmin(least, size > 0 ? -re[k] / size : 0);
    }
    return least;
}

static double growth_now(const states *s) {
    double re[MOST], im[MOST], greatest = -INFINITY;

    if (!poles_now(s, re, im)) return INFINITY;
    for (int k = 0; k < s->size; k++) greatest = fmax(greatest, re[k]);
    return greatest;
}

static gough_status states_of(const gough_model *model, states *s, gough_error *error) {
    double mass[6][6];
    gough_state state;
    const gough_status status = linear_at_rest(model, NULL, &s->motion, &s->control, &state, error);

    if (status != GOUGH_OK) return status;
    s->loop = (linear_loop){&model->machine, &s->motion, &s->control, false, 0, false};
    s->size = GOUGH_LINEAR + linear_beyond(&model->machine, &s->control, s->kept);
    s->quick = tune_quickest_drive(&model->machine);
    linear_mass(&model->machine, &state, mass);
    s->mass = mass[0][0];
    return GOUGH_OK;
}

/* A lag leaves the least damped of three poles the ratio z only up to |s| = 1/(2 z T_a), where their sum is −1/T_a. With integrals
 * alone any G and D do. */
static tune_poles poles_of(states *s, double ratio) {
    const double q = s->quick, part = 1 + 1 / (4 * ratio * ratio);

    return (tune_poles){.ratio = ratio_now,
                        .loop = s,
                        .control = &s->control,
                        .mass = s->mass,
                        .most_damping = q > 0 ? 2 * s->mass * q * part : INFINITY,
                        .most_stiffness = q > 0 ? 4 * s->mass * q * q * part : INFINITY};
}

double tune_states_ratio(const gough_model *model) {
    states s;

    return states_of(model, &s, NULL) == GOUGH_OK ? ratio_now(&s) : (double)NAN;
}

gough_status tune_states_damping(const gough_model *model, double ratio, double *damping,
                                 gough_error *error) {
    states s;
    const gough_status status = states_of(model, &s, error);

    *damping = NAN;
    if (status != GOUGH_OK) return status;
    const tune_poles poles = poles_of(&s, ratio);
    *damping = tune_damping_at(&poles, ratio);
    if (*damping > 0) return GOUGH_OK;
    return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                      "no damping gives the least damped mode at home the ratio %.9g with the "
                      "stiffness %.9g" IN_STIFFNESS ": %s, or the stiffness does not hold the load",
                      ratio, s.control.stiffness[0],
                      s.quick > 0 ? "the drives follow their commands too late"
                                  : "control.integral is too large");
}

/* ---- the window --------------------------------------------------------------------------------------------------- */

static bool holds(states *s, double stiffness) {
    for (int v = 0; v < GOUGH_LEGS; v++) s->control.stiffness[v] = stiffness;
    return growth_now(s) < 0;
}

/* the greatest G that holds, of those up to where a search may end; 0: none, INFINITY: all up there */
static double top_by_damping(const tune *t, states *s) {
    const double threshold = t->tuning->threshold,
                 most = isfinite(t->options->greatest)
                            ? t->options->greatest
                            : fmax(t->furthest, 1e6 * fmax(t->unit, threshold)),
                 step = pow(10, 1.0 / PER_DECADE), least = fmax(threshold, 1e-9 * most);
    double low = most, high = most;

    if (holds(s, most)) return INFINITY;
    do {
        high = low;
        low /= step;
    } while (low > least && !holds(s, low));
    if (!(low > least)) {
        low = least * (1 + 1e-6);
        if (!holds(s, low)) return 0;
    }
    for (int i = 0; i < MOST_STEPS && high > low * (1 + edge_width); i++) {
        const double middle = sqrt(low * high);
        if (holds(s, middle))
            low = middle;
        else
            high = middle;
    }
    return high;
}

/* the mode that grows at the edge, or is the least damped there */
static void name_mode(tune *t, double stiffness, double damping, bool by_ratio) {
    gough_tuning *tuning = t->tuning;
    gough_error none;
    double least = INFINITY;

    for (int v = 0; v < GOUGH_LEGS; v++) {
        t->steady->control.stiffness[v] = stiffness;
        t->steady->control.damping[v] = by_ratio ? damping : t->model->control.damping[v];
    }
    if (gough_stability_at_rest(t->steady, NULL, &t->rest, &none) != GOUGH_OK) return;
    for (size_t k = 0; k < t->rest.size; k++) {
        const double *s = t->rest.eigenvalue[k].value, size = hypot(s[0], s[1]);
        const double measure = by_ratio && size > 0 ? -s[0] / size : -s[0];
        if (!(measure < least)) continue;
        least = measure;
        tuning->upper_frequency = fabs(s[1]);
        tuning->upper_mode = t->rest.eigenvalue[k].mode;
    }
}

gough_status tune_states_window(tune *t, gough_error *error) {
    gough_tuning *tuning = t->tuning;
    double damping = NAN, top;
    gough_status status;
    states s;

    control_knows_all(&t->steady->control);
    for (int v = 0; v < GOUGH_LEGS; v++)
        t->steady->control.damping[v] = t->model->control.damping[v];
    status = states_of(t->steady, &s, error);
    if (status != GOUGH_OK) return status;
    if (!t->ratio) {
        top = top_by_damping(t, &s);
    } else {
        const tune_poles poles = poles_of(&s, t->options->damping_ratio);
        top = s.quick > 0 ? tune_top_by_ratio(&poles, tuning->threshold, t->options->damping_ratio,
                                              &damping)
                          : INFINITY;
    }
    tuning->upper = top > 0 ? top : (double)NAN;
    if (top > 0 && isfinite(top)) name_mode(t, top, damping, t->ratio);
    return GOUGH_OK;
}

/* ---- the program ---------------------------------------------------------------------------------------------------- */

void tune_follow_states(tune *t) {
    gough_tuning *tuning = t->tuning;
    const double part = t->period.period * t->quick;

    t->cheap = tuning->periodic && part <= cheap &&
               gough_keeps_program(&t->model->machine, &t->loop->control, true);
    if (!tuning->periodic || part <= most_followed) return;
    tuning->periodic = false;
    snprintf(tuning->unchecked, sizeof tuning->unchecked,
             "a period of the program is %.4g times as long as the drives take to follow their "
             "commands, and only up to %.0f times is followed, so home was checked",
             part, most_followed);
    t->period = (gough_period){.resting = true};
    memset(&t->steady->motion, 0, sizeof t->steady->motion);
}
