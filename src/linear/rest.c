/* The loop at rest: its stiffness, its eigenvalues and what moves in them, and from which stiffness of the legs on it holds.
 * Theory: docs/theory/stability.md. */
#include <complex.h>
#include <lapacke.h>
#include <math.h>
#include <string.h>

#include "control/program_lack.h"
#include "linear/equilibrium.h"
#include "linear/linear.h"
#include "linear/mode.h"
#include "linear/symmetric.h"
#include "linear/verdict.h"
#include "plant/can_move.h"
#include "program/program_valid.h"

enum { WORK = 512 };

/* eigenvalues this close, relative to the largest, are one */
static const double same_value = 1e-9;

/* joints this far out of a plane, in base radii, are in it */
static const double plane_tolerance = 1e-9;

/* a stiffness further from symmetric than this, relative to its largest element, was not found */
static const double greatest_asymmetry = 1e-6;

static const char no_eigenvalues[] =
    "could not compute the eigenvalues of the loop at rest: its numbers differ too much in size; "
    "choose units in which they are near 1";

/* the loop at rest and what follows from its pose */
typedef struct {
    linear_loop loop;
    gough_state state;
    double mass[FREEDOMS][FREEDOMS]; /* M, and the inertia about the centre of mass in base axes */
} at_rest;

/* largest |K − Kᵀ| and |K|, angles counted as lengths on the base radius */
static void measure(double K[FREEDOMS][FREEDOMS], double radius, double *skew, double *size) {
    for (int i = 0; i < FREEDOMS; i++) {
        for (int j = 0; j < FREEDOMS; j++) {
            const double unit = (i < 3 ? 1 : radius) * (j < 3 ? 1 : radius);
            *skew = fmax(*skew, fabs(K[i][j] - K[j][i]) / unit);
            *size = fmax(*size, fabs(K[i][j]) / unit);
        }
    }
}

/* −M̄ times a block of A's lower half: K at the columns from 0, C at those from 6 */
static void lower_block(const at_rest *r, linear_matrix A, int column,
                        double found[FREEDOMS][FREEDOMS]) {
    for (int i = 0; i < FREEDOMS; i++) {
        for (int j = 0; j < FREEDOMS; j++) {
            found[i][j] = 0;
            for (int k = 0; k < FREEDOMS; k++) found[i][j] -= r->mass[i][k] * A[6 + k][column + j];
        }
    }
}

static void symmetric_part(double found[FREEDOMS][FREEDOMS], double part[FREEDOMS][FREEDOMS]) {
    for (int i = 0; i < FREEDOMS; i++) {
        for (int j = 0; j < FREEDOMS; j++) part[i][j] = 0.5 * (found[i][j] + found[j][i]);
    }
}

/* (stab-15): K = −M̄ A₂₁ of a loop at rest, made symmetric; returns the asymmetry found */
static gough_status stiffness_of(const at_rest *r, const linear_loop *loop, double *asymmetry,
                                 double K[FREEDOMS][FREEDOMS], gough_error *error) {
    double found[FREEDOMS][FREEDOMS], skew = 0, size = 0;
    linear_matrix A;
    const char *wrong = linear_complex.matrix(loop, 0, NULL, A);
    const gough_status status = linear_check(loop, 0, NULL, A, wrong, error);

    if (status != GOUGH_OK) return status;
    lower_block(r, A, 0, found);
    measure(found, loop->machine->base_radius, &skew, &size);
    if (asymmetry != NULL) *asymmetry = size > 0 ? skew / size : 0;
    symmetric_part(found, K);
    return GOUGH_OK;
}

/* K_geo, of the loop that only feeds forward; JᵀJ, of springs of stiffness 1 that bear nothing, so that no difference is taken */
static gough_status parts_of_stiffness(const at_rest *r, gough_rest *rest, gough_error *error) {
    const gough_control forces = {.feedforward = true},
                        springs = {.feedforward = true, .stiffness = {1, 1, 1, 1, 1, 1}};
    gough_machine weightless = *r->loop.machine;
    const linear_loop constant = {r->loop.machine, r->loop.motion, &forces, false, 0, false},
                      elastic = {&weightless, r->loop.motion, &springs, false, 1, false};
    gough_status status = stiffness_of(r, &constant, NULL, rest->geometric, error);

    memset(weightless.gravity, 0, sizeof weightless.gravity);
    if (status == GOUGH_OK) status = stiffness_of(r, &elastic, NULL, rest->legs, error);
    return status;
}

