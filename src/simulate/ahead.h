/* Stages of the program made ready before a step asks for them. They depend on time alone, and a stepper knows its times
 * beforehand: so several are evaluated side by side, a time in each lane, to the same bits as one by one. */
#ifndef GOUGH_SIMULATE_AHEAD_H
#define GOUGH_SIMULATE_AHEAD_H

#include "gough/model.h"

/* times of a block; bytes for the lanes' own memory */
enum { AHEAD_TIMES = 16, AHEAD_ROOM = 32 * 1024 };

typedef struct {
    int count, cursor;
    double time[AHEAD_TIMES];
    const char *fault[AHEAD_TIMES]; /* a formula that is not finite there, or NULL */
    /* F^p with the legs' shares of a vertical force, l^p, l̇^p where forces need rates, determinant and pivots of the
     * equations */
    double force[GOUGH_LEGS][AHEAD_TIMES], length[GOUGH_LEGS][AHEAD_TIMES],
        rate[GOUGH_LEGS][AHEAD_TIMES];
    double determinant[AHEAD_TIMES], pivot_ratio[AHEAD_TIMES];
} ahead_block;

struct ahead_width {
    int lanes;
    void (*begin)(void *room, const gough_motion *motion, const gough_machine *machine,
                  const gough_control *control, const gough_disturbance *disturbance);
    /* fills the block at its times, or at the first of them only: those beyond have to be evaluated one by one */
    void (*fill)(void *room, ahead_block *block);
};

extern const struct ahead_width ahead_width_2, ahead_width_4, ahead_width_8;

/* lanes of the widest registers of this processor: 2, 4 or 8 */
int ahead_lanes(void);
const struct ahead_width *ahead_widest(void);

#endif
