/* Any doubles as a flat model: they end in a model that runs and can be written down again, or in a message. */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "gough/simulate.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static int few(void *context, const gough_row *row) {
    (void)row;
    return ++*(int *)context > 4;
}

/* a few steps, as the options that came along may ask for days */
static void run(const gough_model *model) {
    gough_simulation s = gough_simulation_default();
    gough_end end;
    int rows = 0;
    s.duration = 0.2;
    s.method = GOUGH_RK4;
    s.step = 0.05;
    gough_simulate(model, &s, few, &rows, &end, NULL);
}

/* What was read, written down once more, is read as the same again: an inertia symmetric but for round-off is evened out once. */
static void settle(const gough_model *model, const gough_simulation *simulation, size_t count,
                   size_t bytes) {
    double *once = malloc(count * sizeof *once), *twice = malloc(count * sizeof *twice);
    gough_model *other = malloc(sizeof *other);
    void *memory = malloc(bytes + 1);
    gough_simulation options;
    if (once == NULL || twice == NULL || other == NULL || memory == NULL) abort();

    if (gough_model_flat_size(model) != count) abort();
    gough_model_flatten(model, simulation, once);
    if (gough_model_unflatten(other, &options, memory, once, count, NULL) != GOUGH_OK) abort();
    gough_model_flatten(other, &options, twice);
    if (memcmp(once, twice, count * sizeof *once) != 0) abort();

    free(memory);
    free(other);
    free(twice);
    free(once);
}

/* The number of the format in the head changes with the table of fields. A 0 in its place means the format of this build, so
 * that the rest is read too. The corpus is what tests/web/flat.c writes for the studies in tests/digest, with this 0. */
static double own_format(void) {
    gough_model *empty = calloc(1, sizeof *empty);
    const gough_simulation any = gough_simulation_default();
    if (empty == NULL) abort();
    double *flat = malloc(gough_model_flat_size(empty) * sizeof *flat);
    if (flat == NULL) abort();
    gough_model_flatten(empty, &any, flat);
    const double format = flat[0];
    free(flat);
    free(empty);
    return format;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    const size_t count = size / sizeof(double);
    double *flat = malloc(count * sizeof(double) + 1);
    gough_model *model = malloc(sizeof *model);
    gough_simulation simulation;
    gough_error error = {.message = ""};
    if (flat == NULL || model == NULL) abort();
    memcpy(flat, data, count * sizeof(double));
    if (count > 0 && !(flat[0] < 0) && !(flat[0] > 0)) flat[0] = own_format();

    const size_t bytes = gough_model_flat_memory(flat, count);
    if (bytes > 2 * size + GOUGH_EXTERNALS * sizeof(gough_external)) abort();
    void *memory = malloc(bytes + 1);
    if (memory == NULL) abort();
    const gough_status status =
        gough_model_unflatten(model, &simulation, memory, flat, count, &error);
    if (status != GOUGH_OK && error.message[0] == '\0') abort();
    if (status == GOUGH_OK) {
        settle(model, &simulation, count, bytes);
        run(model);
    }
    free(memory);
    free(model);
    free(flat);
    return 0;
}
