/* The writer's own share of the runs: a thread of its process runs one block at a time, while the process sends and writes. */
#ifndef GOUGH_CLI_MPI_OWN_RUNS_H
#define GOUGH_CLI_MPI_OWN_RUNS_H

#include <pthread.h>

#include "cli/mpi/mpi_messages.h"

typedef struct own_runs {
    const gough_sweep *sweep;
    gough_sweep_options options;
    pthread_t thread;
    pthread_mutex_t lock;
    pthread_cond_t moved;
    bool started; /* the thread is there */
    bool asked, stop,
        leave; /* a block waits or is being run; it is not wanted; the thread shall end */
    mpi_block block;
    gough_outcome *outcome; /* room for a block, the caller's */
    size_t count;           /* outcomes there */
    gough_status status;
    gough_error error;
} own_runs;

/* Starts the thread; without it the other processes run everything. */
void own_runs_start(own_runs *own, const gough_sweep *sweep, const gough_sweep_options *options);

void own_runs_ask(own_runs *own, mpi_block block, gough_outcome *outcome);

/* Whether the block asked for is finished, with how many outcomes; fewer only if it was stopped or failed. */
bool own_runs_finished(own_runs *own, size_t *count, gough_status *status, gough_error *error);

void own_runs_stop(own_runs *own);

/* Ends the thread, which has no block any more. */
void own_runs_end(own_runs *own);

#endif
