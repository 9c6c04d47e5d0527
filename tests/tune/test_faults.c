/* What the analyses of a loop answer when a factorisation or an eigenproblem of LAPACK fails, or ends with numbers that are not
 * finite, and when an analysis that another one needs fails: an error with a sentence, or the answer of before. Each call fails
 * once, of calls in thousands the first ones and then ever fewer.
 * Label: thorough: some hundred maps and searches.
 * Sanitized: campaign: the same.
 * Faults: LAPACKE_dgees_work LAPACKE_dgeev_work LAPACKE_dgesv_work LAPACKE_dgesvd_work LAPACKE_dgetrf_work LAPACKE_dgetrs_work
 * Faults: LAPACKE_dsygv_work LAPACKE_dtrsyl_work LAPACKE_zgesv_work LAPACKE_zheev_work LAPACKE_zhegv_work
 * Faults: equilibrium_find equilibrium_ask spectrum_of_factors symmetric_problem
 * Faults: gough_stability_at_rest gough_stiffness_at_rest gough_sampled_at_rest gough_floquet_multipliers gough_floquet_sampled
 * Faults: gough_map_find gough_map_size gough_motion_period gough_external_wrench gough_leg_kinematics */
#define _GNU_SOURCE
#include <complex.h>
#include <stdio.h>
#include <stdlib.h>

#include <lapacke.h>

#include "floquet/spectrum.h"
#include "gough/floquet.h"
#include "gough/map.h"
#include "gough/tune.h"
#include "linear/equilibrium.h"
#include "linear/symmetric.h"
#include "support/faults.h"
#include "support/machines.h"
#include "support/suite.h"

/* ---- the faults -------------------------------------------------------------------------------------------------- */

