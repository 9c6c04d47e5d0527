/* What the tests of this room share: reading texts, and what was said about them. */
#ifndef TESTS_STUDY_HELPERS_H
#define TESTS_STUDY_HELPERS_H

#include "gough/study.h"

/* A study of seven lines with nothing wrong, to which lines are added. */
extern const char *const good_study;

typedef struct reading {
    gough_status status;
    gough_study *study;
    char *messages;
} reading;

/* Reads "study.yaml" of these bytes with `key=value` settings, a list ended by NULL (or NULL for none). */
reading read_bytes(const char *text, size_t length, const char *const settings[]);
#define SETTINGS(...) ((const char *const[]){__VA_ARGS__, NULL})

/* The good study and more lines. */
reading read_more(const char *more, const char *const settings[]);

void reading_free(reading *made);

/* Expects an error in input whose whole text is this. */
void expect_messages(const char *text, const char *const settings[], const char *messages);

/* Expects an error in input with this in its text. */
void expect_said(const char *text, const char *part);

/* Expects the good study with these lines to be right; the caller frees it. */
reading expect_good(const char *more, const char *const settings[]);

/* How often part occurs in text. */
int occurrences(const char *text, const char *part);

/* Makes a locale with a decimal comma, once a program before the tests; the program ends where that is impossible. */
void make_comma_locale(void);
void forget_comma_locale(void);

void use_comma_locale(void);
void use_plain_locale(void);

/* A new file in a folder of its own; free with forget_file(). */
char *write_file(const char *name, const char *text, size_t length);
void forget_file(char *path);

#endif
