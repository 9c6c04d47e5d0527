/* gough stability --sweep-stiffness: the stability map, its tongues, its data and its pictures. */
#define _GNU_SOURCE
#include "cli/stability/stability_map.h"
#include "cli/common/in_and_out.h"
#include "cli/common/interrupt.h"
#include "cli/common/progress.h"
#include "cli/common/scale.h"
#include "cli/common/talk.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_POINTS = 4000000 }; /* some 300 MB */

/* ---- outputs ----------------------------------------------------------------------------------------------------- */

static gough_status write_outputs(const stability_line *asked, const map_report *report,
                                  FILE *stream) {
    const command_line *line = &asked->line;
    for (size_t i = 0; i < line->outputs.count; i++) {
        const char *path = line->outputs.word[i];
        gough_error error = {0};
        const gough_map_figure figure = {.title =
                                             asked->title ? asked->title : report->study->title,
                                         .units = report->units,
                                         .rest = report->rest};
        fflush(stdout);
        interrupt_outputs(line->verb, line->outputs.word, line->outputs.count, i);
        const gough_status status =
            is_data(path) ? map_write(report, path, &error)
                          : gough_map_draw(&report->options, &report->map, &figure, path, &error);
        if (status) {
            complain(line->verb, "%s", error.message);
            return status;
        }
        if (!stream || strcmp(path, "-") == 0) continue;
        char *beside = is_data(path) ? map_tongues_path(path) : NULL;
        print_line(stream, "wrote %s%s%s", path, beside ? " and " : "", beside ? beside : "");
        free(beside);
    }
    return GOUGH_OK;
}

/* ---- options ----------------------------------------------------------------------------------------------------- */

/* The second axes; the first is the stiffness. */
static const struct {
    const char *option;
    gough_map_axis axis;
} second_axes[] = {{"sweep-amplitude", GOUGH_MAP_AMPLITUDE},
                   {"sweep-frequency", GOUGH_MAP_FREQUENCY},
                   {"sweep-damping", GOUGH_MAP_DAMPING},
                   {"sweep-period", GOUGH_MAP_PERIOD},
                   {"sweep-delay", GOUGH_MAP_DELAY}};

static void read_map_axis(const struct argp_state *state, const option *o, const char *text,
                          void *group) {
    struct map_options *map = group;
    axis_values *axis = strcmp(o->name, "sweep-stiffness") == 0 ? &map->stiffness : &map->second;
    gough_error error = {0};
    if (axis->option && strcmp(axis->option, o->name) != 0)
        usage_error(state, "a map has at most two axes: --sweep-stiffness and one of "
                           "--sweep-amplitude, --sweep-frequency, --sweep-damping, --sweep-period "
                           "and --sweep-delay");
    if (!read_axis(o->name, text, axis, &error)) usage_error(state, "%s", error.message);
    axis->option = o->name;
}

/* "heave", or several of sway, heave, tilt and yaw with + between them */
static void read_map_modes(const struct argp_state *state, const option *o, const char *text,
                           void *group) {
    static const char *const name[4] = {"sway", "heave", "tilt", "yaw"};
    struct map_options *map = group;
    (void)o;
    map->modes = 0;
    for (const char *word = text;; word++) {
        const size_t length = strcspn(word, "+");
        int k = 0;
        while (k < 4 && (strlen(name[k]) != length || strncmp(word, name[k], length) != 0)) k++;
        if (k == 4)
            usage_error(state,
                        "--modes takes sway, heave, tilt or yaw, or several of them with + between "
                        "them, such as sway+tilt; got '%s'",
                        text);
        map->modes |= 1U << k;
        word += length;
        if (*word == '\0') return;
    }
}

