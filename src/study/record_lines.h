/* The lines of a record, one after the other: from a file, of which only a piece is in memory, or from a text. */
#ifndef STUDY_RECORD_LINES_H
#define STUDY_RECORD_LINES_H

#include <stdbool.h>

#include "gough/text.h"
#include "study/messages.h"

typedef struct study_lines {
    study_messages *messages;
    const char *name; /* of the file, in messages */
    int file;         /* -1: the text is all there is */
    char *buffer;     /* of a file; freed by study_lines_end() */
    size_t capacity;
    gough_piece rest;  /* what was read and not taken */
    bool ended;        /* there is nothing behind it */
    study_source *own; /* of a file: the place of errors about all of it */
    bool broken;       /* the file cannot be read, or a line is too long; the error is said */
    gough_piece line;  /* the line that was taken last, without a byte-order mark */
    const char *begin; /* its first byte, which may be that of the mark */
    bool closed;       /* it has an end of line */
    size_t number;     /* its number, from 1; 0: none was taken */
    size_t offset;     /* of its first byte in the file */
    size_t taken;      /* bytes of all lines that were taken */
    const study_source *kept; /* a copy of it, if an error is about it */
    size_t kept_number;
} study_lines;

/* Both without lines taken. A file is read from its start. */
study_lines study_lines_of_text(study_messages *messages, const char *name, const char *text,
                                size_t length);
study_lines study_lines_of_file(study_messages *messages, const char *name, int file);

/* Takes the next line into `line`; false after the last. */
bool study_lines_next(study_lines *lines);

/* The first line is the next again. */
void study_lines_again(study_lines *lines);

/* Lines from the next to the last. */
size_t study_lines_count(study_lines *lines);

void study_lines_end(study_lines *lines);

/* A place in the line that was taken last; it lasts as long as the arena. */
study_place study_lines_place(study_lines *lines, const char *at);

/* The place behind all of the text, once it is taken. */
study_place study_lines_last_place(study_lines *lines);

#endif
