/* Stability as JSON: the same keys in the same order always; null where there is no number. Complex numbers are pairs [re, im]. */
#include <math.h>
#include <string.h>

#include "cli/common/json.h"
#include "cli/common/left_out.h"
#include "cli/common/scale.h"
#include "cli/stability/stability_report.h"

static json_t *complex_pair(const double value[2]) { return json_numbers(value, 2); }

static json_t *mode_object(const gough_mode *mode) {
    static const char *const kind[4] = {"sway", "heave", "tilt", "yaw"};
    json_t *object = json_object(), *shape = json_array(), *share = json_object();
    for (int a = 0; a < 6; a++) json_array_append_new(shape, complex_pair(mode->shape[a]));
    for (int k = 0; k < 4; k++) json_object_set_new(share, kind[k], json_number(mode->share[k]));
    json_object_set_new(object, "name", json_words(mode->name));
    json_object_set_new(object, "shape", shape);
    json_object_set_new(object, "share", share);
    return object;
}

static json_t *pose_object(const double pose[GOUGH_COMPONENTS]) {
    json_t *object = json_object();
    for (int c = 0; c < GOUGH_COMPONENTS; c++)
        json_object_set_new(object, gough_component_name(c), json_number(pose[c]));
    return object;
}

/* Modes that neither stiffness nor damping resists, each name once. */
static json_t *drift_list(const gough_rest *rest) {
    json_t *list = json_array();
    for (int i = 0; i < rest->drifting; i++) {
        const char *name = rest->neutral_mode[i].name;
        bool known = false;
        for (int k = 0; k < i; k++) known = known || strcmp(name, rest->neutral_mode[k].name) == 0;
        if (!known) json_array_append_new(list, json_words(name));
    }
    return list;
}

/* The keys of a loop at rest. */
static void set_rest(json_t *object, const gough_rest *rest, const double pose[GOUGH_COMPONENTS]) {
    json_t *eigenvalues = json_array(), *modes = json_array(), *thresholds = json_array();
    for (size_t i = 0; i < rest->size; i++) {
        json_array_append_new(eigenvalues, complex_pair(rest->eigenvalue[i].value));
        json_array_append_new(modes, mode_object(&rest->eigenvalue[i].mode));
    }
    for (int i = 0; i < 6; i++) {
        json_t *threshold = json_object();
        json_object_set_new(threshold, "mode", json_words(rest->threshold[i].mode.name));
        json_object_set_new(threshold, "stiffness", json_number(rest->threshold[i].stiffness));
        json_array_append_new(thresholds, threshold);
    }
    json_object_set_new(object, "pose", pose_object(pose));
    json_object_set_new(object, "eigenvalues", eigenvalues);
    json_object_set_new(object, "modes", modes);
    json_object_set_new(object, "thresholds", thresholds);
    json_object_set_new(object, "growth_rate", json_number(rest->growth));
    json_object_set_new(object, "trace", json_number(rest->trace));
    json_object_set_new(object, "trace_theorem", json_number(rest->trace_theorem));
    json_object_set_new(object, "asymmetry", json_number(rest->asymmetry));
    json_object_set_new(object, "drifts", drift_list(rest));
    json_object_set_new(object, "decays", json_boolean(rest->decaying));
}

/* The loop where the program ends, when that is not home. */
static json_t *last_object(const stability_report *report) {
    if (!report->ends) return json_null();
    json_t *object = json_object();
    set_rest(object, &report->last, report->last_pose);
    json_object_set_new(object, "stable", json_boolean(report->last.stable));
    return object;
}

static void set_program(json_t *object, const stability_report *report) {
    const gough_floquet *f = &report->floquet;
    json_t *multipliers = json_array(), *modes = json_array();
    for (size_t i = 0; report->periodic && i < f->size; i++) {
        json_array_append_new(multipliers, complex_pair(f->multiplier[i].value));
        json_array_append_new(modes, mode_object(&f->multiplier[i].mode));
    }
    /* without a period of the program those from sample to sample, at rest where it ends */
    const gough_sampled_rest *r =
        report->ends ? &report->sampled_last.rest : &report->sampled_rest.rest;
    const gough_sampled_floquet *a = &report->along;
    const bool is = report->periodic, along = report->sampled_along;
    const gough_multiplier *list = along ? a->multiplier : r->multiplier;
    const size_t listed = !report->sampled ? 0 : along ? a->listed : r->listed;
    for (size_t i = 0; i < listed; i++) {
        json_array_append_new(multipliers, complex_pair(list[i].value));
        json_array_append_new(modes, mode_object(&list[i].mode));
    }
    json_object_set_new(object, "period", json_number(is ? f->period : along ? a->period : NAN));
    json_object_set_new(object, "period_start",
                        json_number(is      ? f->start
                                    : along ? a->start
                                            : NAN));
    json_object_set_new(object, "samples",
                        report->sampled ? json_integer(along ? (json_int_t)a->samples : 1)
                                        : json_null());
    json_object_set_new(object, "periods",
                        along ? json_integer((json_int_t)a->periods) : json_null());
    json_object_set_new(object, "sampling_period",
                        json_number(along ? a->sampling
                                    : report->sampled
                                        ? in_units(&report->units, GOUGH_UNIT_TIME, r->period)
                                        : NAN));
    json_object_set_new(object, "sampling_adjusted",
                        report->sampled ? json_boolean(along && a->adjusted) : json_null());
    json_object_set_new(object, "multipliers", multipliers);
    json_object_set_new(object, "multiplier_modes", modes);
    json_object_set_new(object, "growth_per_period",
                        json_number(is      ? f->growth
                                    : along ? pow(a->growth, 1 / (double)a->periods)
                                            : NAN));
    json_object_set_new(object, "determinant", json_number(is ? f->determinant : NAN));
    json_object_set_new(object, "determinant_defect",
                        json_number(is ? f->determinant_defect : NAN));
    json_object_set_new(object, "pair_defect", json_number(is ? f->pair_defect : NAN));
    json_object_set_new(object, "drifting", is ? json_integer(f->drifting) : json_null());
}

json_t *stability_json(const stability_report *report, const stability_matrix *matrix) {
    json_t *object = json_object();
    json_object_set_new(object, "verb", json_string(report->verb));
    json_object_set_new(object, "title", json_words(report->study->title));
    json_object_set_new(object, "units", json_units(&report->units));
    json_object_set_new(object, "friction_left_out",
                        json_boolean(leaves_out_friction(report->study->model)));
    set_rest(object, &report->rest, report->pose);
    json_object_set_new(object, "last", last_object(report));
    set_program(object, report);
    json_object_set_new(object, "sampling",
                        sampled_view_object(&report->units, report->ends ? &report->sampled_last
                                                                         : &report->sampled_rest));
    json_object_set_new(object, "stable", json_boolean(stability_holds(report)));
    if (matrix) stability_matrix_set(object, matrix);
    return object;
}
