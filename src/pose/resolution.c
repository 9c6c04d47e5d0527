/* How errors of lengths move a pose, (pose-12). */
#define NUMBER_DOUBLE
#include <math.h>
#include <string.h>

#include "base/limits.h"
#include "base/quantity.h"
#include "gough/pose.h"
#include "kernel/solve.h"
#include "plant/rotation_valid.h"

/* the inverse of the Jacobian about the top frame's origin, its rotations about the same axes; then of the point, at r from it */
static void map_of(const gough_machine *machine, const gough_state *state, const double point[3],
                   double map[6][GOUGH_LEGS]) {
    double J[GOUGH_LEGS][6], inverse[GOUGH_LEGS][6] = {{0}}, r[3];

    gough_jacobian(machine, state, J);
    for (int v = 0; v < GOUGH_LEGS; v++) inverse[v][v] = 1;
    solve_six(J, inverse, GOUGH_LEGS);
    for (int i = 0; i < 3; i++) {
        r[i] = 0;
        for (int k = 0; k < 3; k++) r[i] += state->rotation[i][k] * point[k];
    }
    for (int v = 0; v < GOUGH_LEGS; v++) {
        const double *by = inverse[v];
        for (int i = 0; i < 3; i++) {
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            map[i][v] = by[i] + by[3 + j] * r[k] - by[3 + k] * r[j];
            map[3 + i][v] = by[3 + i];
        }
    }
}

/* The largest vector of three rows of the map: a convex function of the errors, so it lies where each is at one of its ends. Signs
 * of all six may be exchanged, so leg 6 keeps its own. */
static double worst_of(double row[3][GOUGH_LEGS], const double error[GOUGH_LEGS], double unit[3],
                       double by[GOUGH_LEGS]) {
    double most = 0;

    for (int v = 0; v < GOUGH_LEGS; v++) by[v] = 0;
    for (int i = 0; i < 3; i++) unit[i] = 0;
    for (unsigned signs = 0; signs < 1U << (GOUGH_LEGS - 1); signs++) {
        double x[3] = {0, 0, 0}, size;
        for (int v = 0; v < GOUGH_LEGS; v++) {
            for (int i = 0; i < 3; i++) x[i] += row[i][v] * (signs >> v & 1 ? -error[v] : error[v]);
        }
        size = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
        if (!(size > most)) continue;
        most = size;
        for (int i = 0; i < 3; i++) unit[i] = x[i] / size;
        for (int v = 0; v < GOUGH_LEGS; v++) by[v] = signs >> v & 1 ? -error[v] : error[v];
    }
    return most;
}

gough_status gough_pose_resolution(const gough_machine *machine, const gough_state *state,
                                   const double point[3], const double error_of_length[GOUGH_LEGS],
                                   gough_resolution *resolution, gough_error *error) {
    gough_resolution r;

    for (int v = 0; v < GOUGH_LEGS; v++) {
        if (!(error_of_length[v] >= 0 && error_of_length[v] < INFINITY))
            return gough_fail(error, GOUGH_ERROR_INPUT,
                              "the error of the length of leg %d must be finite and at least 0, "
                              "not %g" IN_LENGTH,
                              v + 1, error_of_length[v]);
    }
    for (int i = 0; i < 3; i++) {
        if (!isfinite(point[i]))
            return gough_fail(error, GOUGH_ERROR_INPUT,
                              "the point whose displacement is asked for is not finite");
    }
    if (gough_conditioning(machine, state, &r.condition, NULL) != GOUGH_OK)
        return gough_fail(error, GOUGH_ERROR_INPUT, "the matrix of the pose is not a rotation");
    if (!(r.condition <= greatest_condition))
        return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                          "the pose is singular (condition %.3g): its lengths leave some "
                          "displacement undetermined",
                          r.condition);
    map_of(machine, state, point, r.map);
    for (int i = 0; i < 6; i++) {
        r.component[i] = 0;
        for (int v = 0; v < GOUGH_LEGS; v++)
            r.component[i] += fabs(r.map[i][v]) * error_of_length[v];
    }
    r.position = worst_of(r.map, error_of_length, r.direction, r.position_lengths);
    r.angle = worst_of(r.map + 3, error_of_length, r.axis, r.angle_lengths);
    *resolution = r;
    return GOUGH_OK;
}
