/* Transition matrices for 4 stiffnesses side by side. */
#define NUMBER_LANES 4
#include "map/lane_matrices.h"

const struct analyse_width analyse_width_4 = {
    4, (sizeof(group) + 63) / 64 * 64, group_begin, group_advance, group_store, compose};
