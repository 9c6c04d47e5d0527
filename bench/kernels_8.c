/* Kernels of 8 runs side by side. */
#define NUMBER_LANES 8
#include "bench/kernels_text.h"

const kernel_width kernel_width_8 = KERNEL_WIDTH;
