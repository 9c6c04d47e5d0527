/* One study as the page has it: numbers as JSON, columns of tables as base64 of little-endian doubles, so that nothing is
 * rounded and nothing is parsed twice. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/check/check_limits.h"
#include "cli/common/json.h"
#include "cli/common/left_out.h"
#include "cli/common/memory.h"
#include "cli/common/study_fields.h"
#include "cli/common/talk.h"
#include "cli/report/page_study.h"
#include "cli/run/run_report.h"
#include "cli/stability/stability_report.h"

/* 3 bytes to 4 characters, the last group filled up with '=' */
static json_t *base64(const unsigned char *bytes, size_t count) {
    static const char digit[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const size_t length = (count + 2) / 3 * 4;
    char *text = allocate(length + 1);
    for (size_t i = 0, k = 0; i < count; i += 3, k += 4) {
        const size_t left = count - i;
        const unsigned group = (unsigned)bytes[i] << 16 |
                               (left > 1 ? (unsigned)bytes[i + 1] : 0) << 8 |
                               (left > 2 ? (unsigned)bytes[i + 2] : 0);
        for (int c = 0; c < 4; c++) text[k + (size_t)c] = digit[group >> (18 - 6 * c) & 63];
        if (left < 3) text[k + 3] = '=';
        if (left < 2) text[k + 2] = '=';
    }
    json_t *string = json_stringn_nocheck(text, length);
    free(text);
    return string;
}

/* Numbers as bytes, least significant first whatever the machine's order. */
static json_t *base64_of_numbers(const double *value, size_t count) {
    unsigned char *bytes = allocate(8 * count + 1);
    for (size_t i = 0; i < count; i++) {
        uint64_t bits;
        memcpy(&bits, &value[i], sizeof bits);
        for (unsigned b = 0; b < 8; b++) bytes[8 * i + b] = (unsigned char)(bits >> 8 * b);
    }
    json_t *string = base64(bytes, 8 * count);
    free(bytes);
    return string;
}

/* Whether a column is of a joint: the page shows leg forces, but no others of them. */
static bool is_of_joint(const char *name) {
    for (int c = GOUGH_ON_TOP; c <= GOUGH_S_LAST; c++)
        if (strcmp(gough_column(c)->name, name) == 0) return true;
    return false;
}

/* Columns of a table; of the program's only what the page draws of it. */
static json_t *columns_of(const gough_result *result, bool program) {
    json_t *columns = json_array();
    gough_result_column column;
    for (int i = 0; gough_result_column_at(result, i, &column); i++) {
        static const char *const drawn[] = {"t",  "x",  "y",  "z",  "roll", "pitch", "yaw",
                                            "l1", "l2", "l3", "l4", "l5",   "l6",    "f1",
                                            "f2", "f3", "f4", "f5", "f6"};
        bool wanted = !program && !is_of_joint(column.name);
        for (size_t k = 0; k < sizeof drawn / sizeof *drawn; k++)
            wanted |= strcmp(column.name, drawn[k]) == 0;
        if (!wanted) continue;
        json_t *one = json_object();
        json_object_set_new(one, "name", json_string(column.name));
        json_object_set_new(one, "long_name", json_string(column.long_name));
        json_object_set_new(one, "unit", json_string(column.unit));
        json_object_set_new(one, "data", base64_of_numbers(column.value, column.rows));
        json_array_append_new(columns, one);
    }
    return columns;
}

/* whether six legs have different limits, each of `sides` numbers */
static bool differs(const double *bound, size_t sides) {
    bool different = false;
    for (size_t v = 1; v < GOUGH_LEGS; v++)
        different |= memcmp(bound, bound + sides * v, sides * sizeof *bound) != 0;
    return different;
}

/* Whether the force in a leg is another than that of its drive. */
static bool legs_take_force(const gough_machine *m) {
    bool rough = false;
    for (int v = 0; v < GOUGH_LEGS; v++)
        rough = rough || m->platform.friction.viscous[v] > 0 || m->breakaway[v] > 0 ||
                m->platform.friction.efficiency[v] < 1;
    return rough;
}

/* Masses and centres of one part of all legs. */
static json_t *part_object(const gough_leg_part *part, const gough_units *units) {
    json_t *object = json_object();
    double mass[GOUGH_LEGS], center[GOUGH_LEGS];
    for (int v = 0; v < GOUGH_LEGS; v++) {
        mass[v] = in_units(units, GOUGH_UNIT_MASS, part->mass[v]);
        center[v] = in_units(units, GOUGH_UNIT_LENGTH, part->center[v]);
    }
    json_object_set_new(object, "mass", json_numbers(mass, GOUGH_LEGS));
    json_object_set_new(object, "center", json_numbers(center, GOUGH_LEGS));
    return object;
}

/* For each kind of number the factor from units of the run to those of the study, and the name of its unit as in tables; and which
 * units are chosen, for the live run's sentences. */
static json_t *quantities_object(const gough_units *units) {
    static const struct {
        const char *name;
        gough_unit unit;
    } kinds[] = {{"length", GOUGH_UNIT_LENGTH},
                 {"mass", GOUGH_UNIT_MASS},
                 {"time", GOUGH_UNIT_TIME},
                 {"angle", GOUGH_UNIT_ANGLE},
                 {"rate", GOUGH_UNIT_RATE},
                 {"speed", GOUGH_UNIT_SPEED},
                 {"angular_speed", GOUGH_UNIT_ANGULAR_SPEED},
                 {"acceleration", GOUGH_UNIT_ACCELERATION},
                 {"force", GOUGH_UNIT_FORCE},
                 {"power", GOUGH_UNIT_POWER},
                 {"energy", GOUGH_UNIT_ENERGY},
                 {"stiffness", GOUGH_UNIT_STIFFNESS},
                 {"damping", GOUGH_UNIT_DAMPING},
                 {"inertia", GOUGH_UNIT_INERTIA}};
    json_t *object = json_object(), *chosen = json_array();
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        json_t *one = json_object();
        json_object_set_new(one, "factor", json_number(gough_unit_factor(units, kinds[i].unit)));
        json_object_set_new(one, "label", json_string(gough_unit_label(units, kinds[i].unit)));
        json_object_set_new(object, kinds[i].name, one);
    }
    for (int b = 0; b < GOUGH_BASE_UNITS; b++)
        json_array_append_new(chosen, json_integer(units->dimensionless ? -1 : units->name[b]));
    json_object_set_new(object, "chosen", chosen);
    return object;
}

