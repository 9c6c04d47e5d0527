/* What the parts of gough workspace share: what was found, in units of the run. */
#ifndef GOUGH_CLI_WORKSPACE_VERB_H
#define GOUGH_CLI_WORKSPACE_VERB_H

#include <jansson.h>

#include "cli/common/verb.h"

typedef struct workspace_line {
    command_line line;
    int slice[2]; /* of --slice: components, both 0 without the option */
} workspace_line;

typedef struct workspace_answer {
    const gough_study *study;
    const gough_units *unit;
    gough_reach reach;
    gough_travel travel[GOUGH_COMPONENTS];
    bool shape_given; /* by workspace.box */
    gough_box shape;
    gough_largest_box box;
    gough_envelope envelope; /* over workspace.box, else over the largest box */
    gough_volume volume;
    gough_error no_envelope, no_volume; /* why they were not found; empty where they were */
    size_t tests;                       /* of all searches */
    gough_error error;
    gough_status status;
} workspace_answer;

/* "leg 3 at its greatest length", without a full stop */
typedef struct binding_words {
    char text[80];
} binding_words;
binding_words words_of_binding(const gough_binding *binding);
/* whether the limit is one of a leg */
bool binding_has_leg(const gough_binding *binding);

/* what a worst value measures, and whether the study asks for anything that has it */
gough_unit worst_unit(int worst);
bool worst_is_asked(const workspace_answer *answer, int worst);

/* a volume in units of the study */
/* how far the bound of a worst value lies beyond the value found, in parts of that; NaN where that is 0 */
double worst_gap(const gough_extreme *x);
double volume_in_units(const gough_units *units, double volume);

/* parts of what is printed that gough design prints too: a pose, the end of its line included; the worst values over a box, of
 * which reach, unit, shape, envelope and no_envelope are needed; a limit that is added to an object */
void workspace_print_pose(const gough_units *unit, const double pose[GOUGH_COMPONENTS]);
void workspace_print_envelope(const workspace_answer *answer);
json_t *workspace_pose_json(const gough_units *unit, const double pose[GOUGH_COMPONENTS]);
json_t *workspace_envelope_json(const workspace_answer *answer);
void workspace_set_binding(json_t *object, const gough_binding *binding);

void workspace_print(const workspace_answer *answer);
int workspace_print_json(const workspace_answer *answer);

/* -o: the poses at which straight lines from home leave the workspace */
gough_status workspace_write(const workspace_line *line, const workspace_answer *answer);

#endif
