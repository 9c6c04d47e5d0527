/* The least stiffness of the feedback that meets an accuracy: scan, bracket, keep clear of what grows. Theory:
 * docs/theory/tuning.md. */
#include "tune/tune.h"
#include "base/quantity.h"

#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "control/program_lack.h"
#include "floquet/loads.h"
#include "linear/linear.h"
#include "plant/can_move.h"

/* the curve goes on above the G named by this factor */
static const double beyond = 5;

/* the tolerance of a run is at most this part of the deviation asked for, in base radii */
static const double share_of_error = 1e-4;

/* runs of more steps are not made; a step turns the fastest mode by about this angle */
static const double most_steps = 1e6, turn_of_step = 0.6;

/* above the G with which the fastest mode turns by more than this in a period of the program, the map takes too long, and
 * resonances are too narrow to matter */
static const double most_phase = 700;

/* nobody looks beyond that, in M g/R_b */
static const double most_stiffness = 1e15;

/* a search over more is a mistake, and its points would stand far apart */
static const double most_range = 1e15;

/* the threshold at rest over this is where the search begins */
static const double below_threshold = 4;

/* so far below the upper edge of a sampled loop, which is known to less, the search ends, relative */
static const double before_edge = 1e-5;

/* so often a G may be lifted over what grows */
enum { MOST_LIFTS = 200 };

gough_map_options tune_map_options(const gough_tuning_options *options, double from, double to,
                                   size_t count) {
    gough_map_options map = gough_map_options_default();

    map.stiffness = (gough_map_range){from, to, count, true};
    map.intervals = TUNE_INTERVALS;
    map.threads = options->threads;
    return map;
}

/* ---- memory ------------------------------------------------------------------------------------------------------- */

static size_t rounded(size_t bytes) { return (bytes + 63) / 64 * 64; }

static gough_batch_options batch_options(const gough_tuning_options *options) {
    gough_batch_options batch = gough_batch_options_default();

    batch.threads = options->threads;
    return batch;
}

/* G is the same in all legs, and so is D where it follows from G: without what the study's matrices have beside their diagonals */
static void uncouple(gough_control *control) {
    memset(control->cross_stiffness, 0, sizeof control->cross_stiffness);
    memset(control->cross_damping, 0, sizeof control->cross_damping);
    control->coupled = false;
}

static tune *lay_out(const gough_model *model, const gough_tuning_options *options, size_t for_map,
                     void *memory) {
    const gough_batch_options batch = batch_options(options);
    char *place = memory;
    tune *t = (tune *)(void *)place;

    assert_true((uintptr_t)memory % 64 == 0);
    memset(t, 0, sizeof *t);
    place += rounded(sizeof(tune));
    t->loop = (gough_model *)(void *)place;
    place += rounded(sizeof(gough_model));
    t->steady = (gough_model *)(void *)place;
    place += rounded(sizeof(gough_model));
    t->batch_memory = place;
    place += rounded(gough_batch_size(&batch));
    t->map_memory = place;
    t->map_bytes = for_map;
    t->batch = batch;
    t->model = model;
    t->options = options;
    t->ratio = !isnan(options->damping_ratio);
    t->sampled = model->control.sampling.period > 0;
    t->states = !t->sampled && gough_linear_size(model) > GOUGH_LINEAR;
    t->quick = tune_quickest_drive(&model->machine);
    memcpy(t->loop, model, sizeof *model);
    uncouple(&t->loop->control);
    return t;
}

/* ---- where the search goes ---------------------------------------------------------------------------------------- */

static void set_stiffness(gough_model *model, double stiffness) {
    for (int v = 0; v < GOUGH_LEGS; v++) model->control.stiffness[v] = stiffness;
}

void tune_make_plain(gough_model *model) {
    model->control.sampling.period = 0;
    memset(model->control.integral, 0, sizeof model->control.integral);
    memset(&model->machine.platform.actuators, 0, sizeof model->machine.platform.actuators);
}

