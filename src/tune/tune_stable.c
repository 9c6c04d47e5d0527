/* Stability along the search: growth at each point of the curve, intervals of G in which a mode grows, and the least G that keeps
 * its distance from them. Theory: docs/theory/tuning.md. */
#include <math.h>
#include <string.h>

#include "floquet/loads.h"
#include "plant/can_move.h"
#include "tune/tune.h"

/* without a map the margin is looked at in so many places on each side, without damping or with it */
enum { PLACES = 5, DAMPED_PLACES = 2 };

/* with this damping ratio a resonance that overcomes it is no narrow one, and no map is needed to meet it */
static const double well_damped = 0.01;

/* Where the fastest mode turns by more than this in a period, in radians, one look takes seconds, and further up none succeeds:
 * then rest is looked at. */
static const double most_followed = 4000;

/* that part of the threshold at home is far below it */
static const double far_below = 0.5;

/* beyond an interval's edge, relative: the edge itself is known to less */
static const double past_edge = 1e-6;

static void set_gains(tune *t, double stiffness, double damping) {
    for (int v = 0; v < GOUGH_LEGS; v++) {
        t->steady->control.stiffness[v] = stiffness;
        t->steady->control.damping[v] = t->ratio ? damping : t->model->control.damping[v];
    }
}

bool tune_follows(const tune *t, double stiffness) {
    if (t->sampled) return true;
    return t->period.period * t->frequency * sqrt(stiffness) <= most_followed;
}

/* of a loop whose poles are more than the platform's */
static bool own_poles(const tune *t) { return t->sampled || t->states; }

/* whether the program itself is followed now, and not rest at home */
static bool looks_along(const tune *t, double stiffness) {
    if (t->period.resting || (own_poles(t) && !t->naming)) return false;
    return tune_follows(t, stiffness);
}

/* ---- at one G ----------------------------------------------------------------------------------------------------- */

static void look_at_samples(tune *t, gough_tuning_point *point, gough_mode *mode) {
    gough_sampled_rest rest;
    gough_error none;

    if (gough_sampled_at_rest(t->steady, NULL, &rest, &none) != GOUGH_OK) return;
    point->growth = exp(rest.growth);
    point->stable = rest.stable;
    *mode = rest.multiplier[0].mode;
}

/* Where no motion to look at is found, the loop does not hold: growth is unknown, and it is not stable. */
static void look_at_rest(tune *t, gough_tuning_point *point, gough_mode *mode) {
    gough_rest *rest = &t->rest;
    gough_error none;

    if (t->sampled) {
        look_at_samples(t, point, mode);
        return;
    }
    if (gough_stability_at_rest(t->steady, NULL, rest, &none) != GOUGH_OK) return;
    point->growth = exp(rest->growth);
    point->stable = rest->stable;
    *mode = rest->eigenvalue[0].mode;
}

static void look_along_samples(tune *t, gough_tuning_point *point, gough_mode *mode) {
    gough_sampled_floquet floquet;
    gough_error none;

    if (gough_floquet_sampled(t->steady, &t->period, &floquet, &none) != GOUGH_OK) return;
    point->growth = pow(floquet.growth, 1 / (double)floquet.periods);
    point->stable = floquet.stable;
    *mode = floquet.multiplier[0].mode;
}

static void look_along(tune *t, gough_tuning_point *point, gough_mode *mode) {
    gough_floquet floquet;
    gough_error none;

    if (t->sampled) {
        look_along_samples(t, point, mode);
        return;
    }

    if (gough_floquet_multipliers(t->steady, &t->period, 1e-9, &floquet, &none) != GOUGH_OK) return;
    point->growth = floquet.growth;
    point->stable = floquet.growth <= 1 + GOUGH_GROWTH_LIMIT;
    *mode = floquet.multiplier[0].mode;
}

static void look_at(tune *t, gough_tuning_point *point, gough_mode *mode) {
    memset(mode, 0, sizeof *mode);
    point->judged = GOUGH_TUNING_AT_REST;
    point->stable = false;
    point->growth = NAN;
    if (isnan(point->damping)) {
        set_gains(t, point->stiffness, 0);
        look_at_rest(t, point, mode);
        point->stable = false;
    } else {
        set_gains(t, point->stiffness, point->damping);
        if (looks_along(t, point->stiffness)) {
            point->judged = GOUGH_TUNING_ALONG;
            look_along(t, point, mode);
        } else {
            look_at_rest(t, point, mode);
        }
    }
    memcpy(point->mode, mode->name, sizeof point->mode);
}

/* ---- over a range ------------------------------------------------------------------------------------------------- */

