/* The numbers of a study that a sweep varies. */
#ifndef STUDY_TARGET_H
#define STUDY_TARGET_H

#include "study/sweep_plan.h"

/* Fills what an axis has from its path: unit, bound, parts touched. Says what is wrong with the path. */
bool study_target_find(study_messages *messages, study_node *root, study_axis *axis);

#endif
