/* What keeps a loop from moving as its program does, (law-5), in words. Theory: docs/theory/control.md. */
#include "control/program_lack.h"

#include <stdio.h>

/* "a, b and c" of those that are so */
static void list(const char *const word[LACKS], const bool lacks[LACKS], int count,
                 const char *before, const char *after, char *out, size_t room) {
    int put = 0, length = snprintf(out, room, "%s", before);

    for (int i = 0; i < LACKS; i++) {
        if (!lacks[i]) continue;
        length += snprintf(out + length, room - (size_t)length, "%s%s",
                           put == 0           ? ""
                           : put == count - 1 ? " and "
                                              : ", ",
                           word[i]);
        put++;
    }
    snprintf(out + length, room - (size_t)length, "%s", after);
}

program_lack program_lack_of(const gough_machine *machine, const gough_control *control,
                             bool moving) {
    static const char *const what[LACKS] = {"the legs' mass", "their viscous friction",
                                            "the external loads"};
    static const char *const key[LACKS] = {"control.model.legs", "control.model.friction",
                                           "control.model.external"};
    program_lack lack = {"without feed-forward", "control.feedforward to program"};
    bool lacks[LACKS];
    const int count = control_lacks(machine, control, moving, lacks);

    if (!control->feedforward) return lack;
    const char *const named[LACKS] = {
        what[0], lacks[LEGS_LACK] ? what[1] : "the legs' viscous friction", what[2]};
    list(named, lacks, count, "with feed-forward that ignores ", "", lack.how, sizeof lack.how);
    list(key, lacks, count, "", " to true", lack.cure, sizeof lack.cure);
    return lack;
}

void control_knows_all(gough_control *control) {
    control->feedforward = true;
    control->ignores_legs = control->ignores_friction = control->ignores_external = false;
}
