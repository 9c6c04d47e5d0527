/* Stages of 8 times side by side. */
#define NUMBER_LANES 8
#include "run/prefetch_text.h"

const struct prefetch_width prefetch_width_8 = PREFETCH_WIDTH;
