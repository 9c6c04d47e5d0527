/* The summary of forces and simulate as JSON: the same keys in the same order always; null where there is no number. */
#include <math.h>

#include "cli/common/json.h"
#include "cli/run/leg_quantities.h"
#include "cli/run/limits_used.h"

/* "surge" … "yaw" of 1 … 6; null of 0 */
static json_t *component_json(int component) {
    return component ? json_string(gough_component_name(component - 1)) : json_null();
}

static json_t *limits_array(const run_report *report) {
    limit_use use[MOST_LIMITS];
    const int count = limits_used(report, use);
    json_t *array = json_array();
    for (int i = 0; i < count; i++) {
        const limit_use *u = &use[i];
        json_t *object = json_object();
        json_object_set_new(object, "leg", u->leg ? json_integer(u->leg) : json_null());
        json_object_set_new(object, "component", component_json(u->component));
        json_object_set_new(object, "kind", json_string(gough_cause_name(u->kind)));
        json_object_set_new(object, "least", json_boolean(u->least));
        json_object_set_new(object, "limit", json_number(u->limit));
        json_object_set_new(object, "worst", json_number(u->worst));
        json_object_set_new(object, "share", json_number(u->share));
        json_object_set_new(object, "count", json_integer((json_int_t)u->count));
        json_object_set_new(object, "enter", json_number(u->enter));
        json_object_set_new(object, "leave", json_number(u->leave));
        json_object_set_new(object, "worst_time", json_number(u->worst_time));
        json_array_append_new(array, object);
    }
    return array;
}

static json_t *legs_array(unsigned legs) {
    json_t *array = json_array();
    for (int v = 0; v < GOUGH_LEGS; v++)
        if (legs >> v & 1) json_array_append_new(array, json_integer(v + 1));
    return array;
}

static json_t *statistics_object(const gough_statistics *s) {
    json_t *object = json_object(), *stiff = json_null();
    if (s->stiff_rate > 0) {
        stiff = json_object();
        json_object_set_new(stiff, "time", json_number(s->stiff_time));
        json_object_set_new(stiff, "rate", json_number(s->stiff_rate));
    }
    json_object_set_new(object, "steps", json_integer(s->steps));
    json_object_set_new(object, "rejected", json_integer(s->rejected));
    json_object_set_new(object, "evaluations", json_integer(s->evaluations));
    json_object_set_new(object, "stiff", stiff);
    return object;
}

json_t *run_report_json(const run_report *report) {
    const gough_summary *s = &report->summary;
    const gough_end *ended = &report->end;
    json_t *object = json_object(), *end = json_object(), *deviation = json_object();
    json_t *legs = json_array();

    json_object_set_new(end, "status", json_string(gough_cause_name(ended->cause)));
    json_object_set_new(end, "time", json_number(ended->time));
    json_object_set_new(end, "leg", ended->leg ? json_integer(ended->leg) : json_null());
    json_object_set_new(end, "message", json_words(ended->message));
    json_object_set_new(end, "legs", legs_array(ended->legs));
    json_object_set_new(end, "limit",
                        json_number(ended->leg || ended->component ? ended->limit : NAN));
    json_object_set_new(end, "component", component_json(ended->component));
    json_object_set_new(end, "least", json_boolean(ended->least));
    for (int i = 0; i < GOUGH_LEGS; i++) json_array_append_new(legs, leg_json(report, &s->leg[i]));
    json_object_set_new(deviation, "position", json_number(s->position_deviation));
    json_object_set_new(deviation, "angle", json_number(s->angle_deviation));

    json_object_set_new(object, "verb", json_string(report->verb));
    json_object_set_new(object, "title", json_words(report->study->title));
    json_object_set_new(object, "units", json_units(&report->units));
    json_object_set_new(object, "end", end);
    json_object_set_new(object, "legs", legs);
    json_object_set_new(object, "condition", json_number(s->condition));
    json_object_set_new(object, "deviation", deviation);
    json_object_set_new(object, "drift", json_number(report->simulated ? s->drift : NAN));
    json_object_set_new(
        object, "external_work",
        json_number(report->study->model->machine.externals > 0 ? s->external_work : NAN));
    json_object_set_new(object, "limits", limits_array(report));
    json_object_set_new(object, "statistics",
                        report->simulated ? statistics_object(&report->statistics) : json_null());
    return object;
}

int run_report_print_json(const run_report *report) { return json_print(run_report_json(report)); }
