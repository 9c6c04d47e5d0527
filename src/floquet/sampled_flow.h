/* A loop with a sampled controller about its motion, from one sample to the next: what the complex compilation of the run's texts
 * offers to this room. Theory: docs/theory/loop.md. */
#ifndef GOUGH_FLOQUET_SAMPLED_FLOW_H
#define GOUGH_FLOQUET_SAMPLED_FLOW_H

#include <stddef.h>

#include "linear/linear.h"
#include "linear/sampled.h"

/* A deviation has n numbers: ξ, states of the drives, the memory that is used, commands that wait, the latest first. */
typedef struct {
    int drive, waiting, whole, n; /* as in sampled_step */
    bool used[SAMPLED_MEMORY];
    double period, rest; /* T; what the delay has beyond whole periods, 0: nothing */
} sampled_layout;

/* The loop just before a sample: pose and velocities, drives; e, ė, I; the commands that wait. */
typedef struct {
    double y[MOTION + 2 * GOUGH_LEGS], memory[SAMPLED_MEMORY], waiting[SAMPLED_WAITING][GOUGH_LEGS];
} sampled_state;

/* The loop at rest in the program at time t, which it has followed exactly. */
void sampled_begin(const linear_loop *linear, const sampled_layout *layout, double t,
                   sampled_state *state);

/* Takes the state from the sample at t to just before the next one. `deviation`, unless it is NULL, receives row by row what
 * becomes of each number of a deviation, or NaN in each place if the state has become not finite. Adds the number of steps to
 * *steps. Returns the name of what in the study is not finite, or NULL. */
const char *sampled_flow(const linear_loop *linear, const sampled_layout *layout, double t,
                         double tolerance, sampled_state *state, double *deviation, size_t *steps);

/* The same for one deviation, of n numbers, which is replaced by what becomes of it. */
const char *sampled_carry(const linear_loop *linear, const sampled_layout *layout, double t,
                          double tolerance, sampled_state *state, double *deviation);

#endif
