/* Any bytes as a file of recorded motion: they end in a spline or in messages. */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "study/samples.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    study_arena arena = {NULL, false};
    study_messages messages = {.arena = &arena};
    gough_samples samples = {.count = 0};
    static const study_smoothing kinds[] = {
        {.kind = STUDY_AS_RECORDED},
        {.kind = STUDY_SMOOTH_ROUNDING},
        {.kind = STUDY_SMOOTH_DEVIATIONS, .deviation = {0.1, 0.1, 0.1, 0.1, 0.1, 0.1}},
        {.kind = STUDY_SMOOTH_CUTOFF, .cutoff = 1}};
    static gough_record record;
    study_recording recording = {.smoothing = kinds[size % 4],
                                 .units = gough_units_si(),
                                 .keys = study_record_keys_none(NULL, GOUGH_ZYX),
                                 .file = "fuzz.csv",
                                 .record = &record,
                                 .samples = &samples};
    const char *text = study_arena_copy(&arena, (const char *)data, size);
    const study_source source = {"fuzz.csv", text, size, 0, false, 0, 0};
    if (!text) return 0;
    study_samples_parse(&messages, &source, &recording);
    void *memory = recording.memory;
    if ((memory == NULL) != (messages.count > 0) || (memory && samples.count < 2)) abort();
    char *written = NULL;
    study_messages_end(&messages, &written);
    if ((messages.count > 0) != (written != NULL) || (written && !strstr(written, "error: ")))
        abort();
    free(written);
    free(memory);
    study_arena_free(&arena);
    return 0;
}