static json_t *machine_object(const gough_study *study) {
    static const char *const keys[][2] = {{"base", "platform.base.joints"},
                                          {"top", "platform.top.joints"},
                                          {"height", "platform.height"},
                                          {"base_radius", NULL},
                                          {"mass", "load.mass"},
                                          {"center_of_mass", "load.center_of_mass"},
                                          {"inertia", "load.inertia"},
                                          {"gravity", "gravity"}};
    const gough_machine *m = &study->model->machine;
    static const double none[2] = {NAN, NAN};
    const gough_limits l = gough_limits_of(m, &study->model->motion);
    const double least = l.length[0][0], sum = l.force[0][0] + l.force[0][1];
    const bool either = differs(l.force[0], 2) || sum < 0 || sum > 0;
    const gough_units *u = &study->units;
    json_t *object = json_object(), *limits = json_object();
    double home[GOUGH_LEGS];
    for (int v = 0; v < GOUGH_LEGS; v++)
        home[v] = in_units(u, GOUGH_UNIT_LENGTH, m->home_length[v]);

    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++)
        json_object_set_new(object, keys[i][0],
                            keys[i][1]
                                ? json_field(study, keys[i][1])
                                : json_number(in_units(u, GOUGH_UNIT_LENGTH, m->base_radius)));
    json_object_set_new(
        limits, "length",
        json_numbers(
            two_in_units(u, GOUGH_UNIT_LENGTH, least > 0 ? least : NAN, l.length[0][1]).value, 2));
    if (differs(l.length[0], 2)) json_object_set_new(limits, "length", json_numbers(none, 2));
    json_object_set_new(
        limits, "speed",
        json_number(differs(l.speed, 1) ? NAN : in_units(u, GOUGH_UNIT_SPEED, l.speed[0])));
    json_object_set_new(limits, "force",
                        json_number(either ? NAN : in_units(u, GOUGH_UNIT_FORCE, l.force[0][1])));
    json_object_set_new(object, "limits", limits);
    json_object_set_new(object, "all_limits", limits_object(study));
    json_object_set_new(object, "home_length", json_numbers(home, GOUGH_LEGS));
    json_object_set_new(object, "home_condition", json_number(m->home_condition));
    json_object_set_new(object, "legs_have_mass", json_boolean(m->platform.legs_have_mass));
    json_object_set_new(object, "legs_take_force", json_boolean(legs_take_force(m)));
    json_object_set_new(object, "externals", json_integer((json_int_t)m->externals));
    const ignored_words ignored = words_of_ignored(study->model, true);
    json_object_set_new(object, "ignored", json_words(ignored.text));
    json_object_set_new(object, "cylinder", part_object(&m->platform.cylinder, u));
    json_object_set_new(object, "piston", part_object(&m->platform.piston, u));
    return object;
}

