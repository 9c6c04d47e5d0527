/* Many runs: checks, threads, and which runs stand side by side. Each thread takes a handful of groups and walks them through the
 * same block of steps, so that stages recorded by the first serve the others while they are near at hand. */
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <string.h>

#include "base/assert.h"
#include "base/crew.h"
#include "batch/lane_runs_table.h"
#include "gough/sizes.h"
#include "integrate/fixed.h"
#include "program/appointments.h"
#include "run/prefetch.h"
#include "run/run.h"

/* groups that a thread walks together; steps of a block; records of its tape: at most 18 stages a step */
enum { GROUPS = 32, BLOCK = 32, RECORDS = 18 * BLOCK + 8 };

gough_status gough_batch_options_init(gough_batch_options *options, size_t size) {
    if (size != sizeof *options) return gough_size_refuse(options, size);
    *options = (gough_batch_options){.size = size};
    return GOUGH_OK;
}

int gough_batch_lanes(void) { return prefetch_lanes(); }

static const struct batch_width *width_of(int lanes) {
    switch (lanes) {
    case 1:
        return &batch_width_1;
    case 2:
        return &batch_width_2;
#if defined(__x86_64__)
    case 4:
        return &batch_width_4;
    case 8:
        return &batch_width_8;
#endif
    default:
        return NULL;
    }
}

int gough_batch_threads(int wanted) { return crew_threads(wanted); }

/* ---- one thread's memory ---- */

/* of the caller's memory: lanes of eight lie in it */
enum { ALIGNMENT = 64 };

static size_t rounded(size_t bytes) { return (bytes + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT; }

static size_t room_of(const struct batch_width *width) {
    return rounded(sizeof(stage_tape)) + rounded(RECORDS * sizeof(tape_record)) +
           batch_recorder_size() + GROUPS * width->group_size;
}

size_t gough_batch_size(const gough_batch_options *options) {
    size_t most = 0;

    for (int lanes = 1; lanes <= gough_batch_lanes(); lanes *= 2) {
        const size_t room = room_of(width_of(lanes));
        if (room > most) most = room;
    }
    return (size_t)crew_threads(options->threads) * most + 64;
}

/* ---- the work ---- */

typedef struct {
    batch_job job;
    const struct batch_width *width; /* NULL: one by one */
    size_t count, chunk;
    int machine_shared, disturbance_shared;
    atomic_size_t next;
    atomic_int stopped;
    pthread_mutex_t lock;
    size_t done;
    const gough_batch_options *options;
} work;

typedef struct {
    work *work;
    char *memory;
} worker;

static void report(work *w, size_t runs) {
    pthread_mutex_lock(&w->lock);
    w->done += runs;
    if (w->options->progress && w->options->progress(w->options->context, w->done)) {
        atomic_store(&w->stopped, 1);
    }
    pthread_mutex_unlock(&w->lock);
}

/* all steps of the runs from `first` on, in blocks */
static void walk_chunk(work *w, char *memory, size_t first, size_t count) {
    const batch_job *job = &w->job;
    const size_t lanes = (size_t)w->width->lanes, groups = (count + lanes - 1) / lanes;
    stage_tape *t = (stage_tape *)(void *)memory;
    char *group[GROUPS];
    int going[GROUPS];
    const char *end = memory + room_of(w->width);

    assert_true(groups <= GROUPS);
    memory += rounded(sizeof *t);
    t->record = (tape_record *)(void *)memory;
    memory += rounded(RECORDS * sizeof(tape_record));
    t->room = RECORDS;
    t->count = 0;
    t->machine_shared = w->machine_shared;
    t->disturbance_shared = w->disturbance_shared;
    batch_recorder_begin(t, job, memory);
    memory += batch_recorder_size();
    assert_true(memory + groups * w->width->group_size <= end);

    for (size_t g = 0; g < groups; g++) {
        const size_t left = count - g * lanes;
        group[g] = memory + g * w->width->group_size;
        t->cursor = 0;
        w->width->begin(group[g], job, first + g * lanes, (int)(left < lanes ? left : lanes), t);
        going[g] = 1;
    }
    for (long long k = 0; k < job->steps && !atomic_load(&w->stopped); k += BLOCK) {
        const long long to = k + BLOCK < job->steps ? k + BLOCK : job->steps;
        t->count = 0;
        for (size_t g = 0; g < groups; g++) {
            if (!going[g]) continue;
            t->cursor = 0;
            going[g] = w->width->advance(group[g], job, k, to);
        }
    }
    if (atomic_load(&w->stopped)) {
        for (size_t i = first; i < first + count; i++) job->outcomes[i].rows = 0;
        return;
    }
    for (size_t g = 0; g < groups; g++) w->width->finish(group[g], job);
    report(w, count);
}

static void *work_on(void *context) {
    const worker *self = context;
    work *w = self->work;

    while (!atomic_load(&w->stopped)) {
        const size_t first = atomic_fetch_add(&w->next, w->chunk);
        if (first >= w->count) break;
        const size_t count = first + w->chunk < w->count ? w->chunk : w->count - first;
        if (w->width) {
            walk_chunk(w, self->memory, first, count);
        } else {
            batch_alone(&w->job, first);
            report(w, 1);
        }
    }
    return NULL;
}

/* ---- checks ---- */

/* whether runs have legs of one kind and controllers that know as much of them: what chooses equations is the same in all lanes */
static bool legs_alike(const gough_batch_run *a, const gough_batch_run *b) {
    return a->machine->platform.legs_have_mass == b->machine->platform.legs_have_mass &&
           a->control->ignores_legs == b->control->ignores_legs &&
           a->control->ignores_friction == b->control->ignores_friction;
}

/* and as many external loads, which act along the same axes and are known alike */
static int loads_alike(const gough_batch_run *a, const gough_batch_run *b) {
    if (a->machine->externals != b->machine->externals ||
        a->control->ignores_external != b->control->ignores_external)
        return 0;
    for (size_t n = 0; n < a->machine->externals; n++) {
        if (a->machine->external[n].turns != b->machine->external[n].turns) return 0;
    }
    return 1;
}

/* each run's machine, beside the first run's */
static gough_status check_machines(const gough_simulation *simulation, const gough_batch_run *runs,
                                   size_t count, gough_error *error) {
    gough_status status = GOUGH_OK;

    for (size_t i = 0; i < count && status == GOUGH_OK; i++) {
        status = simulate_check_legs(runs[i].machine, runs[i].control, simulation, error);
        if (status == GOUGH_OK) status = simulate_check_control(runs[i].control, simulation, error);
        if (status == GOUGH_OK && !loads_alike(&runs[0], &runs[i]))
            return gough_fail(error, GOUGH_ERROR_INPUT,
                              "run %zu has another number of external loads than run 0, other axes "
                              "of them, or a controller that knows them differently; all runs of a "
                              "batch must have the same",
                              i);
        if (status != GOUGH_OK || legs_alike(&runs[0], &runs[i])) continue;
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "run %zu takes the mass or friction of its legs into account differently "
                          "from run 0; all runs of a batch must do the same",
                          i);
    }
    return status;
}

