/* What a linearised loop leaves out of a machine, and what the feed-forward ignores of it, said to the user. */
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

/* What the machine has and the feed-forward ignores, such as "the legs' mass and the external loads"; empty if nothing.
 * In a program that does not move, viscous friction does not count. Whether anything is fed forward is not asked. */
typedef struct {
    char text[96];
} ignored_words;

ignored_words words_of_ignored(const gough_model *model, bool moving);

/* "Without feed-forward", or "With feed-forward that ignores the legs' mass,", to begin a sentence about a loop that does not keep
 * its program. */
typedef struct {
    char text[128];
} feed_words;

feed_words words_of_feed(const gough_model *model, bool moving);

#endif
