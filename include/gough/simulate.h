/** @file simulate.h
 *  One run: the program's forces (inverse dynamics along the motion) or the motion under forces, control and
 *  disturbances (forward dynamics), as rows of named columns that are passed to the caller one by one.
 *
 *  Numbers are in the units of the model, angles in radians. An error argument may be NULL.
 *
 *  Accuracy: that of the method with its step or tolerance for gough_simulate(); as each function says for the others.
 *  Overlap: outputs must not overlap inputs or each other.
 *  Threads: every function may be called from several threads at once, on distinct outputs; models may be shared. Sinks are
 *  called in the caller's thread.
 */
#ifndef GOUGH_SIMULATE_H
#define GOUGH_SIMULATE_H

#include "gough/model.h"

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__SIZEOF_FLOAT128__)
/** 33 significant digits. */
__extension__ typedef __float128 gough_quad;
#else
/** 33 significant digits. */
typedef long double gough_quad;
#endif

/** Columns of a row, in the order of every table: GOUGH_T, GOUGH_X … GOUGH_S_LAST, one for each line of gough/columns.def, six for
 *  each line of legs, eighteen for each line of their vectors. Names and dimensions are those of gough_column(). Angles are in
 *  radians here. */
enum gough_column {
#define GOUGH_COLUMN(id, name, what, length, mass, time, angle, when) GOUGH_##id,
#define GOUGH_LEG_COLUMNS(id, name, what, after, length, mass, time, angle, when)                  \
    GOUGH_##id, GOUGH_##id##_LAST = GOUGH_##id + GOUGH_LEGS - 1,
#define GOUGH_LEG_VECTORS(id, name, what, after, length, mass, time, angle, when)                  \
    GOUGH_##id, GOUGH_##id##_LAST = GOUGH_##id + 3 * GOUGH_LEGS - 1,
#include "gough/columns.def"
    GOUGH_COLUMNS
};

/** Name and dimension of a column: its unit is length^l · mass^m · time^t · angle^a. */
typedef struct gough_column_info {
    const char *name;      /**< "t", "x", … "s6" */
    const char *long_name; /**< "time", "x of the top frame's origin", … */
    int length;            /**< exponent of the unit of length */
    int mass;              /**< of mass */
    int time;              /**< of time */
    int angle;             /**< of angle */
} gough_column_info;

/** Name and dimension of a column; NULL outside the enumeration. The information lives as long as the program. Safe to call
 *  concurrently.
 *  @param column  GOUGH_T … GOUGH_S_LAST */
GOUGH_API const gough_column_info *gough_column(int column);

/** One row. Columns that the verb does not fill are NaN (see gough_column_filled()). */
typedef struct gough_row {
    double value[GOUGH_COLUMNS]; /**< by gough_column, angles in radians */
    const gough_quad
        *quad; /**< the same numbers in 33 digits, or NULL; valid during the call only */
} gough_row;

/** Called for each row in order of time; a value other than 0 stops the run (GOUGH_END_STOPPED). */
typedef int (*gough_sink)(void *context, const gough_row *row);

/** Steppers: Dormand and Prince's of order 8, the classical Runge–Kutta method, RATTLE and its compositions. */
typedef enum gough_method {
    GOUGH_DOP853,
    GOUGH_RK4,
    GOUGH_RATTLE2,
    GOUGH_RATTLE4,
    GOUGH_RATTLE6,
    GOUGH_RATTLE8,
    GOUGH_METHODS
} gough_method;
/** How i, j, k are kept orthonormal. */
typedef enum gough_constraints { GOUGH_PROJECTION, GOUGH_NONE, GOUGH_BAUMGARTE } gough_constraints;
/** Precision of a run: 16 or 33 digits. */
typedef enum gough_precision { GOUGH_DOUBLE, GOUGH_QUADRUPLE } gough_precision;

/** "dop853", "rk4", "rattle2" …; NULL outside the enumeration. */
GOUGH_API const char *gough_method_name(int method);

/** What a sampled controller knows at one of its samples, (loop-1). */
typedef struct gough_sample {
    uint64_t number;           /**< of the sample, from 0 */
    uint64_t run;              /**< gough_sampling.run, or gough_batch_run.sampling_number */
    double time;               /**< of the sample */
    double length[GOUGH_LEGS]; /**< as measured, with counts and noise */
    double rate[GOUGH_LEGS];   /**< rates of the lengths, exact whatever the controller takes */
    double program_force[GOUGH_LEGS];  /**< F^p, ahead by the preview; 0 if it is not fed forward */
    double program_length[GOUGH_LEGS]; /**< l^p */
    double program_rate[GOUGH_LEGS];   /**< its derivative */
} gough_sample;

