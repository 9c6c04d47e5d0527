/* The program gough-mpi: the processes that mpirun started run the runs of a sweep. Process 0, the writer, is the command `gough`
 * with its one file. It gives each process a block of consecutive runs whenever that process is free, larger ones to faster
 * processes and smaller ones towards the end, and passes the outcomes on in order of the runs. Blocks beyond the first unfinished
 * one are kept in memory, within bounds. */
#define _GNU_SOURCE
#include <math.h>
#include <mpi.h>
#include <stdlib.h>
#include <string.h>

#include "cli/mpi/own_runs.h"
#include "cli/sweep/sweep_crew.h"

enum {
    MOST_BLOCK = 1 << 14, /* runs of a block */
    AHEAD = 1 << 18,      /* runs beyond the first unfinished one, at most: about 80 MB */
    SLOTS = 1 << 14       /* blocks that are handed out and not yet passed on */
};
static const double BLOCK_TIME = 0.5, LOOK_EVERY = 0.1; /* seconds */

/* What this process knows of the others, from the beginning of the program to its end. */
static struct { int processes, threads; } world;

typedef struct slot {
    mpi_block block;
    gough_outcome *outcome;
    bool ready;
} slot;

/* One process, as the writer sees it. */
typedef struct hand {
    bool here; /* it has the job */
    bool busy; /* with the block of this slot */
    size_t slot;
    int lanes, threads;
    double since, rate; /* when it got the block; runs a second of the latest one, 0: unknown */
} hand;

typedef struct writer {
    const gough_sweep *sweep;
    const gough_sweep_options *options;
    gough_sweep_sink sink;
    void *sink_context;
    uint64_t identity;
    hand *hand; /* by rank; that of rank 0 is the own thread */
    own_runs own;
    slot *slot; /* a ring: numbers oldest … newest − 1 */
    size_t oldest, newest;
    size_t next, last; /* the next run to hand out, the last of the sweep */
    size_t done;       /* runs finished, passed on or not */
    double *value;
    gough_status status; /* other than GOUGH_OK: nothing more is handed out */
    gough_error error;
} writer;

static slot *slot_at(const writer *w, size_t number) { return &w->slot[number % SLOTS]; }

static void stop(writer *w, gough_status status, const char *sentence) {
    if (w->status != GOUGH_OK) return;
    w->status = gough_fail(&w->error, status, "%s", sentence);
    for (int rank = 1; rank < world.processes; rank++)
        if (w->hand[rank].busy) mpi_send(rank, TAG_STOP, NULL, 0);
    own_runs_stop(&w->own);
}

/* ---- handing out ------------------------------------------------------------------------------------------------- */

/* Whole lanes, about half a second, and towards the end no more than that all finish together. */
static size_t block_size(const writer *w, const hand *h) {
    const size_t lanes = (size_t)h->lanes, left = w->last + 1 - w->next;
    const size_t share = left / (2 * (size_t)world.processes);
    const size_t most = AHEAD / (2 * (size_t)world.processes);
    size_t size = lanes * (size_t)h->threads;
    if (h->rate > 0) size = (size_t)fmin(h->rate * BLOCK_TIME, MOST_BLOCK);
    if (size > most) size = most;
    if (size > share) size = share;
    size = (size + lanes - 1) / lanes * lanes;
    if (size == 0) size = lanes;
    return size < left ? size : left;
}

static void hand_out(writer *w, int rank) {
    hand *h = &w->hand[rank];
    if (rank == WRITER && !w->own.started) return; /* the others run everything */
    if (!h->here || h->busy || w->status != GOUGH_OK || w->next > w->last) return;
    if (w->newest - w->oldest == SLOTS) return;
    if (w->newest > w->oldest && w->next - slot_at(w, w->oldest)->block.first > AHEAD) return;
    slot *s = slot_at(w, w->newest);
    *s = (slot){.block = {w->next, block_size(w, h)}};
    s->outcome = calloc(s->block.count, sizeof *s->outcome);
    if (s->outcome == NULL) {
        stop(w, GOUGH_ERROR_FILE, "out of memory");
        return;
    }
    h->busy = true;
    h->slot = w->newest++;
    h->since = mpi_seconds();
    w->next += s->block.count;
    if (rank == WRITER)
        own_runs_ask(&w->own, s->block, s->outcome);
    else
        mpi_send(rank, TAG_BLOCK, &s->block, sizeof s->block);
}

