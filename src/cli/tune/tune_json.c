/* The choice of gough tune as JSON: the same keys in the same order always; null where there is no number. */
#include <jansson.h>
#include <math.h>
#include <string.h>

#include "cli/common/json.h"
#include "cli/tune/tune_report.h"

static json_t *text_or_null(const char *text) { return *text ? json_words(text) : json_null(); }

static json_t *asked_object(const tune_report *report) {
    const gough_tuning_options *asked = &report->asked;
    json_t *object = json_object();
    json_object_set_new(object, "deviation", json_number(asked->deviation));
    json_object_set_new(object, "angle_deviation", json_number(asked->angle_deviation));
    json_object_set_new(object, "damping_ratio", json_number(asked->damping_ratio));
    json_object_set_new(object, "margin", json_number(asked->margin));
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
    json_object_set_new(object, "force", json_number(tuning->force));
    json_object_set_new(object, "force_share", json_number(tuning->force_share));
    json_object_set_new(object, "speed", json_number(tuning->speed));
    json_object_set_new(object, "speed_share", json_number(tuning->speed_share));
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

static json_t *curve_object(const gough_tuning *tuning) {
    json_t *object = json_object(), *list = json_array();
    json_object_set_new(object, "slope", json_number(tuning->slope));
    json_object_set_new(object, "scale", json_number(tuning->scale));
    json_object_set_new(object, "points", json_integer((json_int_t)tuning->points));
    for (size_t i = 0; i < tuning->exceptions; i++)
        json_array_append_new(list, exception_object(&tuning->exception[i]));
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
    json_object_set_new(object, "stiffness", json_number(found ? tuning->stiffness : NAN));
    json_object_set_new(object, "damping", json_number(found ? tuning->damping : NAN));
    json_object_set_new(object, "damping_ratio", json_number(found ? tuning->damping_ratio : NAN));
    json_object_set_new(object, "deviation", json_number(found ? tuning->deviation : NAN));
    json_object_set_new(object, "deviation_time",
                        json_number(found ? tuning->deviation_time : NAN));
    json_object_set_new(object, "angle_deviation",
                        json_number(found ? tuning->angle_deviation : NAN));
    json_object_set_new(object, "angle_time", json_number(found ? tuning->angle_time : NAN));
    json_object_set_new(object, "fails", json_number(found ? tuning->fails : NAN));
    json_object_set_new(object, "binding", found ? binding_object(tuning) : json_null());
    json_object_set_new(object, "legs", found ? legs_object(tuning) : json_null());
    json_object_set_new(object, "periodic", json_boolean(tuning->periodic));
    json_object_set_new(object, "unchecked", text_or_null(tuning->unchecked));
    json_object_set_new(object, "curve", curve_object(tuning));
    json_object_set_new(object, "runs", json_integer((json_int_t)tuning->runs));
    return object;
}

int tune_print_json(const tune_report *report) {
    const gough_tuning *first = &report->choice[0].tuning;
    json_t *object = json_object(), *threshold = json_object(), *list = json_array();
    json_object_set_new(threshold, "stiffness", json_number(first->threshold));
    json_object_set_new(threshold, "mode", text_or_null(first->least_mode.name));
    for (int c = 0; c < report->choices; c++)
        json_array_append_new(list, choice_object(&report->choice[c]));
    json_object_set_new(object, "verb", json_string(report->verb));
    json_object_set_new(object, "title", json_words(report->study->title));
    json_object_set_new(object, "asked", asked_object(report));
    json_object_set_new(object, "threshold", threshold);
    json_object_set_new(object, "choices", list);
    return json_print(object);
}
