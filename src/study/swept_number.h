/* The numbers of a study that a sweep or a design varies. */
#ifndef STUDY_TARGET_H
#define STUDY_TARGET_H

#include "study/sweep_plan.h"

/* Fills what an axis has from its path: unit, bound, parts touched. Says what is wrong with the path. */
bool study_target_find(study_messages *messages, study_node *root, study_axis *axis);

/* The node of a path such as platform.legs.length.1, elements of lists by their numbers; NULL if the tree has none. */
study_node *study_node_named(study_arena *arena, study_node *root, const char *path);

#endif
