/* One row of the stability map: the points of the grid, and the intervals between. Theory: docs/theory/floquet.md. */
#include "map/map_row.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "gough/floquet.h"

/* phase of the fastest mode from one sample to the next */
static const double sample_phase = 0.15;

/* edges, relative to the greatest stiffness */
static const double edge_width = 1e-10;
const double map_edge_width_slow = 1e-7;

/* sweeps of golden section for the greatest growth */
enum { GOLDEN = 18 };

static size_t rounded(size_t bytes) { return (bytes + 63) / 64 * 64; }

size_t map_worker_size(const map_job *job) {
    return rounded(sizeof(map_worker)) + transition_scratch(job->width) +
           job->parts * (2 * sizeof(double[NODES][MATRIX]) + sizeof(double[MATRIX])) +
           (job->sampled ? rounded(sizeof(sampled_orbit)) + job->table : 0) +
           rounded((MAP_MOST_NODES + MAP_MOST_PLACES + job->options->stiffness.count + 2) *
                   sizeof(double));
}

map_worker *map_worker_begin(const map_job *job, void *memory) {
    map_worker *w = memory;
    char *next = (char *)memory + rounded(sizeof *w);

    w->job = job;
    w->scratch = next;
    next += transition_scratch(job->width);
    w->bare.phi = (double(*)[NODES][MATRIX])(void *)next;
    next += job->parts * sizeof(double[NODES][MATRIX]);
    w->complete.phi = (double(*)[NODES][MATRIX])(void *)next;
    next += job->parts * sizeof(double[NODES][MATRIX]);
    w->factor = (double(*)[MATRIX])(void *)next;
    next += job->parts * sizeof(double[MATRIX]);
    w->orbit = job->sampled ? (sampled_orbit *)(void *)next : NULL;
    next += job->sampled ? rounded(sizeof(sampled_orbit)) : 0;
    w->table = next;
    next += job->sampled ? job->table : 0;
    w->node = (double *)(void *)next;
    w->room = MAP_MOST_NODES + MAP_MOST_PLACES + job->options->stiffness.count + 2;
    assert_true((char *)(w->node + w->room) <= (char *)memory + map_worker_size(job));
    return w;
}

/* ---- tables ---- */

size_t map_row_steps(const map_worker *w, double finer) {
    return w->d.parts * (size_t)ceil((double)w->d.steps * finer);
}

/* fills a table */
static gough_status find(map_worker *w, bool damped, double finer, transitions *t,
                         gough_error *error) {
    const linear_loop loop = map_row_loop(w);
    const gough_control damping = w->model.control;
    gough_control control = damping;
    division d = w->d;

    assert_true(d.parts <= w->job->parts);
    if (!damped) memset(control.damping, 0, sizeof control.damping);
    d.steps = map_row_steps(w, finer) / d.parts;
    return transition_find(w->job->width,
                           &(linear_loop){loop.machine, loop.motion, &control, !damped, 0, false},
                           &w->period, w->job->options->stiffness.to, &d, t, w->scratch, error);
}

gough_status map_row_accuracy(map_worker *w, double finer, double *change, gough_error *error) {
    const double top = w->job->options->stiffness.to;
    double phi[2][1][MATRIX];
    gough_status status = find(w, w->damped, finer, &w->bare, error);

    if (status == GOUGH_OK) status = find(w, w->damped, 2 * finer, &w->complete, error);
    if (status != GOUGH_OK) return status;
    *change = 0;
    for (int part = 0; part < 3; part++) {
        const double stiffness = part * top / 2;
        double apart = 0, most = 0;
        analyse_width_1.compose(&w->bare, &stiffness, phi[0]);
        analyse_width_1.compose(&w->complete, &stiffness, phi[1]);
        for (int e = 0; e < MATRIX; e++) {
            apart = fmax(apart, fabs(phi[1][0][e] - phi[0][0][e]));
            most = fmax(most, fabs(phi[1][0][e]));
            if (!isfinite(phi[1][0][e])) apart = INFINITY;
        }
        *change = fmax(*change, isfinite(apart) ? apart / most : INFINITY);
    }
    return GOUGH_OK;
}