static gough_status check_runs(const gough_motion *motion, const gough_simulation *simulation,
                               const gough_batch_run *runs, size_t count, gough_error *error) {
    for (size_t i = 1; i < count; i++) {
        const double height = runs[i].machine->platform.height;
        if (runs[i].control->feedforward != runs[0].control->feedforward) {
            return gough_fail(error, GOUGH_ERROR_INPUT,
                              "run %zu uses feed-forward differently from run 0; all runs of a "
                              "batch must use the same",
                              i);
        }
        const double interval = runs[i].disturbance->noise.interval;
        const double first = runs[0].disturbance->noise.interval;
        if (interval < first || interval > first) {
            return gough_fail(error, GOUGH_ERROR_INPUT,
                              "the noise of run %zu has a different interval from run 0; all runs "
                              "of a batch must use the same",
                              i);
        }
        if (height < runs[0].machine->platform.height ||
            height > runs[0].machine->platform.height) {
            return gough_fail(error, GOUGH_ERROR_INPUT,
                              "run %zu has a different height at home from run 0; all runs of a "
                              "batch must have the same",
                              i);
        }
    }
    const gough_status status = simulate_check(motion, simulation, error);
    return status == GOUGH_OK ? check_machines(simulation, runs, count, error) : status;
}

/* whether all runs have the same thing in a place of their description, by address or by content */
static int all_same(const gough_batch_run *runs, size_t count, size_t place, size_t size) {
    const void *first, *other;

    memcpy(&first, (const char *)&runs[0] + place, sizeof first);
    for (size_t i = 1; i < count; i++) {
        memcpy(&other, (const char *)&runs[i] + place, sizeof other);
        if (other != first && memcmp(other, first, size) != 0) return 0;
    }
    return 1;
}

/* a vertical force is shared by the legs in the same equations as F^p */
static int any_vertical(const gough_batch_run *runs, size_t count) {
    for (size_t i = 0; i < count; i++) {
        if (!gough_formula_is_zero(&runs[i].disturbance->vertical_force)) return 1;
    }
    return 0;
}

/* whether all runs divide their fixed steps alike, so that they may stand in lanes */
static int appointments_all_same(const gough_batch_run *runs, size_t count) {
    for (size_t i = 1; i < count; i++) {
        if (!appointments_same(runs[0].disturbance, runs[i].disturbance) ||
            !appointments_same_loads(runs[0].machine, runs[i].machine))
            return 0;
    }
    return 1;
}

