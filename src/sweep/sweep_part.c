/* The append-only file of a sweep: head, records, checksums, and going on from what is there. */
#define _GNU_SOURCE
#include "sweep/sweep_part.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "sweep/sweep_bytes.h"

enum { OUTCOME_NUMBERS = 23, MOST_NUMBERS = OUTCOME_NUMBERS + GOUGH_SIZINGS };
static const double SYNC_EVERY = 1; /* seconds: what a loss of power may cost */

/* An outcome as numbers in the order of the file, the first of which every sweep has; cause and leg stand apart. */
static void outcome_numbers(gough_outcome *o, double *number[MOST_NUMBERS]) {
    double **at = number;
    *at++ = &o->time;
    for (int c = 0; c < 3; c++) *at++ = &o->position[c];
    for (int c = 0; c < 3; c++) *at++ = &o->angles[c];
    for (int c = 0; c < 3; c++) *at++ = &o->velocity[c];
    for (int c = 0; c < 3; c++) *at++ = &o->angular_velocity[c];
    *at++ = &o->position_deviation;
    *at++ = &o->angle_deviation;
    *at++ = &o->force;
    *at++ = &o->speed;
    *at++ = &o->power;
    *at++ = &o->power_least;
    *at++ = &o->power_greatest;
    *at++ = &o->energy;
    *at++ = &o->drift;
    *at++ = &o->rows;
    for (int i = 0; i < GOUGH_SIZINGS; i++) *at++ = &o->sizing[i];
}

static size_t outcome_length(const sweep_head *head) {
    return head->sizing ? MOST_NUMBERS : OUTCOME_NUMBERS;
}

/* run, cause and leg, swept values, outcome, checksum */
size_t sweep_record_size(const sweep_head *head) {
    return 8 * (2 + head->keys + outcome_length(head) + 1);
}

static gough_status fail(const sweep_part *part, gough_error *error, const char *what) {
    return gough_fail(error, GOUGH_ERROR_FILE, "%s: cannot %s: %s",
                      part->path ? part->path : "a temporary file", what, strerror(errno));
}

static bool write_all(int file, const unsigned char *bytes, size_t length) {
    while (length > 0) {
        const ssize_t written = write(file, bytes, length);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return false;
        bytes += written;
        length -= (size_t)written;
    }
    return true;
}

/* Bytes read from a place of a file, fewer only at its end or where it cannot be read. */
static size_t read_at(int file, void *bytes, size_t length, size_t place) {
    size_t used = 0;
    while (used < length) {
        const ssize_t got =
            pread(file, (unsigned char *)bytes + used, length - used, (off_t)(place + used));
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) break;
        used += (size_t)got;
    }
    return used;
}

/* ---- records ----------------------------------------------------------------------------------------------------- */

/* Cause and leg as they are stored: nothing else than a run can leave. */
static bool outcome_possible(const unsigned char *record) {
    uint64_t cause;
    memcpy(&cause, record + 8, 8);
    return cause >> 8 < GOUGH_CAUSES && (cause & 0xff) <= GOUGH_LEGS;
}

static bool record_whole(const sweep_part *part, const unsigned char *record, size_t run) {
    const size_t length = sweep_record_size(part->head) - 8;
    uint64_t number, sum;
    memcpy(&number, record, 8);
    memcpy(&sum, record + length, 8);
    return number == run && sum == sweep_digest(part->seed, record, length) &&
           outcome_possible(record);
}

gough_status sweep_part_add(sweep_part *part, const gough_sweep_row *row, gough_error *error) {
    const size_t keys = part->head->keys, size = sweep_record_size(part->head);
    double *number[MOST_NUMBERS];
    gough_outcome outcome = row->outcome;
    if (part->held + size > sizeof part->buffer) {
        if (!write_all(part->file, part->buffer, part->held)) return fail(part, error, "write");
        part->held = 0;
    }
    unsigned char *at = part->buffer + part->held;
    const uint64_t run = row->run;
    const uint64_t cause = (uint64_t)outcome.cause << 8 | (uint64_t)outcome.leg;
    memcpy(at, &run, 8);
    memcpy(at + 8, &cause, 8);
    memcpy(at + 16, row->value, 8 * keys);
    outcome_numbers(&outcome, number);
    for (size_t i = 0; i < outcome_length(part->head); i++)
        memcpy(at + 16 + 8 * (keys + i), number[i], 8);
    const uint64_t sum = sweep_digest(part->seed, at, size - 8);
    memcpy(at + size - 8, &sum, 8);
    part->held += size;
    part->done++;
    return GOUGH_OK;
}