/* ---- looks at one stiffness ---- */

int map_report(map_worker *w, double part) {
    const double more = part - w->reported;

    w->reported = part;
    return w->job->report(w->job, more);
}

static void set_stiffness(map_worker *w, double stiffness) {
    map_set_stiffness(w, stiffness, &w->model.control);
}

static int look_at_rest(void *context, double stiffness, sample *s) {
    map_worker *w = context;
    gough_rest rest;

    set_stiffness(w, stiffness);
    sample_begin(s, stiffness, w->job->options->modes);
    if (gough_stability_at_rest(&w->model, w->component, &rest, NULL) != GOUGH_OK) {
        sample_no_values(s, stiffness);
        return 0;
    }
    for (int i = 0; i < (int)rest.size; i++) {
        const gough_eigenvalue *e = &rest.eigenvalue[i];
        sample_add(s, e->value, e->value[0], i < rest.growing ? -INFINITY : INFINITY, &e->mode);
    }
    if (w->job->options->modes == 0) s->stable = rest.stable;
    return 0;
}

static int look_along_orbit(void *context, double stiffness, sample *s) {
    map_worker *w = context;
    gough_floquet floquet;

    set_stiffness(w, stiffness);
    sample_begin(s, stiffness, w->job->options->modes);
    if (gough_floquet_multipliers(&w->model, &w->period, 0, &floquet, NULL) != GOUGH_OK) {
        sample_no_values(s, stiffness);
        return map_report(w, w->reported);
    }
    for (size_t i = 0; i < floquet.size; i++) {
        const gough_multiplier *m = &floquet.multiplier[i];
        sample_add(s, m->value, log(hypot(m->value[0], m->value[1])), GOUGH_GROWTH_LIMIT, &m->mode);
    }
    return map_report(w, w->reported);
}

/* from Φ found already, or from its parts where it is too large */
static void take_sample(map_worker *w, const transitions *t, double stiffness, double *phi,
                        sample *s) {
    const symplectic *form = t == &w->bare ? &w->form : NULL;
    transitions one = {.top = t->top, .parts = 1};

    if (sample_monodromy(&w->model.machine, form, stiffness, w->job->options->modes, phi, s))
        return;
    memcpy(one.cosine, t->cosine, sizeof one.cosine);
    for (size_t p = 0; p < t->parts; p++) {
        one.phi = t->phi + p;
        analyse_width_1.compose(&one, &stiffness, w->factor + p);
    }
    sample_factors(&w->model.machine, form, stiffness, w->job->options->modes,
                   (const double(*)[MATRIX])w->factor, t->parts, s);
}

static int look_at(map_worker *w, const transitions *t, double stiffness, sample *s) {
    double phi[1][MATRIX];

    analyse_width_1.compose(t, &stiffness, phi);
    take_sample(w, t, stiffness, phi[0], s);
    return 0;
}

static int look_undamped(void *context, double stiffness, sample *s) {
    map_worker *w = context;

    return look_at(w, &w->bare, stiffness, s);
}

static int look_damped(void *context, double stiffness, sample *s) {
    map_worker *w = context;

    return look_at(w, &w->complete, stiffness, s);
}

/* ---- many looks, in lanes where there is a table ---- */

typedef int (*visit)(map_worker *w, void *context, size_t i, const sample *s);

static int look_at_all(map_worker *w, const transitions *t,
                       int (*look)(void *context, double stiffness, sample *s),
                       const double *stiffness, size_t count, visit seen, void *context) {
    const size_t lanes = t ? (size_t)w->job->width->lanes : 1;
    double phi[8][MATRIX];
    sample s;

    for (size_t i = 0; i < count; i += lanes) {
        double at[8];
        for (size_t k = 0; k < lanes && t; k++)
            at[k] = stiffness[i + k < count ? i + k : count - 1];
        if (t) w->job->width->compose(t, at, phi);
        for (size_t k = 0; k < lanes && i + k < count; k++) {
            if (t) {
                take_sample(w, t, at[k], phi[k], &s);
            } else if (look(w, stiffness[i], &s)) {
                return 1;
            }
            if (seen(w, context, i + k, &s)) return 1;
        }
    }
    return 0;
}

