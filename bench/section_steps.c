/* Rows of whole batches on one thread: steps of RK4 in a second for each width, and the memory of a run. */
#include <math.h>

#include "batch/lane_runs_table.h"
#include "bench/bench.h"

typedef struct {
    bench *b;
    reference *ref;
    gough_simulation simulation;
    int lanes;
    size_t runs;
    void *memory;
    int item;
} batch;

typedef struct {
    batch batch[2][WIDTHS]; /* legs without and with mass */
    gough_simulation alone;
    int simulate[2];
    bench *b;
} own;

static const double step = 0.001;

static void go(void *context) {
    const batch *t = context;
    gough_batch_options options = gough_batch_options_default();

    options.lanes = t->lanes;
    options.threads = 1;
    if (gough_batch(&t->ref->model.motion, &t->simulation, t->ref->run, t->runs, &options,
                    t->ref->outcome, t->memory, NULL) != GOUGH_OK) {
        bench_fail("a batch failed");
    }
}

static void go_alone(void *context) {
    own *o = context;

    (void)reference_alone(&o->b->ref, &o->alone);
}

static void go_alone_heavy(void *context) {
    own *o = context;

    (void)reference_alone(&o->b->heavy, &o->alone);
}

static void prepare(bench *b, void *memory) {
    own *o = memory;
    gough_batch_options options = gough_batch_options_default();

    options.threads = 1;
    o->b = b;
    for (int i = 0; i < 2 * WIDTHS; i++) {
        const int heavy = i / WIDTHS, lanes = bench_lanes(i % WIDTHS);
        batch *t = &o->batch[heavy][i % WIDTHS];
        if (kernel_of(lanes) == NULL) continue;
        *t = (batch){.b = b,
                     .ref = heavy ? &b->heavy : &b->ref,
                     .simulation = reference_rows(&b->ref, GOUGH_RK4, step),
                     .lanes = lanes,
                     .runs = (size_t)(b->quick ? 1 : 64) * (size_t)lanes,
                     .memory = bench_memory(gough_batch_size(&options))};
        t->item = measure_add(&b->time, go, t, (double)t->runs * b->ref.duration / step);
    }
    o->alone = reference_rows(&b->ref, GOUGH_RK4, step);
    o->simulate[0] = measure_add(&b->time, go_alone, o, b->ref.duration / step);
    o->simulate[1] = measure_add(&b->time, go_alone_heavy, o, b->ref.duration / step);
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

static void report_steps(bench *b, const char *name, int lanes, timing t, timing one) {
    table_begin_row(&b->out, "%s", name);
    table_value(&b->out, lanes);
    table_value(&b->out, 1e-6 / t.median);
    table_value(&b->out, 1e-6 / t.quietest);
    table_value(&b->out, 1e9 * t.median);
    table_value(&b->out, one.median / t.median);
}

static void report(bench *b, void *memory) {
    static const table_column columns[] = {{"lanes", AS_PLAIN},
                                           {"million steps/s", AS_PLAIN},
                                           {"quietest", AS_PLAIN},
                                           {"ns a step", AS_PLAIN},
                                           {"against one lane", AS_PLAIN}};
    static const char *const batch_name[2] = {"gough_batch()", "gough_batch(), heavy legs"};
    static const char *const alone_name[2] = {"gough_simulate(), rows each 0.05",
                                              "gough_simulate(), heavy legs"};
    own *o = memory;

    table_section(&b->out, "RK4 at 0.001, one thread", 5, columns);
    for (int heavy = 0; heavy < 2; heavy++) {
        timing *const figure = heavy ? b->figures.heavy_rk4 : b->figures.rk4;
        for (int i = 0; i < WIDTHS; i++) {
            if (o->batch[heavy][i].b == NULL) continue;
            figure[i] = measure_of(&b->time, o->batch[heavy][i].item);
            report_steps(b, batch_name[heavy], bench_lanes(i), figure[i], figure[0]);
        }
        report_steps(b, alone_name[heavy], 1, measure_of(&b->time, o->simulate[heavy]), figure[0]);
    }
    report_memory(b);
}

const bench_section section_steps = {"steps", sizeof(own), prepare, report};
