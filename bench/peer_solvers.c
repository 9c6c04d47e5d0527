/* Rows of general solvers on this problem: GSL's rk8pd, SUNDIALS' CVODE (Adams) and ARKODE (Fehlberg, order 8), on our
 * right-hand side (with Baumgarte's terms, for no solver projects: without them drift spoils the last digits) and on one
 * written by hand. Each looks for the tolerance that meets the target with the least work. */
#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <math.h>
#include <nvector/nvector_serial.h>
#include <string.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "bench/bench.h"
#include "bench/hand.h"

static const long most_steps = 100000;

enum { STATE_MOST = 24, SOLVERS = 3, SIDES = 2 };

/* a right-hand side: ours of 24 numbers, or the one by hand */
typedef struct {
    int size;
    double begin[STATE_MOST];
    void *ours; /* memory of our right-hand side, or NULL */
    hand hand;
} problem;

typedef struct {
    bench *b;
    problem *problem;
    int solver;
    double y[STATE_MOST];
    void *memory; /* of the solver */
    gsl_odeiv2_system system;
    gsl_odeiv2_driver *driver;
    N_Vector vector;
    SUNNonlinearSolver nonlinear;
    double effort, error;
    int item;
} trial;

typedef struct {
    SUNContext context;
    problem problem[SIDES];
    trial trial[SOLVERS][SIDES][TARGETS];
} own;

static void rates(const problem *s, double t, const double *y, double *rate) {
    if (s->ours) {
        kernel_rates(s->ours, t, y, rate);
    } else {
        hand_rates(&s->hand, t, y, rate);
    }
}

static int rates_gsl(double t, const double y[], double rate[], void *context) {
    rates(context, t, y, rate);
    return GSL_SUCCESS;
}

static int rates_sundials(realtype t, N_Vector y, N_Vector rate, void *context) {
    rates(context, t, NV_DATA_S(y), NV_DATA_S(rate));
    return 0;
}

static void must(int status) {
    if (status != 0) bench_fail("a solver could not be made");
}

static void make(trial *t, SUNContext context) {
    const problem *s = t->problem;

    t->vector = N_VMake_Serial(s->size, t->y, context);
    if (t->vector == NULL) bench_fail("a solver could not be made");
    memcpy(t->y, s->begin, sizeof t->y);
    if (t->solver == 0) {
        t->system = (gsl_odeiv2_system){rates_gsl, NULL, (size_t)s->size, t->problem};
    } else if (t->solver == 1) {
        t->memory = CVodeCreate(CV_ADAMS, context);
        must(t->memory == NULL || CVodeInit(t->memory, rates_sundials, 0, t->vector) != 0);
        t->nonlinear = SUNNonlinSol_FixedPoint(t->vector, 0, context);
        must(CVodeSStolerances(t->memory, 1e-6, 1e-6));
        must(CVodeSetNonlinearSolver(t->memory, t->nonlinear));
        must(CVodeSetUserData(t->memory, t->problem));
        must(CVodeSetMaxNumSteps(t->memory, most_steps));
        must(CVodeSetErrFile(t->memory, NULL)); /* a tolerance that it cannot meet is no news */
    } else {
        t->memory = ERKStepCreate(rates_sundials, 0, t->vector, context);
        must(t->memory == NULL);
        must(ERKStepSetTableNum(t->memory, ARKODE_FEHLBERG_13_7_8));
        must(ERKStepSStolerances(t->memory, 1e-6, 1e-6));
        must(ERKStepSetUserData(t->memory, t->problem));
        must(ERKStepSetMaxNumSteps(t->memory, most_steps));
        must(ERKStepSetErrFile(t->memory, NULL));
    }
}

