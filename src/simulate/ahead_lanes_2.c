/* Stages of 2 times side by side. */
#define NUMBER_LANES 2
#include "simulate/ahead_text.h"

const struct ahead_width ahead_width_2 = AHEAD_WIDTH;
