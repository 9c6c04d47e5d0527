/* Rows of what the project means to reach: the figure of this run beside it. */
#include <math.h>

#include "bench/bench.h"

static void prepare(bench *b, void *memory) {
    (void)b;
    (void)memory;
}

/* figure: more is better */
static void claim(bench *b, const char *name, double figure, double quietest, double wanted) {
    table_begin_row(&b->out, "%s", name);
    table_value(&b->out, wanted);
    table_value(&b->out, figure);
    table_value(&b->out, quietest);
    if (!isfinite(figure)) {
        table_word(&b->out, "not measured");
    } else if (figure >= wanted) {
        table_word(&b->out, "reached, %.2f times", figure / wanted);
    } else {
        table_word(&b->out, "not reached: %.1f %% of it", 100 * figure / wanted);
    }
}

static void ratio(bench *b, const char *name, timing slow, timing fast, double wanted) {
    claim(b, name, slow.median / fast.median, slow.quietest / fast.quietest, wanted);
}

static void rate(bench *b, const char *name, timing t, double wanted) {
    claim(b, name, 1e-6 / t.median, 1e-6 / t.quietest, wanted);
}

static void report(bench *b, void *memory) {
    static const table_column columns[] = {
        {"wanted", AS_PLAIN}, {"median", AS_PLAIN}, {"quietest", AS_PLAIN}, {"", AS_PLAIN}};
    const figures *f = &b->figures;
    int widest = WIDTHS - 1;

    (void)memory;
    while (widest > 0 && !isfinite(f->rk4[widest].median)) widest--;
    table_section(&b->out, "What is meant to be reached", 4, columns);
    ratio(b, "RK4 steps in lanes against MuJoCo's tendons, times", f->mujoco_step, f->rk4[widest],
          120);
    ratio(b, "RK4 in 8 lanes against one, times", f->rk4[0], f->rk4[3], 5);
    ratio(b, "RK4 in 4 lanes against one, times", f->rk4[0], f->rk4[2], 2.7);
    rate(b, "RK4, one lane, million steps/s", f->rk4[0], 2.8);
    rate(b, "RK4, the widest lanes, million steps/s", f->rk4[widest], 15);
    rate(b, "inverse dynamics in lanes, million/s", f->inverse[widest], 35);
    ratio(b, "a run to 1e-9 against GSL rk8pd, our right-hand side, times", f->gsl[0][2],
          f->alone[2], 1.2);
    ratio(b, "a run to 1e-9 against GSL rk8pd, by hand, times", f->gsl[1][2], f->alone[2], 1.2);
    ratio(b, "a run to 1e-9 against CVODE Adams, our right-hand side, times", f->cvode[0][2],
          f->alone[2], 8);
    ratio(b, "a run to 1e-9 against CVODE Adams, by hand, times", f->cvode[1][2], f->alone[2], 8);
    ratio(b, "a run to 1e-9 against MuJoCo's tendons, times", f->mujoco[2], f->alone[2], 1000);
    rate(b, "right-hand side with heavy legs, one lane, million/s", f->heavy_rates[0], 1e3 / 350);
    rate(b, "right-hand side with heavy legs, 8 lanes, million/s", f->heavy_rates[3], 1e3 / 60);
    rate(b, "RK4 with heavy legs, one lane, million steps/s", f->heavy_rk4[0], 0.7);
    rate(b, "RK4 with heavy legs, the widest lanes, million steps/s", f->heavy_rk4[widest], 3.5);
    ratio(b, "RK4 steps with heavy legs in lanes against MuJoCo's legs, times", f->mujoco_legs,
          f->heavy_rk4[widest], 120);
    claim(b, "runs to 1e-9 in lanes, a ms", 1e-3 / f->lanes[2].median, 1e-3 / f->lanes[2].quietest,
          2);
    claim(b, "two threads against one, times", f->threads, f->threads, 1.9);
    claim(b, "points of a stability map, 80000 in a minute, points/s", f->map, f->map,
          80000.0 / 60);
}

const bench_section section_claims = {"claims", 0, prepare, report};
