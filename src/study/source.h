/* Bytes of a file, and the guard that stands before the YAML parser. */
#ifndef STUDY_SOURCE_H
#define STUDY_SOURCE_H

#include <stdbool.h>

#include "study/messages.h"

enum { STUDY_MOST_BYTES = 64 * 1024 };

/* Whether a path names a descriptor of the process, such as /dev/stdin or what the shell makes of <(…) */
bool study_is_descriptor(const char *path);

/* Reads a whole file ("-" is standard input) of at most `most` bytes.
 * Returns allocated, terminated text; else NULL and one error about the file at `place`. */
char *study_source_read(study_messages *messages, study_place place, const char *path, size_t most,
                        size_t *length);

/* Opens a record of motion for reading: a regular file of at most `most` bytes that is no JSON, no study and none of the other
 * files that gough writes. -1, with one error at `place`, if it is not. No pipe or device can keep us waiting. */
int study_record_open(study_messages *messages, study_place place, const char *path, size_t most);

/* Whether the text from `begin` may be handed to the YAML parser: at most 64 KiB of UTF-8 without control characters other
 * than tab and line ends, without directives. Says what is wrong if not. */
bool study_source_guard(study_messages *messages, const study_source *source, size_t begin);

#endif
