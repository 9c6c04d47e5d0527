/* Warnings about a control loop whose parts do not go together. */
#ifndef GOUGH_CLI_LOOP_WARNINGS_H
#define GOUGH_CLI_LOOP_WARNINGS_H

#include "gough/gough.h"

/* Says them on standard error, one line each, in the study's units. */
void loop_warnings(const char *verb, const gough_study *study);

#endif
