/* The kernel texts over vectors of 2 doubles. */
#define NUMBER_LANES 2
#include "kernel/lanes.h"

void evaluate_lanes_2(const gough_machine *machine, int count, double (*state)[24],
                      double (*acceleration)[12], double (*out)[KERNEL_RESULTS]);
void evaluate_lanes_2(const gough_machine *machine, int count, double (*state)[24],
                      double (*acceleration)[12], double (*out)[KERNEL_RESULTS]) {
    evaluate(machine, count, state, acceleration, out);
}

void choose_lanes_2(int count, const double *a, const double *b, double (*out)[4]);
void choose_lanes_2(int count, const double *a, const double *b, double (*out)[4]) {
    choose(count, a, b, out);
}
