/* Keys of the study file: the table of fields as the reader asks it. */
#ifndef STUDY_KEYS_H
#define STUDY_KEYS_H

#include <stdbool.h>

#include "gough/study.h"

bool study_key_required(const gough_key *key);

/* "a number", "six points [x, y, z]", …: for "must be …". */
const char *study_shape_phrase(gough_shape shape);

/* The key `name` in the mapping of path `parent` ("" at the root). NULL if the table has no such key. */
const gough_key *study_key_find(const char *parent, const char *name);

/* True if the key is directly in the mapping of path `parent`; its name there is then *name. */
bool study_key_in(const gough_key *key, const char *parent, const char **name);

/* The known name nearest to a misspelled one; NULL if none is near. */
const char *study_nearest(const char *word, const char *const *names, size_t count);

#endif
