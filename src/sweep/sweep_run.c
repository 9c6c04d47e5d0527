/* Running a sweep: threads take pieces of consecutive runs, make their studies, batch those that share a program, and hand the
 * outcomes to the caller's thread, which passes them on in order. A window bounds how far threads run ahead, so that memory
 * does not depend on the number of runs. */
#define _GNU_SOURCE
#include "gough/sweep.h"

#include <errno.h>
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/crew.h"
#include "gough/sizes.h"

enum {
    MOST_PIECE = 256,     /* runs: what a thread's batch walks together in lanes of 8 */
    AHEAD = 4,            /* pieces for each thread in the window */
    PATIENCE = 100000000, /* ns between two looks at whether to stop */
};
static const double PIECE_STEPS = 1e7; /* steps of a piece: about half a second */

typedef struct piece {
    size_t number; /* from 0; which of the pieces stands in this place of the window */
    bool ready;
    gough_outcome outcome[MOST_PIECE];
} piece;

typedef struct workers {
    const gough_sweep *sweep;
    const gough_sweep_options *options;
    size_t first, last, size, pieces, window;
    pthread_mutex_t lock;
    pthread_cond_t moved;
    size_t taken, written; /* pieces */
    size_t runs_done;      /* counts runs of pieces that are not ready too */
    piece *piece;
    bool stopped;
    gough_status status;
    gough_error error;
} workers;

/* What one thread needs; parts that the sweep touches have room for each run of a piece. */
typedef struct hand {
    workers *all;
    gough_sweep_maker *maker;
    gough_machine *machine;
    gough_control *control;
    gough_disturbance *disturbance;
    gough_initial *initial;
    gough_batch_run run[MOST_PIECE];
    size_t order[MOST_PIECE];
    gough_outcome outcome[MOST_PIECE]; /* of a batch */
    double *value;                     /* of all runs of a piece */
    void *memory;
} hand;

gough_status gough_sweep_options_init(gough_sweep_options *options, size_t size) {
    if (size != sizeof *options) return gough_size_refuse(options, size);
    *options = (gough_sweep_options){.size = size};
    return GOUGH_OK;
}

/* ---- the runs of a piece ----------------------------------------------------------------------------------------- */

static const unsigned OF_A_KIND =
    GOUGH_SWEEP_HEIGHT | GOUGH_SWEEP_MOTION | GOUGH_SWEEP_SIMULATION | GOUGH_SWEEP_EXTERNAL;

/* Whether two runs share program, home, options and external loads, which the maker keeps in one place, and so can stand in one
 * batch. */
static bool same_kind(const hand *h, size_t a, size_t b) {
    size_t keys;
    gough_sweep_keys(h->all->sweep, &keys);
    for (size_t k = 0; k < keys; k++) {
        const double x = h->value[a * keys + k], y = h->value[b * keys + k];
        if (gough_sweep_touches(h->all->sweep, k) & OF_A_KIND && (x < y || x > y)) return false;
    }
    return true;
}

/* Lists the runs by kinds, each kind's in their order; its first run leads. */
static void order_by_kind(hand *h, size_t count) {
    bool listed[MOST_PIECE] = {false};
    size_t used = 0;
    const bool kinds = (gough_sweep_touches(h->all->sweep, (size_t)-1) & OF_A_KIND) != 0;
    for (size_t i = 0; i < count; i++) {
        if (listed[i]) continue;
        for (size_t k = i; k < count; k++) {
            if (listed[k] || (kinds && !same_kind(h, i, k))) continue;
            listed[k] = true;
            h->order[used++] = k;
        }
    }
}

/* The run's own parts; what the sweep does not touch is the maker's, the same for all. */
static void keep_run(hand *h, const gough_study *study, size_t number, size_t n) {
    const gough_model *model = study->model;
    h->run[n] = (gough_batch_run){&model->machine,
                                  &model->control,
                                  &model->disturbance,
                                  &model->initial,
                                  gough_sweep_noise_run(study, number),
                                  gough_sweep_sampling_run(study, number)};
    if (h->machine) {
        h->machine[n] = model->machine;
        h->run[n].machine = &h->machine[n];
    }
    if (h->control) {
        h->control[n] = model->control;
        h->run[n].control = &h->control[n];
    }
    if (h->disturbance) {
        h->disturbance[n] = model->disturbance;
        h->run[n].disturbance = &h->disturbance[n];
    }
    if (h->initial) {
        h->initial[n] = model->initial;
        h->run[n].initial = &h->initial[n];
    }
}