static bool grows(const tune *t, const gough_interval *interval) {
    return t->period.resting || interval->growth > 1 + GOUGH_GROWTH_LIMIT;
}

static bool is_well_damped(const tune *t, double stiffness, double damping) {
    const double D = t->ratio ? damping : t->model->control.damping[0];

    return D * t->slow > 2 * well_damped * sqrt(stiffness);
}

static bool keeps_program(const tune *t) {
    return gough_keeps_program(&t->loop->machine, &t->loop->control, !t->period.resting);
}

/* maps are quick for constant loads with the axes of the base */
static bool loads_allow_map(const tune *t) {
    const gough_machine *machine = &t->loop->machine;

    return !machine_loads_follow(machine) && loads_constant(machine, &t->period);
}

/* The map finds resonances however narrow; it is quick where the motion is the program's own, and its memory is limited. Sets the
 * gains. */
static bool can_map(tune *t, double from, double to, size_t count, double damping) {
    const gough_map_options options = tune_map_options(t->options, from, to, count);
    size_t bytes;

    set_gains(t, from, damping);
    if (t->sampled || t->states || !keeps_program(t) || !(to > from) || to > t->map_top)
        return false;
    if (!t->period.resting && is_well_damped(t, to, damping)) return false;
    if (!t->period.resting && !loads_allow_map(t)) return false;
    return gough_map_size(t->steady, &options, &bytes, NULL) == GOUGH_OK && bytes <= t->map_bytes;
}

static gough_status map_range(tune *t, double from, double to, size_t count, tune_growth *growth,
                              size_t room, size_t *found, gough_error *error) {
    gough_map_options options = tune_map_options(t->options, from, to, count);
    gough_map map = {t->map_point, &t->map_row, t->map_interval};
    gough_status status;

    status = gough_map_find(t->steady, &options, &map, t->map_memory, error);
    *found = 0;
    if (status != GOUGH_OK) return status;
    if (t->map_row.error.status != GOUGH_OK)
        return gough_fail(error, t->map_row.error.status, "%s", t->map_row.error.message);
    for (size_t i = 0; i < t->map_row.intervals && *found < room; i++) {
        const gough_interval *interval = &t->map_interval[i];
        if (!grows(t, interval)) continue;
        growth[(*found)++] = (tune_growth){
            interval->from, interval->to,
            t->period.resting || interval->kind == GOUGH_INTERVAL_STATIC ? GOUGH_TUNING_THRESHOLD
                                                                         : GOUGH_TUNING_TONGUE,
            interval->mode};
    }
    return GOUGH_OK;
}

/* Points that nobody looked at count as stable where the run reaches its end; one that grows shows in its deviation. */
static void pass_over(gough_tuning_point *point, size_t points) {
    for (size_t i = 0; i < points; i++) {
        point[i].growth = NAN;
        point[i].judged = GOUGH_TUNING_BY_RUN;
        point[i].stable = point[i].cause == GOUGH_END_DONE;
    }
}

/* Where there is no map, as the program passes a singular pose say, the runs tell what there is to tell. */
static gough_status growth_by_map(tune *t, double before, gough_tuning_point *point, size_t points,
                                  tune_growth *growth, size_t room, size_t *count,
                                  gough_error *error) {
    const size_t extra = before > 0;
    const gough_status status =
        map_range(t, extra ? before : point[0].stiffness, point[points - 1].stiffness,
                  points + extra, growth, room, count, error);

    if (status == GOUGH_ERROR_NUMERICAL) {
        t->map_top = 0; /* nor will there be one further up */
        pass_over(point, points);
        return GOUGH_OK;
    }

    for (size_t i = 0; i < points && status == GOUGH_OK; i++) {
        const gough_map_point *p = &t->map_point[i + extra];
        point[i].growth = t->period.resting ? exp(p->rate) : p->growth;
        point[i].judged = t->period.resting ? GOUGH_TUNING_AT_REST : GOUGH_TUNING_ALONG;
        point[i].stable = p->stable;
        memcpy(point[i].mode, p->mode, sizeof point[i].mode);
    }
    return status;
}

/* At home, and where that holds and a look takes little time, along the program too. */
static void look_twice(tune *t, gough_tuning_point *point) {
    gough_mode mode;

    look_at(t, point, &mode);
    if (!t->cheap || t->period.resting || !point->stable || point->cause != GOUGH_END_DONE) return;
    t->naming = true;
    look_at(t, point, &mode);
    t->naming = false;
}

