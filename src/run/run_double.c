/* One run over double. */
#define NUMBER_DOUBLE
#include "run/run.h"

#include "run/forces_along.h"
#include "run/forward_run.h"

const struct simulate_table simulate_double = {walk_run, forward_run};