static int look(void *context, size_t done) {
    (void)done;
    workers *c = context;
    pthread_mutex_lock(&c->lock);
    const bool stopped = c->stopped;
    pthread_mutex_unlock(&c->lock);
    return stopped;
}

static gough_status run_batch(hand *h, const gough_study *study, const size_t *which, size_t count,
                              gough_outcome *outcome, gough_error *error) {
    const gough_batch_options options = {.lanes = h->all->options->lanes,
                                         .threads = 1,
                                         .sizing = h->all->options->sizing,
                                         .forces = h->all->options->forces,
                                         .progress = look,
                                         .context = h->all};
    const gough_status status = gough_batch(&study->model->motion, &study->simulation, h->run,
                                            count, &options, h->outcome, h->memory, error);
    for (size_t i = 0; i < count; i++) outcome[which[i]] = h->outcome[i];
    return status;
}

/* Makes and runs the runs order[begin] … of one kind; returns one past the last in *end. */
static gough_status run_kind(hand *h, size_t first, size_t begin, size_t count, size_t *end,
                             gough_outcome *outcome, gough_error *error) {
    const gough_study *study = NULL, *good = NULL;
    size_t which[MOST_PIECE], made = 0, at = begin;
    for (; at < count && same_kind(h, h->order[begin], h->order[at]); at++) {
        const size_t run = h->order[at];
        const gough_status status = gough_sweep_make(h->maker, first + run, &study, error);
        if (status == GOUGH_ERROR_FILE) return status;
        if (status != GOUGH_OK) {
            outcome[run] = (gough_outcome){.cause = GOUGH_END_INVALID, .time = NAN};
            continue;
        }
        good = study;
        which[made] = run;
        keep_run(h, study, first + run, made++);
    }
    *end = at;
    /* a run that failed after the last good one has left the maker's parts half made: the program once more */
    if (made > 0 && made < at - begin)
        (void)gough_sweep_make(h->maker, first + which[made - 1], &good, error);
    return made > 0 ? run_batch(h, good, which, made, outcome, error) : GOUGH_OK;
}

static gough_status run_piece(hand *h, size_t first, size_t count, gough_outcome *outcome,
                              gough_error *error) {
    size_t keys;
    gough_sweep_keys(h->all->sweep, &keys);
    for (size_t i = 0; i < count; i++)
        gough_sweep_values(h->all->sweep, first + i, &h->value[i * keys]);
    order_by_kind(h, count);
    gough_status status = GOUGH_OK;
    for (size_t at = 0; at < count && status == GOUGH_OK;)
        status = run_kind(h, first, at, count, &at, outcome, error);
    return status;
}

/* ---- threads ----------------------------------------------------------------------------------------------------- */

static size_t first_of(const workers *c, size_t number) { return c->first + number * c->size; }

static size_t count_of(const workers *c, size_t number) {
    const size_t left = c->last + 1 - first_of(c, number);
    return left < c->size ? left : c->size;
}

/* The next piece to run, when there is room for it in the window; whether there is one. */
static bool take_piece(workers *c, size_t *number) {
    while (!c->stopped && c->taken < c->pieces && c->taken >= c->written + c->window)
        pthread_cond_wait(&c->moved, &c->lock);
    if (c->stopped || c->taken == c->pieces) return false;
    *number = c->taken++;
    return true;
}

