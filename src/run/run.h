/* One run in each precision: what simulate.c chooses from. */
#ifndef GOUGH_RUN_RUN_H
#define GOUGH_RUN_RUN_H

#include "gough/simulate.h"

/* relative slack for one time dividing another, as both are decimals in binary */
static const double division_slack = 1e-9;

/* what a run of forward dynamics is made of */
typedef struct {
    const gough_motion *motion;
    const gough_machine *machine;
    const gough_control *control;
    const gough_disturbance *disturbance;
    const gough_initial *initial;
    uint64_t number;  /* of the run, for its noise */
    uint64_t samples; /* of the run, for the noise and jitter of its samples */
} simulate_parts;

/* gough_simulation_check() for a motion */
gough_status simulate_check(const gough_motion *motion, const gough_simulation *simulation,
                            gough_error *error);

/* whether a machine moves under drive forces, by the method */
gough_status simulate_check_legs(const gough_machine *machine, const gough_control *control,
                                 const gough_simulation *simulation, gough_error *error);

/* gough_control_check(), and whether the times of a sampled controller go with the steps */
gough_status simulate_check_control(const gough_control *control,
                                    const gough_simulation *simulation, gough_error *error);

struct simulate_table {
    gough_status (*forces)(const simulate_parts *parts, const gough_simulation *options,
                           gough_sink sink, void *context, gough_crossing_sink crossings,
                           void *crossings_context, gough_end *end);
    gough_status (*simulate)(const simulate_parts *parts, const gough_simulation *options,
                             gough_sink sink, void *context, gough_end *end);
};

extern const struct simulate_table simulate_double, simulate_quad;
#if defined(__x86_64__)
extern const struct simulate_table simulate_double_4, simulate_double_8;
#endif

/* the table for a precision and this processor; all of one precision give the same bits */
const struct simulate_table *simulate_table_of(gough_precision precision);

#endif
