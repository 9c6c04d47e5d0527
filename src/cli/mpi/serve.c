/* A process of gough-mpi that is not the writer: it takes a job, makes the same sweep of it, and runs the blocks that it gets. */
#define _GNU_SOURCE
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/mpi/mpi_messages.h"

/* The outcomes of a block, as the sweep passes them on. */
typedef struct collected {
    gough_outcome *outcome;
    size_t count;
    bool stopped; /* by the writer */
} collected;

static int collect(void *context, const gough_sweep_row *row) {
    collected *c = context;
    c->outcome[c->count++] = row->outcome;
    return 0;
}

static int look(void *context, size_t done) {
    collected *c = context;
    (void)done;
    c->stopped = mpi_waits(WRITER, TAG_STOP);
    return c->stopped;
}

static void run_block(const gough_sweep *sweep, const gough_sweep_options *options,
                      mpi_answer *answer) {
    mpi_block block;
    mpi_receive(WRITER, TAG_BLOCK, &block, sizeof block);
    collected c = {calloc(block.count, sizeof *c.outcome), 0, false};
    gough_sweep_options own = *options;
    own.first = block.first;
    own.last = block.first + block.count - 1;
    own.progress = look;
    own.context = &c;
    answer->error.message[0] = '\0';
    answer->status = c.outcome ? gough_sweep_run(sweep, &own, collect, &c, &answer->error)
                               : gough_fail(&answer->error, GOUGH_ERROR_FILE, "out of memory");
    if (answer->status != GOUGH_OK && !c.stopped)
        mpi_send(WRITER, TAG_FAILED, answer, sizeof *answer);
    else
        mpi_send(WRITER, TAG_OUTCOMES, c.outcome,
                 answer->status == GOUGH_OK ? c.count * sizeof *c.outcome : 0);
    free(c.outcome);
}

/* Makes the sweep of a job and says whether it is the writer's. */
static gough_sweep *take_job(size_t length, int threads, gough_sweep_options *options,
                             mpi_answer *answer) {
    gough_sweep *sweep = NULL;
    void *bytes = malloc(length);
    if (bytes == NULL) abort(); /* the message could not even be received */
    mpi_receive(WRITER, TAG_JOB, bytes, length);
    *answer = (mpi_answer){.error = {.message = ""}};
    (void)gethostname(answer->machine, sizeof answer->machine - 1);
    answer->status = mpi_job_take(bytes, length, &sweep, options, &answer->error);
    free(bytes);
    if (options->threads == 0) options->threads = threads;
    if (answer->status == GOUGH_OK) answer->identity = gough_sweep_identity(sweep, options);
    answer->lanes = options->lanes ? options->lanes : gough_batch_lanes();
    answer->threads = options->threads;
    mpi_send(WRITER, TAG_READY, answer, sizeof *answer);
    return sweep;
}

void mpi_serve(int threads) {
    gough_sweep *sweep = NULL;
    gough_sweep_options options;
    mpi_answer answer;
    for (;;) {
        int sender;
        size_t length;
        switch (mpi_await(WRITER, &sender, &length)) {
        case TAG_JOB:
            gough_sweep_free(sweep);
            sweep = take_job(length, threads, &options, &answer);
            break;
        case TAG_BLOCK:
            run_block(sweep, &options, &answer);
            break;
        case TAG_STOP:
            mpi_receive(WRITER, TAG_STOP, NULL, 0);
            break;
        default:
            mpi_receive(WRITER, TAG_END, NULL, 0);
            gough_sweep_free(sweep);
            return;
        }
    }
}
