/* What sizes the legs in an outcome, against the summary of a run. */
#ifndef TESTS_SUPPORT_SIZING_H
#define TESTS_SUPPORT_SIZING_H

#include "gough/batch.h"
#include "support/suite.h"

/* what sizes the legs against the summary of the run alone, which has the same looks */
static inline void check_sizing(const gough_outcome *out, const gough_summary *s) {
    double wanted[GOUGH_SIZINGS] = {[GOUGH_SIZING_LENGTH_LEAST] = INFINITY}, largest = 0;

    for (int v = 0; v < 6; v++) {
        const gough_leg_summary *leg = &s->leg[v];
        const double pairs[][2] = {{GOUGH_SIZING_LENGTH_GREATEST, leg->length_max},
                                   {GOUGH_SIZING_SWING_BASE, leg->swing_base},
                                   {GOUGH_SIZING_SWING_TOP, leg->swing_top},
                                   {GOUGH_SIZING_RMS_FORCE, leg->rms_force},
                                   {GOUGH_SIZING_TOP_LOAD, leg->top_load},
                                   {GOUGH_SIZING_BASE_LOAD, leg->base_load},
                                   {GOUGH_SIZING_SIDE_LOAD, leg->side_load}};
        for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i++) {
            double *most = &wanted[(int)pairs[i][0]];
            *most = fmax(*most, pairs[i][1]);
        }
        wanted[GOUGH_SIZING_LENGTH_LEAST] =
            fmin(wanted[GOUGH_SIZING_LENGTH_LEAST], leg->length_min);
        wanted[GOUGH_SIZING_FRICTION_LOSS] += leg->friction_loss;
        wanted[GOUGH_SIZING_RETURNED_ENERGY] += leg->returned_energy;
        largest = fmax(largest, fmax(fabs(leg->power_min), fabs(leg->power_max)));
    }
    for (int i = 0; i < GOUGH_SIZING_HOLDS_FROM; i++) {
        const bool energy = i == GOUGH_SIZING_FRICTION_LOSS || i == GOUGH_SIZING_RETURNED_ENERGY;
        const bool swing = i == GOUGH_SIZING_SWING_BASE || i == GOUGH_SIZING_SWING_TOP;
        const double size = energy ? largest * s->last_time : fabs(wanted[i]);
        /* cubics through angles and through chords differ by the fourth order of the steps */
        ck_assert_msg(fabs(out->sizing[i] - wanted[i]) <= (swing ? 2e-6 : 1e-9) * size,
                      "sizing %d: %.17g, alone %.17g", i, out->sizing[i], wanted[i]);
    }
}

#endif
