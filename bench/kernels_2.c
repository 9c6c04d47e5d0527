/* Kernels of 2 runs side by side. */
#define NUMBER_LANES 2
#include "bench/kernels_text.h"

const kernel_width kernel_width_2 = KERNEL_WIDTH;