static json_t *simulation_object(const gough_study *study) {
    json_t *object = json_object();
    json_object_set_new(object, "duration", json_field(study, "simulation.duration"));
    json_object_set_new(object, "output_step", json_field(study, "simulation.output_step"));
    json_object_set_new(object, "tolerance", json_field(study, "simulation.tolerance"));
    json_object_set_new(object, "method", json_field(study, "simulation.method"));
    return object;
}

static json_t *end_object(const gough_end *end) {
    json_t *object = json_object();
    json_object_set_new(object, "status", json_string(gough_cause_name(end->cause)));
    json_object_set_new(object, "time", json_number(end->time));
    json_object_set_new(object, "leg", json_integer(end->leg));
    json_object_set_new(object, "message", json_words(end->message));
    return object;
}

/* The model for the live simulation; null for recorded motion so long that it would swell the page. */
static json_t *live_object(const gough_study *study) {
    enum { MOST_NUMBERS = 100000 };
    const size_t count = gough_model_flat_size(study->model);
    if (count > MOST_NUMBERS) return json_null();
    double *flat = allocate(count * sizeof *flat);
    gough_model_flatten(study->model, &study->simulation, flat);
    json_t *text = base64_of_numbers(flat, count);
    free(flat);
    return text;
}

/* Runs forces or simulate and adds its summary and table to the object. */
static gough_status add_run(const command_line *line, const gough_study *study, bool simulated,
                            json_t *object) {
    const char *verb = simulated ? "simulate" : "forces";
    run_report report = {.verb = verb, .simulated = simulated, .study = study};
    gough_error error = {0};
    gough_status status = gough_units_of_study(study, false, &report.units, &error);
    gough_result *result = status ? NULL : gough_result_new(study, verb, &report.units);
    if (!status && !result) status = gough_fail(&error, GOUGH_ERROR_FILE, "out of memory");
    if (!status) status = run_report_fill(&report, line, result, &error);
    if (status == GOUGH_OK || status == GOUGH_ERROR_NUMERICAL) {
        run_report_scale(&report);
        json_object_set_new(object, verb, run_report_json(&report));
        json_object_set_new(object, simulated ? "columns" : "program",
                            columns_of(result, !simulated));
        if (simulated) json_object_set_new(object, "end", end_object(&report.end));
    } else {
        complain_of(line->verb, study, &error);
    }
    free(report.crossings.list);
    gough_result_free(result);
    return status;
}

/* What gough stability finds, in the study's units; where there is no answer about the program, rest alone and the reason. */
static void add_stability(const gough_study *study, json_t *object) {
    stability_report *report = calloc(1, sizeof *report);
    gough_error error = {0};
    gough_status status = GOUGH_ERROR_FILE;
    if (report) {
        report->verb = "stability";
        report->study = study;
        report->units = study->units;
        status = stability_find(report, &error);
        if (status == GOUGH_ERROR_INPUT) {
            report->posed = true;
            report->periodic = report->ends = false;
            gough_error at_rest = {0};
            status = stability_find(report, &at_rest);
            if (status) error = at_rest;
        }
    }
    if (!status) stability_scale(report);
    json_object_set_new(object, "stability", status ? json_null() : stability_json(report, NULL));
    gough_error_say(&error, &study->units);
    json_object_set_new(object, "stability_message", json_words(error.message));
    free(report);
}

gough_status page_study(const command_line *line, gough_study *study, json_t **object) {
    json_t *page = *object = json_object();
    json_t *motion = json_object();

    /* before all that knows the columns: tables and the live run */
    study->simulation.joints = legs_take_force(&study->model->machine);
    json_object_set_new(page, "name", json_words(study->name));
    json_object_set_new(page, "title", json_words(study->title));
    json_object_set_new(page, "text", json_words(study->text));
    json_object_set_new(page, "units", json_units(&study->units));
    json_object_set_new(page, "quantities", quantities_object(&study->units));
    json_object_set_new(page, "machine", machine_object(study));
    json_object_set_new(motion, "about", json_field(study, "motion.about"));
    json_object_set_new(motion, "order", json_field(study, "motion.order"));
    json_object_set_new(page, "motion", motion);
    json_t *control = json_section(study, "control");
    if (study->model->control.sampling.period > 0)
        json_object_set_new(control, "sampling", json_section(study, "control.sampling"));
    json_object_set_new(page, "control", control);
    json_object_set_new(page, "simulation", simulation_object(study));
    json_object_set_new(page, "live", live_object(study));
    add_stability(study, page);
    const gough_status simulated = add_run(line, study, true, page);
    if (simulated > GOUGH_ERROR_NUMERICAL) return simulated;
    const gough_status forced = add_run(line, study, false, page);
    return forced > simulated ? forced : simulated;
}
