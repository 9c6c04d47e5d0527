/* Records that come close to a pitch of 90°, read as angles about turned axes. */
#ifndef STUDY_TURNED_H
#define STUDY_TURNED_H

#include "study/record.h"

/* Angle of the rotation to a row from the one before, in degrees. */
double study_turn_between(const study_record_table *table, size_t row);

/* Replaces the angles of a record by continuous angles about turned axes, if a curve through roll, pitch and yaw is wrong where
 * pitch is close to 90°, and if there are axes whose own pole is far enough from all rows. Then the steps of the three columns,
 * and the deviations asked for, are changed to what they mean for these angles. Writes recording->samples->axes, `turned` and
 * `pole_distance` of the record, `turned`, `crowded` and `pole` of the
 * table. copy: as large as table->value. */
void study_record_turn(study_record_table *table, study_recording *recording,
                       study_quantum step[GOUGH_COMPONENTS], double *copy);

#endif
