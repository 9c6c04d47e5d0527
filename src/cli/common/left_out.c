/* What a linearised loop leaves out: dry friction, which at rest would be a damper that holds any loop. */
#include "cli/common/left_out.h"

#include "cli/common/paragraph.h"

bool leaves_out_friction(const gough_model *model) {
    const gough_machine *machine = &model->machine;
    for (int v = 0; v < GOUGH_LEGS; v++)
        if (machine->breakaway[v] > 0 || machine->platform.friction.efficiency[v] < 1) return true;
    return false;
}

void print_left_out_friction(FILE *stream, const gough_model *model) {
    if (!leaves_out_friction(model)) return;
    fprintf(stream, "\n");
    print_paragraph(stream, "", 0,
                    "Dry friction of the legs and losses of their screws are left out: they have "
                    "no useful derivative where a leg rests. gough simulate includes them.");
}

void print_linear_friction(FILE *stream, const gough_model *model) {
    if (!leaves_out_friction(model)) return;
    fprintf(stream, "\n");
    print_paragraph(stream, "", 0,
                    "Deviations are those of runs with the dry friction of the legs and the losses "
                    "of their screws. Growth, thresholds and damping ratios leave them out: they "
                    "have no useful derivative where a leg rests.");
}
