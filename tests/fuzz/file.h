/* Bytes of a fuzzing input as a file with a name, in a folder that is gone when the program ends. */
#ifndef TESTS_FUZZ_FILE_H
#define TESTS_FUZZ_FILE_H

#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char fuzz_folder[64];

static inline void fuzz_forget(void) {
    static const char *const names[] = {"one", "one.part", "two", "out.csv", "out.csv.part"};
    char path[100];
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        snprintf(path, sizeof path, "%s/%s", fuzz_folder, names[i]);
        unlink(path);
    }
}

static inline void fuzz_end(void) {
    fuzz_forget();
    rmdir(fuzz_folder);
}

/* The path of a file of that name in the folder, with these bytes; NULL bytes: only its path. */
static inline const char *fuzz_file(char path[100], const char *name, const void *bytes,
                                    size_t length) {
    if (!fuzz_folder[0]) {
        strcpy(fuzz_folder, access("/dev/shm", W_OK) == 0 ? "/dev/shm/gough-fuzz-XXXXXX"
                                                          : "/tmp/gough-fuzz-XXXXXX");
        if (!mkdtemp(fuzz_folder)) abort();
        atexit(fuzz_end);
    }
    snprintf(path, 100, "%s/%s", fuzz_folder, name);
    if (!bytes) return path;
    const int file = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (file < 0 || write(file, bytes, length) != (ssize_t)length || close(file) != 0) abort();
    return path;
}

#endif
