/** @file status.h
 *  Status of a call, the error as a sentence, and how a run ended.
 *
 *  Accuracy: no numbers are computed; sentences show numbers with the digits of their formats.
 *  Overlap: arguments must not lie in the error or text that is written.
 *  Threads: every function may be called from several threads at once, on distinct errors and texts.
 */
#ifndef GOUGH_STATUS_H
#define GOUGH_STATUS_H

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

#include "gough/names.h"

#if defined(GOUGH_SHARED) && defined(__GNUC__)
#define GOUGH_API __attribute__((visibility("default")))
#else
#define GOUGH_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/** Version of the library that is loaded, as in "0.1.0"; GOUGH_VERSION is that of the headers. Until 1.0 libraries of different
 *  minor versions have different names, so that a program never runs with one that it was not built for. */
GOUGH_API const char *gough_version(void);

/** Edition of the interface of the library that is loaded; GOUGH_EDITION is that of the headers. */
GOUGH_API int gough_edition(void);

/** Status of a call. The values are the exit codes of the command. */
typedef enum gough_status {
    GOUGH_OK = 0, /**< success */
    GOUGH_ERROR_NUMERICAL =
        1, /**< a limit, a singular pose, no convergence, no solution: earlier results are valid */
    GOUGH_ERROR_INPUT = 2, /**< the caller's numbers or text are invalid */
    GOUGH_ERROR_FILE = 3   /**< reading, writing or memory failed */
} gough_status;

enum { GOUGH_ERROR_QUANTITIES = 6 /**< numbers with a unit that an error keeps */ };

/** A number in the sentence of an error that has a unit, in units of the run. */
typedef struct gough_quantity {
    int unit;     /**< a gough_unit (units.h) */
    int at;       /**< byte offset of its digits in the message */
    int length;   /**< number of these bytes */
    int digits;   /**< significant digits that are printed */
    double value; /**< the number */
} gough_quantity;

/** The error, as one sentence that the user can act on. The message is empty if there was no error. */
typedef struct gough_error {
    gough_status status; /**< what the function returned */
    char message[500];   /**< the sentence, UTF-8, terminated, without a line end */
    const char *
        key; /**< the key of a study file that it is about, such as "load.mass", if the library knows it; else NULL */
    int quantities; /**< how many of `quantity` are set */
    gough_quantity quantity
        [GOUGH_ERROR_QUANTITIES]; /**< numbers that gough_error_say() (units.h) writes in other units */
} gough_error;

/** Fills @p error (which may be NULL) with a printf-style sentence, as gough_sentence() formats it.
 *  @return @p status, so that a check reads `return gough_fail(error, …)`. Safe to call concurrently on distinct errors. */
GOUGH_API gough_status gough_fail(gough_error *error, gough_status status, const char *format, ...)
#if defined(__GNUC__)
    __attribute__((format(printf, 3, 4)))
#endif
    ;

/** The same for an error that is about a key of the study file.
 *  @param key  such as "load.mass"; a text that outlives the error */
GOUGH_API gough_status gough_fail_key(gough_error *error, gough_status status, const char *key,
                                      const char *format, ...)
#if defined(__GNUC__)
    __attribute__((format(printf, 4, 5)))
#endif
    ;

/** Writes a printf-style sentence, cut to @p size bytes, with a decimal point in every locale, as gough_fail() does.
 *  Known conversions: c d i u x s e f g %, the lengths l and z, flags, width and precision. */
GOUGH_API void gough_sentence(char *text, size_t size, const char *format, va_list arguments)
#if defined(__GNUC__)
    __attribute__((format(printf, 3, 0)))
#endif
    ;

/** Called when an assertion fails: a bug in the library, or memory that its caller laid out against its contract; never for
 *  invalid numbers or text. The library's own function stops the program (abort()) and prints nothing.
 *
 *  A program replaces it by defining a function of this name, with C linkage, which may write the place down and must not call the
 *  library. It may leave by longjmp(), after which objects that the failed call was given must not be used; if it returns, the
 *  program is stopped. It is called in the thread in which the assertion failed, possibly in several threads at once.
 *  @param file,line  place in the library's source
 *  @param condition  what should have been true, as text */
GOUGH_API void gough_assertion_failed(const char *file, int line, const char *condition);

/** Why a run ended. */
typedef enum gough_cause {
    GOUGH_END_DONE = 0,      /**< the whole duration */
    GOUGH_END_LEG_SHORT,     /**< a leg became shorter than its least length */
    GOUGH_END_LEG_LONG,      /**< a leg became longer than its greatest length */
    GOUGH_END_LEG_SPEED,     /**< a leg exceeded its greatest speed */
    GOUGH_END_LEG_FORCE,     /**< a leg exceeded its greatest force */
    GOUGH_END_LEG_NO_LENGTH, /**< both joints of a leg coincided, so that its direction is undefined */
    GOUGH_END_SINGULAR, /**< the six equations became singular or nearly so (condition over 1e8, or det J changed sign) */
    GOUGH_END_NOT_FINITE, /**< a formula or the motion was no longer finite */
    GOUGH_END_NO_CONVERGENCE, /**< the stepper could not meet the tolerance, or an implicit step did not converge */
    GOUGH_END_STOPPED,          /**< the caller's sink asked to stop */
    GOUGH_END_INVALID,          /**< in a sweep: the values of this run do not make a valid study */
    GOUGH_END_LEG_ACCELERATION, /**< the length of a leg exceeded its greatest acceleration */
    GOUGH_END_BASE_SWING,     /**< a leg turned too far from its direction at home, in base axes */
    GOUGH_END_TOP_SWING,      /**< the same, in the axes of the top */
    GOUGH_END_PLATFORM_POSE,  /**< the platform left the range of one of its six components */
    GOUGH_END_PLATFORM_SPEED, /**< the platform moved or turned too fast */
    GOUGH_END_PLATFORM_ACCELERATION, /**< its acceleration or angular acceleration was too large */
    GOUGH_CAUSES                     /**< number of causes */
} gough_cause;

/** Fixed word for a cause, as in the JSON summary and the attribute `end_cause`:
 *  done, leg_short, leg_long, leg_speed, leg_force, leg_no_length, singular, not_finite, no_convergence, stopped,
 *  invalid, leg_acceleration, base_swing, top_swing, platform_pose, platform_speed, platform_acceleration. */
GOUGH_API const char *gough_cause_name(gough_cause cause);

/** A clause that says what happens in a run that ends for a cause, such as "a leg becomes too short", to be put into a sentence;
 *  "the run ends" for a number that is no cause. A static text. Safe to call concurrently. */
GOUGH_API const char *gough_cause_words(gough_cause cause);

/** How and when a run ended. */
typedef struct gough_end {
    gough_cause cause; /**< why */
    double time;       /**< time of the end, in the study's units */
    int leg;           /**< 1 … 6 if a leg is the cause: the lowest such leg; else 0 */
    unsigned legs;     /**< bit n − 1 is set for each leg n within 1e-6 of that limit */
    double limit;      /**< the exceeded limit (length, speed, force, …); 0 for other causes */
    int component; /**< 1 … 6 for surge … yaw if a limit of the platform is the cause; else 0 */
    bool least;    /**< it fell below the least value, which `limit` is */
    char message[400]; /**< one sentence; empty for GOUGH_END_DONE */
} gough_end;

#ifdef __cplusplus
}
#endif
#endif
