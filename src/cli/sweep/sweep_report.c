/* The summary of a sweep, and what a study would run. */
#include "cli/sweep/sweep_report.h"
#include "cli/common/in_and_out.h"
#include "cli/common/talk.h"

#include <math.h>
#include <string.h>

#include "cli/common/json.h"
#include "cli/common/scale.h"
#include "cli/run/run_report.h"

/* ---- for reading -------------------------------------------------------------------------------------------------- */

void sweep_name_values(const gough_sweep *sweep, size_t run, char *text, size_t size) {
    enum { MOST = 1000 };
    size_t keys, used = 0;
    double value[MOST];
    const gough_sweep_key *key = gough_sweep_keys(sweep, &keys);
    text[0] = '\0';
    if (keys > MOST) return;
    gough_sweep_values(sweep, run, value);
    for (size_t k = 0; k < keys && used < size; k++) {
        char number[32];
        snprintf(number, sizeof number, "%.6g", value[k]);
        if (k == 4 && keys > 5) {
            snprintf(text + used, size - used, " …");
            return;
        }
        used += (size_t)snprintf(text + used, size - used, "%s%s=%s", k ? ", " : "", key[k].path,
                                 number);
    }
}

static const char *cause_words(gough_cause cause) {
    switch (cause) {
    case GOUGH_END_DONE:
        return "reached their end";
    case GOUGH_END_LEG_SHORT:
        return "ended: a leg too short";
    case GOUGH_END_LEG_LONG:
        return "ended: a leg too long";
    case GOUGH_END_LEG_SPEED:
        return "ended: a leg too fast";
    case GOUGH_END_LEG_FORCE:
        return "ended: a leg's force too great";
    case GOUGH_END_LEG_NO_LENGTH:
        return "ended: a leg without length";
    case GOUGH_END_SINGULAR:
        return "ended: a singular pose";
    case GOUGH_END_NOT_FINITE:
        return "ended: not finite";
    case GOUGH_END_NO_CONVERGENCE:
        return "ended: no convergence";
    case GOUGH_END_STOPPED:
        return "stopped";
    case GOUGH_END_INVALID:
        return "invalid";
    case GOUGH_END_LEG_ACCELERATION:
        return "ended: a leg's acceleration too great";
    case GOUGH_END_BASE_SWING:
        return "ended: a leg turned too far at the base";
    case GOUGH_END_TOP_SWING:
        return "ended: a leg turned too far at the top";
    case GOUGH_END_PLATFORM_POSE:
        return "ended: the platform out of its range";
    case GOUGH_END_PLATFORM_SPEED:
        return "ended: the platform too fast";
    case GOUGH_END_PLATFORM_ACCELERATION:
        return "ended: the platform's acceleration too great";
    case GOUGH_CAUSES:
        break;
    }
    return "ended";
}

/* How many runs ended so. Where forces are computed along a program, a limit ends nothing. */
static void print_cause(FILE *stream, gough_cause cause, const gough_sweep_summary *s) {
    static const char ended[] = "ended: ";
    const char *words = cause_words(cause);
    const bool limit = cause == GOUGH_END_LEG_SHORT || cause == GOUGH_END_LEG_LONG ||
                       cause == GOUGH_END_LEG_SPEED || cause == GOUGH_END_LEG_FORCE ||
                       cause >= GOUGH_END_LEG_ACCELERATION;
    if (s->forces && limit)
        fprintf(stream, "  limit exceeded: %s, in %zu\n", words + sizeof ended - 1,
                s->ended[cause]);
    else
        fprintf(stream, "  %-30s %zu\n",
                s->forces && cause == GOUGH_END_DONE ? "within all limits" : words,
                s->ended[cause]);
}

