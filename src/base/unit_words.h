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

/* what records call units besides: those above by other names, and some that a study does not choose. Gal is cm/s² */
#define LENGTHS_OF_RECORDS(W)                                                                      \
    W("metre", 1)                                                                                  \
    W("metres", 1)                                                                                 \
    W("meter", 1)                                                                                  \
    W("meters", 1)                                                                                 \
    W("cm", 1e-2)                                                                                  \
    W("km", 1e3)                                                                                   \
    W("\u00b5m", 1e-6) W("\u03bcm", 1e-6) W("inch", 0.0254) W("inches", 0.0254) W("feet", 0.3048)
#define ANGLES_OF_RECORDS(W)                                                                       \
    W("degree", UNIT_DEGREE)                                                                       \
    W("degrees", UNIT_DEGREE)                                                                      \
    W("\u00b0", UNIT_DEGREE) W("radian", 1) W("radians", 1) W("arcmin", UNIT_DEGREE / 60)
#define TIMES_OF_RECORDS(W)                                                                        \
    W("sec", 1)                                                                                    \
    W("secs", 1)                                                                                   \
    W("second", 1)                                                                                 \
    W("seconds", 1)                                                                                \
    W("msec", 1e-3)                                                                                \
    W("millisecond", 1e-3)                                                                         \
    W("milliseconds", 1e-3)                                                                        \
    W("us", 1e-6) W("\u00b5s", 1e-6) W("\u03bcs", 1e-6) W("ns", 1e-9) W("min", 60) W("h", 3600)
#define ACCELERATIONS_OF_RECORDS(W) W("g", 9.80665) W("mg", 9.80665e-3) W("gal", 1e-2)

#define UNIT_DEGREE (3.14159265358979323846 / 180)

/* "m, mm, um, in, ft" */
#define WORD_FIRST(word, size, a, b) word
#define WORD_NEXT(word, size, a, b) ", " word
#define WORDS_OF(UNITS) UNITS(WORD_FIRST, WORD_NEXT, , )

#endif
