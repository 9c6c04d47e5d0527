/* External loads of a periodic motion. */
#ifndef GOUGH_FLOQUET_LOADS_H
#define GOUGH_FLOQUET_LOADS_H

#include "gough/floquet.h"

/* Fails, with a sentence, if an external load does not repeat with the period. Compared at moments spread over the period. */
gough_status loads_check(const gough_machine *machine, const gough_period *period,
                         gough_error *error);

/* Whether no external load varies within the period, likewise. */
bool loads_constant(const gough_machine *machine, const gough_period *period);

#endif
