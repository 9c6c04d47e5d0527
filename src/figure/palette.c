/* Colours of lines from palette.def. */
#include "figure/palette.h"

enum {
#define COLOUR(name, day, night) COLOUR_##name,
#define LEGS(...)
#define AXES(...)
#define TABLES(...)
#include "figure/palette.def"
#undef COLOUR
#undef LEGS
#undef AXES
#undef TABLES
    COLOURS
};

static const char *const colour[COLOURS] = {
#define COLOUR(name, day, night) day,
#define LEGS(...)
#define AXES(...)
#define TABLES(...)
#include "figure/palette.def"
#undef COLOUR
#undef LEGS
#undef AXES
#undef TABLES
};

#define COLOUR(name, day, night)
#define NAMED(a) COLOUR_##a
#define LEGS(a, b, c, d, e, f)                                                                     \
    static const int legs[] = {NAMED(a), NAMED(b), NAMED(c), NAMED(d), NAMED(e), NAMED(f)};
#define AXES(a, b, c) static const int axes[] = {NAMED(a), NAMED(b), NAMED(c)};
#define TABLES(a, b, c, d, e, f)                                                                   \
    static const int tables[] = {NAMED(a), NAMED(b), NAMED(c), NAMED(d), NAMED(e), NAMED(f)};
#include "figure/palette.def"

enum { TABLE_COLOURS = sizeof tables / sizeof tables[0] };

int colour_of_leg(int leg) { return legs[leg]; }

int colour_of_axis(int axis) { return axes[axis]; }

int colour_of_table(size_t number) {
    return tables[number % TABLE_COLOURS] + COLOURS * (int)(number / TABLE_COLOURS);
}

const char *colour_text(int index) { return colour[index % COLOURS]; }

int colour_round(int index) { return index / COLOURS; }
