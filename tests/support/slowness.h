/* How much slower than a quiet machine this one is taken to be: every limit of time in a test is multiplied by it. */
#ifndef TESTS_SUPPORT_SLOWNESS_H
#define TESTS_SUPPORT_SLOWNESS_H

#include <stdlib.h>

static inline double slowness(void) {
    const char *set = getenv("GOUGH_TEST_SLOWNESS");
    const double value = set ? atof(set) : 0;
    return value >= 1 ? value : 4;
}

#endif
