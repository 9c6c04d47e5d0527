/* Rows of MuJoCo: the same machine on tendons (exactly our model of massless legs) and on legs of two bodies; its RK4 at the same
 * step and at the same error, its inverse dynamics. F^p and l^p come from a table made beforehand, as ours do in a batch. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define NUMBER_DOUBLE
#include "bench/bench.h"
#include "bench/peer_mujoco_model.h"
#include "kernel/solve.h"

/* length and force of the legs at half steps */
typedef struct {
    const hand *hand;
    double half;
    double home[6];
    double *length, *force;
} law;

typedef struct {
    bench *b;
    const reference *ref;
    hand hand;
    double y[HAND_STATE];
    mjModel *model;
    mjData *data;
    law law;
    long steps;
    double error;
    int item;
} trial;

enum { EQUAL_STEP = TARGETS, LEGS_EQUAL_STEP, HEAVY_EQUAL_STEP, TRIALS };

typedef struct {
    trial trial[TRIALS];
    mjModel *model;
    mjData *data;
    int inverse;
    double inverse_error;
} own;

/* MuJoCo's callback has no context: the law of the run under way */
static const law *current;

static void control(const mjModel *m, mjData *d) {
    const law *l = current;
    const long i = lround(d->time / l->half);
    const double base = l->force[i] + l->hand->stiffness * l->length[i];

    if (m->ntendon) {
        for (int v = 0; v < 6; v++) d->ctrl[v] = base - l->hand->stiffness * d->ten_length[v];
    } else {
        for (int v = 0; v < 6; v++) {
            d->ctrl[v] = base - l->hand->stiffness * (l->home[v] + d->qpos[9 + 3 * v]);
        }
    }
}

static void make_law(law *l, const hand *h, double duration, long steps) {
    const size_t bytes = (size_t)(2 * steps + 2) * sizeof(double);
    double axes[3][3];

    free(l->length);
    free(l->force);
    l->hand = h;
    l->half = duration / (double)(2 * steps);
    l->length = malloc(bytes);
    l->force = malloc(bytes);
    if (l->length == NULL || l->force == NULL) bench_fail("no memory");
    for (long i = 0; i <= 2 * steps + 1; i++) {
        hand_program(h, (double)i * l->half, &l->length[i], &l->force[i]);
    }
    for (int v = 0; v < 6; v++) l->home[v] = mujoco_leg_frame(h, v, axes);
}

static void go(void *context) {
    trial *t = context;

    current = &t->law;
    mjcb_control = control;
    mujoco_place(t->model, t->data, &t->hand, t->y);
    t->model->opt.timestep = 2 * t->law.half;
    for (long i = 0; i < t->steps; i++) mj_step(t->model, t->data);
    mjcb_control = NULL;
}

static double error_at(void *context, double effort) {
    trial *t = context;
    double R[3][3];

    t->steps = (long)effort;
    make_law(&t->law, &t->hand, t->ref->duration, t->steps);
    go(t);
    hand_matrix(t->data->qpos + 3, R);
    return reference_error_matrix(t->ref, t->data->qpos, R);
}

/* ---- inverse dynamics ---- */

/* generalised forces, then the six equations of the legs */
static void solve_inverse(const mjModel *m, mjData *d, double u[6]) {
    double a[6][6], b[1][6];

    mj_inverse(m, d);
    for (int r = 0; r < 6; r++) {
        for (int v = 0; v < 6; v++) a[r][v] = d->ten_J[6 * v + r];
        b[0][r] = d->qfrc_inverse[r];
    }
    (void)solve_six(a, b, 1);
    for (int v = 0; v < 6; v++) u[v] = b[0][v];
}

static void go_inverse(void *context) {
    own *o = context;
    double u[6];

    for (int i = 0; i < 64; i++) solve_inverse(o->model, o->data, u);
}

/* at rest in heave the answer is known: M (z̈ + g) l/(6 h) */
static void prepare_inverse(bench *b, own *o, const hand *h) {
    double y[HAND_STATE] = {0}, length, force, u[6];
    const double second = 0.1;

    y[2] = h->height;
    y[3] = 1;
    o->model = mujoco_tendons(h);
    o->data = mj_makeData(o->model);
    mujoco_place(o->model, o->data, h, y);
    memset(o->data->qacc, 0, 6 * sizeof(double));
    o->data->qacc[2] = second;
    solve_inverse(o->model, o->data, u);
    length = sqrt(h->height * h->height + h->distance2);
    force = h->mass * (second + h->gravity) * length / (6 * h->height);
    o->inverse_error = 0;
    for (int v = 0; v < 6; v++) o->inverse_error = fmax(o->inverse_error, fabs(u[v] - force));
    o->inverse = measure_add(&b->time, go_inverse, o, 64);
}

