/* Transition matrices of the parts of a period at the Chebyshev points of the stiffness. Theory: docs/theory/floquet.md. */
#define NUMBER_DOUBLE
#include "map/transition.h"
#include "base/quantity.h"

#include <lapacke.h>
#include <math.h>
#include <string.h>

#include "integrate/dop853_table.h"

static const double pi = 3.14159265358979323846;

/* Of a part: the phase of the fastest mode at the greatest stiffness, for which NODES points suffice to rounding (the terms
 * beyond fall as the Bessel function of order 2 NODES), and the logarithm of what grows without stiffness, beside which the rest
 * is rounded off. */
static const double part_phase = 12, part_growth = 7;

/* 4800 rad in a period; beyond it a row takes minutes, and says nothing that a smaller stiffness does not */
static const double most_parts = 400, most_steps = 10000;

/* of a step: the phase of the fastest mode, and what it decays by, the method being stable up to 5; then the least number of
 * steps in a period, for the program's own harmonics */
static const double step_phase = 0.5, step_decay = 2;
enum { LEAST_STEPS = 32, LOOKS = 16, SIDES = 256, WORK = 12 * GOUGH_LINEAR };

static gough_control control_of(const linear_loop *loop, double stiffness, int damped) {
    gough_control control = *loop->control;

    for (int v = 0; v < GOUGH_LEGS; v++) {
        control.stiffness[v] = stiffness;
        if (!damped) control.damping[v] = 0;
    }
    return control;
}

/* largest |λ| and Re λ of a matrix */
static void rates_of(linear_matrix A, double *size, double *growth) {
    double a[MATRIX], re[GOUGH_LINEAR], im[GOUGH_LINEAR], work[WORK];

    memcpy(a, A, sizeof a); /* the transpose has the same eigenvalues */
    if (LAPACKE_dgeev_work(LAPACK_COL_MAJOR, 'N', 'N', GOUGH_LINEAR, a, GOUGH_LINEAR, re, im, NULL,
                           GOUGH_LINEAR, NULL, GOUGH_LINEAR, work, WORK) != 0) {
        *size = INFINITY;
        return;
    }
    for (int i = 0; i < GOUGH_LINEAR; i++) {
        *size = fmax(*size, hypot(re[i], im[i]));
        *growth = fmax(*growth, re[i]);
    }
}

/* Through a singular pose the steps would be made finer without end. The sign of det J tells the side of it, between the looks
 * at the condition too. */
static gough_status check_side(const linear_loop *loop, const gough_period *period,
                               gough_error *error) {
    double first = 0, side;
    gough_acceleration none;
    gough_state state;

    for (int i = 0; i < SIDES; i++) {
        const double t = period->start + period->period * i / SIDES;
        gough_program(loop->machine, loop->motion, t, &state, &none);
        gough_conditioning(loop->machine, &state, NULL, &side);
        if (i == 0) first = side;
        if (side * first > 0) continue;
        return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                          "by t = %.9g" IN_TIME
                          " the program has reached or passed a singular pose; choose a "
                          "motion that avoids it",
                          t);
    }
    return GOUGH_OK;
}

gough_status transition_divide(const linear_loop *loop, const gough_period *period, double top,
                               division *d, gough_error *error) {
    enum { LOOSE, STIFF, DAMPED, KINDS };
    const gough_control control[KINDS] = {control_of(loop, 0, 0), control_of(loop, top, 0),
                                          control_of(loop, top, 1)};
    const double T = period->period;
    double size[KINDS] = {0}, growth[KINDS] = {0}, parts, steps;

    for (int i = 0; i < LOOKS; i++) {
        const double t = period->start + T * i / LOOKS;
        for (int k = 0; k < KINDS; k++) {
            const linear_loop one = {loop->machine, loop->motion, &control[k], k != DAMPED, 0,
                                     false};
            linear_matrix A;
            const char *wrong = linear_complex.matrix(&one, t, NULL, A);
            const gough_status status = linear_check(&one, t, NULL, A, wrong, error);
            if (status != GOUGH_OK) return status;
            rates_of(A, &size[k], &growth[k]);
        }
    }
    if (check_side(loop, period, error) != GOUGH_OK) return GOUGH_ERROR_NUMERICAL;
    parts = fmax(1, ceil(T * fmax(growth[LOOSE] / part_growth, size[STIFF] / part_phase)));
    steps = ceil(T * fmax(size[STIFF] / step_phase, size[DAMPED] / step_decay) / parts);
    if (!(parts <= most_parts && parts * steps <= most_steps)) {
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "at a stiffness of %.9g" IN_STIFFNESS
                          " the fastest mode turns or decays by %.3g rad in a period, "
                          "which is too much; choose a smaller range of stiffness or damping",
                          top, T * fmax(size[STIFF], size[DAMPED]));
    }
    if (steps * parts < LEAST_STEPS) steps = ceil(LEAST_STEPS / parts);
    *d = (division){(size_t)parts, (size_t)steps, T * size[STIFF]};
    return GOUGH_OK;
}