int map_put_point(map_worker *w, void *context, size_t i, const sample *s) {
    const size_t count = w->job->options->stiffness.count;
    gough_map_point *p = &w->job->map->point[w->index * count + i];
    const double part = 0.1 + 0.4 * ((double)i + 1) / (double)count;

    (void)context;
    p->growth = w->period.resting ? NAN : exp(s->size);
    p->rate = w->period.resting ? s->size : s->size / w->period.period;
    p->stable = s->stable;
    p->mode[0] = '\0';
    if (!isnan(s->size) && (!s->stable || w->damped)) memcpy(p->mode, s->mode.name, sizeof p->mode);
    return i % 64 == 63 ? map_report(w, part) : 0;
}

/* the samples of a scan, one after the other */
typedef struct {
    scan scan;
    sample before;
    bool begun;
    double from, to; /* parts of the work */
} sampling;

static int put_sample(map_worker *w, void *context, size_t i, const sample *s) {
    sampling *p = context;

    if (isnan(s->size))
        return 0; /* it has no values: the scan goes from the one before to the one after */
    if (p->begun) {
        scan_to(&p->scan, &p->before, s);
    } else {
        scan_begin(&p->scan, s);
    }
    p->before = *s;
    p->begun = true;
    if (i % 64 == 63)
        p->scan.stopped |=
            map_report(w, p->from + (p->to - p->from) * ((double)i + 1) / (double)w->nodes);
    return p->scan.stopped;
}

/* ---- where to look ---- */

static void put_node(map_worker *w, double stiffness) {
    if (w->nodes < w->room) w->node[w->nodes++] = stiffness;
}

/* by rising stiffness, each once: Shell's sort, quick where the list is nearly sorted */
static void sort_nodes(map_worker *w) {
    size_t kept = 0;

    for (size_t gap = w->nodes / 2; gap > 0; gap /= 2) {
        for (size_t i = gap; i < w->nodes; i++) {
            const double x = w->node[i];
            size_t k = i;
            for (; k >= gap && w->node[k - gap] > x; k -= gap) w->node[k] = w->node[k - gap];
            w->node[k] = x;
        }
    }
    for (size_t i = 0; i < w->nodes; i++) {
        if (kept == 0 || w->node[i] > w->node[kept - 1]) w->node[kept++] = w->node[i];
    }
    w->nodes = kept;
}

/* equal steps of √G, of which phases are nearly linear functions; from 0, since an interval may begin below the range */
static void put_roots(map_worker *w, double phase) {
    const gough_map_range *range = &w->job->options->stiffness;
    const double steps = fmin(fmax(ceil(phase / sample_phase), 16), MAP_MOST_NODES - 4);

    for (double i = 0; i < steps; i++) put_node(w, range->to * (i / steps) * (i / steps));
    put_node(w, range->from);
    put_node(w, range->to);
}

static void put_grid(map_worker *w) {
    const gough_map_range *range = &w->job->options->stiffness;

    for (size_t i = 0; i < range->count; i++) put_node(w, gough_map_value(range, i));
}

/* ---- what was found ---- */

static bool alike(const gough_interval *a, const gough_interval *b, double width) {
    return a->kind == b->kind && fabs(a->from - b->from) <= width && fabs(a->to - b->to) <= width &&
           strcmp(a->mode.name, b->mode.name) == 0;
}

