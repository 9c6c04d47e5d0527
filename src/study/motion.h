/* The program of a study: formulas, moves or samples. */
#ifndef STUDY_MOTION_H
#define STUDY_MOTION_H

#include "study/build.h"

/* Fills the model's motion; false where an error was said now or before. */
bool study_motion_build(study_build *build);

#endif
