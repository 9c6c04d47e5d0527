/* What the parts of gough pose share: the command line, and poses in the words of a study. */
#ifndef GOUGH_CLI_POSE_VERB_H
#define GOUGH_CLI_POSE_VERB_H

#include <jansson.h>

#include "cli/common/from_lengths.h"

/* certified steps at most from one row of a record to the next */
enum { POSE_ROW_STEPS = 100 };

typedef struct pose_asked {
    lengths_asked lengths;
    bool given_near, given_length_error, all;
    double near[GOUGH_COMPONENTS];
    double length_error;
    const char *samples; /* a file of lengths; NULL: none */
} pose_asked;

typedef struct pose_line {
    command_line line;
    pose_asked asked;
} pose_line;

/* the pose from which one is followed: home, or that of --near */
gough_state pose_begin(const pose_asked *asked, const gough_study *study);

/* that of the Jacobian with rotations times the mean distance of the top joints from the top frame's origin */
double pose_least_singular(const gough_machine *machine, const gough_state *state);

/* ---- the parts ---- */

/* --lengths: one pose, or all of them */
gough_status pose_of_lengths(const pose_line *line, const gough_study *study);

/* --samples */
gough_status pose_of_record(const pose_line *line, const gough_study *study);

/* the keys that all answers have; values of those that do not apply are null. Of `record` the object is taken over */
json_t *pose_object(const gough_study *study, json_t *record);

#endif
