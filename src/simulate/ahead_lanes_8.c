/* Stages of 8 times side by side. */
#define NUMBER_LANES 8
#include "simulate/ahead_text.h"

const struct ahead_width ahead_width_8 = AHEAD_WIDTH;
