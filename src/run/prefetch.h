/* Stages of the program made ready before a step asks for them. They depend on time alone, and a stepper knows its times
 * beforehand: so several are evaluated side by side, a time in each lane, to the same bits as one by one. */
#ifndef GOUGH_RUN_PREFETCH_H
#define GOUGH_RUN_PREFETCH_H

#include "gough/model.h"
#include "plant/layout.h"

/* times of a block; bytes for the lanes' own memory */
enum { PREFETCH_TIMES = 16, PREFETCH_ROOM = 48 * 1024 };

typedef struct {
    int count, cursor;
    double time[PREFETCH_TIMES];
    const char *fault[PREFETCH_TIMES]; /* a formula that is not finite there, or NULL */
    /* F^p with the legs' shares of a vertical force, l^p, l̇^p where forces need rates, determinant and pivots of the
     * equations */
    double force[GOUGH_LEGS][PREFETCH_TIMES], length[GOUGH_LEGS][PREFETCH_TIMES],
        rate[GOUGH_LEGS][PREFETCH_TIMES];
    double determinant[PREFETCH_TIMES], pivot_ratio[PREFETCH_TIMES];
    int posed; /* asked for: the program's (ρ, i, j, k) too */
    double pose[COORDINATES][PREFETCH_TIMES];
} prefetch_block;

struct prefetch_program; /* of run/prefetch_program.h */

struct prefetch_width {
    int lanes;
    void (*begin)(void *room, const gough_motion *motion, const gough_machine *machine,
                  const gough_control *control, const gough_disturbance *disturbance);
    /* the program at the times of a block, for packs of this many lanes or fewer */
    void (*formulas)(void *room, prefetch_block *block, struct prefetch_program *program);
    /* Fills the block from its time number `first` on, a pack after the other, while more than `leave` times are left; returns
     * the number of the first that is not filled. Where a pack cannot be filled, the block ends before it: what lies beyond has
     * to be evaluated one by one. */
    int (*fill)(void *room, prefetch_block *block, const struct prefetch_program *program,
                int first, int leave);
};

extern const struct prefetch_width prefetch_width_2, prefetch_width_4, prefetch_width_8;

/* lanes of the widest registers of this processor: 2, 4 or 8 */
int prefetch_lanes(void);
const struct prefetch_width *prefetch_widest(void);
/* what takes half as many times or fewer sooner than the widest, or NULL */
const struct prefetch_width *prefetch_narrow(void);

#endif
