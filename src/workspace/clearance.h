/* The distance of two legs as segments between their joints, over a box of poses, (space-16). */
#ifndef GOUGH_WORKSPACE_CLEARANCE_H
#define GOUGH_WORKSPACE_CLEARANCE_H

#include "workspace/space.h"

/* whether two legs share a joint, where they always meet */
bool clearance_is_joint(const space *s, int v, int w);

/* bounds of the distance of the axes of legs v and w over the box; one from below that is at least `enough` may be coarse */
void clearance_of(const space *s, const box_view *view, const taylor_vector n[LEGS], int v, int w,
                  double enough, double bound[2]);

#endif
