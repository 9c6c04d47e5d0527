/* The section `design` of a study as a plan: which numbers are chosen, between which bounds, and what is asked for. */
#ifndef STUDY_DESIGN_PLAN_H
#define STUDY_DESIGN_PLAN_H

#include "gough/study.h"
#include "study/sweep_plan.h"

typedef struct study_design {
    study_axis *axis; /* memory of the arena */
    gough_design_key *key;
    size_t keys;
    double weight[GOUGH_AIMS];
    double telescope, least_singular_value; /* in the units of the file; telescope NaN: not given */
    uint32_t seed;
    size_t evaluations; /* 0: not given */
} study_design;

/* Reads the section from a checked tree; says what is wrong. Whether there is such a section and it is right. */
bool study_design_make(study_messages *messages, study_node *root, study_design *design);

#endif
