/* A pose given by leg lengths, as machines measure them, instead of by its components. */
#ifndef GOUGH_CLI_FROM_LENGTHS_H
#define GOUGH_CLI_FROM_LENGTHS_H

#include "cli/common/verb.h"

/* certified steps at most along a way from home or between given poses */
enum { LENGTHS_STEPS = 4000 };

/* The value of an option --lengths. */
typedef struct lengths_asked {
    bool given;
    double length[GOUGH_LEGS]; /* in the units of the study */
} lengths_asked;

extern const option_group lengths_group; /* lengths_asked [text] */

/* ---- poses in the words of a study: components from home of the point `about` of its motion, angles in radians ---- */

gough_state pose_at(const gough_model *model, const double component[GOUGH_COMPONENTS]);
void pose_components(const gough_model *model, const gough_state *state,
                     double component[GOUGH_COMPONENTS]);

/* ---- the pose of lengths that is joined to home ---- */

/* Its components from home, in the units of the study; complains where it is not certain. */
gough_status lengths_pose(const char *verb, const gough_study *study, const lengths_asked *asked,
                          double pose[GOUGH_COMPONENTS]);

/* What is added to the settings of a command line, as long as it is used. */
typedef struct lengths_settings {
    char value[GOUGH_COMPONENTS][32];
    setting_list settings;
} lengths_settings;

/* Reads a study whose runs start in that pose, as `initial` has it: the study is read, the pose found, and the study read again
 * with settings of its `initial`, which *line has from then on. Without lengths it is only read. `memory` is freed with
 * lengths_settings_free(). */
gough_status read_study_at(command_line *line, const char *path, const lengths_asked *asked,
                           lengths_settings *memory, gough_study **study);
void lengths_settings_free(lengths_settings *memory);

#endif