/* no room for all: the narrowest goes, if it is not the one found */
static bool leave_narrowest(gough_map_row *row, gough_interval *list, const gough_interval *found) {
    double least = found->to - found->from;
    size_t narrowest = row->intervals;

    for (size_t i = 0; i < row->intervals; i++) {
        if (!(list[i].to - list[i].from < least)) continue;
        least = list[i].to - list[i].from;
        narrowest = i;
    }
    row->intervals_missed++;
    if (narrowest == row->intervals) return false;
    memmove(list + narrowest, list + narrowest + 1,
            (row->intervals - narrowest - 1) * sizeof *list);
    row->intervals--;
    return true;
}

void map_put_interval(void *context, const gough_interval *found) {
    map_worker *w = context;
    const gough_map_options *o = w->job->options;
    gough_map_row *row = &w->job->map->row[w->index];
    gough_interval *list = w->job->map->interval + w->index * o->intervals;
    size_t place;

    for (size_t i = 0; i < row->intervals; i++) {
        if (!alike(&list[i], found, 1e-7 * o->stiffness.to)) continue;
        list[i].modes++;
        return;
    }
    if (row->intervals == o->intervals && !leave_narrowest(row, list, found)) return;
    for (place = row->intervals++; place > 0 && list[place - 1].from > found->from; place--)
        list[place] = list[place - 1];
    list[place] = *found;
    list[place].modes = 1;
}

static void put_place(map_worker *w, double stiffness) {
    if (w->places < MAP_MOST_PLACES) w->node[w->room - ++w->places] = stiffness;
}

static void put_interval_place(void *context, const gough_interval *found) {
    map_worker *w = context;

    put_place(w, found->stiffness);
    put_place(w, 0.5 * (found->from + found->to));
}

static void put_meeting(void *context, double stiffness) {
    map_worker *w = context;

    w->meetings += stiffness >= w->job->options->stiffness.from;
    put_place(w, stiffness);
}

/* one scan over the nodes */
static int scan_nodes(map_worker *w, const transitions *t,
                      int (*look)(void *context, double stiffness, sample *s), bool final,
                      double from, double to) {
    const gough_map_range *range = &w->job->options->stiffness;
    const double width = range->to > range->from ? range->to - range->from : range->to;
    sampling p = {.from = from, .to = to};

    p.scan =
        (scan){.look = look,
               .found = final ? map_put_interval : put_interval_place,
               .met = t == &w->bare ? put_meeting : NULL,
               .context = w,
               .low = range->from,
               .high = range->to,
               .resolution = w->job->options->resolution * width,
               .edge = (look == look_along_orbit ? map_edge_width_slow : edge_width) * range->to,
               .period = w->period.resting ? 0 : w->period.period,
               .sweeps = GOLDEN};
    if (look_at_all(w, t, look, w->node, w->nodes, put_sample, &p)) return 1;
    if (p.begun) scan_end(&p.scan, &p.before);
    return p.scan.stopped;
}

/* ---- rows of each kind ---- */

static int points(map_worker *w, const transitions *t,
                  int (*look)(void *context, double stiffness, sample *s)) {
    w->nodes = 0;
    put_grid(w);
    return look_at_all(w, t, look, w->node, w->nodes, map_put_point, NULL);
}

/* each stiffness on its own: at rest, and where the loop does not keep its program */
static int find_one_by_one(map_worker *w, int (*look)(void *context, double stiffness, sample *s)) {
    if (points(w, NULL, look)) return 1;
    w->nodes = 0;
    put_grid(w);
    if (w->period.resting) put_roots(w, 0);
    sort_nodes(w);
    return scan_nodes(w, NULL, look, true, 0.5, 1);
}

/* the greatest growth rate not taken yet, of this name if there is one; NaN: none grows */
static double take_rate(const gough_rest *rest, const char *name, bool taken[GOUGH_LINEAR]) {
    int best = -1;
    for (int named = 1; named >= 0 && best < 0; named--)
        for (int i = GOUGH_LINEAR - 1; i >= 0; i--) /* by falling growth rate */
            if (!taken[i] && rest->eigenvalue[i].value[0] > 0 &&
                (!named || strcmp(rest->eigenvalue[i].mode.name, name) == 0))
                best = i;
    if (best < 0) return NAN;
    taken[best] = true;
    return rest->eigenvalue[best].value[0];
}

