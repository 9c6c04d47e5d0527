/* Records with motions that no platform can follow. */
#ifndef TESTS_CUEING_HOSTILE_H
#define TESTS_CUEING_HOSTILE_H

#include "cueing/nearest_rates.h"
#include "gough/cueing.h"
#include "support/machines.h"

/* a flight simulator, lengths in m */
void hostile_machine(gough_model *model);

/* legs of 2.4 to 3.9 m, 0.7 m/s and 6 m/s², other numbers for each leg */
void hostile_begin(gough_limiter *q, const gough_model *model, const gough_state *pose, double h);

typedef struct hostile_count {
    double
        beyond; /* how far a leg was beyond a bound, of length, speed or acceleration, in units of each, at any time */
    double nearest;   /* how near a leg came to the end of its stroke */
    int limited;      /* samples at which a leg was held */
    int whole, ended; /* records to their end; others ended because no pose was certain */
} hostile_count;

hostile_count hostile_records(int records, uint64_t seed);

#endif
