/* Rows of controllers that sample: whole batches in the widest lanes beside the continuous controller, and single steps of a plant
 * with the longest of them. */
#include <stdlib.h>

#include "bench/bench.h"
#include "gough/dynamics.h"

enum { KINDS = 4 };
static const double step = 0.001;

/* continuous, or sampled each so many steps */
static const int every[KINDS] = {0, 10, 2, 1};
static const char *const name[KINDS] = {"continuous, G and D", "sampled each 10 steps",
                                        "sampled each 2 steps", "sampled each step"};

typedef struct {
    reference ref;
    gough_simulation simulation;
    void *memory;
    size_t runs;
    int lanes, item;
} batch;

typedef struct {
    batch batch[KINDS];
} own;

static void go(void *context) {
    batch *t = context;
    gough_batch_options options = gough_batch_options_default();

    options.lanes = t->lanes;
    options.threads = 1;
    if (gough_batch(&t->ref.model.motion, &t->simulation, t->ref.run, t->runs, &options,
                    t->ref.outcome, t->memory, NULL) != GOUGH_OK) {
        bench_fail("a batch of sampled controllers failed");
    }
}

static void prepare(bench *b, void *memory) {
    own *o = memory;
    gough_batch_options options = gough_batch_options_default();
    int widest = WIDTHS - 1;

    options.threads = 1;
    while (widest > 0 && kernel_of(bench_lanes(widest)) == NULL) widest--;
    for (int k = 0; k < KINDS; k++) {
        batch *t = &o->batch[k];
        reference_begin(&t->ref, b->ref.duration, false);
        for (int v = 0; v < GOUGH_LEGS; v++) t->ref.model.control.damping[v] = 3;
        t->ref.model.control.sampling =
            (gough_sampling){.period = every[k] * step, .velocity = GOUGH_VELOCITY_DIFFERENCE};
        t->simulation = reference_rows(&t->ref, GOUGH_RK4, step);
        t->lanes = bench_lanes(widest);
        t->runs = (size_t)(b->quick ? 1 : 16) * (size_t)t->lanes;
        t->memory = bench_memory(gough_batch_size(&options));
        t->item = measure_add(&b->time, go, t, (double)t->runs * b->ref.duration / step);
    }
}

static int ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* seconds on the clock of single steps under a controller that samples each of them: half of them are shorter, all, and one in a
 * hundred is longer */
static void time_plant(bench *b, double figure[3]) {
    enum { STEPS = 20000 };
    gough_model *model = bench_memory(sizeof *model);
    double *seconds = bench_memory(STEPS * sizeof *seconds);
    const gough_simulation s = reference_rows(&b->ref, GOUGH_RK4, step);
    void *plant = bench_memory(gough_plant_size());
    gough_control_memory memory = {.begun = false};
    gough_state home = gough_state_home(&b->ref.model.machine);
    const gough_acceleration none = {.linear = {0, 0, 0}};
    const double rest[GOUGH_LEGS] = {0};
    double force[GOUGH_LEGS], command[GOUGH_LEGS];
    gough_row row;

    *model = b->ref.model;
    for (int c = 0; c < GOUGH_COMPONENTS; c++) model->motion.formula[c] = gough_formula_constant(0);
    for (int v = 0; v < GOUGH_LEGS; v++) model->control.damping[v] = 3;
    model->control.sampling.period = step;
    (void)gough_inverse_dynamics(&model->machine, &home, &none, NULL, force, NULL);
    if (gough_plant_begin(plant, model, &s, &row, NULL, NULL) != GOUGH_OK)
        bench_fail("a plant does not begin");
    for (int k = 0; k < STEPS; k++) {
        const double before = clock_wall();
        gough_control_sample(&model->control, NULL, &memory, force, model->machine.home_length,
                             rest, row.value + GOUGH_L, row.value + GOUGH_DL, command);
        if (gough_step(plant, command, &row, NULL, NULL) != GOUGH_OK) bench_fail("a plant ended");
        seconds[k] = clock_wall() - before;
    }
    qsort(seconds, STEPS, sizeof *seconds, ascending);
    figure[0] = seconds[STEPS / 2];
    figure[1] = seconds[STEPS - STEPS / 100];
    figure[2] = seconds[STEPS - 1];
}

static void report(bench *b, void *memory) {
    static const table_column batches[] = {
        {"lanes", AS_PLAIN}, {"ns a step", AS_PLAIN}, {"against continuous", AS_PLAIN}};
    static const table_column steps[] = {
        {"us", AS_PLAIN}, {"one in 100 is longer", AS_PLAIN}, {"longest", AS_PLAIN}};
    own *o = memory;
    double figure[3];

    table_section(&b->out, "Sampled controllers, RK4 at 0.001, one thread", 3, batches);
    for (int k = 0; k < KINDS; k++) {
        const timing one = measure_of(&b->time, o->batch[0].item),
                     t = measure_of(&b->time, o->batch[k].item);
        table_begin_row(&b->out, "%s", name[k]);
        table_value(&b->out, o->batch[k].lanes);
        table_value(&b->out, 1e9 * t.median);
        table_value(&b->out, t.median / one.median);
    }
    time_plant(b, figure);
    table_section(&b->out, "A plant, one step and one sample", 3, steps);
    table_begin_row(&b->out, "gough_control_sample(), gough_step()");
    for (int i = 0; i < 3; i++) table_value(&b->out, 1e6 * figure[i]);
}

const bench_section section_loop = {"loop", sizeof(own), prepare, report};
