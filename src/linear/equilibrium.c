/* Equilibrium of a loop: the pose asked for, or, where no forces are fed forward, what it sags to as its load comes on.
 * Theory: docs/theory/stability.md. */
#include "linear/equilibrium.h"
#include "base/quantity.h"

#include <lapacke.h>
#include <math.h>
#include <string.h>

#include "base/limits.h"
#include "control/program_lack.h"
#include "linear/linear.h"

/* Newton's steps, in base radii and radians. The first must not leave the branch it comes from; each next is at most half of
 * the one before, until rounding is reached. */
static const double longest_step = 0.1, rounding_step = 1e-14, settled_step = 1e-10;

/* the load comes on in shares of this to begin with, and of no less than that where it bends */
static const double first_share = 0.25, least_share = 1e-4;

static const double degrees = 180 / 3.14159265358979323846;

enum { NEWTON_STEPS = 60 };

static double length_of(const double v[3]) { return hypot(hypot(v[0], v[1]), v[2]); }

/* M v */
static void multiply(double m[3][3], const double v[3], double out[3]) {
    for (int r = 0; r < 3; r++) out[r] = m[r][0] * v[0] + m[r][1] * v[1] + m[r][2] * v[2];
}

/* R turned by the vector w, base axes: R + sin a/a w×R + (1 − cos a)/a² w×(w×R), a = |w| */
static void turn(const double w[3], double R[3][3]) {
    const double a = length_of(w),
                 small = 1e-5; /* below it both series end after their first term */
    const double s = a > small ? sin(a) / a : 1, c = a > small ? (1 - cos(a)) / (a * a) : 0.5;
    double W[3][3] = {{0, -w[2], w[1]}, {w[2], 0, -w[0]}, {-w[1], w[0], 0}};

    for (int column = 0; column < 3; column++) {
        const double e[3] = {R[0][column], R[1][column], R[2][column]};
        double first[3], second[3];
        multiply(W, e, first);
        multiply(W, first, second);
        for (int r = 0; r < 3; r++) R[r][column] = e[r] + s * first[r] + c * second[r];
    }
}

/* the centre of mass moved by step[0…2], the top turned by step[3…5] about it */
static void displace(const gough_machine *machine, const double step[6], gough_state *state) {
    const double *c = machine->load.center_of_mass;
    double before[3], after[3];

    multiply(state->rotation, c, before);
    turn(step + 3, state->rotation);
    multiply(state->rotation, c, after);
    for (int r = 0; r < 3; r++) state->position[r] += step[r] + before[r] - after[r];
}

/* Newton's step towards no acceleration: −∂a/∂(δr, δθ)⁻¹ a, by columns for LAPACK. Returns false where that matrix is singular. */
static bool newton_step(const linear_loop *loop, const gough_state *state, double step[6]) {
    double force[GOUGH_LEGS], by_columns[6 * 6], largest = 0;
    linear_matrix A;
    lapack_int pivot[6];

    if (linear_complex.accelerations(loop, 0, state, step, force) != NULL) return false;
    if (linear_complex.matrix(loop, 0, state, A) != NULL) return false;
    for (int i = 0; i < 6; i++) {
        step[i] = -step[i];
        if (!isfinite(step[i])) return false;
        largest = fmax(largest, fabs(step[i]));
        for (int j = 0; j < 6; j++) {
            by_columns[i + 6 * j] = A[6 + i][j];
            if (!isfinite(A[6 + i][j])) return false;
        }
    }
    if (!(largest > 0)) return true;
    return LAPACKE_dgesv_work(LAPACK_COL_MAJOR, 6, 1, by_columns, 6, pivot, step, 6) == 0;
}

/* from a state nearby to the balance */
static bool settle(const linear_loop *loop, gough_state *state) {
    double before = longest_step;

    for (int k = 0; k < NEWTON_STEPS; k++) {
        double step[6], size;

        if (!newton_step(loop, state, step)) return false;
        size = fmax(length_of(step) / loop->machine->base_radius, length_of(step + 3));
        if (!(size <= (k == 0 ? before : before / 2))) return k > 0 && before <= settled_step;
        displace(loop->machine, step, state);
        if (size <= rounding_step) return true;
        before = size;
    }
    return false;
}

/* (stab-14): gravity and external loads come on from 0, when the pose asked for is the balance, to 1. Returns the share that the
 * springs bear. */
static double take_up_load(const linear_loop *loop, gough_state *state) {
    gough_machine lighter = *loop->machine;
    linear_loop part = {&lighter, loop->motion, loop->control, false, 0, false};
    double borne = 0, more = first_share;

    while (borne < 1 && more >= least_share) {
        const double share = fmin(1, borne + more);
        gough_state there = *state;

        for (int r = 0; r < 3; r++) lighter.gravity[r] = share * loop->machine->gravity[r];
        part.unloaded = 1 - share;
        if (settle(&part, &there)) {
            *state = there;
            borne = share;
            more *= 2;
        } else {
            more /= 2;
        }
    }
    return borne;
}

