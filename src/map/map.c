/* The stability map for callers: axes, checks, threads. Each thread takes row after row. Theory: docs/theory/floquet.md. */
#include "gough/map.h"

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/crew.h"
#include "base/quantity.h"
#include "gough/batch.h"
#include "gough/sizes.h"
#include "linear/linear.h"
#include "map/map_row.h"
#include "plant/can_move.h"

/* steps are refined up to this; beyond it errors up to the second value pass */
static const double finest = 16, rough = 1e-6;

static const double most_points = 2147483648.0;

gough_status gough_map_options_init(gough_map_options *options, size_t size) {
    if (size != sizeof *options) return gough_size_refuse(options, size);
    *options = (gough_map_options){.size = size, .axis = GOUGH_MAP_NONE, .intervals = 256};
    return GOUGH_OK;
}

const char *gough_interval_kind_name(gough_interval_kind kind) {
    static const char *const name[] = {"static", "resonance +1", "resonance -1", "combination",
                                       "oscillation"};

    return (int)kind >= 0 && (size_t)kind < sizeof name / sizeof *name ? name[kind] : "unknown";
}

double gough_map_value(const gough_map_range *range, size_t i) {
    const double part = range->count > 1 ? (double)i / (double)(range->count - 1) : 0;

    if (i == 0) return range->from;
    if (i + 1 >= range->count) return range->to;
    const double ratio = range->to / range->from;
    if (range->logarithmic && isnormal(ratio)) return range->from * pow(ratio, part);
    if (range->logarithmic) /* more than a double's range apart */
        return exp(log(range->from) * (1 - part) + log(range->to) * part);
    return range->from + part * (range->to - range->from);
}

size_t gough_map_rows(const gough_map_options *options) {
    return options->axis == GOUGH_MAP_NONE ? 1 : options->second.count;
}

/* ---- checks ---- */

static gough_status check_range(const gough_map_range *range, const char *what, const char *mark,
                                bool positive, gough_error *error) {
    if (range->count < 1) {
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "the %s axis of the map has no values: its count is 0", what);
    }
    if (!isfinite(range->from) || !isfinite(range->to) || range->from < 0 ||
        ((positive || range->logarithmic) && !(range->from > 0))) {
        return gough_fail(
            error, GOUGH_ERROR_INPUT,
            "the %s axis of the map goes from %.9g%s to %.9g%s; it must be finite and %s", what,
            range->from, mark, range->to, mark,
            positive || range->logarithmic ? "above 0" : "not below 0");
    }
    if (range->count > 1 && !(range->to > range->from)) {
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "the %s axis of the map goes from %.9g%s to %.9g%s; its end must be "
                          "greater than its start",
                          what, range->from, mark, range->to, mark);
    }
    return GOUGH_OK;
}

static const struct analyse_width *width_of(int lanes) {
    switch (lanes) {
    case 1:
        return &analyse_width_1;
    case 2:
        return &analyse_width_2;
#if defined(__x86_64__)
    case 4:
        return &analyse_width_4;
    case 8:
        return &analyse_width_8;
#endif
    default:
        return NULL;
    }
}

static int threads_of(const gough_map_options *options) {
    const size_t rows = gough_map_rows(options);
    const int threads = crew_threads(options->threads);

    return (size_t)threads < rows ? threads : (int)rows;
}

