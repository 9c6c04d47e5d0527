/* The command `gough`: threads of its own process run the runs of a sweep. */
#include "cli/sweep/sweep_crew.h"

const sweep_crew the_crew = {.command = "gough"};
