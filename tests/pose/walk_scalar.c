/* The certified way of a pose one by one. */
#define NUMBER_DOUBLE
#include "pose/walk_lanes.h"

void walk_scalar(int count, const double (*in)[WALK_NUMBERS], double (*out)[WALK_RESULTS]);
void walk_scalar(int count, const double (*in)[WALK_NUMBERS], double (*out)[WALK_RESULTS]) {
    walk_all(count, in, out);
}