/* one run; false where the solver gives up */
static bool run(trial *t, double tolerance) {
    const double end = t->b->ref.duration;
    double now = 0;

    memcpy(t->y, t->problem->begin, sizeof t->y);
    if (t->solver == 0) {
        if (t->driver == NULL) {
            t->driver = gsl_odeiv2_driver_alloc_y_new(&t->system, gsl_odeiv2_step_rk8pd, 1e-2,
                                                      tolerance, tolerance);
        }
        gsl_odeiv2_driver_reset_hstart(t->driver, 1e-2);
        return gsl_odeiv2_driver_apply(t->driver, &now, end, t->y) == GSL_SUCCESS;
    }
    if (t->solver == 1) {
        if (CVodeReInit(t->memory, 0, t->vector) != 0 ||
            CVodeSStolerances(t->memory, tolerance, tolerance) != 0 ||
            CVodeSetStopTime(t->memory, end) != 0) {
            return false;
        }
        return CVode(t->memory, end, t->vector, &now, CV_NORMAL) >= 0;
    }
    if (ERKStepReInit(t->memory, rates_sundials, 0, t->vector) != 0 ||
        ERKStepSStolerances(t->memory, tolerance, tolerance) != 0 ||
        ERKStepSetStopTime(t->memory, end) != 0) {
        return false;
    }
    return ERKStepEvolve(t->memory, end, t->vector, &now, ARK_NORMAL) >= 0;
}

static double error_of(const trial *t) {
    double R[3][3];

    if (t->problem->ours) {
        for (int c = 0; c < 3; c++) {
            for (int r = 0; r < 3; r++) R[r][c] = t->y[3 + 3 * c + r];
        }
    } else {
        hand_matrix(t->y + 3, R);
    }
    return reference_error_matrix(&t->b->ref, t->y, R);
}

static void forget_driver(trial *t) {
    if (t->driver) gsl_odeiv2_driver_free(t->driver);
    t->driver = NULL;
}

static double error_at(void *context, double effort) {
    trial *t = context;

    forget_driver(t); /* its tolerance is its own */
    return run(t, 1 / effort) ? error_of(t) : INFINITY;
}

static void go(void *context) {
    trial *t = context;

    (void)run(t, 1 / t->effort);
}

static void prepare(bench *b, void *memory) {
    own *o = memory;

    must(SUNContext_Create(NULL, &o->context));
    gsl_set_error_handler_off();
    o->problem[0].size = 24;
    o->problem[0].ours = bench_memory(kernel_rates_size());
    kernel_rates_begin(o->problem[0].ours, &b->ref, o->problem[0].begin);
    o->problem[1].size = HAND_STATE;
    o->problem[1].hand = hand_of(&b->ref);
    hand_begin(&b->ref, o->problem[1].begin);
    for (int s = 0; s < SOLVERS; s++) {
        for (int side = 0; side < SIDES; side++) {
            double first = 100;
            for (int i = 0; i < TARGETS; i++) {
                trial *t = &o->trial[s][side][i];
                *t = (trial){.b = b, .problem = &o->problem[side], .solver = s, .item = -1};
                make(t, o->context);
                t->effort = bench_effort(error_at, t, first, 1e16, bench_target(i));
                if (!(t->effort > 0)) break;
                t->error = error_at(t, t->effort);
                t->item = measure_add(&b->time, go, t, 1);
                first = t->effort;
            }
        }
    }
}

static void report(bench *b, void *memory) {
    static const table_column columns[] = {{"error below", AS_ERROR}, {"error", AS_ERROR},
                                           {"1/tolerance", AS_ERROR}, {"ms", AS_PLAIN},
                                           {"quietest", AS_PLAIN},    {"agrees", AS_PLAIN}};
    static const char *const name[SOLVERS] = {"GSL rk8pd", "CVODE Adams", "ARKODE Fehlberg 8(7)"};
    own *o = memory;

    table_section(&b->out, "General solvers", 6, columns);
    for (int s = 0; s < SOLVERS; s++) {
        for (int side = 0; side < SIDES; side++) {
            for (int i = 0; i < TARGETS; i++) {
                trial *t = &o->trial[s][side][i];
                if (t->b == NULL || t->item < 0) continue;
                const timing now = measure_of(&b->time, t->item);
                table_begin_row(&b->out, "%s, %s", name[s],
                                side == 0 ? "our right-hand side" : "by hand");
                table_value(&b->out, bench_target(i));
                table_value(&b->out, t->error);
                table_value(&b->out, t->effort);
                table_value(&b->out, 1e3 * now.median);
                table_value(&b->out, 1e3 * now.quietest);
                table_word(&b->out, t->error <= bench_target(i) ? "yes" : "no");
                if (s == 0) b->figures.gsl[side][i] = now;
                if (s == 1) b->figures.cvode[side][i] = now;
                forget_driver(t);
            }
        }
    }
}

const bench_section section_solvers = {"solvers", sizeof(own), prepare, report};
