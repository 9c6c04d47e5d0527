/* The program at the times of a block, as the lanes of any width load it. Text over double. */
#ifndef GOUGH_RUN_PREFETCH_PROGRAM_H
#define GOUGH_RUN_PREFETCH_PROGRAM_H

#include "program/program.h"
#include "run/prefetch.h"

/* numbers of a rotation: three axes with two derivatives */
enum { PREFETCH_TURN = 27 };

/* rows of times */
typedef struct prefetch_program {
    formula_row component[GOUGH_COMPONENTS];
    double turn[PREFETCH_TURN][PREFETCH_TIMES];
    int still[PREFETCH_TIMES]; /* no angle moves, and `turn` is not set */
} prefetch_program;

#endif
