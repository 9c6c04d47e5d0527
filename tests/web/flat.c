/* Reads a study file and writes its flat model, as raw doubles, to standard output: what the tests give to the page's core. */
#include <stdio.h>
#include <stdlib.h>

#include "gough/study.h"

int main(int count, char **words) {
    gough_study *study = NULL;
    char *messages = NULL;
    gough_status status;
    size_t doubles;
    double *flat;

    if (count != 2) {
        fprintf(stderr, "usage: %s STUDY\n", words[0]);
        return GOUGH_ERROR_INPUT;
    }
    status = gough_study_read(words[1], NULL, 0, &study, &messages);
    if (messages) fprintf(stderr, "%s", messages);
    gough_study_free_messages(messages);
    if (status != GOUGH_OK) return (int)status;

    doubles = gough_model_flat_size(study->model);
    flat = malloc(doubles * sizeof *flat);
    if (flat == NULL) return GOUGH_ERROR_FILE;
    gough_model_flatten(study->model, &study->simulation, flat);
    if (fwrite(flat, sizeof *flat, doubles, stdout) != doubles) status = GOUGH_ERROR_FILE;
    free(flat);
    gough_study_free(study);
    return (int)status;
}
