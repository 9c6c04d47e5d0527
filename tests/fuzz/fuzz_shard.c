/* Any bytes as a shard of a sweep and as the part of one under way, with their checksums repaired so that their contents are read:
 * they are read and merged, continued, or refused with a message. */
#define _POSIX_C_SOURCE 200809L
#include "file.h"
#include "sweep/sweep_bytes.h"
#include "sweep/sweep_part.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void put(unsigned char *at, uint64_t number) { memcpy(at, &number, 8); }

/* Magic number, length and checksum of the head, then number and checksum of each record. Returns the length of the head. */
static size_t repair(unsigned char *bytes, size_t size) {
    const uint64_t magic = 0x677377656570010au;
    uint64_t rest, first = 1;
    if (size < SWEEP_START + 8) return 0;
    put(bytes, magic);
    memcpy(&rest, bytes + SWEEP_IDENTITY, 8);
    if (rest > size - SWEEP_START - 8) rest = size - SWEEP_START - 8;
    put(bytes + SWEEP_IDENTITY, rest);
    const size_t length = SWEEP_START + (size_t)rest + 8;
    put(bytes + length - 8, sweep_digest(0, bytes, length - 8));
    sweep_head *head = sweep_head_read(bytes, length);
    if (!head) return length;
    const size_t record = sweep_record_size(head);
    first = head->first;
    for (size_t at = length, run = 0; size - at >= record; at += record, run++) {
        put(bytes + at, first + run);
        put(bytes + at + record - 8,
            sweep_digest(sweep_digest(0, bytes, length), bytes + at, record - 8));
    }
    sweep_head_free(head);
    return length;
}

/* Reads all records of a shard. */
static void read_shard(const char *path) {
    sweep_part part;
    gough_error error = {0};
    const gough_status status = sweep_part_read(&part, path, &error);
    if (status != GOUGH_OK && !error.message[0]) abort();
    if (status == GOUGH_OK) {
        const size_t size = sweep_record_size(part.head);
        unsigned char *records = malloc(8 * size);
        double *value = malloc((part.head->keys + 1) * sizeof *value);
        if (!records || !value) abort();
        for (size_t n = 0, got = 1; n < part.done && got > 0; n += got) {
            got = sweep_part_get(&part, n, 8, records);
            for (size_t i = 0; i < got; i++) {
                gough_sweep_row row = {.value = value};
                sweep_record_take(&part, records + i * size, value, &row);
                if (!gough_cause_name(row.outcome.cause)) abort();
            }
        }
        free(value);
        free(records);
    }
    sweep_part_close(&part);
}

/* Goes on with a part that is of the sweep in its own head. */
static void go_on(const unsigned char *bytes, size_t size, size_t length) {
    char path[100], named[100];
    sweep_part part;
    gough_error error = {0};
    sweep_head *head = length ? sweep_head_read(bytes, length) : NULL;
    if (!head) return;
    fuzz_file(path, "one.part", bytes, size);
    const gough_status status =
        sweep_part_open(&part, fuzz_file(named, "one", NULL, 0), head, &error);
    if (status != GOUGH_OK && !error.message[0]) abort();
    if (status == GOUGH_OK && part.done > part.head->last + 1 - part.head->first) abort();
    sweep_part_forget(&part);
    sweep_part_close(&part);
}

static void merge(const char *shard) {
    char out[100];
    const char *const shards[] = {shard, shard};
    gough_error error = {0};
    fuzz_file(out, "out.csv", NULL, 0);
    for (size_t count = 1; count <= 2; count++) {
        gough_sweep_summary summary;
        error.message[0] = '\0';
        const gough_status status = gough_sweep_merge(shards, count, out, &summary, &error);
        if (status != GOUGH_OK && !error.message[0]) abort();
        if (status != GOUGH_OK && access(out, F_OK) == 0) abort();
        unlink(out);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    unsigned char *bytes = malloc(size + 1);
    char path[100];
    if (!bytes) abort();
    memcpy(bytes, data, size);
    read_shard(fuzz_file(path, "one", bytes, size)); /* as it is */
    const size_t length = repair(bytes, size);
    fuzz_file(path, "one", bytes, size);
    read_shard(path);
    merge(path);
    fuzz_forget();
    go_on(bytes, size, length);
    fuzz_forget();
    free(bytes);
    return 0;
}
