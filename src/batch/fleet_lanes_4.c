/* Groups of 4 plants side by side. */
#define NUMBER_LANES 4
#include "batch/fleet_lanes.h"

const struct fleet_width fleet_width_4 = FLEET_WIDTH;
