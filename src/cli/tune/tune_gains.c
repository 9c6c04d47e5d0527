/* gough tune --poles and --lqr: matrices of gains that couple the legs, as the keys of a study and as JSON, with the poles of the
 * loop at rest. */
#include "cli/tune/tune_gains.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/json.h"
#include "cli/common/left_out.h"
#include "cli/common/memory.h"
#include "cli/common/option_values.h"
#include "cli/common/paragraph.h"
#include "cli/common/scale.h"
#include "cli/common/talk.h"

enum { POLES = 2 * GOUGH_LEGS };

/* poles this close, over their size, are printed as one; a part of a pole below it is rounding */
static const double same_pole = 1e-9;

/* an element below this part of the largest of its matrix is rounding, and printed as 0 */
static const double no_gain = 1e-15;

/* ---- options ------------------------------------------------------------------------------------------------------ */

/* "2,0.7": two numbers. */
static bool read_two(const char *text, double value[2]) {
    const char *comma = strchr(text, ',');
    return comma && read_decimal(text, comma, &value[0]) &&
           read_decimal(comma + 1, comma + 1 + strlen(comma + 1), &value[1]);
}

static void read_poles(const struct argp_state *state, const option *o, const char *text,
                       void *group) {
    gains_options *asked = group;
    double *value = asked->poles;
    if (!read_two(text, value) || value[0] <= 0 || value[1] < 0 || value[1] > 1)
        usage_error(state,
                    "--%s takes a frequency greater than 0, in cycles per unit of time, and a "
                    "damping ratio from 0 to 1, as in --poles 2,0.7; got '%s'",
                    o->name, text);
}

static void read_lqr(const struct argp_state *state, const option *o, const char *text,
                     void *group) {
    gains_options *asked = group;
    double *value = asked->lqr;
    if (!read_two(text, value) || value[0] < 0 || value[1] < 0)
        usage_error(state,
                    "--%s takes two weights of 0 or more, of errors of length and of their rates, "
                    "as in --lqr 1e6,1e4; got '%s'",
                    o->name, text);
}

static void read_gains_pose(const struct argp_state *state, const option *o, const char *text,
                            void *group) {
    gains_options *asked = group;
    gough_error error = {0};
    (void)o;
    asked->posed = true;
    if (!read_pose("pose", text, asked->pose, &error)) usage_error(state, "%s", error.message);
}

static void begin_gains(void *group) {
    gains_options *asked = group;
    *asked = (gains_options){.poles = {NAN, NAN}, .lqr = {NAN, NAN}};
}

static const option gains_option[] = {
    {.name = "poles",
     .value = "F,ZETA",
     .read = read_poles,
     .text = "instead of a search: matrices of stiffness and damping that give all six modes at "
             "rest the frequency F, in cycles per unit of time, and the damping ratio ZETA, "
             "0 <= ZETA <= 1"},
    {.name = "lqr",
     .value = "Q1,Q2",
     .read = read_lqr,
     .text = "instead of a search: matrices of stiffness and damping of least cost at rest, which "
             "is the integral of Q1 e^2 + Q2 (de/dt)^2 + u^2 over all legs, with e the error of "
             "length and u the force of the feedback; Q1 has the unit of stiffness squared, Q2 "
             "that of damping squared"},
    {.name = "pose",
     .value = "C=X,...",
     .many = true,
     .read = read_gains_pose,
     .text = "with --poles or --lqr: rest in this pose, given by its components from home, as in "
             "heave=0.1,yaw=10 (default: home)"},
    {0}};

const option_group gains_group = {gains_option, begin_gains, NULL};

static bool by_poles(const gains_options *asked) { return isfinite(asked->poles[0]); }

bool gains_asked(const gains_options *asked) {
    return by_poles(asked) || isfinite(asked->lqr[0]) || asked->posed;
}

const char *gains_contradiction(const gains_options *asked) {
    if (by_poles(asked) && isfinite(asked->lqr[0]))
        return "--poles and --lqr each determine all gains; give only one of them";
    if (!by_poles(asked) && !isfinite(asked->lqr[0]))
        return "--pose is where the gains of --poles or --lqr are computed; give one of these too, "
               "as in --poles 2,0.7";
    return NULL;
}

/* ---- finding ------------------------------------------------------------------------------------------------------ */

typedef struct gains_report {
    const char *verb;
    const gough_study *study;
    const gains_options *asked;
    gough_units units;
    gough_gains gains; /* in units of the run */
    bool sampled;      /* the study's controller is, and stability with it is known: */
    double radius, growth;
    bool stable;
} gains_report;

