/* What the command does when memory runs out. Its libraries for YAML, HDF5, JSON and options do not all survive a failed
 * allocation, and some shorten their answer. So a small allocation that fails, whoever asked for it, ends the command with a
 * sentence and exit status 3; large ones return NULL to callers that can say what needs the memory. Ending at any time is safe:
 * files under way have no name yet (src/table/output.c). */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/common/memory.h"
#include "gough/status.h"

_Noreturn void out_of_memory(void) {
    static const char sentence[] = "gough: error: out of memory\n";
    (void)!write(STDERR_FILENO, sentence, sizeof sentence - 1);
    _exit(GOUGH_ERROR_FILE); /* what stands in the buffer of standard output is no whole answer */
}

void *allocate(size_t size) {
    void *memory = malloc(size);
    if (!memory) out_of_memory();
    return memory;
}

void *reallocate(void *old, size_t size) {
    void *memory = realloc(old, size);
    if (!memory) out_of_memory();
    return memory;
}

/* Sanitizers have allocators of their own. */
#if defined(__SANITIZE_ADDRESS__)
#define GOUGH_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define GOUGH_SANITIZED 1
#endif
#endif

#if defined(__GLIBC__) && !defined(GOUGH_SANITIZED)
enum { LARGE = 1 << 20 }; /* bytes: larger ones are checked where they are asked for */

typedef void *allocator(size_t size);
typedef void *array_allocator(size_t count, size_t size);
typedef void *reallocator(void *old, size_t size);

/* glibc's own, for what dlsym() itself may ask for */
extern allocator __libc_malloc;
extern array_allocator __libc_calloc;
extern reallocator __libc_realloc;

static _Thread_local int looking;

/* The next definition of a function after this one: that of the C library, or of a preloaded allocator. */
static void find_next(const char *name, void *function, size_t size) {
    looking = 1;
    void *found = dlsym(RTLD_NEXT, name);
    looking = 0;
    memcpy(function, &found, size);
}

static void *checked(void *memory, size_t size) {
    if (!memory && size > 0 && size < LARGE) out_of_memory();
    return memory;
}

__attribute__((visibility("default"))) void *malloc(size_t size) {
    static allocator *next;
    if (!next && !looking) find_next("malloc", &next, sizeof next);
    return checked(next ? next(size) : __libc_malloc(size), size);
}

__attribute__((visibility("default"))) void *calloc(size_t count, size_t size) {
    static array_allocator *next;
    if (!next && !looking) find_next("calloc", &next, sizeof next);
    void *memory = next ? next(count, size) : __libc_calloc(count, size);
    return count > 0 && size > LARGE / count ? memory : checked(memory, count * size);
}

__attribute__((visibility("default"))) void *realloc(void *old, size_t size) {
    static reallocator *next;
    if (!next && !looking) find_next("realloc", &next, sizeof next);
    return checked(next ? next(old, size) : __libc_realloc(old, size), size);
}
#endif
