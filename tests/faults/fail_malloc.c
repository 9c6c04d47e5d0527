/* Preloaded into the command: counts its allocations and lets one fail. FAIL_SITES=FILE writes a line "N" for the first
 * allocation of each call site (the last return addresses, FAIL_DEPTH of them, hashed); FAIL_AT=N lets the N-th return NULL,
 * once. FAIL_LEAST=BYTES counts only allocations of at least that many bytes. Children that the command forks count on; programs
 * that it executes are left alone. */
#define _GNU_SOURCE
#include <errno.h>
#include <execinfo.h>
#include <fcntl.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *old, size_t size);
void *__libc_memalign(size_t alignment, size_t size);

enum { MOST_DEPTH = 16, OWN = 3, PLACES = 1 << 16 }; /* own: record, this malloc, the command's */

typedef struct shared {
    atomic_ulong count;
    atomic_ulong site[PLACES]; /* hashes met, open addressing */
} shared;

static shared *all;
static unsigned long fail_at;
static size_t least;
static int list = -1, depth = 6;
static _Thread_local int inside;

__attribute__((constructor)) static void begin(void) {
    const char *at = getenv("FAIL_AT"), *sites = getenv("FAIL_SITES"), *deep = getenv("FAIL_DEPTH"),
               *large = getenv("FAIL_LEAST");
    void *frame[2];
    if (strcmp(program_invocation_short_name, "gough") != 0) return;
    inside = 1;
    (void)backtrace(frame, 2); /* loads what it needs */
    all = mmap(NULL, sizeof *all, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (sites) list = open(sites, O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0600);
    if (list >= 0 && list < 20) { /* out of the way of the command's own */
        const int high = fcntl(list, F_DUPFD_CLOEXEC, 200);
        close(list);
        list = high;
    }
    if (deep && atoi(deep) > 0 && atoi(deep) <= MOST_DEPTH) depth = atoi(deep);
    fail_at = at ? strtoul(at, NULL, 10) : 0;
    least = large ? strtoul(large, NULL, 10) : 0;
    inside = 0;
}

static int is_new(unsigned long hash) {
    for (unsigned long i = hash % PLACES;; i = (i + 1) % PLACES) {
        unsigned long there = atomic_load(&all->site[i]);
        if (there == hash) return 0;
        if (there == 0 && atomic_compare_exchange_strong(&all->site[i], &there, hash)) return 1;
        if (there == hash) return 0;
    }
}

static void record(unsigned long number) {
    void *frame[MOST_DEPTH + OWN];
    char line[32];
    const int found = backtrace(frame, depth + OWN);
    unsigned long hash = 1469598103934665603u;
    for (int i = OWN; i < found; i++) hash = (hash ^ (uintptr_t)frame[i]) * 1099511628211u;
    if (!is_new(hash | 1)) return;
    (void)!write(list, line, (size_t)snprintf(line, sizeof line, "%lu\n", number));
}

/* Whether this allocation is the one to fail. */
static int fails(size_t size) {
    if (all == NULL || inside || size < least) return 0;
    const unsigned long number = atomic_fetch_add(&all->count, 1) + 1;
    if (list >= 0) {
        inside = 1;
        record(number);
        inside = 0;
    }
    if (number != fail_at) return 0;
    errno = ENOMEM;
    return 1;
}

void *malloc(size_t size) { return fails(size) ? NULL : __libc_malloc(size); }
void *calloc(size_t count, size_t size) {
    return fails(count * size) ? NULL : __libc_calloc(count, size);
}
void *realloc(void *old, size_t size) { return fails(size) ? NULL : __libc_realloc(old, size); }
void *memalign(size_t alignment, size_t size) {
    return fails(size) ? NULL : __libc_memalign(alignment, size);
}
void *aligned_alloc(size_t alignment, size_t size) {
    return fails(size) ? NULL : __libc_memalign(alignment, size);
}
int posix_memalign(void **memory, size_t alignment, size_t size) {
    void *got = fails(size) ? NULL : __libc_memalign(alignment, size);
    if (got == NULL) return ENOMEM;
    *memory = got;
    return 0;
}
