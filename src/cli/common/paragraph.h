/* Sentences in lines of at most 100 columns. */
#ifndef GOUGH_CLI_PARAGRAPH_H
#define GOUGH_CLI_PARAGRAPH_H

#include <stdio.h>

/* Prints a formatted text, broken at blanks: the first line begins with `label`, padded to `indent` columns, the following ones
 * with as many blanks. Ends the last line. At most 2000 bytes of text. */
void print_paragraph(FILE *stream, const char *label, int indent, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* The columns that a text takes in a terminal. */
int text_columns(const char *text);

#endif
