/* Rows of the kernels: nanoseconds a call and run, flops, share of the core's peak, and how much of the time is division's. */
#include <math.h>

#include "bench/bench.h"

enum { KERNELS = 6, HEAVY_KERNELS = 3 };

typedef struct {
    const kernel_width *kernel;
    void *memory;
    void *heavy; /* memory, for legs with mass */
    int heavy_item[HEAVY_KERNELS];
    int item[KERNELS], divide, root, apart, fused;
    double peak_flops;
} width;

typedef struct {
    width width[WIDTHS];
    kernel_counts counts, heavy_counts;
    int counted;
    double scratch;
} own;

static void prepare(bench *b, void *memory) {
    own *o = memory;

    o->counted = kernels_count(&b->ref, &o->counts) && kernels_count(&b->heavy, &o->heavy_counts);
    for (int i = 0; i < WIDTHS; i++) {
        width *w = &o->width[i];
        w->kernel = kernel_of(bench_lanes(i));
        if (w->kernel == NULL) continue;
        w->memory = bench_memory(w->kernel->size);
        w->kernel->begin(w->memory, &b->ref);

        void (*const go[KERNELS])(void *) = {
            w->kernel->right_hand_side, w->kernel->inverse_dynamics, w->kernel->rk4_step,
            w->kernel->dop853_step,     w->kernel->rattle2_step,     w->kernel->program};
        const double runs = bench_lanes(i), calls = KERNEL_CALLS * runs;
        const peak p = peak_of(bench_lanes(i));
        for (int k = 0; k < KERNELS; k++) {
            const bool alone = go[k] == w->kernel->program; /* the same for every run of a batch */
            w->item[k] = measure_add(&b->time, go[k], w->memory, alone ? KERNEL_CALLS : calls);
        }
        void (*const heavy[HEAVY_KERNELS])(void *) = {w->kernel->right_hand_side,
                                                      w->kernel->rk4_step, w->kernel->rattle2_step};
        w->heavy = bench_memory(w->kernel->size);
        w->kernel->begin(w->heavy, &b->heavy);
        for (int k = 0; k < HEAVY_KERNELS; k++) {
            w->heavy_item[k] = measure_add(&b->time, heavy[k], w->heavy, calls);
        }
        w->divide = measure_add(&b->time, w->kernel->divide, w->memory, 8 * calls);
        w->root = measure_add(&b->time, w->kernel->root, w->memory, 8 * calls);
        w->apart = measure_add(&b->time, p.multiply_add, &o->scratch, p.flops);
        w->fused = p.fused ? measure_add(&b->time, p.fused, &o->scratch, p.flops) : -1;
    }
}

static double flops_of(const kernel_flops *f) {
    return (double)(f->add_multiply + f->divide + f->root);
}

static void report_peaks(bench *b, const own *o) {
    static const table_column columns[] = {{"lanes", AS_PLAIN},
                                           {"multiply, add GFLOP/s", AS_PLAIN},
                                           {"fused GFLOP/s", AS_PLAIN},
                                           {"division ns a run", AS_PLAIN},
                                           {"root ns a run", AS_PLAIN}};

    table_section(&b->out, "The core", 5, columns);
    for (int i = 0; i < WIDTHS; i++) {
        const width *w = &o->width[i];
        if (w->kernel == NULL) continue;
        table_begin_row(&b->out, "most it does");
        table_value(&b->out, bench_lanes(i));
        table_value(&b->out, 1e-9 / measure_of(&b->time, w->apart).quietest);
        table_value(&b->out, 1e-9 / measure_of(&b->time, w->fused).quietest);
        table_value(&b->out, 1e9 * measure_of(&b->time, w->divide).quietest);
        table_value(&b->out, 1e9 * measure_of(&b->time, w->root).quietest);
    }
}

