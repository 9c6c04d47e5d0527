/* The kernel texts over double. */
#define NUMBER_DOUBLE
#include "kernel/lanes.h"

void evaluate_scalar(const gough_machine *machine, int count, double (*state)[24],
                     double (*acceleration)[12], double (*out)[KERNEL_RESULTS]);
void evaluate_scalar(const gough_machine *machine, int count, double (*state)[24],
                     double (*acceleration)[12], double (*out)[KERNEL_RESULTS]) {
    evaluate(machine, count, state, acceleration, out);
}
