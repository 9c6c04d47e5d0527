/* Names of units as records have them, by the words of unit_words.h. */
#define _POSIX_C_SOURCE 200809L /* strncasecmp */
#include <string.h>
#include <strings.h>

#include "base/unit_words.h"
#include "gough/units.h"

typedef struct named {
    const char *word;
    double size;
    gough_unit unit;
} named;

#define OF_LENGTH(word, size, ...) {word, size, GOUGH_UNIT_LENGTH},
#define OF_ANGLE(word, size, ...) {word, size, GOUGH_UNIT_ANGLE},
#define OF_TIME(word, size, ...) {word, size, GOUGH_UNIT_TIME},
#define OF_ACCELERATION(word, size, ...) {word, size, GOUGH_UNIT_ACCELERATION},
#define LENGTH_OF_RECORD(word, size) OF_LENGTH(word, size, )
#define ANGLE_OF_RECORD(word, size) OF_ANGLE(word, size, )
#define TIME_OF_RECORD(word, size) OF_TIME(word, size, )
#define ACCELERATION_OF_RECORD(word, size) OF_ACCELERATION(word, size, )
static const named known[] = {
    /* words that differ in nothing but capitals are found in this order */
    LENGTHS(OF_LENGTH, OF_LENGTH, , ) ANGLES(OF_ANGLE, OF_ANGLE, , ) TIMES(OF_TIME, OF_TIME, , )
        LENGTHS_OF_RECORDS(LENGTH_OF_RECORD) ANGLES_OF_RECORDS(ANGLE_OF_RECORD)
            TIMES_OF_RECORDS(TIME_OF_RECORD) ACCELERATIONS_OF_RECORDS(ACCELERATION_OF_RECORD)};

static const named *find(const char *word, size_t length) {
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strlen(known[i].word) == length && strncasecmp(known[i].word, word, length) == 0)
            return &known[i];
    return NULL;
}

/* The power of a time below the stroke, cut off its end: "s2", "s^2", "s²", or "s/s". */
static int take_power(const char *word, size_t *length) {
    static const char *const squares[] = {"^2", "\u00b2", "2"};
    const char *slash = memchr(word, '/', *length);
    if (slash) {
        const size_t half = (size_t)(slash - word);
        const bool same = 2 * half + 1 == *length && strncasecmp(word, slash + 1, half) == 0;
        *length = same ? half : 0;
        return 2;
    }
    for (size_t i = 0; i < sizeof squares / sizeof *squares; i++) {
        const size_t most = strlen(squares[i]);
        if (*length <= most || memcmp(word + *length - most, squares[i], most) != 0) continue;
        *length -= most;
        return 2;
    }
    return 1;
}

bool gough_unit_named(const char *word, size_t length, gough_unit *unit, double *size) {
    const char *slash = length ? memchr(word, '/', length) : NULL;
    const named *whole = length && !slash ? find(word, length) : NULL;
    if (whole) {
        *unit = whole->unit;
        *size = whole->size;
        return true;
    }
    if (!slash) return false;
    size_t below = length - (size_t)(slash + 1 - word);
    const named *over = find(word, (size_t)(slash - word));
    const int power = take_power(slash + 1, &below);
    const named *time = below ? find(slash + 1, below) : NULL;
    if (!over || !time || time->unit != GOUGH_UNIT_TIME) return false;
    if (over->unit != GOUGH_UNIT_LENGTH && over->unit != GOUGH_UNIT_ANGLE) return false;
    const bool turns = over->unit == GOUGH_UNIT_ANGLE;
    *unit = power == 1 ? (turns ? GOUGH_UNIT_ANGULAR_SPEED : GOUGH_UNIT_SPEED)
                       : (turns ? GOUGH_UNIT_ANGULAR_ACCELERATION : GOUGH_UNIT_ACCELERATION);
    *size = over->size / (power == 1 ? time->size : time->size * time->size);
    return true;
}
