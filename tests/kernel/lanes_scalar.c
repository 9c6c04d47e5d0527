/* The kernel texts over double. */
#define NUMBER_DOUBLE
#include "kernel/lanes.h"

void evaluate_scalar(const gough_machine *machine, int count, double (*state)[24],
                     double (*acceleration)[12], double (*out)[KERNEL_RESULTS]);
void evaluate_scalar(const gough_machine *machine, int count, double (*state)[24],
                     double (*acceleration)[12], double (*out)[KERNEL_RESULTS]) {
    evaluate(machine, count, state, acceleration, out);
}

void choose_scalar(int count, const double *a, const double *b, double (*out)[4]);
void choose_scalar(int count, const double *a, const double *b, double (*out)[4]) {
    choose(count, a, b, out);
}
