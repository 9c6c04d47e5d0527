/* Stages of 2 times side by side. */
#define NUMBER_LANES 2
#include "run/prefetch_text.h"

const struct prefetch_width prefetch_width_2 = PREFETCH_WIDTH;
