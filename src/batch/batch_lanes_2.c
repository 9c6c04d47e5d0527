/* Groups of 2 runs side by side. */
#define NUMBER_LANES 2
#include "batch/lane_runs.h"

const struct batch_width batch_width_2 = {2, (sizeof(group) + 63) / 64 * 64, group_begin,
                                          group_advance, group_finish};