static void begin_trial(bench *b, trial *t, const reference *ref, bool legs) {
    *t = (trial){.b = b, .ref = ref, .hand = hand_of(ref), .item = -1};
    hand_begin(ref, t->y);
    t->model = legs ? mujoco_legs(&t->hand) : mujoco_tendons(&t->hand);
    t->data = mj_makeData(t->model);
}

/* steps too long for this motion end in a state that is not finite: its error says so */
static void say_nothing(const char *sentence) { (void)sentence; }

static void prepare(bench *b, void *memory) {
    own *o = memory;
    const double equal = round(b->ref.duration / 0.001);
    double first = b->quick ? 64 : 512;

    mju_user_warning = say_nothing;
    for (int i = EQUAL_STEP; i < TRIALS; i++) {
        begin_trial(b, &o->trial[i], i == HEAVY_EQUAL_STEP ? &b->heavy : &b->ref, i != EQUAL_STEP);
        o->trial[i].error = error_at(&o->trial[i], equal);
        o->trial[i].item = measure_add(&b->time, go, &o->trial[i], equal);
    }
    for (int i = 0; i < (b->quick ? 2 : 3); i++) {
        trial *t = &o->trial[i];
        begin_trial(b, t, &b->ref, false);
        const double steps = bench_effort(error_at, t, first, 1e6, bench_target(i));
        if (!(steps > 0)) break;
        first = steps;
        t->error = error_at(t, first);
        t->item = measure_add(&b->time, go, t, 1);
    }
    prepare_inverse(b, o, &o->trial[EQUAL_STEP].hand);
}

/* the error of our RK4 at the same step; its times are those of whole batches */
static void report_ours(bench *b, const char *name, const reference *ref) {
    const gough_simulation s = reference_rows(ref, GOUGH_RK4, 0.001);

    table_begin_row(&b->out, "%s", name);
    for (int i = 0; i < 3; i++) table_word(&b->out, "-");
    table_value(&b->out, reference_alone(ref, &s));
}

static void report_equal(bench *b, own *o) {
    static const table_column columns[] = {{"million steps/s", AS_PLAIN}, {"quietest", AS_PLAIN},
                                           {"ns a step", AS_PLAIN},       {"error", AS_ERROR},
                                           {"agrees within", AS_ERROR},   {"agrees", AS_PLAIN}};
    static const char *const name[] = {"MuJoCo, tendons", "MuJoCo, legs of two bodies, connect",
                                       "MuJoCo, heavy legs of two bodies, connect"};
    const double within[] = {1e-4, 5e-2, 1e-3};

    table_section(&b->out, "MuJoCo's RK4 at 0.001", 6, columns);
    for (int i = 0; i < 3; i++) {
        const trial *t = &o->trial[EQUAL_STEP + i];
        const timing now = measure_of(&b->time, t->item);
        table_begin_row(&b->out, "%s", name[i]);
        table_value(&b->out, 1e-6 / now.median);
        table_value(&b->out, 1e-6 / now.quietest);
        table_value(&b->out, 1e9 * now.median);
        table_value(&b->out, t->error);
        table_value(&b->out, within[i]);
        table_word(&b->out, t->error <= within[i] ? "yes" : "no");
        if (i == 0) b->figures.mujoco_step = now;
        if (i == 2) b->figures.mujoco_legs = now;
    }
    const timing now = measure_of(&b->time, o->inverse);
    table_begin_row(&b->out, "MuJoCo, inverse dynamics and six equations");
    table_value(&b->out, 1e-6 / now.median);
    table_value(&b->out, 1e-6 / now.quietest);
    table_value(&b->out, 1e9 * now.median);
    table_value(&b->out, o->inverse_error);
    table_value(&b->out, 1e-12);
    table_word(&b->out, o->inverse_error <= 1e-12 ? "yes" : "no");
    b->figures.mujoco_inverse = now;
    report_ours(b, "ours, legs without mass", &b->ref);
    report_ours(b, "ours, heavy legs", &b->heavy);
}

static void report(bench *b, void *memory) {
    static const table_column columns[] = {{"error below", AS_ERROR},
                                           {"error", AS_ERROR},
                                           {"steps", AS_PLAIN},
                                           {"ms", AS_PLAIN},
                                           {"quietest", AS_PLAIN}};
    own *o = memory;

    report_equal(b, o);
    table_section(&b->out, "MuJoCo's RK4 at equal error, tendons", 5, columns);
    for (int i = 0; i < 3; i++) {
        const trial *t = &o->trial[i];
        if (t->b == NULL || t->item < 0) continue;
        const timing now = measure_of(&b->time, t->item);
        table_begin_row(&b->out, "MuJoCo, tendons");
        table_value(&b->out, bench_target(i));
        table_value(&b->out, t->error);
        table_value(&b->out, (double)t->steps);
        table_value(&b->out, 1e3 * now.median);
        table_value(&b->out, 1e3 * now.quietest);
        b->figures.mujoco[i] = now;
    }
}

const bench_section section_mujoco = {"mujoco", sizeof(own), prepare, report};
