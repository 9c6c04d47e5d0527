/* Intervals of stiffness in which a mode grows: found between sampled stiffnesses by what changed from one to the next,
 * refined at their edges. Theory: docs/theory/floquet.md. */
#ifndef GOUGH_MAP_SCAN_H
#define GOUGH_MAP_SCAN_H

#include "gough/map.h"
#include "map/sample.h"

/* an interval that is still open above */
typedef struct {
    double from;
    grower last;          /* as it was seen last … */
    double at;            /* … and where */
    double best;          /* stiffness at which it was seen to grow most … */
    double before, after; /* … between these */
    grower most;
    bool seen, waiting; /* in the range at all; `after` is still to come */
    bool from_zero;     /* open at the first sample */
    int opened;         /* kind of the multiplier there, or just above its lower edge */
} track;

typedef struct scan {
    /* the loop at any stiffness; returns nonzero where the work is to stop */
    int (*look)(void *context, double stiffness, sample *s);
    /* an interval found, its growth refined */
    void (*found)(void *context, const gough_interval *interval);
    /* a place where multipliers met and stayed on the circle */
    void (*met)(void *context, double stiffness);
    void *context;

    double low, high;  /* range in which growth is of interest */
    double resolution; /* two multipliers that meet and part within it, met only */
    double edge;       /* to which edges are found */
    double
        coarse; /* to which they are where the motion itself ends, and there are no values beyond */
    double period; /* T, 0 at rest */
    int sweeps;    /* of the search for the greatest growth */
    bool
        alone; /* multipliers turn as fast as the loop shakes: an interval is told by how it begins, not divided where its
                 * multiplier turns through the real axis */
    double threshold; /* then: below it nothing holds */

    track active[GOUGH_LINEAR];
    int actives;
    int stopped;
} scan;

/* The first sample; then each next one, by rising stiffness; then the end of the range. */
void scan_begin(scan *s, const sample *first);
void scan_to(scan *s, const sample *before, const sample *next);
void scan_end(scan *s, const sample *last);

#endif