/* What the gains do under the study's own controller, if it is sampled. */
static void find_samples(gains_report *report, const double component[GOUGH_COMPONENTS]) {
    const gough_model *own = report->study->model;
    if (!(own->control.sampling.period > 0)) return;
    gough_model *model = allocate(sizeof *model);
    gough_sampled_rest rest;
    *model = *own;
    model->control.feedforward = true; /* as the poles have it */
    gough_gains_apply(&report->gains, &model->control);
    report->sampled = gough_sampled_at_rest(model, component, &rest, NULL) == GOUGH_OK;
    free(model);
    if (!report->sampled) return;
    report->radius = rest.radius;
    report->growth = rest.growth;
    report->stable = rest.stable;
}

static gough_status find_gains(const gains_report *report, const double component[GOUGH_COMPONENTS],
                               gough_gains *gains, gough_error *error) {
    const gains_options *asked = report->asked;
    const gough_study *study = report->study;
    const gough_units *own = &study->units;
    if (by_poles(asked))
        return gough_gains_by_poles(study->model, component,
                                    gough_unit_read(own, GOUGH_UNIT_RATE, asked->poles[0]),
                                    asked->poles[1], gains, error);
    const double stiffness = gough_unit_read(own, GOUGH_UNIT_STIFFNESS, 1),
                 damping = gough_unit_read(own, GOUGH_UNIT_DAMPING, 1);
    return gough_gains_by_lqr(study->model, component, asked->lqr[0] * stiffness * stiffness,
                              asked->lqr[1] * damping * damping, gains, error);
}

static gough_status find(gains_report *report, gough_error *error) {
    const gough_units *own = &report->study->units;
    double component[GOUGH_COMPONENTS];
    for (int c = 0; c < GOUGH_COMPONENTS; c++)
        component[c] = gough_unit_read(own, component_unit(c), report->asked->pose[c]);
    const gough_status status = find_gains(report, component, &report->gains, error);
    if (!status) find_samples(report, component);
    return status;
}

/* ---- for reading -------------------------------------------------------------------------------------------------- */

static bool same(const gough_eigenvalue *a, const gough_eigenvalue *b, bool named) {
    const double size = hypot(a->value[0], a->value[1]);
    return fabs(a->value[0] - b->value[0]) <= same_pole * size &&
           fabs(a->value[1] - b->value[1]) <= same_pole * size &&
           (!named || strcmp(a->mode.name, b->mode.name) == 0);
}

/* Equal poles on one line; of a pair the upper one. */
static void print_poles(FILE *stream, const gains_report *report) {
    const gough_units *u = &report->units;
    const bool named = !by_poles(report->asked);
    const double rate = gough_unit_factor(u, GOUGH_UNIT_RATE);
    const char *time = unit_word(u, GOUGH_UNIT_TIME);
    char turning[24] = "";
    bool told[POLES] = {false};
    if (*time) snprintf(turning, sizeof turning, "[rad/%s]", time + 1);
    fprintf(stream, "\nPoles of the loop at rest: deviations vary as exp(lambda t)\n");
    const table_heading growth = heading_of("growth", unit_word(u, GOUGH_UNIT_RATE));
    char frequency[48];
    snprintf(frequency, sizeof frequency, "frequency%s%s", *turning ? " " : "", turning);
    fprintf(stream, "%18s%22s%16s\n", growth.text, frequency, "damping ratio");
    for (int k = 0; k < POLES; k++) {
        const gough_eigenvalue *pole = &report->gains.pole[k];
        const double size = hypot(pole->value[0], pole->value[1]);
        const bool paired = fabs(pole->value[1]) > same_pole * size;
        int count = 0;
        if (told[k] || pole->value[1] < -same_pole * size) continue;
        for (int j = k; j < POLES; j++) {
            if (told[j] || !same(pole, &report->gains.pole[j], named)) continue;
            told[j] = true;
            count++;
        }
        fprintf(stream, "%18.10g%22.10g%16.6g   %d %s%s%s%s\n", pole->value[0] * rate,
                paired ? pole->value[1] * rate : 0, -pole->value[0] / size, count,
                paired ? "pair" : "pole", count == 1 ? "" : "s", named ? ", " : "",
                named ? pole->mode.name : "");
    }
}

/* A matrix as the value of a key, in the study's units. */
static void print_matrix(FILE *stream, const char *key, const double *matrix, double factor) {
    double largest = 0;
    for (int i = 0; i < GOUGH_LEGS * GOUGH_LEGS; i++) largest = fmax(largest, fabs(matrix[i]));
    fprintf(stream, "  %s:\n", key);
    for (int i = 0; i < GOUGH_LEGS * GOUGH_LEGS; i++) {
        const double value = fabs(matrix[i]) > no_gain * largest ? matrix[i] * factor : 0;
        const int column = i % GOUGH_LEGS;
        fprintf(stream, "%s%20.13g%s", column == 0 ? "    - [" : " ", value,
                column + 1 < GOUGH_LEGS ? "," : "]\n");
    }
}

