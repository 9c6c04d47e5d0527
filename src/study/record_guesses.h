/* Sentences about what was found in a record without being told. */
#ifndef STUDY_RECORD_GUESSES_H
#define STUDY_RECORD_GUESSES_H

#include "study/record_columns.h"
#include "study/samples.h"

/* Remarks: separators and decimal marks other than commas and points, names that are not those of the study, units. */
void study_guesses_say(const study_recording *recording, const study_layout *layout,
                       const study_columns *columns);

#endif
