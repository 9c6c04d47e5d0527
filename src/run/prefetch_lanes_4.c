/* Stages of 4 times side by side. */
#define NUMBER_LANES 4
#include "run/prefetch_text.h"

const struct prefetch_width prefetch_width_4 = PREFETCH_WIDTH;
