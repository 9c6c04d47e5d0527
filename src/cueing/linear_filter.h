/* Linear filters of up to three states, stepped exactly for input that is straight between samples, (cue-5). */
#ifndef GOUGH_CUEING_LINEAR_FILTER_H
#define GOUGH_CUEING_LINEAR_FILTER_H

#include "gough/cueing.h"

/* Begins a filter at rest whose states are x, x', x'' …: the last one's derivative is the input and row · states. Returns
 * false if a number of its step is not finite. */
bool linear_filter_begin(gough_linear_filter *filter, int states, const double *row, double period);

/* The first sample sets the input; each other one steps the states from the one before. */
void linear_filter_take(gough_linear_filter *filter, double input);

#endif
