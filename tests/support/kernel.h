/* What the kernel tests evaluate: accelerations, leg forces, determinant, violation and condition of a pose. */
#ifndef TESTS_SUPPORT_KERNEL_H
#define TESTS_SUPPORT_KERNEL_H

enum { KERNEL_RESULTS = 21 };

#endif
