/* One run over quadruple precision, 33 digits. */
#define NUMBER_QUAD
#include "simulate/simulate.h"

#include "simulate/forward.h"
#include "simulate/forces_along.h"

const struct simulate_table simulate_quad = {walk_run, forward_run};
