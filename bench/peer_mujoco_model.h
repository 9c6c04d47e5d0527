/* The reference machine as models of MuJoCo. */
#ifndef BENCH_PEER_MUJOCO_MODEL_H
#define BENCH_PEER_MUJOCO_MODEL_H

#include <mujoco/mujoco.h>

#include "bench/hand.h"

/* massless legs: a free body on six spatial tendons, each with a motor */
mjModel *mujoco_tendons(const hand *h);

/* legs of two bodies: universal joint in the base, slide with a motor, the far end tied to the top by `connect`; the
 * bodies have the masses of the machine's legs, or a thousandth of the load's */
mjModel *mujoco_legs(const hand *h);

/* sets a pose of the top at rest, and joints of the legs with it */
void mujoco_place(const mjModel *m, mjData *d, const hand *h, const double y[HAND_STATE]);

/* axes of a leg at home: columns two across and the leg's own direction; returns its length */
double mujoco_leg_frame(const hand *h, int leg, double axes[3][3]);

#endif
