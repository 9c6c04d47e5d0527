/** @file tune.h
 *  Choosing the feedback: the least stiffness G, the same in all legs, with which the nonlinear run stays within an accuracy, is
 *  stable and is clear of resonances, and the damping D that goes with it; or matrices G and D that couple the legs, from the poles
 *  that the loop is to have at rest, or from the costs of errors and forces. Theory: docs/theory/tuning.md. In libgough-analyse.
 *
 *  Numbers are in the units of the model, angles in radians. An error argument may be NULL.
 *
 *  Accuracy: as each function says.
 *  Overlap: outputs and memory must not overlap each other or inputs.
 *  Threads: every function may be called from several threads at once, on distinct outputs, if LAPACK allows that, as usual
 *  builds do. gough_tune() starts threads of its own and waits for them.
 */
#ifndef GOUGH_TUNE_H
#define GOUGH_TUNE_H

#include "gough/batch.h"
#include "gough/floquet.h"
#include "gough/map.h"
#include "gough/units.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The request; start from gough_tuning_options_default(). */
typedef struct gough_tuning_options {
    size_t size; /**< of this struct in bytes, from gough_tuning_options_default(), or 0 */
    double
        deviation; /**< greatest distance of the top frame's origin from the program allowed, > 0 */
    double
        angle_deviation; /**< greatest angle from the program allowed, radians; INFINITY: any angle */
    double
        damping_ratio; /**< D is chosen so that the least damped mode at home has this ratio, in [0, 1); NaN: keep the
                                 model's damping */
    double margin; /**< margin to instability below and above G, as a fraction of G, in [0, 0.5] */
    double
        least; /**< least G tried; 0: a quarter of the largest threshold at rest, or 1e-3 F/R_b if that is more,
                          F being the weight or the largest force that a leg has to bear */
    double
        greatest; /**< greatest G tried; INFINITY: 1e6 F/R_b, and further if that can help: up to 1e3 times the largest
                          force over the deviation, and 1e2 times the stiffness to which inertia and damping amount in an
                          output step */
    int threads;  /**< of the runs; 0: one per processor that the process may use */
    /** Called occasionally with the fraction of the work done, 0 … 1; nonzero stops. May be NULL. Meanwhile `stiffness` of the
     *  result is the least G known to meet the deviation (0: none yet), and `fails` the greatest G below it known not to meet it
     *  (NaN: none). */
    int (*progress)(void *context, double part);
    void *context;            /**< passed to progress */
    const gough_units *units; /**< of numbers in sentences; NULL: those of the run, without names */
} gough_tuning_options;

/** Fills in the defaults: a margin of 0.02, the model's damping, any angle, no units; `deviation` is 0 and must be set.
 *  @param size  sizeof(gough_tuning_options)
 *  @return as gough_platform_init() */
GOUGH_API gough_status gough_tuning_options_init(gough_tuning_options *options, size_t size);

/** The options that gough_tuning_options_init() fills in. */
static inline gough_tuning_options gough_tuning_options_default(void) {
    gough_tuning_options options;
    (void)gough_tuning_options_init(&options, sizeof options);
    return options;
}

/** How the stability of a point of the curve was found. */
typedef enum gough_tuning_judged {
    GOUGH_TUNING_BY_RUN,  /**< not but by its run: it reached its end or did not */
    GOUGH_TUNING_AT_REST, /**< at rest: at home, or where the program comes to rest */
    GOUGH_TUNING_ALONG    /**< along the program, over its period */
} gough_tuning_judged;