/* ---- taking back ------------------------------------------------------------------------------------------------- */

static void finish_block(writer *w, hand *h, size_t count) {
    slot *s = slot_at(w, h->slot);
    const double time = mpi_seconds() - h->since;
    h->busy = false;
    s->ready = count == s->block.count;
    if (!s->ready) return; /* it was stopped, or has failed */
    w->done += count;
    h->rate = (double)count / fmax(time, 1e-6);
}

/* Its own sentence, where a process other than the writer has one. */
static void fail_at(writer *w, int rank, const mpi_answer *answer) {
    gough_error error;
    gough_fail(&error, answer->status, "process %d on %s: %s", rank, answer->machine,
               answer->error.message);
    stop(w, answer->status, error.message);
}

static void welcome(writer *w, int rank) {
    mpi_answer answer;
    mpi_receive(rank, TAG_READY, &answer, sizeof answer);
    hand *h = &w->hand[rank];
    h->here = true;
    h->lanes = answer.lanes;
    h->threads = answer.threads;
    if (answer.status != GOUGH_OK) {
        fail_at(w, rank, &answer);
    } else if (answer.identity != w->identity) {
        gough_fail(&answer.error, GOUGH_ERROR_INPUT,
                   "this study has other numbers here than in process 0: its recorded motion, the "
                   "build of gough or the C library differs");
        answer.status = GOUGH_ERROR_INPUT;
        fail_at(w, rank, &answer);
    }
}

/* Takes one message, if there is one. */
static bool take_message(writer *w) {
    int rank;
    size_t length;
    mpi_answer answer;
    if (world.processes == 1 || !mpi_waits(-1, -1)) return false;
    const int tag = mpi_await(-1, &rank, &length);
    hand *h = &w->hand[rank];
    if (tag == TAG_READY) {
        welcome(w, rank);
    } else if (tag == TAG_FAILED) {
        mpi_receive(rank, TAG_FAILED, &answer, sizeof answer);
        finish_block(w, h, 0);
        fail_at(w, rank, &answer);
    } else {
        mpi_receive(rank, TAG_OUTCOMES, slot_at(w, h->slot)->outcome, length);
        finish_block(w, h, length / sizeof(gough_outcome));
    }
    return true;
}

static bool take_own(writer *w) {
    hand *h = &w->hand[WRITER];
    size_t count;
    gough_status status;
    gough_error error;
    if (!h->busy || !own_runs_finished(&w->own, &count, &status, &error)) return false;
    finish_block(w, h, status == GOUGH_OK ? count : 0);
    if (status != GOUGH_OK) stop(w, status, error.message);
    return true;
}

/* Passes on what is next in order. */
static bool pass_on(writer *w) {
    bool any = false;
    for (; w->oldest < w->newest && slot_at(w, w->oldest)->ready && w->status == GOUGH_OK;
         w->oldest++) {
        slot *s = slot_at(w, w->oldest);
        for (size_t i = 0; i < s->block.count && w->status == GOUGH_OK; i++) {
            gough_sweep_values(w->sweep, s->block.first + i, w->value);
            const gough_sweep_row row = {s->block.first + i, w->value, s->outcome[i]};
            if (w->sink(w->sink_context, &row))
                stop(w, GOUGH_ERROR_NUMERICAL, "the sweep was stopped");
        }
        free(s->outcome);
        s->outcome = NULL;
        any = true;
    }
    return any;
}

/* ---- a sweep ----------------------------------------------------------------------------------------------------- */

/* Whether a process still has something to say. */
static bool anyone_busy(const writer *w) {
    for (int rank = 0; rank < world.processes; rank++)
        if (w->hand[rank].busy || !w->hand[rank].here) return true;
    return false;
}

