/* The mapping for motion.samples that says how a record is read, as text to paste; and lists of its columns. */
#ifndef STUDY_RECORD_MAPPING_H
#define STUDY_RECORD_MAPPING_H

#include "study/record_columns.h"

/* The quantity that a name certainly means: STUDY_TIME for t and time; -1 if none. */
int study_name_quantity(const char *name);

/* "1 `t`, 2 `Heave (mm)`", or "1, 2"; behind a column note[i] in brackets, unless it or `note` is NULL. NULL if out of memory. */
const char *study_mapping_columns(study_arena *arena, const study_layout *layout,
                                  const char *const *note);

/* What the mapping takes each column for: a quantity, or -1. first: as in study_columns_mapping(). */
void study_mapping_guess(const study_layout *layout, const study_record_keys *keys,
                         const double *first, int *quantity);

#endif
