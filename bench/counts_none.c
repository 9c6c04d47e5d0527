/* In place of counts.cc where there is no C++ compiler. */
#include "bench/kernels.h"

int kernels_count(const reference *ref, kernel_counts *counts) {
    (void)ref;
    *counts = (kernel_counts){{0}, {0}, {0}, {0}};
    return 0;
}
