/** @file tune.h
 *  The choice of the feedback: the least stiffness G, the same in all legs, with which the whole nonlinear run stays within an
 *  accuracy, stable and clear of resonances, and the damping D that goes with it. Theory: docs/theory/tuning.md. In
 *  libgough-analyse.
 */
#ifndef GOUGH_TUNE_H
#define GOUGH_TUNE_H

#include "gough/analyse.h"
#include "gough/batch.h"
#include "gough/map.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What is asked; start from gough_tuning_options_default(). */
typedef struct gough_tuning_options {
    double deviation;       /**< greatest distance of the top-frame origin from the program, > 0 */
    double angle_deviation; /**< greatest angle from it, radians; INFINITY: any */
    double
        damping_ratio; /**< D is chosen so that the least damped mode at home has this ratio, in [0, 1); NaN: the
                                 model's damping stays */
    double margin;   /**< no instability within this part of G below and above it, in [0, 0.5] */
    double least;    /**< least G tried; 0: a quarter of the largest threshold at rest */
    double greatest; /**< greatest G tried; INFINITY: 1e6 M g/R_b */
    int threads;     /**< of the runs; 0: one per processor that the process may use */
    /** Called now and then with the part done, from 0 to 1; nonzero stops. May be NULL. */
    int (*progress)(void *context, double part);
    void *context; /**< handed to progress */
} gough_tuning_options;

/** A margin of 0.02, the model's damping, any angle; `deviation` is 0 and must be set. */
GOUGH_API gough_tuning_options gough_tuning_options_default(void);

/** A point of the curve: deviation against G. */
typedef struct gough_tuning_point {
    double stiffness;          /**< G */
    double damping;            /**< D; NaN where no D gives the damping ratio, and nothing is run */
    gough_cause cause;         /**< of the end of the run; GOUGH_END_INVALID: not run */
    int leg;                   /**< 1 … 6 where one leg is the cause, else 0 */
    double end_time;           /**< of the run */
    double position_deviation; /**< largest distance from the program up to then */
    double angle_deviation;    /**< largest angle */
    double force;              /**< largest |leg force| */
    double speed;              /**< largest |leg rate| */
    double
        growth; /**< largest |Floquet multiplier|; of a program without period e^{growth rate} at rest; NaN: none found */
    bool stable;                /**< growth is not over 1 + 1e-7 */
    bool regular;               /**< it follows the trend, see gough_tuning.slope */
    char mode[GOUGH_MODE_NAME]; /**< what grows fastest, or decays slowest */
} gough_tuning_point;

/** What keeps G from being less. */
typedef enum gough_tuning_binding {
    GOUGH_TUNING_POSITION,  /**< the deviation of position */
    GOUGH_TUNING_ANGLE,     /**< the deviation of angle */
    GOUGH_TUNING_END,       /**< runs with less end early */
    GOUGH_TUNING_THRESHOLD, /**< with less, and the margin, the loop is unstable at rest */
    GOUGH_TUNING_TONGUE,    /**< with less, and the margin, the program's own motion pumps a mode */
    GOUGH_TUNING_SEARCH     /**< nothing: it is the least G of the search */
} gough_tuning_binding;

/** "position", "angle", "end", "threshold", "tongue", "search". */
GOUGH_API const char *gough_tuning_binding_name(gough_tuning_binding binding);

/** Why points of the curve are not on its trend. */
typedef enum gough_tuning_exception_kind {
    GOUGH_TUNING_ENDED,    /**< the runs end early */
    GOUGH_TUNING_UNSTABLE, /**< deviations grow: below a threshold or in a tongue */
    GOUGH_TUNING_OFF_TREND /**< the deviation is another than the trend's */
} gough_tuning_exception_kind;

/** "ended", "unstable", "off_trend". */
GOUGH_API const char *gough_tuning_exception_name(gough_tuning_exception_kind kind);

/** Neighbouring points that the trend does not describe. */
typedef struct gough_tuning_exception {
    double from;                      /**< least G of them */
    double to;                        /**< greatest */
    gough_tuning_exception_kind kind; /**< why */
    gough_cause cause;                /**< of early ends; else GOUGH_END_DONE */
    double worst;                     /**< largest ratio of deviation to trend; NaN: no trend */
    char mode[GOUGH_MODE_NAME];       /**< what grows, where they are unstable; "" else */
} gough_tuning_exception;

enum { GOUGH_TUNING_EXCEPTIONS = 96, GOUGH_TUNING_POINTS = 320 };

