/* Where a pose is followed from, and how near it is to a singular one. */
#include <math.h>
#include <string.h>

#include "cli/check/singular_values.h"
#include "cli/common/scale.h"
#include "cli/pose/pose_verb.h"

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
