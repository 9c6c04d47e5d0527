/* Growth of deviations in runs of the nonlinear equations, over many periods, against the largest multiplier of the sampled loop:
 * measured rates, without delay and with one sample of it, in heave and in all six axes, stable and unstable. The delay is the
 * test's own: a law that commands now what the last sample asked for, so that a run can begin anywhere on its periodic motion.
 * Not sanitized: the same functions run under sanitizers in tests/floquet/test_sampled.c. */
#include <stdio.h>

#include "gough/floquet.h"
#include "support/machines.h"
#include "support/suite.h"

enum { STATE = 18, MOST_STEPS = 12 };

static const double two_pi = 6.283185307179586;

/* G, D, the command that waits, and how many samples a period has: one more falls on its end */
typedef struct {
    double stiffness, damping, waiting[6];
    bool late;
    uint64_t samples;
} law;

static void command(void *context, const gough_sample *s, double out[GOUGH_LEGS]) {
    law *l = context;

    if (s->number >= l->samples) return;
    for (int v = 0; v < GOUGH_LEGS; v++) {
        const double now = s->program_force[v] +
                           l->stiffness * (s->program_length[v] - s->length[v]) +
                           l->damping * (s->program_rate[v] - s->rate[v]);
        out[v] = l->late ? l->waiting[v] : now;
        l->waiting[v] = now;
    }
}

static int keep(void *context, const gough_row *row) {
    memcpy(context, row->value, sizeof row->value);
    return 0;
}

/* A run over a period of the program, 2π. z, before and after: pose from home, velocities, angular velocities, waiting commands. */
static void period(const gough_model *study, const law *gains, double z[STATE]) {
    gough_model model = *study;
    gough_simulation s = gough_simulation_default();
    double last[GOUGH_COLUMNS];
    gough_error error = {0};
    law l = *gains;
    gough_end end;

    l.samples = (uint64_t)lround(two_pi / model.control.sampling.period);

    for (int c = 0; c < 6; c++) {
        model.initial.given[c] = true;
        model.initial.component[c] = z[c];
    }
    model.initial.velocity_given = model.initial.angular_velocity_given = true;
    for (int i = 0; i < 3; i++) {
        model.initial.velocity[i] = z[6 + i];
        model.initial.angular_velocity[i] = z[9 + i];
    }
    memcpy(l.waiting, z + 12, sizeof l.waiting);
    s.duration = s.output_step = two_pi;
    s.tolerance = 1e-13;
    s.law = command;
    s.law_context = &l;
    ck_assert_msg(gough_simulate(&model, &s, keep, last, &end, &error) == GOUGH_OK, "%s",
                  error.message);
    z[0] = last[GOUGH_X];
    z[1] = last[GOUGH_Y];
    z[2] = last[GOUGH_Z] - model.machine.platform.height;
    z[3] = last[GOUGH_ROLL_ANGLE];
    z[4] = last[GOUGH_PITCH_ANGLE];
    z[5] = last[GOUGH_YAW_ANGLE];
    for (int i = 0; i < 3; i++) {
        z[6 + i] = last[GOUGH_VX + i];
        z[9 + i] = last[GOUGH_WX + i];
    }
    memcpy(z + 12, l.waiting, sizeof l.waiting);
}

/* what a deviation becomes, by central differences */
static void carry(const gough_model *model, const law *gains, const double at[STATE],
                  const double from[STATE], double to[STATE]) {
    const double step = 1e-4;
    double more[STATE], less[STATE];

    for (int i = 0; i < STATE; i++) {
        more[i] = at[i] + step * from[i];
        less[i] = at[i] - step * from[i];
    }
    period(model, gains, more);
    period(model, gains, less);
    for (int i = 0; i < STATE; i++) to[i] = (more[i] - less[i]) / (2 * step);
}

/* The heave that repeats itself, in three numbers: height, its rate, and the command of all legs alike. By Newton's method with
 * differences, from the program. */
static void find_motion(const gough_model *model, const law *gains, double z[STATE]) {
    double A[3][4], size = 1;

    for (int step = 0; step < MOST_STEPS && size > 1e-11; step++) {
        double end[STATE];
        memcpy(end, z, sizeof end);
        period(model, gains, end);
        for (int c = 0; c < 3; c++) {
            double from[STATE] = {0}, to[STATE];
            const int own[3] = {2, 8, 12};
            for (int i = own[c]; i < (c == 2 ? STATE : own[c] + 1); i++) from[i] = 1;
            carry(model, gains, z, from, to);
            for (int r = 0; r < 3; r++) A[r][c] = (r == c) - to[own[r]];
            A[c][3] = end[own[c]] - z[own[c]];
        }
        for (int c = 0; c < 3; c++) { /* Gauss and Jordan */
            for (int r = 0; r < 3; r++) {
                const double part = A[r][c] / A[c][c];
                for (int k = 0; k < 4 && r != c; k++) A[r][k] -= part * A[c][k];
            }
        }
        size = 0;
        for (int c = 0; c < 3; c++) {
            const double move = A[c][3] / A[c][c];
            size = fmax(size, fabs(move));
            for (int i = c == 2 ? 12 : c == 1 ? 8 : 2; i < (c == 2 ? STATE : c == 1 ? 9 : 3); i++)
                z[i] += move;
        }
    }
    ck_assert_msg(size <= 1e-8, "no motion: %.3g", size);
}