/* ---- eigenvalues ---------------------------------------------------------------------------------------------- */

static void equal_apart(const gough_machine *machine, const double kappa[FREEDOMS], double largest,
                        double complex shape[FREEDOMS][6]) {
    double complex value[FREEDOMS];

    for (int k = 0; k < FREEDOMS; k++) value[k] = kappa[k];
    mode_separate(machine, FREEDOMS, value, same_value * largest, shape);
}

/* Without damping: M̄ẍ + K x = 0, so that λ = ±√−κ is real or imaginary, exactly */
static bool undamped(const at_rest *r, const double *K, double complex value[GOUGH_LINEAR_MOST],
                     double complex shape[GOUGH_LINEAR_MOST][6]) {
    double kappa[FREEDOMS];
    double complex x[FREEDOMS][6];
    const double largest = symmetric_problem(K, r->mass[0], kappa, x);

    if (largest < 0) return false;
    equal_apart(r->loop.machine, kappa, largest, x);
    for (int k = 0; k < FREEDOMS; k++) {
        const double root = sqrt(fabs(kappa[k]));
        const double complex lambda = kappa[k] < 0 ? root : I * root;
        for (int side = 0; side < 2; side++) {
            value[2 * k + side] = side ? 0 - lambda : lambda;
            memcpy(shape[2 * k + side], x[k], sizeof x[k]);
        }
    }
    return true;
}

/* With damping: eigenvalues of the whole matrix of N rows, balanced */
static bool damped(const at_rest *r, int N, const double *A,
                   double complex value[GOUGH_LINEAR_MOST],
                   double complex shape[GOUGH_LINEAR_MOST][6]) {
    enum { MOST = GOUGH_LINEAR_MOST };
    double a[MOST * MOST], re[MOST], im[MOST], right[MOST * MOST], work[WORK], left = 0,
                                                                               largest = 0;

    for (int i = 0; i < N; i++) {
        for (int j = 0; j < N; j++) a[i + N * j] = A[N * i + j];
    }
    if (LAPACKE_dgeev_work(LAPACK_COL_MAJOR, 'N', 'V', N, a, N, re, im, &left, 1, right, N, work,
                           WORK) != 0) {
        return false;
    }
    for (int k = 0; k < N; k++) {
        /* of a pair the first has the real part, the second the imaginary part of the shape */
        const int first = im[k] < 0 ? k - 1 : k;
        const double sign = im[k] > 0 ? 1 : im[k] < 0 ? -1 : 0;
        if (!isfinite(re[k]) || !isfinite(im[k])) return false;
        value[k] = re[k] + I * im[k];
        largest = fmax(largest, cabs(value[k]));
        for (int i = 0; i < 6; i++) {
            const double other = first + 1 < N ? right[i + N * (first + 1)] : 0;
            shape[k][i] = right[i + N * first] + I * (sign * other);
        }
    }
    mode_separate(r->loop.machine, N, value, same_value * largest, shape);
    return true;
}

/* by falling growth rate, then by rising frequency; opposite ones stay as they come, the positive first, next to each other */
static bool comes_before(double complex a, double complex b) {
    if (creal(a) > creal(b) || creal(a) < creal(b)) return creal(a) > creal(b);
    return fabs(cimag(a)) < fabs(cimag(b));
}

static void list_eigenvalues(const gough_machine *machine, double complex value[GOUGH_LINEAR_MOST],
                             double complex shape[GOUGH_LINEAR_MOST][6], gough_rest *rest) {
    const int n = (int)rest->size;
    int order[GOUGH_LINEAR_MOST];

    for (int k = 0; k < n; k++) {
        int place = k;
        for (; place > 0 && comes_before(value[k], value[order[place - 1]]); place--) {
            order[place] = order[place - 1];
        }
        order[place] = k;
    }
    for (int k = 0; k < n; k++) {
        gough_eigenvalue *e = &rest->eigenvalue[k];
        e->value[0] = creal(value[order[k]]) + 0; /* no minus zero */
        e->value[1] = cimag(value[order[k]]) + 0;
        mode_of(machine, shape[order[k]], &e->mode);
    }
}

