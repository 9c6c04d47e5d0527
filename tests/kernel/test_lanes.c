/* The kernel texts as they stand, over vectors of 2, 4 and 8 doubles: the same bits as one by one.
 * Sanitized: campaign: all other programs evaluate the same texts under sanitizers. */
#include <stdio.h>

#include "support/kernel.h"
#include "support/lanes.h"
#include "support/machines.h"
#include "support/suite.h"

void evaluate_scalar(const gough_machine *machine, int count, double (*state)[24],
                     double (*acceleration)[12], double (*out)[KERNEL_RESULTS]);
void evaluate_lanes_2(const gough_machine *machine, int count, double (*state)[24],
                      double (*acceleration)[12], double (*out)[KERNEL_RESULTS]);
void evaluate_lanes_4(const gough_machine *machine, int count, double (*state)[24],
                      double (*acceleration)[12], double (*out)[KERNEL_RESULTS]);
void evaluate_lanes_8(const gough_machine *machine, int count, double (*state)[24],
                      double (*acceleration)[12], double (*out)[KERNEL_RESULTS]);

void choose_scalar(int count, const double *a, const double *b, double (*out)[4]);
void choose_lanes_2(int count, const double *a, const double *b, double (*out)[4]);
void choose_lanes_4(int count, const double *a, const double *b, double (*out)[4]);
void choose_lanes_8(int count, const double *a, const double *b, double (*out)[4]);

enum { POSES = 256 };

START_TEST(lanes_give_the_bits_of_one) {
    static double state[POSES][24], acceleration[POSES][12];
    static double one[POSES][KERNEL_RESULTS], many[3][POSES][KERNEL_RESULTS];
    gough_machine machine;
    dice d = {11};

    skew_machine(&machine);
    for (int p = 0; p < POSES; p++) {
        for (int i = 0; i < 24; i++) state[p][i] = dice_between(&d, -0.03, 0.03);
        state[p][2] += 1.3;
        state[p][3] += 1;
        state[p][7] += 1;
        state[p][11] += 1;
        for (int i = 0; i < 12; i++) acceleration[p][i] = dice_between(&d, -1, 1);
    }
    evaluate_scalar(&machine, POSES, state, acceleration, one);
    evaluate_lanes_2(&machine, POSES, state, acceleration, many[0]);
    if (has_lanes(4)) evaluate_lanes_4(&machine, POSES, state, acceleration, many[1]);
    if (has_lanes(8)) evaluate_lanes_8(&machine, POSES, state, acceleration, many[2]);
    for (int p = 0; p < POSES; p++) {
        for (int i = 0; i < KERNEL_RESULTS; i++) ck_assert(isfinite(one[p][i]));
        ck_assert(one[p][19] < 1e-15);
    }
    for (int w = 0; w < 3; w++) {
        ck_assert(!has_lanes(2 << w) || memcmp(one, many[w], sizeof one) == 0);
    }
}
END_TEST

/* The instructions of lanes for the larger and the smaller number know the order of their operands: it decides between zeros of
 * either sign and where one is not a number. */
START_TEST(lanes_choose_as_comparisons_of_doubles_do) {
    enum { VALUES = 8, PAIRS = VALUES * VALUES };
    typedef void chooser(int count, const double *a, const double *b, double(*out)[4]);
    static const double value[VALUES] = {-INFINITY, -1, -0.0, 0.0, 1e-310, 1, INFINITY, NAN};
    static chooser *const chooses[] = {choose_scalar, choose_lanes_2, choose_lanes_4,
                                       choose_lanes_8};
    static double a[PAIRS], b[PAIRS], out[PAIRS][4];

    for (int i = 0; i < PAIRS; i++) a[i] = value[i / VALUES], b[i] = value[i * 5 % VALUES];
    for (int w = 0; w < 4; w++) {
        const int width = 1 << w;
        if (!has_lanes(width)) continue;
        chooses[w](PAIRS, a, b, out);
        for (int i = 0; i < PAIRS; i++) {
            const double larger = b[i] > a[i] ? b[i] : a[i];
            const double smaller = a[i] > b[i] ? b[i] : a[i];
            int any = 0;
            for (int k = i / width * width; k < i / width * width + width; k++) any |= a[k] > b[k];
            ck_assert_msg(memcmp(&out[i][0], &larger, sizeof larger) == 0, "%g and %g in %d", a[i],
                          b[i], width);
            ck_assert_msg(memcmp(&out[i][1], &smaller, sizeof smaller) == 0, "%g and %g in %d",
                          a[i], b[i], width);
            ck_assert(out[i][2] == (a[i] > b[i] ? 1 : 2) && out[i][3] == any);
        }
    }
}
END_TEST

int main(void) {
    return SUITE_RUN("lanes", 30, lanes_give_the_bits_of_one,
                     lanes_choose_as_comparisons_of_doubles_do);
}
