/* Whether a loop moves as its program does, (law-5): the feed-forward is that of the machine as it is, dry friction left out. At
 * rest integrals in all legs do the same: they come to bear whatever the feed-forward lacks.
 * Theory: docs/theory/control.md. */
#include "control/program_lack.h"

bool gough_keeps_program(const gough_machine *machine, const gough_control *control, bool moving) {
    bool lacks[LACKS];

    if (!moving && control_integrates(control) == GOUGH_LEGS) return true;
    return control->feedforward && control_lacks(machine, control, moving, lacks) == 0;
}
