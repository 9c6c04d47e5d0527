/* Groups of 8 plants side by side. */
#define NUMBER_LANES 8
#include "batch/fleet_lanes.h"

const struct fleet_width fleet_width_8 = FLEET_WIDTH;
