/** @file units.h
 *  Units of the numbers that a user writes and reads: their names, and the factors between them and the units of a run.
 *
 *  Inside, units are consistent: SI for studies with units of their own, and whatever a dimensionless study means. Five units are
 *  chosen, of length, force, mass, angle and time; the others follow from them: stiffness is force/length, damping
 *  force·time/length, inertia mass·length². Force is chosen by itself, so that mm, N and kg go together, or in, lbf and lb,
 *  although none of these sets is consistent. Energy is in J and power in W.
 *
 *  Accuracy: factors are accurate to a few roundings; those of SI are 1, and that of degrees is the double next to 180/π.
 *  Overlap: no argument may overlap the units that are written.
 *  Threads: every function may be called from several threads at once, on distinct units and errors.
 */
#ifndef GOUGH_UNITS_H
#define GOUGH_UNITS_H

#include <stdbool.h>

#include "gough/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The units that a study chooses. */
typedef enum gough_base_unit {
    GOUGH_BASE_LENGTH,
    GOUGH_BASE_FORCE,
    GOUGH_BASE_MASS,
    GOUGH_BASE_ANGLE,
    GOUGH_BASE_TIME,
    GOUGH_BASE_UNITS
} gough_base_unit;

/** Units of numbers. Zeros with a length, mass and time of 1 mean SI, angles in degrees. */
typedef struct gough_units {
    bool dimensionless; /**< unit labels "1" */
    double length;      /**< one unit of length in units of the run: 1, 0.001 for mm, or R_b */
    double mass;        /**< of mass: 1, or M */
    double time;        /**< of time: 1, or √(R_b/g) */
    double
        force; /**< of force; energy and power are then in J and W. 0: mass·length/time², and all units follow from it */
    unsigned char name[GOUGH_BASE_UNITS]; /**< which of the words of gough_unit_choice(), from 0 */
} gough_units;

/** What a number measures. Numbers of one kind are scaled by one factor, and have one name for their unit. */
typedef enum gough_unit {
    GOUGH_UNIT_NONE, /**< a pure number */
    GOUGH_UNIT_LENGTH,
    GOUGH_UNIT_MASS,
    GOUGH_UNIT_TIME,
    GOUGH_UNIT_ANGLE, /**< radians in a run, degrees outside unless another unit is chosen */
    GOUGH_UNIT_RATE,  /**< 1/time */
    GOUGH_UNIT_SPEED,
    GOUGH_UNIT_ANGULAR_SPEED,
    GOUGH_UNIT_ACCELERATION,
    GOUGH_UNIT_ANGULAR_ACCELERATION,
    GOUGH_UNIT_FORCE,
    GOUGH_UNIT_MOMENT,
    GOUGH_UNIT_POWER,
    GOUGH_UNIT_ENERGY,
    GOUGH_UNIT_STIFFNESS, /**< force/length */
    GOUGH_UNIT_DAMPING,   /**< force/speed */
    GOUGH_UNIT_INERTIA,
    GOUGH_UNIT_FORCE_RATE,   /**< force/time */
    GOUGH_UNIT_INTEGRAL_GAIN /**< force/(length·time) */
} gough_unit;

/** The word for a base unit: "m", "mm", "um", "in", "ft"; "N", "kN", "lbf"; "kg", "t", "lb"; "deg", "rad", "mrad", "arcsec"; "s",
 *  "ms". @param index  from 0, which is the usual one @return NULL beyond the last and for no base unit */
GOUGH_API const char *gough_unit_choice(gough_base_unit base, int index);

/** Chooses a base unit by its word. @p units begins as gough_units_si().
 *  @return false if there is no such unit; nothing is then changed */
GOUGH_API bool gough_units_choose(gough_units *units, gough_base_unit base, const char *word);

/** SI units, angles in degrees. @param size  sizeof(gough_units) @return as gough_platform_init() */
GOUGH_API gough_status gough_units_init(gough_units *units, size_t size);

/** The units that gough_units_init() fills in. */
static inline gough_units gough_units_si(void) {
    gough_units units;
    (void)gough_units_init(&units, sizeof units);
    return units;
}

/** One of these units in units of the run; of angles 1, as for pure numbers. Accurate to a few roundings. */
GOUGH_API double gough_unit_size(const gough_units *units, gough_unit unit);

/** What a number of the run is multiplied by to be in these units; radians become degrees, or what is chosen. Accurate to a few
 *  roundings. */
GOUGH_API double gough_unit_factor(const gough_units *units, gough_unit unit);

/** A number in these units, in units of the run: the way back of gough_unit_factor(). Accurate to a few roundings; exact for SI. */
GOUGH_API double gough_unit_read(const gough_units *units, gough_unit unit, double value);

/** The powers of the base units that make up a unit. Those of energy and power are 0 if a unit of force is chosen, because these
 *  are in J and W; if none is chosen, those of force are 0. */
GOUGH_API void gough_unit_powers(const gough_units *units, gough_unit unit,
                                 int power[GOUGH_BASE_UNITS]);

/** Name of a unit in tables: "m/s2", "N m", "degree", "1"; without dimensions that of angles for all angles and else "1". */
GOUGH_API const char *gough_unit_label(const gough_units *units, gough_unit unit);

/** Name of a unit in text, with the space that stands between a number and it: " m/s^2", " N m", " deg", and "" for pure numbers;
 *  without dimensions that of angles for all angles and else "". */
GOUGH_API const char *gough_unit_word(const gough_units *units, gough_unit unit);

/** Rewrites the sentence of an error with its numbers in these units and with the names of these; without dimensions it stays as it
 *  is. Once is enough: later calls do nothing.
 *  @param error  as a function of the library filled it */
GOUGH_API void gough_error_say(gough_error *error, const gough_units *units);

/** Reads the name of a unit as records have it: those of gough_unit_choice(), more that instruments write (cm, degree, second, min,
 *  g, Gal …), and what is composed of them (m/s, deg/s, mm/s2, m/s^2), in letters of either case.
 *  @param word,length  need not be terminated
 *  @param[out] unit    a length, an angle, a time, or a speed or acceleration of these. Written only if the name is known
 *  @param[out] size    one of it in SI and radians, accurate to a few roundings; likewise
 *  @return false if there is no such unit. Safe to call concurrently. */
GOUGH_API bool gough_unit_named(const char *word, size_t length, gough_unit *unit, double *size);

/** The unit that the table of fields calls so: "force/length", "angle [degrees]" …; GOUGH_UNIT_NONE for "" and any other. */
GOUGH_API gough_unit gough_unit_of_field(const char *unit);

#ifdef __cplusplus
}
#endif
#endif
