/* One study as the page has it: numbers as JSON, columns of tables packed (packed.c), so that nothing is rounded and nothing is
 * parsed twice. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/check/check_limits.h"
#include "cli/common/json.h"
#include "cli/common/left_out.h"
#include "cli/common/memory.h"
#include "cli/common/study_fields.h"
#include "cli/common/talk.h"
#include "cli/report/packed.h"
#include "cli/report/page_study.h"
#include "cli/run/run_report.h"
#include "cli/stability/stability_report.h"

/* Whether a column is of a joint: the page shows leg forces, but no others of them. */
static bool is_of_joint(const char *name) {
    for (int c = GOUGH_ON_TOP; c <= GOUGH_S_LAST; c++)
        if (strcmp(gough_column(c)->name, name) == 0) return true;
    return false;
}

/* What the page has of a column: its numbers, or without them what the page computes by itself, or nothing. */
typedef enum column_share { LEFT_OUT, COMPUTED, NUMBERS } column_share;

static bool is_among(const char *name, const char *const *names) {
    while (*names && strcmp(*names, name) != 0) names++;
    return *names != NULL;
}

/* Of the program only what the page draws of it. A thin page has pose, rates, forces and drift, from which its core computes the
 * rest; accelerations do not follow from them. `same_times`: deviations follow from the poses of run and program. */
static column_share share_of(const char *name, bool program, const page_options *options,
                             bool same_times) {
    static const char *const drawn[] = {"t",  "x",  "y",  "z",  "roll", "pitch", "yaw",
                                        "l1", "l2", "l3", "l4", "l5",   "l6",    "f1",
                                        "f2", "f3", "f4", "f5", "f6",   NULL};
    static const char *const deviations[] = {"ex", "ey", "ez", "eroll", "epitch", "eyaw", NULL};
    static const char *const accelerations[] = {"ax", "ay", "az", "alx", "aly", "alz", NULL};
    if (program ? !is_among(name, drawn) : is_of_joint(name)) return LEFT_OUT;
    if (!options->thin) return NUMBERS;
    if (is_among(name, accelerations)) return LEFT_OUT;
    if (is_among(name, deviations)) return same_times ? COMPUTED : NUMBERS;
    const bool of_leg = name[0] == 'l' || name[0] == 'p' || (name[0] == 'd' && name[1] == 'l');
    const bool numbered = name[strlen(name) - 1] >= '1' && name[strlen(name) - 1] <= '6';
    return (of_leg && numbered) || strcmp(name, "condition") == 0 ? COMPUTED : NUMBERS;
}

static json_t *columns_of(const gough_result *result, bool program, const page_options *options,
                          bool same_times) {
    json_t *columns = json_array();
    gough_result_column column;
    for (int i = 0; gough_result_column_at(result, i, &column); i++) {
        const column_share share = share_of(column.name, program, options, same_times);
        if (share == LEFT_OUT) continue;
        json_t *one = json_object();
        json_object_set_new(one, "name", json_string(column.name));
        json_object_set_new(one, "long_name", json_string(column.long_name));
        json_object_set_new(one, "unit", json_string(column.unit));
        if (share == NUMBERS) pack_numbers(one, column.value, column.rows);
        json_array_append_new(columns, one);
    }
    return columns;
}

/* Whether the rows of a run are the first ones of its program, at the same times to the bit. */
static bool have_same_times(const gough_result *run, const gough_result *program) {
    gough_result_column a, b;
    return gough_result_column_at(run, GOUGH_T, &a) &&
           gough_result_column_at(program, GOUGH_T, &b) && a.rows <= b.rows &&
           memcmp(a.value, b.value, a.rows * sizeof *a.value) == 0;
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

static json_t *flat_of(const gough_model *model, const gough_simulation *simulation) {
    const size_t count = gough_model_flat_size(model);
    double *flat = allocate(count * sizeof *flat);
    gough_model_flatten(model, simulation, flat);
    json_t *text = base64_of_numbers(flat, count);
    free(flat);
    return text;
}

/* The model for the live simulation; null for recorded motion so long that it would swell the page. */
static json_t *live_object(const gough_study *study) {
    enum { MOST_NUMBERS = 100000 };
    if (gough_model_flat_size(study->model) > MOST_NUMBERS) return json_null();
    return flat_of(study->model, &study->simulation);
}

/* The same machine at rest: what the columns of a thin page are computed of. */
static json_t *machine_at_rest(const gough_study *study) {
    gough_model model = *study->model;
    model.motion = (gough_motion){.order = study->model->motion.order};
    return flat_of(&model, &study->simulation);
}

/* Runs forces or simulate and adds its summary to the object; *table is to be freed. */
static gough_status add_run(const command_line *line, const gough_study *study, bool simulated,
                            json_t *object, gough_result **table) {
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
        if (simulated) json_object_set_new(object, "end", end_object(&report.end));
    } else {
        complain_of(line->verb, study, &error);
    }
    free(report.crossings.list);
    *table = result;
    return status;
}

/* Both runs with their tables. */
static gough_status add_runs(const command_line *line, const gough_study *study,
                             const page_options *options, json_t *object) {
    gough_result *run = NULL, *program = NULL;
    gough_status worst = add_run(line, study, true, object, &run);
    if (worst <= GOUGH_ERROR_NUMERICAL) {
        const gough_status forced = add_run(line, study, false, object, &program);
        if (forced > worst) worst = forced;
    }
    if (worst <= GOUGH_ERROR_NUMERICAL) {
        const bool same_times = have_same_times(run, program);
        json_object_set_new(object, "columns", columns_of(run, false, options, same_times));
        json_object_set_new(object, "program", columns_of(program, true, options, same_times));
    }
    gough_result_free(run);
    gough_result_free(program);
    return worst;
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

gough_status page_study(const command_line *line, const page_options *options, gough_study *study,
                        json_t **object) {
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
    if (options->thin) json_object_set_new(page, "at_rest", machine_at_rest(study));
    return add_runs(line, study, options, page);
}
