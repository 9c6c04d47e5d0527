/* Output that is complete or absent: written to a file without a name in the same folder (where the system has none: with a name
 * beside the final one), synced, renamed over the final name. Devices, pipes and standard output are written in place. */
#define _GNU_SOURCE /* O_TMPFILE */

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "table/table.h"

static gough_status fail_path(const char *path, const char *what, gough_error *error) {
    const int number = errno;
    return gough_fail(error, GOUGH_ERROR_FILE, "%s: cannot %s: %s", path, what, strerror(number));
}

/* Length of the folder's part of a path, its last slash included; 0 for a bare name. */
static size_t folder_length(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash == NULL ? 0 : (size_t)(slash - path) + 1;
}

enum { ATTEMPTS = 1000 };

/* ".gough-PID-N.part" in the final path's folder: short, so that a name of any length that the folder allows has room beside
 * it. */
static void name_beside(const result_output *output, char *beside, size_t size, int attempt) {
    snprintf(beside, size, "%.*s.gough-%ld-%d.part", (int)folder_length(output->final),
             output->final, (long)getpid(), attempt);
}

static char *room_beside(const result_output *output, size_t *size) {
    *size = folder_length(output->final) + 64;
    return malloc(*size);
}

/* A file without a name, which vanishes with the process that writes it, however that ends; -1 where the system has none or
 * could not give it a name later. */
static int open_nameless(const char *folder) {
#ifdef O_TMPFILE
    if (access("/proc/self/fd", X_OK) == 0)
        return open(folder, O_TMPFILE | O_RDWR | O_CLOEXEC, 0666);
#endif
    (void)folder;
    return -1;
}

/* Creates the file to write, without a name or else beside its final one, and never over something that is there. */
static gough_status create_beside(result_output *output, gough_error *error) {
    const size_t folder = folder_length(output->final);
    size_t size;
    char *beside = room_beside(output, &size);
    if (beside == NULL)
        return gough_fail(error, GOUGH_ERROR_FILE, "%s: out of memory", output->path);
    snprintf(beside, size, "%.*s", folder > 0 ? (int)folder : 1, folder > 0 ? output->final : ".");
    output->file = open_nameless(beside);
    if (output->file >= 0) {
        free(beside);
        return GOUGH_OK;
    }
    for (int attempt = 0; attempt < ATTEMPTS; attempt++) {
        name_beside(output, beside, size, attempt);
        output->file = open(beside, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0666);
        if (output->file >= 0 || errno != EEXIST) break;
    }
    if (output->file >= 0) {
        output->beside = beside;
        return GOUGH_OK;
    }

    const int number = errno;
    free(beside);
    if (number == ENOENT || number == ENOTDIR)
        return gough_fail(error, GOUGH_ERROR_FILE,
                          "%s: the folder %.*s does not exist; create it first", output->path,
                          folder > 1 ? (int)(folder - 1) : 1, folder > 0 ? output->final : ".");
    errno = number;
    return fail_path(output->path, "write in its folder", error);
}

/* An existing target: a device or FIFO is opened as it is; a link is followed, so that it stays a link. */
static gough_status look_at_target(result_output *output, bool *in_place, mode_t *mode,
                                   gough_error *error) {
    struct stat target;
    *in_place = false;
    *mode = 0;
    if (stat(output->path, &target) != 0) return GOUGH_OK;
    if (S_ISDIR(target.st_mode))
        return gough_fail(error, GOUGH_ERROR_FILE, "%s: is a folder; name a file in it",
                          output->path);
    if (access(output->path, W_OK) != 0) return fail_path(output->path, "write", error);
    *in_place = !S_ISREG(target.st_mode);
    *mode = target.st_mode & 07777;
    return GOUGH_OK;
}

gough_status result_output_open(result_output *output, const char *path, gough_error *error) {
    output->path = path;
    output->final = output->beside = NULL;
    output->file = -1;
    output->held = 0;
    output->standard = strcmp(path, "-") == 0;
    if (output->standard) return GOUGH_OK;
    if (path[0] == '\0') return gough_fail(error, GOUGH_ERROR_FILE, "the output has no name");

    bool in_place;
    mode_t mode;
    gough_status status = look_at_target(output, &in_place, &mode, error);
    if (status != GOUGH_OK) return status;
    if (in_place) {
        output->file = open(path, O_WRONLY | O_CLOEXEC);
        return output->file >= 0 ? GOUGH_OK : fail_path(path, "open", error);
    }

    output->final = mode != 0 ? realpath(path, NULL) : strdup(path);
    if (output->final == NULL) return fail_path(path, "write", error);
    status = create_beside(output, error);
    if (status != GOUGH_OK) {
        free(output->final);
        output->final = NULL;
        return status;
    }
    /* a file that is replaced keeps its permissions; where that is refused, the new file's stand */
    if (mode != 0 && fchmod(output->file, mode) != 0) errno = 0;
    return GOUGH_OK;
}

