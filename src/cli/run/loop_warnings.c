/* Warnings about a control loop whose parts do not go together: exact rates beside counted lengths, an integral that nothing keeps
 * from growing although it should be. */
#include "cli/run/loop_warnings.h"

#include "cli/common/scale.h"
#include "cli/common/talk.h"

static bool has_integral(const gough_control *control) {
    for (int v = 0; v < GOUGH_LEGS; v++)
        if (control->integral[v] > 0) return true;
    return false;
}

static bool has_limits(const gough_actuators *drives) {
    for (int v = 0; v < GOUGH_LEGS; v++)
        if (drives->max_force[v][0] < drives->max_force[v][1]) return true;
    return false;
}

void loop_warnings(const char *verb, const gough_study *study) {
    const gough_control *control = &study->model->control;
    const gough_sampling *s = &control->sampling;
    const gough_units *unit = &study->units;
    const char *missing = !has_integral(control) ? "control.integral is not given"
                          : !has_limits(&study->model->machine.platform.actuators)
                              ? "the drives have no actuators.max_force"
                              : NULL;
    if (s->period > 0 && s->velocity == GOUGH_VELOCITY_EXACT && s->resolution > 0)
        remark(verb,
               "warning: lengths are measured in counts of %.6g%s, but rates exactly; a controller "
               "that has only counts needs control.sampling.velocity: difference",
               in_units(unit, GOUGH_UNIT_LENGTH, s->resolution),
               unit_word(unit, GOUGH_UNIT_LENGTH));
    if (control->tracking_time > 0 && missing)
        remark(verb, "warning: control.tracking_time has no effect, because %s", missing);
}