/* ---- steps ---- */

/* A over the stages of steps: what is affine in G found from two values of it, (floquet-20) */
typedef struct {
    const linear_loop *loop;
    gough_control without, with; /* G = 0 and D; G = 1 and D = 0 … */
    gough_control bare;          /* … compared with both 0 */
    int damped;
    double start, period;
    size_t count; /* steps */
} stages;

static void begin_stages(stages *s, const linear_loop *loop, const gough_period *period,
                         size_t count) {
    s->loop = loop;
    s->without = control_of(loop, 0, 1);
    s->with = control_of(loop, 1, 0);
    s->bare = control_of(loop, 0, 0);
    s->damped = linear_is_damped(loop);
    s->start = period->start, s->period = period->period;
    s->count = count;
}

static gough_status matrices(const stages *s, const gough_control *control, const double *t,
                             size_t count, linear_matrix *A, gough_error *error) {
    const linear_loop loop = {
        s->loop->machine, s->loop->motion, control, control != &s->without, 0, false};
    const char *wrong = linear_complex.along(&loop, t, count, A);

    return linear_check(&loop, t[0], NULL, A[0], wrong, error);
}

/* stages of step k from `first` on: 1 where the first is the last of the step before */
static gough_status find_stages(const stages *s, size_t k, int first, loop_step *step,
                                gough_error *error) {
    const size_t count = (size_t)(STAGES - first);
    double t[STAGES];
    linear_matrix bare[STAGES], with[STAGES];
    gough_status status;

    for (int i = 0; i < STAGES; i++)
        t[i] = s->start + s->period * (((double)k + dop853_c[i]) / (double)s->count);
    if (first) {
        memcpy(step->base[0], step->base[STAGES - 1], sizeof step->base[0]);
        memcpy(step->gain[0], step->gain[STAGES - 1], sizeof step->gain[0]);
    }
    status = matrices(s, &s->bare, t + first, count, bare + first, error);
    if (status == GOUGH_OK) status = matrices(s, &s->with, t + first, count, with + first, error);
    if (status == GOUGH_OK && s->damped)
        status = matrices(s, &s->without, t + first, count, step->base + first, error);
    if (status != GOUGH_OK) return status;

    if (!s->damped) memcpy(step->base + first, bare + first, count * sizeof bare[0]);
    for (int m = first; m < STAGES; m++) {
        for (int i = 0; i < 6; i++) {
            for (int j = 0; j < 6; j++) step->gain[m][i][j] = with[m][6 + i][j] - bare[m][6 + i][j];
        }
    }
    return GOUGH_OK;
}

/* ---- all parts ---- */

size_t transition_scratch(const struct analyse_width *width) {
    return (sizeof(loop_step) + 63) / 64 * 64 + NODES / (size_t)width->lanes * width->group_size;
}

static void begin_nodes(transitions *t, double top, double node[NODES]) {
    t->top = top;
    for (int i = 0; i < NODES; i++) {
        for (int k = 0; k < NODES; k++) t->cosine[k][i] = cos(k * (i + 0.5) * pi / NODES);
        node[i] = top * (0.5 + 0.5 * t->cosine[1][i]);
    }
}

gough_status transition_find(const struct analyse_width *width, const linear_loop *loop,
                             const gough_period *period, double top, const division *d,
                             transitions *t, void *scratch, gough_error *error) {
    const size_t total = d->parts * d->steps;
    const double h = period->period / (double)total;
    loop_step *step = scratch;
    char *groups = (char *)scratch + (sizeof *step + 63) / 64 * 64;
    double node[NODES];
    stages s;

    begin_nodes(t, top, node);
    begin_stages(&s, loop, period, total);
    t->parts = d->parts;
    for (size_t p = 0; p < d->parts; p++) {
        for (int i = 0; i < NODES; i += width->lanes)
            width->begin(groups + (size_t)(i / width->lanes) * width->group_size, node + i);
        for (size_t k = 0; k < d->steps; k++) {
            const size_t step_number = p * d->steps + k;
            const gough_status status = find_stages(&s, step_number, step_number > 0, step, error);
            if (status != GOUGH_OK) return status;
            for (int i = 0; i < NODES; i += width->lanes)
                width->advance(groups + (size_t)(i / width->lanes) * width->group_size, step, h);
        }
        for (int i = 0; i < NODES; i += width->lanes)
            width->store(groups + (size_t)(i / width->lanes) * width->group_size, t->phi[p] + i);
    }
    return GOUGH_OK;
}
