/* A crew of threads that work on one thing together, the caller's own among them. */
#ifndef GOUGH_BASE_CREW_H
#define GOUGH_BASE_CREW_H

#include <stddef.h>

enum { CREW_MOST = 256 };

/* Threads for a wish: 0 or less means one for each processor that the process may use; at most CREW_MOST */
int crew_threads(int wanted);

/* Calls work(member) for each of `count` members, an array of elements of `size` bytes, each in a thread of its own and the first
 * in the caller's. Threads that cannot be started are left out: their members do not work, so that the work must be shared out
 * while it is done. Returns when all have finished. */
void crew_work(void *members, size_t size, int count, void *(*work)(void *member));

#endif
