/* The certified way of a pose over vectors of 2, 4 and 8 doubles: the same bits as one by one, for ways that are certified in few
 * steps or many, and for those that are lost.
 * Sanitized: campaign: the other tests of poses follow the same text under sanitizers. */
#include <stdio.h>

#include "pose/pose_machines.h"
#include "support/lanes.h"
#include "support/suite.h"
#include "support/walks.h"

void walk_scalar(int count, const double (*in)[WALK_NUMBERS], double (*out)[WALK_RESULTS]);
void walk_lanes_2(int count, const double (*in)[WALK_NUMBERS], double (*out)[WALK_RESULTS]);
void walk_lanes_4(int count, const double (*in)[WALK_NUMBERS], double (*out)[WALK_RESULTS]);
void walk_lanes_8(int count, const double (*in)[WALK_NUMBERS], double (*out)[WALK_RESULTS]);

enum { WAYS = 512 };

/* a way from home to a random pose, lengths in units of 1 */
static void random_way(dice *d, int n, double in[WALK_NUMBERS]) {
    gough_machine machine;
    double length[GOUGH_LEGS];
    int at = 0;

    family_machine((family)(n % FAMILIES), d, &machine);
    const double size = n % 3 == 0 ? 0.02 : 0.4;
    const gough_state there = random_pose(&machine, size, 2 * size, d);
    lengths_by_vectors(&machine, &there, length);
    for (int v = 0; v < GOUGH_LEGS; v++) {
        for (int k = 0; k < 3; k++) in[at++] = machine.platform.base[v][k];
        for (int k = 0; k < 3; k++) in[at++] = machine.platform.top[v][k];
        in[at++] = length[v] * length[v];
        in[at++] = n % 5 == 0 ? 1e-3 : 0;
    }
    /* home: e = (1, 0, 0, 0), g = (0, t) */
    const double x[8] = {1, 0, 0, 0, 0, 0, 0, machine.platform.height};
    memcpy(in + at, x, sizeof x);
}

START_TEST(lanes_follow_as_one_does) {
    static double in[WAYS][WALK_NUMBERS], one[WAYS][WALK_RESULTS], many[3][WAYS][WALK_RESULTS];
    dice d = {51};
    int lost = 0, single = 0;

    for (int n = 0; n < WAYS; n++) random_way(&d, n, in[n]);
    const double(*from)[WALK_NUMBERS] = (const double(*)[WALK_NUMBERS])in;
    walk_scalar(WAYS, from, one);
    walk_lanes_2(WAYS, from, many[0]);
#if defined(__x86_64__)
    if (has_lanes(4)) walk_lanes_4(WAYS, from, many[1]);
    if (has_lanes(8)) walk_lanes_8(WAYS, from, many[2]);
    for (int w = 0; w < 3; w++)
        ck_assert(!has_lanes(2 << w) || memcmp(one, many[w], sizeof one) == 0);
#else
    ck_assert(memcmp(one, many[0], sizeof one) == 0);
#endif
    for (int n = 0; n < WAYS; n++) {
        lost += one[n][9] < 1;
        single += one[n][8] > 0 && one[n][8] < 2;
    }
    ck_assert_msg(lost > 5 && lost < WAYS / 2 && single > WAYS / 10, "%d lost, %d in one step",
                  lost, single);
}
END_TEST

int main(void) { return SUITE_RUN("walk_lanes", 60, lanes_follow_as_one_does); }