static double seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

gough_status sweep_part_flush(sweep_part *part, gough_error *error) {
    const size_t held = part->held;
    part->held = 0;
    if (held > 0 && !write_all(part->file, part->buffer, held)) return fail(part, error, "write");
    const double now = seconds();
    if (part->path == NULL || now - part->synced < SYNC_EVERY) return GOUGH_OK;
    part->synced = now;
    return fdatasync(part->file) == 0 ? GOUGH_OK : fail(part, error, "write");
}

size_t sweep_part_get(const sweep_part *part, size_t n, size_t most, void *records) {
    const size_t size = sweep_record_size(part->head), left = part->done - n;
    const size_t wanted = left < most ? left : most;
    const size_t got = read_at(part->file, records, wanted * size, part->length + n * size) / size;
    for (size_t i = 0; i < got; i++)
        if (!record_whole(part, (unsigned char *)records + i * size, part->head->first + n + i))
            return i;
    return got;
}

void sweep_record_take(const sweep_part *part, const void *record, double *value,
                       gough_sweep_row *row) {
    const unsigned char *at = record;
    const size_t keys = part->head->keys;
    double *number[MOST_NUMBERS];
    uint64_t run, cause;
    memcpy(&run, at, 8);
    memcpy(&cause, at + 8, 8);
    memcpy(value, at + 16, 8 * keys);
    outcome_numbers(&row->outcome, number);
    for (size_t i = 0; i < MOST_NUMBERS; i++) *number[i] = NAN;
    for (size_t i = 0; i < outcome_length(part->head); i++)
        memcpy(number[i], at + 16 + 8 * (keys + i), 8);
    row->run = (size_t)run;
    row->value = value;
    row->outcome.cause = (gough_cause)(cause >> 8);
    row->outcome.leg = (int)(cause & 0xff);
}

/* ---- opening ----------------------------------------------------------------------------------------------------- */

/* Counts whole records from the beginning. */
static bool count_records(sweep_part *part) {
    const size_t size = sweep_record_size(part->head), room = sizeof part->buffer / size;
    const size_t wanted = part->head->last + 1 - part->head->first;
    part->done = 0;
    while (part->done < wanted) {
        const size_t got =
            read_at(part->file, part->buffer, room * size, part->length + part->done * size) / size;
        size_t good = 0;
        while (good < got && part->done < wanted &&
               record_whole(part, part->buffer + good * size, part->head->first + part->done)) {
            good++;
            part->done++;
        }
        if (good < room) break;
    }
    return part->done == wanted;
}

/* The name of the part of a result, allocated. */
static char *part_name(const char *path) {
    char *name = NULL;
    return asprintf(&name, "%s.part", path) < 0 ? NULL : name;
}

static int open_nameless(void) {
    const char *folder = getenv("TMPDIR");
    char name[300];
    if (folder == NULL || folder[0] != '/' || strlen(folder) > 200) folder = "/tmp";
    snprintf(name, sizeof name, "%s/gough-sweep-XXXXXX", folder);
    /* the system's own way leaves nothing behind even if a signal comes now */
    int file = open(folder, O_TMPFILE | O_RDWR | O_CLOEXEC | O_EXCL, 0600);
    if (file >= 0) return file;
    file = mkostemp(name, O_CLOEXEC);
    if (file >= 0) unlink(name);
    return file;
}

/* What stands in a file of that name is of this sweep, or a beginning of its head that a crash has cut. */
static gough_status compare_head(sweep_part *part, bool *begun, gough_error *error) {
    unsigned char *there = malloc(part->length);
    if (there == NULL) return gough_fail(error, GOUGH_ERROR_FILE, "out of memory");
    const size_t got = read_at(part->file, there, part->length, 0);
    const bool same = memcmp(there, part->bytes, got) == 0;
    free(there);
    *begun = same && got == part->length;
    if (same) return GOUGH_OK;
    return gough_fail(error, GOUGH_ERROR_INPUT,
                      "%s belongs to a different sweep: its study, settings, values, shard, units "
                      "or version differ, or this build of gough computes different numbers. "
                      "Finish that sweep, or remove the file",
                      part->path);
}

