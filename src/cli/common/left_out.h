/* What a linearised loop leaves out of a machine, said to the user. */
#ifndef GOUGH_CLI_LEFT_OUT_H
#define GOUGH_CLI_LEFT_OUT_H

#include <stdio.h>

#include "gough/gough.h"

/* True if the legs have dry friction or losses of a screw. */
bool leaves_out_friction(const gough_model *model);

/* The sentences for it, after an empty line; nothing where nothing is left out. */
void print_left_out_friction(FILE *stream, const gough_model *model);

/* The same where runs include it and only linearised loops leave it out. */
void print_linear_friction(FILE *stream, const gough_model *model);

#endif
