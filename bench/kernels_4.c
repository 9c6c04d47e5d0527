/* Kernels of 4 runs side by side. */
#define NUMBER_LANES 4
#include "bench/kernels_text.h"

const kernel_width kernel_width_4 = KERNEL_WIDTH;
