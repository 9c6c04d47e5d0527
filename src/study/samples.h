/* Recorded motion from a CSV file. */
#ifndef STUDY_SAMPLES_H
#define STUDY_SAMPLES_H

#include "gough/model.h"
#include "study/messages.h"

/* Reads the text of a sample file, angles in degrees there and in radians here, and prepares the spline.
 * memory: one allocation that holds all of it, to be freed by the caller; NULL where an error was said. */
void study_samples_parse(study_messages *messages, const study_source *source,
                         gough_samples *samples, void **memory);

/* Reads a file; the errors about it stand at the place in the study that names it. */
void study_samples_read(study_messages *messages, study_place place, const char *path,
                        gough_samples *samples, void **memory);

#endif
