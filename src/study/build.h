/* From a checked tree to the model. */
#ifndef STUDY_BUILD_H
#define STUDY_BUILD_H

#include "gough/study.h"
#include "study/tree.h"

typedef struct study_build {
    study_messages *messages;
    const study_node *root;
    const char *folder; /* of the study, ending in / or empty: relative samples start there */
    gough_study *study;
    gough_move *moves; /* memory of the model, the caller's to free */
    void *samples;
    const char *samples_path; /* memory of the arena; NULL: none */
    gough_external
        *external;        /* memory of the external loads, likewise; used again where it is there */
    gough_record *record; /* the study's memory for what is found out about recorded motion */
} study_build;

/* Fills these parts of the model, flags of gough_part, once more, from a tree in which only numbers have changed. */
void study_model_rebuild(study_build *build, unsigned parts);

/* Fills the model and the simulation from the tree's parts that have no errors, and says what only then can be found:
 * impossible geometry or inertia, keys that do not go together, recorded motion that is wrong. */
void study_model_build(study_build *build);

#endif