void tune_feed_as_asked(const tune *t, gough_model *model) {
    const gough_control *asked = &t->loop->control;

    model->control.feedforward = asked->feedforward;
    model->control.ignores_legs = asked->ignores_legs;
    model->control.ignores_friction = asked->ignores_friction;
    model->control.ignores_external = asked->ignores_external;
}

void tune_make_as_asked(const tune *t, gough_model *model) {
    model->control.sampling = t->model->control.sampling;
    memcpy(model->control.integral, t->model->control.integral, sizeof model->control.integral);
    model->machine.platform.actuators = t->model->machine.platform.actuators;
}

/* thresholds at rest with feed-forward, and the fastest mode where G outweighs all else */
static gough_status look_at_home(tune *t, gough_error *error) {
    gough_tuning *tuning = t->tuning;
    double large, fastest = 0, slowest = INFINITY;
    gough_status status;

    control_knows_all(&t->steady->control);
    tune_make_plain(t->steady);
    uncouple(&t->steady->control);
    set_stiffness(t->steady, 0);
    for (int v = 0; v < GOUGH_LEGS; v++) t->steady->control.damping[v] = 0;
    status = gough_stability_at_rest(t->steady, NULL, &t->rest, error);
    if (status != GOUGH_OK) return status;
    tuning->threshold = t->rest.threshold[0].stiffness;
    tuning->least_mode = t->rest.threshold[0].mode;

    large = 1e4 * fmax(t->unit, tuning->threshold);
    set_stiffness(t->steady, large);
    status = gough_stability_at_rest(t->steady, NULL, &t->rest, error);
    if (status != GOUGH_OK) return status;
    for (int k = 0; k < GOUGH_LINEAR; k++) {
        const double *value = t->rest.eigenvalue[k].value;
        fastest = fmax(fastest, hypot(value[0], value[1]));
        slowest = fmin(slowest, hypot(value[0], value[1]));
    }
    t->frequency = fastest / sqrt(large);
    t->slow = slowest / sqrt(large);
    return GOUGH_OK;
}

/* steps of a run that damping asks for: its fastest decay, D times the square of the fastest mode at G = 1, times a step is at
 * most about 6 */
static double damped_steps(const tune *t) {
    double damping = 0;

    for (int v = 0; v < GOUGH_LEGS; v++) damping = fmax(damping, tune_damping_of(t, v));
    return t->simulation.duration * damping * t->frequency * t->frequency / 6;
}

/* a delayed force holds the platform up to the upper edge only, which the margin keeps away from */
static gough_status limit_to_window(tune *t, gough_error *error) {
    const double end = t->tuning->upper / (1 + t->options->margin) * (1 - before_edge);

    if (!(end < t->greatest)) return GOUGH_OK;
    if (t->options->least > 0 && !(end > t->options->least))
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "the search for the stiffness begins at %.6g" IN_STIFFNESS
                          ", but the %s holds the platform at home up to %.6g" IN_STIFFNESS
                          " only (%s); give --stiffness a:b with a below that, or %s",
                          t->options->least,
                          t->sampled ? "sampled controller" : "loop with drives that lag",
                          t->tuning->upper, t->tuning->upper_mode.name,
                          t->sampled ? "shorten control.sampling.period" : "faster drives");
    t->greatest = end;
    t->least = fmin(t->least, end / 10);
    t->edged = t->bounded = true;
    t->most_steps = false;
    return GOUGH_OK;
}