/* LAPACK says that it failed ("name"), or says nothing and its results are not numbers ("NaN name") */
#define LAPACK_FAULT(name, parameters, result, ...)                                                \
    lapack_int __real_##name parameters;                                                           \
    lapack_int __wrap_##name parameters;                                                           \
    lapack_int __wrap_##name parameters {                                                          \
        if (fault_comes(#name)) return 1;                                                          \
        const bool spoil = fault_comes("NaN " #name);                                              \
        const lapack_int info = __real_##name(__VA_ARGS__);                                        \
        if (spoil) (result)[0] = NAN;                                                              \
        return info;                                                                               \
    }                                                                                              \
    _Static_assert(1, "")

LAPACK_FAULT(LAPACKE_dgees_work,
             (int layout, char vectors, char sort, LAPACK_D_SELECT2 select, lapack_int n, double *a,
              lapack_int lda, lapack_int *count, double *re, double *im, double *vs,
              lapack_int ldvs, double *work, lapack_int size, lapack_logical *side),
             vs, layout, vectors, sort, select, n, a, lda, count, re, im, vs, ldvs, work, size,
             side);
LAPACK_FAULT(LAPACKE_dgeev_work,
             (int layout, char left, char right, lapack_int n, double *a, lapack_int lda,
              double *re, double *im, double *vl, lapack_int ldvl, double *vr, lapack_int ldvr,
              double *work, lapack_int size),
             re, layout, left, right, n, a, lda, re, im, vl, ldvl, vr, ldvr, work, size);
LAPACK_FAULT(LAPACKE_dgesv_work,
             (int layout, lapack_int n, lapack_int columns, double *a, lapack_int lda,
              lapack_int *pivot, double *b, lapack_int ldb),
             b, layout, n, columns, a, lda, pivot, b, ldb);
LAPACK_FAULT(LAPACKE_dgesvd_work,
             (int layout, char left, char right, lapack_int m, lapack_int n, double *a,
              lapack_int lda, double *s, double *u, lapack_int ldu, double *vt, lapack_int ldvt,
              double *work, lapack_int size),
             s, layout, left, right, m, n, a, lda, s, u, ldu, vt, ldvt, work, size);
LAPACK_FAULT(LAPACKE_dgetrf_work,
             (int layout, lapack_int m, lapack_int n, double *a, lapack_int lda, lapack_int *pivot),
             a, layout, m, n, a, lda, pivot);
LAPACK_FAULT(LAPACKE_dgetrs_work,
             (int layout, char turned, lapack_int n, lapack_int columns, const double *a,
              lapack_int lda, const lapack_int *pivot, double *b, lapack_int ldb),
             b, layout, turned, n, columns, a, lda, pivot, b, ldb);
LAPACK_FAULT(LAPACKE_dsygv_work,
             (int layout, lapack_int kind, char vectors, char half, lapack_int n, double *a,
              lapack_int lda, double *b, lapack_int ldb, double *w, double *work, lapack_int size),
             w, layout, kind, vectors, half, n, a, lda, b, ldb, w, work, size);
LAPACK_FAULT(LAPACKE_dtrsyl_work,
             (int layout, char turn_a, char turn_b, lapack_int sign, lapack_int m, lapack_int n,
              const double *a, lapack_int lda, const double *b, lapack_int ldb, double *c,
              lapack_int ldc, double *scale),
             scale, layout, turn_a, turn_b, sign, m, n, a, lda, b, ldb, c, ldc, scale);
LAPACK_FAULT(LAPACKE_zgesv_work,
             (int layout, lapack_int n, lapack_int columns, double _Complex *a, lapack_int lda,
              lapack_int *pivot, double _Complex *b, lapack_int ldb),
             b, layout, n, columns, a, lda, pivot, b, ldb);
LAPACK_FAULT(LAPACKE_zheev_work,
             (int layout, char vectors, char half, lapack_int n, double _Complex *a, lapack_int lda,
              double *w, double _Complex *work, lapack_int size, double *real_work),
             w, layout, vectors, half, n, a, lda, w, work, size, real_work);
LAPACK_FAULT(LAPACKE_zhegv_work,
             (int layout, lapack_int kind, char vectors, char half, lapack_int n,
              double _Complex *a, lapack_int lda, double _Complex *b, lapack_int ldb, double *w,
              double _Complex *work, lapack_int size, double *real_work),
             w, layout, kind, vectors, half, n, a, lda, b, ldb, w, work, size, real_work);

static const char told[] = "it was told to fail";
#define REFUSED gough_fail(error, GOUGH_ERROR_NUMERICAL, "%s", told)

FAULTY(gough_status, equilibrium_find,
       (const gough_model *model, const double *component, gough_motion *rest, gough_error *error),
       REFUSED, model, component, rest, error);
FAULTY(gough_status, equilibrium_ask,
       (const gough_model *model, const double *component, gough_motion *rest, asked_pose *asked,
        gough_error *error),
       REFUSED, model, component, rest, asked, error);
FAULTY(gough_status, spectrum_of_factors,
       (const double *factor, size_t stride, int n, size_t count, int sweeps, spectrum *s,
        gough_error *error),
       REFUSED, factor, stride, n, count, sweeps, s, error);
FAULTY(double, symmetric_problem,
       (const double *K, const double *B, double kappa[FREEDOMS],
        double complex shape[FREEDOMS][6]),
       -1, K, B, kappa, shape);
FAULTY_PUBLIC(gough_status, gough_stability_at_rest,
              (const gough_model *model, const double component[GOUGH_COMPONENTS], gough_rest *rest,
               gough_error *error),
              REFUSED, model, component, rest, error);
FAULTY_PUBLIC(gough_status, gough_stiffness_at_rest,
              (const gough_model *model, const double component[GOUGH_COMPONENTS],
               gough_stiffness *stiffness, gough_error *error),
              REFUSED, model, component, stiffness, error);
FAULTY_PUBLIC(gough_status, gough_sampled_at_rest,
              (const gough_model *model, const double component[GOUGH_COMPONENTS],
               gough_sampled_rest *rest, gough_error *error),
              REFUSED, model, component, rest, error);
FAULTY_PUBLIC(gough_status, gough_floquet_multipliers,
              (const gough_model *model, const gough_period *period, double tolerance,
               gough_floquet *floquet, gough_error *error),
              REFUSED, model, period, tolerance, floquet, error);
FAULTY_PUBLIC(gough_status, gough_floquet_sampled,
              (const gough_model *model, const gough_period *period, gough_sampled_floquet *floquet,
               gough_error *error),
              REFUSED, model, period, floquet, error);
FAULTY_PUBLIC(gough_status, gough_map_find,
              (const gough_model *model, const gough_map_options *options, gough_map *map,
               void *memory, gough_error *error),
              REFUSED, model, options, map, memory, error);
FAULTY_PUBLIC(gough_status, gough_map_size,
              (const gough_model *model, const gough_map_options *options, size_t *bytes,
               gough_error *error),
              REFUSED, model, options, bytes, error);
FAULTY_PUBLIC(gough_status, gough_motion_period,
              (const gough_motion *motion, gough_period *period, gough_error *error), REFUSED,
              motion, period, error);
FAULTY_PUBLIC(gough_status, gough_external_wrench,
              (const gough_machine *machine, const gough_state *state, double t,
               gough_wrench *wrench),
              GOUGH_ERROR_INPUT, machine, state, t, wrench);
FAULTY_PUBLIC(gough_status, gough_leg_kinematics,
              (const gough_machine *machine, const gough_state *state, const gough_acceleration *a,
               double length[GOUGH_LEGS], double rate[GOUGH_LEGS], double second[GOUGH_LEGS]),
              GOUGH_ERROR_NUMERICAL, machine, state, a, length, rate, second);

static const char *const lapack[] = {
    "LAPACKE_dgees_work",  "LAPACKE_dgeev_work",  "LAPACKE_dgesv_work", "LAPACKE_dgesvd_work",
    "LAPACKE_dgetrf_work", "LAPACKE_dgetrs_work", "LAPACKE_dsygv_work", "LAPACKE_dtrsyl_work",
    "LAPACKE_zgesv_work",  "LAPACKE_zheev_work",  "LAPACKE_zhegv_work"};
static const char *const needed[] = {"equilibrium_find",        "equilibrium_ask",
                                     "spectrum_of_factors",     "symmetric_problem",
                                     "gough_stability_at_rest", "gough_stiffness_at_rest",
                                     "gough_sampled_at_rest",   "gough_floquet_multipliers",
                                     "gough_floquet_sampled",   "gough_map_find",
                                     "gough_map_size",          "gough_motion_period",
                                     "gough_external_wrench",   "gough_leg_kinematics"};

/* ---- what is asked ------------------------------------------------------------------------------------------------ */

/* What an analysis says, in a few numbers. */
typedef struct facts {
    double number[24];
    size_t count;
} facts;

static void note(facts *f, double number) {
    ck_assert_uint_lt(f->count, 24);
    f->number[f->count++] = number;
}

typedef gough_status analysis(const gough_model *model, facts *f, gough_error *error);

static gough_status at_rest(const gough_model *model, facts *f, gough_error *error) {
    const double turned[GOUGH_COMPONENTS] = {0.05, -0.03, 0.02, 0.04, 0.02, -0.05};
    gough_rest rest;
    const gough_status status =
        gough_stability_at_rest(model, model->control.feedforward ? turned : NULL, &rest, error);
    if (status != GOUGH_OK) return status;
    note(f, rest.stable);
    note(f, rest.growing);
    note(f, rest.growth);
    note(f, rest.threshold[0].stiffness);
    note(f, rest.eigenvalue[0].value[1]);
    return GOUGH_OK;
}

static gough_status stiffness(const gough_model *model, facts *f, gough_error *error) {
    gough_stiffness s;
    const gough_status status = gough_stiffness_at_rest(model, NULL, &s, error);
    if (status != GOUGH_OK) return status;
    note(f, s.firm);
    note(f, s.total[2][2]);
    note(f, s.firm ? s.compliance[2][2] : 0);
    return GOUGH_OK;
}

static gough_status matrix(const gough_model *model, facts *f, gough_error *error) {
    enum { MOST = 128 };
    const size_t n = gough_deviation_size(model);
    double a[MOST * MOST];
    ck_assert_uint_le(n, MOST);
    const gough_status status = gough_matrix_at_rest(model, NULL, n, a, error);
    for (size_t i = 0; i < 12 && status == GOUGH_OK; i++) note(f, a[i * n + i]);
    return status;
}

static gough_status sampled(const gough_model *model, facts *f, gough_error *error) {
    gough_sampled_rest rest;
    gough_sampled_margins margins;
    gough_status status = gough_sampled_at_rest(model, NULL, &rest, error);
    if (status != GOUGH_OK) return status;
    note(f, rest.stable);
    note(f, rest.radius);
    note(f, rest.mass);
    status = gough_sampled_margins_at_rest(model, NULL, &margins, error);
    if (status != GOUGH_OK) return status;
    note(f, margins.open);
    note(f, margins.lower.stiffness);
    note(f, margins.upper.stiffness);
    note(f, margins.longest_period);
    note(f, margins.longest_delay);
    note(f, margins.best_stiffness);
    note(f, margins.period_limit);
    return GOUGH_OK;
}

static gough_status gains(const gough_model *model, facts *f, gough_error *error) {
    gough_gains g;
    gough_status status = gough_gains_by_poles(model, NULL, 0.7, 0.6, &g, error);
    if (status != GOUGH_OK) return status;
    note(f, g.stiffness[0][0]);
    note(f, g.pole[0].value[0]);
    status = gough_gains_by_lqr(model, NULL, 10, 1, &g, error);
    if (status != GOUGH_OK) return status;
    note(f, g.stiffness[0][0]);
    note(f, g.damping[0][1]);
    note(f, g.pole[0].value[0]);
    return GOUGH_OK;
}

static gough_status along(const gough_model *model, facts *f, gough_error *error) {
    if (model->control.sampling.period > 0) {
        gough_sampled_floquet floquet;
        const gough_status status = gough_floquet_sampled(model, NULL, &floquet, error);
        if (status != GOUGH_OK) return status;
        note(f, floquet.stable);
        note(f, hypot(floquet.multiplier[0].value[0], floquet.multiplier[0].value[1]));
        return GOUGH_OK;
    }
    gough_floquet floquet;
    const gough_status status = gough_floquet_multipliers(model, NULL, 1e-6, &floquet, error);
    if (status != GOUGH_OK) return status;
    note(f, floquet.stable);
    note(f, hypot(floquet.multiplier[0].value[0], floquet.multiplier[0].value[1]));
    return GOUGH_OK;
}

/* A map of some stiffnesses, and of two dampings; rows without values count as failed. */
static gough_status map_of(const gough_model *model, facts *f, gough_error *error) {
    enum { POINTS = 3, ROWS = 2, INTERVALS = 4 };
    gough_map_point point[ROWS * POINTS];
    gough_map_row row[ROWS];
    gough_interval interval[ROWS * INTERVALS];
    gough_map map = {point, row, interval};
    gough_map_options o = gough_map_options_default();
    size_t bytes;
    o.stiffness = model->control.feedforward ? (gough_map_range){0.2, 3, POINTS, false}
                                             : (gough_map_range){50, 60, POINTS, false};
    o.accuracy = 1e-4;
    o.resolution = 1e-3;
    o.axis = GOUGH_MAP_DAMPING;
    o.second = (gough_map_range){0, 0.3, ROWS, false};
    o.intervals = INTERVALS;
    o.threads = 1;
    o.lanes = 1;
    gough_status status = gough_map_size(model, &o, &bytes, error);
    if (status != GOUGH_OK) return status;
    void *memory = aligned_alloc(64, (bytes + 63) / 64 * 64);
    ck_assert_ptr_nonnull(memory);
    status = gough_map_find(model, &o, &map, memory, error);
    free(memory);
    if (status != GOUGH_OK) return status;
    for (size_t r = 0; r < ROWS; r++) {
        if (row[r].error.status != GOUGH_OK) {
            *error = row[r].error;
            return row[r].error.status;
        }
        note(f, (double)row[r].intervals);
        if (row[r].intervals > 0) note(f, interval[r * INTERVALS].to);
    }
    return GOUGH_OK;
}

static gough_status tune(const gough_model *model, facts *f, gough_error *error) {
    gough_simulation run = gough_simulation_default();
    gough_tuning_options o = gough_tuning_options_default();
    gough_tuning tuning;
    size_t bytes;
    o.deviation = 2e-3;
    o.threads = 1;
    run.duration = 6;
    run.output_step = 0.1;
    gough_status status = gough_tune_size(model, &o, &bytes, error);
    if (status != GOUGH_OK) return status;
    void *memory = aligned_alloc(64, (bytes + 63) / 64 * 64);
    gough_tuning_point *point = calloc(GOUGH_TUNING_POINTS, sizeof *point);
    ck_assert(memory != NULL && point != NULL);
    status = gough_tune(model, &run, true, &o, point, &tuning, memory, error);
    free(memory);
    free(point);
    if (status != GOUGH_OK) return status;
    note(f, tuning.found);
    if (tuning.found) note(f, tuning.stiffness);
    return GOUGH_OK;
}

/* ---- the machine -------------------------------------------------------------------------------------------------- */

enum { HEAVING = 1, UNFED = 2, SAMPLED = 4, LAGGING = 8, ADDING = 16, BARE = 32, HEAVY = 64 };

static gough_model *model_with(unsigned how) {
    gough_model *m = calloc(1, sizeof *m);
    dice d = {7};
    ck_assert_ptr_nonnull(m);
    paper_machine(&m->machine);
    if (how & HEAVY) give_legs(&m->machine, LEGS_HEAVY, &d);
    m->control.feedforward = !(how & UNFED);
    set_gains(m, how & UNFED ? 60 : 1.5, how & BARE ? 0 : 0.4);
    if (how & HEAVING) set_formula(&m->motion.formula[GOUGH_HEAVE], "0.1*sin(t)");
    if (how & SAMPLED) m->control.sampling = (gough_sampling){.period = pi / 16, .delay = 0.02};
    for (int v = 0; v < GOUGH_LEGS; v++) {
        set_formula(&m->disturbance.leg_force[v],
                    v == 0 ? "0.002*(1 - exp(-t))" : "0.001*(1 - exp(-t))");
        if (how & ADDING) m->control.integral[v] = 0.02;
        if (how & LAGGING) m->machine.platform.actuators.time_constant[v] = 0.05;
    }
    if (how & LAGGING) m->machine.platform.actuators.kind = GOUGH_ACTUATOR_LAG;
    return m;
}

static const struct {
    const char *name;
    analysis *ask;
    unsigned how;
    long factor; /* between one call that fails and the next */
} asked[] = {
    {"rest", at_rest, 0, 2},
    {"rest of springs", at_rest, UNFED, 2},
    {"rest without damping", at_rest, BARE, 2},
    {"rest with states", at_rest, LAGGING | ADDING, 2},
    {"rest of heavy legs", at_rest, HEAVY, 2},
    {"stiffness", stiffness, 0, 2},
    {"matrix", matrix, LAGGING, 2},
    {"matrix of samples", matrix, SAMPLED, 2},
    {"samples", sampled, SAMPLED, 2},
    {"gains", gains, 0, 2},
    {"multipliers", along, HEAVING, 2},
    {"multipliers without damping", along, HEAVING | BARE, 2},
    {"multipliers of springs", along, HEAVING | UNFED, 2},
    {"multipliers with states", along, HEAVING | LAGGING, 2},
    {"multipliers of samples", along, HEAVING | SAMPLED, 2},
    {"map", map_of, HEAVING, 8},
    {"map at rest", map_of, 0, 8},
    {"map of samples", map_of, SAMPLED, 8},
    {"map of heavy legs", map_of, HEAVING | HEAVY, 8},
    {"tune", tune, HEAVING, 64},
    {"tune with samples", tune, SAMPLED, 64},
    {"tune with states", tune, LAGGING, 64},
};
enum { ASKED = sizeof asked / sizeof asked[0] };

static bool is_near(double a, double b) {
    return (isnan(a) && isnan(b)) || a == b || fabs(a - b) <= 1e-4 * fmax(fabs(a), fabs(b));
}

/* One fault: an error with a sentence, or the answer of before; a map has no values at the stiffnesses where its problem was not
 * solved. */
static bool act(size_t i, const gough_model *model, const facts *before, const char *fails,
                long n) {
    facts f = {.count = 0};
    gough_error error = {.message = ""};
    fault_arm(fails, n, 0);
    const gough_status status = asked[i].ask(model, &f, &error);
    if (!fault_disarm()) return false;
    ck_assert_msg(status == GOUGH_OK || error.message[0] != '\0', "%s: %s %ld: no sentence",
                  asked[i].name, fails, n);
    for (size_t k = 0; k < before->count && status == GOUGH_OK && asked[i].ask != map_of; k++)
        ck_assert_msg(k < f.count && is_near(f.number[k], before->number[k]),
                      "%s: %s %ld: number %zu is %g, not %g", asked[i].name, fails, n, k,
                      f.number[k], before->number[k]);
    return true;
}

/* The first calls, and then ever fewer. */
static void fail_each(size_t i, const gough_model *model, const facts *before, const char *fails,
                      long calls) {
    for (long n = 1; n <= calls && act(i, model, before, fails, n); n = 1 + n * asked[i].factor)
        continue;
}

static void fail_all(size_t i) {
    gough_model *model = model_with(asked[i].how);
    facts before = {.count = 0};
    gough_error error = {.message = ""};
    char nan[80];
    long calls[sizeof lapack / sizeof lapack[0] + sizeof needed / sizeof needed[0]];
    enum { LAPACKS = sizeof lapack / sizeof lapack[0], NEEDED = sizeof needed / sizeof needed[0] };
    fault_forget();
    ck_assert_msg(asked[i].ask(model, &before, &error) == GOUGH_OK, "%s: %s", asked[i].name,
                  error.message);
    for (int k = 0; k < LAPACKS; k++) calls[k] = fault_calls(lapack[k]);
    for (int k = 0; k < NEEDED; k++) calls[LAPACKS + k] = fault_calls(needed[k]);
    for (int k = 0; k < LAPACKS; k++) {
        snprintf(nan, sizeof nan, "NaN %s", lapack[k]);
        fail_each(i, model, &before, lapack[k], calls[k]);
        fail_each(i, model, &before, nan, calls[k]);
    }
    for (int k = 0; k < NEEDED; k++) fail_each(i, model, &before, needed[k], calls[LAPACKS + k]);
    free(model);
}

static void fail_all_of(analysis *ask) {
    for (size_t i = 0; i < ASKED; i++)
        if (asked[i].ask == ask) fail_all(i);
}

START_TEST(rest_says_what_failed) {
    fail_all_of(at_rest);
    fail_all_of(stiffness);
    fail_all_of(matrix);
    fail_all_of(sampled);
    fail_all_of(gains);
}
END_TEST

START_TEST(multipliers_say_what_failed) { fail_all_of(along); }
END_TEST

START_TEST(maps_say_what_failed) { fail_all_of(map_of); }
END_TEST

START_TEST(tuning_says_what_failed) { fail_all_of(tune); }
END_TEST

int main(void) {
    return SUITE_RUN("tune/faults", 600, rest_says_what_failed, multipliers_say_what_failed,
                     maps_say_what_failed, tuning_says_what_failed);
}
