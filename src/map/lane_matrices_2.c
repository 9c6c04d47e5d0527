/* Transition matrices for 2 stiffnesses side by side. */
#define NUMBER_LANES 2
#include "map/lane_matrices.h"

const struct analyse_width analyse_width_2 = {
    2, (sizeof(group) + 63) / 64 * 64, group_begin, group_advance, group_store, compose};
