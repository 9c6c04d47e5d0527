/* Assertions: what only a bug can make false, in the library or in its caller's program: sizes of rooms, slices, alignment. Input
 * that a user may give is no bug; it is answered by a status. They stay in every build, so they are for places that are passed
 * once in a run or a block, not for the texts of lanes. */
#ifndef GOUGH_BASE_ASSERT_H
#define GOUGH_BASE_ASSERT_H

#include <stdlib.h>

#include "gough/status.h"

/* the name without folders: binaries do not depend on where they were built */
#if defined(__FILE_NAME__)
#define ASSERT_FILE __FILE_NAME__
#else
#define ASSERT_FILE __FILE__
#endif

/* The page has no room for sentences and nobody to read them. */
#if defined(__wasm__)
#define assert_true(condition) ((condition) ? (void)0 : __builtin_trap())
#else
#define assert_true(condition)                                                                     \
    ((condition) ? (void)0 : (gough_assertion_failed(ASSERT_FILE, __LINE__, #condition), abort()))
#endif

#endif
