/* Where the keys of a study stand, kept for errors that are found when it runs. */
#ifndef STUDY_WHERE_H
#define STUDY_WHERE_H

#include "gough/study.h"
#include "study/tree.h"

typedef struct study_where study_where;

/* The paths and places of a tree's values, in memory of `arena` alone; NULL if there are none or memory is short. */
study_where *study_where_keep(study_arena *arena, const study_node *root);

#endif
