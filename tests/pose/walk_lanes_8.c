/* The certified way of a pose in 8 lanes. */
#define NUMBER_LANES 8
#include "pose/walk_lanes.h"

void walk_lanes_8(int count, const double (*in)[WALK_NUMBERS], double (*out)[WALK_RESULTS]);
void walk_lanes_8(int count, const double (*in)[WALK_NUMBERS], double (*out)[WALK_RESULTS]) {
    walk_all(count, in, out);
}
