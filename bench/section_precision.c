/* Rows of work against precision: what a run costs whose final pose is right to 1e-3 … 1e-12, for every stepper. */
#include <math.h>

#include "bench/bench.h"

/* methods of gough_method in order, each with fixed steps; and dop853 with steps of its own before them */
enum { METHODS = GOUGH_METHODS + 1 };

typedef struct {
    bench *b;
    gough_simulation alone, batch;
    int lanes;
    size_t runs;
    void *memory;
    double effort, error;
    int alone_item, batch_item; /* −1: not reached */
} trial;

typedef struct {
    trial trial[METHODS][TARGETS];
} own;

static double run_batch(trial *t, int lanes, size_t runs) {
    gough_batch_options options = gough_batch_options_default();
    gough_outcome *out = t->b->ref.outcome;

    options.lanes = lanes;
    options.threads = 1;
    if (gough_batch(&t->b->ref.model.motion, &t->batch, t->b->ref.run, runs, &options, out,
                    t->memory, NULL) != GOUGH_OK) {
        bench_fail("a batch failed");
    }
    return out->cause == GOUGH_END_DONE ? reference_error(&t->b->ref, out->position, out->angles)
                                        : INFINITY;
}

static double error_fixed(void *context, double effort) {
    trial *t = context;

    t->batch = reference_simulation(&t->b->ref, t->batch.method, (long)effort, 0);
    return run_batch(t, 1, 1);
}

static double error_adaptive(void *context, double effort) {
    trial *t = context;

    t->alone = reference_simulation(&t->b->ref, GOUGH_DOP853, 0, 1 / effort);
    return reference_alone(&t->b->ref, &t->alone);
}

static void go_alone(void *context) {
    const trial *t = context;

    (void)reference_alone(&t->b->ref, &t->alone);
}

static void go_batch(void *context) {
    trial *t = context;

    (void)run_batch(t, t->lanes, t->runs);
}

static void prepare_fixed(bench *b, trial *t, gough_method method, double first, double target) {
    const double most = b->quick ? 2e4 : 4e5;

    t->batch.method = method;
    t->effort = bench_effort(error_fixed, t, first, most, target);
    if (!(t->effort > 0)) return;
    t->error = error_fixed(t, t->effort);
    t->alone = t->batch;
    t->alone.output_step = b->ref.duration;
    t->alone.step = b->ref.duration / t->effort;
    t->alone_item = measure_add(&b->time, go_alone, t, 1);

    /* enough runs for their stages to be shared, not so many that a round takes seconds */
    const double groups = 3e6 / (t->effort * t->lanes);
    t->runs = (size_t)t->lanes * (size_t)(groups < 1 ? 1 : groups > 32 ? 32 : groups);
    t->batch_item = measure_add(&b->time, go_batch, t, (double)t->runs);
}

static void prepare(bench *b, void *memory) {
    own *o = memory;
    gough_batch_options options = gough_batch_options_default();
    void *room;

    options.threads = 1;
    room = bench_memory(gough_batch_size(&options));
    for (int m = 0; m < METHODS; m++) {
        double first = m == 0 ? 1e2 : 16;
        for (int i = 0; i < TARGETS; i++) {
            trial *t = &o->trial[m][i];
            *t = (trial){.b = b,
                         .lanes = gough_batch_lanes(),
                         .memory = room,
                         .alone_item = -1,
                         .batch_item = -1};
            if (m == 0) {
                t->effort = bench_effort(error_adaptive, t, first, 1e14, bench_target(i));
                if (!(t->effort > 0)) break;
                t->error = error_adaptive(t, t->effort);
                t->alone_item = measure_add(&b->time, go_alone, t, 1);
            } else {
                prepare_fixed(b, t, (gough_method)(m - 1), first, bench_target(i));
                if (!(t->effort > 0)) break;
            }
            first = t->effort;
        }
    }
}

static void report(bench *b, void *memory) {
    static const table_column columns[] = {
        {"error below", AS_ERROR}, {"error", AS_ERROR},    {"steps or 1/tolerance", AS_ERROR},
        {"ms alone", AS_PLAIN},    {"quietest", AS_PLAIN}, {"ms a run in lanes", AS_PLAIN},
        {"quietest", AS_PLAIN}};
    const own *o = memory;

    table_section(&b->out, "Work against precision", 7, columns);
    for (int m = 0; m < METHODS; m++) {
        for (int i = 0; i < TARGETS; i++) {
            const trial *t = &o->trial[m][i];
            if (t->b == NULL || t->alone_item < 0) continue;
            const timing alone = measure_of(&b->time, t->alone_item),
                         lanes = measure_of(&b->time, t->batch_item);
            table_begin_row(&b->out, m == 0 ? "%s, adaptive" : "%s",
                            gough_method_name(m == 0 ? (int)GOUGH_DOP853 : m - 1));
            table_value(&b->out, bench_target(i));
            table_value(&b->out, t->error);
            table_value(&b->out, t->effort);
            table_value(&b->out, 1e3 * alone.median);
            table_value(&b->out, 1e3 * alone.quietest);
            table_value(&b->out, 1e3 * lanes.median);
            table_value(&b->out, 1e3 * lanes.quietest);
            if (m == 0) b->figures.alone[i] = alone;
            if (m == 1) b->figures.lanes[i] = lanes;
        }
    }
}

const bench_section section_precision = {"precision", sizeof(own), prepare, report};
