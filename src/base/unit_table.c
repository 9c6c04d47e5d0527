/* Units, all in one table: what one of each is in units of the run, and what it is called. */
#include "gough/units.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "base/unit_words.h"
#include "gough/sizes.h"

/* ---- base units ---- */

typedef struct base_word {
    const char *word;
    double size;
} base_word;

#define BASE(word, size, a, b) {word, size},
static const base_word lengths[] = {LENGTHS(BASE, BASE, , )}, forces[] = {FORCES(BASE, BASE, , )},
                       masses[] = {MASSES(BASE, BASE, , )}, angles[] = {ANGLES(BASE, BASE, , )},
                       times[] = {TIMES(BASE, BASE, , )};
#define COUNT(table) (int)(sizeof(table) / sizeof *(table))
enum { ANGLES_KNOWN = COUNT(angles) };

static const struct {
    const base_word *word;
    int count;
} bases[GOUGH_BASE_UNITS] = {[GOUGH_BASE_LENGTH] = {lengths, COUNT(lengths)},
                             [GOUGH_BASE_FORCE] = {forces, COUNT(forces)},
                             [GOUGH_BASE_MASS] = {masses, COUNT(masses)},
                             [GOUGH_BASE_ANGLE] = {angles, ANGLES_KNOWN},
                             [GOUGH_BASE_TIME] = {times, COUNT(times)}};

const char *gough_unit_choice(gough_base_unit base, int index) {
    if ((unsigned)base >= GOUGH_BASE_UNITS || index < 0 || index >= bases[base].count) return NULL;
    return bases[base].word[index].word;
}

gough_status gough_units_init(gough_units *units, size_t size) {
    if (size != sizeof *units) return gough_size_refuse(units, size);
    *units = (gough_units){.length = 1, .mass = 1, .time = 1, .force = 1};
    return GOUGH_OK;
}

bool gough_units_choose(gough_units *units, gough_base_unit base, const char *word) {
    double *const size[GOUGH_BASE_UNITS] = {[GOUGH_BASE_LENGTH] = &units->length,
                                            [GOUGH_BASE_FORCE] = &units->force,
                                            [GOUGH_BASE_MASS] = &units->mass,
                                            [GOUGH_BASE_TIME] = &units->time};
    const char *known;
    for (int i = 0; (known = gough_unit_choice(base, i)) != NULL; i++) {
        if (strcmp(known, word) != 0) continue;
        units->name[base] = (unsigned char)i;
        if (size[base]) *size[base] = bases[base].word[i].size;
        return true;
    }
    return false;
}

/* ---- words of what is composed of them ---- */

/* all words of a kind, in the order of the base units in `word_order`: of speeds "m/s", "m/ms", "mm/s" … */
#define ALONE(word, size, a, b) a word b,
#define DEGREE(word, size, a, b) a "degree" b,
#define OVER_TIME(word, size, a, b) TIMES(ALONE, ALONE, a word "/", b)
#define DEGREE_OVER_TIME(word, size, a, b) TIMES(ALONE, ALONE, a "degree/", b)
#define OVER_LENGTH(word, size, a, b) LENGTHS(ALONE, ALONE, a word "/", b)
#define BY_LENGTH(word, size, a, b) LENGTHS(ALONE, ALONE, a word " ", b)
#define TIME_OVER(word, size, a, b) TIMES(ALONE, ALONE, a, "/" word b)
#define AND_TIME(word, size, a, b) TIMES(ALONE, ALONE, a "/(" word " ", ")" b)
#define OVER_LENGTH_AND_TIME(word, size, a, b) LENGTHS(AND_TIME, AND_TIME, a word, b)
#define BY_TIME_OVER_LENGTH(word, size, a, b) LENGTHS(TIME_OVER, TIME_OVER, a word " ", b)

/* in tables, and after a number in a text */
#define WORDS(name, UNITS, FIRST, NEXT, before, square, power)                                     \
    static const char *const name##_label[] = {UNITS(FIRST, NEXT, before, square)},                \
                             *const name##_word[] = {UNITS(NEXT, NEXT, " " before, power)}

