/* What a linearised loop leaves out: dry friction, which at rest would be a damper that holds any loop; and what the feed-forward
 * ignores, in words. */
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
    const bool lags = !model->control.feedforward || model->control.ignores_friction;
    print_paragraph(stream, "", 0,
                    "Dry friction of the legs and losses of their screws are left out: they have "
                    "no useful derivative where a leg rests. gough simulate includes them%s.",
                    lags ? "; there the platform lags behind what is computed here, since no force "
                           "that overcomes them is fed forward"
                         : "");
}

ignored_words words_of_ignored(const gough_model *model, bool moving) {
    const gough_control *control = &model->control;
    const gough_platform *platform = &model->machine.platform;
    ignored_words ignored = {""};
    const char *word[3];
    bool viscous = false;
    int count = 0;
    for (int v = 0; v < GOUGH_LEGS; v++) viscous = viscous || platform->friction.viscous[v] > 0;
    if (control->ignores_legs && platform->legs_have_mass) word[count++] = "the legs' mass";
    if (control->ignores_friction && viscous && moving)
        word[count++] = "the viscous friction of the legs";
    if (control->ignores_external && model->machine.externals > 0)
        word[count++] = "the external loads";
    for (int i = 0, length = 0; i < count; i++)
        length += snprintf(ignored.text + length, sizeof ignored.text - (size_t)length, "%s%s",
                           i == 0           ? ""
                           : i == count - 1 ? " and "
                                            : ", ",
                           word[i]);
    return ignored;
}

feed_words words_of_feed(const gough_model *model, bool moving) {
    feed_words words = {"Without feed-forward"};
    if (model->control.feedforward)
        snprintf(words.text, sizeof words.text, "With feed-forward that ignores %s,",
                 words_of_ignored(model, moving).text);
    return words;
}

void print_linear_friction(FILE *stream, const gough_model *model) {
    if (!leaves_out_friction(model)) return;
    fprintf(stream, "\n");
    print_paragraph(stream, "", 0,
                    "Deviations are those of runs with the dry friction of the legs and the losses "
                    "of their screws. Growth, thresholds and damping ratios leave them out: they "
                    "have no useful derivative where a leg rests.");
}
