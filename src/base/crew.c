/* See crew.h. */
#define _GNU_SOURCE
#include "base/crew.h"

#include <sched.h>

#include "base/assert.h"

int crew_threads(int wanted) {
    int threads = wanted;

    if (threads <= 0) {
        cpu_set_t set;
        if (sched_getaffinity(0, sizeof set, &set) != 0)
            return 1; /* on machines of more processors than the set has room for */
        threads = CPU_COUNT(&set);
    }
    return threads > CREW_MOST ? CREW_MOST : threads;
}

int crew_start(crew *c, void *members, size_t size, int count, void *(*work)(void *member)) {
    char *member = members;
    pthread_attr_t attributes;
    size_t stack;

    assert_true(count >= 0 && count <= CREW_MOST);
    c->count = 0;
    if (pthread_attr_init(&attributes) != 0) return 0;
    /* a caller who has chosen a larger stack for all threads keeps it */
    pthread_attr_getstacksize(&attributes, &stack);
    if (stack < CREW_STACK) pthread_attr_setstacksize(&attributes, CREW_STACK);
    while (c->count < count && pthread_create(&c->thread[c->count], &attributes, work,
                                              member + (size_t)c->count * size) == 0) {
        c->count++;
    }
    pthread_attr_destroy(&attributes);
    return c->count;
}

void crew_join(crew *c) {
    for (int i = 0; i < c->count; i++) pthread_join(c->thread[i], NULL);
    c->count = 0;
}

void crew_work(void *members, size_t size, int count, void *(*work)(void *member)) {
    crew others;

    assert_true(count >= 1);
    crew_start(&others, (char *)members + size, size, count - 1, work);
    work(members); /* alone if need be */
    crew_join(&others);
}