static gough_status find_range(tune *t, gough_error *error) {
    const gough_tuning *tuning = t->tuning;
    const double longest = most_steps * turn_of_step / (t->simulation.duration * t->frequency);

    if (!t->ratio && damped_steps(t) > most_steps)
        return gough_fail(
            error, GOUGH_ERROR_INPUT,
            "the loop is so strongly damped that one run takes about %.1g steps, and the "
            "search makes runs of at most %.0g; lower control.damping or "
            "simulation.duration",
            damped_steps(t), most_steps);
    t->bounded = isfinite(t->options->greatest);
    t->least = t->options->least;
    t->greatest = t->options->greatest;
    if (t->greatest <= tuning->threshold && tuning->threshold > 0)
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "the machine is unstable at home without feedback: %s grows unless G "
                          "exceeds %.6g" IN_STIFFNESS ", but "
                          "the search ends at %.6g" IN_STIFFNESS
                          "; give --stiffness a:b with b above the threshold",
                          tuning->least_mode.name, tuning->threshold, t->greatest);
    if (!t->bounded) t->greatest = 1e6 * fmax(t->unit, tuning->threshold);
    if (!(t->least > 0)) t->least = fmax(tuning->threshold / below_threshold, 1e-3 * t->unit);
    if (!(t->greatest > t->least))
        return gough_fail(
            error, GOUGH_ERROR_INPUT,
            "the search for the stiffness takes two numbers, 0 < a < b; got %.9g" IN_STIFFNESS
            " and "
            "%.9g" IN_STIFFNESS,
            t->least, t->greatest);
    if (t->greatest / t->least > most_range)
        return gough_fail(
            error, GOUGH_ERROR_INPUT,
            "the search for the stiffness covers at most 15 decades; got %.9g" IN_STIFFNESS
            " to %.9g" IN_STIFFNESS,
            t->least, t->greatest);
    if (t->greatest > longest * longest && longest * longest > t->least) {
        t->greatest = longest * longest;
        t->most_steps = true;
    }
    const gough_status status = limit_to_window(t, error);
    if (status != GOUGH_OK) return status;
    t->whole = (size_t)ceil(log10(t->greatest / t->least) * TUNE_DECADE) + 1;
    t->last = t->whole;
    if (!t->bounded && !t->most_steps && t->furthest > t->greatest) {
        const double end = fmin(t->furthest, longest * longest);
        const double more = ceil(log10(end / t->greatest) * TUNE_DECADE);
        t->most_steps = end < t->furthest;
        if (more > 0) t->last += (size_t)fmin(more, GOUGH_TUNING_POINTS);
        if (t->last > GOUGH_TUNING_POINTS) t->last = GOUGH_TUNING_POINTS;
    }
    return GOUGH_OK;
}

/* the program's period; where it has none, rest at home is looked at in its place */
static gough_status find_period(tune *t, gough_error *error) {
    gough_tuning *tuning = t->tuning;
    gough_error why = {0};
    gough_status status;

    if (t->sampled) return tune_follow_samples(t, error);
    status = gough_motion_period(&t->model->motion, &t->period, &why);

    if (status != GOUGH_OK && t->model->motion.period > 0)
        return gough_fail(error, status, "%s", why.message);
    tuning->periodic = status == GOUGH_OK && !t->period.resting;
    if (tuning->periodic) status = loads_check(&t->model->machine, &t->period, error);
    if (tuning->periodic && status != GOUGH_OK) return status;
    if (status != GOUGH_OK) {
        gough_fail(&why, status, "the program has no period, so home was checked");
        t->period = (gough_period){.resting = true};
        memset(&t->steady->motion, 0, sizeof t->steady->motion);
    } else if (t->period.resting) {
        gough_fail(&why, status, "the program ends at rest, so the pose there was checked");
    }
    t->map_top = most_stiffness * fmax(t->unit, tuning->threshold);
    if (!t->period.resting) t->map_top = pow(most_phase / (t->period.period * t->frequency), 2);
    if (!tuning->periodic) {
        why.message[sizeof tuning->unchecked - 1] = '\0';
        memcpy(tuning->unchecked, why.message, sizeof tuning->unchecked);
    }
    if (t->states) tune_follow_states(t);
    return GOUGH_OK;
}