/** The choice. Numbers of a run are those of the run with the G and D named. */
typedef struct gough_tuning {
    bool found;       /**< whether some G does it; else `reason` says why none does */
    char reason[500]; /**< one sentence, or empty */
    double stiffness; /**< G, of five digits */
    double
        damping; /**< D, of nine digits; where legs differ in the model's damping that of leg 1 */
    double damping_ratio;   /**< of the least damped mode at home, with them */
    double deviation;       /**< largest distance from the program */
    double deviation_time;  /**< when */
    double angle_deviation; /**< largest angle, radians */
    double angle_time;      /**< when */
    double fails;           /**< the greatest G below it that was found not to do; NaN: none */
    gough_tuning_binding binding; /**< why not */
    gough_cause cause;            /**< of the early end of runs with less, where that binds */
    gough_mode
        mode; /**< which mode binds: the one that holds most of the deviation at its worst, or that grows */
    double mode_share;  /**< its part of that deviation; NaN where stability binds */
    int leg;            /**< which leg binds: 1 … 6, of the largest force */
    double force;       /**< that force */
    double force_share; /**< of the limit; NaN: no limit */
    double speed;       /**< largest |leg rate| of any leg */
    double speed_share; /**< of the limit; NaN: no limit */
    bool periodic; /**< stability was looked at over a period of the program; else at rest only */
    char unchecked[240];   /**< why at rest only, or empty */
    double threshold;      /**< largest threshold of G at rest with feed-forward */
    gough_mode least_mode; /**< the mode that it belongs to */
    double slope; /**< d log deviation / d log G, least squares over regular points; NaN: too few */
    double scale; /**< deviation ≈ scale · G^slope */
    size_t points;     /**< of the curve, by rising G */
    size_t exceptions; /**< of those found, how many are kept */
    gough_tuning_exception exception[GOUGH_TUNING_EXCEPTIONS]; /**< by rising G */
    size_t runs;                                               /**< nonlinear runs made */
} gough_tuning;

/** Checks the options and says how many bytes of memory gough_tune() needs, aligned to 64.
 *  @return GOUGH_OK; GOUGH_ERROR_INPUT: an option out of its range, a period that the motion does not have;
 *  GOUGH_ERROR_NUMERICAL: a singular home pose. */
GOUGH_API gough_status gough_tune_size(const gough_model *model,
                                       const gough_tuning_options *options, size_t *bytes,
                                       gough_error *error);

/** Finds the least G, the same in all legs, with which the run meets what is asked.
 *
 *  Disturbances, initial state, program and duration are the model's; its stiffness and the method of its simulation are not
 *  used: runs are adaptive, at the least of the tolerance given (or 1e-10 for a fixed step) and 1e-4 of the deviation asked for,
 *  and deviations are taken as often as the fastest mode needs. The G named meets the accuracy, a G less by 1e-4 of it does not,
 *  nor does any of those that were tried below, 20 in each decade; those that would, but are unstable, are passed over.
 *  @param feedforward  whether program forces are fed forward; the model's own choice is not used
 *  @param[out] point   GOUGH_TUNING_POINTS of them, the curve
 *  @param[out] tuning  `found` false where no G does it, with the reason
 *  @param memory       gough_tune_size() bytes, aligned to 64; nothing else is allocated
 *  @return GOUGH_OK also where none is found; GOUGH_ERROR_INPUT: an option out of its range, a search that stays below the
 *  threshold of a home pose which needs feedback, a period that the motion does not have; GOUGH_ERROR_NUMERICAL: a singular home
 *  pose, or stopped. Not more than GOUGH_TUNING_POINTS points and a million steps a run. Thread-safe. */
GOUGH_API gough_status gough_tune(const gough_model *model, const gough_simulation *simulation,
                                  bool feedforward, const gough_tuning_options *options,
                                  gough_tuning_point *point, gough_tuning *tuning, void *memory,
                                  gough_error *error);

/** The damping D, the same in all legs, with which the least damped mode at home has a damping ratio, (tune-1).
 *  @param model      with the G wanted; its damping is not used. Without feed-forward home is where the loop rests
 *  @param ratio      in [0, 1)
 *  @return GOUGH_OK; GOUGH_ERROR_NUMERICAL: home is singular or, with this G, unstable, so that no damping helps;
 *  GOUGH_ERROR_INPUT: a ratio out of its range. Exact up to rounding of the eigenvalues. Allocates nothing. Thread-safe. */
GOUGH_API gough_status gough_damping_for_ratio(const gough_model *model, double ratio,
                                               double *damping, gough_error *error);

#ifdef __cplusplus
}
#endif
#endif
