/* gough design as JSON, in the study's units. */
#include <math.h>

#include "cli/common/json.h"
#include "cli/design/design_verb.h"

static json_t *keys_object(const design_answer *a) {
    json_t *object = json_object();
    for (size_t k = 0; k < a->keys; k++)
        json_object_set_new(object, a->key[k].path, json_number(a->result.value[k]));
    return object;
}

static json_t *pair(double first, double second) {
    const double both[2] = {first, second};
    return json_numbers(both, 2);
}

static json_t *bounds_object(const design_answer *a) {
    json_t *object = json_object();
    for (size_t k = 0; k < a->keys; k++)
        json_object_set_new(object, a->key[k].path, pair(a->key[k].least, a->key[k].greatest));
    return object;
}

static json_t *aims_object(const design_answer *a, int which) {
    json_t *object = json_object();
    for (int k = 0; k < GOUGH_AIMS; k++) {
        const double value = in_units(a->unit, aim_unit((gough_aim)k), a->result.aim[k][which]);
        if (a->request.weight[k] > 0)
            json_object_set_new(object, gough_aim_name((gough_aim)k), json_number(value));
    }
    return object;
}

static json_t *objective_object(const design_answer *a) {
    json_t *object = json_object(), *weights = json_object();
    const bool weighs = design_weighs(a);
    const gough_unit unit = aim_unit(design_aim(a));
    double value[2];
    for (int i = 0; i < 2; i++)
        value[i] = weighs ? a->result.objective[i]
                          : in_units(a->unit, unit, a->result.aim[design_aim(a)][i]);
    for (int k = 0; k < GOUGH_AIMS; k++)
        if (a->request.weight[k] > 0)
            json_object_set_new(weights, gough_aim_name((gough_aim)k),
                                json_number(a->request.weight[k]));
    json_object_set_new(object, "minimize", weights);
    json_object_set_new(object, "before", json_number(value[0]));
    json_object_set_new(object, "after", json_number(value[1]));
    json_object_set_new(object, "aims_before", aims_object(a, 0));
    json_object_set_new(object, "aims_after", aims_object(a, 1));
    return object;
}

static json_t *active_array(const design_answer *a) {
    json_t *array = json_array();
    for (size_t i = 0; i < a->result.actives; i++) {
        const gough_active *one = &a->result.active[i];
        const bool key = one->kind == GOUGH_ACTIVE_LEAST || one->kind == GOUGH_ACTIVE_GREATEST;
        json_t *object = json_object();
        json_object_set_new(object, "kind", json_string(gough_active_name(one->kind)));
        json_object_set_new(object, "key", key ? json_string(a->key[one->key].path) : json_null());
        workspace_set_binding(object, &one->binding);
        json_object_set_new(object, "pose",
                            one->kind == GOUGH_ACTIVE_LIMIT
                                ? workspace_pose_json(a->unit, one->pose)
                                : json_null());
        json_array_append_new(array, object);
    }
    return array;
}

static json_t *missing_object(const design_answer *a) {
    const gough_design_result *r = &a->result;
    json_t *object = json_object();
    json_object_set_new(object, "excess", json_number(r->excess));
    json_object_set_new(object, "scale", json_number(r->scale));
    json_object_set_new(object, "telescope", json_boolean(r->telescope_fails));
    workspace_set_binding(object, &r->certificate.binding);
    json_object_set_new(object, "pose", workspace_pose_json(a->unit, r->certificate.pose));
    return object;
}

/* what the search left to spare, for the limits of which it left something */
static json_t *spare_object(const design_answer *a) {
    json_t *object = json_object();
    for (int kind = 0; kind < GOUGH_BINDS; kind++)
        if (a->result.spare[kind] > 0)
            json_object_set_new(object, gough_bind_name((gough_bind)kind),
                                json_number(a->result.spare[kind]));
    return object;
}

int design_print_json(const design_answer *a) {
    const gough_design_result *r = &a->result;
    const workspace_answer w = design_workspace(a);
    const bool told = a->status != GOUGH_ERROR_INPUT && r->evaluations > 0;
    json_t *object = json_object();
    json_object_set_new(object, "verb", json_string("design"));
    json_object_set_new(object, "title", json_words(a->study->title));
    json_object_set_new(object, "units", json_units(a->unit));
    json_object_set_new(object, "keys", told ? keys_object(a) : json_null());
    json_object_set_new(object, "bounds", bounds_object(a));
    json_object_set_new(object, "objective", told ? objective_object(a) : json_null());
    json_object_set_new(object, "active", told ? active_array(a) : json_null());
    json_object_set_new(object, "certified", json_boolean(r->found));
    json_object_set_new(object, "spare", told ? spare_object(a) : json_null());
    json_object_set_new(object, "singular_value",
                        told ? json_number(r->singular_value) : json_null());
    json_object_set_new(object, "missing", told && !r->found ? missing_object(a) : json_null());
    json_object_set_new(object, "envelope",
                        r->found && r->bounded ? workspace_envelope_json(&w) : json_null());
    json_object_set_new(object, "evaluations", json_integer((json_int_t)r->evaluations));
    json_object_set_new(object, "tests", json_integer((json_int_t)r->tests));
    json_object_set_new(object, "seed", json_integer((json_int_t)a->request.seed));
    json_object_set_new(object, "message", json_words(a->error.message));
    return json_print(object);
}
