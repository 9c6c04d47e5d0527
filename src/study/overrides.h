/* Overrides as from --set key=value, applied to the tree before it is checked. */
#ifndef STUDY_SETTINGS_H
#define STUDY_SETTINGS_H

#include "gough/study.h"
#include "study/tree.h"

/* Applies one override; what is wrong is said at "--set key". rank: of its messages, after those of all files. */
void study_setting_apply(study_messages *messages, study_node *root, const gough_setting *setting,
                         int rank);

#endif
