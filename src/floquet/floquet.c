/* Floquet multipliers of the loop about its periodic motion: the program where the loop keeps it, else the motion that springs and
 * drives of the legs give. Theory: docs/theory/floquet.md. */
#include <lapacke.h>
#include <math.h>
#include <string.h>

#include "base/quantity.h"
#include "floquet/loads.h"
#include "floquet/orbit.h"
#include "floquet/spectrum.h"
#include "linear/mode.h"
#include "plant/can_move.h"
#include "program/program_valid.h"

/* the steps' tolerance where none is given, and what double precision can be asked for */
static const double usual_tolerance = 1e-13, states_tolerance = 1e-10, least_tolerance = 1e-15,
                    greatest_tolerance = 1e-3;

/* error of the monodromy matrix, relative to its norm, in tolerances of the steps: hundreds of steps in 64 factors */
static const double matrix_error = 100;

enum { WORK = 34 * MONODROMY_ROWS };

/* −tr A over a part of the period up to which its factor keeps digits of the determinant: e⁻⁸ of each of six drives */
static const double most_decay = 48;

static gough_status check(const gough_period *period, double tolerance, gough_error *error) {
    if (period->resting)
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "the program is at rest from t = %.9g" IN_TIME
                          ", so it has no period and no multipliers; compute "
                          "the stability at rest in that pose (gough_stability_at_rest())",
                          period->start);
    if (!(period->period > 0 && isfinite(period->period) && isfinite(period->start)))
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "a period must be positive and finite, not %g" IN_TIME, period->period);
    if (!(tolerance >= least_tolerance && tolerance <= greatest_tolerance))
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "the tolerance of the steps must be between %g and %g, not %g",
                          least_tolerance, greatest_tolerance, tolerance);
    return GOUGH_OK;
}

/* the matrix in the study's units */
static void fill_matrix(const monodromy *m, gough_floquet *floquet) {
    double product[MONODROMY_SIZE];

    monodromy_product(m, product);
    memset(floquet->monodromy, 0, sizeof floquet->monodromy);
    for (int i = 0; i < m->n; i++) {
        for (int j = 0; j < m->n; j++)
            floquet->monodromy[i][j] = product[j * m->n + i] * m->unit[i] / m->unit[j];
    }
}

static void fill_multipliers(const monodromy *m, const spectrum *s, gough_floquet *floquet) {
    floquet->growth = 0;
    for (int k = 0; k < m->n; k++) {
        gough_multiplier *multiplier = &floquet->multiplier[k];
        double complex shape[6];
        for (int i = 0; i < 6; i++) shape[i] = s->vector[k][i] * m->unit[i];
        multiplier->value[0] = creal(s->value[k]);
        multiplier->value[1] = cimag(s->value[k]);
        mode_of(m->loop.machine, shape, &multiplier->mode);
        floquet->growth = fmax(floquet->growth, cabs(s->value[k]));
    }
    floquet->stable = floquet->growth <= 1 + GOUGH_GROWTH_LIMIT;
}

/* (floquet-9): multipliers within c of 1, less the singular values of M - 1 below c. An error of M of the relative size e moves
 * the multipliers of a defective pair by up to the root of e times the norm of M, which is c. */
static gough_status find_drift(const monodromy *m, const spectrum *s, gough_floquet *floquet,
                               gough_error *error) {
    double a[MONODROMY_SIZE], none[1], sigma[MONODROMY_ROWS], work[WORK], norm = 0;
    const int n = m->n;

    monodromy_product(m, a);
    for (int i = 0; i < n * n; i++) norm += a[i] * a[i];
    for (int i = 0; i < n; i++) a[i * (n + 1)] -= 1;
    if (LAPACKE_dgesvd_work(LAPACK_COL_MAJOR, 'N', 'N', n, n, a, n, sigma, none, 1, none, 1, work,
                            WORK / MONODROMY_ROWS * n) != 0)
        return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                          "the deviations grow beyond the range of numbers within one period, so "
                          "there are no multipliers");
    const double near = sqrt(norm * matrix_error * fmax(m->tolerance, usual_tolerance));
    floquet->drifting = 0;
    for (int k = 0; k < n; k++)
        floquet->drifting += (cabs(s->value[k] - 1) <= near) - (sigma[k] <= near);
    if (floquet->drifting < 0) floquet->drifting = 0;
    floquet->stable = floquet->stable && floquet->drifting == 0;
    return GOUGH_OK;
}