/* Twice what the map takes with the model's own damping, or none: with another it takes a little more, or is done without. */
static gough_status bytes_for_map(const gough_model *model, const gough_tuning_options *options,
                                  size_t *bytes, gough_error *error) {
    gough_model steady = *model;
    gough_tuning tuning;
    tune probe = {.model = model, .options = options, .steady = &steady, .tuning = &tuning};
    gough_status status;

    *bytes = 0;
    if (model->control.sampling.period > 0 || gough_linear_size(model) > GOUGH_LINEAR)
        return GOUGH_OK;
    probe.unit =
        model->machine.load.mass * model->machine.gravity_magnitude / model->machine.base_radius;
    if (!(probe.unit > 0)) probe.unit = model->machine.load.mass;
    status = look_at_home(&probe, error);

    if (status == GOUGH_OK) status = find_period(&probe, error);
    if (status == GOUGH_OK) {
        const gough_map_options map =
            tune_map_options(options, 0.5 * probe.map_top, probe.map_top, TUNE_ROUND + 2);
        steady.control = model->control;
        uncouple(&steady.control);
        control_knows_all(&steady.control);
        status = gough_map_size(&steady, &map, bytes, error);
    }
    *bytes *= 2;
    return status;
}

gough_status gough_tune_size(const gough_model *model, const gough_tuning_options *options,
                             size_t *bytes, gough_error *error) {
    const gough_batch_options batch = batch_options(options);
    size_t for_map = 0;
    gough_status status = tune_check_options(model, options, error);

    *bytes = 0;
    if (status == GOUGH_OK) status = machine_can_move(&model->machine, error);
    if (status == GOUGH_OK) status = bytes_for_map(model, options, &for_map, error);
    if (status != GOUGH_OK) return status;
    *bytes = rounded(sizeof(tune)) + 2 * rounded(sizeof(gough_model)) +
             rounded(gough_batch_size(&batch)) + rounded(for_map);
    return GOUGH_OK;
}

static gough_status prepare(tune *t, const gough_simulation *simulation, bool feedforward,
                            gough_error *error) {
    const double share = share_of_error * t->options->deviation / t->model->machine.base_radius;
    gough_status status = gough_simulation_check(t->model, simulation, error);

    if (status != GOUGH_OK) return status;
    t->simulation = *simulation;
    t->simulation.precision = GOUGH_DOUBLE;
    t->simulation.reactions = false;
    if (t->simulation.step > 0) t->simulation.tolerance = 1e-10;
    t->simulation.tolerance = fmax(fmin(t->simulation.tolerance, share), 1e-14);
    status = gough_simulation_check(t->model, &t->simulation, error);
    if (status != GOUGH_OK) return status;

    tune_find_scales(t);
    memcpy(t->steady, t->loop, sizeof *t->steady);
    t->loop->control.feedforward = feedforward;
    status = look_at_home(t, error);
    tune_make_as_asked(t, t->steady);
    if (status == GOUGH_OK) status = tune_find_window(t, error);
    if (status == GOUGH_OK) status = find_range(t, error);
    if (status == GOUGH_OK) status = find_period(t, error);
    tune_feed_as_asked(t, t->steady);
    t->fine = status == GOUGH_OK && tune_is_stiff(t);
    return status;
}

/* ---- the hunt ----------------------------------------------------------------------------------------------------- */

static double rounded_up(double x) {
    const double unit = pow(10, 4 - floor(log10(x)));

    return ceil(x * unit * (1 - 1e-12)) / unit;
}

static gough_tuning_binding binding_of(const tune *t, const gough_tuning_point *fails) {
    if (!(fails->stiffness > 0)) return GOUGH_TUNING_SEARCH;
    if (fails->cause == GOUGH_END_INVALID) return GOUGH_TUNING_THRESHOLD;
    if (fails->cause != GOUGH_END_DONE) return GOUGH_TUNING_END;
    return fails->position_deviation > t->options->deviation ? GOUGH_TUNING_POSITION
                                                             : GOUGH_TUNING_ANGLE;
}

/* where the search for the least G stands */
typedef struct {
    size_t next;              /* of the curve's points */
    gough_tuning_point fails; /* the greatest that was found not to do; G = 0: none */
    bool lifted;              /* over what grows, to: */
    double floor;
    tune_growth blocked;
    int lifts;
    bool over, found;
    bool again; /* the search must begin anew, with small steps */
} hunt;

