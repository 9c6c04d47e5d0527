/* Our right-hand side, compiled for registers of 2 doubles. */
#define NUMBER_DOUBLE
#include "bench/rates_text.h"

const rates_width rates_width_2 = RATES_WIDTH;