/* Of a loop with states of its own, or with matrices of gains: the verdict is that of the eigenvalues */
static bool by_eigenvalues(const at_rest *r, gough_rest *rest) {
    double complex value[GOUGH_LINEAR_MOST], shape[GOUGH_LINEAR_MOST][6];
    double A[GOUGH_LINEAR_MOST * GOUGH_LINEAR_MOST];
    int kept[LINEAR_BEYOND];

    linear_beyond(r->loop.machine, r->loop.control, kept);
    linear_complex.whole(&r->loop, 0, NULL, kept, (int)rest->size, A);
    for (size_t i = 0; i < rest->size * rest->size; i++) {
        if (!isfinite(A[i])) return false;
    }
    if (!damped(r, (int)rest->size, A, value, shape)) return false;
    list_eigenvalues(r->loop.machine, value, shape, rest);
    verdict_by_eigenvalues(r->loop.machine, rest);
    return true;
}

static gough_status eigenvalues(const at_rest *r, double K[FREEDOMS][FREEDOMS], gough_rest *rest,
                                gough_error *error) {
    const gough_machine *machine = r->loop.machine;
    double complex value[GOUGH_LINEAR_MOST], shape[GOUGH_LINEAR_MOST][6];
    double found_damping[FREEDOMS][FREEDOMS], C[FREEDOMS][FREEDOMS];
    bool found;

    if (rest->size > GOUGH_LINEAR || r->loop.control->coupled) {
        if (by_eigenvalues(r, rest)) return GOUGH_OK;
        return gough_fail(error, GOUGH_ERROR_NUMERICAL, "%s", no_eigenvalues);
    }
    found = linear_is_damped(&r->loop) ? damped(r, GOUGH_LINEAR, rest->matrix[0], value, shape)
                                       : undamped(r, K[0], value, shape);
    if (!found) return gough_fail(error, GOUGH_ERROR_NUMERICAL, "%s", no_eigenvalues);

    list_eigenvalues(machine, value, shape, rest);
    lower_block(r, rest->matrix, 6, found_damping);
    symmetric_part(found_damping, C);
    if (!verdict_at_rest(machine, r->mass[0], K, C, rest))
        return gough_fail(error, GOUGH_ERROR_NUMERICAL, "%s", no_eigenvalues);
    return GOUGH_OK;
}

/* ---- thresholds and the theorem ------------------------------------------------------------------------------- */

/* (stab-10) in all six freedoms: −K_geo v = γ JᵀJ v */
static gough_status thresholds(const gough_machine *machine, gough_rest *rest, gough_error *error) {
    double kappa[FREEDOMS];
    double complex shape[FREEDOMS][6];
    const double largest = symmetric_problem(rest->geometric[0], rest->legs[0], kappa, shape);

    if (largest < 0) {
        return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                          "the pose is too close to a singular one for thresholds of the "
                          "stiffness: no leg stiffness holds the load there; choose another pose");
    }
    equal_apart(machine, kappa, largest, shape);
    for (int k = 0; k < FREEDOMS; k++) {
        rest->threshold[k].stiffness = kappa[k] < 0 ? -kappa[k] : 0;
        rest->threshold[k].neutral = !(kappa[k] < 0) && !(kappa[k] > 0);
        mode_of(machine, shape[k], &rest->threshold[k].mode);
    }
    return GOUGH_OK;
}

/* the height of six joints over the base frame's origin against gravity, or NaN where they are not in one level plane */
static double level_of(double joint[GOUGH_LEGS][3], const double up[3], double tolerance) {
    double height[GOUGH_LEGS], sum = 0;

    for (int v = 0; v < GOUGH_LEGS; v++) {
        height[v] = joint[v][0] * up[0] + joint[v][1] * up[1] + joint[v][2] * up[2];
        sum += height[v];
    }
    for (int v = 0; v < GOUGH_LEGS; v++) {
        if (!(fabs(height[v] - sum / GOUGH_LEGS) <= tolerance)) return NAN;
    }
    return sum / GOUGH_LEGS;
}

/* what of the legs' mass hangs on the top, Σ S of (mass-1) */
static double hanging_mass(const gough_machine *machine, const gough_state *state) {
    const gough_platform *p = &machine->platform;
    double length[GOUGH_LEGS], sum = 0;

    gough_leg_kinematics(machine, state, NULL, length, NULL, NULL);
    for (int v = 0; v < GOUGH_LEGS; v++) {
        sum += (p->cylinder.mass[v] * p->cylinder.center[v] +
                p->piston.mass[v] * (length[v] - p->piston.center[v])) /
               length[v];
    }
    return sum;
}

