/** @file batch.h
 *  Many runs of forward dynamics at once: runs that share a program are computed side by side in the lanes of vector registers,
 *  and distributed over threads. The bits are the same for any number of lanes and threads, and for fixed steps the same as those
 *  of gough_simulate(). Numbers are in the units of the models, angles in radians.
 *
 *  Accuracy: the same bits as gough_simulate() with fixed steps, and as accurate with adaptive ones.
 *  Overlap: outcomes and memory must not overlap each other or what the runs point to.
 *  Threads: functions may be called from several threads at once, on distinct outcomes and memory. gough_batch() starts threads
 *  of its own and waits for them.
 */
#ifndef GOUGH_BATCH_H
#define GOUGH_BATCH_H

#include "gough/simulate.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The parts that differ between runs; runs may share the objects pointed to. All runs of a batch follow one program. */
typedef struct gough_batch_run {
    const gough_machine *machine; /**< joints, load, gravity; the same height of home in all runs */
    const gough_control *control; /**< the same choice of feed-forward in all runs */
    const gough_disturbance *disturbance; /**< forces unknown to the controller */
    const gough_initial *initial;         /**< where the run starts */
    uint64_t number;          /**< number of the run, for its noise; replaces gough_noise.run */
    uint64_t sampling_number; /**< likewise, for noise and jitter of a sampled controller; replaces
                                   gough_sampling.run */
} gough_batch_run;

/** What sizes the legs, GOUGH_SIZING_LENGTH_LEAST … GOUGH_SIZING_HOLDS_TO, one for each line of gough/sizing.def: the least or the
 *  greatest value of the six legs over a run, or their sum, as that line says. */
enum gough_sizing {
#define GOUGH_SIZING_COLUMN(id, name, what, unit, of_legs) GOUGH_SIZING_##id,
#include "gough/sizing.def"
    GOUGH_SIZINGS
};

/** Outcome of a run. Peaks, deviations and work are those of the motion, between output times too, as
 *  gough_summary_look() takes them; with fixed steps the looks are at the ends of steps. Angles in radians. */
typedef struct gough_outcome {
    gough_cause cause;  /**< GOUGH_END_DONE, or why this run ended early */
    int leg;            /**< 1 … 6 if a leg is the cause, else 0 */
    double time;        /**< time of the end */
    double position[3]; /**< origin of the top frame at the last output time reached, base frame */
    double angles[3];   /**< roll, pitch, yaw there */
    double velocity[3]; /**< of the origin, base axes */
    double angular_velocity[3]; /**< base axes */
    double position_deviation;  /**< largest distance from the program */
    double angle_deviation;     /**< largest angle from the program */
    double force;               /**< largest |leg force| */
    double speed;               /**< largest |leg rate| */
    double power;               /**< largest power that a leg delivers; 0 if none delivers any */
    double power_least;         /**< least power of any leg; below 0 a leg brakes */
    double power_greatest;      /**< greatest power of any leg */
    double energy;              /**< net work of all legs */
    double drift;               /**< largest violation of (1.2) before projection */
    double rows;                /**< output times reached */
    double sizing
        [GOUGH_SIZINGS]; /**< by gough_sizing, if gough_batch_options.sizing asks for it; else NaN */
} gough_outcome;

/** How to run a batch; start from gough_batch_options_default(). */
typedef struct gough_batch_options {
    size_t size; /**< of this struct in bytes, from gough_batch_options_default(), or 0 */
    int lanes; /**< 0: as many as the processor has; else 1, 2, 4 or 8 (more than it has is an error) */
    int threads; /**< 0: one per processor that the process may use */
    bool sizing; /**< fill gough_outcome.sizing, for about a third more time */
    bool
        forces; /**< inverse dynamics along the program, as gough_forces(), in place of motion. Runs go one by one. Deviations and
                      drift of outcomes are NaN, and a limit that is exceeded does not end a run: the first one is its cause */
    /** Called occasionally, from one thread at a time, with the number of finished runs; nonzero stops. May be NULL. */
    int (*progress)(void *context, size_t done);
    void *context; /**< passed to progress */
} gough_batch_options;

/** Fills in the defaults: widest lanes, all processors, no progress.
 *  @param size  sizeof(gough_batch_options)
 *  @return as gough_platform_init() */
GOUGH_API gough_status gough_batch_options_init(gough_batch_options *options, size_t size);

/** The options that gough_batch_options_init() fills in. */
static inline gough_batch_options gough_batch_options_default(void) {
    gough_batch_options options;
    (void)gough_batch_options_init(&options, sizeof options);
    return options;
}

/** Widest lanes of this processor: 8 (AVX-512), 4 (AVX2) or 2. */
GOUGH_API int gough_batch_lanes(void);

/** Number of threads that a batch uses for a value of gough_batch_options.threads: that value, or if it is 0 the number of
 *  processors that the process may use; at most 256. */
GOUGH_API int gough_batch_threads(int wanted);

/** Bytes of memory that gough_batch() needs, aligned to 64, for any number of runs. */
GOUGH_API size_t gough_batch_size(const gough_batch_options *options);

/** Runs a batch.
 *  @param motion      the program of all runs
 *  @param simulation  fixed steps run in lanes; adaptive dop853 and quadruple precision run one by one, on all threads
 *  @param runs,count  the runs; none of the objects that they point to may overlap an output
 *  @param options        NULL is not allowed
 *  @param[out] outcomes  @p count of them, in the order of the runs
 *  @param memory      gough_batch_size() bytes, aligned to 64; nothing else is allocated, except by the
 *                     system for threads
 *  @return GOUGH_OK, even if runs ended early (see their outcomes); GOUGH_ERROR_INPUT for invalid options, or runs of
 *  motion that differ in height or feed-forward; GOUGH_ERROR_NUMERICAL if the progress function stopped it
 *  (unfinished runs have 0 rows). Bits do not depend on lanes and threads. */
GOUGH_API gough_status gough_batch(const gough_motion *motion, const gough_simulation *simulation,
                                   const gough_batch_run *runs, size_t count,
                                   const gough_batch_options *options, gough_outcome *outcomes,
                                   void *memory, gough_error *error);

#ifdef __cplusplus
}
#endif
#endif