/* the options with their defaults filled in */
static gough_status check(const gough_map_options *given, gough_map_options *o,
                          gough_error *error) {
    static const char *const second[] = {"",        "amplitude", "frequency",
                                         "damping", "period",    "delay"};
    static const char *const mark[] = {"", "", "", IN_DAMPING, IN_TIME, IN_TIME};
    const int widest = gough_batch_lanes();
    gough_status status =
        gough_size_check(given->size, sizeof(gough_map_options), "gough_map_options", error);

    if (status != GOUGH_OK) return status;
    *o = *given;
    if ((int)o->axis < GOUGH_MAP_NONE || (int)o->axis > GOUGH_MAP_DELAY) {
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "the second axis of the map: %d is neither amplitude nor frequency nor "
                          "damping nor period nor delay",
                          (int)o->axis);
    }
    if (o->modes > (GOUGH_MAP_SWAY | GOUGH_MAP_HEAVE | GOUGH_MAP_TILT | GOUGH_MAP_YAW)) {
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "the modes of the map: %u is no sum of sway 1, heave 2, tilt 4 and yaw 8",
                          o->modes);
    }
    if (o->accuracy <= 0) o->accuracy = 1e-9;
    if (o->resolution <= 0) o->resolution = 1e-6;
    if (o->lanes == 0) o->lanes = widest;
    if (o->stiffness.count == 1) o->stiffness.to = o->stiffness.from;
    if (width_of(o->lanes) == NULL || o->lanes > widest) {
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "%d lanes: this processor can run 1%s%s or %d lanes", o->lanes,
                          widest > 2 ? ", 2" : "", widest > 4 ? ", 4" : "", widest);
    }
    status = check_range(&o->stiffness, "stiffness", IN_STIFFNESS, false, error);
    if (status == GOUGH_OK && o->axis != GOUGH_MAP_NONE)
        status = check_range(&o->second, second[o->axis], mark[o->axis],
                             o->axis == GOUGH_MAP_FREQUENCY || o->axis == GOUGH_MAP_PERIOD, error);
    if (status != GOUGH_OK) return status;
    if (!(o->stiffness.to > 0))
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "the stiffness axis of the map must extend above 0");
    if ((double)o->stiffness.count * (double)gough_map_rows(o) > most_points) {
        return gough_fail(
            error, GOUGH_ERROR_INPUT,
            "a map of %zu × %zu points is too large: at most %.0f points are possible",
            o->stiffness.count, gough_map_rows(o), most_points);
    }
    return GOUGH_OK;
}

/* ---- the work ---- */

typedef struct {
    map_job job;
    size_t rows;
    atomic_size_t next;
    atomic_int stopped;
    pthread_mutex_t lock;
    double done;
} work;

typedef struct {
    work *work;
    map_worker *worker;
} hand;

static int report(const map_job *job, double part) {
    work *w = job->context;

    pthread_mutex_lock(&w->lock);
    w->done += part;
    if (job->options->progress &&
        job->options->progress(job->options->context, fmin(w->done / (double)w->rows, 1))) {
        atomic_store(&w->stopped, 1);
    }
    pthread_mutex_unlock(&w->lock);
    return atomic_load(&w->stopped);
}

static void *work_on(void *context) {
    const hand *self = context;
    work *w = self->work;

    while (!atomic_load(&w->stopped)) {
        const size_t row = atomic_fetch_add(&w->next, 1);
        if (row >= w->rows) break;
        map_row_find(self->worker, row);
    }
    return NULL;
}

static gough_status run_threads(work *w, int threads, char *memory, gough_error *error) {
    const size_t room = map_worker_size(&w->job);
    hand hands[CREW_MOST];

    for (int i = 0; i < threads; i++)
        hands[i] = (hand){w, map_worker_begin(&w->job, memory + (size_t)i * room)};
    crew_work(hands, sizeof hands[0], threads, work_on);
    if (!atomic_load(&w->stopped)) return GOUGH_OK;
    return gough_fail(error, GOUGH_ERROR_NUMERICAL, "the map was stopped at %.0f %%",
                      100 * w->done / (double)w->rows);
}

/* ---- before the work ---- */

