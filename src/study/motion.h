/* The program of a study: formulas, moves or samples. */
#ifndef STUDY_MOTION_H
#define STUDY_MOTION_H

#include "study/build.h"

/* Fills the model's motion; false where an error was said now or before. */
bool study_motion_build(study_build *build);

/* Places the moves that were read one after the other; with a machine, finds those durations that follow from limits. */
void study_moves_place(study_build *build, bool machine);

/* Whether the duration of a move depends on the machine. */
bool study_moves_depend(const study_node *root);

#endif
