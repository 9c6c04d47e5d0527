/* What a motion asks of the legs over a box of poses: the wrench that they must give load and legs, and the accelerations of
 * their lengths, (space-12). The equations are those of (legs-7), (mass-1) … (mass-4) and (legs-6), in numbers of (space-3). Base
 * axes; moments are about the top frame's origin. */
#ifndef GOUGH_WORKSPACE_BURDEN_H
#define GOUGH_WORKSPACE_BURDEN_H

#include "workspace/space.h"

/* A motion of the top frame's origin with loads; gravity in parts of the machine's, 0 or 1. */
typedef struct effort {
    double linear[3], angular[3]; /* accelerations */
    double velocity[3], angular_velocity[3];
    double force[3], moment[3]; /* on the load, at its centre of mass, besides weight */
    double gravity;
} effort;

/* The top over the box, made once for all motions. */
typedef struct burden {
    const space *s;
    taylor_vector column[3]; /* R, its columns */
    taylor_vector center;    /* the centre of mass from the top frame's origin */
    taylor_vector arm[LEGS]; /* top joints likewise */
    taylor_vector n[LEGS];   /* directions of the legs */
    taylor length[LEGS], inverse[LEGS];
    taylor across[LEGS], more[LEGS], tilt[LEGS]; /* (mass-1), (mass-2): τ, μ − τ, β/l */
    taylor turning[LEGS];                        /* I_t */
} burden;

/* the greatest of what is asked for, each by itself */
effort effort_most(const gough_reach *reach);

void burden_of(const space *s, const box_view *view, const taylor_vector n[LEGS], burden *b);

/* force, and moment divided by the mean distance of the top joints: what the legs have to give together */
void burden_wrench(const burden *b, const effort *e, taylor wrench[6]);

/* (legs-6): acceleration of the length of leg v */
taylor burden_second_rate(const burden *b, const effort *e, int v);

#endif
