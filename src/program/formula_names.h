/* The names that a formula may use. Private to src/model. */
#ifndef GOUGH_PROGRAM_FORMULA_NAMES_H
#define GOUGH_PROGRAM_FORMULA_NAMES_H

#include <stddef.h>

typedef struct gough_word_ {
    const char *name;
    int code;         /* formula_code of program.h */
    int arguments;    /* 0: a value */
    const char *form; /* how it is written */
} gough_word_;

/* The word with this name, or NULL. */
const gough_word_ *gough_find_word_(const char *name, size_t length);

/* The word of this code, or NULL. */
const gough_word_ *gough_word_of_(int code);

/* What may have been meant by an unknown name, to be appended to a sentence: ": did you mean
 * 'sin'?", or "". */
void gough_word_hint_(const char *name, size_t length, char hint[80]);

#endif
