/* Following a pose to leg lengths, (pose-6), over a scalar number type: what gough_pose_from_lengths() is for double and float.
 * Around the way itself everything is double. */
#ifndef GOUGH_POSE_FOLLOW_H
#define GOUGH_POSE_FOLLOW_H

#include <stdbool.h>

#include "gough/pose.h"
#include "plant/rotation_valid.h"
#include "pose/frame.h"
#include "pose/walk.h"

/* sentences of gough_pose_from_lengths() */
static inline gough_status follow_lost(gough_error *error, const soma_way *way, int most_steps,
                                       bool tube) {
    const char *unknown = tube ? ", or the lengths between are not known well enough" : "";
    const double reached = 100 * (double)way->reached;
    const int steps = (int)way->steps;

    if (steps == 0)
        return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                          "no step from this pose is certain: it is singular or nearly so%s",
                          unknown);
    if (steps == most_steps)
        return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                          "%d certified steps reach only %.6g %% of the way to these lengths: "
                          "allow more steps, or come in smaller changes",
                          steps, reached);
    return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                      "the way to these lengths is certain for %.6g %% of it only: there it "
                      "meets a singular pose or passes too closely by one%s",
                      reached, unknown);
}

static inline gough_status follow_input(const double length[GOUGH_LEGS],
                                        const double tube[GOUGH_LEGS], int most_steps,
                                        const gough_state *pose, gough_error *error) {
    const gough_status status = pose_check_lengths(length, error);

    if (status) return status;
    for (int v = 0; v < GOUGH_LEGS; v++) {
        if (tube && !(tube[v] >= 0 && tube[v] < INFINITY))
            return gough_fail(
                error, GOUGH_ERROR_INPUT,
                "the width of the tube of leg %d must be finite and at least 0, not %g" IN_LENGTH,
                v + 1, tube[v]);
    }
    if (most_steps < 1)
        return gough_fail(error, GOUGH_ERROR_INPUT, "the number of steps must be 1 or more, not %d",
                          most_steps);
    if (!is_rotation(pose->rotation))
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "the matrix of the pose to begin from is not a rotation");
    return GOUGH_OK;
}

/* (pose-7): how far squares of lengths may be off their straight line: δ about the straight line of the lengths, which lies
 * itself a quarter of the square of the change below that of the squares */
static inline double follow_width(double from, double to, double tube) {
    const double most = (from > to ? from : to) + tube, change = to - from;

    return 2 * most * tube + 0.25 * change * change;
}

static inline gough_status follow(const gough_machine *machine, const double length[GOUGH_LEGS],
                                  const double tube[GOUGH_LEGS], int most_steps, gough_state *pose,
                                  gough_pose_certificate *certificate, gough_error *error) {
    const gough_status status = follow_input(length, tube, most_steps, pose, error);
    gough_pose_certificate c = {.steps = 0};
    number b[3], a[3], square[GOUGH_LEGS], width[GOUGH_LEGS], x[SOMA];
    double y[SOMA], from[GOUGH_LEGS];
    soma_legs legs;
    soma_way way;

    if (status) return status;
    const pose_frame f = pose_frame_of(machine, machine->home_length);
    const double unit = 1 / (f.scale * f.scale);
    if (tube) gough_leg_kinematics(machine, pose, NULL, from, NULL, NULL);
    for (int v = 0; v < GOUGH_LEGS; v++) {
        pose_frame_joints(&f, machine, v, b, a);
        soma_row(b, a, legs.row[v]);
        square[v] = number_of(unit * length[v] * length[v]);
        width[v] = number_of(tube ? unit * follow_width(from[v], length[v], tube[v]) : 0);
    }
    soma_legs_bound(&legs);
    pose_soma(&f, pose, y);
    for (int k = 0; k < SOMA; k++) x[k] = number_of(y[k]);
    soma_walk(&legs, square, width, most_steps, x, &way);

    c.steps = (int)way.steps, c.reached = (double)way.reached, c.margin = (double)way.margin;
    if (c.steps > 0) {
        for (int k = 0; k < SOMA; k++) y[k] = (double)x[k];
        const double distance = pose_of_soma(&f, y, pose->position, pose->rotation);
        const double rounding = 8 * (double)REAL_EPSILON;
        pose_errors(&f, (double)way.error + rounding * (1 + distance), distance, &c.position_error,
                    &c.angle_error);
        pose_unique(&f, (double)way.unique, distance, &c.unique_position, &c.unique_angle);
        c.position_error += rounding * pose_norm(f.base);
    }
    if (certificate) *certificate = c;
    return c.reached < 1 ? follow_lost(error, &way, most_steps, tube != NULL) : GOUGH_OK;
}

#endif
