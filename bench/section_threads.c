/* Rows of threads: the same batch on one and on two, by the clock on the wall, pinned to nothing. */
#include <math.h>

#include "bench/bench.h"

enum { MOST_THREADS_TIMED = 2 };

typedef struct {
    bench *b;
    gough_simulation simulation;
    int threads, item;
    void *memory;
    double processor, calls; /* processor time of all threads, summed */
} batch;

typedef struct {
    batch batch[MOST_THREADS_TIMED];
} own;

static const double step = 0.005;

static void go(void *context) {
    batch *t = context;
    gough_batch_options options = gough_batch_options_default();

    options.threads = t->threads;
    measure_unpin();
    const double begin = clock_process();
    if (gough_batch(&t->b->ref.model.motion, &t->simulation, t->b->ref.run, REFERENCE_RUNS,
                    &options, t->b->ref.outcome, t->memory, NULL) != GOUGH_OK) {
        bench_fail("a batch failed");
    }
    t->processor += clock_process() - begin;
    t->calls += 1;
    (void)measure_pin();
}

static void prepare(bench *b, void *memory) {
    own *o = memory;

    if (measure_processors() < 2) return;
    for (int i = 0; i < MOST_THREADS_TIMED; i++) {
        batch *t = &o->batch[i];
        gough_batch_options options = gough_batch_options_default();
        options.threads = i + 1;
        *t = (batch){.b = b,
                     .simulation = reference_rows(&b->ref, GOUGH_RK4, step),
                     .threads = i + 1,
                     .memory = bench_memory(gough_batch_size(&options))};
        t->item = measure_add(&b->time, go, t, REFERENCE_RUNS * b->ref.duration / step);
        b->time.item[t->item].wall = true;
    }
}

static void report(bench *b, void *memory) {
    static const table_column columns[] = {
        {"threads", AS_PLAIN},  {"million steps/s", AS_PLAIN},
        {"quietest", AS_PLAIN}, {"against one", AS_PLAIN},
        {"quietest", AS_PLAIN}, {"if nothing else ran", AS_PLAIN}};
    own *o = memory;
    timing one = {NAN, NAN};

    if (o->batch[0].b == NULL) return;
    table_section(&b->out, "Threads, RK4 at 0.005, the widest lanes", 6, columns);
    for (int i = 0; i < MOST_THREADS_TIMED; i++) {
        const batch *t = &o->batch[i];
        const timing now = measure_of(&b->time, t->item);
        const double work = t->processor / t->calls,
                     first = o->batch[0].processor / o->batch[0].calls;
        if (i == 0) one = now;
        table_begin_row(&b->out, "gough_batch()");
        table_value(&b->out, t->threads);
        table_value(&b->out, 1e-6 / now.median);
        table_value(&b->out, 1e-6 / now.quietest);
        table_value(&b->out, one.median / now.median);
        table_value(&b->out, one.quietest / now.quietest);
        table_value(&b->out, t->threads * first / work);
        if (i == 1) b->figures.threads = one.quietest / now.quietest;
    }
}

const bench_section section_threads = {"threads", sizeof(own), prepare, report};