/* (floquet-5): without damping the determinant is 1, and multipliers come in pairs if all forces have a potential; with it
 * Liouville's formula is left, as far as drives do not decay so fast that factors have no digits of their decay */
static void fill_defects(const monodromy *m, const spectrum *s, gough_floquet *floquet) {
    const bool damped = m->n > GOUGH_LINEAR || linear_is_damped(&m->loop);
    const bool lost = m->n > GOUGH_LINEAR && -m->trace > most_decay * m->parts;

    floquet->determinant = exp(s->log_determinant);
    floquet->determinant_defect =
        lost ? NAN : fabs(expm1(s->log_determinant - (damped ? m->trace : 0)));
    floquet->pair_defect =
        damped || machine_loads_follow(m->loop.machine) ? NAN : spectrum_pair_defect(s);
}

/* finds the motion; its state where the period begins */
static gough_status go_round(monodromy *m, gough_floquet *floquet, gough_error *error) {
    gough_state *state = &floquet->state;
    gough_acceleration acceleration;
    gough_status status;
    double y[STATE_SIZE];

    if (!m->loop.whole && gough_keeps_program(m->loop.machine, m->loop.control, true)) {
        gough_program(m->loop.machine, m->loop.motion, m->start, state, &acceleration);
        return monodromy_of_program(m, error);
    }
    status = orbit_find(m, y, error);
    if (status != GOUGH_OK) return status;
    monodromy_fold(m->loop.machine, y, state);
    for (int i = GOUGH_LINEAR; i < m->n; i++)
        floquet->beyond[i - GOUGH_LINEAR] = y[MOTION + m->kept[i - GOUGH_LINEAR]];
    return GOUGH_OK;
}

gough_status gough_floquet_multipliers(const gough_model *model, const gough_period *period,
                                       double tolerance, gough_floquet *floquet,
                                       gough_error *error) {
    const double usual =
        gough_linear_size(model) > GOUGH_LINEAR ? states_tolerance : usual_tolerance;
    const double asked = fabs(tolerance) <= 0 ? usual : tolerance;
    gough_period found;
    gough_status status;
    monodromy m;
    spectrum s;

    status = motion_check(&model->motion, error);
    if (status == GOUGH_OK) status = machine_can_move(&model->machine, error);
    if (status == GOUGH_OK)
        status = linear_refuse_sampled(model, "the stability about a program", error);
    if (status == GOUGH_OK) status = gough_control_check(&model->control, error);
    if (status != GOUGH_OK) return status;
    if (period == NULL) {
        status = gough_motion_period(&model->motion, &found, error);
        if (status != GOUGH_OK) return status;
        period = &found;
    }
    status = check(period, asked, error);
    if (status == GOUGH_OK) status = loads_check(&model->machine, period, error);
    if (status != GOUGH_OK) return status;
    monodromy_begin(&m, model, period, asked);
    status = go_round(&m, floquet, error);
    if (status == GOUGH_OK) status = spectrum_of(&m, &s, error);
    if (status != GOUGH_OK) return status;

    floquet->size = (size_t)m.n;
    floquet->start = m.start;
    floquet->period = m.period;
    floquet->steps = m.steps;
    fill_matrix(&m, floquet);
    fill_multipliers(&m, &s, floquet);
    fill_defects(&m, &s, floquet);
    return find_drift(&m, &s, floquet, error);
}
