/* A sweep into a file: runs done go to the append-only part, and from there to the table when all are done; shards stay records
 * until they are merged. */
#define _POSIX_C_SOURCE 200809L
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "gough/sizes.h"
#include "sweep/sweep_table.h"
#include "table/table.h"

static bool ends_in(const char *path, const char *ending) {
    const size_t length = strlen(path), tail = strlen(ending);
    return length > tail && strcasecmp(path + length - tail, ending) == 0;
}

static gough_status check_table(const char *path, gough_error *error) {
    if (!path || strcmp(path, "-") == 0 || ends_in(path, ".csv") || ends_in(path, ".h5"))
        return GOUGH_OK;
    return gough_fail(error, GOUGH_ERROR_INPUT,
                      "%s: the name must end in .h5 (HDF5) or .csv, or be - for CSV on standard "
                      "output",
                      path);
}

static gough_status check_path(const gough_sweep_output *output, gough_error *error) {
    if (output->shards == 0) {
        gough_status status = check_table(output->path, error);
        for (size_t i = 0; i < output->also_count && status == GOUGH_OK; i++)
            status = check_table(output->also[i], error);
        return status;
    }
    if (output->shard < 1 || output->shard > output->shards || output->shards > 100000000)
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "there is no shard %zu of %zu; shards are numbered from 1", output->shard,
                          output->shards);
    if (!output->path || !ends_in(output->path, ".shard") || output->also_count > 0)
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "a shard is written to one file, whose name ends in .shard; `gough "
                          "merge` joins all shards into a table");
    return GOUGH_OK;
}

/* ---- running ------------------------------------------------------------------------------------------------------ */

typedef struct recording {
    sweep_part *part;
    const gough_sweep_options *options;
    size_t resumed;
    gough_error error;
    gough_status status;
} recording;

static int record(void *context, const gough_sweep_row *row) {
    recording *r = context;
    r->status = sweep_part_add(r->part, row, &r->error);
    return r->status != GOUGH_OK;
}

/* Between two looks: what came since goes to the file. */
static int report(void *context, size_t done) {
    recording *r = context;
    r->status = sweep_part_flush(r->part, &r->error);
    if (r->status != GOUGH_OK) return 1;
    return r->options->progress ? r->options->progress(r->options->context, r->resumed + done) : 0;
}

static gough_status run_rest(const gough_sweep *sweep, const gough_sweep_options *options,
                             const gough_sweep_output *output, sweep_part *part,
                             gough_error *error) {
    recording r = {part, options, part->done, {.message = ""}, GOUGH_OK};
    gough_sweep_options own = *options;
    own.first = part->head->first + part->done;
    own.last = part->head->last;
    own.progress = report;
    own.context = &r;
    if (own.first > own.last) return GOUGH_OK;
    gough_status status =
        output->runner ? output->runner(output->runner_context, sweep, &own, record, &r, error)
                       : gough_sweep_run(sweep, &own, record, &r, error);
    if (r.status == GOUGH_OK) r.status = sweep_part_flush(part, &r.error);
    if (r.status != GOUGH_OK) status = gough_fail(error, r.status, "%s", r.error.message);
    return status;
}

/* The part becomes the shard, synced before it has the name. */
static gough_status finish_shard(sweep_part *part, const char *path, gough_error *error) {
    if (fsync(part->file) == 0 && rename(part->path, path) == 0) return GOUGH_OK;
    return gough_fail(error, GOUGH_ERROR_FILE, "%s: cannot finish: %s", path, strerror(errno));
}

static gough_status run_into(const gough_sweep *sweep, const gough_sweep_options *options,
                             const gough_sweep_output *output, sweep_part *part,
                             gough_sweep_summary *summary, gough_error *error) {
    const size_t resumed = part->done;
    const gough_status status = run_rest(sweep, options, output, part, error);
    gough_error ignored;
    const gough_status summed = sweep_table_sum(part, 1, summary, status ? &ignored : error);
    summary->resumed = resumed;
    if (status != GOUGH_OK || summed != GOUGH_OK) return status != GOUGH_OK ? status : summed;
    if (output->shards > 0) return finish_shard(part, output->path, error);
    gough_status written = GOUGH_OK;
    if (output->path) written = sweep_table_write(part, 1, output->path, error);
    for (size_t i = 0; i < output->also_count && written == GOUGH_OK; i++)
        written = sweep_table_write(part, 1, output->also[i], error);
    if (written == GOUGH_OK && part->path) unlink(part->path);
    return written;
}

