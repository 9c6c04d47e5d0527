/* Messages on standard error, and text of users in any message or summary. */
#ifndef GOUGH_CLI_TALK_H
#define GOUGH_CLI_TALK_H

#include <argp.h>
#include <jansson.h>
#include <stdbool.h>
#include <stdio.h>

#include "gough/gough.h"

/* A line with text of the user in it, such as a title or the name of a file: as gough_text_show() has it, so that no byte of it
 * can drive a terminal. */
void print_line(FILE *stream, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* Prints the title of a study on a line of its own, or nothing if the title is NULL or "". */
void print_title(FILE *stream, const char *title);
/* Ends the process with a sentence about the command line, how to ask for help, and exit code 2: "gough VERB: error: …". */
void usage_error(const struct argp_state *state, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
/* From here on messages are lines of JSON on standard error: {"error": {"message": …, "verb": …}}; or "warning", or "remark". */
void talk_in_json(void);
bool talks_in_json(void);
/* Writes such a line of this kind; takes over the object. */
void say_json(const char *kind, const char *verb, json_t *what);
/* "gough VERB: error: …"; texts of the user likewise */
void complain(const char *verb, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* The same about a file, or a place of one: "gough VERB: error: own.yaml:12:10: …" */
void complain_at(const char *verb, const char *place, const char *sentence);
/* "own.yaml:12:10", the place of the key that a sentence begins with, to be freed; NULL: the study does not give it */
char *place_of(const gough_study *study, const char *sentence);
/* The same of a sentence about a study: "gough VERB: error: own.yaml:12:10: …" with the place of the key that it begins with, or
 * else the name of the study. */
void complain_of(const char *verb, const gough_study *study, gough_error *error);
/* "gough VERB: …" */
void remark(const char *verb, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* whether colours may be used on a stream */
bool colourful(FILE *stream);
/* the candidate nearest to a misspelled word; NULL if none is near */
const char *nearest_word(const char *word, const char *const *candidate, size_t count);

#endif
