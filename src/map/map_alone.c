/* A row of the map each of whose stiffnesses is computed on its own, since nothing tells from one what another does: a sampled
 * controller, drives that lag or have limits, integrals, matrices of gains. What is between the points of the grid: edges by
 * guesses from both sides, tops of growth that lie between. Theory: docs/theory/loop.md, docs/theory/floquet.md. */
#include <math.h>

#include "linear/gain_pattern.h"
#include "linear/symmetric.h"
#include "map/map_row.h"

/* Where a motion ends, each look beyond takes a long search for one: edges there, relative to the greatest stiffness. */
static const double coarse_edge = 1e-4;

enum { GOLDEN = 6, BUMP = 8 };

/* ---- the row ---- */

/* The scan of a row: what has been scanned so far, and the two points of the grid after it. */
typedef struct {
    scan scan;
    sample last, middle, next;
    int seen; /* how many of these there are */
} way;

/* threshold_of() with the stiffnesses of a matrix, as the axis counts them; INFINITY: no stiffness of that pattern holds all
 * modes */
static double threshold_of_matrix(map_worker *w) {
    const gough_control own = w->model.control;
    double K[6][6], gamma[6];
    double complex shape[6][6];
    gough_stiffness s;
    gough_status status;

    map_set_stiffness(w, 1, &w->model.control);
    status = gough_stiffness_at_rest(&w->model, w->period.resting ? w->component : NULL, &s, NULL);
    w->model.control = own;
    if (status != GOUGH_OK) return INFINITY;
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++) K[i][j] = 0.5 * (s.control[i][j] + s.control[j][i]);
    if (symmetric_problem(s.geometric[0], K[0], gamma, shape) < 0) return INFINITY;
    return fmax(0, -gamma[0]);
}

/* the greatest least stiffness of a mode at rest, which neither period, delay nor lag moves: below it some mode falls */
static double threshold_of(map_worker *w) {
    double greatest = 0;
    gough_rest rest;

    if (w->model.control.coupled) return threshold_of_matrix(w);

    if (gough_stability_at_rest(&w->model, w->period.resting ? w->component : NULL, &rest, NULL) !=
        GOUGH_OK)
        return 0;
    for (int i = 0; i < 6; i++) {
        if (sample_counts(&rest.threshold[i].mode, w->job->options->modes))
            greatest = fmax(greatest, rest.threshold[i].stiffness);
    }
    return greatest;
}

static void scan_one(way *p, const sample *s) {
    scan_to(&p->scan, &p->last, s);
    p->last = *s;
}

/* Where growth has a top below the circle, or a bottom above it, at the middle one of three points: whether it crosses the circle
 * between them, by golden section. */
static bool find_bump(way *p, sample *found) {
    const double golden = 0.61803398874989485;
    const double sign = p->middle.growers > 0 ? -1 : 1; /* of the quantity that has a top */
    double a = p->last.stiffness, b = p->next.stiffness, x = b - golden * (b - a);
    sample best = p->middle;

    if ((p->last.growers > 0) != (p->middle.growers > 0) ||
        (p->next.growers > 0) != (p->middle.growers > 0) ||
        !(sign * (p->middle.size - p->last.size) >= 0 &&
          sign * (p->middle.size - p->next.size) >= 0))
        return false;
    for (int k = 0; k < BUMP && !p->scan.stopped; k++) {
        p->scan.stopped |= p->scan.look(p->scan.context, x, found);
        if (isnan(found->size)) return false;
        if ((found->growers > 0) != (p->middle.growers > 0)) return true;
        if (sign * (found->size - best.size) > 0) {
            if (x > best.stiffness)
                a = best.stiffness;
            else
                b = best.stiffness;
            best = *found;
        } else if (x > best.stiffness) {
            b = x;
        } else {
            a = x;
        }
        x = best.stiffness - a > b - best.stiffness
                ? best.stiffness - (1 - golden) * (best.stiffness - a)
                : best.stiffness + (1 - golden) * (b - best.stiffness);
    }
    return false;
}

/* a further point of the grid, by rising stiffness */
static void put_next(way *p, const sample *s) {
    sample bump;

    if (isnan(s->size))
        return; /* it has no values: the scan goes from the point before to the one after */
    switch (p->seen) {
    case 0:
        scan_begin(&p->scan, s);
        p->last = *s;
        p->seen = 1;
        return;
    case 1:
        p->middle = *s;
        p->seen = 2;
        return;
    }
    p->next = *s;
    const bool bumps = find_bump(p, &bump);
    if (bumps && bump.stiffness < p->middle.stiffness) scan_one(p, &bump);
    scan_one(p, &p->middle);
    if (bumps && bump.stiffness > p->middle.stiffness) scan_one(p, &bump);
    p->middle = *s;
}

int map_alone_find(map_worker *w, map_look *look) {
    const gough_map_range *range = &w->job->options->stiffness;
    way p = {.seen = 0};
    sample s;

    p.scan = (scan){.look = look,
                    .found = map_put_interval,
                    .context = w,
                    .low = range->from,
                    .high = range->to,
                    .resolution = map_edge_width_slow * range->to,
                    .edge = map_edge_width_slow * range->to,
                    .coarse = coarse_edge * range->to,
                    .period = w->period.resting ? 0 : w->period.period,
                    .sweeps = GOLDEN,
                    .alone = true,
                    .threshold = threshold_of(w)};
    for (size_t i = 0; i < range->count && !p.scan.stopped; i++) {
        if (p.scan.look(w, gough_map_value(range, i), &s)) return 1;
        if (map_put_point(w, NULL, i, &s)) return 1;
        put_next(&p, &s);
    }
    if (p.seen == 2) scan_one(&p, &p.middle);
    if (p.seen > 0) scan_end(&p.scan, &p.last);
    return p.scan.stopped;
}
