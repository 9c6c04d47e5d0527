/* A study with other numbers at some of its keys, made again and again: those of a sweep's runs, those of a design. The numbers are
 * written into the tree of the file, and the parts of the model that they touch are built once more, by the same checks and the
 * same code as in reading it. */
#ifndef STUDY_VARIED_H
#define STUDY_VARIED_H

#include "gough/sweep.h"
#include "study/read.h"

/* A number as text, with the least digits that read back as the same: gough_sweep_print(). */
typedef char study_number_text[GOUGH_SWEEP_TEXT];

typedef struct study_varied {
    study_arena arena;
    study_node *root, **target;
    study_number_text *text;
    gough_study *study;
    const char *folder;
    const study_axis *axis;
    size_t axes;
    unsigned touches;
    bool failed; /* the study before: marks of what is wrong stand in the tree */
} study_varied;

/* The parts of a model that these numbers touch. */
unsigned study_axes_touch(const study_axis *axis, size_t axes);

/* Reads the text into a new study. The text and the settings must stay until study_varied_free(). Returns NULL if there is not
 * enough memory. */
study_varied *study_varied_new(const study_source *source, const gough_setting *settings,
                               size_t setting_count, const study_axis *axis, size_t axes);

void study_varied_free(study_varied *varied);

/* The study with these numbers, one for each axis, in the units of the file; as gough_sweep_make(). */
gough_status study_varied_make(study_varied *varied, const double *value, const gough_study **study,
                               gough_error *error);

#endif
