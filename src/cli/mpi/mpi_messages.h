/* What the processes of gough-mpi send each other. Process 0, the writer, sends a job, then blocks of runs; the others answer with
 * their outcomes. All processes run the same program on machines of one kind, so that structs go as they are. */
#ifndef GOUGH_CLI_MPI_MESSAGES_H
#define GOUGH_CLI_MPI_MESSAGES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "gough/gough.h"

enum {
    WRITER = 0, /* rank of the process that writes */
    /* tags, from the writer */
    TAG_JOB = 1, /* bytes of mpi_job_pack() */
    TAG_BLOCK,   /* mpi_block */
    TAG_STOP,    /* nothing: what is being run is not wanted */
    TAG_END,     /* nothing: there is no further job */
    /* and to it */
    TAG_READY,    /* mpi_answer: the job is understood, or is not */
    TAG_OUTCOMES, /* the outcomes of the block, in order of the runs; none: it was stopped */
    TAG_FAILED    /* mpi_answer: why the block could not be run */
};

/* Runs first … first + count − 1. */
typedef struct mpi_block {
    uint64_t first, count;
} mpi_block;

typedef struct mpi_answer {
    gough_status status;
    int lanes, threads; /* with which it runs */
    uint64_t identity;  /* gough_sweep_identity() */
    char machine[64];
    gough_error error;
} mpi_answer;

/* Seconds of a clock that only moves on. */
double mpi_seconds(void);

/* Waits a moment without using the processor. */
void mpi_rest(void);

/* Waits for a message of this rank (negative: of any) and returns its tag; its sender and length in bytes. */
int mpi_await(int rank, int *sender, size_t *length);

/* Whether a message of this rank with this tag waits to be received. */
bool mpi_waits(int rank, int tag);

void mpi_send(int rank, int tag, const void *bytes, size_t length);
void mpi_receive(int rank, int tag, void *bytes, size_t length);

/* Threads for one process, if the user has not chosen: its share of the processors of its machine. Called by all processes at
 * once. */
int mpi_threads(void);

/* ---- a job: a sweep and how to run it ---- */

/* The bytes of a job, to be freed; NULL if out of memory. */
void *mpi_job_pack(const gough_sweep *sweep, const gough_sweep_options *options, size_t *length);

/* A sweep of these bytes; what is wrong goes into the error. */
gough_status mpi_job_take(const void *bytes, size_t length, gough_sweep **sweep,
                          gough_sweep_options *options, gough_error *error);

/* The life of every process but the writer: jobs, until there is no further one. */
void mpi_serve(int threads);

#endif
