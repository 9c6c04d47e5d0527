/* Who runs the runs of `gough sweep`: the threads of the command's own process, or with gough-mpi the processes that mpirun
 * started. Each of the two programs is linked with one file that defines `the_crew`. */
#ifndef GOUGH_CLI_SWEEP_CREW_H
#define GOUGH_CLI_SWEEP_CREW_H

#include "gough/gough.h"

typedef struct sweep_crew {
    const char *command; /* name of the program */
    const char *only;    /* its only verb; NULL: it has all */
    const char *text;    /* of its --help, if it has one verb */
    /* Called first of all; may not return, in a process that takes part in the runs of another. NULL: nothing to do */
    void (*begin)(int *count, char ***argument);
    gough_sweep_runner run; /* NULL: gough_sweep_run() */
} sweep_crew;

extern const sweep_crew the_crew;

#endif
