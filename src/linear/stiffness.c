/* The stiffness of a loop at rest about a point of the top, and its inverse. Theory: docs/theory/stability.md. */
#include <lapacke.h>
#include <math.h>
#include <string.h>

#include "linear/equilibrium.h"
#include "linear/linear.h"
#include "linear/symmetric.h"
#include "plant/can_move.h"
#include "program/program_valid.h"

/* a stiffness per mass below this part of the largest counts as 0 */
static const double least_stiffness = 1e-12;

/* R v of a point of the top frame less another */
static void turned(const gough_state *state, const double point[3], const double from[3],
                   double out[3]) {
    for (int r = 0; r < 3; r++) {
        out[r] = 0;
        for (int c = 0; c < 3; c++) out[r] += state->rotation[r][c] * (point[c] - from[c]);
    }
}

/* Σ G y yᵀ with y = (n, r × n), r the top joint from the point; of a matrix Σ y G yᵀ over pairs of legs */
static void of_control(const gough_model *model, const gough_state *state, double K[6][6]) {
    const gough_platform *p = &model->machine.platform;
    const gough_control *c = &model->control;
    double J[GOUGH_LEGS][6], y[GOUGH_LEGS][6];

    memset(K, 0, sizeof(double[6][6]));
    gough_jacobian(&model->machine, state, J);
    for (int v = 0; v < GOUGH_LEGS; v++) {
        double arm[3];
        turned(state, p->top[v], model->motion.about, arm);
        for (int i = 0; i < 3; i++) {
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            y[v][i] = J[v][i];
            y[v][3 + i] = arm[j] * J[v][k] - arm[k] * J[v][j];
        }
        for (int i = 0; i < 6; i++) {
            for (int j = 0; j < 6; j++) K[i][j] += c->stiffness[v] * y[v][i] * y[v][j];
        }
    }
    for (int v = 0; v < GOUGH_LEGS && c->coupled; v++) {
        for (int w = 0; w < GOUGH_LEGS; w++) {
            for (int i = 0; i < 6; i++) {
                for (int j = 0; j < 6; j++) K[i][j] += c->cross_stiffness[v][w] * y[v][i] * y[w][j];
            }
        }
    }
}

/* (stab-18): TᵀKT, from the centre of mass, at c from the point, to the point: δr_C = δr + δθ × c */
static void to_point(double K[6][6], const double c[3]) {
    double T[6][6] = {{1, 0, 0, 0, c[2], -c[1]}, {0, 1, 0, -c[2], 0, c[0]},
                      {0, 0, 1, c[1], -c[0], 0}, {0, 0, 0, 1, 0, 0},
                      {0, 0, 0, 0, 1, 0},        {0, 0, 0, 0, 0, 1}};
    double half[6][6], out[6][6];

    memset(half, 0, sizeof half);
    memset(out, 0, sizeof out);
    for (int i = 0; i < 6; i++) {
        for (int j = 0; j < 6; j++) {
            for (int k = 0; k < 6; k++) half[i][j] += K[i][k] * T[k][j];
        }
    }
    for (int i = 0; i < 6; i++) {
        for (int j = 0; j < 6; j++) {
            for (int k = 0; k < 6; k++) out[i][j] += T[k][i] * half[k][j];
        }
    }
    memcpy(K, out, sizeof out);
}

/* K_geo = −M̄ A₂₁ of a loop whose leg forces stay as they are, about the centre of mass */
static gough_status of_forces(const gough_model *model, const gough_motion *rest,
                              const gough_state *state, double K[6][6], gough_error *error) {
    const gough_control forces = {.feedforward = true};
    const linear_loop constant = {&model->machine, rest, &forces, false, 0, false};
    double mass[6][6];
    linear_matrix A;
    const char *wrong = linear_complex.matrix(&constant, 0, NULL, A);
    const gough_status status = linear_check(&constant, 0, NULL, A, wrong, error);

    if (status != GOUGH_OK) return status;
    linear_mass(&model->machine, state, mass);
    memset(K, 0, sizeof(double[6][6]));
    for (int i = 0; i < 6; i++) {
        for (int j = 0; j < 6; j++) {
            for (int k = 0; k < 6; k++) K[i][j] -= mass[i][k] * A[6 + k][j];
        }
    }
    return GOUGH_OK;
}

