/* What keeps a loop from moving as its program does, (law-5), in words. Plain C. */
#ifndef GOUGH_PLANT_KEEPS_PROGRAM_H
#define GOUGH_PLANT_KEEPS_PROGRAM_H

#include "gough/dynamics.h"

typedef struct {
    char how[112];  /* "without feed-forward", "with feed-forward that ignores the legs' mass" */
    char cure[112]; /* after "set": "control.feedforward to program" */
} program_lack;

/* For a loop that does not keep its program, as gough_keeps_program() says. */
program_lack program_lack_of(const gough_machine *machine, const gough_control *control,
                             bool moving);

/* all that holds the machine along its program is fed forward */
void control_knows_all(gough_control *control);

#endif
