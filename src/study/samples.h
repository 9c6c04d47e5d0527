/* Recorded motion from a text file: rows of cells, as record_layout.h has them. */
#ifndef STUDY_SAMPLES_H
#define STUDY_SAMPLES_H

#include "gough/study.h"
#include "study/messages.h"
#include "study/record_keys.h"

/* How a record is smoothed: `smooth` and `cutoff` of motion or motion.samples. */
typedef struct study_smoothing {
    enum {
        STUDY_AS_RECORDED,       /* nothing is said about it: rounding that matters is warned of */
        STUDY_EXACT,             /* none: the values are meant as they are written */
        STUDY_SMOOTH_ROUNDING,   /* by as much as rounding moved the values */
        STUDY_SMOOTH_DEVIATIONS, /* by these root mean squares */
        STUDY_SMOOTH_CUTOFF      /* below this frequency */
    } kind;
    double deviation[GOUGH_COMPONENTS]; /* in the study's units; 0: as recorded */
    double cutoff;                      /* cycles per unit of time of the study */
} study_smoothing;

/* A record to be read. */
typedef struct study_recording {
    study_smoothing smoothing;
    gough_units units;      /* of sentences, and of cells that have no other */
    gough_order order;      /* of the angles of the study */
    study_record_keys keys; /* what the study says about the file */
    const char *file;       /* as the study names it */
    gough_record *record;   /* receives what was found out */
    gough_samples *samples; /* receives the motion in units of the run, its spline prepared */
    void *
        memory; /* one allocation that holds all of it, to be freed by the caller; NULL where an error was said */
} study_recording;

/* Reads the text of a sample file. */
void study_samples_parse(study_messages *messages, const study_source *source,
                         study_recording *recording);

/* Reads a file; the errors about it stand at the place in the study that names it. */
void study_samples_read(study_messages *messages, study_place place, const char *path,
                        study_recording *recording);

#endif
