/* One sample of a controller and its plant at rest as a matrix. Theory: docs/theory/loop.md. */
#ifndef GOUGH_LINEAR_SAMPLED_H
#define GOUGH_LINEAR_SAMPLED_H

#include <stdbool.h>

#include "gough/linear.h"

/* Most numbers of a plant with its drives, of the controller's memory (e, ė and I of the legs), and most commands of a leg that
 * wait until they act. */
enum {
    SAMPLED_PLANT = GOUGH_LINEAR + 2 * GOUGH_LEGS,
    SAMPLED_MEMORY = 3 * GOUGH_LEGS,
    SAMPLED_WAITING = 12,
    SAMPLED_ROWS = SAMPLED_PLANT + SAMPLED_MEMORY + SAMPLED_WAITING * GOUGH_LEGS
};

/* What commands of the legs do at rest, ẋ = A x + B u: ξ, then forces of drives that lag and their rates; δl = J (δr, δθ) */
typedef struct {
    int n;
    double A[SAMPLED_PLANT][SAMPLED_PLANT], B[SAMPLED_PLANT][GOUGH_LEGS], J[GOUGH_LEGS][6];
    double mass[6][6]; /* M̂ on (δv, δω) */
    double lag;        /* of the slowest drive */
} sampled_plant;

/* One sample of the controller, (loop-1), as derivatives by the lengths, their rates and the memory: e, ė, I of each leg. Memory
 * that is not `used` has no effect. */
enum { SAMPLED_SEEN = 2 * GOUGH_LEGS, SAMPLED_INPUTS = SAMPLED_SEEN + SAMPLED_MEMORY };
typedef struct {
    double command[GOUGH_LEGS][SAMPLED_INPUTS], memory[SAMPLED_MEMORY][SAMPLED_INPUTS];
    bool used[SAMPLED_MEMORY];
} sampled_law;

/* The plant over a period, in which a new command begins to act: x ← keep x + before u' + after u. u was given `whole` samples
 * ago; the one before it, u', acts first for the rest of the delay, if there is any. */
typedef struct {
    int n, whole;
    bool parted;
    double keep[SAMPLED_PLANT][SAMPLED_PLANT], before[SAMPLED_PLANT][GOUGH_LEGS],
        after[SAMPLED_PLANT][GOUGH_LEGS];
    bool unsolved; /* LAPACK failed: nothing else counts */
} sampled_step;

/* State of the map: x, used memory, commands that wait, the latest first. Row by row, n numbers each. */
typedef struct {
    int n;
    double matrix[SAMPLED_ROWS * SAMPLED_ROWS];
} sampled_map;

/* sampled_complex.c: the law of a controller; rate of a drive's numbers (force, and its rate if the order is 2) by
 * command, force, rate. Returns the order of the drives, 0 for ideal ones. */
void sampled_law_of(const gough_control *control, sampled_law *law);
int sampled_drive_of(const gough_actuators *actuators, int leg, double change[2][3]);

/* The plant of a machine that rests in a state, `motion` a program that stands there. */
gough_status sampled_plant_of(const gough_machine *machine, const gough_motion *motion,
                              const gough_state *state, sampled_plant *plant, gough_error *error);

/* The same of a model, with its control as it is where the load is borne; fails for a continuous controller too. */
gough_status sampled_rest_of(const gough_model *model, const double component[GOUGH_COMPONENTS],
                             sampled_plant *plant, gough_control *control, gough_state *state,
                             gough_error *error);

/* Fails for a continuous controller, and where more commands wait than may. */
gough_status sampled_check(const gough_sampling *sampling, gough_error *error);

/* Whether so many commands may wait; of each leg, how many do. */
bool sampled_delay_fits(double period, double delay);
int sampled_waiting(double period, double delay);

/* Returns false where numbers are too large, or `unsolved`. The delay must fit. */
bool sampled_step_of(const sampled_plant *plant, double period, double delay, sampled_step *step);

void sampled_map_of(const sampled_plant *plant, const sampled_step *step, const sampled_law *law,
                    sampled_map *map);

/* the largest |μ|; infinite where the map has numbers that are too large, NaN if LAPACK found none */
double sampled_radius(const sampled_map *map);

/* Multipliers by falling magnitude with their modes, up to `most`; returns how many, 0 if LAPACK found none */
int sampled_multipliers(const gough_machine *machine, const sampled_map *map, int most,
                        gough_multiplier *multiplier);

#endif
