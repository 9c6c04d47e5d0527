/* Numbers of one way of a pose outside the kernels: tests/pose/walk_lanes.h. */
#ifndef TESTS_SUPPORT_WALKS_H
#define TESTS_SUPPORT_WALKS_H

/* of each leg two joints, the square of its length and its width, then x; x and five numbers of the way; steps at most */
enum { WALK_NUMBERS = 6 * 8 + 8, WALK_RESULTS = 8 + 5, WALK_STEPS = 60 };

#endif