static void run_all(writer *w) {
    double looked = 0;
    while (w->status == GOUGH_OK ? w->oldest < w->newest || w->next <= w->last || anyone_busy(w)
                                 : anyone_busy(w)) {
        for (int rank = 0; rank < world.processes; rank++) hand_out(w, rank);
        bool moved = take_own(w);
        while (take_message(w)) moved = true;
        moved = pass_on(w) || moved;
        const double now = mpi_seconds();
        if (now - looked > LOOK_EVERY && w->options->progress) {
            looked = now;
            if (w->options->progress(w->options->context, w->done))
                stop(w, GOUGH_ERROR_NUMERICAL, "the sweep was stopped");
        }
        if (!moved) mpi_rest();
    }
}

static bool send_jobs(const writer *w, const gough_sweep_options *options) {
    size_t length;
    void *bytes = mpi_job_pack(w->sweep, options, &length);
    for (int rank = 1; bytes && rank < world.processes; rank++)
        mpi_send(rank, TAG_JOB, bytes, length);
    free(bytes);
    return bytes != NULL;
}

static gough_status run(void *context, const gough_sweep *sweep, const gough_sweep_options *options,
                        gough_sweep_sink sink, void *sink_context, gough_error *error) {
    (void)context;
    gough_sweep_options own = *options;
    size_t keys;
    gough_sweep_keys(sweep, &keys);
    if (own.threads == 0) own.threads = world.threads;
    if (world.processes == 1) return gough_sweep_run(sweep, &own, sink, sink_context, error);
    writer w = {.sweep = sweep,
                .options = options,
                .sink = sink,
                .sink_context = sink_context,
                .identity = gough_sweep_identity(sweep, options),
                .hand = calloc((size_t)world.processes, sizeof *w.hand),
                .slot = calloc(SLOTS, sizeof *w.slot),
                .next = options->first,
                .last = options->last,
                .value = calloc(keys, sizeof *w.value)};
    if (w.hand && w.slot && w.value && w.identity && send_jobs(&w, options)) {
        own_runs_start(&w.own, sweep, &own);
        w.hand[WRITER] = (hand){.here = true,
                                .lanes = own.lanes ? own.lanes : gough_batch_lanes(),
                                .threads = own.threads};
        run_all(&w);
        own_runs_end(&w.own);
    } else {
        w.status = gough_fail(&w.error, GOUGH_ERROR_FILE, "out of memory");
    }
    for (size_t n = w.oldest; n < w.newest; n++) free(slot_at(&w, n)->outcome);
    free(w.hand);
    free(w.slot);
    free(w.value);
    return w.status == GOUGH_OK ? GOUGH_OK : gough_fail(error, w.status, "%s", w.error.message);
}

/* ---- the program ------------------------------------------------------------------------------------------------- */

/* However the writer ends, the others end too. */
static void end_all(void) {
    for (int rank = 1; rank < world.processes; rank++) mpi_send(rank, TAG_END, NULL, 0);
    MPI_Finalize();
}

static void begin(int *count, char ***argument) {
    int given, rank;
    MPI_Init_thread(count, argument, MPI_THREAD_FUNNELED, &given);
    MPI_Comm_size(MPI_COMM_WORLD, &world.processes);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    world.threads = mpi_threads();
    if (rank == WRITER) {
        atexit(end_all);
        return;
    }
    mpi_serve(world.threads);
    MPI_Finalize();
    exit(0);
}

const sweep_crew the_crew = {
    .command = "gough-mpi",
    .only = "sweep",
    .text = "Run `gough sweep` on all processes that mpirun starts.\n\n"
            "  mpirun -n 64 gough-mpi sweep STUDY -o FILE\n\n"
            "The file has the same bytes as that of `gough sweep`; 'gough-mpi sweep --help' "
            "describes the options, which are the same.\v"
            "Each process reads recorded motion by itself, by the path that the study gives. "
            "Process 0 reads the study, writes FILE and runs its share.",
    .begin = begin,
    .run = run};
