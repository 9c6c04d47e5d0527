/* A private temporary folder. A child process, the keeper, waits until the other end of a pipe is closed, by us or by our death,
 * and removes the folder then; so neither Ctrl-C nor SIGKILL leaves it behind. The keeper calls functions that are safe after a
 * fork in a process with threads, and no others. */
#define _GNU_SOURCE
#include "figure/private_folder.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

/* As the system call has it. */
struct entry {
    uint64_t inode;
    int64_t offset;
    unsigned short length;
    unsigned char type;
    char name[];
};

static void remove_files(int folder) {
    _Alignas(struct entry) char list[4096];
    long got;
    while ((got = syscall(SYS_getdents64, folder, list, sizeof list)) > 0)
        for (long at = 0; at < got;) {
            const struct entry *entry = (const struct entry *)(const void *)(list + at);
            if (entry->name[0] != '.') unlinkat(folder, entry->name, 0);
            at += entry->length;
        }
}

/* Some times over, as a gnuplot that dies with us may still be writing. */
static void remove_folder(const char *path) {
    for (int attempt = 0; attempt < 100; attempt++) {
        const int folder = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
        if (folder < 0) return;
        remove_files(folder);
        close(folder);
        if (rmdir(path) == 0 || (errno != ENOTEMPTY && errno != EEXIST)) return;
        nanosleep(&(struct timespec){0, 20000000}, NULL);
    }
}

/* Signals stay blocked here: those of a terminal are meant for whoever waits for the figure. */
static _Noreturn void keep(int line, const char *folder) {
    char byte;
    ssize_t got;
    do got = read(line, &byte, 1);
    while (got > 0 || (got < 0 && errno == EINTR));
    remove_folder(folder);
    _exit(0);
}

static gough_status make(workshop *shop, const char *parent, gough_error *error) {
    int ends[2] = {-1, -1};
    snprintf(shop->folder, sizeof shop->folder, "%s/gough-figure-XXXXXX", parent);
    if (pipe2(ends, O_CLOEXEC) != 0 || mkdtemp(shop->folder) == NULL) {
        gough_fail(error, GOUGH_ERROR_FILE, "cannot make a temporary folder in %s: %s", parent,
                   strerror(errno));
        if (ends[0] >= 0) close(ends[0]);
        if (ends[1] >= 0) close(ends[1]);
        return GOUGH_ERROR_FILE;
    }
    shop->line = ends[1];
    shop->keeper = fork();
    if (shop->keeper == 0) {
        close(ends[1]);
        keep(ends[0], shop->folder);
    }
    const int number = errno;
    close(ends[0]);
    if (shop->keeper > 0) return GOUGH_OK;
    close(ends[1]);
    rmdir(shop->folder);
    return gough_fail(error, GOUGH_ERROR_FILE, "cannot start a child process: %s",
                      strerror(number));
}

gough_status workshop_open(workshop *shop, gough_error *error) {
    const char *parent = getenv("TMPDIR");
    sigset_t all, before;
    if (parent == NULL || parent[0] != '/' || strlen(parent) > 150) parent = "/tmp";
    /* no signal ends us while the folder has no keeper */
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    const gough_status status = make(shop, parent, error);
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return status;
}

void workshop_close(workshop *shop) {
    close(shop->line);
    while (waitpid(shop->keeper, NULL, 0) < 0 && errno == EINTR) {
    }
}
