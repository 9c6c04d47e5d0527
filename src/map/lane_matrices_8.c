/* Transition matrices for 8 stiffnesses side by side. */
#define NUMBER_LANES 8
#include "map/lane_matrices.h"

const struct analyse_width analyse_width_8 = {
    8, (sizeof(group) + 63) / 64 * 64, group_begin, group_advance, group_store, compose};
