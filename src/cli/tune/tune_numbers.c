/* The numbers of gough tune in the units of the output, and as JSON: the same keys in the same order always; null where there is
 * no number. */
#include <jansson.h>
#include <math.h>
#include <string.h>

#include "cli/common/json.h"
#include "cli/common/left_out.h"
#include "cli/tune/tune_report.h"

/* ---- what each number measures, and its key in the JSON ----------------------------------------------------------- */

/* of the G found */
static const scaled_member found_members[] = {
    KEYED(gough_tuning, stiffness, STIFFNESS, "stiffness"),
    KEYED(gough_tuning, damping, DAMPING, "damping"),
    KEYED(gough_tuning, damping_ratio, NONE, "damping_ratio"),
    KEYED(gough_tuning, deviation, LENGTH, "deviation"),
    KEYED(gough_tuning, deviation_time, TIME, "deviation_time"),
    KEYED(gough_tuning, angle_deviation, ANGLE, "angle_deviation"),
    KEYED(gough_tuning, angle_time, TIME, "angle_time"),
    KEYED(gough_tuning, fails, STIFFNESS, "fails")};

/* of the legs that it needs */
static const scaled_member leg_members[] = {KEYED(gough_tuning, force, FORCE, "force"),
                                            KEYED(gough_tuning, force_share, NONE, "force_share"),
                                            KEYED(gough_tuning, speed, SPEED, "speed"),
                                            KEYED(gough_tuning, speed_share, NONE, "speed_share")};

/* of the curve of deviation against stiffness */
static const scaled_member curve_members[] = {KEYED(gough_tuning, slope, NONE, "slope"),
                                              KEYED(gough_tuning, scale, LENGTH, "scale")};

/* of the machine at rest */
static const scaled_member rest_members[] = {
    KEYED(gough_tuning, threshold, STIFFNESS, "stiffness")};

/* of the upper edge of a sampled loop */
static const scaled_member upper_members[] = {
    KEYED(gough_tuning, upper, STIFFNESS, "stiffness"),
    KEYED(gough_tuning, upper_frequency, RATE, "frequency")};

/* of what was asked for */
static const scaled_member asked_members[] = {
    KEYED(gough_tuning_options, deviation, LENGTH, "deviation"),
    KEYED(gough_tuning_options, angle_deviation, ANGLE, "angle_deviation"),
    KEYED(gough_tuning_options, damping_ratio, NONE, "damping_ratio"),
    KEYED(gough_tuning_options, margin, NONE, "margin")};

static const scaled_member range_members[] = {SCALED(gough_tuning_options, least, STIFFNESS),
                                              SCALED(gough_tuning_options, greatest, STIFFNESS)};

static const scaled_member exception_members[] = {SCALED(gough_tuning_exception, from, STIFFNESS),
                                                  SCALED(gough_tuning_exception, to, STIFFNESS)};

static const scaled_member point_members[] = {
    SCALED(gough_tuning_point, stiffness, STIFFNESS),
    SCALED(gough_tuning_point, damping, DAMPING),
    SCALED(gough_tuning_point, end_time, TIME),
    SCALED(gough_tuning_point, position_deviation, LENGTH),
    SCALED(gough_tuning_point, angle_deviation, ANGLE),
    SCALED(gough_tuning_point, force, FORCE),
    SCALED(gough_tuning_point, speed, SPEED)};

void tune_scale(tune_report *report) {
    const gough_units *u = &report->units;
    SCALE(&report->asked, asked_members, u);
    SCALE(&report->asked, range_members, u);
    for (int c = 0; c < report->choices; c++) {
        tune_choice *choice = &report->choice[c];
        gough_tuning *tuning = &choice->tuning;
        SCALE(tuning, found_members, u);
        SCALE(tuning, leg_members, u);
        SCALE(tuning, curve_members, u);
        SCALE(tuning, rest_members, u);
        SCALE(tuning, upper_members, u);
        /* the deviation is scale · G^slope */
        tuning->scale *= pow(gough_unit_factor(u, GOUGH_UNIT_STIFFNESS), -tuning->slope);
        for (size_t i = 0; i < tuning->exceptions; i++)
            SCALE(&tuning->exception[i], exception_members, u);
        for (size_t i = 0; i < tuning->points; i++) SCALE(&choice->point[i], point_members, u);
    }
}

/* ---- JSON --------------------------------------------------------------------------------------------------------- */

static json_t *text_or_null(const char *text) { return *text ? json_words(text) : json_null(); }

static json_t *asked_object(const tune_report *report) {
    const gough_tuning_options *asked = &report->asked;
    json_t *object = json_object();
    JSON_SET(object, asked, asked_members);
    json_object_set_new(object, "stiffness",
                        asked->greatest > 0
                            ? json_numbers((double[]){asked->least, asked->greatest}, 2)
                            : json_null());
    return object;
}

