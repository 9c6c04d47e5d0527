/* Groups of 2 plants side by side. */
#define NUMBER_LANES 2
#include "batch/fleet_lanes.h"

const struct fleet_width fleet_width_2 = FLEET_WIDTH;
