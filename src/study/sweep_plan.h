/* The section `sweep` of a study as a plan: which numbers vary, over what, and in how many runs. */
#ifndef STUDY_PLAN_H
#define STUDY_PLAN_H

#include "gough/sweep.h"
#include "study/keys.h"
#include "study/tree.h"

typedef struct study_axis {
    gough_sweep_key key;
    unsigned touches;         /* flags of gough_sweep_touches() */
    const gough_bound *bound; /* of a number; NULL: a formula, here a constant one */
    const double *list;       /* of a list */
    size_t draw;              /* of a distribution: its number among them, from 0 */
    study_node *node;         /* where the sweep asks for it */
} study_axis;

typedef struct study_plan {
    study_axis *axis; /* memory of the arena */
    size_t axes, runs, seed;
    bool zipped;
} study_plan;

/* Reads the plan from a checked tree; says what is wrong. Whether there is one. */
bool study_plan_make(study_messages *messages, study_node *root, study_plan *plan);

/* The number in a tree that an axis varies, made where the file does not give it; NULL where out of memory. */
study_node *study_plan_target(study_arena *arena, study_node *root, const study_axis *axis,
                              bool *made);

void study_plan_values(const study_plan *plan, size_t run, double *value);

#endif
