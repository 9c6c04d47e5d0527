/* One run over double. */
#define NUMBER_DOUBLE
#include "simulate/simulate.h"

#include "simulate/drive.h"
#include "simulate/walk.h"

const struct simulate_table simulate_double = {walk_run, drive_run};
