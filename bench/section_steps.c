/* Rows of whole batches on one thread: steps of RK4 in a second for each width, and the memory of a run. */
#include <math.h>

#include "batch/lane_runs_table.h"
#include "bench/bench.h"

typedef struct {
    bench *b;
    gough_simulation simulation;
    int lanes;
    size_t runs;
    void *memory;
    int item;
} batch;

typedef struct {
    batch batch[WIDTHS], adaptive;
    gough_simulation alone;
    int simulate;
    bench *b;
} own;

static const double step = 0.001;

static void go(void *context) {
    const batch *t = context;
    gough_batch_options options = gough_batch_options_default();

    options.lanes = t->lanes;
    options.threads = 1;
    if (gough_batch(&t->b->ref.model.motion, &t->simulation, t->b->ref.run, t->runs, &options,
                    t->b->ref.outcome, t->memory, NULL) != GOUGH_OK) {
        bench_fail("a batch failed");
    }
}

static void go_alone(void *context) {
    own *o = context;

    (void)reference_alone(&o->b->ref, &o->alone);
}

static void prepare(bench *b, void *memory) {
    own *o = memory;
    gough_batch_options options = gough_batch_options_default();

    options.threads = 1;
    o->b = b;
    for (int i = 0; i < WIDTHS; i++) {
        batch *t = &o->batch[i];
        if (kernel_of(bench_lanes(i)) == NULL) continue;
        *t = (batch){.b = b,
                     .simulation = reference_rows(&b->ref, GOUGH_RK4, step),
                     .lanes = bench_lanes(i),
                     .runs = (size_t)(b->quick ? 1 : 64) * (size_t)bench_lanes(i),
                     .memory = bench_memory(gough_batch_size(&options))};
        t->item = measure_add(&b->time, go, t, (double)t->runs * b->ref.duration / step);
    }
    o->alone = reference_rows(&b->ref, GOUGH_RK4, step);
    o->simulate = measure_add(&b->time, go_alone, o, b->ref.duration / step);
}

static void report_memory(bench *b) {
    static const table_column columns[] = {{"lanes", AS_PLAIN}, {"bytes", AS_PLAIN}};
    static const struct batch_width *const widths[WIDTHS] = {
        &batch_width_1,
        &batch_width_2,
#if defined(__x86_64__)
        &batch_width_4,
        &batch_width_8
#endif
    };
    gough_batch_options options = gough_batch_options_default();

    options.threads = 1;
    table_section(&b->out, "Memory", 2, columns);
    for (int i = 0; i < WIDTHS; i++) {
        if (kernel_of(bench_lanes(i)) == NULL) continue;
        table_begin_row(&b->out, "a run under way");
        table_value(&b->out, bench_lanes(i));
        table_value(&b->out, (double)widths[i]->group_size / bench_lanes(i));
    }
    table_begin_row(&b->out, "a run: what it is and what it leaves");
    table_word(&b->out, "-");
    table_value(&b->out,
                (double)(sizeof(gough_batch_run) + sizeof(gough_initial) + sizeof(gough_outcome)));
    table_begin_row(&b->out, "a thread, whatever the number of runs");
    table_word(&b->out, "-");
    table_value(&b->out, (double)gough_batch_size(&options));
}

static void report(bench *b, void *memory) {
    static const table_column columns[] = {{"lanes", AS_PLAIN},
                                           {"million steps/s", AS_PLAIN},
                                           {"quietest", AS_PLAIN},
                                           {"ns a step", AS_PLAIN},
                                           {"against one lane", AS_PLAIN}};
    own *o = memory;

    table_section(&b->out, "RK4 at 0.001, one thread", 5, columns);
    for (int i = 0; i < WIDTHS; i++) {
        if (o->batch[i].b == NULL) continue;
        const timing t = measure_of(&b->time, o->batch[i].item);
        b->figures.rk4[i] = t;
        table_begin_row(&b->out, "gough_batch()");
        table_value(&b->out, bench_lanes(i));
        table_value(&b->out, 1e-6 / t.median);
        table_value(&b->out, 1e-6 / t.quietest);
        table_value(&b->out, 1e9 * t.median);
        table_value(&b->out, b->figures.rk4[0].median / t.median);
    }
    const timing t = measure_of(&b->time, o->simulate);
    table_begin_row(&b->out, "gough_simulate(), rows each 0.05");
    table_value(&b->out, 1);
    table_value(&b->out, 1e-6 / t.median);
    table_value(&b->out, 1e-6 / t.quietest);
    table_value(&b->out, 1e9 * t.median);
    table_value(&b->out, b->figures.rk4[0].median / t.median);
    report_memory(b);
}

const bench_section section_steps = {"steps", sizeof(own), prepare, report};