/* (stab-5), with legs that have mass (mass-16) */
static void traces(const at_rest *r, gough_rest *rest) {
    const gough_machine *machine = r->loop.machine;
    const double g = machine->gravity_magnitude, tolerance = plane_tolerance * machine->base_radius;
    double up[3] = {0, 0, 1}, base[GOUGH_LEGS][3], top[GOUGH_LEGS][3], h;

    for (int i = 0; i < 3 && g > 0; i++) up[i] = -machine->gravity[i] / g;
    for (int v = 0; v < GOUGH_LEGS; v++) {
        for (int i = 0; i < 3; i++) {
            top[v][i] = r->state.position[i];
            for (int j = 0; j < 3; j++)
                top[v][i] += r->state.rotation[i][j] * machine->platform.top[v][j];
        }
    }
    memcpy(base, machine->platform.base, sizeof base);
    h = level_of(top, up, tolerance) - level_of(base, up, tolerance);
    rest->trace = rest->geometric[0][0] + rest->geometric[1][1] + rest->geometric[2][2];
    const double mass = machine->load.mass + hanging_mass(machine, &r->state);
    rest->trace_theorem = fabs(h) > tolerance ? 0 - 2 * mass * g / h : NAN;
}

/* (stab-15) at the equilibrium, whose forces count as fed forward: the loop about it is the same */
static gough_status analyse(const at_rest *r, gough_rest *rest, gough_error *error) {
    const linear_loop *loop = &r->loop;
    double K[FREEDOMS][FREEDOMS], acceleration[6];
    const char *wrong = linear_complex.matrix(loop, 0, NULL, rest->matrix);
    gough_status status = linear_check(loop, 0, NULL, rest->matrix, wrong, error);

    if (status == GOUGH_OK) status = stiffness_of(r, loop, &rest->asymmetry, K, error);
    const bool skew = !loop->control->coupled && !(rest->asymmetry <= greatest_asymmetry);
    if (status == GOUGH_OK && skew && machine_loads_follow(loop->machine)) {
        status = gough_fail_key(error, GOUGH_ERROR_INPUT, "external",
                                "external: load %d turns with the top or is a moment, so that its "
                                "work depends on the way and the stiffness at rest is not "
                                "symmetric; stability at rest is computed for forces with the axes "
                                "of the base only. Simulate instead",
                                machine_loads_follow(loop->machine));
    } else if (status == GOUGH_OK && skew) {
        status = gough_fail(error, GOUGH_ERROR_NUMERICAL, "%s", no_eigenvalues);
    }
    if (status == GOUGH_OK) status = parts_of_stiffness(r, rest, error);
    if (status == GOUGH_OK) status = eigenvalues(r, K, rest, error);
    if (status == GOUGH_OK) status = thresholds(loop->machine, rest, error);
    if (status != GOUGH_OK) return status;

    linear_complex.accelerations(loop, 0, &r->state, acceleration, rest->force);
    traces(r, rest);
    return GOUGH_OK;
}

gough_status linear_at_rest(const gough_model *model, const double component[GOUGH_COMPONENTS],
                            gough_motion *motion, gough_control *control, gough_state *state,
                            gough_error *error) {
    gough_acceleration none;
    gough_status status = motion_check(&model->motion, error);

    if (status == GOUGH_OK) status = machine_can_move(&model->machine, error);
    if (status == GOUGH_OK) status = equilibrium_find(model, component, motion, error);
    if (status != GOUGH_OK) return status;
    *control = model->control;
    control_knows_all(control);
    gough_program(&model->machine, motion, 0, state, &none);
    return GOUGH_OK;
}

gough_status gough_stability_at_rest(const gough_model *model,
                                     const double component[GOUGH_COMPONENTS], gough_rest *rest,
                                     gough_error *error) {
    gough_control control;
    gough_motion motion;
    at_rest r = {.loop = {&model->machine, &motion, &control, false, 0, false}};
    gough_status status;

    memset(rest, 0, sizeof *rest);
    status = linear_at_rest(model, component, &motion, &control, &r.state, error);
    if (status != GOUGH_OK) return status;
    linear_mass(&model->machine, &r.state, r.mass);
    rest->state = r.state;
    rest->size = gough_linear_size(model);
    return analyse(&r, rest, error);
}