/** A control law of the caller's.
 *  @param sample           what the controller knows
 *  @param[in,out] command  force of each drive: what the law of the model commands; may be replaced. Limits and lag of the
 *                          drives, and the delay, come after it */
typedef void (*gough_law)(void *context, const gough_sample *sample, double command[GOUGH_LEGS]);

/** Effort of a run of forward dynamics, and whether stability, not accuracy, limited its steps. */
typedef struct gough_statistics {
    long long
        steps; /**< steps that were kept; a fixed step that a corner divides counts as its parts */
    long long rejected; /**< adaptive steps that were made again, shorter */
    long long
        evaluations; /**< of the equations of motion; for rattle methods, of forces and moments */
    double
        stiff_rate; /**< if the loop is stiff: |λ| of its fastest mode, decay or oscillation, in 1/time; else 0 */
    double stiff_time; /**< time at which that was first found; 0 if stiff_rate is 0 */
} gough_statistics;

/** How to run; start from gough_simulation_default(): 20 units of time, a row every 0.05, dop853 with a
 *  tolerance of 1e-10, projection. */
typedef struct gough_simulation {
    size_t size;        /**< of this struct in bytes, from gough_simulation_default(), or 0 */
    double duration;    /**< from t = 0 */
    double output_step; /**< rows at k · output_step, k = 0 … ⌊duration/output_step + 1e-9⌋ */
    gough_method method; /**< the stepper */
    double
        step; /**< fixed step, a divisor of output_step; 0 with dop853: adaptive. A step in which the program or a disturbance
                     has a corner, or changes too fast for it, is made in parts. A last
                     step that would pass the duration ends there */
    double max_step; /**< longest step, fixed or adaptive; 0: no limit */
    double
        tolerance; /**< of an adaptive step: the RMS of error/(s + |y|) over the coordinates y, with s = R_b for positions and 1
                          for axes, each divided by √(R_b/g) for rates */
    gough_constraints constraints; /**< ignored by rattle methods, which keep them themselves */
    double baumgarte[2];           /**< α, β */
    gough_precision precision;     /**< of the whole run */
    bool reactions;                /**< fill the columns of Λ */
    bool joints;    /**< fill the columns of leg forces, joint forces and side loads */
    bool commands;  /**< fill the columns of the controller's commands */
    bool actuators; /**< fill the columns of measured lengths and of limits that hold the drives;
                         then those of the commands too */
    gough_law law; /**< called at each sample of a sampled controller, from the thread that computes
                        the run; NULL: the law of the model alone. A continuous controller has no
                        samples: with it, a law is refused */
    void *law_context;             /**< passed to it */
    struct gough_summary *summary; /**< filled by the run with peaks and time integrals of the
                                        motion itself, between rows too; NULL: not wanted */
    gough_statistics *statistics;  /**< filled by gough_simulate(), however the run ends; NULL: not
                                        wanted. gough_forces() makes no steps and fills zeros */
} gough_simulation;

/** Fills in the defaults: 20 units of time, a row every 0.05, dop853 with a tolerance of 1e-10, projection, double precision.
 *  @param size  sizeof(gough_simulation)
 *  @return as gough_platform_init() */
GOUGH_API gough_status gough_simulation_init(gough_simulation *simulation, size_t size);

/** The options that gough_simulation_init() fills in. */
static inline gough_simulation gough_simulation_default(void) {
    gough_simulation simulation;
    (void)gough_simulation_init(&simulation, sizeof simulation);
    return simulation;
}

/** Checks the options against the model.
 *  @return GOUGH_OK or GOUGH_ERROR_INPUT: duration, output_step or step not positive and finite, step not dividing
 *  output_step within 1e-9, more than 1e8 rows, tolerance outside the range of the precision (double 1e-15 … 1e-1,
 *  quadruple 1e-30 … 1e-1), a missing step that the method needs, or a step over max_step, Baumgarte with a rattle method,
 *  a duration beyond recorded motion, a control law that gough_control_check() refuses, a law of the caller's with a continuous
 *  controller, jitter with fixed steps, a fixed step that does not divide the period and the delay of a sampled controller within
 *  1e-9, more than 1e12 samples. */
GOUGH_API gough_status gough_simulation_check(const gough_model *model,
                                              const gough_simulation *simulation,
                                              gough_error *error);

/** Columns that a run fills: forces GOUGH_T … GOUGH_CONDITION, simulate up to GOUGH_DRIFT; both also the six reactions and the
 *  forces of the joints if the options ask for them.
 *  @param simulated   true for gough_simulate(), false for gough_forces()
 *  @param simulation  its options
 *  @return whether @p column is filled. */
