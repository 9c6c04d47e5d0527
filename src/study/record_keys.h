/* What a study says about its record: the keys of motion.samples. */
#ifndef STUDY_RECORD_KEYS_H
#define STUDY_RECORD_KEYS_H

#include "gough/model.h"
#include "gough/units.h"
#include "study/tree.h"

/* The quantities that a column may be. */
enum {
    STUDY_QUATERNION = GOUGH_COMPONENTS, /* qw, qx, qy, qz */
    STUDY_MATRIX = STUDY_QUATERNION + 4, /* r11 … r33 */
    STUDY_QUANTITIES = STUDY_MATRIX + 9,
    STUDY_TIME = STUDY_QUANTITIES,
    STUDY_CHANNELS
};

/* "heave", "qw", "r11", and "t" */
const char *study_quantity_name(int quantity);

/* the quantity of that name; -1 if no quantity has it */
int study_quantity_of(const char *name);

/* whether it measures a length, an angle, a time or nothing */
gough_unit study_quantity_unit(int quantity);

/* What the study says about one column. */
typedef struct study_column_keys {
    study_node *node;   /* NULL: nothing */
    study_node *column; /* its name or number; NULL: not given */
    size_t number;      /* from 1; 0: the text of `column` is its name */
    study_node *unit;
    double scale, offset;
} study_column_keys;

/* Zero-filled, with scales of 1: a bare file name. */
typedef struct study_record_keys {
    study_node *node; /* motion.samples */
    size_t skip;
    const char *comment;
    char separator, decimal; /* 0: to be found */
    study_column_keys channel[STUDY_CHANNELS];
    bool columns; /* it says which columns are read */
    bool from_first_time;
    double time_step; /* 0: a column has the times */
    bool from_first;
    enum { STUDY_ANGLES, STUDY_BY_QUATERNION, STUDY_BY_MATRIX } rotation;
    gough_order order; /* of the file's angles */
} study_record_keys;

/* Reads them from a mapping whose keys were checked; what does not go together is said. `order` is that of the study. */
study_record_keys study_record_keys_read(study_messages *messages, study_node *samples,
                                         gough_order order);

/* Those of a bare file name. */
study_record_keys study_record_keys_none(study_node *samples, gough_order order);

#endif