static void *work(void *context) {
    hand *h = context;
    workers *c = h->all;
    size_t number = 0;
    pthread_mutex_lock(&c->lock);
    while (take_piece(c, &number)) {
        piece *p = &c->piece[number % c->window];
        gough_error error = {.message = ""};
        pthread_mutex_unlock(&c->lock);
        const gough_status status =
            run_piece(h, first_of(c, number), count_of(c, number), p->outcome, &error);
        pthread_mutex_lock(&c->lock);
        if (status != GOUGH_OK && !c->stopped) {
            c->stopped = true;
            c->status = status;
            c->error = error;
        }
        p->number = number;
        p->ready = status == GOUGH_OK;
        c->runs_done += p->ready ? count_of(c, number) : 0;
        pthread_cond_broadcast(&c->moved);
    }
    pthread_mutex_unlock(&c->lock);
    return NULL;
}

/* Waits for a piece, or for some time; whether it is ready. Called with the lock. */
static bool await(workers *c, size_t number) {
    const piece *p = &c->piece[number % c->window];
    struct timespec until;
    clock_gettime(CLOCK_MONOTONIC, &until);
    until.tv_nsec += PATIENCE;
    until.tv_sec += until.tv_nsec / 1000000000;
    until.tv_nsec %= 1000000000;
    while (!c->stopped && !(p->ready && p->number == number))
        if (pthread_cond_clockwait(&c->moved, &c->lock, CLOCK_MONOTONIC, &until) == ETIMEDOUT)
            break;
    return p->ready && p->number == number;
}

static bool hand_over(workers *c, size_t number, double *value, gough_sweep_sink sink,
                      void *context) {
    const piece *p = &c->piece[number % c->window];
    for (size_t i = 0; i < count_of(c, number); i++) {
        const size_t run = first_of(c, number) + i;
        gough_sweep_values(c->sweep, run, value);
        const gough_sweep_row row = {run, value, p->outcome[i]};
        if (sink(context, &row)) return false;
    }
    return true;
}

/* The caller's part: rows in order, and a look now and then at whether to stop. */
static void pass_on(workers *c, double *value, gough_sweep_sink sink, void *context) {
    pthread_mutex_lock(&c->lock);
    while (c->written < c->pieces) {
        const bool ready = await(c, c->written);
        if (c->stopped) break;
        const size_t done = c->runs_done;
        pthread_mutex_unlock(&c->lock);
        bool stop = ready && !hand_over(c, c->written, value, sink, context);
        if (!stop && c->options->progress)
            stop = c->options->progress(c->options->context, done) != 0;
        pthread_mutex_lock(&c->lock);
        if (stop && !c->stopped) {
            c->stopped = true;
            c->status = gough_fail(&c->error, GOUGH_ERROR_NUMERICAL, "the sweep was stopped");
        }
        if (ready) {
            c->piece[c->written % c->window].ready = false;
            c->written++;
        }
        pthread_cond_broadcast(&c->moved);
    }
    pthread_mutex_unlock(&c->lock);
}

/* ---- beginning and end ------------------------------------------------------------------------------------------- */

static void release_hand(hand *h) {
    gough_sweep_maker_free(h->maker);
    free(h->machine);
    free(h->control);
    free(h->disturbance);
    free(h->initial);
    free(h->value);
    free(h->memory);
}

static bool equip_hand(hand *h, workers *c) {
    const gough_batch_options options = {.lanes = c->options->lanes, .threads = 1};
    const unsigned touches = gough_sweep_touches(c->sweep, (size_t)-1);
    const size_t runs = c->size, size = (gough_batch_size(&options) + 63) / 64 * 64;
    size_t keys;
    gough_sweep_keys(c->sweep, &keys);
    h->all = c;
    h->maker = gough_sweep_maker_new(c->sweep);
    h->memory = aligned_alloc(64, size);
    h->value = calloc(runs * keys, sizeof *h->value);
    bool good = h->maker && h->memory && h->value;
    if (touches & GOUGH_SWEEP_MACHINE)
        good = (h->machine = calloc(runs, sizeof *h->machine)) != NULL && good;
    if (touches & GOUGH_SWEEP_CONTROL)
        good = (h->control = calloc(runs, sizeof *h->control)) != NULL && good;
    if (touches & GOUGH_SWEEP_DISTURBANCE)
        good = (h->disturbance = calloc(runs, sizeof *h->disturbance)) != NULL && good;
    if (touches & GOUGH_SWEEP_INITIAL)
        good = (h->initial = calloc(runs, sizeof *h->initial)) != NULL && good;
    return good;
}

