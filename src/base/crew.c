/* See crew.h. */
#define _GNU_SOURCE
#include "base/crew.h"

#include <pthread.h>
#include <sched.h>

#include "base/assert.h"

int crew_threads(int wanted) {
    int threads = wanted;

    if (threads <= 0) {
        cpu_set_t set;
        threads = sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
    }
    return threads < 1 ? 1 : threads > CREW_MOST ? CREW_MOST : threads;
}

void crew_work(void *members, size_t size, int count, void *(*work)(void *member)) {
    pthread_t thread[CREW_MOST];
    char *member = members;
    int started = 1;

    assert_true(count >= 1 && count <= CREW_MOST);
    while (started < count &&
           pthread_create(&thread[started], NULL, work, member + (size_t)started * size) == 0) {
        started++;
    }
    work(members); /* alone if need be */
    for (int i = 1; i < started; i++) pthread_join(thread[i], NULL);
}
