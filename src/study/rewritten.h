/* The text of a study with other numbers at some keys; comments and everything else stay. */
#ifndef STUDY_REWRITTEN_H
#define STUDY_REWRITTEN_H

#include "study/varied.h"

/* The text, in memory of the arena, that reads without settings as the tree of `varied`: that of the file with these settings, in
 * which the numbers of the axes have other values. NULL with the reason in *error. */
const char *study_rewritten(study_arena *arena, const study_source *source,
                            const gough_setting *settings, size_t setting_count,
                            const study_varied *varied, gough_error *error);

#endif