/* Runs of a piece: whole lanes, work for every thread, about half a second; adaptive runs go one by one. */
static size_t piece_size(const workers *c, int threads) {
    const gough_simulation *s = &gough_sweep_study(c->sweep)->simulation;
    const size_t lanes = (size_t)(c->options->lanes > 0 ? c->options->lanes : gough_batch_lanes());
    if (!(s->step > 0) || c->options->forces) return 1;
    const size_t runs = c->last + 1 - c->first;
    const double steps = fmax(s->duration / s->step, 1);
    double size = fmin(MOST_PIECE, PIECE_STEPS / steps);
    size = fmin(size, (double)runs / (2.0 * threads));
    const size_t groups = (size_t)(size / (double)lanes);
    return (groups > 0 ? groups : 1) * lanes;
}

static gough_status start(workers *c, hand *hands, int threads, double *value,
                          gough_sweep_sink sink, void *context) {
    crew hired;
    int equipped = 0;
    while (equipped < threads && equip_hand(&hands[equipped], c)) equipped++;
    if (crew_start(&hired, hands, sizeof *hands, equipped, work) > 0)
        pass_on(c, value, sink, context);
    else
        c->status = gough_fail(&c->error, GOUGH_ERROR_FILE, "no thread could be started");
    crew_join(&hired);
    for (int i = 0; i < threads; i++) release_hand(&hands[i]);
    return c->status;
}

static gough_status check_lanes(const gough_sweep_options *options, gough_error *error) {
    const int lanes = options->lanes, widest = gough_batch_lanes();
    const bool known = lanes == 0 || lanes == 1 || lanes == 2 || lanes == 4 || lanes == 8;
    if (known && lanes <= widest) return GOUGH_OK;
    return gough_fail(error, GOUGH_ERROR_INPUT,
                      "%d lanes are not possible: this processor runs 1%s%s or %d side by side",
                      lanes, widest > 2 ? ", 2" : "", widest > 4 ? ", 4" : "", widest);
}

gough_status gough_sweep_run(const gough_sweep *sweep, const gough_sweep_options *options,
                             gough_sweep_sink sink, void *context, gough_error *error) {
    const int threads = gough_batch_threads(options->threads);
    workers c = {.sweep = sweep,
                 .options = options,
                 .first = options->first ? options->first : 1,
                 .last = options->last ? options->last : gough_sweep_runs(sweep)};
    if (gough_size_check(options->size, sizeof(gough_sweep_options), "gough_sweep_options",
                         error) != GOUGH_OK)
        return GOUGH_ERROR_INPUT;
    if (c.last > gough_sweep_runs(sweep) || c.first > c.last + 1)
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "there are no runs %zu to %zu in a sweep of %zu runs", c.first, c.last,
                          gough_sweep_runs(sweep));
    const gough_status checked = check_lanes(options, error);
    if (checked != GOUGH_OK || c.first > c.last) return checked;
    size_t keys;
    gough_sweep_keys(sweep, &keys);
    c.size = piece_size(&c, threads);
    c.pieces = (c.last - c.first) / c.size + 1;
    c.window = AHEAD * (size_t)threads;
    c.piece = calloc(c.window, sizeof *c.piece);
    double *value = calloc(keys, sizeof *value);
    hand *hands = calloc((size_t)threads, sizeof *hands);
    pthread_mutex_init(&c.lock, NULL);
    pthread_cond_init(&c.moved, NULL);
    gough_status status = GOUGH_ERROR_FILE;
    if (c.piece && value && hands)
        status = start(&c, hands, threads, value, sink, context);
    else
        gough_fail(&c.error, status, "out of memory");
    if (status != GOUGH_OK) gough_fail(error, status, "%s", c.error.message);
    pthread_cond_destroy(&c.moved);
    pthread_mutex_destroy(&c.lock);
    free(c.piece);
    free(value);
    free(hands);
    return status;
}
