/* gough workspace as JSON, in the study's units. */
#include <math.h>

#include "cli/common/json.h"
#include "cli/workspace/workspace_verb.h"

json_t *workspace_pose_json(const gough_units *unit, const double pose[GOUGH_COMPONENTS]) {
    double value[GOUGH_COMPONENTS];
    for (int c = 0; c < GOUGH_COMPONENTS; c++)
        value[c] = in_units(unit, component_unit(c), pose[c]);
    return json_numbers(value, GOUGH_COMPONENTS);
}

/* adds the limit, and its leg or component, to an object */
void workspace_set_binding(json_t *object, const gough_binding *b) {
    json_object_set_new(object, "limit", json_string(gough_bind_name(b->bind)));
    json_object_set_new(object, "leg",
                        binding_has_leg(b) ? json_integer(b->which + 1) : json_null());
    json_object_set_new(object, "other_leg",
                        b->bind == GOUGH_BIND_CLEARANCE ? json_integer(b->other + 1) : json_null());
    json_object_set_new(object, "component",
                        b->bind == GOUGH_BIND_POSE ? json_string(gough_component_name(b->which))
                                                   : json_null());
}

static json_t *end_object(const workspace_answer *a, int c, int end) {
    const gough_travel *t = &a->travel[c];
    json_t *object = json_object();
    json_object_set_new(object, "end",
                        json_number(in_units(a->unit, component_unit(c), t->end[end])));
    workspace_set_binding(object, &t->binding[end]);
    return object;
}

static json_t *travel_object(const workspace_answer *a) {
    json_t *object = json_object();
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        json_t *axis = json_object();
        json_object_set_new(axis, "least", end_object(a, c, 0));
        json_object_set_new(axis, "greatest", end_object(a, c, 1));
        json_object_set_new(object, gough_component_name(c), axis);
    }
    return object;
}

static json_t *box_object(const workspace_answer *a) {
    const gough_largest_box *b = &a->box;
    json_t *object = json_object();
    json_object_set_new(object, "shape_given", json_boolean(a->shape_given));
    json_object_set_new(object, "scale", json_number(b->scale));
    json_object_set_new(object, "upper", json_number(b->upper));
    json_object_set_new(object, "least", workspace_pose_json(a->unit, b->box.least));
    json_object_set_new(object, "greatest", workspace_pose_json(a->unit, b->box.greatest));
    json_t *stop = json_null();
    if (b->upper < INFINITY) {
        stop = json_object();
        workspace_set_binding(stop, &b->binding);
        json_object_set_new(stop, "pose", workspace_pose_json(a->unit, b->pose));
    }
    json_object_set_new(object, "stopped_by", stop);
    return object;
}

static json_t *extremes(const workspace_answer *a, bool bounds) {
    json_t *object = json_object();
    for (int i = 0; i < GOUGH_WORSTS; i++) {
        const gough_extreme *x = &a->envelope.of[i];
        const double value = bounds ? x->bound : x->sampled;
        const gough_unit unit = worst_unit(i);
        const double shown = unit == GOUGH_UNIT_NONE ? value : in_units(a->unit, unit, value);
        json_object_set_new(object, gough_worst_name((gough_worst)i),
                            json_number(worst_is_asked(a, i) ? shown : NAN));
    }
    return object;
}

static json_t *gaps(const workspace_answer *a) {
    json_t *object = json_object();
    for (int i = 0; i < GOUGH_WORSTS; i++)
        json_object_set_new(
            object, gough_worst_name((gough_worst)i),
            json_number(worst_is_asked(a, i) ? worst_gap(&a->envelope.of[i]) : NAN));
    return object;
}

json_t *workspace_envelope_json(const workspace_answer *a) {
    const gough_box *box = a->shape_given ? &a->shape : &a->box.box;
    json_t *object = extremes(a, true), *legs = json_object();
    for (int i = 0; i < GOUGH_WORSTS; i++) {
        const int leg = a->envelope.of[i].leg;
        json_object_set_new(legs, gough_worst_name((gough_worst)i),
                            leg >= 0 ? json_integer(leg + 1) : json_null());
    }
    json_object_set_new(object, "least", workspace_pose_json(a->unit, box->least));
    json_object_set_new(object, "greatest", workspace_pose_json(a->unit, box->greatest));
    json_object_set_new(object, "sampled", extremes(a, false));
    json_object_set_new(object, "gap", gaps(a));
    json_object_set_new(object, "legs", legs);
    return object;
}

static json_t *volume_object(const workspace_answer *a) {
    json_t *object = json_object();
    const double bound[2] = {volume_in_units(a->unit, a->volume.least),
                             volume_in_units(a->unit, a->volume.greatest)};
    double angle[3];
    for (int k = 0; k < 3; k++)
        angle[k] = in_units(a->unit, GOUGH_UNIT_ANGLE, a->study->model->workspace.orientation[k]);
    json_object_set_new(object, "value", json_number(volume_in_units(a->unit, a->volume.value)));
    json_object_set_new(object, "bounds", json_numbers(bound, 2));
    json_object_set_new(object, "orientation", json_numbers(angle, 3));
    json_object_set_new(object, "exact", json_boolean(a->volume.exact));
    return object;
}

int workspace_print_json(const workspace_answer *a) {
    json_t *object = json_object();
    json_object_set_new(object, "verb", json_string("workspace"));
    json_object_set_new(object, "title", json_words(a->study->title));
    json_object_set_new(object, "units", json_units(a->unit));
    json_object_set_new(object, "about", json_null());
    double about[3];
    for (int k = 0; k < 3; k++) about[k] = in_units(a->unit, GOUGH_UNIT_LENGTH, a->reach.about[k]);
    if (!a->status) json_object_set_new(object, "about", json_numbers(about, 3));
    json_object_set_new(object, "travel", a->status ? json_null() : travel_object(a));
    json_object_set_new(object, "box", a->status ? json_null() : box_object(a));
    const bool bounded = !a->status && !*a->no_envelope.message,
               measured = !a->status && !*a->no_volume.message;
    json_object_set_new(object, "envelope", bounded ? workspace_envelope_json(a) : json_null());
    json_object_set_new(object, "volume", measured ? volume_object(a) : json_null());
    json_object_set_new(object, "tests", json_integer((json_int_t)a->tests));
    json_object_set_new(object, "message",
                        json_words(a->status                 ? a->error.message
                                   : *a->no_envelope.message ? a->no_envelope.message
                                                             : a->no_volume.message));
    return json_print(object);
}