/* At rest with feed-forward a mode grows below its threshold, (stab-10), and nowhere else: damping moves no threshold. It grows
 * most where the stiffness is least. */
static int find_at_rest(map_worker *w) {
    const gough_map_range *range = &w->job->options->stiffness;
    bool taken[GOUGH_LINEAR] = {false};
    gough_rest rest;

    if (points(w, NULL, look_at_rest)) return 1;
    set_stiffness(w, range->from);
    if (gough_stability_at_rest(&w->model, w->component, &rest, NULL) != GOUGH_OK) return 0;
    for (int i = 0; i < 6; i++) {
        const gough_threshold *t = &rest.threshold[i];
        if (!(t->stiffness > range->from)) continue;
        if (!sample_counts(&t->mode, w->job->options->modes)) continue;
        map_put_interval(w, &(gough_interval){.from = 0,
                                              .to = fmin(t->stiffness, range->to),
                                              .cut = t->stiffness > range->to,
                                              .stiffness = range->from,
                                              .growth = NAN,
                                              .rate = take_rate(&rest, t->mode.name, taken),
                                              .kind = GOUGH_INTERVAL_STATIC,
                                              .mode = t->mode});
    }
    return 0;
}

static int find_by_tables(map_worker *w, gough_error *error) {
    const double finer = w->job->finer;
    const transitions *t = w->damped ? &w->complete : &w->bare;
    gough_status status = find(w, false, finer, &w->bare, error);

    if (status == GOUGH_OK && w->damped) status = find(w, true, finer, &w->complete, error);
    if (status != GOUGH_OK) return 0;
    w->job->map->row[w->index].steps = map_row_steps(w, finer);
    if (map_report(w, 0.1) || points(w, t, NULL)) return 1;

    w->nodes = 0;
    put_roots(w, w->d.phase);
    sort_nodes(w);
    if (scan_nodes(w, &w->bare, look_undamped, !w->damped, 0.5, 0.8)) return 1;
    if (!w->damped) return 0;

    for (size_t i = 1; i <= w->places; i++) put_node(w, w->node[w->room - i]);
    put_grid(w);
    sort_nodes(w);
    w->places = 0;
    return scan_nodes(w, &w->complete, look_damped, true, 0.8, 1);
}

void map_row_clear(const map_job *job, size_t index) {
    const gough_map_options *o = job->options;
    gough_map_row *row = &job->map->row[index];

    memset(row, 0, sizeof *row);
    row->value = o->axis == GOUGH_MAP_NONE ? 0 : gough_map_value(&o->second, index);
    gough_fail(&row->error, GOUGH_ERROR_NUMERICAL,
               "the map was stopped before this row was finished");
    for (size_t i = 0; i < o->stiffness.count; i++) {
        job->map->point[index * o->stiffness.count + i] =
            (gough_map_point){.growth = NAN, .rate = NAN};
    }
}

int map_row_find(map_worker *w, size_t index) {
    gough_map_row *row = &w->job->map->row[index];
    gough_error error = {.message = ""};
    gough_status status;
    int stopped = 0;

    w->places = w->meetings = 0;
    w->reported = 0;
    status = map_row_begin(w, index, &error);
    if (status == GOUGH_OK) {
        row->period = w->period;
        if (w->sampled) {
            stopped = map_sampled_find(w);
        } else if (w->unordered) {
            stopped = map_alone_find(w, w->period.resting ? look_at_rest : look_along_orbit);
        } else if (w->period.resting && map_row_kept(w)) {
            stopped = find_at_rest(w);
        } else if (w->period.resting) {
            stopped = find_one_by_one(w, look_at_rest);
        } else if (w->alone) {
            stopped = find_one_by_one(w, look_along_orbit);
        } else {
            stopped = find_by_tables(w, &error);
        }
    }
    row->meetings = w->meetings;
    if (!stopped) row->error = error;
    return stopped | map_report(w, 1);
}