static const option map_option[] = {
    {.name = "sweep-stiffness",
     .value = "A:B:N[:log]",
     .read = read_map_axis,
     .text =
         "compute the stability map over the stiffness G, the same in all legs, or of a matrix the "
         "largest on its diagonal: N values from A to B in equal steps, or in equal ratios "
         "with :log"},
    {.name = "sweep-amplitude",
     .value = "A:B:N[:log]",
     .read = read_map_axis,
     .text = "second axis of the map: a factor on the motion"},
    {.name = "sweep-frequency",
     .value = "A:B:N[:log]",
     .read = read_map_axis,
     .text = "second axis: a factor on the motion's frequency"},
    {.name = "sweep-damping",
     .value = "A:B:N[:log]",
     .read = read_map_axis,
     .text = "second axis: the damping D, of all legs as with the stiffness"},
    {.name = "sweep-period",
     .value = "A:B:N[:log]",
     .read = read_map_axis,
     .text = "second axis: the period of the sampled controller, its delay and preview in "
             "proportion"},
    {.name = "sweep-delay",
     .value = "A:B:N[:log]",
     .read = read_map_axis,
     .text = "second axis: the delay of the sampled controller"},
    {.name = "modes",
     .value = "MODE[+MODE...]",
     .read = read_map_modes,
     .text = "map only modes that move in nothing but these: sway, heave, tilt, yaw"},
    {0}};

const option_group map_group = {map_option, NULL, NULL};

/* An axis in the study's units as one in those of the run. */
static gough_map_range range_of(const axis_values *values, const gough_units *units,
                                gough_unit unit) {
    return (gough_map_range){gough_unit_read(units, unit, values->from),
                             gough_unit_read(units, unit, values->to), values->count,
                             values->logarithmic};
}

static gough_map_axis axis_of(const char *name) {
    for (size_t i = 0; name && i < sizeof second_axes / sizeof *second_axes; i++)
        if (strcmp(name, second_axes[i].option) == 0) return second_axes[i].axis;
    return GOUGH_MAP_NONE;
}

static int look(void *context, double done) {
    progress_update(context, done);
    return 0;
}

/* What the study as it stands has on the second axis: factor 1, or its own value. */
static double own_value(const map_report *report) {
    const gough_control *c = &report->study->model->control;
    switch (report->options.axis) {
    case GOUGH_MAP_DAMPING:
        return c->damping[0];
    case GOUGH_MAP_PERIOD:
        return c->sampling.period;
    case GOUGH_MAP_DELAY:
        return c->sampling.delay;
    default:
        return 1.0;
    }
}

/* The row nearest to it. */
static size_t find_own_row(const map_report *report) {
    const double own = own_value(report);
    size_t nearest = 0;
    for (size_t r = 1; r < report->rows; r++)
        if (fabs(report->map.row[r].value - own) < fabs(report->map.row[nearest].value - own))
            nearest = r;
    return nearest;
}

/* ---- units ------------------------------------------------------------------------------------------------------- */

static void scale_range(gough_map_range *range, const gough_units *u, gough_unit d) {
    range->from *= gough_unit_factor(u, d);
    range->to *= gough_unit_factor(u, d);
}

static const scaled_member point_members[] = {SCALED(gough_map_point, rate, RATE)};

static const scaled_member row_members[] = {SCALED(gough_map_row, period.period, TIME),
                                            SCALED(gough_map_row, period.start, TIME),
                                            SCALED(gough_map_row, sampling, TIME)};

static const scaled_member damped_members[] = {SCALED(gough_map_row, value, DAMPING)};

static const scaled_member timed_members[] = {SCALED(gough_map_row, value, TIME)};

static const scaled_member interval_members[] = {
    SCALED(gough_interval, from, STIFFNESS), SCALED(gough_interval, to, STIFFNESS),
    SCALED(gough_interval, stiffness, STIFFNESS), SCALED(gough_interval, rate, RATE)};

static const scaled_member threshold_members[] = {SCALED(gough_threshold, stiffness, STIFFNESS)};

static void scale_map(map_report *report) {
    const gough_units *u = &report->units;
    const gough_unit second = map_axis_unit(report->options.axis);
    scale_range(&report->options.stiffness, u, GOUGH_UNIT_STIFFNESS);
    if (second != GOUGH_UNIT_NONE) scale_range(&report->options.second, u, second);
    for (size_t p = 0; p < report->rows * report->options.stiffness.count; p++)
        SCALE(&report->map.point[p], point_members, u);
    for (size_t r = 0; r < report->rows; r++) {
        gough_map_row *row = &report->map.row[r];
        if (second == GOUGH_UNIT_DAMPING) SCALE(row, damped_members, u);
        if (second == GOUGH_UNIT_TIME) SCALE(row, timed_members, u);
        SCALE(row, row_members, u);
        for (size_t i = 0; i < row->intervals; i++)
            SCALE(&report->map.interval[r * report->options.intervals + i], interval_members, u);
    }
    for (int i = 0; report->rest && i < 6; i++)
        SCALE(&report->rest->threshold[i], threshold_members, u);
}