static json_t *binding_object(const gough_tuning *tuning) {
    json_t *object = json_object();
    json_object_set_new(object, "what", json_string(gough_tuning_binding_name(tuning->binding)));
    json_object_set_new(object, "mode", text_or_null(tuning->mode.name));
    json_object_set_new(object, "share", json_number(tuning->mode_share));
    json_object_set_new(object, "cause",
                        tuning->binding == GOUGH_TUNING_END
                            ? json_string(gough_cause_name(tuning->cause))
                            : json_null());
    return object;
}

static json_t *legs_object(const gough_tuning *tuning) {
    json_t *object = json_object();
    json_object_set_new(object, "leg", json_integer(tuning->leg));
    JSON_SET(object, tuning, leg_members);
    return object;
}

static json_t *exception_object(const gough_tuning_exception *e) {
    json_t *object = json_object();
    json_object_set_new(object, "stiffness", json_numbers((double[]){e->from, e->to}, 2));
    json_object_set_new(object, "kind", json_string(gough_tuning_exception_name(e->kind)));
    json_object_set_new(object, "mode", text_or_null(e->mode));
    json_object_set_new(object, "cause",
                        e->kind == GOUGH_TUNING_ENDED ? json_string(gough_cause_name(e->cause))
                                                      : json_null());
    json_object_set_new(object, "ratio", json_number(e->worst));
    json_object_set_new(object, "small_steps", json_boolean(e->small_steps));
    return object;
}

void tune_count_judged(const tune_choice *choice, size_t judged[TUNE_JUDGED]) {
    memset(judged, 0, TUNE_JUDGED * sizeof *judged);
    for (size_t i = 0; i < choice->tuning.points; i++) judged[choice->point[i].judged]++;
}

static json_t *judged_object(const tune_choice *choice) {
    static const char *const key[TUNE_JUDGED] = {"run", "rest", "program"};
    size_t judged[TUNE_JUDGED];
    json_t *object = json_object();
    tune_count_judged(choice, judged);
    for (int k = 0; k < TUNE_JUDGED; k++)
        json_object_set_new(object, key[k], json_integer((json_int_t)judged[k]));
    return object;
}

static json_t *curve_object(const tune_choice *choice) {
    const gough_tuning *tuning = &choice->tuning;
    json_t *object = json_object(), *list = json_array();
    JSON_SET(object, tuning, curve_members);
    json_object_set_new(object, "points", json_integer((json_int_t)tuning->points));
    for (size_t i = 0; i < tuning->exceptions; i++)
        json_array_append_new(list, exception_object(&tuning->exception[i]));
    json_object_set_new(object, "judged", judged_object(choice));
    json_object_set_new(object, "exceptions", list);
    return object;
}

static json_t *choice_object(const tune_choice *choice) {
    const gough_tuning *tuning = &choice->tuning;
    const bool found = tuning->found;
    json_t *object = json_object();
    json_object_set_new(object, "feedforward",
                        json_string(choice->feedforward ? "program" : "none"));
    json_object_set_new(object, "found", json_boolean(found));
    json_object_set_new(object, "reason", text_or_null(tuning->reason));
    JSON_SET(object, found ? tuning : NULL, found_members);
    json_object_set_new(object, "binding", found ? binding_object(tuning) : json_null());
    json_object_set_new(object, "legs", found ? legs_object(tuning) : json_null());
    json_object_set_new(object, "periodic", json_boolean(tuning->periodic));
    json_object_set_new(object, "unchecked", text_or_null(tuning->unchecked));
    json_object_set_new(object, "curve", curve_object(choice));
    json_object_set_new(object, "runs", json_integer((json_int_t)tuning->runs));
    return object;
}

/* Where a sampled controller, or one whose drives lag, no longer holds the platform; null for others, and where it never does. */
static json_t *upper_object(const gough_tuning *tuning) {
    if (!(tuning->upper > 0 && isfinite(tuning->upper))) return json_null();
    json_t *object = json_object();
    JSON_SET(object, tuning, upper_members);
    json_object_set_new(object, "mode", text_or_null(tuning->upper_mode.name));
    return object;
}

int tune_print_json(const tune_report *report) {
    const gough_tuning *first = &report->choice[0].tuning;
    json_t *object = json_object(), *threshold = json_object(), *list = json_array();
    JSON_SET(threshold, first, rest_members);
    json_object_set_new(threshold, "mode", text_or_null(first->least_mode.name));
    for (int c = 0; c < report->choices; c++)
        json_array_append_new(list, choice_object(&report->choice[c]));
    json_object_set_new(object, "verb", json_string(report->verb));
    json_object_set_new(object, "title", json_words(report->study->title));
    json_object_set_new(object, "units", json_units(&report->units));
    json_object_set_new(object, "friction_left_out",
                        json_boolean(leaves_out_friction(report->study->model)));
    json_object_set_new(object, "asked", asked_object(report));
    json_object_set_new(object, "threshold", threshold);
    json_object_set_new(object, "upper", upper_object(first));
    json_object_set_new(object, "choices", list);
    return json_print(object);
}
