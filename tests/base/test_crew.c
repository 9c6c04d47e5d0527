/* A crew: every member works once, each on what is its own, however many there are. */
#define _GNU_SOURCE
#include <pthread.h>
#include <stdatomic.h>
#include <sys/resource.h>
#include <unistd.h>

#include "base/crew.h"
#include "gough/batch.h"
#include "support/suite.h"

typedef struct {
    atomic_int *sum;
    int worked;
} member;

static void *work(void *context) {
    member *m = context;
    m->worked++;
    atomic_fetch_add(m->sum, 1);
    return NULL;
}

START_TEST(each_member_works_once) {
    for (int count = 1; count <= 9; count += 4) {
        member members[9] = {{NULL, 0}};
        atomic_int sum;
        atomic_init(&sum, 0);
        for (int i = 0; i < count; i++) members[i].sum = &sum;
        crew_work(members, sizeof members[0], count, work);
        ck_assert_int_eq(atomic_load(&sum), count);
        for (int i = 0; i < 9; i++) ck_assert_int_eq(members[i].worked, i < count);
    }
}
END_TEST

/* Stacks of 2^46 bytes, which no machine has. A C library that refuses to take such a size for all threads, as musl does, finds
 * no room in its address space for stacks of any size. */
START_TEST(without_threads_the_caller_works_alone) {
    member members[4] = {{NULL, 0}};
    pthread_attr_t attributes;
    atomic_int sum;
    size_t usual, taken;
    struct rlimit space;
    atomic_init(&sum, 0);
    for (int i = 0; i < 4; i++) members[i].sum = &sum;
    ck_assert_int_eq(pthread_getattr_default_np(&attributes), 0);
    pthread_attr_getstacksize(&attributes, &usual);
    pthread_attr_setstacksize(&attributes, (size_t)1 << 46);
    ck_assert_int_eq(pthread_setattr_default_np(&attributes), 0);
    ck_assert_int_eq(pthread_getattr_default_np(&attributes), 0);
    pthread_attr_getstacksize(&attributes, &taken);
    ck_assert_int_eq(getrlimit(RLIMIT_AS, &space), 0);
    const struct rlimit narrow = {4096, space.rlim_max};
    if (taken != (size_t)1 << 46) ck_assert_int_eq(setrlimit(RLIMIT_AS, &narrow), 0);
    crew_work(members, sizeof members[0], 4, work);
    ck_assert_int_eq(setrlimit(RLIMIT_AS, &space), 0);
    pthread_attr_setstacksize(&attributes, usual);
    ck_assert_int_eq(pthread_setattr_default_np(&attributes), 0);
    pthread_attr_destroy(&attributes);
    for (int i = 0; i < 4; i++) ck_assert_int_eq(members[i].worked, i == 0);
}
END_TEST

/* more than the 128 KiB of the usual stack of musl, with which batches crashed */
static void *fill_a_megabyte(void *context) {
    volatile char stack[1 << 20];
    member *m = context;
    for (size_t i = 0; i < sizeof stack; i += 1024) stack[i] = 1;
    m->worked += stack[0];
    return NULL;
}

START_TEST(members_have_a_large_stack_whatever_is_usual) {
    member members[4] = {{NULL, 0}};
    pthread_attr_t attributes;
    size_t usual;
    ck_assert_int_eq(pthread_getattr_default_np(&attributes), 0);
    pthread_attr_getstacksize(&attributes, &usual);
    pthread_attr_setstacksize(&attributes, (size_t)1 << 17);
    ck_assert_int_eq(pthread_setattr_default_np(&attributes), 0);
    crew_work(members, sizeof members[0], 4, fill_a_megabyte);
    pthread_attr_setstacksize(&attributes, usual);
    ck_assert_int_eq(pthread_setattr_default_np(&attributes), 0);
    pthread_attr_destroy(&attributes);
    for (int i = 0; i < 4; i++) ck_assert_int_eq(members[i].worked, 1);
}
END_TEST

START_TEST(a_wish_has_bounds) {
    ck_assert_int_eq(crew_threads(3), 3);
    ck_assert_int_eq(crew_threads(1000000), CREW_MOST);
    ck_assert_int_ge(crew_threads(0), 1);
    ck_assert_int_le(crew_threads(0), (int)sysconf(_SC_NPROCESSORS_CONF));
    ck_assert_int_eq(crew_threads(-5), crew_threads(0));
    /* what batches say of it */
    for (int wish = -1; wish < 300; wish++)
        ck_assert_int_eq(gough_batch_threads(wish), crew_threads(wish));
}
END_TEST

int main(void) {
    return SUITE_RUN("base/crew", 60, each_member_works_once,
                     without_threads_the_caller_works_alone,
                     members_have_a_large_stack_whatever_is_usual, a_wish_has_bounds);
}
