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

/* whether friction of the legs is left out of derivatives: at rest it is a damper so strong that any loop seems to hold */
static inline int machine_has_dry_friction(const gough_machine *machine) {
    for (int v = 0; v < GOUGH_LEGS; v++) {
        if (machine->breakaway[v] > 0 || machine->platform.friction.efficiency[v] < 1) return 1;
    }
    return 0;
}

/* the number of the first external load that has no potential, as it turns with the top or is a moment; 0: none */
static inline int machine_loads_follow(const gough_machine *machine) {
    for (size_t n = 0; n < machine->externals; n++) {
        const gough_external *e = &machine->external[n];
        for (int c = 0; c < 3; c++) {
            const bool force = e->turns && !gough_formula_is_zero(&e->force[c]);
            if (force || !gough_formula_is_zero(&e->moment[c])) return (int)n + 1;
        }
    }
    return 0;
}

#endif
