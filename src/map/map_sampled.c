/* A row of the map whose controller is sampled: each stiffness on its own, at rest from sample to sample, along the program about
 * the periodic motion of the sampled loop. That motion depends on the stiffness, and it grows beyond bounds where a multiplier
 * comes to 1, so nothing is interpolated. Theory: docs/theory/loop.md. */
#include <math.h>

#include "linear/sampled.h"
#include "map/map_row.h"

/* growth of a multiplier in each sample at rest that rounding explains */
static const double rounding = 1e-12;

/* A conjugate pair this close to the real axis is two real multipliers, of a machine that sways alike in two directions. */
static const double same_real = 3e-5;

enum { MOST_TABLE = 1 << 26 };

/* ---- the controller of the row ---- */

static void set_period(gough_sampling *s, double period) {
    const double longer = s->period > 0 ? period / s->period : 0;

    s->delay *= longer;
    s->preview *= longer;
    s->period = period;
}

/* the controller of a row on its own */
static void set_axis(const gough_map_options *o, size_t index, gough_sampling *s) {
    if (o->axis == GOUGH_MAP_PERIOD) set_period(s, gough_map_value(&o->second, index));
    if (o->axis == GOUGH_MAP_DELAY) s->delay = gough_map_value(&o->second, index);
}

/* Bytes of the table for a loop, 0 if it takes too many. */
static size_t table_of(const sampled_orbit *o) {
    const size_t bytes = sampled_table_size(o->samples, o->layout.n);

    return bytes <= MOST_TABLE ? bytes : 0;
}

size_t map_sampled_table(const map_job *job) {
    map_worker w = {.job = job};
    size_t most = 0;
    sampled_orbit o;

    for (size_t row = 0; row < gough_map_rows(job->options); row++) {
        w.orbit = &o;
        o.samples = 0;
        if (map_row_begin(&w, row, NULL) != GOUGH_OK || w.period.resting) continue;
        const size_t bytes = table_of(&o);
        if (bytes > most) most = bytes;
    }
    return most;
}

gough_status map_sampled_begin(map_worker *w, gough_error *error) {
    gough_sampling *s = &w->model.control.sampling;
    gough_status status;

    set_axis(w->job->options, w->index, s);
    status = gough_control_check(&w->model.control, error);
    if (status == GOUGH_OK) status = sampled_check(s, error);
    if (status != GOUGH_OK || w->period.resting) return status;
    status = sampled_orbit_begin(w->orbit, &w->model, &w->period, error);
    /* the table is that of stiffnesses alike in all legs */
    if (status == GOUGH_OK && w->table != NULL && !w->model.control.coupled &&
        table_of(w->orbit) > 0)
        w->orbit->table = sampled_table_begin(w->orbit->samples, w->orbit->layout.n, w->table);
    return status;
}

/* ---- one stiffness ---- */

/* ln|μ| of what is listed, over `span`, as samples */
static void take(const gough_multiplier *list, int listed, double span, double limit, sample *s) {
    for (int k = 0; k < listed; k++) {
        const double size = hypot(list[k].value[0], list[k].value[1]);
        double value[2] = {list[k].value[0], list[k].value[1]};
        if (fabs(value[1]) <= same_real * fabs(value[0])) value[1] = 0;
        sample_add(s, value, log(size) / span, limit, &list[k].mode);
    }
    if (!isfinite(s->size)) sample_no_values(s, s->stiffness);
}

static int look_at_rest(void *context, double stiffness, sample *s) {
    map_worker *w = context;
    const gough_machine *machine = &w->model.machine;
    const double T = w->model.control.sampling.period;
    const double unit = sqrt(machine->gravity_magnitude / machine->base_radius);
    gough_sampled_rest rest;

    map_set_stiffness(w, stiffness, &w->model.control);
    sample_begin(s, stiffness, w->job->options->modes);
    if (gough_sampled_at_rest(&w->model, w->component, &rest, NULL) == GOUGH_OK)
        take(rest.multiplier, (int)rest.listed, T, rounding / T + GOUGH_GROWTH_LIMIT * unit, s);
    else
        sample_no_values(s, stiffness);
    return map_report(w, w->reported);
}

static int look_along(void *context, double stiffness, sample *s) {
    map_worker *w = context;
    sampled_orbit *o = w->orbit;
    gough_multiplier list[GOUGH_SAMPLED];

    map_set_stiffness(w, stiffness, &o->control);
    sample_begin(s, stiffness, w->job->options->modes);
    if (sampled_orbit_find(o, NULL) == GOUGH_OK) {
        w->job->map->row[w->index].steps = o->steps;
        take(list, sampled_orbit_multipliers(o, list), (double)o->periods,
             GOUGH_GROWTH_LIMIT / (double)o->periods, s);
    } else {
        sample_no_values(s, stiffness);
    }
    return map_report(w, w->reported);
}

/* ---- the row ---- */

int map_sampled_find(map_worker *w) {
    gough_map_row *row = &w->job->map->row[w->index];

    row->sampling = w->model.control.sampling.period;
    if (!w->period.resting) row->sampling = w->orbit->control.sampling.period;
    if (!w->period.resting) row->periods = w->orbit->periods;
    return map_alone_find(w, w->period.resting ? look_at_rest : look_along);
}
