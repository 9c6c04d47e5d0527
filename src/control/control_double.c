/* The public functions of a control law: gough/dynamics.h over double. */
#define NUMBER_DOUBLE
#include <string.h>

#include "control/law.h"
#include "control/sampler_numbers.h"
#include "drive/drive_numbers.h"
#include "gough/dynamics.h"

void gough_control_law(const gough_control *control, const double program_force[GOUGH_LEGS],
                       const double program_length[GOUGH_LEGS],
                       const double program_rate[GOUGH_LEGS], const double length[GOUGH_LEGS],
                       const double rate[GOUGH_LEGS], double force[GOUGH_LEGS]) {
    for (int v = 0; v < LEGS; v++) {
        force[v] =
            law_force(control->feedforward ? program_force[v] : 0, control->stiffness[v],
                      control->damping[v], program_length[v], program_rate[v], length[v], rate[v]);
    }
}

void gough_control_sample(const gough_control *control, const gough_actuators *actuators,
                          gough_control_memory *memory, const double program_force[GOUGH_LEGS],
                          const double program_length[GOUGH_LEGS],
                          const double program_rate[GOUGH_LEGS], const double length[GOUGH_LEGS],
                          const double rate[GOUGH_LEGS], double command[GOUGH_LEGS]) {
    sampler rule;
    law_coupling cross;
    static const gough_actuators ideal;
    const sampler_gains gains = {control->stiffness, control->damping, control->integral,
                                 control->coupled ? &cross : NULL};
    double error[LEGS], slope[LEGS], fed[LEGS], asked[LEGS];
    sampler_memory m;

    sampler_put(&rule, 0, control);
    memcpy(cross.stiffness, control->cross_stiffness, sizeof cross.stiffness);
    memcpy(cross.damping, control->cross_damping, sizeof cross.damping);
    for (int v = 0; v < LEGS; v++) {
        fed[v] = control->feedforward ? program_force[v] : 0;
        error[v] = program_length[v] - length[v];
        slope[v] = rate ? program_rate[v] - rate[v] : 0;
        m.error[v] = memory->error[v];
        m.rate[v] = memory->rate[v];
        m.integral[v] = memory->integral[v];
    }
    if (!memory->begun) sampler_begin(&rule, error, slope, &m);
    sampler_asks(&rule, &gains, fed, error, slope, &m, asked);
    for (int v = 0; v < LEGS; v++) {
        leg_drive d;
        drive_put(&d, 0, actuators ? actuators : &ideal, v);
        command[v] = drive_takes(&d, asked[v]);
    }
    sampler_integrate(&rule, control->integral, asked, command, &m);
    memory->begun = true;
    for (int v = 0; v < LEGS; v++) {
        memory->error[v] = m.error[v];
        memory->rate[v] = m.rate[v];
        memory->integral[v] = m.integral[v];
    }
}
