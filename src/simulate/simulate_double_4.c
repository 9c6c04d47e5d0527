/* One run over double, compiled for registers of 4 doubles: the same bits as without, sooner. */
#define NUMBER_DOUBLE
#include "simulate/simulate.h"

#include "simulate/drive.h"
#include "simulate/walk.h"

const struct simulate_table simulate_double_4 = {walk_run, drive_run};
