/* One run over double. */
#define NUMBER_DOUBLE
#include "simulate/simulate.h"

#include "simulate/forward.h"
#include "simulate/forces_along.h"

const struct simulate_table simulate_double = {walk_run, forward_run};
