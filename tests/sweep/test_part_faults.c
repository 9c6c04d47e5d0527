/* The file of a sweep when memory or the system fails: a sentence with the file's name, and a part that can still go on.
 * Faults: malloc calloc strdup strndup asprintf open_memstream fclose write pread fstat open mkostemp flock ftruncate lseek
 * Faults: fdatasync clock_gettime */
#define _GNU_SOURCE
#include <fcntl.h>
#include <stdarg.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>

#include "gough/sweep.h"

#include "support/faults.h"
#include "support/suite.h"
#include "sweep/sweep_part.h"
#include "table/by_hand.h"

FAULTY_MALLOC;
FAULTY_CALLOC;
FAULTY_STRDUP;
FAULTY_STRNDUP;
FAULTY_OPEN_MEMSTREAM;
FAULTY_WRITE;
FAULTY_FSTAT;
FAULTY(ssize_t, pread, (int file, void *to, size_t n, off_t at), -1, file, to, n, at);
FAULTY(int, mkostemp, (char *name, int flags), -1, name, flags);
FAULTY(int, flock, (int file, int operation), -1, file, operation);
FAULTY(int, ftruncate, (int file, off_t length), -1, file, length);
FAULTY(off_t, lseek, (int file, off_t at, int from), -1, file, at, from);
FAULTY(int, fdatasync, (int file), -1, file);

/* a stream into memory that could not grow */
int __real_fclose(FILE *stream);
int __wrap_fclose(FILE *stream);
int __wrap_fclose(FILE *stream) {
    const bool fails = fault_comes("fclose");
    return __real_fclose(stream) != 0 || fails ? EOF : 0;
}

int __wrap_asprintf(char **text, const char *format, ...) __attribute__((format(printf, 2, 3)));
int __wrap_asprintf(char **text, const char *format, ...) {
    va_list list;
    if (fault_comes("asprintf")) return -1;
    va_start(list, format);
    const int length = vasprintf(text, format, list);
    va_end(list);
    return length;
}

int __real_open(const char *path, int flags, ...);
int __wrap_open(const char *path, int flags, ...);
int __wrap_open(const char *path, int flags, ...) {
    return fault_comes("open") ? -1 : __real_open(path, flags, 0666);
}

/* if in a hurry, later by a minute with each call: every flush syncs */
static bool hurried;
int __real_clock_gettime(clockid_t clock, struct timespec *now);
int __wrap_clock_gettime(clockid_t clock, struct timespec *now);
int __wrap_clock_gettime(clockid_t clock, struct timespec *now) {
    static time_t passed;
    const int status = __real_clock_gettime(clock, now);
    if (hurried) now->tv_sec += passed += 60;
    return status;
}

static const char study[] = "units: dimensionless\n"
                            "title: \"faults\"\n"
                            "platform:\n"
                            "  base: {radius: 1.0, half_angle: 15}\n"
                            "  top: {radius: 0.6, half_angle: 15}\n"
                            "  height: 1.2\n"
                            "load: {mass: 1, inertia: [0.08, 0.08, 0.15]}\n"
                            "simulation: {duration: 0.1, method: rk4, step: 0.05}\n"
                            "control: {stiffness: 5}\n"
                            "sweep: {keys: {load.mass: {from: 1, to: 2, steps: 3}}}\n";

static gough_sweep *new_sweep(void) {
    const gough_setting setting = {"control.damping", "1"};
    gough_sweep *sweep = NULL;
    char *messages = NULL;
    ck_assert_msg(gough_sweep_parse("study.yaml", study, strlen(study), &setting, 1, &sweep,
                                    &messages) == GOUGH_OK,
                  "%s", messages);
    return sweep;
}

static gough_status run_into(const gough_sweep *sweep, const char *path, size_t shard,
                             size_t shards, gough_error *error) {
    gough_sweep_options options = gough_sweep_options_default();
    gough_sweep_summary summary;
    const gough_sweep_output output = {.path = path, .shard = shard, .shards = shards};
    options.threads = 1;
    *error = (gough_error){.message = ""};
    hurried = true;
    const gough_status status = gough_sweep_write(sweep, &options, &output, &summary, error);
    hurried = false;
    return status;
}

/* Each call of the function fails once; then the sweep is run again from what is left. `cause`: what may be said, or NULL if the
 * sweep has to end as if nothing had been. */
