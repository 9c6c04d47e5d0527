/* One run over double, compiled for registers of 8 doubles: the same bits as without, sooner. */
#define NUMBER_DOUBLE
#include "run/run.h"

#include "run/forces_along.h"
#include "run/forward_run.h"

const struct simulate_table simulate_double_8 = {walk_run, forward_run};