/* After a round, a decade, in which nothing grew nothing is looked for any more along the curve: resonances only get narrower. */
gough_status tune_growth_of(tune *t, double before, gough_tuning_point *point, size_t points,
                            tune_growth *growth, size_t room, size_t *count, gough_error *error) {
    const double from = before > 0 ? before : point[0].stiffness, to = point[points - 1].stiffness;
    const size_t all = points + (before > 0);
    gough_status status = GOUGH_OK;
    bool grew = false, ran = false;
    gough_mode mode;

    *count = 0;
    for (size_t i = 0; i < points; i++) ran |= point[i].cause == GOUGH_END_DONE;
    if (own_poles(t)) {
        for (size_t i = 0; i < points; i++) look_twice(t, &point[i]);
        return status;
    }
    if (!t->period.resting && (!keeps_program(t) || t->quiet || !ran)) {
        pass_over(point, points);
        return status;
    }
    if (!t->ratio && can_map(t, from, to, all, 0))
        status = growth_by_map(t, before, point, points, growth, room, count, error);
    else
        for (size_t i = 0; i < points; i++) look_at(t, &point[i], &mode);
    for (size_t i = 0; i < points; i++) grew |= !point[i].stable;
    t->quiet = !grew && *count == 0;
    return status;
}

bool tune_look_again(tune *t) {
    bool found = false;

    for (size_t i = 0; i < t->tuning->points; i++) {
        gough_tuning_point *point = &t->point[i];
        gough_mode mode;
        if (point->regular || !point->stable || !isnan(point->growth)) continue;
        look_at(t, point, &mode);
        found |= !point->stable;
    }
    return found;
}

/* ---- clear of it -------------------------------------------------------------------------------------------------- */

/* the least G from `stiffness` on whose margin meets none of the intervals, and the last that it had to pass */
static double pass(double stiffness, double margin, const tune_growth *growth, size_t count,
                   tune_growth *blocked) {
    bool moved = true;

    while (moved) {
        moved = false;
        for (size_t i = 0; i < count; i++) {
            if (!(growth[i].to >= stiffness * (1 - margin) * (1 - past_edge)) ||
                !(growth[i].from <= stiffness * (1 + margin)))
                continue;
            stiffness = growth[i].to * (1 + 2 * past_edge) / (1 - margin);
            *blocked = growth[i];
            moved = true;
        }
    }
    return stiffness;
}

static gough_status clear_by_map(tune *t, double low, double high, const gough_tuning_point *point,
                                 double *clear, tune_growth *blocked, gough_error *error) {
    tune_growth growth[TUNE_INTERVALS];
    size_t count;
    gough_status status = map_range(t, low, high, 3, growth, TUNE_INTERVALS, &count, error);

    *clear = point->stiffness;
    if (status != GOUGH_OK || count == 0) return status;
    if (can_map(t, low, 4 * high, TUNE_ROUND, point->damping))
        status = map_range(t, low, 4 * high, TUNE_ROUND, growth, TUNE_INTERVALS, &count, error);
    if (status != GOUGH_OK) return status;
    *clear = pass(point->stiffness, t->options->margin, growth, count, blocked);
    /* unstable all over, and still far below the threshold at home */
    if (*clear >= 4 * high) *clear = fmax(*clear, far_below * t->tuning->threshold);
    return status;
}

/* without a map: some places within the margin */
static void clear_by_places(tune *t, double stiffness, double damping, double *clear,
                            tune_growth *blocked) {
    const double margin = t->options->margin;
    const int places = is_well_damped(t, stiffness, damping) ? DAMPED_PLACES : PLACES;

    *clear = stiffness;
    for (int i = places; i >= -places; i--) {
        gough_tuning_point place = {.stiffness = stiffness * (1 + margin * i / places),
                                    .damping = damping};
        gough_mode mode;
        look_at(t, &place, &mode);
        if (place.stable) continue;
        *clear = place.stiffness * (1 + 1e-3) / (1 - margin);
        *blocked = (tune_growth){place.stiffness, place.stiffness,
                                 t->period.resting || place.stiffness < 1.1 * t->tuning->threshold
                                     ? GOUGH_TUNING_THRESHOLD
                                     : GOUGH_TUNING_TONGUE,
                                 mode};
        return;
    }
}

gough_status tune_clear(tune *t, const gough_tuning_point *point, double *clear,
                        tune_growth *blocked, gough_error *error) {
    const double margin = t->options->margin,
                 low = point->stiffness * (1 - margin) * (1 - past_edge),
                 high = point->stiffness * (1 + margin) * (1 + past_edge);
    gough_status status = GOUGH_OK;

    t->naming = own_poles(t);
    if (can_map(t, low, high, 3, point->damping))
        status = clear_by_map(t, low, high, point, clear, blocked, error);
    else
        clear_by_places(t, point->stiffness, point->damping, clear, blocked);
    t->naming = false;
    if (*clear > t->greatest) *clear = INFINITY;
    return status;
}
