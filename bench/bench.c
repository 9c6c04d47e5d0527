/* bench: times of the kernels, of whole runs, of threads and of the command, beside those of other programs, in one table. */
#include "bench/bench.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_SECTIONS = 12 };

int bench_lanes(int width) { return 1 << width; }

double bench_target(int target) {
    static const double targets[TARGETS] = {1e-3, 1e-6, 1e-9, 1e-12};

    return targets[target];
}

void bench_fail(const char *sentence) {
    fprintf(stderr, "bench: %s\n", sentence);
    exit(70);
}

void *bench_memory(size_t size) {
    const size_t rounded = (size + 63) / 64 * 64;
    void *memory = aligned_alloc(64, rounded);

    if (memory == NULL) bench_fail("no memory");
    memset(memory, 0, rounded);
    return memory;
}

double bench_effort(double (*error)(void *context, double effort), void *context, double first,
                    double most, double target) {
    double low = 0, high = first;

    while (!(error(context, high) <= target)) {
        low = high;
        high *= 2;
        if (high > most) return NAN;
    }
    for (int i = 0; i < 5 && low > 0; i++) {
        const double middle = floor(sqrt(low * high));
        if (error(context, middle) <= target) {
            high = middle;
        } else {
            low = middle;
        }
    }
    return high;
}

static timing no_timing(void) { return (timing){NAN, NAN}; }

static void clear_figures(figures *f) {
    f->threads = f->map = NAN;
    f->mujoco_step = f->mujoco_legs = f->mujoco_inverse = no_timing();
    for (int w = 0; w < WIDTHS; w++) {
        f->rk4[w] = f->inverse[w] = f->heavy_rk4[w] = f->heavy_rates[w] = no_timing();
        f->peak_share[w] = NAN;
    }
    for (int t = 0; t < TARGETS; t++) {
        f->alone[t] = f->lanes[t] = f->mujoco[t] = no_timing();
        for (int s = 0; s < 2; s++) f->gsl[s][t] = f->cvode[s][t] = no_timing();
    }
}

static void say_usage(FILE *where) {
    fputs("bench [--quick] [--json] [--only=SECTION] [--gough=COMMAND]\n"
          "  --quick   short runs: shows that all works, the times mean little\n"
          "  --json    the table for machines\n"
          "  --only    kernels, steps, loop, precision, mujoco, solvers, threads, map, pose, "
          "workspace or process\n"
          "  --gough   the command whose processes are timed\n",
          where);
}

static int parse(bench *b, int count, char **text) {
    for (int i = 1; i < count; i++) {
        if (strcmp(text[i], "--quick") == 0) {
            b->quick = true;
        } else if (strcmp(text[i], "--json") == 0) {
            b->json = true;
        } else if (strncmp(text[i], "--gough=", 8) == 0) {
            b->command = text[i] + 8;
        } else if (strncmp(text[i], "--only=", 7) == 0) {
            b->only = text[i] + 7;
        } else if (strcmp(text[i], "--help") == 0) {
            say_usage(stdout);
            exit(0);
        } else {
            fprintf(stderr, "bench: no option '%s'\n", text[i]);
            say_usage(stderr);
            return 0;
        }
    }
    return 1;
}

static bool wanted(const bench *b, const bench_section *s) {
    return b->only == NULL || strcmp(b->only, s->name) == 0;
}

int main(int count, char **text) {
    static const bench_section *const sections[] = {
        &section_kernels,
        &section_steps,
        &section_loop,
        &section_precision,
#if defined(BENCH_PEERS)
        &section_mujoco,
        &section_solvers,
#endif
        &section_threads,
        &section_map,
        &section_pose,
        &section_workspace,
        &section_process,
        &section_claims,
    };
    const int number = (int)(sizeof sections / sizeof *sections);
    void *own[MOST_SECTIONS];
    bench *b = bench_memory(sizeof *b);

    if (!parse(b, count, text)) return 64;
    if (!measure_pin()) fputs("bench: not pinned to a processor\n", stderr);
    b->time = measure_begin(b->quick);
    clear_figures(&b->figures);
    reference_begin(&b->ref, b->quick ? 1 : 20, false);
    reference_begin(&b->heavy, b->quick ? 1 : 20, true);
    for (int i = 0; i < number; i++) {
        if (!wanted(b, sections[i])) continue;
        own[i] = bench_memory(sections[i]->size);
        sections[i]->prepare(b, own[i]);
    }
    measure_run(&b->time);
    for (int i = 0; i < number; i++) {
        if (wanted(b, sections[i])) sections[i]->report(b, own[i]);
    }
    if (b->json) {
        table_print_json(&b->out);
    } else {
        table_print(&b->out);
    }
    return fflush(stdout) == 0 ? 0 : 74;
}
