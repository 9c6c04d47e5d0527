/* Groups of a single plant. */
#define NUMBER_DOUBLE
#include "batch/fleet_lanes.h"

const struct fleet_width fleet_width_1 = FLEET_WIDTH;
