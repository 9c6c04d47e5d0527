/* Whether a loop moves as its program does, (law-5): the feed-forward is that of the machine as it is, dry friction left out.
 * Theory: docs/theory/control.md. */
#include "control/program_lack.h"

bool gough_keeps_program(const gough_machine *machine, const gough_control *control, bool moving) {
    bool lacks[LACKS];

    return control->feedforward && control_lacks(machine, control, moving, lacks) == 0;
}