/* What a sweep leaves of a quantity: its least and greatest value, and the runs that have them. */
static const struct quantity {
    const char *key, *label;
    gough_unit unit;
    size_t at; /* of its range in the summary */
} quantities[] = {
#define RANGE(member) offsetof(gough_sweep_summary, member)
    {"position_deviation", "largest deviation of position", GOUGH_UNIT_LENGTH, RANGE(position)},
    {"angle_deviation", "largest deviation of angle", GOUGH_UNIT_ANGLE, RANGE(angle)},
    {"force", "largest drive force of a leg, pushing or pulling", GOUGH_UNIT_FORCE, RANGE(force)},
    {"speed", "largest speed of a leg", GOUGH_UNIT_SPEED, RANGE(speed)},
    {"power", "power of a leg (below 0 the leg brakes)", GOUGH_UNIT_POWER, RANGE(power)},
#define GOUGH_SIZING_COLUMN(id, name, what, unit, of_legs)                                         \
    {name, what, GOUGH_UNIT_##unit, RANGE(sizing) + GOUGH_SIZING_##id * sizeof(gough_sweep_range)},
#include "gough/sizing.def"
};
enum { QUANTITIES = sizeof quantities / sizeof quantities[0] };

/* how many of them a sweep has: those that size the legs only where it was asked for */
static int quantities_of(const gough_sweep_summary *s) {
    return s->has_sizing ? QUANTITIES : QUANTITIES - GOUGH_SIZINGS;
}

static const gough_sweep_range *range_of(const gough_sweep_summary *s, const struct quantity *q) {
    return (const gough_sweep_range *)(const void *)((const char *)s + q->at);
}

/* what is printed: in the output's units */
static gough_sweep_summary scaled_summary(const sweep_report *report) {
    gough_sweep_summary summary = report->summary;
    for (int q = 0; q < QUANTITIES; q++) {
        const scaled_member both[] = {{quantities[q].at, 2, quantities[q].unit, NULL}};
        SCALE(&summary, both, &report->units);
    }
    return summary;
}

static void print_extreme(FILE *stream, const sweep_report *report, const char *what, double value,
                          const char *unit, size_t run) {
    if (run == 0) return;
    char values[300] = "";
    size_t keys = 0;
    if (report->sweep) gough_sweep_keys(report->sweep, &keys);
    /* of more there are too many for a line; --run prints them */
    if (keys > 0 && keys <= 3) sweep_name_values(report->sweep, run, values, sizeof values);
    fprintf(stream, "    %-10s %.6g%s, run %zu%s%s\n", what, value, unit, run, *values ? ": " : "",
            values);
}

static void print_summary(FILE *stream, const sweep_report *report) {
    const gough_sweep_summary summary = scaled_summary(report), *s = &summary;
    print_title(stream, report->title);
    fprintf(stream, "%zu run%s", s->runs, s->runs == 1 ? "" : "s");
    if (s->resumed) fprintf(stream, ", %zu of them finished earlier", s->resumed);
    const double made = (double)(s->runs - s->resumed);
    if (report->sweep && report->time > 0 && made > 0)
        fprintf(stream, ", %.3g s, %.4g runs/s", report->time, made / report->time);
    fputs("\n\n", stream);
    for (int c = 0; c < GOUGH_CAUSES; c++)
        if (s->ended[c] || c == GOUGH_END_DONE) print_cause(stream, (gough_cause)c, s);
    bool any = false;
    for (int q = 0; q < quantities_of(s); q++) {
        const struct quantity *e = &quantities[q];
        const gough_sweep_range *range = range_of(s, e);
        const char *unit = unit_word(&report->units, e->unit);
        if (range->least_run == 0) continue;
        fprintf(stream, "  %s%s\n", e->label,
                any         ? ""
                : s->forces ? " (runs that met no singular pose)"
                            : " (runs that reached their end)");
        any = true;
        print_extreme(stream, report, "least", range->least, unit, range->least_run);
        print_extreme(stream, report, "greatest", range->greatest, unit, range->greatest_run);
    }
    for (size_t i = 0; i < report->outputs; i++)
        if (strcmp(report->output[i], "-") != 0) print_line(stream, "wrote %s", report->output[i]);
}

static const char *kind_words(const gough_sweep_key *key) {
    switch (key->kind) {
    case GOUGH_SWEEP_GRID:
        return key->logarithmic ? "logarithmic" : "linear";
    case GOUGH_SWEEP_LIST:
        return "list";
    case GOUGH_SWEEP_UNIFORM:
        return "uniform";
    case GOUGH_SWEEP_NORMAL:
        return "normal";
    }
    return "";
}

void sweep_describe(const gough_sweep *sweep) {
    size_t keys;
    const gough_sweep_key *key = gough_sweep_keys(sweep, &keys);
    const size_t runs = gough_sweep_runs(sweep);
    int width = 20;
    for (size_t k = 0; k < keys; k++)
        if ((int)strlen(key[k].path) > width) width = (int)strlen(key[k].path);
    printf("\nSweep\n  %-*s %zu%s\n", width, "runs", runs,
           gough_sweep_zipped(sweep) ? ", values side by side" : "");
    for (size_t k = 0; k < keys; k++) {
        printf("  %-*s ", width, key[k].path);
        if (key[k].kind == GOUGH_SWEEP_NORMAL)
            printf("normal, mean %.6g, deviation %.6g\n", key[k].least, key[k].greatest);
        else if (key[k].kind == GOUGH_SWEEP_UNIFORM)
            printf("uniform, %.6g to %.6g\n", key[k].least, key[k].greatest);
        else
            printf("%zu value%s, %.6g to %.6g, %s\n", key[k].count, key[k].count == 1 ? "" : "s",
                   key[k].least, key[k].greatest, kind_words(&key[k]));
    }
}

/* Whether a sweep varies a key that begins so. */
static bool varies(const gough_sweep *sweep, const char *begin) {
    size_t keys;
    const gough_sweep_key *key = gough_sweep_keys(sweep, &keys);
    for (size_t k = 0; k < keys; k++)
        if (strncmp(key[k].path, begin, strlen(begin)) == 0) return true;
    return false;
}

bool sweep_numbers_noise(const gough_sweep *sweep) {
    const gough_study *study = gough_sweep_study(sweep);
    const bool noisy =
        study->model->disturbance.noise.interval > 0 || varies(sweep, "disturbance.noise.");
    return noisy && !study->noise_run_given;
}

bool sweep_numbers_samples(const gough_sweep *sweep) {
    const gough_study *study = gough_sweep_study(sweep);
    const gough_sampling *s = &study->model->control.sampling;
    const bool random = s->noise > 0 || s->jitter > 0 || varies(sweep, "control.sampling.noise") ||
                        varies(sweep, "control.sampling.jitter");
    return random && s->period > 0 && !study->sampling_run_given;
}

/* ---- as JSON ------------------------------------------------------------------------------------------------------ */

json_t *sweep_object(const gough_sweep *sweep) {
    size_t keys;
    const gough_sweep_key *key = gough_sweep_keys(sweep, &keys);
    json_t *object = json_object(), *list = json_array();
    json_object_set_new(object, "runs", json_integer((json_int_t)gough_sweep_runs(sweep)));
    json_object_set_new(object, "combine",
                        json_string(gough_sweep_zipped(sweep) ? "zip" : "product"));
    for (size_t k = 0; k < keys; k++) {
        json_t *item = json_object();
        json_object_set_new(item, "key", json_string(key[k].path));
        json_object_set_new(item, "kind", json_string(kind_words(&key[k])));
        json_object_set_new(item, "values",
                            key[k].count ? json_integer((json_int_t)key[k].count) : json_null());
        json_object_set_new(item, "range",
                            json_numbers((double[]){key[k].least, key[k].greatest}, 2));
        json_array_append_new(list, item);
    }
    json_object_set_new(object, "keys", list);
    return object;
}

int sweep_print_run_json(const gough_sweep *sweep, size_t run, const double *value) {
    size_t keys;
    const gough_sweep_key *key = gough_sweep_keys(sweep, &keys);
    json_t *object = json_object(), *set = json_object();
    for (size_t k = 0; k < keys; k++) json_object_set_new(set, key[k].path, json_number(value[k]));
    if (sweep_numbers_noise(sweep))
        json_object_set_new(set, "disturbance.noise.run", json_integer((json_int_t)run));
    if (sweep_numbers_samples(sweep))
        json_object_set_new(set, "control.sampling.run", json_integer((json_int_t)run));
    json_object_set_new(object, "run", json_integer((json_int_t)run));
    json_object_set_new(object, "units", json_units(&gough_sweep_study(sweep)->units));
    json_object_set_new(object, "set", set);
    return json_print(object);
}

static json_t *extreme(double value, size_t run) {
    json_t *object = json_object();
    json_object_set_new(object, "value", run ? json_number(value) : json_null());
    json_object_set_new(object, "run", run ? json_integer((json_int_t)run) : json_null());
    return object;
}

static json_t *extremes_of(const gough_sweep_range *range) {
    json_t *object = json_object();
    json_object_set_new(object, "least", extreme(range->least, range->least_run));
    json_object_set_new(object, "greatest", extreme(range->greatest, range->greatest_run));
    return object;
}

static int print_summary_json(const sweep_report *report) {
    const gough_sweep_summary summary = scaled_summary(report), *s = &summary;
    const double made = (double)(s->runs - s->resumed);
    const bool timed = report->sweep && report->time > 0;
    json_t *object = json_object(), *ended = json_object();
    for (int c = 1; c < GOUGH_CAUSES; c++)
        if (s->ended[c])
            json_object_set_new(ended, gough_cause_name((gough_cause)c),
                                json_integer((json_int_t)s->ended[c]));
    json_object_set_new(object, "verb", json_string(report->verb));
    json_object_set_new(object, "title", report->title ? json_words(report->title) : json_null());
    json_object_set_new(object, "units", json_units(&report->units));
    json_object_set_new(object, "runs", json_integer((json_int_t)s->runs));
    json_object_set_new(object, "resumed", json_integer((json_int_t)s->resumed));
    json_object_set_new(object, "done", json_integer((json_int_t)s->ended[GOUGH_END_DONE]));
    json_object_set_new(object, "ended", ended);
    for (int q = 0; q < quantities_of(s); q++)
        json_object_set_new(object, quantities[q].key, extremes_of(range_of(s, &quantities[q])));
    json_object_set_new(object, "time", json_number(timed ? report->time : NAN));
    json_object_set_new(object, "rate", json_number(timed ? made / report->time : NAN));
    return json_print(object);
}

gough_status sweep_tell(const command_line *line, const sweep_report *report) {
    if (line->json) return print_summary_json(report) ? GOUGH_ERROR_FILE : GOUGH_OK;
    if (!line->quiet) print_summary(writes_standard(line) ? stderr : stdout, report);
    return GOUGH_OK;
}
