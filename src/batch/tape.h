/* Stages depend on time alone: recorded by the first lanes that come to them, replayed by all others that share program, machine
 * or disturbances. Plain doubles, so that lanes of every width read one tape. */
#ifndef GOUGH_BATCH_TAPE_H
#define GOUGH_BATCH_TAPE_H

#include "gough/batch.h"
#include "plant/layout.h"

typedef struct {
    double time;
    double component[GOUGH_COMPONENTS][3]; /* the program's jets */

    /* where all runs have one machine: F^p and the legs' shares of a vertical force (in `force`, or apart), l^p, l̇^p,
     * (ρ, i, j, k) of the program,
     * determinant and pivots of its six equations */
    double force[GOUGH_LEGS], shake[GOUGH_LEGS], length[GOUGH_LEGS], rate[GOUGH_LEGS];
    double pose[COORDINATES];
    double determinant, pivot_ratio;

    /* where all runs have one disturbance */
    double leg[GOUGH_LEGS], vertical;
    double push[3], turn[3];
} tape_record;

typedef struct stage_tape {
    tape_record *record;
    int room, count, cursor;
    int machine_shared, disturbance_shared;
    void *recorder; /* fills records: a scalar run */
    void (*write)(struct stage_tape *tape, double t, tape_record *record);
    tape_record spare;       /* for times beyond the room */
    const tape_record *last; /* the record given last */
} stage_tape;

/* the next record, which is that of time t: steppers ask for the same times in the same order */
static inline const tape_record *tape_at(stage_tape *tape, double t) {
    const int known = tape->cursor < tape->count;

    if (known && !(tape->record[tape->cursor].time < t) && !(tape->record[tape->cursor].time > t)) {
        tape->last = &tape->record[tape->cursor++];
    } else if (known || tape->count == tape->room) {
        tape->write(tape, t, &tape->spare);
        tape->last = &tape->spare;
    } else {
        tape->write(tape, t, &tape->record[tape->count++]);
        tape->last = &tape->record[tape->cursor++];
    }
    return tape->last;
}

#endif
