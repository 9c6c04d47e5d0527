/* One run over double, compiled for registers of 8 doubles: the same bits as without, sooner. */
#define NUMBER_DOUBLE
#include "simulate/simulate.h"

#include "simulate/forward.h"
#include "simulate/forces_along.h"

const struct simulate_table simulate_double_8 = {walk_run, forward_run};
