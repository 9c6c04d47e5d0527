/* A table read by a child process, handed over through a pipe: status and message, then shape, texts, names, numbers, each
 * text as its length and its bytes; or in parts, with status and message once more behind the last. The child is limited in time
 * and memory; its death by a signal is an answer, not a crash. */
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

/* The numbers that come before the texts. */
typedef struct shape {
    size_t rows, columns;
    double end_time, tolerance, step, max_speed, max_force;
} shape;

/* The texts and names of a table, and `rows` of its numbers. */
static bool put_heads(int pipe, const gough_table *table) {
    const shape s = {table->rows, table->columns,   table->end_time, table->tolerance,
                     table->step, table->max_speed, table->max_force};
    const char *const text[TEXTS] = {table->title, table->verb, table->end_cause,
                                     table->end_message};
    bool good = put(pipe, &s, sizeof s);
    for (int i = 0; i < TEXTS; i++) good = good && put_text(pipe, text[i]);
    for (size_t c = 0; c < table->columns; c++)
        good = good && put_text(pipe, table->name[c]) && put_text(pipe, table->unit[c]);
    return good;
}

/* Rows of numbers, column by column. */
static bool put_rows(int pipe, const gough_table *table) {
    bool good = true;
    for (size_t c = 0; c < table->columns; c++)
        good = good && put(pipe, table->value[c], table->rows * sizeof(double));
    return good;
}

/* room: least number of rows to make room for */
static bool get_heads(int pipe, gough_table *table, size_t room) {
    shape s = {.rows = 0};
    char **const text[TEXTS] = {&table->title, &table->verb, &table->end_cause,
                                &table->end_message};
    bool good = get(pipe, &s, sizeof s);
    table->end_time = s.end_time;
    table->tolerance = s.tolerance;
    table->step = s.step;
    table->max_speed = s.max_speed;
    table->max_force = s.max_force;
    for (int i = 0; i < TEXTS; i++) good = good && get_text(pipe, text[i]);
    good = good && result_table_shape(table, s.columns, s.rows > room ? s.rows : room);
    table->rows = s.rows;
    for (size_t c = 0; c < s.columns; c++)
        good = good && get_text(pipe, &table->name[c]) && get_text(pipe, &table->unit[c]);
    return good;
}

static bool get_rows(int pipe, gough_table *table) {
    bool good = true;
    for (size_t c = 0; c < table->columns; c++)
        good = good && get(pipe, table->value[c], table->rows * sizeof(double));
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

/* What a child is for: a whole table, or its parts. */
typedef struct task {
    const char *path;
    result_reader *read;           /* NULL: in parts */
    result_part_reader *read_part; /* as `scan` asks for */
    result_scan *scan;
} task;

/* Where the child is, as its sink sees it. */
typedef struct outlet {
    int pipe;
    bool begun; /* the names are through */
} outlet;

/* A gough_table_sink: a part is its number of rows, above 0, and its numbers. */
static int send_part(void *context, const gough_table *part) {
    outlet *out = context;
    const bool begun = out->begun;
    out->begun = true;
    if (!begun) return !put_heads(out->pipe, part);
    return !(put(out->pipe, &part->rows, sizeof part->rows) && put_rows(out->pipe, part));
}

/* After the names and the parts, a part without rows, and how it went. Without names how it went comes first. */
static bool send_parts(int pipe, const task *work, gough_table *table) {
    gough_error error = {.message = ""};
    gough_status status = GOUGH_OK;
    const size_t none = 0;
    outlet out = {pipe, false};
    result_scan scan = {.path = work->path, .wanted = work->scan->wanted};
    scan.sink = send_part;
    scan.context = &out;
    if (!put(pipe, &status, sizeof status) || !put(pipe, &error, sizeof error)) return false;
    status = work->read_part(&scan, table, &error);
    if (scan.stopped) return false;
    return (out.begun || put_heads(pipe, &(gough_table){.rows = 0})) &&
           put(pipe, &none, sizeof none) && put(pipe, &status, sizeof status) &&
           put(pipe, &error, sizeof error);
}

static bool send_table(int pipe, const task *work, gough_table *table) {
    gough_error error = {.message = ""};
    const gough_status status = work->read(work->path, table, &error);
    return put(pipe, &status, sizeof status) && put(pipe, &error, sizeof error) &&
           (status != GOUGH_OK || (put_heads(pipe, table) && put_rows(pipe, table)));
}

/* The child's whole life. What a dying library prints is of no use to anyone. */
static _Noreturn void serve(int pipe, const task *work, gough_table *table) {
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDERR_FILENO);
    static const int fatal[] = {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU, SIGPIPE};
    for (size_t i = 0; i < sizeof fatal / sizeof fatal[0]; i++) signal(fatal[i], SIG_DFL);
    struct stat about;
    limit_child(stat(work->path, &about) == 0 ? (size_t)about.st_size : 0);
    const bool good =
        work->read != NULL ? send_table(pipe, work, table) : send_parts(pipe, work, table);
    _exit(good ? 0 : 1);
}

