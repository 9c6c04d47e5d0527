/* A table read by a child process, handed over through a pipe: status and message, then shape, texts, numbers, each text
 * as its length and its bytes. The child is limited in time and memory; its death by a signal is an answer, not a crash. */
#define _POSIX_C_SOURCE 200809L

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "table/child_reader.h"
#include "table/table.h"

enum { TEXT_CAP = 1 << 20, CPU_SECONDS = 10 };
static const rlim_t MEMORY_BASE = (rlim_t)4 << 30;

#if defined(__SANITIZE_ADDRESS__)
enum { ADDRESS_SANITIZER = 1 };
#elif defined(__has_feature)
enum { ADDRESS_SANITIZER = __has_feature(address_sanitizer) };
#else
enum { ADDRESS_SANITIZER = 0 };
#endif

static bool put(int pipe, const void *bytes, size_t length) {
    const char *at = bytes;
    while (length > 0) {
        const ssize_t written = write(pipe, at, length);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return false;
        at += written;
        length -= (size_t)written;
    }
    return true;
}

static bool get(int pipe, void *bytes, size_t length) {
    char *at = bytes;
    while (length > 0) {
        const ssize_t got = read(pipe, at, length);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return false;
        at += got;
        length -= (size_t)got;
    }
    return true;
}

/* NULL: an empty text */
static bool put_text(int pipe, const char *text) {
    const size_t length = text ? strlen(text) : 0;
    return put(pipe, &length, sizeof length) && put(pipe, text, length);
}

static bool get_text(int pipe, char **text) {
    size_t length = 0;
    if (!get(pipe, &length, sizeof length) || length > TEXT_CAP) return false;
    *text = calloc(length + 1, 1);
    return *text != NULL && get(pipe, *text, length);
}

enum { TEXTS = 4 };

static void texts_of(gough_table *table, char **text[TEXTS]) {
    text[0] = &table->title;
    text[1] = &table->verb;
    text[2] = &table->end_cause;
    text[3] = &table->end_message;
}

/* The numbers that come before the texts. */
typedef struct shape {
    size_t rows, columns;
    double end_time, tolerance, step, max_speed, max_force;
} shape;

static bool put_table(int pipe, gough_table *table) {
    const shape s = {table->rows, table->columns,   table->end_time, table->tolerance,
                     table->step, table->max_speed, table->max_force};
    char **text[TEXTS];
    texts_of(table, text);
    bool good = put(pipe, &s, sizeof s);
    for (int i = 0; i < TEXTS; i++) good = good && put_text(pipe, *text[i]);
    for (size_t c = 0; c < table->columns; c++)
        good = good && put_text(pipe, table->name[c]) && put_text(pipe, table->unit[c]) &&
               put(pipe, table->value[c], table->rows * sizeof(double));
    return good;
}

static bool get_table(int pipe, gough_table *table) {
    shape s = {.rows = 0};
    char **text[TEXTS];
    texts_of(table, text);
    bool good = get(pipe, &s, sizeof s);
    table->end_time = s.end_time;
    table->tolerance = s.tolerance;
    table->step = s.step;
    table->max_speed = s.max_speed;
    table->max_force = s.max_force;
    for (int i = 0; i < TEXTS; i++) good = good && get_text(pipe, text[i]);
    good = good && result_table_shape(table, s.columns, s.rows);
    for (size_t c = 0; c < s.columns; c++)
        good = good && get_text(pipe, &table->name[c]) && get_text(pipe, &table->unit[c]) &&
               get(pipe, table->value[c], s.rows * sizeof(double));
    return good;
}

/* Seconds of computing and bytes of memory in proportion to the file. Sanitizers need address space without end. */
static void limit_child(size_t file_size) {
    const rlim_t seconds = CPU_SECONDS + file_size / ((size_t)16 << 20);
    setrlimit(RLIMIT_CPU, &(struct rlimit){seconds, seconds + 1});
    setrlimit(RLIMIT_CORE, &(struct rlimit){0, 0});
    const rlim_t memory = MEMORY_BASE + 80 * (rlim_t)file_size;
    if (!ADDRESS_SANITIZER) setrlimit(RLIMIT_AS, &(struct rlimit){memory, memory});
}

/* The child's whole life. What a dying library prints is of no use to anyone. */
static _Noreturn void serve(int pipe, result_reader *read_table, const char *path,
                            gough_table *table) {
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDERR_FILENO);
    static const int fatal[] = {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU, SIGPIPE};
    for (size_t i = 0; i < sizeof fatal / sizeof fatal[0]; i++) signal(fatal[i], SIG_DFL);
    struct stat about;
    limit_child(stat(path, &about) == 0 ? (size_t)about.st_size : 0);

    gough_error error = {.message = ""};
    const gough_status status = read_table(path, table, &error);
    const bool good = put(pipe, &status, sizeof status) && put(pipe, &error, sizeof error) &&
                      (status != GOUGH_OK || put_table(pipe, table));
    _exit(good ? 0 : 1);
}

static gough_status receive(int pipe, const char *path, gough_table *table, gough_error *error) {
    gough_status status = GOUGH_ERROR_INPUT;
    gough_error said = {.message = ""};
    const bool answered = get(pipe, &status, sizeof status) && get(pipe, &said, sizeof said);
    if (answered && status != GOUGH_OK) {
        said.message[sizeof said.message - 1] = '\0';
        return gough_fail(error, status, "%s", said.message);
    }
    errno = 0;
    if (answered && get_table(pipe, table)) return GOUGH_OK;
    if (errno == ENOMEM) return gough_fail(error, GOUGH_ERROR_FILE, "%s: out of memory", path);
    return gough_fail(error, GOUGH_ERROR_INPUT,
                      "%s: the HDF5 library cannot read it; the file is damaged", path);
}

gough_status result_read_in_child(result_reader *read_table, const char *path, gough_table *table,
                                  gough_error *error) {
    int ends[2];
    if (pipe(ends) != 0)
        return gough_fail(error, GOUGH_ERROR_FILE, "%s: cannot create a pipe: %s", path,
                          strerror(errno));
    const pid_t child = fork();
    if (child < 0) {
        const int number = errno;
        close(ends[0]);
        close(ends[1]);
        return gough_fail(error, GOUGH_ERROR_FILE, "%s: cannot start a child process: %s", path,
                          strerror(number));
    }
    if (child == 0) {
        close(ends[0]);
        serve(ends[1], read_table, path, table);
    }
    close(ends[1]);
    gough_status status = receive(ends[0], path, table, error);
    int ended = 0;
    close(ends[0]);
    while (waitpid(child, &ended, 0) < 0 && errno == EINTR) {
    }
    /* a program may end itself so when memory runs out (src/cli/common/memory.c); that says nothing about the file */
    if (status != GOUGH_OK && WIFEXITED(ended) && WEXITSTATUS(ended) == GOUGH_ERROR_FILE)
        status = gough_fail(error, GOUGH_ERROR_FILE, "%s: out of memory while reading it", path);
    return status;
}
