/* Any keys of motion.samples with any bytes as the file: the first line of the input is the inside of the mapping behind `file`,
 * the rest the record. They end in a study with a motion or in messages; and so does the description of the file alone. */
#define _POSIX_C_SOURCE 200809L
#include <math.h>

#include "file.h"
#include "gough/study.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static const char machine[] = "platform: {base: {radius: 1, half_angle: 15}, top: {radius: 0.6, "
                              "half_angle: 15}, height: 1.2}\n"
                              "load: {mass: 1, inertia: [0.08, 0.08, 0.15]}\n"
                              "simulation: {duration: 0.01, output_step: 0.01}\n";

static void read_study(const char *path, const uint8_t *keys, size_t length) {
    char *text = calloc(length + 1000, 1), *messages = NULL;
    gough_study *study = NULL;
    if (!text) abort();
    int used = sprintf(text, "%smotion: {samples: {file: '%s', ", machine, path);
    memcpy(text + used, keys, length);
    used += (int)length + sprintf(text + used + length, "}}\n");
    const gough_status status =
        gough_study_parse("fuzz.yaml", text, (size_t)used, NULL, 0, &study, &messages);
    if ((status == GOUGH_OK) != (study != NULL) || (status == GOUGH_OK) != (messages == NULL))
        abort();
    if (messages && !strstr(messages, "error: ")) abort();
    const gough_samples *samples = study ? &study->model->motion.samples : NULL;
    for (size_t i = 0; samples && i < samples->count; i++)
        if (!isfinite(samples->time[i]) || !isfinite(samples->value[i * GOUGH_COMPONENTS])) abort();
    gough_study_free(study);
    gough_study_free_messages(messages);
    free(text);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char path[100];
    const uint8_t *end = size ? memchr(data, '\n', size) : NULL;
    const size_t keys = end ? (size_t)(end - data) : 0, from = end ? keys + 1 : 0;
    fuzz_file(path, "one", size ? data + from : (const uint8_t *)"", size - from);
    read_study(path, data, keys);
    gough_motion_file *file = NULL;
    char *messages = NULL;
    const gough_status status = gough_motion_file_read(path, &file, &messages);
    if ((status == GOUGH_OK) != (file != NULL) || (status == GOUGH_OK) != (messages == NULL))
        abort();
    if (file && (!file->mapping || file->rows > size)) abort();
    gough_motion_file_free(file);
    gough_study_free_messages(messages);
    return 0;
}