GOUGH_API bool gough_column_filled(int column, bool simulated, const gough_simulation *simulation);

/** One interval of the program in which a leg or the platform exceeds a limit. */
typedef struct gough_crossing {
    gough_cause cause; /**< which limit */
    int leg;           /**< 1 … 6; 0: a limit of the platform */
    int component;     /**< of the platform: 1 … 6 for surge … yaw; 0: a limit of a leg */
    double limit;      /**< the limit */
    bool least;        /**< it is a least value, other than that of a length */
    double enter;      /**< time at which it begins */
    double leave;      /**< time at which it ends; INFINITY: still exceeded at the end of the run */
    double worst;      /**< the worst value in the interval (length, speed, force, …) */
    double worst_time; /**< time of that value */
} gough_crossing;

/** Called for each crossing in order of its beginning. */
typedef void (*gough_crossing_sink)(void *context, const gough_crossing *crossing);

/** Inverse dynamics along the program, (2.1)–(2.7): rows at the output times.
 *  Exceeded limits do not stop it: each crossing is located and passed to @p crossings (may be NULL) when it is over; those
 *  still open at the end of the run come last. @p end is then the earliest of them. A singular or nearly singular pose, a leg of no
 *  length or a formula that is not finite stops it.
 *  @return GOUGH_OK; GOUGH_ERROR_NUMERICAL if @p end has a cause other than done, with its time accurate to 1e-9 relative;
 *  GOUGH_ERROR_INPUT if a formula is not finite or the options are invalid. Allocates nothing. Numbers of a row are accurate to
 *  rounding, forces to 3e-14 times the condition number.
 *  @param sink  receives the rows; NULL: rows are not wanted */
GOUGH_API gough_status gough_forces(const gough_model *model, const gough_simulation *simulation,
                                    gough_sink sink, void *context, gough_crossing_sink crossings,
                                    void *crossings_context, gough_end *end, gough_error *error);

/** Forward dynamics, (1.4), (1.5), under control and disturbances: rows at the output times, up to the end.
 *  Stops at the first exceeded limit, singular pose, leg of no length or number that is not finite; earlier rows stay valid.
 *  @return as gough_forces(). Allocates nothing.
 *
 *  The error of each adaptive step is within the tolerance; fixed steps have the order of their method, down to rounding.
 *  docs/theory/accuracy.md lists the errors measured: 1e-11 in pose at t = 20 with a tolerance of 1e-13. */
GOUGH_API gough_status gough_simulate(const gough_model *model, const gough_simulation *simulation,
                                      gough_sink sink, void *context, gough_end *end,
                                      gough_error *error);

/* ---- a plant, step by step ------------------------------------------------------------------------------------- */

/** Bytes of memory of a plant, aligned to 64. */
GOUGH_API size_t gough_plant_size(void);

/** Makes a plant that the caller's controller moves step by step, such as for hardware in the loop: machine, drives and
 *  disturbances of a model, under commands instead of its control law.
 *  @param[out] plant  gough_plant_size() bytes, aligned to 64. Nothing is allocated, and nothing needs to be freed
 *  @param model       where it begins, what acts on it, and its program, which rows compare with; must outlive the plant
 *  @param simulation  method and fixed step, without which there is no step to make. Its duration counts only for
 *                     gough_simulation_check() and for how short the pulses are that steps must not pass
 *  @param[out] row    the beginning, before any command; NULL: not wanted
 *  @param[out] end    may be NULL
 *  @return GOUGH_OK; GOUGH_ERROR_INPUT if gough_simulation_check() refuses the options, or for adaptive steps or quadruple
 *  precision; GOUGH_ERROR_NUMERICAL if the motion ends where it begins, as @p end says */
GOUGH_API gough_status gough_plant_begin(void *plant, const gough_model *model,
                                         const gough_simulation *simulation, gough_row *row,
                                         gough_end *end, gough_error *error);

/** One fixed step of a plant, with commands that are held over it. With the commands of gough_simulate() for a controller that
 *  samples each step without delay, it gives the same bits.
 *  @param command   force that each drive is to have; its limits and lag come after it. A drive that lags begins with the first
 *                   command
 *  @param[out] row  the end of the step, as gough_simulate() would fill it; NULL: not wanted
 *  @param[out] end  why the motion has ended, with the time; may be NULL
 *  @return GOUGH_OK; GOUGH_ERROR_NUMERICAL if the motion has ended, in this step or before: the row is then not filled. Allocates
 *  nothing; takes about the same time each step, but where a program or a disturbance changes so fast that steps are divided. */
