/* Gains that couple the legs: the machine at rest in the lengths of its legs, gains by poles, and the poles of a loop with given
 * gains. Theory: docs/theory/tuning.md. */
#include "tune/gains.h"

#include <complex.h>
#include <lapacke.h>
#include <math.h>
#include <string.h>

#include "base/quantity.h"
#include "linear/equilibrium.h"
#include "linear/linear.h"
#include "linear/mode.h"
#include "plant/can_move.h"
#include "program/program_valid.h"

enum { N = GOUGH_LEGS, STATES = 2 * GOUGH_LEGS, WORK = 512 };

static const double two_pi = 6.28318530717958647692;

/* eigenvalues this close, relative to the largest, are one */
static const double same_value = 1e-9;

/* eigenvalues about a double real one are found to half of their digits, their mean to all: those this close are taken for it */
static const double double_value = 1e-6;

double gains_size(leg_matrix a) {
    double largest = 0;

    for (int i = 0; i < N; i++) {
        for (int j = 0; j < N; j++) {
            if (!(fabs(a[i][j]) <= largest)) largest = fabs(a[i][j]);
        }
    }
    return largest;
}

void gains_product(leg_matrix a, leg_matrix b, leg_matrix out) {
    leg_matrix sum;

    for (int i = 0; i < N; i++) {
        for (int j = 0; j < N; j++) {
            sum[i][j] = 0;
            for (int k = 0; k < N; k++) sum[i][j] += a[i][k] * b[k][j];
        }
    }
    memcpy(out, sum, sizeof sum);
}

gough_status gains_fail(gough_error *error) {
    return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                      "could not compute gains: the machine's numbers differ too much in size; "
                      "choose units in which they are near 1");
}

/* ---- the machine at rest ------------------------------------------------------------------------------------------ */

static void transpose(leg_matrix a, leg_matrix out) {
    for (int i = 0; i < N; i++) {
        for (int j = 0; j < N; j++) out[i][j] = a[j][i];
    }
}

/* A⁻¹ B */
static bool solve(leg_matrix a, leg_matrix b, leg_matrix out) {
    double columns[N * N], right[N * N];
    lapack_int pivot[N];

    for (int i = 0; i < N; i++) {
        for (int j = 0; j < N; j++) {
            columns[i + N * j] = a[i][j], right[i + N * j] = b[i][j];
            if (!isfinite(a[i][j]) || !isfinite(b[i][j])) return false;
        }
    }
    if (LAPACKE_dgesv_work(LAPACK_COL_MAJOR, N, N, columns, N, pivot, right, N) != 0) return false;
    for (int i = 0; i < N; i++) {
        for (int j = 0; j < N; j++) out[i][j] = right[i + N * j];
    }
    return true;
}

/* (legs-5) of the velocity of the centre of mass: a row (n, m) of the top frame's origin becomes (n, m − Rc × n) */
static void jacobian_of_center(const gough_machine *machine, const gough_state *state,
                               leg_matrix J) {
    double c[3] = {0, 0, 0};

    gough_jacobian(machine, state, J);
    for (int r = 0; r < 3; r++) {
        for (int k = 0; k < 3; k++) c[r] += state->rotation[r][k] * machine->load.center_of_mass[k];
    }
    for (int v = 0; v < N; v++) {
        const double *n = J[v];
        const double turned[3] = {c[1] * n[2] - c[2] * n[1], c[2] * n[0] - c[0] * n[2],
                                  c[0] * n[1] - c[1] * n[0]};
        for (int r = 0; r < 3; r++) J[v][3 + r] -= turned[r];
    }
}

/* Wᵀ A W */
static void to_legs(leg_matrix W, leg_matrix a, leg_matrix out) {
    leg_matrix across;

    transpose(W, across);
    gains_product(a, W, out);
    gains_product(across, out, out);
}

