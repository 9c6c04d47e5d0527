/* Transition matrices one by one. */
#define NUMBER_DOUBLE
#include "map/lane_matrices.h"

const struct analyse_width analyse_width_1 = {
    1, (sizeof(group) + 63) / 64 * 64, group_begin, group_advance, group_store, compose};
