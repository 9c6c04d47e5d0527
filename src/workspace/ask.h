/* What the motions and loads that are asked for do to each leg over a box of poses: drive forces, rates and accelerations of the
 * lengths, (space-12) … (space-15). */
#ifndef GOUGH_WORKSPACE_ASK_H
#define GOUGH_WORKSPACE_ASK_H

#include "workspace/burden.h"
#include "workspace/stiff.h"

/* The greatest value over all motions and loads that are asked for, as a number that depends on the pose. */
typedef struct over_box {
    double least, most; /* bounds of it over the box */
    taylor near;        /* of forces: they lie between near + sure and near + above */
    double sure, above;
} over_box;

typedef struct asked_of_leg {
    over_box push, pull;   /* greatest drive force, and the least with its sign turned */
    over_box speed;        /* greatest |rate| */
    over_box acceleration; /* greatest |second rate| */
} asked_of_leg;

void asked_of(const space *s, const box_view *view, const taylor_vector n[LEGS], const stiff *J,
              asked_parts parts, asked_of_leg asked[LEGS]);

#endif
