/* The curve of deviation against G: its slope, where it leaves its trend, and, where no G does, why. Theory:
 * docs/theory/tuning.md. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "tune/tune.h"

/* a point whose deviation is this factor off the trend is not of it */
static const double off_trend = 1.5;

/* a deviation below so many tolerances of the run, in base radii, is its error and tells nothing */
static const double errors = 100;

/* as flat as this, a curve does not lead to any accuracy */
static const double flat = -0.05;

enum { SWEEPS = 40, FEWEST = 5 };

static const char *const binding_names[] = {"position",  "angle",  "end",
                                            "threshold", "tongue", "search"};
static const char *const exception_names[] = {"ended", "unstable", "off_trend"};

const char *gough_tuning_binding_name(gough_tuning_binding binding) {
    const size_t names = sizeof binding_names / sizeof *binding_names;
    return (int)binding >= 0 && (size_t)binding < names ? binding_names[binding] : "unknown";
}

const char *gough_tuning_exception_name(gough_tuning_exception_kind kind) {
    const size_t names = sizeof exception_names / sizeof *exception_names;
    return (int)kind >= 0 && (size_t)kind < names ? exception_names[kind] : "unknown";
}

/* ---- trend -------------------------------------------------------------------------------------------------------- */

static bool usable(const tune *t, const gough_tuning_point *p) {
    return p->cause == GOUGH_END_DONE && p->stable &&
           p->position_deviation > errors * t->simulation.tolerance * t->model->machine.base_radius;
}

/* ln of deviation over trend */
static double excess(const gough_tuning *tuning, const gough_tuning_point *p) {
    return log(p->position_deviation / tuning->scale) - tuning->slope * log(p->stiffness);
}

/* least squares of ln deviation = ln scale + slope ln G over points from `first` on, of weight w(excess) once there is a line;
 * false where there are too few */
static bool fit(tune *t, size_t first, double (*weight)(double excess)) {
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    gough_tuning *tuning = t->tuning;
    size_t points = 0;

    for (size_t i = first; i < tuning->points; i++) {
        const gough_tuning_point *p = &t->point[i];
        if (!usable(t, p)) continue;
        const double x = log(p->stiffness), y = log(p->position_deviation);
        const double w = weight ? weight(excess(tuning, p)) : 1;
        n += w, sx += w * x, sy += w * y, sxx += w * x * x, sxy += w * x * y;
        points += w > 0;
    }
    if (points < FEWEST || !(n * sxx - sx * sx > 0)) return false;
    tuning->slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
    tuning->scale = exp((sy - tuning->slope * sx) / n);
    return true;
}

/* that of least absolute deviations: points far off pull no harder than others */
static double sturdy(double e) { return 1 / fmax(fabs(e), 0.01); }
static double within(double e) { return fabs(e) <= log(off_trend); }

/* where the last decade of points that can be used begins */
static size_t last_decade(const tune *t) {
    size_t first = t->tuning->points, used = 0;

    while (first > 0 && used < TUNE_DECADE) used += usable(t, &t->point[--first]);
    return first;
}

/* The line that large G tend to, and how far down it holds. */
static void find_trend(tune *t) {
    gough_tuning *tuning = t->tuning;
    const size_t first = last_decade(t);
    bool found = fit(t, first, NULL);

    for (int i = 0; i < SWEEPS && found; i++) found = fit(t, first, sturdy);
    for (int i = 0; i < 3 && found; i++) found = fit(t, 0, within);
    if (!found) tuning->slope = tuning->scale = NAN;
    for (size_t i = 0; i < tuning->points; i++) {
        gough_tuning_point *p = &t->point[i];
        p->regular = found && usable(t, p) && within(excess(tuning, p)) > 0;
    }
}

/* ---- exceptions --------------------------------------------------------------------------------------------------- */

static void keep(gough_tuning *tuning, const gough_tuning_exception *e) {
    size_t place = tuning->exceptions;

    if (place == GOUGH_TUNING_EXCEPTIONS) return;
    while (place > 0 && tuning->exception[place - 1].from > e->from) {
        tuning->exception[place] = tuning->exception[place - 1];
        place--;
    }
    tuning->exception[place] = *e;
    tuning->exceptions++;
}

