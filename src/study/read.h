/* The steps of reading a study, for those who take them one by one. */
#ifndef STUDY_READ_H
#define STUDY_READ_H

#include "study/build.h"
#include "study/sweep_plan.h"

/* What a study has allocated besides its model. */
typedef struct study_memory {
    gough_move *moves;
    gough_external *external;
    void *samples;
    gough_record record;
    struct study_where *where; /* in `places` */
    study_arena places;
} study_memory;

/* Copies of a text and its settings that live as long as the arena, which is exhausted where there is no memory for them. */
gough_setting *study_input_copy(study_arena *arena, const char *name, const char *text,
                                size_t length, const gough_setting *settings, size_t count,
                                study_source *source);

/* The guarded, parsed and checked tree of a text that outlives it, settings applied; NULL where there is none. What is wrong
 * is said. */
study_node *study_tree_read(study_messages *messages, const study_source *source,
                            const gough_setting *settings, size_t setting_count);

/* The study of a tree; NULL where out of memory. */
gough_study *study_from_tree(study_messages *messages, study_node *root,
                             const study_source *source);

/* The folder of a file, with its slash: relative samples start there. Empty, the working directory, for a descriptor. */
const char *study_folder(study_arena *arena, const char *name);

#endif
