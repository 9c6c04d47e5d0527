/* Whether drive forces determine how a machine moves. Plain C. */
#ifndef GOUGH_PLANT_CAN_MOVE_H
#define GOUGH_PLANT_CAN_MOVE_H

#include "gough/model.h"

/* the first leg whose screw locks itself: the leg force is no function of the drive force there, (mass-13); 0: none */
static inline int machine_locks(const gough_machine *machine) {
    for (int v = 0; v < GOUGH_LEGS; v++) {
        if (!(machine->platform.friction.efficiency[v] > 0.5)) return v + 1;
    }
    return 0;
}

/* the same as an error, with a sentence */
static inline gough_status machine_can_move(const gough_machine *machine, gough_error *error) {
    const int leg = machine_locks(machine);

    if (leg == 0) return GOUGH_OK;
    return gough_fail_key(error, GOUGH_ERROR_INPUT, "platform.legs.friction.efficiency",
                          "with an efficiency of %.9g in leg %d the screw locks itself: such a leg "
                          "is driven by position, not by force. Forces along a motion can be "
                          "computed, a motion under forces needs an efficiency above 0.5",
                          machine->platform.friction.efficiency[leg - 1], leg);
}

/* For what is not worked out for legs with mass and friction; `what` begins the sentence. */
static inline gough_status machine_is_plain(const gough_machine *machine, const char *what,
                                            gough_error *error) {
    const gough_platform *p = &machine->platform;
    int rough = 0;

    for (int v = 0; v < GOUGH_LEGS; v++) {
        rough |= machine->breakaway[v] > 0 || p->friction.viscous[v] > 0 ||
                 p->friction.efficiency[v] < 1;
    }
    if (!p->legs_have_mass && !rough) return GOUGH_OK;
    return gough_fail_key(error, GOUGH_ERROR_INPUT, "platform.legs",
                          "%s not computed for legs with mass or friction in this version; remove "
                          "them from platform.legs",
                          what);
}

#endif
