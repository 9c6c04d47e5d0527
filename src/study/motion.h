/* The program of a study: formulas, moves or samples. */
#ifndef STUDY_MOTION_H
#define STUDY_MOTION_H

#include "study/build.h"

/* Fills the model's motion; false where an error was said now or before. */
bool study_motion_build(study_build *build);

/* The numbers of a checked list, in order; nothing where it is NULL. */
void study_numbers(const study_node *list, double *value);

/* The formula of a checked scalar; the constant 0 where it is NULL. */
gough_formula study_formula(const study_node *node);

#endif