static void print_keys(FILE *stream, const gains_report *report) {
    const gough_units *own = &report->study->units;
    fprintf(stream, "\n");
    print_paragraph(stream, "", 0,
                    "Put these keys in place of the study's own. Row n has the gains of the force "
                    "of leg n, column m those for the error of leg m; numbers are in the units of "
                    "the study.");
    fprintf(stream, "\ncontrol:\n");
    print_matrix(stream, "stiffness", report->gains.stiffness[0],
                 gough_unit_factor(own, GOUGH_UNIT_STIFFNESS));
    print_matrix(stream, "damping", report->gains.damping[0],
                 gough_unit_factor(own, GOUGH_UNIT_DAMPING));
}

/* ", surge 0.1 m, yaw 5 deg" */
static void pose_words(const gains_report *report, char *text, size_t size) {
    size_t used = 0;
    text[0] = '\0';
    for (int c = 0; c < GOUGH_COMPONENTS && used < size; c++)
        if (fabs(report->asked->pose[c]) > 0)
            used += (size_t)snprintf(text + used, size - used, "%s%s %.6g%s", used ? ", " : "",
                                     gough_component_name(c), report->asked->pose[c],
                                     unit_word(&report->study->units, component_unit(c)));
    if (!used) snprintf(text, size, "home");
}

/* What the study has that these gains do not count with. */
static void print_reservations(FILE *stream, const gains_report *report) {
    const gough_model *model = report->study->model;
    const gough_control *control = &model->control;
    bool integral = false;
    for (int v = 0; v < GOUGH_LEGS; v++) integral = integral || control->integral[v] > 0;
    const bool sampled = control->sampling.period > 0,
               late = model->machine.platform.actuators.kind != GOUGH_ACTUATOR_IDEAL;
    if (!control->feedforward) {
        fprintf(stream, "\n");
        print_paragraph(stream, "", 0,
                        "These are the poles where the forces that hold the pose are fed forward. "
                        "This study has control.feedforward: none, so the platform sags away from "
                        "the pose, and its poles differ.");
    }
    if (sampled || late || integral) {
        fprintf(stream, "\n");
        print_paragraph(stream, "", 0,
                        "These are the poles of a continuous controller without integral and of "
                        "drives without lag. This study has %s%s%s%s%s, so its poles differ.",
                        sampled ? "control.sampling" : "",
                        sampled && (late || integral) ? ", " : "",
                        late ? "actuators.kind: lag" : "", late && integral ? ", " : "",
                        integral ? "control.integral" : "");
    }
    if (report->sampled)
        print_paragraph(
            stream, "", 0,
            "With the study's own controller, sampled every %.6g%s, deviations at rest "
            "%s by a factor of %.6g from sample to sample.",
            control->sampling.period * gough_unit_factor(&report->units, GOUGH_UNIT_TIME),
            unit_word(&report->units, GOUGH_UNIT_TIME),
            report->stable ? "become smaller, the slowest of them" : "grow", report->radius);
    print_left_out_friction(stream, model);
}

/* a weight of --lqr with its unit, the square of another */
static void squared(const gains_report *report, double weight, gough_unit unit, char text[80]) {
    const char *word = unit_word(&report->study->units, unit);

    if (*word)
        snprintf(text, 80, "%.10g (%s)^2", weight, word + 1);
    else
        snprintf(text, 80, "%.10g", weight);
}

static void print(FILE *stream, const gains_report *report) {
    const gains_options *asked = report->asked;
    const char *time = unit_word(&report->study->units, GOUGH_UNIT_TIME);
    char pose[200], length[80], rate[80];
    pose_words(report, pose, sizeof pose);
    squared(report, asked->lqr[0], GOUGH_UNIT_STIFFNESS, length);
    squared(report, asked->lqr[1], GOUGH_UNIT_DAMPING, rate);
    print_title(stream, report->study->title);
    if (by_poles(asked))
        print_paragraph(stream, "", 0,
                        "Gains that give every mode at rest (%s) the frequency of %.10g cycles "
                        "per %s and the damping ratio %.10g",
                        pose, asked->poles[0], *time ? time + 1 : "unit of time", asked->poles[1]);
    else
        print_paragraph(stream, "", 0,
                        "Gains of least cost at rest (%s) with the weights %s of errors of "
                        "length and %s of their rates",
                        pose, length, rate);
    fprintf(stream, "%s\n", units_sentence(report->study, &report->units).text);
    print_poles(stream, report);
    print_reservations(stream, report);
    print_keys(stream, report);
}

