/* What is worst over a box of poses, each value with a bound and, at the centre, one that a pose has, (space-18). */
#ifndef GOUGH_WORKSPACE_WORST_VALUES_H
#define GOUGH_WORKSPACE_WORST_VALUES_H

#include "workspace/space.h"

/* Values of which greater ones are worse: those that are worst where they are least have their sign turned. */
typedef struct values {
    double most[GOUGH_WORSTS]; /* no pose of the box has a worse one */
    double sure[GOUGH_WORSTS]; /* at a single pose: one that it has */
    int leg[GOUGH_WORSTS];
} values;

/* the values of a box, of those that have their bit in `wanted` */
void worst_values(const space *s, const box_view *view, unsigned wanted, values *to);

#endif
