/* What is wrong with a study, collected with the places, and written as one text at the end.
 *
 *  Columns count characters (code points) from 1, lines end in LF, CR LF or CR. */
#ifndef STUDY_MESSAGES_H
#define STUDY_MESSAGES_H

#include "gough/status.h"
#include "study/arena.h"

/* A text that messages point into: the study, a sample file, or one setting as "key=value". */
typedef struct study_source {
    const char *name; /* "lift.yaml", or "--set control.stiffness" */
    const char *text; /* may hold any bytes; a NUL follows */
    size_t length;
    int rank;     /* messages come by rank, then by offset */
    bool setting; /* its name is the whole place, without line and column */
    size_t lines; /* of the file, before the text */
    size_t bytes; /* likewise */
} study_source;

typedef struct study_place {
    const study_source *source;
    size_t offset;
} study_place;

typedef struct study_message study_message;

typedef struct study_messages {
    study_arena *arena;
    study_message *first, *last;
    size_t count;    /* kept */
    size_t left_out; /* beyond the greatest number kept */
    gough_status
        status; /* GOUGH_ERROR_INPUT as soon as one is about input, else GOUGH_ERROR_FILE */
} study_messages;

/* Adds an error; the status is GOUGH_ERROR_INPUT or GOUGH_ERROR_FILE. */
void study_say(study_messages *messages, gough_status status, study_place place, const char *format,
               ...) __attribute__((format(printf, 4, 5)));

/* The sentence said first, of at least one. */
const char *study_messages_first(const study_messages *messages);

/* The status of a reading and, unless `text` is NULL, the allocated text of all its messages in the order of the files (NULL if
 * there is no message). If there is no memory for the text, *text is NULL and the status is GOUGH_ERROR_FILE. */
gough_status study_messages_end(const study_messages *messages, char **text);

/* Line and column, from 1, of a place. */
void study_place_find(study_place place, size_t *line, size_t *column);

/* Text of the user for a sentence: at most 40 characters, in the form of gough_text_show(). */
const char *study_quote(study_arena *arena, const char *text, size_t length);

/* A whole sentence in that form. */
const char *study_printable(study_arena *arena, const char *sentence);

#endif
