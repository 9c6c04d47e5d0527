/* What becomes of the sampled heave of the paper near its resonance with the program, where the library finds no periodic motion
 * near the program: runs of one equation, written here for itself, in which nothing but heave moves. (On six axes it falls
 * in other modes at these stiffnesses before heave has settled.) Where the library finds a motion it is the one that these runs
 * settle into. */
#include "gough/floquet.h"
#include "support/machines.h"
#include "support/suite.h"

enum { SAMPLES = 64, STEPS = 12, PERIODS = 1200, LAST = 20 };

static const double radius = 0.7, damping = 0.02, amplitude = 0.2;

typedef struct {
    double z, v;
} height;

/* z̈ = 6 u h/l − 1, with h = 1 + z and six commands u alike */
static height rates(height y, double u) {
    const double h = 1 + y.z;

    return (height){y.v, 6 * u * h / hypot(h, radius) - 1};
}

static height along(height y, double step, height rate) {
    return (height){y.z + step * rate.z, y.v + step * rate.v};
}

static height wanted(double t) { return (height){amplitude * sin(t), amplitude * cos(t)}; }

static double fed(double t) {
    const double h = 1 + amplitude * sin(t);

    return (1 - amplitude * sin(t)) * hypot(h, radius) / (6 * h);
}

/* one sample at t: the command is held for a period of the controller, over which steps of order 4 go */
static height sample(height y, double t, double stiffness, double preview) {
    const height p = wanted(t);
    const double l = hypot(1 + y.z, radius), lp = hypot(1 + p.z, radius);
    const double u = fed(t + preview) + stiffness * (lp - l) +
                     damping * (p.v * (1 + p.z) / lp - y.v * (1 + y.z) / l);
    const double h = 2 * pi / SAMPLES / STEPS;

    for (int i = 0; i < STEPS; i++) {
        const height a = rates(y, u), b = rates(along(y, h / 2, a), u),
                     c = rates(along(y, h / 2, b), u), d = rates(along(y, h, c), u);
        y.z += h / 6 * (a.z + 2 * b.z + 2 * c.z + d.z);
        y.v += h / 6 * (a.v + 2 * b.v + 2 * c.v + d.v);
    }
    return y;
}

/* A run from the program. Returns the periods after which the platform has left, its top below the base, and PERIODS if it stays.
 * off: the largest distance from the program in the last periods; moved: how far heights at the beginning of these differ; y: the
 * state there. */
static int follow(double stiffness, double preview, height *y, double *off, double *moved) {
    double first = 0;

    *y = wanted(0);
    *off = *moved = 0;
    for (int k = 0; k < PERIODS; k++) {
        if (k == PERIODS - LAST) first = y->z;
        for (int s = 0; s < SAMPLES; s++) {
            const double t = 2 * pi * s / SAMPLES;
            if (k >= PERIODS - LAST) *off = fmax(*off, fabs(y->z - wanted(t).z));
            *y = sample(*y, t, stiffness, preview);
            if (!(y->z > -1)) return k;
        }
        if (k >= PERIODS - LAST) *moved = fmax(*moved, fabs(y->z - first));
    }
    return PERIODS;
}

static gough_status find(double stiffness, double preview, gough_sampled_floquet *f) {
    gough_model *model = calloc(1, sizeof *model);
    gough_error error = {0};

    ck_assert(model != NULL);
    paper_machine(&model->machine);
    model->control.feedforward = true;
    set_gains(model, stiffness, damping);
    model->control.sampling = (gough_sampling){.period = 2 * pi / SAMPLES, .preview = preview};
    set_formula(&model->motion.formula[GOUGH_HEAVE], "0.2*sin(t)");
    const gough_status status = gough_floquet_sampled(model, NULL, f, &error);
    if (status != GOUGH_OK)
        ck_assert_msg(strstr(error.message, "was found near the program") != NULL, "%s",
                      error.message);
    free(model);
    return status;
}

static const double half = 3.14159265358979323846 / SAMPLES;

START_TEST(runs_settle_into_the_motion_that_is_found) {
    const struct {
        double stiffness, preview;
    } cases[] = {{0.25, 0}, {0.31, 0}, {0.32, 0}, {0.31, half}, {0.38, half}, {0.395, half}};

    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        const double G = cases[k].stiffness;
        gough_sampled_floquet f;
        double off, moved;
        height y;
        ck_assert_int_eq(follow(G, cases[k].preview, &y, &off, &moved), PERIODS);
        ck_assert_msg(moved <= 1e-6, "G = %g: %g", G, moved);
        ck_assert_int_eq(find(G, cases[k].preview, &f), GOUGH_OK);
        ck_assert_msg(fabs(f.state.position[2] - 1 - y.z) <= 1e-6 &&
                          fabs(f.state.velocity[2] - y.v) <= 1e-6,
                      "G = %g: %.9g, not %.9g", G, f.state.position[2] - 1, y.z);
    }
}
END_TEST

/* the numbers of the guide to the loop */
START_TEST(where_no_motion_is_found_runs_go_far_from_the_program) {
    gough_sampled_floquet f;
    double off, moved;
    height y;

    for (double G = 0.335; G < 0.4075; G += 0.005) {
        const int periods = follow(G, 0, &y, &off, &moved);
        if (G < 0.3575)
            ck_assert_msg(periods == PERIODS && moved <= 1e-9 && off > 0.31 && off < 0.5,
                          "G = %g: %d periods, off by %g", G, periods, off);
        else
            ck_assert_msg(periods >= 5 && periods <= 9, "G = %g: %d periods", G, periods);
    }
    for (double G = 0.335; G < 0.3725; G += 0.005) {
        const int periods = follow(G, half, &y, &off, &moved);
        if (G < 0.3625)
            ck_assert_msg(periods == PERIODS && moved <= 1e-9 && off > 0.13 && off < 0.56,
                          "G = %g: %d periods, off by %g", G, periods, off);
        else
            ck_assert_msg(periods >= 28 && periods <= 36, "G = %g: %d periods", G, periods);
    }
    ck_assert_int_eq(find(0.345, 0, &f), GOUGH_ERROR_NUMERICAL);
}
END_TEST

int main(void) {
    return SUITE_RUN("heave_alone", 60, runs_settle_into_the_motion_that_is_found,
                     where_no_motion_is_found_runs_go_far_from_the_program);
}