/* (floquet-24): the steps of all rows are made finer until those of the first, the middle and the last row suffice */
static gough_status choose_steps(map_job *job, map_worker *w, gough_error *error) {
    const size_t rows = gough_map_rows(job->options);

    job->finer = 1;
    if (job->sampled) return GOUGH_OK;
    for (int look = 0; look < 3; look++) {
        const size_t row = (rows - 1) * (size_t)look / 2;
        const double wanted = job->options->accuracy;
        double change;
        if (map_row_begin(w, row, NULL) != GOUGH_OK || !map_row_has_tables(w)) continue;
        while (map_row_accuracy(w, job->finer, &change, NULL) == GOUGH_OK && !(change <= wanted)) {
            if (job->finer > finest && change <= rough) break;
            if (job->finer > finest) {
                return gough_fail(
                    error, GOUGH_ERROR_NUMERICAL,
                    "with %zu steps in a period the multipliers are accurate only to %.1g: the "
                    "program is too rough, or round-off leaves too little accuracy",
                    map_row_steps(w, job->finer), change);
            }
            /* errors fall with the eighth power */
            job->finer *= fmin(fmax(1.1 * pow(change / wanted, 0.125), 1.1), 4);
        }
    }
    return GOUGH_OK;
}

/* the most parts that any row takes; `probe` is a worker without tables */
static size_t most_parts(map_worker *probe, size_t rows) {
    size_t parts = 1;

    for (size_t row = 0; row < rows; row++) {
        if (map_row_begin(probe, row, NULL) != GOUGH_OK || !map_row_has_tables(probe)) continue;
        if (probe->d.parts > parts) parts = probe->d.parts;
    }
    return parts;
}

/* what cannot be mapped */
static gough_status refuse(const gough_model *model, const gough_map_options *o,
                           gough_error *error) {
    const bool sampled = model->control.sampling.period > 0 || o->axis == GOUGH_MAP_PERIOD;
    gough_status status = machine_can_move(&model->machine, error);

    if (status == GOUGH_OK) status = gough_control_check(&model->control, error);
    if (status == GOUGH_OK && !sampled && o->axis == GOUGH_MAP_DELAY)
        return gough_fail_key(error, GOUGH_ERROR_INPUT, "control.sampling",
                              "a map over the delay needs a sampled controller; give "
                              "control.sampling.period");
    return status;
}

static gough_status prepare(const gough_model *model, const gough_map_options *given,
                            gough_map_options *o, map_job *job, gough_error *error) {
    gough_status status = check(given, o, error);
    map_worker probe;

    if (status == GOUGH_OK) status = refuse(model, o, error);
    if (status != GOUGH_OK) return status;
    memset(job, 0, sizeof *job);
    job->model = model;
    job->options = o;
    job->width = width_of(o->lanes);
    probe.job = job;
    job->sampled = model->control.sampling.period > 0 || o->axis == GOUGH_MAP_PERIOD;
    job->table = job->sampled ? map_sampled_table(job) : 0;
    job->parts = job->sampled ? 1 : most_parts(&probe, gough_map_rows(o));
    return GOUGH_OK;
}

gough_status gough_map_size(const gough_model *model, const gough_map_options *options,
                            size_t *bytes, gough_error *error) {
    gough_map_options o;
    map_job job;
    const gough_status status = prepare(model, options, &o, &job, error);

    *bytes = status == GOUGH_OK ? (size_t)threads_of(&o) * map_worker_size(&job) : 0;
    return status;
}

gough_status gough_map_find(const gough_model *model, const gough_map_options *options,
                            gough_map *map, void *memory, gough_error *error) {
    gough_map_options o;
    gough_status status;
    work w;

    status = prepare(model, options, &o, &w.job, error);
    if (status != GOUGH_OK) return status;
    assert_true((uintptr_t)memory % 64 == 0);
    w.job.map = map;
    w.job.report = report;
    w.job.context = &w;
    w.rows = gough_map_rows(&o);
    w.done = 0;
    atomic_init(&w.next, 0);
    atomic_init(&w.stopped, 0);
    for (size_t row = 0; row < w.rows; row++) map_row_clear(&w.job, row);
    status = choose_steps(&w.job, map_worker_begin(&w.job, memory), error);
    if (status != GOUGH_OK) return status;
    pthread_mutex_init(&w.lock, NULL);
    status = run_threads(&w, threads_of(&o), memory, error);
    pthread_mutex_destroy(&w.lock);
    return status;
}
