/* Our right-hand side, compiled for registers of 4 doubles. */
#define NUMBER_DOUBLE
#include "bench/rates_text.h"

const rates_width rates_width_4 = RATES_WIDTH;