/* (tune-7) from the mass, the Jacobian and −K_geo = M̄ A₂₁ of a loop whose leg forces stay as they are */
static bool parts(gains_plant *p, linear_matrix A) {
    leg_matrix J, across, mass, fallen, unit = {{0}};

    for (int i = 0; i < N; i++) {
        unit[i][i] = 1;
        for (int j = 0; j < N; j++) fallen[i][j] = -A[6 + i][j];
    }
    jacobian_of_center(p->machine, &p->state, J);
    linear_mass(p->machine, &p->state, mass);
    transpose(J, across);
    if (!solve(J, unit, p->back) || !solve(mass, across, p->mobility)) return false;
    gains_product(J, p->mobility, p->mobility);
    gains_product(mass, fallen, fallen);
    to_legs(p->back, mass, p->inertia);
    to_legs(p->back, fallen, p->geometric);
    memcpy(p->viscous, p->machine->platform.friction.viscous, sizeof p->viscous);
    return isfinite(gains_size(p->geometric)) && isfinite(gains_size(p->mobility)) &&
           isfinite(gains_size(p->inertia));
}

gough_status gains_plant_find(const gough_model *model, const double *component, gains_plant *plant,
                              gough_error *error) {
    const gough_control forces = {.feedforward = true};
    gough_motion rest;
    const linear_loop constant = {&model->machine, &rest, &forces, true, 0, false};
    asked_pose asked;
    linear_matrix A;
    gough_status status = motion_check(&model->motion, error);

    if (status == GOUGH_OK) status = machine_can_move(&model->machine, error);
    if (status == GOUGH_OK) status = equilibrium_ask(model, component, &rest, &asked, error);
    if (status != GOUGH_OK) return status;
    const char *wrong = linear_complex.matrix(&constant, 0, NULL, A);
    status = linear_check(&constant, 0, NULL, A, wrong, error);
    if (status != GOUGH_OK) return status;
    plant->machine = &model->machine;
    plant->state = asked.state;
    return parts(plant, A) ? GOUGH_OK : gains_fail(error);
}

/* ---- the poles of a loop ------------------------------------------------------------------------------------------ */

/* d/dt (e, ė), by columns */
static void loop_of(gains_plant *plant, const gough_gains *gains, double *a) {
    leg_matrix spring, damper;

    for (int i = 0; i < N; i++) {
        for (int j = 0; j < N; j++) {
            spring[i][j] = plant->geometric[i][j] + gains->stiffness[i][j];
            damper[i][j] = gains->damping[i][j] + (i == j ? plant->viscous[i] : 0);
        }
    }
    gains_product(plant->mobility, spring, spring);
    gains_product(plant->mobility, damper, damper);
    memset(a, 0, STATES * STATES * sizeof *a);
    for (int i = 0; i < N; i++) {
        a[i + STATES * (N + i)] = 1;
        for (int j = 0; j < N; j++) {
            a[N + i + STATES * j] = -spring[i][j];
            a[N + i + STATES * (N + j)] = -damper[i][j];
        }
    }
}

/* mean of those about a double real value */
static void join_double_values(double complex value[STATES]) {
    double complex found[STATES];

    memcpy(found, value, sizeof found);
    for (int k = 0; k < STATES; k++) {
        const double close = double_value * cabs(found[k]);
        double complex sum = 0;
        int count = 0;
        if (!(fabs(cimag(found[k])) <= close)) continue;
        for (int j = 0; j < STATES; j++) {
            if (!(cabs(found[j] - found[k]) <= close)) continue;
            sum += found[j];
            count++;
        }
        if (count > 1) value[k] = creal(sum) / count;
    }
}

static bool comes_before(double complex a, double complex b) {
    const double apart = same_value * cabs(a);

    if (fabs(creal(a) - creal(b)) > apart) return creal(a) > creal(b);
    if (fabs(fabs(cimag(a)) - fabs(cimag(b))) > apart) return fabs(cimag(a)) < fabs(cimag(b));
    return false;
}