/* a program that stands in a state */
static void stand(const gough_machine *machine, const gough_state *state, gough_motion *rest) {
    double rotation[3][3], angles[3];

    memcpy(rotation, state->rotation, sizeof rotation);
    gough_angles_from_rotation(rotation, angles);
    memset(rest, 0, sizeof *rest);
    for (int c = 0; c < 3; c++) {
        const double home = c == 2 ? machine->platform.height : 0;
        rest->formula[GOUGH_SURGE + c] = gough_formula_constant(state->position[c] - home);
        rest->formula[GOUGH_ROLL + c] = gough_formula_constant(angles[c]);
    }
}

/* "home", or "surge 0.1, yaw 5°" */
static void words_of(const double component[GOUGH_COMPONENTS], gough_error *words) {
    char text[sizeof words->message] = "";

    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        const bool angle = c >= GOUGH_ROLL;
        const double value = component[c] * (angle ? degrees : 1);
        if (!(fabs(value) > 0)) continue;
        const gough_error before = *words;
        gough_fail(words, GOUGH_OK, "%s%s%s %.6g%s", text, text[0] ? ", " : "",
                   gough_component_name(c), value, angle ? IN_DEGREES "°" : IN_LENGTH);
        if (text[0]) quantity_carry(words, &before);
        memcpy(text, words->message, sizeof text);
    }
    if (text[0] == '\0') gough_fail(words, GOUGH_OK, "home");
}

static gough_status check_pose(const gough_machine *machine, const gough_state *state,
                               const char *what, const char *pose, double *determinant,
                               gough_error *error) {
    double condition;

    gough_conditioning(machine, state, &condition, determinant);
    if (condition <= greatest_condition) return GOUGH_OK;
    return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                      "%s (%s) is singular or nearly so (condition %.3g): no leg forces can hold "
                      "the load there; choose another pose",
                      what, pose, condition);
}

static gough_status sag(const linear_loop *loop, const char *pose, double determinant,
                        gough_state *state, gough_error *error) {
    const program_lack lack = program_lack_of(loop->machine, loop->control, false);
    const double borne = take_up_load(loop, state);
    gough_error what;
    double there;
    gough_status status;

    if (!(borne >= 1)) {
        return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                          "%s no equilibrium was found near the requested pose "
                          "(%s): the stiffness of the legs carries only %.3g %% of the load; "
                          "increase control.stiffness, or set %s",
                          lack.how, pose, 100 * borne, lack.cure);
    }
    gough_fail(&what, GOUGH_OK, "the equilibrium %s, starting from", lack.how);
    status = check_pose(loop->machine, state, what.message, pose, &there, error);
    if (status != GOUGH_OK || there * determinant > 0) return status;
    return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                      "%s the load comes to rest only beyond a singular pose, "
                      "starting from the requested pose (%s); increase control.stiffness, or set "
                      "%s",
                      lack.how, pose, lack.cure);
}

gough_status equilibrium_ask(const gough_model *model, const double *component, gough_motion *rest,
                             asked_pose *asked, gough_error *error) {
    static const double home[GOUGH_COMPONENTS];
    const double *from = component != NULL ? component : home;
    gough_acceleration none;

    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        if (isfinite(from[c])) continue;
        return gough_fail(error, GOUGH_ERROR_INPUT, "%s of the requested pose is not finite",
                          gough_component_name(c));
    }
    memset(rest, 0, sizeof *rest);
    memcpy(rest->about, model->motion.about, sizeof rest->about);
    rest->order = model->motion.order;
    for (int c = 0; c < GOUGH_COMPONENTS; c++) rest->formula[c] = gough_formula_constant(from[c]);

    words_of(from, &asked->words);
    gough_program(&model->machine, rest, 0, &asked->state, &none);
    const gough_status status = check_pose(&model->machine, &asked->state, "the requested pose",
                                           asked->words.message, &asked->determinant, error);
    if (status != GOUGH_OK) quantity_carry(error, &asked->words);
    return status;
}

/* Legs with an integral come to their lengths, others sag: such a balance is not computed. */
static gough_status refuse_mixed(const gough_control *control, gough_error *error) {
    const int integrate = control_integrates(control);

    if (integrate == 0) return GOUGH_OK;
    return gough_fail_key(
        error, GOUGH_ERROR_INPUT, "control.integral",
        "%d of the legs %s an integral, and forces that hold the load are not all "
        "fed forward: where such a loop rests is not computed; give all six legs "
        "an integral or leave all without one, or feed those forces forward",
        integrate, integrate == 1 ? "has" : "have");
}

gough_status equilibrium_find(const gough_model *model, const double *component, gough_motion *rest,
                              gough_error *error) {
    const linear_loop loop = {&model->machine, rest, &model->control, false, 0, false};
    asked_pose asked;
    gough_status status = equilibrium_ask(model, component, rest, &asked, error);

    if (status != GOUGH_OK || gough_keeps_program(&model->machine, &model->control, false))
        return status;
    status = refuse_mixed(&model->control, error);
    if (status != GOUGH_OK) return status;
    status = sag(&loop, asked.words.message, asked.determinant, &asked.state, error);
    if (status == GOUGH_OK) {
        stand(&model->machine, &asked.state, rest);
    } else {
        quantity_carry(error, &asked.words);
    }
    return status;
}
