/* A stability map for reading and as JSON: thresholds, and the intervals of stiffness in which a mode grows. */
#include <math.h>
#include <string.h>

#include "cli/common/json.h"
#include "cli/common/left_out.h"
#include "cli/common/paragraph.h"
#include "cli/common/scale.h"
#include "cli/common/talk.h"
#include "cli/run/run_report.h"
#include "cli/stability/stability_map.h"

/* ---- for reading ------------------------------------------------------------------------------------------------- */

static void print_range(FILE *stream, const gough_map_range *range, const char *unit) {
    fprintf(stream, "%zu value%s from %.6g to %.6g%s%s", range->count, range->count == 1 ? "" : "s",
            range->from, range->to, unit, range->logarithmic ? ", in equal ratios" : "");
}

static const char *second_unit(const map_report *report) {
    return unit_word(&report->units, map_axis_unit(report->options.axis));
}

static void print_axes(FILE *stream, const map_report *report) {
    const char *axis = map_axis_name(report);
    fprintf(stream, "Stability map over the stiffness G, %s: ",
            report->study->model->control.coupled ? "the largest on the diagonal of its matrix"
                                                  : "the same in all legs");
    print_range(stream, &report->options.stiffness,
                unit_word(&report->units, GOUGH_UNIT_STIFFNESS));
    if (axis) {
        fprintf(stream, ";\nover the %s%s%s: ", axis,
                map_axis_unit(report->options.axis) == GOUGH_UNIT_TIME ? " of the controller" : "",
                map_axis_is_factor(report->options.axis) ? ", a factor on the study's" : "");
        print_range(stream, &report->options.second, second_unit(report));
    }
    if (*map_modes_of(report).text)
        fprintf(stream, "\nOnly modes that move in nothing but %s count.",
                map_modes_of(report).text);
    fprintf(stream, "\n%s\n", units_sentence(report->study, &report->units).text);
    print_left_out_friction(stream, report->study->model);
}

static void print_thresholds(FILE *stream, const map_report *report) {
    const char *unit = unit_word(&report->units, GOUGH_UNIT_STIFFNESS);
    if (!report->rest) return;
    fprintf(stream, "\nLeast stiffness at home and at rest, for each mode\n");
    for (int i = 0; i < 6; i++) {
        const gough_threshold *t = &report->rest->threshold[i];
        const bool again = i > 0 && strcmp(t->mode.name, t[-1].mode.name) == 0 &&
                           fabs(t->stiffness - t[-1].stiffness) <= 1e-9 * fabs(t->stiffness);
        if (again) continue;
        fprintf(stream, "  ");
        stability_pad(stream, t->mode.name, 20);
        fprintf(stream, "%12.6g%s%s\n", t->stiffness, unit,
                t->neutral ? "   any G > 0 holds it" : "");
    }
}

static const char *kind_words(gough_interval_kind kind) {
    switch (kind) {
    case GOUGH_INTERVAL_STATIC:
        return "below threshold";
    case GOUGH_INTERVAL_PLUS:
        return "resonance at +1";
    case GOUGH_INTERVAL_MINUS:
        return "resonance at -1";
    case GOUGH_INTERVAL_COMBINATION:
        return "two modes";
    case GOUGH_INTERVAL_OSCILLATION:
        return "oscillation";
    }
    return "";
}

static void print_cell(FILE *stream, double value) {
    if (isfinite(value))
        fprintf(stream, "%12.6g", value);
    else
        fprintf(stream, "%12s", "-");
}

/* At rest there is no motion to be in resonance with. */
static void print_interval(FILE *stream, const gough_interval *i, bool resting) {
    char name[GOUGH_MODE_NAME + 16];
    snprintf(name, sizeof name, i->modes > 1 ? "%s ×%d" : "%s", i->mode.name, i->modes);
    fprintf(stream, "  ");
    stability_pad(stream, name, 19);
    print_cell(stream, i->from);
    print_cell(stream, i->to);
    fprintf(stream, "%c", i->cut ? '+' : ' ');
    print_cell(stream, i->growth);
    print_cell(stream, i->rate);
    print_cell(stream, i->stiffness);
    fprintf(stream, "   %s\n",
            kind_words(resting && i->kind != GOUGH_INTERVAL_OSCILLATION ? GOUGH_INTERVAL_STATIC
                                                                        : i->kind));
}

/* "At amplitude 0.5" */
static void print_row_heading(FILE *stream, const map_report *report, const gough_map_row *row) {
    const gough_units *unit = &report->units;
    const bool lower = map_axis_name(report) != NULL;
    fprintf(stream, "\n");
    if (lower)
        fprintf(stream, "At %s %.6g%s, ", map_axis_name(report), row->value, second_unit(report));
    if (row->error.status)
        fprintf(stream, "%s values: %s\n", lower ? "there are no" : "There are no",
                row->error.message);
    else if (row->period.resting)
        fprintf(stream, "%s the program is at rest", lower ? "where" : "Where");
    else
        fprintf(stream, "%s the program, of period %.9g%s", lower ? "along" : "Along",
                row->period.period, unit_word(unit, GOUGH_UNIT_TIME));
    if (row->error.status) return;
    if (row->sampling > 0)
        fprintf(stream, ", sampled every %.9g%s", row->sampling, unit_word(unit, GOUGH_UNIT_TIME));
    fprintf(stream, ": ");
}

