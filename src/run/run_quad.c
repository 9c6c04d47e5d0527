/* One run over quadruple precision, 33 digits. */
#define NUMBER_QUAD
#include "run/run.h"

#include "run/forces_along.h"
#include "run/forward_run.h"

const struct simulate_table simulate_quad = {walk_run, forward_run};