/* ---- JSON --------------------------------------------------------------------------------------------------------- */

static json_t *rows_of(const double *matrix, double factor) {
    json_t *rows = json_array();
    for (int i = 0; i < GOUGH_LEGS; i++) {
        double row[GOUGH_LEGS];
        for (int j = 0; j < GOUGH_LEGS; j++) row[j] = matrix[GOUGH_LEGS * i + j] * factor;
        json_array_append_new(rows, json_numbers(row, GOUGH_LEGS));
    }
    return rows;
}

static json_t *asked_object(const gains_report *report) {
    const gains_options *asked = report->asked;
    const gough_units *own = &report->study->units, *u = &report->units;
    json_t *object = json_object(), *pose = json_object();
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        const gough_unit unit = component_unit(c);
        json_object_set_new(
            pose, gough_component_name(c),
            json_number(in_units(u, unit, gough_unit_read(own, unit, asked->pose[c]))));
    }
    const double rate =
                     gough_unit_factor(u, GOUGH_UNIT_RATE) * gough_unit_size(own, GOUGH_UNIT_RATE),
                 stiffness = gough_unit_factor(u, GOUGH_UNIT_STIFFNESS) *
                             gough_unit_size(own, GOUGH_UNIT_STIFFNESS),
                 damping = gough_unit_factor(u, GOUGH_UNIT_DAMPING) *
                           gough_unit_size(own, GOUGH_UNIT_DAMPING);
    json_object_set_new(object, "frequency", json_number(asked->poles[0] * rate));
    json_object_set_new(object, "damping_ratio", json_number(asked->poles[1]));
    json_object_set_new(object, "length_weight",
                        json_number(asked->lqr[0] * stiffness * stiffness));
    json_object_set_new(object, "rate_weight", json_number(asked->lqr[1] * damping * damping));
    json_object_set_new(object, "pose", pose);
    return object;
}

/* null with a continuous controller */
static json_t *sampled_object(const gains_report *report) {
    if (!report->sampled) return json_null();
    const double rate = gough_unit_factor(&report->units, GOUGH_UNIT_RATE);
    json_t *object = json_object();
    json_object_set_new(object, "radius", json_number(report->radius));
    json_object_set_new(object, "growth_rate", json_number(report->growth * rate));
    json_object_set_new(object, "stable", json_boolean(report->stable));
    return object;
}

static json_t *gains_object(const gains_report *report) {
    const gough_units *u = &report->units;
    const gough_gains *gains = &report->gains;
    const double rate = gough_unit_factor(u, GOUGH_UNIT_RATE);
    json_t *object = json_object(), *poles = json_array(), *modes = json_array();
    for (int k = 0; k < POLES; k++) {
        const double value[2] = {gains->pole[k].value[0] * rate, gains->pole[k].value[1] * rate};
        json_array_append_new(poles, json_numbers(value, 2));
        json_array_append_new(modes, json_words(gains->pole[k].mode.name));
    }
    json_object_set_new(object, "stiffness",
                        rows_of(gains->stiffness[0], gough_unit_factor(u, GOUGH_UNIT_STIFFNESS)));
    json_object_set_new(object, "damping",
                        rows_of(gains->damping[0], gough_unit_factor(u, GOUGH_UNIT_DAMPING)));
    json_object_set_new(object, "poles", poles);
    json_object_set_new(object, "modes", modes);
    json_object_set_new(object, "residual",
                        json_number(by_poles(report->asked) ? (double)NAN : gains->residual));
    json_object_set_new(object, "sampled", sampled_object(report));
    return object;
}

static int print_json(const gains_report *report) {
    json_t *object = json_object();
    json_object_set_new(object, "verb", json_string(report->verb));
    json_object_set_new(object, "title", json_words(report->study->title));
    json_object_set_new(object, "units", json_units(&report->units));
    json_object_set_new(object, "friction_left_out",
                        json_boolean(leaves_out_friction(report->study->model)));
    json_object_set_new(object, "asked", asked_object(report));
    json_object_set_new(object, "gains", gains_object(report));
    return json_print(object);
}

/* ---- the answer --------------------------------------------------------------------------------------------------- */

gough_status gains_answer(const command_line *line, const gains_options *asked,
                          const gough_study *study) {
    gains_report report = {.verb = line->verb, .study = study, .asked = asked};
    gough_error error = {0};
    gough_status status = gough_units_of_study(study, line->dimensionless, &report.units, &error);
    if (!status) status = find(&report, &error);
    if (status) {
        complain_of(line->verb, study, &error);
        return status;
    }
    if (line->json) return print_json(&report) ? GOUGH_ERROR_FILE : GOUGH_OK;
    if (!line->quiet) print(stdout, &report);
    return GOUGH_OK;
}