/** A point of the curve: deviation against G. */
typedef struct gough_tuning_point {
    double stiffness;  /**< G */
    double damping;    /**< D; NaN if no D gives the damping ratio: then this point was not run */
    gough_cause cause; /**< how the run ended; GOUGH_END_INVALID: not run */
    int leg;           /**< 1 … 6 if a leg is the cause, else 0 */
    double end_time;   /**< time at which the run ended */
    double position_deviation; /**< largest distance from the program up to then */
    double angle_deviation;    /**< largest angle from the program */
    double force;              /**< largest |leg force| */
    double speed;              /**< largest |leg rate| */
    double
        growth; /**< largest |Floquet multiplier| over a period of the program, or e^{growth rate} at rest, as `judged` says; NaN:
                     not found, or not looked for */
    gough_tuning_judged judged; /**< how `stable` was found */
    bool stable;  /**< growth is at most 1 + 1e-7; judged by its run, the run reached its end */
    bool regular; /**< follows the trend, see gough_tuning.slope */
    bool
        small_steps; /**< computed with fixed steps of at most a hundredth of the output step, which end at each corner
                                     of program and disturbance, as every point is that is 100 times off the trend */
    char mode[GOUGH_MODE_NAME]; /**< the mode that grows fastest or decays slowest */
} gough_tuning_point;

/** The requirement that keeps G from being smaller. */
typedef enum gough_tuning_binding {
    GOUGH_TUNING_POSITION,  /**< the deviation of position */
    GOUGH_TUNING_ANGLE,     /**< the deviation of angle */
    GOUGH_TUNING_END,       /**< runs with a smaller G end early */
    GOUGH_TUNING_THRESHOLD, /**< within the margin below G, the loop is unstable at rest */
    GOUGH_TUNING_TONGUE,    /**< within the margin below G, the program's own motion pumps a mode */
    GOUGH_TUNING_SEARCH     /**< none: G is the least of the search */
} gough_tuning_binding;

/** "position", "angle", "end", "threshold", "tongue", "search". */
GOUGH_API const char *gough_tuning_binding_name(gough_tuning_binding binding);

/** Why points of the curve do not follow its trend. */
typedef enum gough_tuning_exception_kind {
    GOUGH_TUNING_ENDED,    /**< the runs end early */
    GOUGH_TUNING_UNSTABLE, /**< deviations grow: below a threshold or in a tongue */
    GOUGH_TUNING_OFF_TREND /**< the deviation differs from the trend's */
} gough_tuning_exception_kind;

/** "ended", "unstable", "off_trend". */
GOUGH_API const char *gough_tuning_exception_name(gough_tuning_exception_kind kind);

/** Neighbouring points that do not follow the trend. */
typedef struct gough_tuning_exception {
    double from;                      /**< least G of them */
    double to;                        /**< greatest G of them */
    gough_tuning_exception_kind kind; /**< why */
    gough_cause cause;                /**< of early ends; else GOUGH_END_DONE */
    bool small_steps;                 /**< all of them were run with small steps */
    double worst;                     /**< largest ratio of deviation to trend; NaN: no trend */
    char mode[GOUGH_MODE_NAME];       /**< the mode that grows, if they are unstable; else "" */
} gough_tuning_exception;

enum { GOUGH_TUNING_EXCEPTIONS = 96, GOUGH_TUNING_POINTS = 320 };