static gough_status lock(sweep_part *part, gough_error *error) {
    if (flock(part->file, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return GOUGH_OK;
    return gough_fail(error, GOUGH_ERROR_INPUT, "%s is in use: the same sweep is already running",
                      part->path);
}

static gough_status go_on(sweep_part *part, gough_error *error) {
    bool begun = false;
    gough_status status = lock(part, error);
    if (status == GOUGH_OK) status = compare_head(part, &begun, error);
    if (status != GOUGH_OK) return status;
    if (begun) count_records(part);
    const size_t size = sweep_record_size(part->head);
    const off_t end = begun ? (off_t)(part->length + part->done * size) : 0;
    if (ftruncate(part->file, end) != 0 || lseek(part->file, end, SEEK_SET) != end)
        return fail(part, error, "write");
    if (!begun && !write_all(part->file, part->bytes, part->length))
        return fail(part, error, "write");
    part->own = true;
    return GOUGH_OK;
}

void sweep_part_forget(const sweep_part *part) {
    if (part->own && part->done == 0 && part->path) unlink(part->path);
}

gough_status sweep_part_open(sweep_part *part, const char *path, sweep_head *head,
                             gough_error *error) {
    *part = (sweep_part){.head = head, .file = -1};
    part->path = path ? part_name(path) : NULL;
    part->bytes = head ? sweep_head_bytes(head, &part->length) : NULL;
    if (part->bytes == NULL || (path && part->path == NULL))
        return gough_fail(error, GOUGH_ERROR_FILE, "out of memory");
    part->seed = sweep_digest(0, part->bytes, part->length);
    part->file =
        path ? open(part->path, O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666) : open_nameless();
    struct stat about;
    if (part->file < 0 || fstat(part->file, &about) != 0) return fail(part, error, "open");
    if (!S_ISREG(about.st_mode))
        return gough_fail(error, GOUGH_ERROR_FILE, "%s: is not a regular file", part->path);
    return go_on(part, error);
}

static gough_status fail_shard(const char *path, gough_error *error, const char *what) {
    return gough_fail(error, GOUGH_ERROR_INPUT, "%s: %s", path, what);
}

gough_status sweep_part_read(sweep_part *part, const char *path, gough_error *error) {
    struct stat about;
    *part = (sweep_part){.path = strdup(path), .file = -1};
    if (part->path == NULL) return gough_fail(error, GOUGH_ERROR_FILE, "out of memory");
    part->file = gough_open_input(path, error);
    if (part->file < 0) return GOUGH_ERROR_FILE;
    if (fstat(part->file, &about) != 0) return fail(part, error, "read");
    if (!S_ISREG(about.st_mode))
        return fail_shard(path, error, "is a pipe; a regular file is needed");
    unsigned char start[SWEEP_START];
    const size_t got = read_at(part->file, start, sizeof start, 0);
    part->length = sweep_head_length(start, got);
    const char *other = part->length == 0 ? gough_input_kind(part->file, GOUGH_INPUT_SHARD) : NULL;
    if (other)
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "%s: is %s; a shard is needed, as `gough sweep --shard` writes", path,
                          other);
    if (part->length == 0 || part->length > (size_t)about.st_size)
        return fail_shard(path, error, "is not a finished shard of gough sweep");
    part->bytes = malloc(part->length);
    if (part->bytes == NULL) return gough_fail(error, GOUGH_ERROR_FILE, "out of memory");
    errno = 0;
    if (read_at(part->file, part->bytes, part->length, 0) == part->length)
        part->head = sweep_head_read(part->bytes, part->length);
    if (part->head == NULL && errno == ENOMEM)
        return gough_fail(error, GOUGH_ERROR_FILE, "out of memory");
    if (part->head == NULL) return fail_shard(path, error, "is damaged");
    part->seed = sweep_digest(0, part->bytes, part->length);
    if (!count_records(part))
        return fail_shard(path, error, "is incomplete or damaged; run its sweep again");
    return GOUGH_OK;
}

void sweep_part_close(sweep_part *part) {
    if (part->file >= 0) close(part->file);
    free((void *)part->path);
    free(part->bytes);
    sweep_head_free(part->head);
    *part = (sweep_part){.file = -1};
}

bool sweep_part_same(const sweep_part *a, const sweep_part *b) {
    const size_t start = SWEEP_IDENTITY; /* behind the numbers of the shard */
    return a->length == b->length && a->head->shards == b->head->shards &&
           memcmp(a->bytes + start, b->bytes + start, a->length - start - 8) == 0;
}
