/* What a record is like, what is done to it, and what must be said about both. */
#ifndef STUDY_RECORD_H
#define STUDY_RECORD_H

#include "study/quantum.h"
#include "study/samples.h"

/* A record as read, in the study's units; study_record_make() turns angles into degrees. */
typedef struct study_record_table {
    size_t count;
    double *time;
    double *value; /* six components a row */
    double *
        work; /* study_record_work() doubles; when it is made, the first six of a row are the curvature of the spline */
    study_quantum step[GOUGH_COMPONENTS]; /* of the values as they were written */
    bool given[GOUGH_COMPONENTS];         /* the record has such a column */
    study_clock clock;
    size_t turned; /* a row because of which the angles are about turned axes; 0: they are not */
    bool crowded;  /* it comes close to a pitch of 90°, and to the pole of any other axes */
    double pole;   /* if turned, its distance, or that of the row before, from a pitch of 90° */
} study_record_table;

size_t study_record_work(size_t count);

/* One unit of angle of the record in degrees; exactly 1 for degrees. */
double study_record_degrees(const study_recording *recording);

/* Makes the angles continuous, smooths as asked for, finds the accelerations that the steps of the columns make, and writes the
 * remarks, all into recording->record. */
gough_status study_record_make(study_record_table *table, study_recording *recording,
                               gough_error *error);

#endif
