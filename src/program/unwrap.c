/* Angles of recorded motion made continuous, (motion-7). A rotation has many triples of angles: whole turns may be
 * added to each, and (roll + 180°, 180° − pitch, yaw + 180°) is the same rotation as (roll, pitch, yaw). Instruments write
 * one of them, within bounds; of all, each row takes the one nearest to that of the row before. */
#include <math.h>

#include "gough/model.h"
#include "gough/sizes.h"

/* The angle plus the whole turns that bring it nearest to `to`. */
static double nearest(double angle, double to, double turn) {
    return angle - turn * rint((angle - to) / turn);
}

/* Both families of triples, each as near to `before` as whole turns bring it. */
static void candidates(const double given[3], const double before[3], double half,
                       double triple[2][3]) {
    const double other[3] = {given[0] + half, half - given[1], given[2] + half};
    for (int a = 0; a < 3; a++) {
        triple[0][a] = nearest(given[a], before[a], 2 * half);
        triple[1][a] = nearest(other[a], before[a], 2 * half);
    }
}

static double squared_distance(const double a[3], const double b[3]) {
    double sum = 0;
    for (int i = 0; i < 3; i++) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum;
}

gough_status gough_samples_make_continuous(size_t count, double *value, double half_turn,
                                           gough_unwrapping *done, size_t size) {
    if (size != sizeof *done) return gough_size_refuse(done, size);
    *done = (gough_unwrapping){.first = 0};
    double turns[3] = {0, 0, 0}; /* added so far to each angle of the row before */
    int family = 0;
    for (size_t i = 1; i < count; i++) {
        double *angle = value + i * GOUGH_COMPONENTS + GOUGH_ROLL;
        const double *before = angle - GOUGH_COMPONENTS;
        double triple[2][3];
        candidates(angle, before, half_turn, triple);
        const double *same = triple[family], *other = triple[1 - family];
        const bool flips = squared_distance(other, before) < 0.999 * squared_distance(same, before);
        bool jumps = flips;
        if (flips) {
            family = 1 - family;
            done->flips++;
        }
        for (int a = 0; a < 3; a++) {
            const double bare = family == 0 ? angle[a]
                                : a == 1    ? half_turn - angle[a]
                                            : angle[a] + half_turn;
            const double added = rint((triple[family][a] - bare) / (2 * half_turn));
            if (!flips && fabs(added - turns[a]) > 0.5) done->turns[a]++, jumps = true;
            turns[a] = added;
            angle[a] = triple[family][a];
        }
        if (jumps && !done->first) done->first = i;
    }
    return GOUGH_OK;
}
