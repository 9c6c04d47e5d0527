/* A flight simulator with limits of all kinds and demands on its legs, and one pose of it by other means: vectors, and the
 * functions of dynamics.h at a single state. */
#ifndef TESTS_WORKSPACE_FLIGHT_H
#define TESTS_WORKSPACE_FLIGHT_H

#include "gough/workspace.h"
#include "support/machines.h"

/* legs without mass; with limits of length and swing only */
void flight_machine(gough_model *model);
/* legs with mass, limits of force, speed and acceleration, and motions and loads that are asked for */
void flight_demands(gough_model *model);

gough_reach flight_reach(const gough_model *model);

void flight_state(const gough_model *model, const double component[GOUGH_COMPONENTS],
                  gough_state *state);

/* by how much a pose exceeds the limits of its legs, joints and side; lengths and angles, below 0: by nothing */
double flight_excess(const gough_model *model, const gough_reach *reach,
                     const double component[GOUGH_COMPONENTS]);

/* A motion and load of those asked for: each number at random, or at one of its ends. Forces, rates and second rates of the
 * legs. */
typedef struct flight_load {
    double force[GOUGH_LEGS], rate[GOUGH_LEGS], second_rate[GOUGH_LEGS];
} flight_load;
void flight_draw(const gough_model *model, const double component[GOUGH_COMPONENTS], bool ends,
                 dice *d, flight_load *load);

/* by how much a motion exceeds the limits of the legs, in parts of them; INFINITY where a number is not finite */
double flight_over(const gough_reach *reach, const flight_load *load);

/* a pose of a box, at random or at one of its corners */
void flight_pick(const gough_box *box, bool corner, dice *d, double pose[GOUGH_COMPONENTS]);

/* the distance of two legs as segments, by trying many points of both */
double flight_distance(const gough_model *model, const double component[GOUGH_COMPONENTS], int v,
                       int w);

#endif
