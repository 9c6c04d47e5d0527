/* Marks in sentences: behind the conversion of a number, as in "t = %.9g" IN_TIME, they name its unit, so that gough_error_say()
 * can write it in the units of a study. A mark may also begin a text that is printed behind the number, as in "%.3g%s", and the
 * text is then what stands for the unit. A sentence that is done has no marks. */
#ifndef GOUGH_BASE_QUANTITY_H
#define GOUGH_BASE_QUANTITY_H

#include <string.h>

#include "gough/status.h"

/* A mark is followed by a letter: 'A' + the gough_unit of a number in units of the run, or 'a' + that of one in degrees. */
enum { QUANTITY_MARK = 1, QUANTITY_PLAIN = 'A', QUANTITY_DEGREES = 'a' };

#define IN_LENGTH "\1B"
#define IN_MASS "\1C"
#define IN_TIME "\1D"
#define IN_RATE "\1F"
#define IN_SPEED "\1G"
#define IN_ACCELERATION "\1I"
#define IN_FORCE "\1K"
#define IN_STIFFNESS "\1O"
#define IN_DAMPING "\1P"
#define IN_INERTIA "\1Q"
#define IN_FORCE_RATE "\1R"
#define IN_INTEGRAL_GAIN "\1S"
#define IN_DEGREES "\1e"
#define IN_DEGREES_PER_TIME "\1h"
#define IN_DEGREES_PER_TIME_SQUARED "\1j"

/* Marked numbers of a part that stands in the message of an error as it is. */
static inline void quantity_carry(gough_error *error, const gough_error *part) {
    const char *found = error && part->message[0] ? strstr(error->message, part->message) : NULL;
    for (int q = 0; found && q < part->quantities; q++) {
        if (error->quantities == GOUGH_ERROR_QUANTITIES) return;
        gough_quantity *carried = &error->quantity[error->quantities++];
        *carried = part->quantity[q];
        carried->at += (int)(found - error->message);
    }
}

#endif
