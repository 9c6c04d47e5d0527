/* The base units, each once: FIRST the usual one, NEXT the others, each with its size in SI and radians. The last two arguments are
 * passed on, so that the words of composed units can be made of these. */
#ifndef GOUGH_BASE_UNIT_WORDS_H
#define GOUGH_BASE_UNIT_WORDS_H

/* international inch and foot; standard gravity times the avoirdupois pound */
#define LENGTHS(FIRST, NEXT, a, b)                                                                 \
    FIRST("m", 1, a, b)                                                                            \
    NEXT("mm", 1e-3, a, b) NEXT("um", 1e-6, a, b) NEXT("in", 0.0254, a, b) NEXT("ft", 0.3048, a, b)
#define FORCES(FIRST, NEXT, a, b)                                                                  \
    FIRST("N", 1, a, b) NEXT("kN", 1e3, a, b) NEXT("lbf", 4.4482216152605, a, b)
#define MASSES(FIRST, NEXT, a, b)                                                                  \
    FIRST("kg", 1, a, b) NEXT("t", 1e3, a, b) NEXT("lb", 0.45359237, a, b)
#define ANGLES(FIRST, NEXT, a, b)                                                                  \
    FIRST("deg", UNIT_DEGREE, a, b)                                                                \
    NEXT("rad", 1, a, b) NEXT("mrad", 1e-3, a, b) NEXT("arcsec", UNIT_DEGREE / 3600, a, b)
#define TIMES(FIRST, NEXT, a, b) FIRST("s", 1, a, b) NEXT("ms", 1e-3, a, b)

#define UNIT_DEGREE (3.14159265358979323846 / 180)

/* "m, mm, um, in, ft" */
#define WORD_FIRST(word, size, a, b) word
#define WORD_NEXT(word, size, a, b) ", " word
#define WORDS_OF(UNITS) UNITS(WORD_FIRST, WORD_NEXT, , )

#endif
