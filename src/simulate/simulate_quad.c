/* One run over quadruple precision, 33 digits. */
#define NUMBER_QUAD
#include "simulate/simulate.h"

#include "simulate/drive.h"
#include "simulate/walk.h"

const struct simulate_table simulate_quad = {walk_run, drive_run};
