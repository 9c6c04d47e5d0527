/* One run over double, compiled for registers of 4 doubles: the same bits as without, sooner. */
#define NUMBER_DOUBLE
#include "run/run.h"

#include "run/forces_along.h"
#include "run/forward_run.h"

const struct simulate_table simulate_double_4 = {walk_run, forward_run};