/** The result. Numbers of a run are those of the run with this G and D. */
typedef struct gough_tuning {
    bool found;       /**< true if some G meets the request; else `reason` is why none does */
    char reason[500]; /**< one sentence, or empty */
    double stiffness; /**< G, rounded to five digits */
    double
        damping; /**< D, rounded to nine digits; leg 1's if the model's damping differs between legs */
    double damping_ratio;   /**< of the least damped mode at home, with them */
    double deviation;       /**< largest distance from the program */
    double deviation_time;  /**< time at which it occurs */
    double angle_deviation; /**< largest angle, radians */
    double angle_time;      /**< time at which it occurs */
    double fails;           /**< the greatest G below it that was found insufficient; NaN: none */
    gough_tuning_binding binding; /**< why it is insufficient */
    gough_cause cause;            /**< why runs with a smaller G end early, if that binds */
    gough_mode
        mode; /**< the mode that binds: the one with the largest part of the worst deviation, or the one that grows */
    double mode_share;  /**< its share of that deviation; NaN if stability binds */
    int leg;            /**< the leg with the largest force, 1 … 6 */
    double force;       /**< that force, pushing or pulling */
    double force_share; /**< share of the force limit used; NaN: no limit */
    double speed;       /**< largest |leg rate| of any leg */
    double speed_share; /**< share of the speed limit used; NaN: no limit */
    bool
        periodic; /**< true if stability was computed over a period of the program; else at rest only */
    char unchecked[240];   /**< why at rest only, as a sentence, or empty */
    double threshold;      /**< largest threshold of G at rest with feed-forward */
    gough_mode least_mode; /**< its mode */
    /** the controller is sampled: points of the curve are examined at rest at home, from sample to sample, the G named and its
     *  margin along the program too if `periodic`. So are points that hold at home, see `judged`, if that takes at most 100
     *  samples. Damping ratios are those of the poles ln μ/T of the multipliers at rest */
    bool sampled;
    /** the controller is continuous, and drives lag or integrals add up: the same, but that points which hold at home are examined
     *  along the program if its period is at most 128 time constants of the drives and the program's forces are fed forward.
     *  Damping ratios are those of all poles, of drives and integrals too */
    bool states;
    double upper; /**< if so: G from which the loop at home is unstable, or above which no D gives
                       the damping ratio, with feed-forward; infinite: no G of the search; NaN: neither sampled nor with such
                       states, or no G holds */
    double upper_frequency; /**< angular frequency of the mode that grows there, or is the least
                                 damped; NaN: as upper */
    gough_mode upper_mode;  /**< that mode */
    double slope; /**< d log deviation / d log G, least squares over regular points; NaN: too few */
    double scale; /**< deviation ≈ scale · G^slope */
    size_t points;     /**< number of points of the curve, by rising G */
    size_t exceptions; /**< number of exceptions stored */
    gough_tuning_exception exception[GOUGH_TUNING_EXCEPTIONS]; /**< by rising G */
    size_t runs;                                               /**< number of simulations */
} gough_tuning;

/** Checks the options and computes the size of the memory that gough_tune() needs, in bytes.
 *  @return GOUGH_OK; GOUGH_ERROR_INPUT: an option out of its range, a period that the motion does not have;
 *  GOUGH_ERROR_NUMERICAL: a singular home pose. */
GOUGH_API gough_status gough_tune_size(const gough_model *model,
                                       const gough_tuning_options *options, size_t *bytes,
                                       gough_error *error);

/** Finds the least G, the same in all legs, with which the run meets the request.
 *
 *  Disturbances, initial state, program, duration and method are the model's; its stiffness is not used. Adaptive runs take the
 *  smaller of the tolerance given and 1e-4 of the deviation asked for; a fixed step is halved until it follows the fastest mode.
 *  Deviations are taken as often as that mode needs. Before a G is reported, a run with steps of a hundredth of the output step
 *  must confirm it; if it does not, the search is repeated with such steps. The resulting G meets the accuracy; a G smaller
 *  by 1e-4 of it does not, nor does any smaller G that was tried, 20 in each decade. Unstable values that meet it are
 *  skipped.
 *  @param feedforward  whether program forces are fed forward; the model's own choice is not used. What they ignore of the machine
 *                      is the model's
 *  @param[out] point   GOUGH_TUNING_POINTS of them, the curve
 *  @param[out] tuning  `found` is false if no G meets the request, with the reason
 *  @param memory       gough_tune_size() bytes, aligned to 64; nothing else is allocated
 *  @return GOUGH_OK, even if none is found; GOUGH_ERROR_INPUT: an option out of its range, a search that stays below the
 *  threshold of a home pose which needs feedback, a period that the motion does not have; GOUGH_ERROR_NUMERICAL: a singular home
 *  pose, or stopped. At most GOUGH_TUNING_POINTS points, and a million steps in each run. */
GOUGH_API gough_status gough_tune(const gough_model *model, const gough_simulation *simulation,
                                  bool feedforward, const gough_tuning_options *options,
                                  gough_tuning_point *point, gough_tuning *tuning, void *memory,
                                  gough_error *error);