static long let_run_fail(const char *name, int number, const char *folder, const char *cause) {
    char path[PATH_SIZE], whole[PATH_SIZE];
    gough_error error;
    size_t length, other;
    gough_sweep *sweep = new_sweep();
    path_in(folder, "a.csv", path);
    ck_assert_msg(run_into(sweep, path_in(folder, "w.csv", whole), 0, 0, &error) == GOUGH_OK, "%s",
                  error.message);
    char *wanted = read_bytes(whole, &length);
    long n = 1;
    for (bool came = true; came; n++) {
        fault_arm(name, n, number);
        const gough_status status = run_into(sweep, path, 0, 0, &error);
        came = fault_disarm();
        if (status != GOUGH_OK) {
            const bool said =
                cause && (strstr(error.message, cause) || strstr(error.message, "no thread"));
            ck_assert_msg(came && said, "call %ld of %s: %s", n, name, error.message);
            ck_assert_int_ne(access(path, F_OK), 0);
            ck_assert_msg(run_into(sweep, path, 0, 0, &error) == GOUGH_OK, "%s", error.message);
        }
        char *made = read_bytes(path, &other);
        ck_assert(other == length && memcmp(made, wanted, length) == 0);
        free(made);
        ck_assert_int_eq(unlink(path), 0);
    }
    free(wanted);
    gough_sweep_free(sweep);
    return n - 2;
}

START_TEST(a_sweep_without_memory_says_so_and_goes_on_later) {
    static const char *const each[] = {"malloc",   "calloc",         "strdup",
                                       "asprintf", "open_memstream", "fclose"};
    char folder[PATH_SIZE];
    make_folder(folder);
    long calls = 0;
    for (size_t i = 0; i < sizeof each / sizeof each[0]; i++)
        calls += let_run_fail(each[i], ENOMEM, folder, "memory");
    ck_assert_int_gt(calls, 20);
    remove_folder(folder);
}
END_TEST

START_TEST(a_sweep_on_a_failing_disk_says_so_and_goes_on_later) {
    char folder[PATH_SIZE];
    make_folder(folder);
    ck_assert_int_gt(let_run_fail("write", ENOSPC, folder, "No space left on device"), 2);
    ck_assert_int_gt(let_run_fail("ftruncate", EIO, folder, "write: Input/output error"), 0);
    ck_assert_int_gt(let_run_fail("lseek", EIO, folder, "write: Input/output error"), 0);
    ck_assert_int_gt(let_run_fail("fdatasync", EIO, folder, "write: Input/output error"), 0);
    ck_assert_int_gt(let_run_fail("fstat", EIO, folder, "open: Input/output error"), 0);
    ck_assert_int_gt(let_run_fail("open", EACCES, folder, "Permission denied"), 0);
    ck_assert_int_gt(let_run_fail("write", EINTR, folder, NULL), 2);
    ck_assert_int_gt(let_run_fail("pread", EINTR, folder, NULL), 1);
    /* some file systems have no locks: the sweep runs without */
    ck_assert_int_gt(let_run_fail("flock", ENOLCK, folder, NULL), 0);
    remove_folder(folder);
}
END_TEST

/* The identity of a sweep is 0 where memory runs out, and else one number. */
START_TEST(an_identity_needs_memory) {
    static const char *const each[] = {"calloc", "strdup", "open_memstream", "fclose"};
    const gough_sweep_options options = gough_sweep_options_default();
    gough_sweep *sweep = new_sweep();
    const uint64_t identity = gough_sweep_identity(sweep, &options);
    ck_assert(identity != 0);
    for (size_t i = 0; i < sizeof each / sizeof each[0]; i++) {
        bool came = true;
        for (long n = 1; came; n++) {
            fault_arm(each[i], n, ENOMEM);
            const uint64_t found = gough_sweep_identity(sweep, &options);
            came = fault_disarm();
            ck_assert(found == (came ? 0 : identity));
        }
    }
    gough_sweep_free(sweep);
}
END_TEST

START_TEST(a_part_in_use_is_left_alone) {
    char folder[PATH_SIZE], path[PATH_SIZE], part[PATH_SIZE];
    gough_error error;
    gough_sweep *sweep = new_sweep();
    make_folder(folder);
    path_in(folder, "a.csv", path);
    write_bytes(path_in(folder, "a.csv.part", part), "", 0);
    const int other = __real_open(part, O_RDWR);
    ck_assert_int_eq(flock(other, LOCK_EX | LOCK_NB), 0);
    ck_assert_int_eq(run_into(sweep, path, 0, 0, &error), GOUGH_ERROR_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "a.csv.part is in use"));
    ck_assert_int_eq(access(part, F_OK), 0);
    close(other);
    ck_assert_int_eq(unlink(part), 0);
    ck_assert_int_eq(mkfifo(part, 0600), 0);
    ck_assert_int_eq(run_into(sweep, path, 0, 0, &error), GOUGH_ERROR_FILE);
    ck_assert_ptr_nonnull(strstr(error.message, "a.csv.part: is not a regular file"));
    gough_sweep_free(sweep);
    remove_folder(folder);
}
END_TEST