GOUGH_API gough_status gough_step(void *plant, const double command[GOUGH_LEGS], gough_row *row,
                                  gough_end *end, gough_error *error);

/** What follows a number in the message of an end, such as " m/s"; "" where numbers have no unit. */
typedef struct gough_end_words {
    const char *length;               /**< such as " m" */
    const char *speed;                /**< " m/s" */
    const char *acceleration;         /**< " m/s^2" */
    const char *force;                /**< " N" */
    const char *time;                 /**< " s" */
    const char *angle;                /**< " deg" */
    const char *angular_speed;        /**< " deg/s" */
    const char *angular_acceleration; /**< " deg/s^2" */
} gough_end_words;

/** Rewrites the message of an end with units. The library does not know the units, so the message of a run has none.
 *
 *  @param end  with its time and limit in the units that are named; convert them first if necessary
 *  @param words  what follows numbers of each dimension
 *
 *  The message of an end at a limit is written anew from cause, legs, component, limit and time; in other messages each
 *  "t = number" becomes the time of the end with its unit. Independent of the locale. */
GOUGH_API void gough_end_say(gough_end *end, const gough_end_words *words);

/* ---- a model and how to run it as one array --------------------------------------------------------------------- */

/** Doubles that gough_model_flatten() writes for @p model. */
GOUGH_API size_t gough_model_flat_size(const gough_model *model);

/** Writes a model and its options as an array of doubles, for another process, another machine or a page.
 *
 *  The array begins with the number of its format, which changes with the table of fields (fields.h), and the number of its
 *  doubles. It contains what the model was made from; gough_model_unflatten() derives the rest again, with the same bits. Safe to
 *  call concurrently on one model.
 *  @param model       validated
 *  @param simulation  how to run it
 *  @param[out] flat   gough_model_flat_size() doubles, exact */
GOUGH_API void gough_model_flatten(const gough_model *model, const gough_simulation *simulation,
                                   double *flat);

/** Bytes of memory that gough_model_unflatten() needs in addition to the model, for moves or the spline of recorded motion; 0 if it
 *  needs none or the head of the array is damaged. Never more than twice the size of the array, besides the
 *  external loads, of which there are at most GOUGH_EXTERNALS. */
GOUGH_API size_t gough_model_flat_memory(const double *flat, size_t count);

/** Reads a model and its options from such an array, which may come from an untrusted source.
 *
 *  A run of the result has the same bits as a run of the original.
 *  @param[out] model       complete on GOUGH_OK only
 *  @param[out] simulation  likewise, checked by gough_simulation_check()
 *  @param memory  gough_model_flat_memory() bytes, aligned for doubles; NULL if that is 0. It and @p flat, which contains the
 *                 recorded motion, must outlive the model
 *  @param flat,count  the array and its length
 *  @return GOUGH_OK, or GOUGH_ERROR_INPUT with a sentence: an unknown format, an array that is too short or too long, a number
 *  out of range, an invalid formula, a machine or options that fail their own checks. Numbers keep their bits. */
GOUGH_API gough_status gough_model_unflatten(gough_model *model, gough_simulation *simulation,
                                             void *memory, const double *flat, size_t count,
                                             gough_error *error);

/* ---- the summary of a run ----------------------------------------------------------------------- */

/** One leg over a run. */
typedef struct gough_leg_summary {
    double length_min; /**< least length */
    double length_max; /**< greatest length */
    double speed;      /**< peak |rate| */
    double force_min;  /**< least force; below 0 the leg pulls */
    double force_max;  /**< greatest force */
    double rms_force;  /**< root mean square over time */
    double power_min;  /**< least power; below 0 the leg absorbs power */
    double power_max;  /**< greatest power */
    double energy;     /**< net work done by the leg */
    double
        swing_base; /**< largest angle between its direction and that at home, relative to the base */
    double swing_top; /**< the same, relative to the top */
    double top_load;  /**< peak force between the leg and the top, its magnitude */
    double base_load; /**< peak force between the leg and the base, its magnitude */
    double side_load; /**< peak side load between cylinder and piston */
    double
        friction_loss; /**< work that friction takes, ∫ (u − F) l̇ dt, of drive force u and leg force F */
    double
        returned_energy; /**< energy that the leg returns to its drive while it brakes, −∫ min(power, 0) dt, at least 0 */
    double
        acceleration; /**< peak |second derivative of the length|; 0 unless the machine has a limit
                              of acceleration or of the platform */
    double
        saturated; /**< share of the time, 0 to 1, in which a limit of `actuators` held its drive back; NaN if unknown, as
                           from rows without the columns sat1 … sat6 and for forces along a program */
    double saturated_at; /**< time at which this was first so; NaN if never */
    double
        sample_error; /**< of a sampled controller the largest |l^p − l| that it found at a sample of the run, from the length as
                           measured, with its noise and counts; NaN if unknown, as saturated, and for a continuous one */
    double sample_error_at; /**< time of that sample; NaN likewise */
} gough_leg_summary;