/* The largest |μ| from three successive deviations after many periods: they obey d'' = a d' − b d. */
static double largest(double d[3][STATE]) {
    double m[2][2] = {{0}}, r[2] = {0};

    for (int i = 0; i < STATE; i++) {
        m[0][0] += d[1][i] * d[1][i];
        m[0][1] -= d[1][i] * d[0][i];
        m[1][1] += d[0][i] * d[0][i];
        r[0] += d[1][i] * d[2][i];
        r[1] -= d[0][i] * d[2][i];
    }
    const double det = m[0][0] * m[1][1] - m[0][1] * m[0][1];
    if (!(det > 1e-10 * m[0][0] * m[1][1])) return fabs(r[0] / m[0][0]); /* one real μ alone */
    const double a = (r[0] * m[1][1] - r[1] * m[0][1]) / det,
                 b = (m[0][0] * r[1] - m[0][1] * r[0]) / det, root = a * a / 4 - b;
    return root > 0 ? fabs(a) / 2 + sqrt(root) : sqrt(b);
}

/* of heave alone, or of all modes */
static double multiplier(const gough_model *study, const law *gains, bool heave) {
    gough_model model = *study;
    gough_sampled_floquet f;
    gough_error error = {0};
    double most = 0;

    set_gains(&model, gains->stiffness, gains->damping);
    model.control.sampling.delay = gains->late ? model.control.sampling.period : 0;
    ck_assert_msg(gough_floquet_sampled(&model, NULL, &f, &error) == GOUGH_OK, "%s", error.message);
    for (size_t k = 0; k < f.listed; k++) {
        const gough_multiplier *m = &f.multiplier[k];
        if (!heave || strcmp(m->mode.name, "heave") == 0)
            most = fmax(most, hypot(m->value[0], m->value[1]));
    }
    return most;
}

static void compare(bool six, double samples, const law *gains, int periods, bool grows) {
    gough_model *model = calloc(1, sizeof *model);
    double z[STATE] = {0}, d[3][STATE] = {{0}};

    ck_assert(model != NULL);
    paper_machine(&model->machine);
    set_formula(&model->motion.formula[GOUGH_HEAVE], six ? "0.05*sin(t)" : "0.2*sin(t)");
    model->control.feedforward = true;
    model->control.sampling.period = two_pi / samples;
    model->control.sampling.preview = gains->late ? 1.5 * two_pi / samples : 0.5 * two_pi / samples;
    z[8] = six ? 0.05 : 0.2;
    for (int v = 0; v < 6; v++) z[12 + v] = 0.2;
    find_motion(model, gains, z);

    for (int i = 0; i < STATE; i++)
        d[2][i] = six                ? 1.0 / (1 + i)
                  : i == 2 || i == 8 ? 1
                                     : 0; /* heave has no part in the others */
    for (int k = 0; k < periods; k++) {
        double size = 0;
        memcpy(d[0], d[1], sizeof d[0]);
        memcpy(d[1], d[2], sizeof d[1]);
        for (int i = 0; i < STATE; i++) size = fmax(size, fabs(d[1][i]));
        for (int i = 0; i < STATE; i++) {
            d[0][i] /= size;
            d[1][i] /= size;
            if (!six && i < 12 && i != 2 && i != 8) d[0][i] = d[1][i] = 0; /* of rounding */
            if (!six && i > 12) d[0][i] = d[0][12], d[1][i] = d[1][12];
        }
        carry(model, gains, z, d[1], d[2]);
    }
    const double found = largest(d), right = multiplier(model, gains, !six);
    ck_assert_msg(fabs(found - right) <= 1e-4 * right, "G %g, %s: %.8g in runs, not %.8g",
                  gains->stiffness, gains->late ? "late" : "at once", found, right);
    ck_assert_int_eq(right > 1, grows);
    free(model);
}

/* inside the tongue at −1, between tongues, beyond what the delay bears */
START_TEST(heave_grows_as_its_multiplier) {
    compare(false, 32, &(law){.stiffness = 0.15, .damping = 0.05}, 12, true);
    compare(false, 32, &(law){.stiffness = 0.25, .damping = 0.05}, 12, false);
    compare(false, 32, &(law){.stiffness = 0.9, .damping = 0.05}, 12, true);
    compare(false, 32, &(law){.stiffness = 0.15, .damping = 0.05, .late = true}, 12, true);
    compare(false, 32, &(law){.stiffness = 0.1, .damping = 0.05, .late = true}, 12, false);
    compare(false, 32, &(law){.stiffness = 0.5, .damping = 0.05, .late = true}, 12, true);
}
END_TEST

START_TEST(six_axes_grow_as_their_multiplier) {
    compare(true, 64, &(law){.stiffness = 1.1, .damping = 0.15}, 40, false);
    compare(true, 64, &(law){.stiffness = 0.8, .damping = 0.2}, 25, true);
    compare(true, 64, &(law){.stiffness = 6, .damping = 0.2}, 30, true);
    compare(true, 64, &(law){.stiffness = 0.8, .damping = 0.2, .late = true}, 25, true);
    compare(true, 64, &(law){.stiffness = 1.3, .damping = 0.3, .late = true}, 40, false);
    compare(true, 64, &(law){.stiffness = 3, .damping = 0.2, .late = true}, 30, true);
}
END_TEST

int main(void) {
    return SUITE_RUN("floquet/sampled growth", 240, heave_grows_as_its_multiplier,
                     six_axes_grow_as_their_multiplier);
}