/* Intervals in which a mode grows, each once although it may reach over the ends of what is looked at. */
void tune_note_growth(tune *t, const tune_growth *growth, size_t count) {
    gough_tuning *tuning = t->tuning;

    for (size_t i = 0; i < count; i++) {
        gough_tuning_exception e = {.from = growth[i].from,
                                    .to = growth[i].to,
                                    .kind = GOUGH_TUNING_UNSTABLE,
                                    .worst = NAN};
        bool known = false;
        memcpy(e.mode, growth[i].mode.name, sizeof e.mode);
        for (size_t k = 0; k < tuning->exceptions; k++) {
            gough_tuning_exception *other = &tuning->exception[k];
            if (strcmp(other->mode, e.mode) != 0 || other->to < e.from * (1 - 1e-5) ||
                other->from > e.to * (1 + 1e-5))
                continue;
            other->from = fmin(other->from, e.from);
            other->to = fmax(other->to, e.to);
            known = true;
        }
        if (!known) keep(tuning, &e);
    }
}

static bool in_known_interval(const gough_tuning *tuning, size_t known, double stiffness) {
    for (size_t k = 0; k < known; k++) {
        const gough_tuning_exception *e = &tuning->exception[k];
        if (stiffness >= e->from && stiffness <= e->to) return true;
    }
    return false;
}

static gough_tuning_exception_kind kind_of(const gough_tuning_point *p) {
    if (p->cause != GOUGH_END_DONE && p->cause != GOUGH_END_INVALID) return GOUGH_TUNING_ENDED;
    return p->stable ? GOUGH_TUNING_OFF_TREND : GOUGH_TUNING_UNSTABLE;
}

static double ratio_to_trend(const gough_tuning *tuning, const gough_tuning_point *p) {
    return isfinite(tuning->slope) && p->position_deviation > 0 ? exp(excess(tuning, p)) : NAN;
}

static void find_exceptions(tune *t) {
    gough_tuning *tuning = t->tuning;
    gough_tuning_exception found[GOUGH_TUNING_EXCEPTIONS];
    const size_t known = tuning->exceptions;
    size_t count = 0;

    for (size_t i = 0; i < tuning->points && count < GOUGH_TUNING_EXCEPTIONS; i++) {
        const gough_tuning_point *p = &t->point[i];
        gough_tuning_exception *last = count ? &found[count - 1] : NULL;
        const gough_tuning_exception_kind kind = kind_of(p);
        const double ratio = ratio_to_trend(tuning, p);
        if (p->regular || (kind == GOUGH_TUNING_OFF_TREND && !isfinite(tuning->slope))) continue;
        if (kind == GOUGH_TUNING_UNSTABLE && in_known_interval(tuning, known, p->stiffness))
            continue;
        const char *grows = kind == GOUGH_TUNING_UNSTABLE ? p->mode : "";
        const gough_cause cause = kind == GOUGH_TUNING_ENDED ? p->cause : GOUGH_END_DONE;
        const bool follows = last && i > 0 && !(last->to < t->point[i - 1].stiffness) &&
                             last->kind == kind && last->cause == cause &&
                             strcmp(last->mode, grows) == 0;
        if (follows) {
            last->to = p->stiffness;
            last->worst = fmax(last->worst, ratio);
            last->small_steps &= p->small_steps;
            continue;
        }
        found[count] = (gough_tuning_exception){.from = p->stiffness,
                                                .to = p->stiffness,
                                                .kind = kind,
                                                .cause = cause,
                                                .small_steps = p->small_steps,
                                                .worst = ratio};
        snprintf(found[count].mode, sizeof found[count].mode, "%s", grows);
        count++;
    }
    for (size_t i = 0; i < count; i++) keep(tuning, &found[i]);
}

/* decades: a point so far off the trend may be one whose run has stepped over something */
static const double far_off = 100;

gough_status tune_check_outliers(tune *t, gough_error *error) {
    gough_tuning *tuning = t->tuning;
    gough_status status = GOUGH_OK;
    const bool before = t->fine;

    find_trend(t);
    if (t->fine || !isfinite(tuning->slope)) return GOUGH_OK;
    t->fine = true;
    for (size_t i = 0; i < tuning->points && status == GOUGH_OK; i++) {
        gough_tuning_point *p = &t->point[i], again;
        if (!usable(t, p) || !(fabs(excess(tuning, p)) > log(far_off))) continue;
        status = tune_evaluate(t, &p->stiffness, 1, &again, error);
        if (status != GOUGH_OK) break;
        again.growth = p->growth;
        again.stable = p->stable;
        again.judged = p->judged;
        memcpy(again.mode, p->mode, sizeof again.mode);
        *p = again;
    }
    t->fine = before;
    return status;
}

