/* Volume where lengths are all that limits positions: by upright lines, which meet the spheres of the legs in closed form. */
#ifndef GOUGH_WORKSPACE_LINES_H
#define GOUGH_WORKSPACE_LINES_H

#include "workspace/space.h"

/* A box about some positions; without any its ends are infinite, the least above the greatest. */
typedef struct hull {
    double least[3], greatest[3];
} hull;

/* (space-17): the volume of the positions within a box, at the orientation R, on the side of home of all singular poses. Leg v
 * keeps the point between two spheres about centre[v]. Outside of the box `doubtful` no position that all legs allow is on the
 * other side. */
double lines_volume(const space *s, const triad *R, const hull *allowed, const hull *doubtful,
                    const vector centre[LEGS]);

#endif