static const char *const none_label[] = {"1"}, *const none_word[] = {""};
static const char *const power_label[] = {"W"}, *const power_word[] = {" W"};
static const char *const energy_label[] = {"J"}, *const energy_word[] = {" J"};
WORDS(length, LENGTHS, ALONE, ALONE, "", "", "");
WORDS(mass, MASSES, ALONE, ALONE, "", "", "");
WORDS(time, TIMES, ALONE, ALONE, "", "", "");
WORDS(angle, ANGLES, DEGREE, ALONE, "", "", "");
WORDS(rate, TIMES, ALONE, ALONE, "1/", "", "");
WORDS(speed, LENGTHS, OVER_TIME, OVER_TIME, "", "", "");
WORDS(angular_speed, ANGLES, DEGREE_OVER_TIME, OVER_TIME, "", "", "");
WORDS(acceleration, LENGTHS, OVER_TIME, OVER_TIME, "", "2", "^2");
WORDS(angular_acceleration, ANGLES, DEGREE_OVER_TIME, OVER_TIME, "", "2", "^2");
WORDS(force, FORCES, ALONE, ALONE, "", "", "");
WORDS(moment, FORCES, BY_LENGTH, BY_LENGTH, "", "", "");
WORDS(stiffness, FORCES, OVER_LENGTH, OVER_LENGTH, "", "", "");
WORDS(damping, FORCES, BY_TIME_OVER_LENGTH, BY_TIME_OVER_LENGTH, "", "", "");
WORDS(inertia, MASSES, BY_LENGTH, BY_LENGTH, "", "2", "^2");
WORDS(force_rate, FORCES, OVER_TIME, OVER_TIME, "", "", "");
WORDS(integral_gain, FORCES, OVER_LENGTH_AND_TIME, OVER_LENGTH_AND_TIME, "", "", "");

/* ---- what units there are ---- */

/* A unit is the product of powers of length, force, mass, angle and time; joule: not of those that are chosen, but of SI. */
typedef struct unit_info {
    signed char power[GOUGH_BASE_UNITS];
    bool joule;
    const char *const *label, *const *word;
    const char *field; /* in the table of fields */
} unit_info;

#define UNIT(name) name##_label, name##_word
static const unit_info units_known[] = {
    [GOUGH_UNIT_NONE] = {{0}, false, UNIT(none), ""},
    [GOUGH_UNIT_LENGTH] = {{1, 0, 0, 0, 0}, false, UNIT(length), "length"},
    [GOUGH_UNIT_MASS] = {{0, 0, 1, 0, 0}, false, UNIT(mass), "mass"},
    [GOUGH_UNIT_TIME] = {{0, 0, 0, 0, 1}, false, UNIT(time), "time"},
    [GOUGH_UNIT_ANGLE] = {{0, 0, 0, 1, 0}, false, UNIT(angle), "angle [degrees]"},
    [GOUGH_UNIT_RATE] = {{0, 0, 0, 0, -1}, false, UNIT(rate), "1/time"},
    [GOUGH_UNIT_SPEED] = {{1, 0, 0, 0, -1}, false, UNIT(speed), "length/time"},
    [GOUGH_UNIT_ANGULAR_SPEED] = {{0, 0, 0, 1, -1},
                                  false,
                                  UNIT(angular_speed),
                                  "angle/time [degrees]"},
    [GOUGH_UNIT_ACCELERATION] = {{1, 0, 0, 0, -2}, false, UNIT(acceleration), "length/time²"},
    [GOUGH_UNIT_ANGULAR_ACCELERATION] = {{0, 0, 0, 1, -2},
                                         false,
                                         UNIT(angular_acceleration),
                                         "angle/time² [degrees]"},
    [GOUGH_UNIT_FORCE] = {{0, 1, 0, 0, 0}, false, UNIT(force), "force"},
    [GOUGH_UNIT_MOMENT] = {{1, 1, 0, 0, 0}, false, UNIT(moment), "force·length"},
    [GOUGH_UNIT_POWER] = {{1, 1, 0, 0, -1}, true, UNIT(power), NULL},
    [GOUGH_UNIT_ENERGY] = {{1, 1, 0, 0, 0}, true, UNIT(energy), NULL},
    [GOUGH_UNIT_STIFFNESS] = {{-1, 1, 0, 0, 0}, false, UNIT(stiffness), "force/length"},
    [GOUGH_UNIT_DAMPING] = {{-1, 1, 0, 0, 1}, false, UNIT(damping), "force·time/length"},
    [GOUGH_UNIT_INERTIA] = {{2, 0, 1, 0, 0}, false, UNIT(inertia), "mass·length²"},
    [GOUGH_UNIT_FORCE_RATE] = {{0, 1, 0, 0, -1}, false, UNIT(force_rate), "force/time"},
    [GOUGH_UNIT_INTEGRAL_GAIN] = {
        {-1, 1, 0, 0, -1}, false, UNIT(integral_gain), "force/(length·time)"}};