/* Without a path the records stand in a file without a name. */
START_TEST(a_nameless_file_is_made_in_any_folder_for_temporary_files) {
    static char too_long[300];
    memset(too_long, 'x', sizeof too_long - 1);
    too_long[0] = '/';
    const char *const folders[] = {"relative", "/tmp", too_long, NULL};
    gough_error error;
    gough_sweep *sweep = new_sweep();
    for (size_t i = 0; i < sizeof folders / sizeof folders[0]; i++) {
        if (folders[i])
            setenv("TMPDIR", folders[i], 1);
        else
            unsetenv("TMPDIR");
        ck_assert_msg(run_into(sweep, NULL, 0, 0, &error) == GOUGH_OK, "%s", error.message);
    }
    /* a file system without files that have no name */
    fault_arm("open", 1, EOPNOTSUPP);
    ck_assert_msg(run_into(sweep, NULL, 0, 0, &error) == GOUGH_OK, "%s", error.message);
    ck_assert(fault_disarm());
    setenv("TMPDIR", "/nowhere/at/all", 1);
    ck_assert_int_eq(run_into(sweep, NULL, 0, 0, &error), GOUGH_ERROR_FILE);
    ck_assert_str_eq(error.message, "a temporary file: cannot open: No such file or directory");
    unsetenv("TMPDIR");
    gough_sweep_free(sweep);
}
END_TEST

START_TEST(shards_that_cannot_be_read_are_refused_with_their_name) {
    static const char *const memory[] = {"malloc", "calloc", "strdup", "strndup"};
    char folder[PATH_SIZE], one[PATH_SIZE];
    gough_error error;
    gough_sweep *sweep = new_sweep();
    make_folder(folder);
    ck_assert_int_eq(run_into(sweep, path_in(folder, "1.shard", one), 1, 1, &error), GOUGH_OK);
    static sweep_part part;
    for (size_t i = 0; i < sizeof memory / sizeof memory[0]; i++)
        for (long n = 1;; n++) {
            fault_arm(memory[i], n, ENOMEM);
            const gough_status status = sweep_part_read(&part, one, &error);
            const bool came = fault_disarm();
            sweep_part_close(&part);
            if (!came) break;
            ck_assert_int_eq(status, GOUGH_ERROR_FILE);
            ck_assert_ptr_nonnull(strstr(error.message, "out of memory"));
        }
    fault_arm("fstat", 2, EIO); /* the first is that of opening */
    ck_assert_int_eq(sweep_part_read(&part, one, &error), GOUGH_ERROR_FILE);
    ck_assert(fault_disarm());
    ck_assert_ptr_nonnull(strstr(error.message, "1.shard: cannot read: Input/output error"));
    sweep_part_close(&part);
    for (long n = 1; n <= 3; n++) {
        fault_arm("pread", n, EIO);
        ck_assert_int_eq(sweep_part_read(&part, one, &error), GOUGH_ERROR_INPUT);
        ck_assert(fault_disarm());
        ck_assert_ptr_nonnull(strstr(error.message, "1.shard: is "));
        sweep_part_close(&part);
    }
    const gough_sweep_options options = {.size = 0};
    static const gough_units bare = {.dimensionless = true, .length = 1, .mass = 1, .time = 1};
    ck_assert_int_eq(sweep_part_read(&part, "no such.shard", &error), GOUGH_ERROR_FILE);
    sweep_part_close(&part);
    char path[40];
    snprintf(path, sizeof path, "/dev/fd/%d", __real_open("/dev/null", O_RDONLY));
    ck_assert_int_eq(sweep_part_read(&part, path, &error), GOUGH_ERROR_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "is a pipe; a regular file is needed"));
    sweep_part_close(&part);
    /* a disk that is full at any time, of a file with a name and of one without */
    for (int named = 0; named < 2; named++) {
        gough_status status = sweep_part_open(&part, named ? one : NULL,
                                              sweep_head_of(sweep, &options, &bare, 0, 0), &error);
        ck_assert_int_eq(status, GOUGH_OK);
        fault_arm("write", 1, ENOSPC);
        const double value = 1;
        const gough_sweep_row row = {.run = 1, .value = &value};
        size_t rows = 0;
        for (; status == GOUGH_OK; rows++) status = sweep_part_add(&part, &row, &error);
        ck_assert(fault_disarm());
        ck_assert_uint_gt(rows * sweep_record_size(part.head), sizeof part.buffer);
        ck_assert_ptr_nonnull(strstr(error.message, "cannot write: No space left on device"));
        part.done = 0;
        sweep_part_forget(&part);
        sweep_part_close(&part);
    }
    gough_sweep_free(sweep);
    remove_folder(folder);
}
END_TEST

int main(void) {
    return SUITE_RUN("sweep/part_faults", 60, a_sweep_without_memory_says_so_and_goes_on_later,
                     a_sweep_on_a_failing_disk_says_so_and_goes_on_later, an_identity_needs_memory,
                     a_part_in_use_is_left_alone,
                     a_nameless_file_is_made_in_any_folder_for_temporary_files,
                     shards_that_cannot_be_read_are_refused_with_their_name);
}