/** Summary of the rows so far; fill it by gough_summary_begin(), gough_summary_add(), gough_summary_end(). For the motion
 *  itself, between rows too, let the run fill it: gough_simulation.summary. */
typedef struct gough_summary {
    gough_leg_summary leg[GOUGH_LEGS]; /**< legs 1 … 6 */
    size_t rows;                       /**< rows added */
    double first_time;                 /**< t of the first row */
    double last_time;                  /**< t of the last row */
    double condition;                  /**< largest condition number */
    double condition_time;             /**< time at which it occurs */
    double position_deviation;         /**< largest distance from the program; NaN for forces */
    double angle_deviation;            /**< largest angle from the program; NaN for forces */
    double drift;                      /**< largest violation of (1.2) before projection */
    gough_order order;                 /**< of the angles in the rows: GOUGH_ZYX unless set after
                            gough_summary_begin(). A run that fills the summary sets that of its motion */
    double
        external_work; /**< work that the external loads of the machine did on it; of looks, not of
                               rows alone */
    double
        between_rows; /**< greatest excess of a leg's length between two rows over both of them; 0 without looks
                              between rows */
    int between_leg; /**< that leg, 1 … 6; 0: none */
    /** Least and greatest values of the platform's components, those of gough_limits.pose, rate and second_rate at the point
     *  `about`; 0 unless the machine has a limit of acceleration or of the platform. */
    double component[3][GOUGH_COMPONENTS][2];
    double drawing_step; /**< rows this close draw the motion: chords miss lengths by a hundredth of
                              the longest stroke at most; 0 where between_leg is 0 */
    double window_
        [4][1 + 3 * GOUGH_LEGS]; /**< private: the last rows for the fourth-order time integrals */
    double square_[GOUGH_LEGS];  /**< private */
    double look_[4][5 + 14 * GOUGH_LEGS]; /**< private: the last looks */
    size_t looks_;                        /**< private: looks since a corner */
    double origin_;                       /**< private: time of the first look */
    double span_;                         /**< private: time since then */
    double between_[GOUGH_LEGS][3];       /**< private: lengths since the last row */
    double acceleration_;                 /**< private: largest of a leg */
    bool brief_;                          /**< private: what an outcome has, no more */
    bool joints_;                         /**< private: looks have forces of the joints */
    bool limited_;                        /**< private: component and acceleration are wanted */
    double about_[3];                     /**< private: their point */
    double held_[1 + GOUGH_LEGS]; /**< private: time and saturations of the last look or row */
} gough_summary;

/** An empty summary. Summaries are exact where rows or looks are, and of fourth order in their distance between them. */
GOUGH_API void gough_summary_begin(gough_summary *summary);
/** Adds one row, in the units and order of the run. Least and greatest values are exactly those of the rows. If the row lacks the
 *  forces of the joints (gough_simulation.joints), they are taken to be those of legs without mass and friction. */
GOUGH_API void gough_summary_add(gough_summary *summary, const gough_machine *machine,
                                 const gough_row *row);
/** Adds one instant of the motion, a row or a point between rows (a look), in order of time; do not mix with
 *  gough_summary_add().
 *
 *  Peaks are then those of the cubics through four neighbouring looks, whose distances may vary: peaks and time integrals are
 *  of fourth order in them, with an accuracy of about 1e-6 in runs that fill the summary. Columns that are NaN (position,
 *  condition, deviation) are left out of their peaks; forces of the joints that are NaN are taken as in gough_summary_add().
 *  @param is_row  true if this instant is a row of the table */
GOUGH_API void gough_summary_look(gough_summary *summary, const gough_machine *machine,
                                  const gough_row *row, bool is_row);
/** Marks the last look as a corner: derivatives of the motion may jump there, and nothing is
 *  interpolated across it. Values up to it are exact there. */
GOUGH_API void gough_summary_corner(gough_summary *summary);
/** Marks the last look as one after which other forces act: the next look, which may be of the same time, begins
 *  anew. Values up to it are exact there. */
GOUGH_API void gough_summary_jump(gough_summary *summary);
/** Completes the time integrals. Rows equally spaced are integrated to fourth order; cubics exactly but for rounding. */
GOUGH_API void gough_summary_end(gough_summary *summary);

#ifdef __cplusplus
}
#endif
#endif