/* whether two runs have loops of the same parts that look and act at the same times, so that they may stand in lanes */
static int loops_alike(const gough_batch_run *a, const gough_batch_run *b) {
    const gough_actuators *one = &a->machine->platform.actuators;
    const gough_actuators *two = &b->machine->platform.actuators;
    const gough_sampling *s = &a->control->sampling, *t = &b->control->sampling;
    const double times[][2] = {{s->period, t->period},
                               {s->delay, t->delay},
                               {s->jitter, t->jitter},
                               {s->preview, t->preview}};

    for (size_t i = 0; i < sizeof times / sizeof times[0]; i++) {
        if (times[i][0] < times[i][1] || times[i][0] > times[i][1]) return 0;
    }
    for (int v = 0; v < GOUGH_LEGS; v++) {
        const double *x = one->max_force[v], *y = two->max_force[v];
        if ((x[0] < x[1]) != (y[0] < y[1])) return 0;
        if ((one->time_constant[v] > 0) != (two->time_constant[v] > 0)) return 0;
        if ((a->control->integral[v] > 0) != (b->control->integral[v] > 0)) return 0;
    }
    return s->velocity == t->velocity && one->kind == two->kind &&
           a->control->coupled == b->control->coupled;
}

static int loops_all_same(const gough_batch_run *runs, size_t count) {
    for (size_t i = 1; i < count; i++) {
        if (!loops_alike(&runs[0], &runs[i])) return 0;
    }
    return 1;
}

static void plan(work *w, const gough_simulation *s, int lanes, int threads) {
    const int fixed = s->step > 0 && s->precision == GOUGH_DOUBLE && !w->job.forces;
    size_t share = (w->count + 2 * (size_t)threads - 1) / (2 * (size_t)threads);

    w->width = fixed ? width_of(lanes) : NULL;
    w->chunk = 1;
    if (!fixed) return;
    w->job.steps = fixed_steps(s->duration, s->step);
    w->job.per_row = llround(s->output_step / s->step);
    /* whole groups, at most as many as a thread has room for, and work for every thread */
    share = (share + (size_t)lanes - 1) / (size_t)lanes * (size_t)lanes;
    w->chunk = share < (size_t)lanes * GROUPS ? share : (size_t)lanes * GROUPS;
}

static gough_status run_threads(work *w, int threads, char *memory, gough_error *error) {
    const size_t room = w->width ? room_of(w->width) : 0;
    worker workers[CREW_MOST];

    assert_true((uintptr_t)memory % ALIGNMENT == 0);
    for (int i = 0; i < threads; i++) workers[i] = (worker){w, memory + (size_t)i * room};
    crew_work(workers, sizeof workers[0], threads, work_on);
    if (atomic_load(&w->stopped)) {
        return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                          "the batch was stopped after %zu of %zu "
                          "runs",
                          w->done, w->count);
    }
    return GOUGH_OK;
}

gough_status gough_batch(const gough_motion *motion, const gough_simulation *simulation,
                         const gough_batch_run *runs, size_t count,
                         const gough_batch_options *options, gough_outcome *outcomes, void *memory,
                         gough_error *error) {
    const int widest = gough_batch_lanes(), lanes = options->lanes ? options->lanes : widest;
    const int threads = crew_threads(options->threads);
    gough_simulation own = *simulation;
    gough_status status;
    work w;

    if (gough_size_check(options->size, sizeof(gough_batch_options), "gough_batch_options",
                         error) != GOUGH_OK)
        return GOUGH_ERROR_INPUT;
    if (count == 0) return GOUGH_OK;
    if (width_of(lanes) == NULL || lanes > widest) {
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "%d lanes: this processor can run 1%s%s or %d lanes", lanes,
                          widest > 2 ? ", 2" : "", widest > 4 ? ", 4" : "", widest);
    }
    status = options->forces ? simulate_check(motion, simulation, error)
                             : check_runs(motion, simulation, runs, count, error);
    if (status != GOUGH_OK) return status;

    own.summary = NULL; /* of one run, which runs side by side must not share */
    own.joints |= options->sizing;
    w = (work){.job = {motion, &own, runs, outcomes, 0, 0, options->sizing, options->forces},
               .count = count,
               .options = options,
               .done = 0};
    atomic_init(&w.next, 0);
    atomic_init(&w.stopped, 0);
    pthread_mutex_init(&w.lock, NULL);
    w.disturbance_shared =
        all_same(runs, count, offsetof(gough_batch_run, disturbance), sizeof(gough_disturbance));
    w.machine_shared =
        all_same(runs, count, offsetof(gough_batch_run, machine), sizeof(gough_machine)) &&
        (w.disturbance_shared || !any_vertical(runs, count));
    plan(&w, simulation, lanes, threads);
    if (w.width && !(appointments_all_same(runs, count) &&
                     loops_all_same(runs, count))) { /* steps of their own: each run alone */
        w.width = width_of(1);
        w.chunk = 1;
    }
    for (size_t i = 0; i < count; i++) outcomes[i].rows = 0;
    status = run_threads(&w, threads, memory, error);
    pthread_mutex_destroy(&w.lock);
    return status;
}
