/* What each width of lanes offers: groups of runs side by side. */
#ifndef GOUGH_BATCH_LANE_RUNS_TABLE_H
#define GOUGH_BATCH_LANE_RUNS_TABLE_H

#include "batch/tape.h"
#include "plant/layout.h"

/* what is common to all runs of a batch */
typedef struct {
    const gough_motion *motion;
    const gough_simulation *simulation;
    const gough_batch_run *runs;
    gough_outcome *outcomes;
    long long steps;   /* fixed steps of a run */
    long long per_row; /* steps from a row to the next */
    int sizing;        /* outcomes have what sizes the legs */
    int forces;        /* inverse dynamics in place of motion */
} batch_job;

struct batch_width {
    int lanes;
    size_t group_size; /* bytes, a multiple of 64 */

    /* puts `count` runs from `first` on into a group; further lanes repeat the last, and their results are ignored */
    void (*begin)(void *group, const batch_job *job, size_t first, int count, stage_tape *tape);

    /* advances a group by the steps `from` … `to` − 1; returns how many of its runs go on */
    int (*advance)(void *group, const batch_job *job, long long from, long long to);

    /* fills the outcomes of the runs that went on to the end */
    void (*finish)(void *group, const batch_job *job);
};

extern const struct batch_width batch_width_1, batch_width_2, batch_width_4, batch_width_8;

/* ---- what one lane does alone, over double: beginnings, ends and last rows (batch_double.c) ---- */

/* the state at t = 0; returns 1 if the run goes on, else 0 with the outcome's end filled. rows: 1 if the first row stands */
int batch_start(const batch_job *job, size_t run, double state[STATE_SIZE], double side[2]);

/* numbers of a look at a run (look.h), and of those that size its legs (sizing.h) */
enum { BATCH_LOOK = 3 * GOUGH_LEGS + 7, BATCH_SIZING = 7 * GOUGH_LEGS };

/* a step that may have broken something, as gough_simulate() would see it; side: signs of the determinants at the beginning */
typedef struct {
    double t0, h, t, residual; /* h: how long it is, t - t0 but for rounding */
    double y0[STATE_SIZE], rate0[STATE_SIZE], raw[STATE_SIZE], side[2];
    double held[GOUGH_LEGS]; /* commands in force, of a sampled controller */

    /* found: when the run ends, and what is seen there if any motion is left to be seen */
    double until, look[BATCH_LOOK], sizing[BATCH_SIZING];
    int looked;
} batch_step;

/* finds the end of a run within a step, fills the outcome's end and looks at it; 0 if the run goes on */
int batch_locate(const batch_job *job, size_t run, batch_step *step);

/* the end of a run whose program has no number for the sample at t, into its outcome */
void batch_unknown(const batch_job *job, size_t run, double t);

/* pose and velocities of the last row, from its state */
void batch_last_row(const batch_job *job, size_t run, const double state[STATE_SIZE]);

/* the least and the greatest power of a leg into an outcome */
void batch_put_power(gough_outcome *outcome, double least, double greatest);

/* one run by the driver of gough_simulate(), for adaptive steps and quadruple precision, or by that of gough_forces() */
void batch_alone(const batch_job *job, size_t run);

/* makes a tape that records with the first run */
size_t batch_recorder_size(void);
void batch_recorder_begin(stage_tape *tape, const batch_job *job, void *recorder);

#endif
