/* Any bytes as a study: they end in a model or in messages. Text after a first line that begins with "#set " goes in as settings
 * too, so that overrides are tried with odd keys and values. */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "gough/sweep.h"

/* The same bytes as a design: its text with other numbers, if there is one, is a design again. */
static void try_design(const char *text, size_t size, const gough_setting *setting, size_t settings,
                       const gough_study *study) {
    gough_design_study *design = NULL, *again = NULL;
    char *messages = NULL;
    gough_error error = {.message = ""};
    gough_design_request request;
    const char *written = NULL;
    const gough_status status =
        gough_design_study_parse("fuzz.yaml", text, size, setting, settings, &design, &messages);
    if ((status == GOUGH_OK) != (design != NULL) || (status == GOUGH_OK) != (messages == NULL))
        abort();
    if (status == GOUGH_OK && !study) abort();
    gough_study_free_messages(messages);
    if (design) {
        (void)gough_design_study_request(design, &request, sizeof request);
        if (gough_design_study_text(design, request.least, &written, &error) == GOUGH_OK &&
            gough_design_study_parse("fuzz.yaml", written, strlen(written), NULL, 0, &again,
                                     NULL) != GOUGH_OK)
            abort();
        if (!written && !error.message[0]) abort();
    }
    gough_design_study_free(again);
    gough_design_study_free(design);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* "#set key=value" at the start as a setting; false where there is none. */
static int first_line_setting(const char *text, size_t size, char line[200],
                              gough_setting *setting) {
    const char *end = size > 5 && memcmp(text, "#set ", 5) == 0 ? memchr(text, '\n', size) : NULL;
    if (!end || end - text > 200) return 0;
    memcpy(line, text + 5, (size_t)(end - text - 5));
    line[end - text - 5] = '\0';
    char *equals = strchr(line, '=');
    if (!equals) return 0;
    *equals = '\0';
    *setting = (gough_setting){line, equals + 1};
    return 1;
}

/* The same bytes as a sweep: an error of the study is one of it too, and its first and last runs can be asked for. */
static void try_sweep(const char *text, size_t size, const gough_setting *setting, size_t settings,
                      const gough_study *study) {
    gough_sweep *sweep = NULL;
    char *messages = NULL;
    const gough_status status =
        gough_sweep_parse("fuzz.yaml", text, size, setting, settings, &sweep, &messages);
    if ((status == GOUGH_OK) != (sweep != NULL) || (status == GOUGH_OK) != (messages == NULL))
        abort();
    if (status == GOUGH_OK && (!study || !study->swept)) abort();
    gough_study_free_messages(messages);
    gough_sweep_maker *maker = sweep ? gough_sweep_maker_new(sweep) : NULL;
    for (int i = 0; maker && i < 2; i++) {
        const gough_study *made;
        gough_error error = {.message = ""};
        const size_t run = i ? gough_sweep_runs(sweep) : 1;
        if (gough_sweep_make(maker, run, &made, &error) != GOUGH_OK && !error.message[0]) abort();
    }
    gough_sweep_maker_free(maker);
    gough_sweep_free(sweep);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    gough_study *study = NULL;
    char *messages = NULL, line[200];
    gough_setting setting;
    const char *text = (const char *)data;
    const size_t settings = (size_t)first_line_setting(text, size, line, &setting);
    const gough_status status =
        gough_study_parse("fuzz.yaml", text, size, &setting, settings, &study, &messages);
    if ((status == GOUGH_OK) != (study != NULL) || (status == GOUGH_OK) != (messages == NULL))
        abort();
    if (messages && !strstr(messages, "error: ")) abort();
    try_sweep(text, size, &setting, settings, study);
    try_design(text, size, &setting, settings, study);
    gough_study_free(study);
    gough_study_free_messages(messages);
    return 0;
}
