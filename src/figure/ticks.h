/* Ticks of an axis: where they stand and what is written at them. */
#ifndef GOUGH_FIGURE_TICKS_H
#define GOUGH_FIGURE_TICKS_H

#include <stdbool.h>
#include <stdio.h>

enum { MOST_TICKS = 128, TICK_TEXT = 64 };

/* One tick. The text is for gnuplot's enhanced mode ("10^{−3}") and "" for a short mark without a number. */
typedef struct tick {
    double value;
    char text[TICK_TEXT];
} tick;

typedef struct tick_list {
    int count;
    tick tick[MOST_TICKS];
} tick_list;

/* An axis as gnuplot calls it ("x", "y", "cb"), its range and its length in nominal pixels. */
typedef struct axis {
    const char *name;
    bool logarithmic;
    double low, high;
    double length;
    bool beside; /* labels stand beside each other, as under an abscissa, and must not touch */
    bool bare;   /* ticks without numbers */
} axis;

/* Chooses the ticks of an axis by increasing value. */
void tick_choose(const axis *axis, tick_list *list);

/* Range, scale and ticks of an axis as commands of gnuplot, in the C locale. */
void axis_write(FILE *file, const axis *axis);

/* Room in nominal pixels that the longest label takes. */
double tick_label_width(const tick_list *list);

/* The step of 1, 2 or 5 times a power of ten that divides a range into at most so many intervals. */
double tick_step(double low, double high, int most);

#endif
