/* What limits say together about a box. A margin is at least 0 where its limit is kept; its bounds over the box decide. */
#ifndef GOUGH_WORKSPACE_JUDGE_H
#define GOUGH_WORKSPACE_JUDGE_H

#include <math.h>

#include "gough/workspace.h"

/* A limit counts as kept where it is exceeded by less than this part of its size: a home pose whose legs are fully
 * retracted would otherwise be undecided, by rounding alone. */
static const double LIMIT_SLACK = 1e-12;

typedef struct judge {
    gough_verdict verdict;
    gough_binding
        binding;  /* the most exceeded limit, or of those that are not certain the most doubtful */
    double worst; /* its margin in parts of the limit's size */
    double in,
        out; /* of the volume of a box of positions, which part is certainly inside, and which outside */
} judge;

static inline judge judge_begin(void) {
    return (judge){GOUGH_INSIDE, {GOUGH_BIND_NONE, 0, 0}, INFINITY, 1, 0};
}

/* the part of the box of positions in which a margin is certainly not kept, and that in which it is not certain to be kept */
static inline void judge_parts(judge *j, double out, double lost) {
    j->out = fmax(j->out, out), j->in -= lost;
}

/* a margin between `least` and `most` over the box; `size` makes margins of different limits comparable */
static inline gough_verdict judge_margin(judge *j, double least, double most, double size,
                                         gough_bind bind, int which) {
    const double slack = LIMIT_SLACK * size;
    const gough_verdict verdict = most < -slack     ? GOUGH_OUTSIDE
                                  : least >= -slack ? GOUGH_INSIDE
                                                    : GOUGH_UNDECIDED;
    const double part = (verdict == GOUGH_OUTSIDE ? most : least) / size;
    const bool graver = verdict == GOUGH_OUTSIDE && j->verdict != GOUGH_OUTSIDE;

    if (verdict == GOUGH_OUTSIDE) judge_parts(j, 1, 1);
    if (j->verdict == GOUGH_OUTSIDE && verdict != GOUGH_OUTSIDE) return verdict;
    if (verdict == GOUGH_OUTSIDE || j->verdict == GOUGH_INSIDE) j->verdict = verdict;
    if (!graver && part >= j->worst) return verdict;
    j->worst = part;
    j->binding = (gough_binding){bind, which, 0};
    return verdict;
}

#endif