/* ---- the map ----------------------------------------------------------------------------------------------------- */

/* Where no row has values, the first says why. */
static gough_status check_rows(const map_report *report, gough_error *error) {
    for (size_t r = 0; r < report->rows; r++)
        if (!report->map.row[r].error.status) return GOUGH_OK;
    *error = report->map.row[0].error;
    return error->status;
}

static gough_status find(const command_line *line, map_report *report, gough_error *error) {
    const gough_model *model = report->study->model;
    const size_t points = report->rows * report->options.stiffness.count;
    size_t bytes = 0;
    if (points > MOST_POINTS)
        return gough_fail(
            error, GOUGH_ERROR_INPUT,
            "a map of %zu points is too large; at most %d are possible. Tongues are found between "
            "the points too, so a few values of the stiffness are enough",
            points, MOST_POINTS);
    gough_status status = gough_map_size(model, &report->options, &bytes, error);
    if (status) return status;
    void *memory = aligned_alloc(64, (bytes + 127) / 64 * 64);
    report->map.point = calloc(points, sizeof *report->map.point);
    report->map.row = calloc(report->rows, sizeof *report->map.row);
    report->map.interval =
        calloc(report->rows * report->options.intervals, sizeof *report->map.interval);
    if (!memory || !report->map.point || !report->map.row || !report->map.interval)
        status =
            gough_fail(error, GOUGH_ERROR_FILE,
                       "not enough memory for %zu points; use fewer values on an axis", points);
    progress bar = progress_begin(line->verb, 1.0, line->quiet);
    report->options.progress = look;
    report->options.context = &bar;
    if (!status) status = gough_map_find(model, &report->options, &report->map, memory, error);
    progress_end(&bar);
    report->options.progress = NULL;
    report->options.context = NULL;
    free(memory);
    return status ? status : check_rows(report, error);
}

/* Thresholds at home, of stiffnesses alike in all legs. Without a rest at home, where home is singular or its springs carry
 * nothing, and beside matrices of gains the map has no thresholds. */
static void find_thresholds(map_report *report) {
    if (report->study->model->control.coupled) return;
    report->rest = malloc(sizeof *report->rest);
    if (report->rest &&
        gough_stability_at_rest(report->study->model, NULL, report->rest, NULL) != GOUGH_OK) {
        free(report->rest);
        report->rest = NULL;
    }
}

static gough_status tell(const stability_line *asked, map_report *report) {
    const command_line *line = &asked->line;
    FILE *stream = line->quiet || line->json ? NULL : writes_standard(line) ? stderr : stdout;
    int failed = 0;
    if (line->json) failed = map_print_json(report);
    if (stream) map_print(stream, report, line->outputs.count == 0);
    const gough_status status = write_outputs(asked, report, stream);
    return failed ? GOUGH_ERROR_FILE : status;
}

gough_status stability_map(const stability_line *asked, const gough_study *study) {
    const command_line *line = &asked->line;
    map_report report = {.verb = line->verb, .study = study};
    gough_error error = {0};
    gough_status status = check_data_and_pictures(line);
    if (status) return status;
    report.options = gough_map_options_default();
    report.options.stiffness = range_of(&asked->map.stiffness, &study->units, GOUGH_UNIT_STIFFNESS);
    report.options.axis = axis_of(asked->map.second.option);
    report.options.second =
        range_of(&asked->map.second, &study->units, map_axis_unit(report.options.axis));
    report.options.modes = asked->map.modes;
    report.options.lanes = asked->lanes;
    report.options.threads = asked->threads;
    report.rows = gough_map_rows(&report.options);
    interrupt_outputs(line->verb, line->outputs.word, line->outputs.count, 0);
    status = gough_units_of_study(study, line->dimensionless, &report.units, &error);
    if (!status) status = find(line, &report, &error);
    if (status) {
        complain_of(line->verb, study, &error);
    } else {
        for (size_t r = 0; r < report.rows; r++)
            gough_error_say(&report.map.row[r].error, &report.units);
        find_thresholds(&report);
        report.own_row = find_own_row(&report);
        scale_map(&report);
        status = tell(asked, &report);
    }
    free(report.map.point);
    free(report.map.row);
    free(report.map.interval);
    free(report.rest);
    return status;
}
