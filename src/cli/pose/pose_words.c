/* Poses in the words of a study: components from home of the point whose motion it gives. */
#include <math.h>
#include <string.h>

#include "cli/check/singular_values.h"
#include "cli/common/scale.h"
#include "cli/pose/pose_verb.h"

/* R · about − about, less the height of home */
static void point_at_home(const gough_model *model, const gough_state *state, double out[3]) {
    const double *about = model->motion.about;
    for (int r = 0; r < 3; r++) {
        out[r] = -about[r] - (r == 2 ? model->machine.platform.height : 0);
        for (int k = 0; k < 3; k++) out[r] += state->rotation[r][k] * about[k];
    }
}

gough_state pose_at(const gough_model *model, const double component[GOUGH_COMPONENTS]) {
    gough_state state = gough_state_home(&model->machine);
    double moved[3];
    gough_rotation_in_order(model->motion.order, component + GOUGH_ROLL, state.rotation);
    point_at_home(model, &state, moved);
    for (int k = 0; k < 3; k++) state.position[k] = component[k] - moved[k];
    return state;
}

void pose_components(const gough_model *model, const gough_state *state,
                     double component[GOUGH_COMPONENTS]) {
    gough_state copy = *state;
    double moved[3];
    point_at_home(model, state, moved);
    for (int k = 0; k < 3; k++) component[k] = state->position[k] + moved[k];
    gough_angles_in_order(model->motion.order, copy.rotation, component + GOUGH_ROLL);
}

gough_state pose_begin(const pose_asked *asked, const gough_study *study) {
    double component[GOUGH_COMPONENTS];
    for (int c = 0; c < GOUGH_COMPONENTS; c++)
        component[c] = gough_unit_read(&study->units, component_unit(c), asked->near[c]);
    return pose_at(study->model, component);
}

double pose_least_singular(const gough_machine *machine, const gough_state *state) {
    double A[6][6], V[6][6], value[6], arm = 0, least;
    for (int v = 0; v < GOUGH_LEGS; v++) {
        const double *t = machine->platform.top[v];
        arm += sqrt(t[0] * t[0] + t[1] * t[1] + t[2] * t[2]) / GOUGH_LEGS;
    }
    if (gough_jacobian(machine, state, A)) return NAN;
    for (int i = 0; i < 6; i++)
        for (int j = 3; j < 6; j++) A[i][j] /= arm;
    singular_values(A, V, value);
    least = value[0];
    for (int j = 1; j < 6; j++) least = fmin(least, value[j]);
    return least;
}