/* How the child says that it went. @return whether it said so */
static bool get_status(int pipe, gough_status *status, gough_error *said) {
    const bool answered = get(pipe, status, sizeof *status) && get(pipe, said, sizeof *said);
    said->message[sizeof said->message - 1] = '\0';
    return answered;
}

/* The parts up to the last one; false if the child died before. */
static bool receive_parts(int pipe, result_scan *scan, gough_table *table) {
    const bool known = table->columns > 0;
    if (known) scan->stopped = scan->sink(scan->context, table) != 0;
    while (!scan->stopped) {
        if (!get(pipe, &table->rows, sizeof table->rows) || table->rows > RESULT_PART) return false;
        if (table->rows == 0) return true;
        if (!get_rows(pipe, table)) return false;
        scan->stopped = scan->sink(scan->context, table) != 0;
    }
    return true;
}

static gough_status receive(int pipe, const task *work, gough_table *table, gough_error *error) {
    gough_status status = GOUGH_ERROR_INPUT;
    gough_error said = {.message = ""};
    bool answered = get_status(pipe, &status, &said);
    errno = 0;
    if (answered && status == GOUGH_OK && work->read != NULL) {
        answered = get_heads(pipe, table, 0) && get_rows(pipe, table);
    } else if (answered && status == GOUGH_OK) {
        answered = get_heads(pipe, table, RESULT_PART) && receive_parts(pipe, work->scan, table);
        if (answered && work->scan->stopped) return GOUGH_OK;
        answered = answered && get_status(pipe, &status, &said);
    }
    if (answered && status == GOUGH_OK) return GOUGH_OK;
    if (answered) return gough_fail(error, status, "%s", said.message);
    if (errno == ENOMEM)
        return gough_fail(error, GOUGH_ERROR_FILE, "%s: out of memory", work->path);
    return gough_fail(error, GOUGH_ERROR_INPUT,
                      "%s: the HDF5 library cannot read it; the file is damaged", work->path);
}

static gough_status run_child(const task *work, gough_table *table, gough_error *error) {
    const char *path = work->path;
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
        serve(ends[1], work, table);
    }
    close(ends[1]);
    gough_status status = receive(ends[0], work, table, error);
    int ended = 0;
    close(ends[0]);
    while (waitpid(child, &ended, 0) < 0 && errno == EINTR) {
    }
    /* a program may end itself so when memory runs out (src/cli/common/memory.c); that says nothing about the file */
    if (status != GOUGH_OK && WIFEXITED(ended) && WEXITSTATUS(ended) == GOUGH_ERROR_FILE)
        status = gough_fail(error, GOUGH_ERROR_FILE, "%s: out of memory while reading it", path);
    return status;
}

gough_status result_read_in_child(result_reader *read_table, const char *path, gough_table *table,
                                  gough_error *error) {
    const task work = {.path = path, .read = read_table};
    return run_child(&work, table, error);
}

gough_status result_scan_in_child(result_part_reader *read_part, result_scan *scan,
                                  gough_table *table, gough_error *error) {
    const task work = {.path = scan->path, .read_part = read_part, .scan = scan};
    return run_child(&work, table, error);
}
