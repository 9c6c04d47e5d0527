/* Output that is complete or absent: written beside its final name in the same folder, synced, renamed over it. What is
 * not an ordinary file (a device, a FIFO, standard output) is written in place. */
#define _XOPEN_SOURCE 700

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "result.h"

static gough_status fail_path(const char *path, const char *what, gough_error *error) {
    const int number = errno;
    return gough_fail(error, GOUGH_ERROR_FILE, "%s: cannot %s: %s", path, what, strerror(number));
}

/* Length of the folder's part of a path, its last slash included; 0 for a bare name. */
static size_t folder_length(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash == NULL ? 0 : (size_t)(slash - path) + 1;
}

/* Creates ".gough-PID-N.part" in the final path's folder: never over something that is there, and short, so that a name
 * of any length that the folder allows has room beside it. */
static gough_status create_beside(result_output *output, gough_error *error) {
    const size_t folder = folder_length(output->final), size = folder + 64;
    output->beside = malloc(size);
    if (output->beside == NULL)
        return gough_fail(error, GOUGH_ERROR_FILE, "%s: out of memory", output->path);
    for (int attempt = 0; attempt < 1000; attempt++) {
        snprintf(output->beside, size, "%.*s.gough-%ld-%d.part", (int)folder, output->final,
                 (long)getpid(), attempt);
        output->file =
            open(output->beside, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0666);
        if (output->file >= 0 || errno != EEXIST) break;
    }
    if (output->file >= 0) return GOUGH_OK;

    const int number = errno;
    free(output->beside);
    output->beside = NULL;
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
    if (path[0] == '\0') return gough_fail(error, GOUGH_ERROR_FILE, "no file is named to write to");

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

gough_status result_output_finish(result_output *output, gough_error *error) {
    gough_status status = flush(output, error);
    if (status == GOUGH_OK && output->standard && fflush(stdout) != 0)
        status = fail_path("standard output", "write", error);
    if (status == GOUGH_OK && output->beside != NULL && fsync(output->file) != 0)
        status = fail_path(output->path, "write", error);
    if (output->file >= 0 && close(output->file) != 0 && status == GOUGH_OK)
        status = fail_path(output->path, "write", error);
    output->file = -1;
    if (status == GOUGH_OK && output->beside != NULL) {
        if (rename(output->beside, output->final) != 0) {
            status = fail_path(output->path, "rename the finished file", error);
        } else {
            sync_folder(output->final);
            free(output->beside);
            output->beside = NULL;
        }
    }
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