static void name(tune *t, const hunt *h, const gough_tuning_point *point, bool by_stability) {
    gough_tuning *tuning = t->tuning;

    tuning->stiffness = point->stiffness;
    tuning->damping = point->damping;
    tuning->binding = by_stability ? h->blocked.kind : binding_of(t, &h->fails);
    tuning->cause = tuning->binding == GOUGH_TUNING_END ? h->fails.cause : GOUGH_END_DONE;
    tuning->fails = h->fails.stiffness > 0 ? h->fails.stiffness : NAN;
    if (by_stability) {
        tuning->fails = h->blocked.to;
        tuning->mode = h->blocked.mode;
    } else if (tuning->binding == GOUGH_TUNING_THRESHOLD) {
        tuning->mode = tuning->least_mode;
    }
    tuning->mode_share = NAN;
}

/* A run with small steps does not meet the accuracy: something was stepped over. The first time the search begins anew with such
 * steps; after that the G is taken to be insufficient. */
static void refuse(tune *t, hunt *h, const gough_tuning_point *point) {
    if (!t->fine) {
        h->again = h->over = true;
        return;
    }
    h->fails = *point;
    h->fails.position_deviation = INFINITY;
}

/* a G that meets the accuracy: named, if it is clear of what grows */
static gough_status consider(tune *t, hunt *h, const gough_tuning_point *does, bool by_stability,
                             gough_error *error) {
    const double round = rounded_up(does->stiffness);
    gough_tuning_point point;
    double clear;
    gough_status status = tune_evaluate(t, &round, 1, &point, error);

    if (status != GOUGH_OK) return status;
    if (!tune_meets(t, &point)) point = *does;
    status = tune_clear(t, &point, &clear, &h->blocked, error);
    if (status != GOUGH_OK) return status;
    if (!(clear > point.stiffness)) {
        bool good;
        status = tune_verify(t, &point, &good, error);
        if (status != GOUGH_OK) return status;
        if (!good) {
            refuse(t, h, &point);
            return GOUGH_OK;
        }
        name(t, h, &point, by_stability);
        h->found = h->over = true;
    } else if (!isfinite(clear) || ++h->lifts > MOST_LIFTS) {
        h->over = true;
    } else {
        h->lifted = true;
        h->floor = clear;
    }
    return GOUGH_OK;
}

/* the point to which the search was lifted */
static gough_status try_floor(tune *t, hunt *h, gough_error *error) {
    gough_tuning_point point;
    const gough_status status = tune_evaluate(t, &h->floor, 1, &point, error);

    h->lifted = false;
    if (status != GOUGH_OK) return status;
    if (tune_meets(t, &point)) return consider(t, h, &point, true, error);
    h->fails = point;
    return GOUGH_OK;
}

static gough_status go_on(tune *t, hunt *h, gough_error *error) {
    gough_status status = GOUGH_OK;

    while (!h->over && status == GOUGH_OK) {
        if (h->lifted) {
            status = try_floor(t, h, error);
            continue;
        }
        if (h->next == t->tuning->points) break;
        gough_tuning_point point = t->point[h->next];
        if (!(point.stiffness > h->fails.stiffness)) {
            h->next++;
        } else if (!tune_meets(t, &point)) {
            h->fails = point;
            t->tuning->fails = point.stiffness;
            h->next++;
        } else {
            if (h->fails.stiffness > 0) status = tune_refine(t, &h->fails, &point, error);
            if (status == GOUGH_OK) status = consider(t, h, &point, false, error);
        }
    }
    return status;
}

/* ---- the curve ---------------------------------------------------------------------------------------------------- */

/* G of the curve's point i */
static double place_of(const tune *t, size_t i) {
    return t->least * pow(t->greatest / t->least, (double)i / (double)(t->whole - 1));
}

/* points of the next round: a decade, or up to where the curve is enough once a G is named */
static size_t round_of(const tune *t) {
    const gough_tuning *tuning = t->tuning;
    const size_t left = t->last - tuning->points, most = left < TUNE_ROUND ? left : TUNE_ROUND;
    size_t count = 1;

    if (!(tuning->stiffness > 0)) return most;
    while (count < most && place_of(t, tuning->points + count - 1) < beyond * tuning->stiffness)
        count++;
    return count;
}

