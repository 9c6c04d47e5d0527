/* Messages about study files, as their reader writes them: for a person, or for a program that asked for JSON. */
#ifndef GOUGH_CLI_STUDY_MESSAGES_H
#define GOUGH_CLI_STUDY_MESSAGES_H

#include <jansson.h>

/* Prints the messages of gough_study_read() and its like on standard error and frees them; NULL: there are none. */
void say_study_messages(const char *verb, char *messages);

/* The length of the place "file:line:column" with which a sentence begins, before ": "; 0: it begins with none. */
size_t leading_place(const char *sentence);

/* Adds the members of a place: "file", "line" and "column" of "own.yaml:12:10", "setting" of "--set load.mass", else "file". */
void json_set_place(json_t *object, const char *place, size_t length);

#endif
