/* Stages of 4 times side by side. */
#define NUMBER_LANES 4
#include "simulate/ahead_text.h"

const struct ahead_width ahead_width_4 = AHEAD_WIDTH;
