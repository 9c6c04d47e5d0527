/* Which column of a record is what: by the keys of the study, or by names that are certain; and a mapping that says so. */
#ifndef STUDY_RECORD_COLUMNS_H
#define STUDY_RECORD_COLUMNS_H

#include "gough/units.h"
#include "study/record_layout.h"

/* How the cells of one column become numbers in the study's units: scale × (the cell in them) + offset. */
typedef struct study_channel {
    bool used;
    bool direct;                       /* the cell is the number: no factor, scale 1, offset 0 */
    size_t column;                     /* from 0 */
    const char *unit;                  /* of the cells; "": the study's */
    double times, over, scale, offset; /* a cell is multiplied by `times` and divided by `over` */
} study_channel;

typedef struct study_columns {
    study_channel channel[STUDY_CHANNELS];
    unsigned rotation; /* as in study_record_keys */
    bool guessed;      /* something beyond names and units of the study was found, not said */
} study_columns;

/* Finds them. False where an error was said: one about all columns that are not certain, with a mapping to paste, or one at the key
 * that is wrong. file: as the study names it; first: the numbers of the first row, NaN where a cell holds no number. */
bool study_columns_choose(study_messages *messages, const study_layout *layout,
                          const study_record_keys *keys, const gough_units *units, const char *file,
                          const double *first, study_columns *columns);

/* The mapping for motion.samples that says how the record is read, on one line of YAML; of columns that are not certain what they
 * may be. NULL if out of memory. */
const char *study_columns_mapping(study_arena *arena, const study_layout *layout,
                                  const study_record_keys *keys, const char *file,
                                  const double *first);

/* A cell in the study's units. */
double study_channel_convert(const study_channel *channel, double cell);

#endif
