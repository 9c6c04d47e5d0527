/* Which sweep a file of records belongs to: everything that its numbers depend on, as bytes that are compared. */
#define _GNU_SOURCE
#include <stdlib.h>
#include <string.h>

#include "gough/sizes.h"
#include "gough/version.h"
#include "sweep/sweep_bytes.h"
#include "sweep/sweep_identity.h"
#include "sweep/sweep_part.h"
#include "table/table.h"

static uint64_t digest(uint64_t sum, const void *bytes, size_t length) {
    const unsigned char *at = bytes;
    for (size_t i = 0; i < length; i++) sum = (sum ^ at[i]) * 0x100000001b3u;
    return sum;
}

/* Recorded motion stands in another file, which may change while the study does not. */
static uint64_t digest_samples(const gough_motion *motion) {
    const gough_samples *s = &motion->samples;
    uint64_t sum = 0xcbf29ce484222325u;
    if (motion->kind != GOUGH_MOTION_SAMPLES) return 0;
    sum = digest(sum, s->axes, sizeof s->axes);
    sum = digest(sum, s->time, s->count * sizeof *s->time);
    return digest(sum, s->value, s->count * GOUGH_COMPONENTS * sizeof *s->value);
}

static char *join_settings(const gough_sweep *sweep) {
    size_t count, length = 0;
    char *text = NULL;
    const gough_setting *setting = gough_sweep_settings(sweep, &count);
    FILE *stream = open_memstream(&text, &length);
    if (stream == NULL) return NULL;
    for (size_t i = 0; i < count; i++) fprintf(stream, "%s=%s\n", setting[i].key, setting[i].value);
    if (fclose(stream) == 0) return text;
    free(text);
    return NULL;
}

sweep_head *sweep_head_of(const gough_sweep *sweep, const gough_sweep_options *options,
                          const gough_units *units, size_t shard, size_t shards) {
    sweep_head *head = calloc(1, sizeof *head);
    if (head == NULL) return NULL;
    const gough_study *study = gough_sweep_study(sweep);
    size_t keys = 0;
    const gough_sweep_key *key = gough_sweep_keys(sweep, &keys);
    head->runs = gough_sweep_runs(sweep);
    head->shard = shards > 0 ? shard : 1;
    head->shards = shards > 0 ? shards : 1;
    /* i runs/n without overflow: at most 1e8 runs, and as many shards */
    head->first = (head->shard - 1) * head->runs / head->shards + 1;
    head->last = head->shard * head->runs / head->shards;
    head->units = *units;
    head->base_radius = study->model->machine.base_radius;
    head->gravity = study->model->machine.gravity_magnitude;
    head->own = study->units;
    head->samples = digest_samples(&study->model->motion);
    head->sizing = options->sizing;
    head->forces = options->forces;
    head->numerics = sweep_numerics_digest(study, head->forces);
    head->title = strdup(study->title);
    head->study = strdup(study->text);
    head->settings = join_settings(sweep);
    head->version = strdup(GOUGH_VERSION);
    head->path = calloc(keys, sizeof *head->path);
    head->label = calloc(keys, sizeof *head->label);
    double *value = calloc(keys, sizeof *value);
    if (value) head->plan = sweep_plan_digest(sweep, value);
    if (head->path && head->label) head->keys = keys;
    bool good =
        value && head->title && head->study && head->settings && head->version && head->keys > 0;
    for (size_t k = 0; k < head->keys; k++) {
        head->path[k] = strdup(key[k].path);
        head->label[k] = strdup(gough_unit_label(&head->own, gough_unit_of_field(key[k].unit)));
        good = good && head->path[k] && head->label[k];
    }
    free(value);
    if (good) return head;
    sweep_head_free(head);
    return NULL;
}

uint64_t gough_sweep_identity(const gough_sweep *sweep, const gough_sweep_options *options) {
    const gough_units units = gough_units_si();
    size_t length;
    if (gough_size_check(options->size, sizeof *options, "gough_sweep_options", NULL) != GOUGH_OK)
        return 0;
    sweep_head *head = sweep_head_of(sweep, options, &units, 0, 0);
    unsigned char *bytes = head ? sweep_head_bytes(head, &length) : NULL;
    /* without the checksum at its end, behind which a digest of the whole is 0 */
    const uint64_t sum = bytes ? sweep_digest(0, bytes, length - 8) : 0;
    const bool made = bytes != NULL;
    sweep_head_free(head);
    free(bytes);
    return made && sum == 0 ? 1 : sum; /* unreachable: a sum that is 0 by chance */
}

void sweep_head_free(sweep_head *head) {
    if (head == NULL) return;
    for (size_t k = 0; k < head->keys; k++) {
        free((void *)head->path[k]);
        free((void *)head->label[k]);
    }
    free(head->path);
    free(head->label);
    free((void *)head->title);
    free((void *)head->study);
    free((void *)head->settings);
    free((void *)head->version);
    free(head);
}
