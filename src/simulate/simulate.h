/* One run in each precision: what simulate.c chooses from. */
#ifndef GOUGH_SIMULATE_SIMULATE_H
#define GOUGH_SIMULATE_SIMULATE_H

#include "gough/simulate.h"

struct simulate_table {
    gough_status (*forces)(const gough_model *model, const gough_simulation *options,
                           gough_sink sink, void *context, gough_crossing_sink crossings,
                           void *crossings_context, gough_end *end);
    gough_status (*simulate)(const gough_model *model, const gough_simulation *options,
                             gough_sink sink, void *context, gough_end *end);
};

extern const struct simulate_table simulate_double, simulate_quad;

#endif