/** The damping D, the same in all legs, with which the least damped mode at home has a damping ratio, (tune-1).
 *  @param model      with the wanted G; its damping is ignored. Without feed-forward, home is where the loop rests. With drives
 *                    that lag, integrals or a sampled controller the ratio is that of all poles of the loop, and the least D
 *                    that gives it is taken
 *  @param ratio      in [0, 1)
 *  @return GOUGH_OK; GOUGH_ERROR_NUMERICAL: home is singular or, with this G, unstable, so no damping helps;
 *  GOUGH_ERROR_INPUT: a ratio out of its range. Exact up to rounding of the eigenvalues. Allocates nothing. */
GOUGH_API gough_status gough_damping_for_ratio(const gough_model *model, double ratio,
                                               double *damping, gough_error *error);

/** Gains that couple the legs, and the loop at rest with them. Their loop is the ideal one: a continuous controller, drives whose
 *  force is the command, no integral, forces of rest fed forward; legs with mass and viscous friction, without dry friction. */
typedef struct gough_gains {
    gough_state state;                        /**< of rest in the requested pose */
    double stiffness[GOUGH_LEGS][GOUGH_LEGS]; /**< G: [leg that pushes][leg whose error it is] */
    double damping[GOUGH_LEGS][GOUGH_LEGS];   /**< D likewise */
    gough_eigenvalue pole[2 * GOUGH_LEGS];    /**< of the loop with them, found from it: by falling
                                                growth rate, then by rising frequency */
    double residual; /**< what is left of the Riccati equation, over the sum of its terms' sizes,
                          (tune-9); 0 for gains by poles */
} gough_gains;

/** G and D that give all six modes at rest one frequency and one damping ratio, (tune-6).
 *  @param component      surge … yaw from home of the point `about` of the motion, radians; NULL: home
 *  @param frequency      F, in cycles per unit of time, > 0: poles lie at the distance 2πF from 0
 *  @param damping_ratio  ζ, 0 … 1
 *  @param[out] gains     use it only if the status is GOUGH_OK
 *  @return GOUGH_OK; GOUGH_ERROR_INPUT: a number out of its range, a component that is not finite; GOUGH_ERROR_NUMERICAL: a
 *  singular pose, numbers that differ too much in size.
 *
 *  The model's gains are not used. G is symmetric if external loads have base axes and no moment, and D always. Poles are those
 *  asked for, to 1e-14 times the square of the condition of the pose. Allocates nothing. */
GOUGH_API gough_status gough_gains_by_poles(const gough_model *model,
                                            const double component[GOUGH_COMPONENTS],
                                            double frequency, double damping_ratio,
                                            gough_gains *gains, gough_error *error);

/** G and D with which the loop at rest comes back from any small deviation at the least cost: the integral of
 *  q₁|l^p − l|² + q₂|l̇^p − l̇|² + |u|², with u what feedback adds to the leg forces, (tune-7) … (tune-9). With both weights 0 it
 *  is the least effort that holds the load: growing modes are mirrored into decaying ones.
 *  @param component      as in gough_gains_by_poles()
 *  @param length_weight  q₁, >= 0, the square of a stiffness
 *  @param rate_weight    q₂, >= 0, the square of a damping
 *  @param[out] gains     use it only if the status is GOUGH_OK; G and D need not be symmetric
 *  @return as gough_gains_by_poles(); GOUGH_ERROR_NUMERICAL also if there is no such feedback, because a mode neither grows nor
 *  decays and does not count in the cost, or if the Riccati equation is not solved to 1e-12 of its terms.
 *
 *  The model's gains are not used. Accurate to that residual times the condition of the equation. Allocates nothing. */
GOUGH_API gough_status gough_gains_by_lqr(const gough_model *model,
                                          const double component[GOUGH_COMPONENTS],
                                          double length_weight, double rate_weight,
                                          gough_gains *gains, gough_error *error);

/** Puts G and D into a control, which then is `coupled`; its other members stay. Exact. */
GOUGH_API void gough_gains_apply(const gough_gains *gains, gough_control *control);

#ifdef __cplusplus
}
#endif
#endif
