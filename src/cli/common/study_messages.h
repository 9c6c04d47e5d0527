/* Messages about study files, as their reader writes them: for a person, or for a program that asked for JSON. */
#ifndef GOUGH_CLI_STUDY_MESSAGES_H
#define GOUGH_CLI_STUDY_MESSAGES_H

#include <jansson.h>

/* Prints the messages of gough_study_read() and its like on standard error and frees them. NULL stands for no messages. */
void say_study_messages(const char *verb, char *messages);

/* The length of the place "file:line:column" with which a sentence begins, before ": "; 0 if it does not begin with a place. */
size_t leading_place(const char *sentence);

/* A text of the user as a JSON string; where it is not UTF-8, as gough_text_show() has it. */
json_t *json_shown(const char *text, size_t length);

/* Adds the members of a place: "file", "line" and "column" of "own.yaml:12:10", "setting" of "--set load.mass", else "file". */
void json_set_place(json_t *object, const char *place, size_t length);

#endif
