/* What the sections of the program share. Each registers what it wants timed, all is timed together, each writes its rows. */
#ifndef BENCH_BENCH_H
#define BENCH_BENCH_H

#include "bench/kernels.h"
#include "bench/measure.h"
#include "bench/reference.h"
#include "bench/table.h"

enum { WIDTHS = 4, TARGETS = 4 };

/* figures that the claims are about; NaN where they were not measured */
typedef struct {
    timing rk4[WIDTHS];     /* a step of a run, by gough_batch() on one thread */
    timing inverse[WIDTHS]; /* inverse dynamics, a run */
    timing heavy_rk4[WIDTHS],
        heavy_rates[WIDTHS]; /* a step, and a right-hand side, where legs have mass */
    double peak_share[WIDTHS];
    timing alone[TARGETS];                     /* a run of adaptive dop853 to the targets */
    timing lanes[TARGETS];                     /* a run of fixed dop853 in the widest lanes */
    timing gsl[2][TARGETS], cvode[2][TARGETS]; /* on our right-hand side, and on one by hand */
    timing mujoco[TARGETS];
    timing mujoco_step, mujoco_legs, mujoco_inverse; /* legs: with mass */
    double threads;                                  /* two against one */
    double map; /* points of a stability map in a second, on two threads */
} figures;

typedef struct {
    bool quick, json;
    const char *only;     /* the one section that is wanted, or NULL */
    const char *command;  /* the command gough, or NULL */
    reference ref, heavy; /* legs without and with mass */
    measure time;
    table out;
    figures figures;
} bench;

typedef struct {
    const char *name;
    size_t size; /* of the section's own memory, zeroed, aligned to 64 */
    void (*prepare)(bench *b, void *own);
    void (*report)(bench *b, void *own);
} bench_section;

extern const bench_section section_kernels, section_steps, section_loop, section_precision,
    section_threads, section_map, section_pose, section_workspace, section_process, section_claims;
#if defined(BENCH_PEERS)
extern const bench_section section_mujoco, section_solvers;
#endif

/* 1, 2, 4, 8 */
int bench_lanes(int width);
void *bench_memory(size_t size); /* aligned to 64, zeroed; kept to the program's end */
void bench_fail(const char *sentence);

/* targets of error in the final pose: 1e-3, 1e-6, 1e-9, 1e-12 */
double bench_target(int target);

/* Least effort (steps, or one over a tolerance) at which the error is at most `target`: doubled from `first` on up to `most`,
 * then halved in between; NaN if there is none. `known` is an effort that was too small, or 0. */
double bench_effort(double (*error)(void *context, double effort), void *context, double first,
                    double most, double target);

#endif
