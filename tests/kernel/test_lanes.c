/* The kernel texts as they stand, over vectors of 2, 4 and 8 doubles: the same bits as one by one.
 * Sanitized: campaign: all other programs evaluate the same texts under sanitizers. */
#include <stdio.h>

#include "support/kernel.h"
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
    evaluate_lanes_4(&machine, POSES, state, acceleration, many[1]);
    evaluate_lanes_8(&machine, POSES, state, acceleration, many[2]);
    for (int p = 0; p < POSES; p++) {
        for (int i = 0; i < KERNEL_RESULTS; i++) ck_assert(isfinite(one[p][i]));
        ck_assert(one[p][19] < 1e-15);
    }
    for (int w = 0; w < 3; w++) ck_assert(memcmp(one, many[w], sizeof one) == 0);
}
END_TEST

int main(void) { return SUITE_RUN("lanes", 30, lanes_give_the_bits_of_one); }
