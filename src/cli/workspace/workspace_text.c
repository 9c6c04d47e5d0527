/* gough workspace for reading: travels, the largest box, and what stops them, in the study's units. */
#include <math.h>
#include <stdio.h>

#include "cli/common/paragraph.h"
#include "cli/common/scale.h"
#include "cli/common/talk.h"
#include "cli/workspace/workspace_verb.h"

/* limits with the words that follow "leg 3 " */
static const char *leg_words(gough_bind bind) {
    static const char *const words[GOUGH_BINDS] = {
        [GOUGH_BIND_SHORTEST] = "at its least length",
        [GOUGH_BIND_LONGEST] = "at its greatest length",
        [GOUGH_BIND_BASE_SWING] = "at the greatest swing of its base joint",
        [GOUGH_BIND_TOP_SWING] = "at the greatest swing of its top joint",
        [GOUGH_BIND_CLEARANCE] = "touches leg",
        [GOUGH_BIND_SPEED] = "at its greatest speed",
        [GOUGH_BIND_ACCELERATION] = "at its greatest acceleration",
        [GOUGH_BIND_PUSH] = "at its greatest force",
        [GOUGH_BIND_PULL] = "at its least force",
    };
    return words[bind];
}

bool binding_has_leg(const gough_binding *binding) { return leg_words(binding->bind) != NULL; }

binding_words words_of_binding(const gough_binding *binding) {
    binding_words words;
    const char *leg = leg_words(binding->bind);
    const size_t size = sizeof words.text;
    if (binding->bind == GOUGH_BIND_CLEARANCE)
        snprintf(words.text, size, "leg %d %s %d", binding->which + 1, leg, binding->other + 1);
    else if (leg)
        snprintf(words.text, size, "leg %d %s", binding->which + 1, leg);
    else if (binding->bind == GOUGH_BIND_POSE)
        snprintf(words.text, size, "the platform's limit of %s",
                 gough_component_name(binding->which));
    else if (binding->bind == GOUGH_BIND_SINGULAR)
        snprintf(words.text, size, "a singular pose");
    else if (binding->bind == GOUGH_BIND_SINGULAR_VALUE)
        snprintf(words.text, size, "workspace.least_singular_value");
    else
        snprintf(words.text, size, "no limit within the search");
    return words;
}

gough_unit worst_unit(int worst) {
    static const gough_unit unit[GOUGH_WORSTS] = {
        GOUGH_UNIT_FORCE,  GOUGH_UNIT_FORCE, GOUGH_UNIT_LENGTH,
        GOUGH_UNIT_LENGTH, GOUGH_UNIT_SPEED, GOUGH_UNIT_ACCELERATION,
        GOUGH_UNIT_ANGLE,  GOUGH_UNIT_ANGLE, GOUGH_UNIT_LENGTH};
    return worst <= GOUGH_WORST_CLEARANCE ? unit[worst] : GOUGH_UNIT_NONE;
}

bool worst_is_asked(const workspace_answer *a, int worst) {
    const gough_workspace *w = &a->reach.asked;
    double moving = 0, turning = 0;
    for (int k = 0; k < 3; k++) {
        moving += w->velocity[k] + w->angular_velocity[k];
        turning += w->acceleration[k] + w->angular_acceleration[k];
    }
    return worst == GOUGH_WORST_SPEED          ? moving > 0
           : worst == GOUGH_WORST_ACCELERATION ? moving + turning > 0
                                               : true;
}

double worst_gap(const gough_extreme *x) {
    return fabs(x->sampled) > 0 ? fabs(x->bound - x->sampled) / fabs(x->sampled) : NAN;
}

double volume_in_units(const gough_units *units, double volume) {
    const double length = gough_unit_factor(units, GOUGH_UNIT_LENGTH);
    return volume * length * length * length;
}

static void print_range(const workspace_answer *a, int c, double least, double greatest) {
    const table_heading head =
        heading_of(gough_component_name(c), unit_word(a->unit, component_unit(c)));
    printf("  %-14s %12.6g %12.6g", head.text, in_units(a->unit, component_unit(c), least),
           in_units(a->unit, component_unit(c), greatest));
}

static void print_travel(const workspace_answer *a) {
    printf("Travel of each axis from home, the others at home\n");
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        const gough_travel *t = &a->travel[c];
        const binding_words low = words_of_binding(&t->binding[0]),
                            high = words_of_binding(&t->binding[1]);
        print_range(a, c, t->end[0], t->end[1]);
        printf("  %s; %s\n", low.text, high.text);
    }
}

