/* From the numbers of a row: the motion of the platform's point, the accelerations of the legs, (legs-6), and the power of
 * external loads. */
#include "run/summary_limits.h"

#include <math.h>
#include <string.h>

#include "gough/dynamics.h"
#include "plant/platform_point.h"

void summary_limits_begin(gough_summary *summary, const gough_machine *machine,
                          const gough_motion *motion) {
    const gough_limits l = gough_limits_of(machine, motion);

    memcpy(summary->about_, l.about, sizeof summary->about_);
    for (int i = 0; i < GOUGH_COMPONENTS; i++) {
        summary->limited_ = summary->limited_ || isfinite(l.pose[i][0]) || isfinite(l.rate[i][0]) ||
                            isfinite(l.second_rate[i][0]) || isfinite(l.acceleration[i]);
    }
    for (int order = 0; order < 3 && summary->limited_; order++) {
        for (int c = 0; c < GOUGH_COMPONENTS; c++) {
            summary->component[order][c][0] = INFINITY;
            summary->component[order][c][1] = -INFINITY;
        }
    }
}

void summary_limits_row(const gough_machine *machine, gough_order order, const double about[3],
                        const double *value, double component[3][GOUGH_COMPONENTS],
                        double acceleration[GOUGH_LEGS]) {
    double R[3][3], point[3], velocity[3], a[3], along[3];

    const top_motion top = {value + GOUGH_X,  value + GOUGH_VX,  value + GOUGH_AX,
                            value + GOUGH_WX, value + GOUGH_ALX, (const double(*)[3])R};

    gough_rotation_in_order(order, value + GOUGH_ROLL_ANGLE, R);
    platform_point(&top, about, point, velocity, a);
    for (int i = 0; i < 3; i++) {
        component[0][i] = point[i] - about[i] - (i == 2 ? machine->platform.height : 0);
        component[1][i] = velocity[i];
        component[2][i] = a[i];
        component[0][3 + i] = value[GOUGH_ROLL_ANGLE + i];
        component[1][3 + i] = value[GOUGH_WX + i];
        component[2][3 + i] = value[GOUGH_ALX + i];
    }

    /* l̈ = n·a + (|v|² − l̇²)/l */
    for (int v = 0; v < GOUGH_LEGS; v++) {
        platform_point(&top, machine->platform.top[v], point, velocity, a);
        for (int i = 0; i < 3; i++) along[i] = point[i] - machine->platform.base[v][i];
        const double length = sqrt(point_dot(along, along)),
                     rate = point_dot(along, velocity) / length;
        acceleration[v] =
            (point_dot(along, a) + point_dot(velocity, velocity) - rate * rate) / length;
    }
}

double summary_external_power(const gough_machine *machine, gough_order order,
                              const double *value) {
    const double *c = machine->load.center_of_mass, *velocity = value + GOUGH_VX,
                 *omega = value + GOUGH_WX;
    gough_state state = gough_state_home(machine);
    double arm[3], power = 0;
    gough_wrench w;

    if (machine->externals == 0 || isnan(value[GOUGH_X])) return 0;
    for (int r = 0; r < 3; r++) state.position[r] = value[GOUGH_X + r];
    gough_rotation_in_order(order, value + GOUGH_ROLL_ANGLE, state.rotation);
    if (gough_external_wrench(machine, &state, value[GOUGH_T], &w) != GOUGH_OK) return 0;
    for (int r = 0; r < 3; r++)
        arm[r] =
            state.rotation[r][0] * c[0] + state.rotation[r][1] * c[1] + state.rotation[r][2] * c[2];
    for (int r = 0; r < 3; r++) {
        const int s = (r + 1) % 3, t = (r + 2) % 3;
        const double speed = velocity[r] + omega[s] * arm[t] - omega[t] * arm[s];
        power += w.force[r] * speed + w.moment[r] * omega[r];
    }
    return power;
}

void summary_saturation(gough_summary *summary, const double *value) {
    double *held = summary->held_;

    for (int v = 0; v < GOUGH_LEGS; v++) {
        gough_leg_summary *leg = &summary->leg[v];
        const double now = value[GOUGH_SATURATED + v] > 0 ? 1 : 0;
        if (isnan(value[GOUGH_SATURATED + v])) continue;
        if (isnan(leg->saturated)) leg->saturated = 0;
        if (now > 0 && isnan(leg->saturated_at)) leg->saturated_at = value[GOUGH_T];
        if (held[0] < value[GOUGH_T])
            leg->saturated += (value[GOUGH_T] - held[0]) * (held[1 + v] + now) / 2;
        held[1 + v] = now;
    }
    held[0] = value[GOUGH_T];
}
