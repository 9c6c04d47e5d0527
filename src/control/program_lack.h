/* What keeps a loop from moving as its program does, (law-5), in words. Plain C. */
#ifndef GOUGH_CONTROL_PROGRAM_LACK_H
#define GOUGH_CONTROL_PROGRAM_LACK_H

#include "gough/dynamics.h"

enum { LEGS_LACK, FRICTION_LACKS, LOADS_LACK, LACKS };

/* what the machine has and the feed-forward ignores, dry friction left out; returns how much of it */
static inline int control_lacks(const gough_machine *machine, const gough_control *control,
                                bool moving, bool lacks[LACKS]) {
    bool viscous = false;

    for (int v = 0; v < GOUGH_LEGS; v++) viscous |= machine->platform.friction.viscous[v] > 0;
    lacks[LEGS_LACK] = control->ignores_legs && machine->platform.legs_have_mass;
    lacks[FRICTION_LACKS] = control->ignores_friction && viscous && moving;
    lacks[LOADS_LACK] = control->ignores_external && machine->externals > 0;
    return lacks[LEGS_LACK] + lacks[FRICTION_LACKS] + lacks[LOADS_LACK];
}

/* how many legs have an integral */
static inline int control_integrates(const gough_control *control) {
    int legs = 0;

    for (int v = 0; v < GOUGH_LEGS; v++) legs += control->integral[v] > 0;
    return legs;
}

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
