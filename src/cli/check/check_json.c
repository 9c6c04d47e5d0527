/* A study and its machine as JSON, in the units of the study. */
#include "cli/check/check_json.h"

#include <math.h>

#include "cli/check/check_limits.h"
#include "cli/check/check_loop.h"
#include "cli/check/check_moves.h"
#include "cli/check/check_record.h"
#include "cli/common/json.h"
#include "cli/common/scale.h"
#include "cli/common/study_fields.h"
#include "cli/sweep/sweep_report.h"

double check_own(const check *c, gough_unit unit, double value) {
    return in_units(c->unit, unit, value);
}

const char *check_weakest_name(const machine_view *view) {
    int largest = 0;
    for (int i = 1; i < 6; i++)
        if (fabs(view->weakest[i]) > fabs(view->weakest[largest])) largest = i;
    return gough_component_name(largest);
}

double check_determinant_of(const check *c) {
    const double length = check_own(c, GOUGH_UNIT_LENGTH, 1);
    return length * length * length * c->view.determinant;
}

static json_t *groups_object(const check *c) {
    const gough_machine *m = c->machine;
    const double R = m->base_radius, M = m->load.mass, g = m->gravity_magnitude;
    double inertia[3], stiffness[GOUGH_LEGS], damping[GOUGH_LEGS];
    for (int k = 0; k < 3; k++) inertia[k] = c->view.moments[k] / (M * R * R);
    for (int i = 0; i < GOUGH_LEGS; i++) {
        stiffness[i] = g > 0 ? c->model->control.stiffness[i] * R / (M * g) : NAN;
        damping[i] = c->model->control.damping[i] * c->view.time_unit / M;
    }
    json_t *groups = json_object();
    json_object_set_new(groups, "height", json_number(m->platform.height / R));
    json_object_set_new(groups, "top_radius", json_number(c->view.top_radius / R));
    json_object_set_new(groups, "inertia", json_numbers(inertia, 3));
    json_object_set_new(groups, "stiffness", json_numbers(stiffness, GOUGH_LEGS));
    json_object_set_new(groups, "damping", json_numbers(damping, GOUGH_LEGS));
    return groups;
}

static json_t *program_object(const check *c) {
    static const char *const kinds[] = {"formulas", "moves", "samples"};
    const gough_motion *motion = &c->model->motion;
    json_t *program = json_object();
    json_object_set_new(program, "kind", json_string(kinds[motion->kind]));
    json_object_set_new(program, "order", json_field(c->study, "motion.order"));
    if (motion->kind == GOUGH_MOTION_SAMPLES) {
        const two_numbers span = two_in_units(c->unit, GOUGH_UNIT_TIME, motion->samples.time[0],
                                              motion->samples.time[motion->samples.count - 1]);
        json_object_set_new(program, "samples", json_integer((json_int_t)motion->samples.count));
        json_object_set_new(program, "span", json_numbers(span.value, 2));
        json_object_set_new(program, "ends", json_string("not-a-knot"));
        if (c->study->record)
            json_object_set_new(program, "record", record_object(c->study->record));
    }
    json_t *moves = moves_array(c->study);
    if (moves) json_object_set_new(program, "moves", moves);
    for (int k = 0; k < GOUGH_COMPONENTS; k++)
        json_object_set_new(program, gough_component_name(k),
                            json_numbers((double[]){c->least[k], c->greatest[k]}, 2));
    return program;
}

static json_t *own_numbers(const check *c, gough_unit unit, const double *value, int count) {
    json_t *array = json_array();
    for (int i = 0; i < count; i++)
        json_array_append_new(array, json_number(check_own(c, unit, value[i])));
    return array;
}

