/* The damping that gives the least damped mode at home a damping ratio: a root, found from the eigenvalues. Theory:
 * docs/theory/tuning.md. */
#include <lapacke.h>
#include <math.h>
#include <string.h>

#include "base/quantity.h"
#include "control/program_lack.h"
#include "linear/equilibrium.h"
#include "linear/linear.h"
#include "plant/can_move.h"
#include "program/program_valid.h"
#include "tune/tune.h"

enum { N = GOUGH_LINEAR, WORK = 512, MOST_STEPS = 100 };

/* of the root, relative: that of the eigenvalues themselves */
static const double precision = 1e-14;

double tune_least_ratio(double matrix[GOUGH_LINEAR][GOUGH_LINEAR]) {
    double a[N * N], re[N], im[N], none = 0, work[WORK], least = INFINITY;

    for (int i = 0; i < N; i++) {
        for (int j = 0; j < N; j++) a[i + N * j] = matrix[i][j];
    }
    if (LAPACKE_dgeev_work(LAPACK_COL_MAJOR, 'N', 'N', N, a, N, re, im, &none, 1, &none, 1, work,
                           WORK) != 0) {
        return NAN;
    }
    for (int k = 0; k < N; k++) {
        const double size = hypot(re[k], im[k]);
        if (!isfinite(size)) return NAN;
        least = fmin(least, size > 0 ? -re[k] / size : 0);
    }
    return least;
}

/* A = A₀ + D A_D */
typedef struct {
    double still[N][N], damped[N][N];
} affine;

static double ratio_at(const affine *A, double damping) {
    double sum[N][N];

    for (int i = 0; i < N; i++) {
        for (int j = 0; j < N; j++) sum[i][j] = A->still[i][j] + damping * A->damped[i][j];
    }
    return tune_least_ratio(sum);
}

/* (tune-1): the first D, from 0 up, whose least ratio is the one asked for: by regula falsi with the weights of Illinois. */
static bool root(const affine *A, double guess, double ratio, double *damping) {
    double low = 0, high = guess, f_low = -ratio, f_high = ratio_at(A, high) - ratio;

    for (int i = 0; i < MOST_STEPS && !(f_high >= 0); i++) {
        if (!(f_high < 0)) return false;
        low = high, f_low = f_high;
        high *= 2;
        f_high = ratio_at(A, high) - ratio;
    }
    for (int i = 0; i < MOST_STEPS && high - low > precision * high && f_high > 0; i++) {
        double next = low + (high - low) * f_low / (f_low - f_high), f;
        if (!(next > low && next < high)) next = 0.5 * (low + high);
        f = ratio_at(A, next) - ratio;
        if (f < 0) {
            low = next, f_low = f;
            f_high *= 0.5; /* lest one end stay for ever */
        } else {
            high = next, f_high = f;
            f_low *= 0.5;
        }
    }
    *damping = high;
    return isfinite(high);
}

/* The loop about where it rests, its forces there counted as fed forward, with and without damping. A_D is a difference of two
 * matrices that differ by it alone, as large as what it is taken from. */
static gough_status parts(const gough_model *model, double unit, affine *A, gough_error *error) {
    gough_control control = model->control;
    gough_motion motion;
    const linear_loop loop = {&model->machine, &motion, &control, false, 0, false};
    gough_status status = equilibrium_find(model, NULL, &motion, error);

    control_knows_all(&control);
    memset(control.cross_damping, 0, sizeof control.cross_damping);
    for (int with = 0; with < 2 && status == GOUGH_OK; with++) {
        double(*matrix)[N] = with ? A->damped : A->still;
        const char *wrong;
        for (int v = 0; v < GOUGH_LEGS; v++) control.damping[v] = with ? unit : 0;
        wrong = linear_complex.matrix(&loop, 0, NULL, matrix);
        status = linear_check(&loop, 0, NULL, matrix, wrong, error);
    }
    if (status != GOUGH_OK) return status;
    for (int i = 0; i < N; i++) {
        for (int j = 0; j < N; j++) A->damped[i][j] = (A->damped[i][j] - A->still[i][j]) / unit;
    }
    return GOUGH_OK;
}

gough_status gough_damping_for_ratio(const gough_model *model, double ratio, double *damping,
                                     gough_error *error) {
    const double mass = model->machine.load.mass;
    double stiffness = 0, unit;
    affine A;
    gough_status status;

    if (!(ratio >= 0 && ratio < 1)) {
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "the damping ratio must be at least 0 and less than 1, not %.9g", ratio);
    }
    status = motion_check(&model->motion, error);
    if (status == GOUGH_OK) status = machine_can_move(&model->machine, error);
    if (status != GOUGH_OK) return status;
    if (model->control.sampling.period > 0) {
        if (ratio > 0) return tune_sampled_damping(model, ratio, damping, error);
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "with a sampled controller the damping ratio must be greater than 0: at "
                          "0 the loop is at the edge of stability");
    }
    if (gough_linear_size(model) > GOUGH_LINEAR) {
        if (ratio > 0) return tune_states_damping(model, ratio, damping, error);
        return gough_fail(
            error, GOUGH_ERROR_INPUT,
            "with drives that lag or integrals the damping ratio must be greater than "
            "0: at 0 the loop is at the edge of stability");
    }
    for (int v = 0; v < GOUGH_LEGS; v++) stiffness = fmax(stiffness, model->control.stiffness[v]);
    unit = stiffness > 0
               ? sqrt(stiffness * mass)
               : mass * sqrt(model->machine.gravity_magnitude / model->machine.base_radius);
    if (!(unit > 0)) unit = mass; /* nothing holds then, whatever D */
    status = parts(model, unit, &A, error);
    if (status != GOUGH_OK) return status;

    *damping = 0;
    if (!(ratio_at(&A, 1e-3 * unit) > 0)) {
        return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                          "with the stiffness %.9g" IN_STIFFNESS
                          " some mode is not held at home, and damping "
                          "cannot change that; use a greater stiffness",
                          stiffness);
    }
    if (ratio > 0 && !root(&A, ratio * unit, ratio, damping)) {
        return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                          "found no damping that gives the least damped mode the ratio %.9g: the "
                          "eigenvalues of the loop differ too much in size",
                          ratio);
    }
    return GOUGH_OK;
}
