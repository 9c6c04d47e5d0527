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

enum { FAULTS_COUNTED = 48 };

typedef struct fault_state {
    char name[40];
    long left;  /* calls until the one that fails */
    int number; /* its errno */
    bool came;
    /* calls since fault_forget(), by name */
    struct {
        char name[40];
        long calls;
    } called[FAULTS_COUNTED];
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
    fault()->left = n;
    fault()->number = number;
    fault()->came = false;
    strncpy(fault()->name, name, sizeof fault()->name - 1);
}

/* No more faults; whether the armed one came. */
static inline bool fault_disarm(void) {
    fault()->name[0] = '\0';
    return fault()->came;
}

/* Counts calls from now on. */
static inline void fault_forget(void) { memset(fault()->called, 0, sizeof fault()->called); }

/* How often the function was called since fault_forget(). */
static inline long fault_calls(const char *name) {
    for (int i = 0; i < FAULTS_COUNTED; i++)
        if (strcmp(fault()->called[i].name, name) == 0) return fault()->called[i].calls;
    return 0;
}

static inline void fault_count(const char *name) {
    for (int i = 0; i < FAULTS_COUNTED; i++) {
        if (!fault()->called[i].name[0]) strncpy(fault()->called[i].name, name, 39);
        if (strcmp(fault()->called[i].name, name) != 0) continue;
        fault()->called[i].calls++;
        return;
    }
}

static inline bool fault_comes(const char *name) {
    fault_state *state = fault();
    fault_count(name);
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

/* The same of a public function, whose name ends for the linker in the edition of the interface (gough/names.h). */
#define FAULTY_PUBLIC(type, name, parameters, failure, ...)                                        \
    GOUGH_NAME_(__real_##name)                                                                     \
    GOUGH_NAME_(__wrap_##name)                                                                     \
    FAULTY(type, name, parameters, failure, __VA_ARGS__)

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