static const unit_info *info_of(gough_unit unit) {
    return &units_known[(unsigned)unit < COUNT(units_known) ? unit : GOUGH_UNIT_NONE];
}

gough_unit gough_unit_of_field(const char *unit) {
    for (int i = 0; i < COUNT(units_known); i++)
        if (units_known[i].field && strcmp(units_known[i].field, unit) == 0) return (gough_unit)i;
    return GOUGH_UNIT_NONE;
}

/* The word of the chosen base units among all of a kind. */
static int word_at(const gough_units *units, const unit_info *u) {
    static const gough_base_unit word_order[] = {
        GOUGH_BASE_FORCE, GOUGH_BASE_MASS, GOUGH_BASE_ANGLE, GOUGH_BASE_LENGTH, GOUGH_BASE_TIME};
    int at = 0;
    for (int i = 0; i < COUNT(word_order) && !u->joule; i++) {
        const gough_base_unit base = word_order[i];
        if (u->power[base] == 0) continue;
        const int chosen = units->name[base];
        at = at * bases[base].count + (chosen < bases[base].count ? chosen : 0);
    }
    return at;
}

/* Without dimensions angles alone have a unit. */
static const unit_info *named_info(const gough_units *units, gough_unit unit) {
    const unit_info *u = info_of(unit);
    if (!units->dimensionless) return u;
    return &units_known[u->power[GOUGH_BASE_ANGLE] ? GOUGH_UNIT_ANGLE : GOUGH_UNIT_NONE];
}

const char *gough_unit_label(const gough_units *units, gough_unit unit) {
    const unit_info *u = named_info(units, unit);
    return u->label[word_at(units, u)];
}

const char *gough_unit_word(const gough_units *units, gough_unit unit) {
    const unit_info *u = named_info(units, unit);
    return u->word[word_at(units, u)];
}

/* ---- scaling ---- */

/* Where no unit of force is chosen, it is mass·length/time². */
void gough_unit_powers(const gough_units *units, gough_unit unit, int power[GOUGH_BASE_UNITS]) {
    const unit_info *u = info_of(unit);
    const bool chosen = units->force > 0;
    for (int b = 0; b < GOUGH_BASE_UNITS; b++) power[b] = chosen && u->joule ? 0 : u->power[b];
    if (chosen) return;
    const int force = power[GOUGH_BASE_FORCE];
    power[GOUGH_BASE_FORCE] = 0;
    power[GOUGH_BASE_LENGTH] += force;
    power[GOUGH_BASE_MASS] += force;
    power[GOUGH_BASE_TIME] -= 2 * force;
}

double gough_unit_size(const gough_units *units, gough_unit unit) {
    int power[GOUGH_BASE_UNITS];
    gough_unit_powers(units, unit, power);
    const double size = pow(units->length, power[GOUGH_BASE_LENGTH]) *
                        pow(units->mass, power[GOUGH_BASE_MASS]) *
                        pow(units->time, power[GOUGH_BASE_TIME]);
    return units->force > 0 ? size * pow(units->force, power[GOUGH_BASE_FORCE]) : size;
}

/* One unit of angle in radians, and its inverse: for degrees the doubles next to π/180 and 180/π. */
static double angle_size(const gough_units *units) {
    const int chosen = units->name[GOUGH_BASE_ANGLE];
    return angles[chosen < ANGLES_KNOWN ? chosen : 0].size;
}
static double angle_factor(const gough_units *units) {
    return units->name[GOUGH_BASE_ANGLE] == 0 ? 57.29577951308232087679815481410517033
                                              : 1 / angle_size(units);
}

double gough_unit_factor(const gough_units *units, gough_unit unit) {
    const double turn = info_of(unit)->power[GOUGH_BASE_ANGLE] ? angle_factor(units) : 1;
    return turn / gough_unit_size(units, unit);
}

double gough_unit_read(const gough_units *units, gough_unit unit, double value) {
    const double turn = info_of(unit)->power[GOUGH_BASE_ANGLE] ? angle_size(units) : 1;
    const double size = gough_unit_size(units, unit), factor = 1 / size;
    /* a thousandth is divided by a thousand, so that 50 mm are 0.05 m to the last digit */
    return value * turn * (fabs(factor - rint(factor)) > 0 ? size : 1) /
           (fabs(factor - rint(factor)) > 0 ? 1 : factor);
}
