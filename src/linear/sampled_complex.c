/* The controller's own sample and the drives' own equations over complex numbers: imaginary steps come out as their derivatives.
 * Counts are taken for lengths, and commands as what the drives can follow. Theory: docs/theory/loop.md. */
#define NUMBER_COMPLEX
#include "linear/sampled.h"

#include "control/sampler_numbers.h"
#include "drive/drive_numbers.h"
#include "linear/displace.h"

/* a controller that measures lengths themselves */
static sampler sampler_of(const gough_control *control) {
    gough_control exact = *control;
    sampler s;

    exact.sampling.resolution = exact.sampling.noise = 0;
    sampler_put(&s, 0, &exact);
    return s;
}

/* one sample: lengths, rates and memory before; commands and memory after */
static void look(const gough_control *c, const sampler *s, const number seen[SAMPLED_SEEN],
                 sampler_memory *m, number command[LEGS]) {
    number none[LEGS] = {0}, error[LEGS], rate[LEGS], stiffness[LEGS], damping[LEGS],
           integral[LEGS];
    law_coupling across;

    for (int v = 0; v < LEGS; v++) {
        error[v] = -sampler_length(s, seen[v], 0, 0);
        rate[v] = -seen[LEGS + v];
        stiffness[v] = c->stiffness[v];
        damping[v] = c->damping[v];
        integral[v] = c->integral[v];
        for (int w = 0; w < LEGS; w++) {
            across.stiffness[v][w] = c->cross_stiffness[v][w];
            across.damping[v][w] = c->cross_damping[v][w];
        }
    }
    const sampler_gains gains = {stiffness, damping, integral, c->coupled ? &across : NULL};
    sampler_asks(s, &gains, none, error, rate, m, command);
    sampler_integrate(s, integral, command, command, m);
}

static void spread(const sampler_memory *m, number out[SAMPLED_MEMORY]) {
    for (int v = 0; v < LEGS; v++) {
        out[v] = m->error[v];
        out[LEGS + v] = m->rate[v];
        out[2 * LEGS + v] = m->integral[v];
    }
}

void sampled_law_of(const gough_control *control, sampled_law *law) {
    const sampler s = sampler_of(control);

    for (int input = 0; input < SAMPLED_INPUTS; input++) {
        number in[SAMPLED_INPUTS] = {0}, command[LEGS], after[SAMPLED_MEMORY];
        sampler_memory m;

        in[input] = I * imaginary_step;
        for (int v = 0; v < LEGS; v++) {
            m.error[v] = in[SAMPLED_SEEN + v];
            m.rate[v] = in[SAMPLED_SEEN + LEGS + v];
            m.integral[v] = in[SAMPLED_SEEN + 2 * LEGS + v];
        }
        look(control, &s, in, &m, command);
        spread(&m, after);
        for (int v = 0; v < LEGS; v++) law->command[v][input] = cimag(command[v]) / imaginary_step;
        for (int i = 0; i < SAMPLED_MEMORY; i++)
            law->memory[i][input] = cimag(after[i]) / imaginary_step;
    }
    for (int v = 0; v < LEGS; v++) {
        law->used[v] = s.differences;
        law->used[LEGS + v] = s.differences && creal(s.keep) > 0;
        law->used[2 * LEGS + v] = control->integral[v] > 0;
    }
}

int sampled_drive_of(const gough_actuators *actuators, int leg, double change[2][3]) {
    const int first = actuators->time_constant[leg] > 0;
    const int order = actuators->kind != GOUGH_ACTUATOR_LAG ? 0 : first ? 1 : 2;
    gough_actuators limitless = *actuators;
    leg_drive d;

    limitless.max_force[leg][0] = limitless.max_force[leg][1] = limitless.max_rate[leg] = 0;
    drive_put(&d, 0, &limitless, leg);
    for (int input = 0; input < 3; input++) {
        number in[3] = {0};
        in[input] = I * imaginary_step;
        const number force = order == 1 ? drive_first(&d, in[0], in[1]) : in[2];
        const number rate = drive_second(&d, in[0], in[1], in[2]);
        change[0][input] = cimag(force) / imaginary_step;
        change[1][input] = cimag(rate) / imaginary_step;
    }
    return order;
}