static void print_row(FILE *stream, const map_report *report, size_t r) {
    const gough_map_row *row = &report->map.row[r];
    const gough_units *unit = &report->units;
    bool cut = false;
    print_row_heading(stream, report, row);
    if (row->error.status) return;
    if (row->intervals == 0) {
        fprintf(stream, "nothing grows at any G in this range\n");
        return;
    }
    const table_heading from = heading_of("from G", unit_word(unit, GOUGH_UNIT_STIFFNESS)),
                        rate = heading_of("rate", unit_word(unit, GOUGH_UNIT_RATE));
    fprintf(stream, "ranges of G in which a mode grows\n  %-19s%12s%12s %12s%12s%12s\n", "mode",
            from.text, "to", row->period.resting ? "" : "per period", rate.text, "at G");
    for (size_t i = 0; i < row->intervals; i++) {
        const gough_interval *one = &report->map.interval[r * report->options.intervals + i];
        print_interval(stream, one, row->period.resting);
        cut = cut || one->cut;
    }
    if (cut) fprintf(stream, "  + the range continues above this map\n");
    if (row->intervals_missed)
        fprintf(stream, "  and %zu more ranges; a map over a narrower range of G lists them\n",
                row->intervals_missed);
}

/* Rows that failed are counted, and the first says why. */
static void print_failures(FILE *stream, const map_report *report) {
    size_t failed = 0, first = 0;
    for (size_t r = report->rows; r-- > 0;)
        if (report->map.row[r].error.status) failed++, first = r;
    if (failed && map_axis_name(report))
        fprintf(stream, "\n%zu of %zu rows have no values; the first is at %s %.6g%s: %s\n", failed,
                report->rows, map_axis_name(report), report->map.row[first].value,
                second_unit(report), report->map.row[first].error.message);
}

/* The period of the controller that a row is for. */
static double asked_period(const map_report *report, const gough_map_row *row) {
    if (report->options.axis == GOUGH_MAP_PERIOD) return row->value;
    return in_units(&report->units, GOUGH_UNIT_TIME, report->study->model->control.sampling.period);
}

static void print_adjusted(FILE *stream, const map_report *report) {
    size_t adjusted = 0;
    double most = 0;
    for (size_t r = 0; r < report->rows; r++) {
        const gough_map_row *row = &report->map.row[r];
        const double asked = asked_period(report, row), part = fabs(row->sampling / asked - 1);
        if (row->error.status || !(row->sampling > 0) || !(part > 2e-9)) continue;
        adjusted++;
        most = fmax(most, part);
    }
    if (!adjusted) return;
    fprintf(stream, "\n");
    if (report->rows > 1)
        print_paragraph(
            stream, "", 0,
            "%zu of %zu rows are for a period of the controller that differs from the one asked "
            "for by up to %.2g %%: the period of the program must be a whole number of periods of "
            "the controller, and these are the nearest.",
            adjusted, report->rows, 100 * most);
    else
        print_paragraph(
            stream, "", 0,
            "The map is for a period of the controller near the study's own: the period of the "
            "program must be a whole number of periods of the controller.");
}

static void print_share(FILE *stream, const map_report *report) {
    size_t stable = 0, gaps = 0;
    const size_t columns = report->options.stiffness.count, points = report->rows * columns;
    for (size_t p = 0; p < points; p++) {
        stable += report->map.point[p].stable;
        gaps += isnan(report->map.point[p].rate) && !report->map.row[p / columns].error.status;
    }
    fprintf(stream, "\n%zu of the %zu points of the map are stable (%.3g %%).\n", stable, points,
            100.0 * (double)stable / (double)points);
    if (gaps)
        print_paragraph(stream, "", 0,
                        "%zu point%s no values: no motion that repeats itself was found there%s.",
                        gaps, gaps == 1 ? " has" : "s have",
                        report->options.modes
                            ? ", or the growth of the modes that count is below 1e-9 of that of "
                              "another mode, and so is lost in its rounding"
                            : "");
}

void map_print(FILE *stream, const map_report *report, bool all) {
    print_title(stream, report->study->title);
    print_axes(stream, report);
    print_thresholds(stream, report);
    for (size_t r = 0; r < report->rows; r++)
        if (all || r == report->own_row) print_row(stream, report, r);
    print_adjusted(stream, report);
    print_share(stream, report);
    print_failures(stream, report);
}

