/* Faults on demand: one call of a function that the library uses fails.
 *
 * A test lists such functions in a line "Faults: NAME…" of its file; the linker then leads the library's calls of NAME to the
 * __wrap_NAME() that FAULTY defines. Counting n from 1 until the fault does not come any more lets each call fail once:
 *
 *     for (long n = 1; fault_arm("malloc", n, ENOMEM), act(), fault_disarm(); n++) …
 *
 * What is armed is shared with children of fork(). */
#ifndef TESTS_SUPPORT_FAULTS_H
#define TESTS_SUPPORT_FAULTS_H

#include <errno.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

typedef struct fault_state {
    char name[40];
    long left;  /* calls until the one that fails */
    int number; /* its errno */
    bool came;
} fault_state;

static inline fault_state *fault(void) {
    static fault_state *state;
    if (state) return state;
    state = mmap(NULL, sizeof *state, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (state == MAP_FAILED) abort();
    return state;
}

/* The n-th call of the function fails, from 1. */
static inline void fault_arm(const char *name, long n, int number) {
    *fault() = (fault_state){.left = n, .number = number};
    strncpy(fault()->name, name, sizeof fault()->name - 1);
}

/* No more faults; whether the armed one came. */
static inline bool fault_disarm(void) {
    fault()->name[0] = '\0';
    return fault()->came;
}

static inline bool fault_comes(const char *name) {
    fault_state *state = fault();
    if (strcmp(state->name, name) != 0 || --state->left != 0) return false;
    state->came = true;
    errno = state->number;
    return true;
}

#define FAULTY(type, name, parameters, failure, ...)                                               \
    type __real_##name parameters;                                                                 \
    type __wrap_##name parameters;                                                                 \
    type __wrap_##name parameters {                                                                \
        return fault_comes(#name) ? (failure) : __real_##name(__VA_ARGS__);                        \
    }                                                                                              \
    _Static_assert(1, "")

#define FAULTY_MALLOC FAULTY(void *, malloc, (size_t size), NULL, size)
#define FAULTY_CALLOC FAULTY(void *, calloc, (size_t n, size_t size), NULL, n, size)
#define FAULTY_REALLOC FAULTY(void *, realloc, (void *old, size_t size), NULL, old, size)
#define FAULTY_STRDUP FAULTY(char *, strdup, (const char *text), NULL, text)
#define FAULTY_STRNDUP FAULTY(char *, strndup, (const char *text, size_t n), NULL, text, n)
#define FAULTY_OPEN_MEMSTREAM                                                                      \
    FAULTY(FILE *, open_memstream, (char **text, size_t *length), NULL, text, length)
#define FAULTY_READ FAULTY(ssize_t, read, (int file, void *to, size_t n), -1, file, to, n)
#define FAULTY_WRITE FAULTY(ssize_t, write, (int file, const void *at, size_t n), -1, file, at, n)
#define FAULTY_FSTAT FAULTY(int, fstat, (int file, struct stat *about), -1, file, about)

#endif