void tune_curve(tune *t) {
    find_trend(t);
    if (tune_look_again(t)) find_trend(t);
    find_exceptions(t);
}

/* ---- why none does ------------------------------------------------------------------------------------------------ */

/* slope over the last decade of points that reached their end; NaN: too few */
static double last_slope(const tune *t) {
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;

    for (size_t i = t->tuning->points; i-- > 0 && n <= TUNE_DECADE;) {
        const gough_tuning_point *p = &t->point[i];
        if (!usable(t, p)) continue;
        const double x = log(p->stiffness), y = log(p->position_deviation);
        n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
    return n >= FEWEST ? (n * sxy - sx * sy) / (n * sxx - sx * sx) : NAN;
}

/* whether the run starts elsewhere than its program */
static bool starts_off(const gough_initial *initial) {
    bool off = initial->velocity_given || initial->angular_velocity_given;

    for (int c = 0; c < GOUGH_COMPONENTS; c++) off |= initial->given[c];
    return off;
}

/* Forces are borne by springs in proportion to 1/G in the end; only an offset at the start stays. */
bool tune_is_flat(const tune *t) {
    const double slope = last_slope(t);

    return starts_off(&t->model->initial) && isfinite(slope) && slope > flat;
}

static const gough_tuning_point *best_point(const tune *t) {
    const gough_tuning_point *best = NULL;

    for (size_t i = 0; i < t->tuning->points; i++) {
        const gough_tuning_point *p = &t->point[i];
        if (p->cause != GOUGH_END_DONE) continue;
        if (!best || p->position_deviation < best->position_deviation) best = p;
    }
    return best;
}

static bool met_somewhere(const tune *t, const gough_tuning_point **where) {
    for (size_t i = 0; i < t->tuning->points; i++) {
        *where = &t->point[i];
        if (tune_meets(t, *where)) return true;
    }
    return false;
}

/* Numbers and names of units in sentences. */
static double shown(const tune *t, gough_unit unit, double value) {
    const gough_units *units = t->options->units;
    return units ? gough_unit_factor(units, unit) * value : value;
}
static const char *word(const tune *t, gough_unit unit) {
    return t->options->units ? gough_unit_word(t->options->units, unit) : "";
}
static double shown_stiffness(const tune *t, double value) {
    return shown(t, GOUGH_UNIT_STIFFNESS, value);
}
static const char *stiffness_word(const tune *t) { return word(t, GOUGH_UNIT_STIFFNESS); }
static double shown_length(const tune *t, double value) {
    return shown(t, GOUGH_UNIT_LENGTH, value);
}
static const char *length_word(const tune *t) { return word(t, GOUGH_UNIT_LENGTH); }

static void say_ends(tune *t, gough_error *why) {
    const gough_tuning *tuning = t->tuning;
    const gough_tuning_point *last = &t->point[tuning->points - 1];
    char leg[24] = "";

    if (last->leg) snprintf(leg, sizeof leg, " (leg %d)", last->leg);
    if (last->cause == GOUGH_END_INVALID)
        gough_fail(why, GOUGH_OK,
                   "the machine is unstable at home with every G up to %.6g%s, and damping cannot "
                   "change that; search further with --stiffness",
                   shown_stiffness(t, last->stiffness), stiffness_word(t));
    else
        gough_fail(
            why, GOUGH_OK,
            "no run reaches its end: with G = %.6g%s, the greatest, it stops at t = %.6g%s because "
            "%s%s; change the study's program, limits or initial state",
            shown_stiffness(t, last->stiffness), stiffness_word(t),
            shown(t, GOUGH_UNIT_TIME, last->end_time), word(t, GOUGH_UNIT_TIME),
            gough_cause_words(last->cause), leg);
}

/* where to search on, if not beyond the upper edge of a loop whose forces are late; `wanted`: 0 where it is not known */
static void search_further(const tune *t, double wanted, gough_error *how) {
    const double upper = t->tuning->upper, most = upper / (1 + t->options->margin);
    const double searched = t->point[t->tuning->points - 1].stiffness;

    if (!(upper < INFINITY) || (wanted > 0 && wanted < most))
        gough_fail(how, GOUGH_OK, "search further with --stiffness");
    else if (wanted > 0 || !(searched < 0.9 * most))
        gough_fail(how, GOUGH_OK, "but the %s holds the platform at home below G = %.6g%s only: %s",
                   t->sampled ? "sampled controller" : "loop with drives that lag",
                   shown_stiffness(t, upper), stiffness_word(t),
                   t->sampled ? "shorten control.sampling.period or its delay"
                              : "take faster drives");
    else
        gough_fail(how, GOUGH_OK, "search further with --stiffness, up to G = %.6g%s, where the %s",
                   shown_stiffness(t, upper), stiffness_word(t),
                   t->sampled ? "sampled controller no longer holds the platform at home"
                              : "loop with drives that lag no longer holds the platform at home");
}

static void say_floor(const tune *t, const gough_tuning_point *best, gough_error *why) {
    const bool damped = t->ratio ? t->options->damping_ratio > 0 : t->model->control.damping[0] > 0;
    gough_error how = {0};

    search_further(t, 0, &how);

    if (!starts_off(&t->model->initial))
        gough_fail(why, GOUGH_OK,
                   "up to G = %.6g%s the least deviation is %.3g%s, at G = %.6g%s, and it hardly "
                   "falls any more there; %s, or look for a jump in the program",
                   shown_stiffness(t, t->point[t->tuning->points - 1].stiffness), stiffness_word(t),
                   shown_length(t, best->position_deviation), length_word(t),
                   shown_stiffness(t, best->stiffness), stiffness_word(t), how.message);
    else if (damped)
        gough_fail(why, GOUGH_OK,
                   "the deviation does not fall with G; it stays at %.3g%s or more: the run starts "
                   "off its program, and its first swing is as large with any G. Start nearer, or "
                   "allow a larger deviation",
                   shown_length(t, best->position_deviation), length_word(t));
    else
        gough_fail(why, GOUGH_OK,
                   "the deviation does not fall with G; it stays at %.3g%s or more: the run starts "
                   "off its program, and without damping that offset never dies out. Start nearer, "
                   "give --damping-ratio, or allow a larger deviation",
                   shown_length(t, best->position_deviation), length_word(t));
}

static void say_far(const tune *t, const gough_tuning_point *best, double slope, gough_error *why) {
    const double wanted =
        best->stiffness * pow(t->options->deviation / best->position_deviation, 1 / slope);
    gough_error how = {0};

    search_further(t, wanted, &how);
    gough_fail(why, GOUGH_OK,
               "up to G = %.6g%s the least deviation is %.3g%s; it falls as G^%.2f, so that about "
               "G = %.2g%s would be needed; %s",
               shown_stiffness(t, t->point[t->tuning->points - 1].stiffness), stiffness_word(t),
               shown_length(t, best->position_deviation), length_word(t), slope,
               shown_stiffness(t, wanted), stiffness_word(t),
               t->most_steps ? "a run with a larger G takes more than a million steps, so shorten "
                               "simulation.duration"
                             : how.message);
}

/* The deviation falls with G, but a loop whose forces are late cannot have the G. */
static void say_edge(const tune *t, const gough_tuning_point *best, gough_error *why) {
    const gough_tuning *tuning = t->tuning;

    gough_fail(why, GOUGH_OK,
               "the upper edge of stability comes first: the %s holds the platform "
               "at home%s for G below %.6g%s (%s), and up to %.3g %% less than that the least "
               "deviation is %.3g%s, at G = %.6g%s; %s%s",
               t->sampled ? "sampled controller" : "loop with drives that lag",
               t->ratio ? " with that damping ratio" : "", shown_stiffness(t, tuning->upper),
               stiffness_word(t), tuning->upper_mode.name, 100 * t->options->margin,
               shown_length(t, best->position_deviation), length_word(t),
               shown_stiffness(t, best->stiffness), stiffness_word(t),
               t->sampled ? "shorten control.sampling.period or its delay" : "take faster drives",
               t->ratio ? ", or ask for another ratio" : ", or give --damping-ratio");
}

static void reason_closed_states(tune *t, const char *lack) {
    gough_error why = {0};

    gough_fail(&why, GOUGH_OK,
               "the window of G is closed: at home, with %s, %s with any G of the search; %s",
               t->quick > 0 ? "drives that lag" : "an integral", lack,
               t->quick > 0 ? "take faster drives, or give more damping"
                            : "reduce control.integral, or give more damping");
    memcpy(t->tuning->reason, why.message, sizeof t->tuning->reason);
}

void tune_reason_closed(tune *t) {
    const gough_sampling *s = &t->model->control.sampling;
    const gough_sampled_margins *m = &t->margins;
    const char *time = word(t, GOUGH_UNIT_TIME);
    const double damping = t->model->control.damping[0];
    char lack[120] = "", best[120] = "", limit[140] = "";
    gough_error why = {0};

    if (t->ratio)
        snprintf(lack, sizeof lack, "no D gives its least damped mode the ratio %.6g",
                 t->options->damping_ratio);
    else if (damping > 0)
        snprintf(lack, sizeof lack, "the damping D = %.6g%s does not hold it",
                 shown(t, GOUGH_UNIT_DAMPING, damping), word(t, GOUGH_UNIT_DAMPING));
    else
        snprintf(lack, sizeof lack, "without damping it shakes; give --damping-ratio");
    if (t->states) {
        reason_closed_states(t, lack);
        return;
    }
    if (m->best_stiffness > 0)
        snprintf(best, sizeof best, "; the greatest G held by any D is %.6g%s, with D = %.6g%s",
                 shown_stiffness(t, m->best_stiffness), stiffness_word(t),
                 shown(t, GOUGH_UNIT_DAMPING, m->best_damping), word(t, GOUGH_UNIT_DAMPING));
    if (m->period_limit > 0)
        snprintf(
            limit, sizeof limit,
            "; with a period of %.6g%s or more, and a delay in proportion, no gains hold it at all",
            shown(t, GOUGH_UNIT_TIME, m->period_limit), time);
    gough_fail(&why, GOUGH_OK,
               "the window of G is closed: at home, with a controller sampled every %.6g%s that "
               "acts %.6g%s later, %s%s%s",
               shown(t, GOUGH_UNIT_TIME, s->period), time, shown(t, GOUGH_UNIT_TIME, s->delay),
               time, lack, best, limit);
    memcpy(t->tuning->reason, why.message, sizeof t->tuning->reason);
}

void tune_reason(tune *t) {
    gough_error sentence = {0}, *why = &sentence;
    const gough_tuning_options *o = t->options;
    const gough_units degrees = gough_units_si(), *angles = o->units ? o->units : &degrees;
    const gough_tuning_point *best = best_point(t), *where;
    const double offset = tune_initial_offset(t), slope = last_slope(t);

    if (offset > t->options->deviation)
        gough_fail(why, GOUGH_OK,
                   "no feedback can achieve it: the run starts %.3g%s off the program, more than "
                   "the deviation allowed; start nearer, or allow a larger deviation",
                   shown_length(t, offset), length_word(t));
    else if (!best)
        say_ends(t, why);
    else if (met_somewhere(t, &where))
        gough_fail(
            why, GOUGH_OK,
            "the deviation is small enough from G = %.6g%s, but up to G = %.6g%s no G is %.3g %% "
            "away from every range in which a mode (%s) grows, or a run with small steps does not "
            "confirm it; allow a smaller --margin, or give --damping-ratio",
            shown_stiffness(t, where->stiffness), stiffness_word(t),
            shown_stiffness(t, t->point[t->tuning->points - 1].stiffness), stiffness_word(t),
            100 * o->margin, where->mode[0] ? where->mode : "one of them");
    else if (best->position_deviation <= t->options->deviation)
        gough_fail(why, GOUGH_OK,
                   "the position is within its limit with G = %.6g%s, but the angle is not: it "
                   "deviates by "
                   "%.3g%s",
                   shown_stiffness(t, best->stiffness), stiffness_word(t),
                   gough_unit_factor(angles, GOUGH_UNIT_ANGLE) * best->angle_deviation,
                   angles->name[GOUGH_BASE_ANGLE] ? word(t, GOUGH_UNIT_ANGLE) : " degrees");
    else if (t->edged)
        say_edge(t, best, why);
    else if (!(slope < flat))
        say_floor(t, best, why);
    else
        say_far(t, best, slope, why);
    memcpy(t->tuning->reason, sentence.message, sizeof t->tuning->reason);
}