/* whether the symmetric part is positive definite, beside a mass of 1 and its moment on the base radius; returns false if LAPACK
 * cannot tell */
static bool find_firm(double K[6][6], double radius, bool *firm) {
    double part[6][6], unit[6][6] = {{0}}, kappa[6], least = INFINITY;
    double complex shape[6][6];

    for (int i = 0; i < 6; i++) {
        unit[i][i] = i < 3 ? 1 : radius * radius;
        for (int j = 0; j < 6; j++) part[i][j] = 0.5 * (K[i][j] + K[j][i]);
    }
    const double largest = symmetric_problem(part[0], unit[0], kappa, shape);
    for (int k = 0; k < 6; k++) least = fmin(least, kappa[k]);
    *firm = largest > 0 && least > least_stiffness * largest;
    return largest >= 0;
}

static bool inverse(double K[6][6], double out[6][6]) {
    double a[36], x[36] = {0};
    lapack_int pivot[6];

    for (int i = 0; i < 6; i++) {
        x[7 * i] = 1;
        for (int j = 0; j < 6; j++) a[i + 6 * j] = K[i][j];
    }
    if (LAPACKE_dgesv_work(LAPACK_COL_MAJOR, 6, 6, a, 6, pivot, x, 6) != 0) return false;
    bool finite = true;
    for (int i = 0; i < 6; i++) {
        for (int j = 0; j < 6; j++) {
            out[i][j] = x[i + 6 * j];
            finite &= isfinite(out[i][j]);
        }
    }
    return finite;
}

gough_status gough_stiffness_at_rest(const gough_model *model,
                                     const double component[GOUGH_COMPONENTS],
                                     gough_stiffness *stiffness, gough_error *error) {
    const gough_machine *machine = &model->machine;
    const gough_acceleration none = {{0, 0, 0}, {0, 0, 0}};
    gough_stiffness *s = stiffness;
    gough_motion rest;
    gough_wrench known;
    asked_pose asked;
    double center[3];
    gough_status status = motion_check(&model->motion, error);

    memset(s, 0, sizeof *s);
    if (status == GOUGH_OK) status = machine_can_move(machine, error);
    if (status == GOUGH_OK) status = equilibrium_ask(model, component, &rest, &asked, error);
    if (status != GOUGH_OK) return status;
    if (gough_external_wrench(machine, &asked.state, 0, &known) != GOUGH_OK)
        return gough_fail_key(error, GOUGH_ERROR_INPUT, "external",
                              "external: a load is not finite at t = 0");

    s->state = asked.state;
    gough_leg_kinematics(machine, &s->state, NULL, s->length, NULL, NULL);
    status = gough_inverse_dynamics(machine, &s->state, &none, &known, s->force, &s->condition);
    if (status != GOUGH_OK) /* unreachable: the pose has been checked */
        return gough_fail(error, status, "no leg forces hold the load in the requested pose");
    status = of_forces(model, &rest, &s->state, s->geometric, error);
    if (status != GOUGH_OK) return status;
    turned(&s->state, machine->load.center_of_mass, model->motion.about, center);
    to_point(s->geometric, center);
    of_control(model, &s->state, s->control);
    for (int i = 0; i < 6; i++) {
        for (int j = 0; j < 6; j++) {
            s->total[i][j] = s->control[i][j] + s->geometric[i][j];
            s->compliance[i][j] = (double)NAN;
        }
    }
    if (!find_firm(s->total, machine->base_radius, &s->firm) ||
        (s->firm && !inverse(s->total, s->compliance)))
        return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                          "could not compute whether the stiffness resists every displacement: "
                          "LAPACK did not solve its problem");
    return GOUGH_OK;
}