static gough_status add_points(tune *t, gough_error *error) {
    gough_tuning *tuning = t->tuning;
    gough_tuning_point *point = &t->point[tuning->points];
    const size_t count = round_of(t);
    const double before = tuning->points ? point[-1].stiffness : 0;
    tune_growth growth[TUNE_INTERVALS];
    double stiffness[TUNE_ROUND];
    size_t grown;
    gough_status status;

    for (size_t i = 0; i < count; i++) stiffness[i] = place_of(t, tuning->points + i);
    status = tune_evaluate(t, stiffness, count, point, error);
    if (status == GOUGH_OK)
        status = tune_growth_of(t, before, point, count, growth, TUNE_INTERVALS, &grown, error);
    if (status != GOUGH_OK) return status;
    tune_note_growth(t, growth, grown);
    tuning->points += count;
    if (t->options->progress &&
        t->options->progress(t->options->context,
                             fmin((double)tuning->points / (double)t->whole, 1)))
        return gough_fail(error, GOUGH_ERROR_NUMERICAL, "the search was stopped");
    return GOUGH_OK;
}

/* whether more of the curve would tell nothing */
static bool enough(const tune *t, const hunt *h) {
    const gough_tuning *tuning = t->tuning;
    const double reached = t->point[tuning->points - 1].stiffness;

    if (tuning->points == t->last) return true;
    if (tuning->points == t->whole && h->found) return true;
    if (h->found) return reached >= beyond * tuning->stiffness;
    if (h->over) return true;
    return reached > fmax(1e3 * fmax(tuning->threshold, t->least), t->settled) && tune_is_flat(t);
}

/* the whole search, once more with small steps if a run with them says that something was stepped over */
static gough_status search(tune *t, hunt *h, gough_error *error) {
    gough_tuning *tuning = t->tuning;
    gough_status status = GOUGH_OK;

    for (;;) {
        *h = (hunt){0};
        tuning->stiffness = 0;
        tuning->fails = NAN;
        do {
            status = add_points(t, error);
            if (status == GOUGH_OK) status = go_on(t, h, error);
        } while (status == GOUGH_OK && !enough(t, h));
        if (status != GOUGH_OK || !h->again) return status;
        t->fine = true;
        t->quiet = 0;
        tuning->points = tuning->exceptions = 0;
    }
}

gough_status gough_tune(const gough_model *model, const gough_simulation *simulation,
                        bool feedforward, const gough_tuning_options *options,
                        gough_tuning_point *point, gough_tuning *tuning, void *memory,
                        gough_error *error) {
    hunt h = {0};
    size_t for_map;
    gough_status status = tune_check_options(model, options, error);
    tune *t;

    memset(tuning, 0, sizeof *tuning);
    if (status != GOUGH_OK) return status;
    status = bytes_for_map(model, options, &for_map, error);
    if (status != GOUGH_OK) return status;
    t = lay_out(model, options, for_map, memory);
    t->point = point;
    t->tuning = tuning;
    status = prepare(t, simulation, feedforward, error);
    if (status == GOUGH_OK && (t->sampled || t->states) && !(tuning->upper > 0)) {
        tuning->fails = tuning->slope = tuning->scale = NAN;
        tune_reason_closed(t);
        return GOUGH_OK;
    }
    if (status == GOUGH_OK) status = search(t, &h, error);
    if (status == GOUGH_OK) status = tune_check_outliers(t, error);
    if (status != GOUGH_OK) return status;

    tuning->found = h.found;
    if (!h.found) tuning->stiffness = 0, tuning->fails = NAN;
    tune_curve(t);
    if (h.found && tuning->periodic && !t->sampled && !tune_follows(t, tuning->stiffness)) {
        tuning->periodic = false;
        strcpy(tuning->unchecked, "the platform oscillates too often in one period of the program");
    }
    if (h.found) return tune_detail(t, error);
    tune_reason(t);
    return GOUGH_OK;
}