static void report_row(bench *b, const own *o, int i, const char *name, int item,
                       const kernel_flops *f) {
    const width *w = &o->width[i];
    const timing t = measure_of(&b->time, item);
    const double apart = measure_of(&b->time, w->apart).quietest,
                 fused = measure_of(&b->time, w->fused).quietest,
                 divide = measure_of(&b->time, w->divide).quietest,
                 root = measure_of(&b->time, w->root).quietest;

    table_begin_row(&b->out, "%s", name);
    table_value(&b->out, bench_lanes(i));
    table_value(&b->out, 1e9 * t.median);
    table_value(&b->out, 1e9 * t.quietest);
    if (f == NULL) return;
    table_value(&b->out, flops_of(f));
    table_value(&b->out, flops_of(f) / t.median * apart);
    table_value(&b->out, flops_of(f) / t.median * fused);
    table_value(&b->out, (double)f->divide);
    table_value(&b->out, (double)f->root);
    table_value(&b->out, ((double)f->divide * divide + (double)f->root * root) / t.median);
}

/* legs with mass */
static void report_heavy(bench *b, const own *o) {
    static const char *const name[HEAVY_KERNELS] = {
        "right-hand side, heavy legs", "rk4 step, heavy legs", "rattle2 step, heavy legs"};
    const kernel_flops *const flops[HEAVY_KERNELS] = {
        &o->heavy_counts.right_hand_side, &o->heavy_counts.rk4_step, &o->heavy_counts.rattle2_step};

    for (int k = 0; k < HEAVY_KERNELS; k++) {
        for (int i = 0; i < WIDTHS; i++) {
            const width *w = &o->width[i];
            if (w->kernel == NULL) continue;
            report_row(b, o, i, name[k], w->heavy_item[k], o->counted ? flops[k] : NULL);
            if (k == 0) b->figures.heavy_rates[i] = measure_of(&b->time, w->heavy_item[k]);
        }
    }
}

static void report(bench *b, void *memory) {
    static const table_column columns[] = {
        {"lanes", AS_PLAIN},     {"ns a run", AS_PLAIN},     {"quietest", AS_PLAIN},
        {"flops", AS_PLAIN},     {"of mul+add", AS_PERCENT}, {"of fused", AS_PERCENT},
        {"divisions", AS_PLAIN}, {"roots", AS_PLAIN},        {"their time", AS_PERCENT}};
    static const char *const name[KERNELS] = {"right-hand side",      "inverse dynamics, pivoting",
                                              "rk4 step, projection", "dop853 step, projection",
                                              "rattle2 step",         "program, one stage"};
    const own *o = memory;
    const kernel_flops *const flops[KERNELS] = {
        &o->counts.right_hand_side, &o->counts.inverse_dynamics,
        &o->counts.rk4_step,        NULL,
        &o->counts.rattle2_step,    NULL};

    report_peaks(b, o);
    table_section(&b->out, "Kernels, one core", 9, columns);
    for (int k = 0; k < KERNELS; k++) {
        for (int i = 0; i < WIDTHS; i++) {
            const width *w = &o->width[i];
            if (w->kernel == NULL || (k == KERNELS - 1 && i > 0)) continue;
            report_row(b, o, i, name[k], w->item[k], o->counted ? flops[k] : NULL);
            if (k == 1) b->figures.inverse[i] = measure_of(&b->time, w->item[k]);
            if (k == 2 && o->counted) {
                b->figures.peak_share[i] = flops_of(flops[k]) *
                                           measure_of(&b->time, w->apart).quietest /
                                           measure_of(&b->time, w->item[k]).median;
            }
        }
    }
    report_heavy(b, o);
    for (int i = 0; i < WIDTHS; i++) {
        const width *w = &o->width[i];
        if (w->kernel == NULL) continue;
        table_begin_row(&b->out, "forces to motion and back");
        table_value(&b->out, bench_lanes(i));
        table_word(&b->out, "%.1e", w->kernel->round_trip(w->memory));
    }
}

const bench_section section_kernels = {"kernels", sizeof(own), prepare, report};