/* ---- as JSON ----------------------------------------------------------------------------------------------------- */

static json_t *range_values(const gough_map_range *range) {
    json_t *values = json_array();
    for (size_t i = 0; i < range->count; i++)
        json_array_append_new(values, json_number(gough_map_value(range, i)));
    return values;
}

/* One list for each row of the map, of one thing about its points. */
static json_t *grid_of(const map_report *report, json_t *(*take)(const gough_map_point *point)) {
    const size_t columns = report->options.stiffness.count;
    json_t *rows = json_array();
    for (size_t r = 0; r < report->rows; r++) {
        json_t *row = json_array();
        for (size_t c = 0; c < columns; c++)
            json_array_append_new(row, take(&report->map.point[r * columns + c]));
        json_array_append_new(rows, row);
    }
    return rows;
}

static json_t *take_growth(const gough_map_point *point) { return json_number(point->growth); }
static json_t *take_rate(const gough_map_point *point) { return json_number(point->rate); }
static json_t *take_stable(const gough_map_point *point) { return json_boolean(point->stable); }
static json_t *take_mode(const gough_map_point *point) { return json_words(point->mode); }

static json_t *row_object(const gough_map_row *row) {
    json_t *object = json_object();
    json_object_set_new(object, "value", json_number(row->value));
    json_object_set_new(object, "error",
                        row->error.status ? json_words(row->error.message) : json_null());
    json_object_set_new(object, "period",
                        json_number(row->period.period > 0 ? row->period.period : NAN));
    json_object_set_new(object, "sampling_period",
                        json_number(row->sampling > 0 ? row->sampling : NAN));
    json_object_set_new(object, "periods",
                        row->periods > 0 ? json_integer((json_int_t)row->periods) : json_null());
    json_object_set_new(object, "tongues", json_integer((json_int_t)row->intervals));
    json_object_set_new(object, "tongues_missed", json_integer((json_int_t)row->intervals_missed));
    return object;
}

static json_t *interval_object(double value, const gough_interval *i) {
    json_t *object = json_object();
    json_object_set_new(object, "value", json_number(value));
    json_object_set_new(object, "mode", json_words(i->mode.name));
    json_object_set_new(object, "modes", json_integer(i->modes));
    json_object_set_new(object, "kind", json_string(gough_interval_kind_name(i->kind)));
    json_object_set_new(object, "from", json_number(i->from));
    json_object_set_new(object, "to", json_number(i->to));
    json_object_set_new(object, "cut", json_boolean(i->cut));
    json_object_set_new(object, "stiffness", json_number(i->stiffness));
    json_object_set_new(object, "growth_per_period", json_number(i->growth));
    json_object_set_new(object, "growth_rate", json_number(i->rate));
    return object;
}

static json_t *threshold_list(const gough_rest *rest) {
    json_t *list = json_array();
    for (int i = 0; rest && i < 6; i++) {
        json_t *threshold = json_object();
        json_object_set_new(threshold, "mode", json_words(rest->threshold[i].mode.name));
        json_object_set_new(threshold, "stiffness", json_number(rest->threshold[i].stiffness));
        json_array_append_new(list, threshold);
    }
    return list;
}

int map_print_json(const map_report *report) {
    const char *axis = map_axis_name(report);
    json_t *object = json_object(), *map = json_object(), *rows = json_array(),
           *tongues = json_array();
    for (size_t r = 0; r < report->rows; r++) {
        const gough_map_row *row = &report->map.row[r];
        json_array_append_new(rows, row_object(row));
        for (size_t i = 0; i < row->intervals; i++)
            json_array_append_new(
                tongues, interval_object(axis ? row->value : NAN,
                                         &report->map.interval[r * report->options.intervals + i]));
    }
    json_object_set_new(map, "stiffness", range_values(&report->options.stiffness));
    json_object_set_new(map, "axis", axis ? json_string(axis) : json_null());
    json_object_set_new(map, "modes",
                        *map_modes_of(report).text ? json_string(map_modes_of(report).text)
                                                   : json_null());
    json_object_set_new(map, "rows", rows);
    json_object_set_new(map, "growth_per_period", grid_of(report, take_growth));
    json_object_set_new(map, "growth_rate", grid_of(report, take_rate));
    json_object_set_new(map, "stable", grid_of(report, take_stable));
    json_object_set_new(map, "mode", grid_of(report, take_mode));

    json_object_set_new(object, "verb", json_string(report->verb));
    json_object_set_new(object, "title", json_words(report->study->title));
    json_object_set_new(object, "units", json_units(&report->units));
    json_object_set_new(object, "friction_left_out",
                        json_boolean(leaves_out_friction(report->study->model)));
    json_object_set_new(object, "thresholds", threshold_list(report->rest));
    json_object_set_new(object, "map", map);
    json_object_set_new(object, "tongues", tongues);
    return json_print(object);
}