static gough_status write_all(result_output *output, const char *bytes, size_t length,
                              gough_error *error) {
    if (output->standard) {
        if (fwrite(bytes, 1, length, stdout) == length) return GOUGH_OK;
        return fail_path("standard output", "write", error);
    }
    while (length > 0) {
        const ssize_t written = write(output->file, bytes, length);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return fail_path(output->path, "write", error);
        bytes += written;
        length -= (size_t)written;
    }
    return GOUGH_OK;
}

static gough_status flush(result_output *output, gough_error *error) {
    const size_t held = output->held;
    output->held = 0;
    return write_all(output, output->buffer, held, error);
}

gough_status result_output_add(result_output *output, const void *bytes, size_t length,
                               gough_error *error) {
    if (output->held + length > sizeof output->buffer) {
        const gough_status status = flush(output, error);
        if (status != GOUGH_OK) return status;
    }
    if (length > sizeof output->buffer) return write_all(output, bytes, length, error);
    memcpy(output->buffer + output->held, bytes, length);
    output->held += length;
    return GOUGH_OK;
}

void result_output_abandon(result_output *output) {
    if (output->file >= 0) close(output->file);
    if (output->beside != NULL) unlink(output->beside);
    free(output->beside);
    free(output->final);
    output->file = -1;
    output->beside = output->final = NULL;
}

/* Makes the new name last through a loss of power; the file itself is complete without it, so that a file system which
 * cannot do this is no error. */
static void sync_folder(const char *final) {
    const size_t folder = folder_length(final);
    char *name = strndup(folder > 0 ? final : ".", folder > 0 ? folder : 1);
    if (name == NULL) return;
    const int file = open(name, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    free(name);
    if (file < 0) return;
    (void)fsync(file);
    close(file);
}

/* Gives a file without a name one beside the final one. */
static bool name_file(result_output *output) {
    char source[40];
    size_t size;
    char *beside = room_beside(output, &size);
    if (beside == NULL) return false;
    snprintf(source, sizeof source, "/proc/self/fd/%d", output->file);
    for (int attempt = 0; attempt < ATTEMPTS; attempt++) {
        name_beside(output, beside, size, attempt);
        if (linkat(AT_FDCWD, source, AT_FDCWD, beside, AT_SYMLINK_FOLLOW) == 0) {
            output->beside = beside;
            return true;
        }
        if (errno != EEXIST) break;
    }
    const int number = errno;
    free(beside);
    errno = number;
    return false;
}

/* The finished file takes its place. No signal comes between its two names. */
static bool move_into_place(result_output *output) {
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    const bool moved =
        (output->beside != NULL || name_file(output)) && rename(output->beside, output->final) == 0;
    const int number = errno;
    if (moved) {
        free(output->beside);
        output->beside = NULL;
    } else if (output->beside != NULL) {
        unlink(output->beside);
    }
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    errno = number;
    return moved;
}

gough_status result_output_finish(result_output *output, gough_error *error) {
    const bool moves = output->final != NULL;
    gough_status status = flush(output, error);
    if (status == GOUGH_OK && output->standard && fflush(stdout) != 0)
        status = fail_path("standard output", "write", error);
    if (status == GOUGH_OK && moves && fsync(output->file) != 0)
        status = fail_path(output->path, "write", error);
    if (status == GOUGH_OK && moves && !move_into_place(output))
        status = fail_path(output->path, "rename the finished file", error);
    if (status == GOUGH_OK && moves) sync_folder(output->final);
    const bool closed = output->file < 0 || close(output->file) == 0;
    output->file = -1;
    if (!closed && status == GOUGH_OK) status = fail_path(output->path, "write", error);
    result_output_abandon(output);
    return status;
}

gough_status gough_write_file(const char *path, const void *bytes, size_t length,
                              gough_error *error) {
    result_output *output = malloc(sizeof *output);
    if (output == NULL) return gough_fail(error, GOUGH_ERROR_FILE, "%s: out of memory", path);
    gough_status status = result_output_open(output, path, error);
    if (status == GOUGH_OK) {
        status = result_output_add(output, bytes, length, error);
        if (status == GOUGH_OK)
            status = result_output_finish(output, error);
        else
            result_output_abandon(output);
    }
    free(output);
    return status;
}