static json_t *external_array(const check *c) {
    const gough_machine *m = c->machine;
    json_t *array = json_array();
    for (size_t n = 0; n < m->externals; n++) {
        const gough_external *e = &m->external[n];
        double value[6];
        for (int i = 0; i < 6; i++) {
            double now[3];
            gough_formula_evaluate(i < 3 ? &e->force[i] : &e->moment[i - 3], 0, now);
            value[i] = now[0];
        }
        json_t *object = json_object();
        json_object_set_new(object, "force", own_numbers(c, GOUGH_UNIT_FORCE, value, 3));
        json_object_set_new(object, "moment", own_numbers(c, GOUGH_UNIT_MOMENT, value + 3, 3));
        json_object_set_new(
            object, "at",
            own_numbers(c, GOUGH_UNIT_LENGTH, e->at_given ? e->at : m->load.center_of_mass, 3));
        json_object_set_new(object, "axes", json_string(e->turns ? "top" : "base"));
        json_array_append_new(array, object);
    }
    return array;
}

json_t *check_object(const check *c) {
    const gough_machine *m = c->machine;
    const gough_simulation *s = &c->study->simulation;
    json_t *object = json_object(), *axes = json_array(), *simulation = json_object();
    for (int a = 0; a < 3; a++) {
        double axis[3];
        for (int k = 0; k < 3; k++) axis[k] = m->principal_axes[k][a];
        json_array_append_new(axes, json_numbers(axis, 3));
    }
    json_object_set_new(simulation, "duration", json_field(c->study, "simulation.duration"));
    json_object_set_new(simulation, "output_step", json_field(c->study, "simulation.output_step"));
    json_object_set_new(simulation, "method", json_field(c->study, "simulation.method"));
    json_object_set_new(simulation, "step",
                        json_number(s->step > 0 ? check_own(c, GOUGH_UNIT_TIME, s->step) : NAN));
    json_object_set_new(simulation, "tolerance", json_number(s->step > 0 ? NAN : s->tolerance));

    json_object_set_new(object, "verb", json_string("check"));
    json_object_set_new(object, "title", json_words(c->study->title));
    json_object_set_new(object, "units", json_units(c->unit));
    json_object_set_new(object, "home_length",
                        own_numbers(c, GOUGH_UNIT_LENGTH, m->home_length, GOUGH_LEGS));
    json_object_set_new(object, "stroke", limits_common_length(c->study));
    json_object_set_new(object, "limits", limits_object(c->study));
    json_object_set_new(object, "condition", json_number(c->view.condition));
    json_object_set_new(object, "determinant", json_number(check_determinant_of(c)));
    json_object_set_new(object, "least_singular_value", json_number(c->view.least_singular));
    json_object_set_new(object, "weakest_motion", json_string(check_weakest_name(&c->view)));
    json_object_set_new(object, "principal_moments",
                        own_numbers(c, GOUGH_UNIT_INERTIA, c->view.moments, 3));
    json_object_set_new(object, "principal_axes", axes);
    json_object_set_new(object, "leg_mass",
                        json_number(check_own(c, GOUGH_UNIT_MASS, c->view.leg_mass)));
    json_object_set_new(object, "leg_mass_on_top",
                        json_number(check_own(c, GOUGH_UNIT_MASS, c->view.hanging)));
    json_object_set_new(object, "external", external_array(c));
    json_object_set_new(object, "pose", pose_view_object(c->model, c->unit, &c->pose));
    json_object_set_new(object, "base_radius",
                        json_number(check_own(c, GOUGH_UNIT_LENGTH, m->base_radius)));
    json_object_set_new(object, "time_unit",
                        json_number(check_own(c, GOUGH_UNIT_TIME, c->view.time_unit)));
    json_object_set_new(object, "groups", groups_object(c));
    json_object_set_new(object, "program", program_object(c));
    json_object_set_new(object, "control", control_object(c->study, c->unit));
    json_object_set_new(object, "actuators", drives_object(c->study, c->unit));
    json_object_set_new(object, "sampling", sampled_view_object(c->unit, &c->sampled));
    json_object_set_new(object, "simulation", simulation);
    if (c->sweep) json_object_set_new(object, "sweep", sweep_object(c->sweep));
    return object;
}