static void list_poles(const gough_machine *machine, const double complex value[STATES],
                       double complex shape[STATES][6], gough_gains *gains) {
    int order[STATES];

    for (int k = 0; k < STATES; k++) {
        int place = k;
        for (; place > 0 && comes_before(value[k], value[order[place - 1]]); place--)
            order[place] = order[place - 1];
        order[place] = k;
    }
    for (int k = 0; k < STATES; k++) {
        gough_eigenvalue *pole = &gains->pole[k];
        pole->value[0] = creal(value[order[k]]) + 0; /* no minus zero */
        pole->value[1] = cimag(value[order[k]]) + 0;
        mode_of(machine, shape[order[k]], &pole->mode);
    }
}

bool gains_poles_find(gains_plant *plant, gough_gains *gains) {
    double a[STATES * STATES], re[STATES], im[STATES], right[STATES * STATES], work[WORK], left = 0;
    double complex value[STATES], shape[STATES][6];
    double largest = 0;

    gains->state = plant->state;
    if (!isfinite(gains_size(gains->stiffness)) || !isfinite(gains_size(gains->damping)))
        return false;
    loop_of(plant, gains, a);
    for (int i = 0; i < STATES * STATES; i++) {
        if (!isfinite(a[i])) return false;
    }
    if (LAPACKE_dgeev_work(LAPACK_COL_MAJOR, 'N', 'V', STATES, a, STATES, re, im, &left, 1, right,
                           STATES, work, WORK) != 0)
        return false;
    for (int k = 0; k < STATES; k++) {
        /* of a pair the first has the real part, the second the imaginary part of the errors e */
        const int first = im[k] < 0 ? k - 1 : k;
        const double sign = im[k] > 0 ? 1 : im[k] < 0 ? -1 : 0;
        if (!isfinite(re[k]) || !isfinite(im[k])) return false;
        value[k] = re[k] + I * im[k];
        largest = fmax(largest, cabs(value[k]));
        for (int i = 0; i < 6; i++) {
            shape[k][i] = 0;
            for (int j = 0; j < N; j++) {
                const double other = first + 1 < STATES ? right[j + STATES * (first + 1)] : 0;
                shape[k][i] -= plant->back[i][j] * (right[j + STATES * first] + I * (sign * other));
            }
        }
    }
    join_double_values(value);
    mode_separate(plant->machine, STATES, value, same_value * largest, shape);
    list_poles(plant->machine, value, shape, gains);
    return true;
}

/* ---- gains by poles ----------------------------------------------------------------------------------------------- */

gough_status gough_gains_by_poles(const gough_model *model,
                                  const double component[GOUGH_COMPONENTS], double frequency,
                                  double damping_ratio, gough_gains *gains, gough_error *error) {
    const double omega = two_pi * frequency;
    gains_plant plant;
    gough_status status;

    memset(gains, 0, sizeof *gains);
    if (!(frequency > 0 && isfinite(frequency)))
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "the frequency of the poles must be greater than 0, not %.9g" IN_RATE,
                          frequency);
    if (!(damping_ratio >= 0 && damping_ratio <= 1))
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "the damping ratio of the poles must be from 0 to 1, not %.9g",
                          damping_ratio);
    status = gains_plant_find(model, component, &plant, error);
    if (status != GOUGH_OK) return status;

    /* (tune-6): G = ω² S⁻¹ − Γ, D = 2ζω S⁻¹ − Δ */
    for (int i = 0; i < N; i++) {
        for (int j = 0; j < N; j++) {
            gains->stiffness[i][j] = omega * omega * plant.inertia[i][j] - plant.geometric[i][j];
            gains->damping[i][j] =
                2 * damping_ratio * omega * plant.inertia[i][j] - (i == j ? plant.viscous[i] : 0);
        }
    }
    return gains_poles_find(&plant, gains) ? GOUGH_OK : gains_fail(error);
}

void gough_gains_apply(const gough_gains *gains, gough_control *control) {
    control->coupled = true;
    for (int i = 0; i < N; i++) {
        for (int j = 0; j < N; j++) {
            control->cross_stiffness[i][j] = i == j ? 0 : gains->stiffness[i][j];
            control->cross_damping[i][j] = i == j ? 0 : gains->damping[i][j];
        }
        control->stiffness[i] = gains->stiffness[i][i];
        control->damping[i] = gains->damping[i][i];
    }
}
