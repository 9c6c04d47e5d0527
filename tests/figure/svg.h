/* What a reader sees in an SVG that gnuplot drew: numbers at ticks with their places, and the points of lines. */
#ifndef TESTS_REPORT_SVG_H
#define TESTS_REPORT_SVG_H

#include <stdbool.h>
#include <stddef.h>

enum { SVG_TICKS = 200, SVG_POINTS = 4000 };

/* A tick with a number: the side of its panel that it stands on, its place along that side in pixels, the value that its text
 * says, and how far from the sheet's left edge its text begins. */
typedef struct svg_tick {
    bool below; /* under a panel; else at its side */
    double side, place, value, text_left;
    char text[64];
} svg_tick;

typedef struct svg_ticks {
    int count;
    svg_tick tick[SVG_TICKS];
} svg_ticks;

typedef struct svg_line {
    size_t count;
    double x[SVG_POINTS], y[SVG_POINTS];
} svg_line;

/* The value of a label as gnuplot writes it into an SVG: "−0.5", "2·10<tspan … dy="-5.5px">−7</tspan>". NaN: none. */
double svg_number(const char *markup);

/* All ticks with numbers of the axes, in the order of the file. */
void svg_read_ticks(const char *svg, svg_ticks *ticks);

/* Those on one side of one panel: sides are numbered as they come, those below panels and the others apart. */
void svg_side(const svg_ticks *all, bool below, int number, svg_ticks *side);

/* The nth line (from 0) of a colour such as "  0, 114, 178". @return false if there is none. */
bool svg_read_line(const char *svg, const char *colour, int number, svg_line *line);

/* The power of ten that a panel's heading has before its unit: 0 where it has none. */
int svg_power(const char *svg, const char *heading);

#endif
