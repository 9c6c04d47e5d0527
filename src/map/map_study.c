/* The study as it is in a row of the map: the value of the second axis in its place, its period, and whether its stiffnesses can be
 * computed together. Theory: docs/theory/floquet.md. */
#include "floquet/loads.h"
#include "floquet/monodromy.h"
#include "gough/floquet.h"
#include "map/map_row.h"
#include "plant/can_move.h"

/* times of a period at which forces of a program are compared with limits */
enum { LIMIT_LOOKS = 1024 };

void map_set_stiffness(const map_worker *w, double stiffness, gough_control *control) {
    if (control->coupled) {
        gain_pattern_spread(&w->stiffness, stiffness, control->stiffness, control->cross_stiffness);
        return;
    }
    for (int v = 0; v < GOUGH_LEGS; v++) control->stiffness[v] = stiffness;
}

static void set_motion(gough_motion *motion, double amplitude, double frequency) {
    if (!motion->scaled) motion->amplitude = motion->frequency = 1;
    motion->scaled = true;
    motion->amplitude *= amplitude;
    motion->frequency *= frequency;
    motion->period /= frequency;
}

linear_loop map_row_loop(const map_worker *w) {
    return (linear_loop){
        .machine = &w->model.machine, .motion = &w->model.motion, .control = &w->model.control};
}

static void set_damping(gough_control *control, double damping) {
    gain_pattern pattern;

    (void)gain_pattern_of(control->damping, (const double(*)[GOUGH_LEGS])control->cross_damping,
                          control->coupled, &pattern);
    if (control->coupled)
        gain_pattern_spread(&pattern, damping, control->damping, control->cross_damping);
    for (int v = 0; v < GOUGH_LEGS && !control->coupled; v++) control->damping[v] = damping;
}

/* whether some drive cannot give the forces of the program, looked for at many times of its period */
static bool reaches_limits(const map_worker *w) {
    const gough_actuators *a = &w->model.machine.platform.actuators;
    const linear_loop loop = map_row_loop(w);

    for (int i = 0; i < LIMIT_LOOKS; i++) {
        const double t = w->period.start + w->period.period * i / LIMIT_LOOKS;
        double acceleration[6], force[GOUGH_LEGS];
        gough_acceleration none;
        gough_state state;
        gough_program(&w->model.machine, &w->model.motion, t, &state, &none);
        if (linear_complex.accelerations(&loop, t, &state, acceleration, force) != NULL)
            return false;
        for (int v = 0; v < GOUGH_LEGS; v++) {
            const double *limit = a->max_force[v];
            if (limit[0] < limit[1] && !(force[v] >= limit[0] && force[v] <= limit[1])) return true;
        }
    }
    return false;
}

/* Whether multipliers may leave the unit circle anywhere, although the controller is continuous. At rest limits of drives are not
 * reached. */
static bool is_unordered(const map_worker *w) {
    if (w->model.control.coupled || gough_linear_size(&w->model) > GOUGH_LINEAR) return true;
    return !w->period.resting && map_row_kept(w) && monodromy_is_whole(&w->model) &&
           reaches_limits(w);
}

bool map_row_kept(const map_worker *w) {
    return gough_keeps_program(&w->model.machine, &w->model.control, !w->period.resting);
}

bool map_row_has_tables(const map_worker *w) { return !w->period.resting && !w->alone; }

gough_status map_row_begin(map_worker *w, size_t index, gough_error *error) {
    const gough_map_options *o = w->job->options;
    const double value = o->axis == GOUGH_MAP_NONE ? 0 : gough_map_value(&o->second, index);
    const double top = o->stiffness.to;
    gough_control *control = &w->model.control;
    gough_status status;
    gough_state state;
    gough_acceleration acceleration;
    linear_loop loop;

    w->index = index;
    w->model = *w->job->model;
    if (o->axis == GOUGH_MAP_AMPLITUDE) set_motion(&w->model.motion, value, 1);
    if (o->axis == GOUGH_MAP_FREQUENCY) set_motion(&w->model.motion, 1, value);
    if (o->axis == GOUGH_MAP_DAMPING) set_damping(control, value);
    (void)gain_pattern_of(control->stiffness, (const double(*)[GOUGH_LEGS])control->cross_stiffness,
                          control->coupled, &w->stiffness);
    loop = map_row_loop(w);
    w->sampled = w->job->sampled;
    w->alone = w->unordered = false;
    w->damped = w->sampled || linear_is_damped(&loop);

    status = gough_motion_period(&w->model.motion, &w->period, error);
    if (status != GOUGH_OK) return status;
    w->unordered = !w->sampled && is_unordered(w);
    w->damped |= w->unordered;
    if (w->period.resting) {
        double component[GOUGH_COMPONENTS][3];
        gough_motion_evaluate(&w->model.motion, w->period.start, component);
        for (int c = 0; c < GOUGH_COMPONENTS; c++) w->component[c] = component[c][0];
        return w->sampled ? map_sampled_begin(w, error) : GOUGH_OK;
    }
    if (w->sampled) return map_sampled_begin(w, error);
    /* tables are of constant forces with the axes of the base, for which multipliers come in pairs */
    w->alone = w->unordered || !map_row_kept(w) || machine_loads_follow(&w->model.machine) ||
               !loads_constant(&w->model.machine, &w->period);
    if (w->alone) return loads_check(&w->model.machine, &w->period, error);

    status = transition_divide(&loop, &w->period, top, &w->d, error);
    if (status != GOUGH_OK) return status;
    gough_program(&w->model.machine, &w->model.motion, w->period.start, &state, &acceleration);
    symplectic_at(&w->model.machine, &state, &w->form);
    return GOUGH_OK;
}