gough_status gough_sweep_write(const gough_sweep *sweep, const gough_sweep_options *options,
                               const gough_sweep_output *output, gough_sweep_summary *summary,
                               gough_error *error) {
    gough_units units;
    *summary = (gough_sweep_summary){.runs = 0};
    gough_status status =
        gough_size_check(options->size, sizeof(gough_sweep_options), "gough_sweep_options", error);
    if (status == GOUGH_OK) status = check_path(output, error);
    if (status == GOUGH_OK)
        status =
            gough_units_of_study(gough_sweep_study(sweep), output->dimensionless, &units, error);
    if (status != GOUGH_OK) return status;
    const char *path = output->path && strcmp(output->path, "-") != 0 ? output->path : NULL;
    sweep_part *part = malloc(sizeof *part);
    if (part == NULL) return gough_fail(error, GOUGH_ERROR_FILE, "out of memory");
    sweep_head *head = sweep_head_of(sweep, options, &units, output->shard, output->shards);
    status = sweep_part_open(part, path, head, error);
    if (status == GOUGH_OK) status = run_into(sweep, options, output, part, summary, error);
    if (status != GOUGH_OK) sweep_part_forget(part);
    sweep_part_close(part);
    free(part);
    return status;
}

/* ---- merging ------------------------------------------------------------------------------------------------------ */

static int by_number(const void *left, const void *right) {
    const sweep_part *a = left, *b = right;
    return (a->head->shard > b->head->shard) - (a->head->shard < b->head->shard);
}

static gough_status check_set(const sweep_part *part, size_t count, gough_error *error) {
    for (size_t i = 1; i < count; i++) {
        if (!sweep_part_same(&part[0], &part[i]))
            return gough_fail(error, GOUGH_ERROR_INPUT, "%s and %s are not from the same sweep",
                              part[0].path, part[i].path);
        if (part[i].head->shard == part[i - 1].head->shard)
            return gough_fail(error, GOUGH_ERROR_INPUT, "%s and %s are the same shard, %zu of %zu",
                              part[i - 1].path, part[i].path, (size_t)part[i].head->shard,
                              (size_t)part[i].head->shards);
    }
    for (size_t i = 0; i < part[0].head->shards; i++)
        if (i == count || part[i].head->shard != i + 1)
            return gough_fail(error, GOUGH_ERROR_INPUT, "shard %zu of %zu is missing", i + 1,
                              (size_t)part[0].head->shards);
    return GOUGH_OK;
}

gough_status gough_sweep_merge(const char *const *shard, size_t count, const char *path,
                               gough_sweep_summary *summary, gough_error *error) {
    const gough_sweep_output output = {.path = path};
    gough_status status = check_path(&output, error);
    *summary = (gough_sweep_summary){.runs = 0};
    if (status != GOUGH_OK) return status;
    if (count == 0) return gough_fail(error, GOUGH_ERROR_INPUT, "no shard to merge");
    sweep_part *part = calloc(count, sizeof *part);
    if (part == NULL) return gough_fail(error, GOUGH_ERROR_FILE, "out of memory");
    size_t open = 0;
    while (open < count && status == GOUGH_OK)
        status = sweep_part_read(&part[open], shard[open], error), open++;
    if (status == GOUGH_OK) {
        qsort(part, count, sizeof *part, by_number);
        status = check_set(part, count, error);
    }
    if (status == GOUGH_OK) status = sweep_table_sum(part, count, summary, error);
    if (status == GOUGH_OK && path) status = sweep_table_write(part, count, path, error);
    for (size_t i = 0; i < open; i++) sweep_part_close(&part[i]);
    free(part);
    return status;
}
