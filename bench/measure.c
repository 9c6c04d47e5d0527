/* Clocks, medians of interleaved rounds, and the processor on which they are taken. */
#define _GNU_SOURCE
#include "bench/measure.h"

#include <math.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static double seconds_of(clockid_t clock) {
    struct timespec t;

    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double clock_thread(void) { return seconds_of(CLOCK_THREAD_CPUTIME_ID); }
double clock_wall(void) { return seconds_of(CLOCK_MONOTONIC); }
double clock_process(void) { return seconds_of(CLOCK_PROCESS_CPUTIME_ID); }

measure measure_begin(bool quick) {
    return (measure){.rounds = quick ? 3 : MEASURE_ROUNDS,
                     .least = quick ? 2e-4 : 6e-3,
                     .enough = quick ? 0.01 : 0.6};
}

int measure_add(measure *m, void (*go)(void *), void *context, double units) {
    if (m->count == MEASURE_ITEMS) {
        fprintf(stderr, "bench: no room for more than %d things to time\n", MEASURE_ITEMS);
        exit(70);
    }
    m->item[m->count] = (measure_item){.go = go, .context = context, .units = units};
    return m->count++;
}

static double one_round(measure_item *item, double least) {
    double (*clock)(void) = item->wall ? clock_wall : clock_thread;
    const double begin = clock();
    double spent;
    long calls = 0;

    do {
        item->go(item->context);
        calls++;
        spent = clock() - begin;
    } while (spent < least);
    return spent / ((double)calls * item->units);
}

void measure_run(measure *m) {
    for (int i = 0; i < m->count; i++) {
        const double begin = clock_wall();
        m->item[i].rounds = 0;
        (void)one_round(&m->item[i], 0); /* warms up */
        m->item[i].most = m->rounds;
        if ((clock_wall() - begin) * m->rounds > m->enough) m->item[i].most = 3;
    }
    for (int round = 0; round < m->rounds; round++) {
        for (int i = 0; i < m->count; i++) {
            measure_item *item = &m->item[i];
            if (item->rounds == item->most) continue;
            item->seconds[item->rounds++] = one_round(item, m->least);
        }
    }
}

static int ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;

    return (x > y) - (x < y);
}

timing measure_of(const measure *m, int item) {
    double sorted[MEASURE_ROUNDS];

    if (item < 0 || m->item[item].rounds == 0) return (timing){NAN, NAN};
    const int n = m->item[item].rounds;
    memcpy(sorted, m->item[item].seconds, (size_t)n * sizeof *sorted);
    qsort(sorted, (size_t)n, sizeof *sorted, ascending);
    return (timing){(sorted[(n - 1) / 2] + sorted[n / 2]) / 2, sorted[0]};
}

/* ---- processors ---- */

/* all that the process may use, asked for before anything is pinned */
static cpu_set_t everything(void) {
    static cpu_set_t all;
    static int known;

    if (!known) known = sched_getaffinity(0, sizeof all, &all) == 0;
    return all;
}

int measure_processors(void) {
    const cpu_set_t all = everything();

    return CPU_COUNT(&all);
}

bool measure_pin(void) {
    const int here = sched_getcpu();
    cpu_set_t one;

    (void)everything();
    if (here < 0) return false;
    CPU_ZERO(&one);
    CPU_SET((size_t)here, &one);
    return sched_setaffinity(0, sizeof one, &one) == 0;
}

void measure_unpin(void) {
    const cpu_set_t all = everything();

    (void)sched_setaffinity(0, sizeof all, &all);
}