void workspace_print_pose(const gough_units *unit, const double pose[GOUGH_COMPONENTS]) {
    const char *joint = "";
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        if (!(fabs(pose[c]) > 0)) continue;
        printf("%s%s %.6g%s", joint, gough_component_name(c),
               in_units(unit, component_unit(c), pose[c]), unit_word(unit, component_unit(c)));
        joint = ", ";
    }
    printf("%s\n", *joint ? "" : "home");
}

static void print_box(const workspace_answer *a) {
    const gough_largest_box *b = &a->box;
    const binding_words stop = words_of_binding(&b->binding);
    printf("\nLargest box of the shape of %s in which all combinations are free\n",
           a->shape_given ? "workspace.box" : "these travels");
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        print_range(a, c, b->box.least[c], b->box.greatest[c]);
        printf("\n");
    }
    printf("  %-20s %.5g of the shape, certified\n", "size", b->scale);
    if (!(b->upper < INFINITY)) {
        printf("  %-20s no larger box was tried that is not free\n", "stopped by");
        return;
    }
    printf("  %-20s %.5g of the shape is not free\n", "", b->upper);
    printf("  %-20s %s, at\n", "stopped by", stop.text);
    printf("  %-20s ", "");
    workspace_print_pose(a->unit, b->pose);
}

/* the words of the table of worst values, by gough_worst */
static const char *const WORST[GOUGH_WORSTS] = {
    "greatest force",      "least force",       "shortest",         "longest",   "leg speed",
    "leg acceleration",    "swing at the base", "swing at the top", "clearance", "condition",
    "least singular value"};

void workspace_print_envelope(const workspace_answer *a) {
    printf("\nWorst values in %s\n", a->shape_given ? "workspace.box" : "this box");
    if (*a->no_envelope.message) {
        print_paragraph(stdout, "  not bounded", 23, "%s", a->no_envelope.message);
        return;
    }
    printf("  %-28s %13s %12s %10s\n", "", "no worse than", "found", "apart");
    for (int i = 0; i < GOUGH_WORSTS; i++) {
        const gough_extreme *x = &a->envelope.of[i];
        const gough_unit unit = worst_unit(i);
        if (!worst_is_asked(a, i)) continue;
        const char *word = unit == GOUGH_UNIT_NONE ? "" : unit_word(a->unit, unit);
        const table_heading head = heading_of(WORST[i], word);
        printf("  %-28s %13.6g %12.6g", head.text,
               unit == GOUGH_UNIT_NONE ? x->bound : in_units(a->unit, unit, x->bound),
               unit == GOUGH_UNIT_NONE ? x->sampled : in_units(a->unit, unit, x->sampled));
        if (fabs(x->sampled) > 0)
            printf(" %8.2g %%", 100 * worst_gap(x));
        else
            printf(" %10s", "");
        if (x->leg >= 0) printf("  leg %d", x->leg + 1);
        if (i == GOUGH_WORST_CLEARANCE && !(x->sampled > 0)) printf(" touches another leg");
        printf("\n");
    }
}

static void print_volume(const workspace_answer *a) {
    const char *word = unit_word(a->unit, GOUGH_UNIT_LENGTH);
    const double *at = a->study->model->workspace.orientation;
    printf("\nPositions at roll %.4g, pitch %.4g, yaw %.4g%s\n",
           in_units(a->unit, GOUGH_UNIT_ANGLE, at[0]), in_units(a->unit, GOUGH_UNIT_ANGLE, at[1]),
           in_units(a->unit, GOUGH_UNIT_ANGLE, at[2]), unit_word(a->unit, GOUGH_UNIT_ANGLE));
    if (*a->no_volume.message) {
        print_paragraph(stdout, "  volume", 23, "%s", a->no_volume.message);
        return;
    }
    printf("  %-20s %.*g%s%s\n", "volume", a->volume.exact ? 6 : 3,
           volume_in_units(a->unit, a->volume.value), word, *word ? "^3" : "");
    printf("  %-20s %.4g to %.4g%s%s\n", "certainly", volume_in_units(a->unit, a->volume.least),
           volume_in_units(a->unit, a->volume.greatest), word, *word ? "^3" : "");
}

void workspace_print(const workspace_answer *a) {
    print_title(stdout, a->study->title);
    printf("%s\n\n", units_sentence(a->study, a->unit).text);
    print_travel(a);
    print_box(a);
    workspace_print_envelope(a);
    print_volume(a);
}
