/* A crew of threads that work on one thing together, the caller's own among them. */
#ifndef GOUGH_BASE_CREW_H
#define GOUGH_BASE_CREW_H

#include <pthread.h>
#include <stddef.h>

/* CREW_STACK: the least bytes of a member's stack, glibc's usual size, with which everything is tested. musl's usual stack has
 * 128 KiB, less than a batch needs. A page of a stack takes memory only once it is used. */
enum { CREW_MOST = 256, CREW_STACK = 8 << 20 };

/* Threads for a wish: 0 or less means one for each processor that the process may use; at most CREW_MOST */
int crew_threads(int wanted);

typedef struct crew {
    pthread_t thread[CREW_MOST];
    int count;
} crew;

/* Starts work(member) for `count` members, an array of elements of `size` bytes, each in a thread of its own. Returns how many were
 * started, the first ones: the others do not work, so that the work must be shared out while it is done. crew_join() waits for
 * their end; crew and members must live until then. */
int crew_start(crew *c, void *members, size_t size, int count, void *(*work)(void *member));
void crew_join(crew *c);

/* Calls work(member) for each of `count` members, an array as above, each in a thread of its own and the first in the caller's.
 * Returns when all have finished. */
void crew_work(void *members, size_t size, int count, void *(*work)(void *member));

#endif
