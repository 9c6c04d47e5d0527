/** @file sweep.h
 *  Many runs of one study with different numbers, as given in the section `sweep` of a study file. They run in lanes and threads,
 *  and a sweep that was killed resumes from its file. Runs are numbered from 1. The bytes are the same for any number of lanes,
 *  threads and shards.
 *
 *  Accuracy: that of gough_batch() for each run; swept values are the same bits as when they are read as settings.
 *  Overlap: outputs must not overlap inputs.
 *  Threads: a sweep may be shared by threads; a maker is for one thread at a time, and a file for one call. gough_sweep_run() and
 *  gough_sweep_write() start threads of their own and wait for them.
 */
#ifndef GOUGH_SWEEP_H
#define GOUGH_SWEEP_H

#include "gough/batch.h"
#include "gough/result.h"
#include "gough/study.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- the runs ---------------------------------------------------------------------------------------------- */

/** A study with its sweep, as read. Opaque and constant: safe to use from several threads. */
typedef struct gough_sweep gough_sweep;

/** How a key varies. */
typedef enum gough_sweep_kind {
    GOUGH_SWEEP_GRID,    /**< {from, to, steps, scale} */
    GOUGH_SWEEP_LIST,    /**< a list of numbers */
    GOUGH_SWEEP_UNIFORM, /**< {uniform: [low, high]} */
    GOUGH_SWEEP_NORMAL   /**< {normal: [mean, deviation]} */
} gough_sweep_kind;

/** One key that varies. */
typedef struct gough_sweep_key {
    const char *path; /**< "control.stiffness", "disturbance.leg_force.2" */
    const char *unit; /**< as in the table of keys: "force/length", "angle [degrees]", "" … */
    gough_sweep_kind kind; /**< by a grid, a list or a distribution */
    bool logarithmic;      /**< of a grid */
    double least;          /**< of a grid or list; else the first number of `uniform` or `normal` */
    double greatest;       /**< of a grid or list; else the second number */
    size_t count;          /**< values of a grid or list; 0 for a distribution */
} gough_sweep_key;

/** Reads a study and its section `sweep`; parameters, messages and status as gough_study_parse(). A study without that
 *  section, and a study that is invalid without the swept values, are errors.
 *  @param[out] sweep  set on GOUGH_OK only; free with gough_sweep_free() */
GOUGH_API gough_status gough_sweep_parse(const char *name, const char *text, size_t length,
                                         const gough_setting *settings, size_t setting_count,
                                         gough_sweep **sweep, char **messages);

/** Frees a sweep; NULL is allowed. */
GOUGH_API void gough_sweep_free(gough_sweep *sweep);

/** The study as written, without swept values. */
GOUGH_API const gough_study *gough_sweep_study(const gough_sweep *sweep);

/** The settings used to read it. */
GOUGH_API const gough_setting *gough_sweep_settings(const gough_sweep *sweep, size_t *count);

/** Number of runs, at most 1e8. */
GOUGH_API size_t gough_sweep_runs(const gough_sweep *sweep);

/** True if grids and lists are taken side by side (`combine: zip`); else each value of one runs with each value of the others. */
GOUGH_API bool gough_sweep_zipped(const gough_sweep *sweep);

/** Seed of the distributions. */
GOUGH_API uint64_t gough_sweep_seed(const gough_sweep *sweep);

/** The keys that vary, in the order of the file, which is also the order of a run's values. */
GOUGH_API const gough_sweep_key *gough_sweep_keys(const gough_sweep *sweep, size_t *count);

/** Values of a run, in the units of the study file (angles in degrees). In a product the last key changes fastest. The n-th
 *  distribution from 0 draws gough_random_uniform() or gough_random_normal() of (seed, run, n). The ends of grids are exact. */
GOUGH_API void gough_sweep_values(const gough_sweep *sweep, size_t run, double *value);

enum { GOUGH_SWEEP_TEXT = 32 };

/** A value as text, the shortest that reads back as the same number: what `--set` takes. Independent of the locale. */
GOUGH_API void gough_sweep_print(double value, char text[GOUGH_SWEEP_TEXT]);

/** Makes the study of one run at a time. Use one maker in each thread. Opaque. */
typedef struct gough_sweep_maker gough_sweep_maker;

/** A maker for a sweep, which must outlive it; NULL if out of memory. */
GOUGH_API gough_sweep_maker *gough_sweep_maker_new(const gough_sweep *sweep);

/** The study of a run: the same numbers, to the bit, as the study read with its values as settings.
 *  @param[out] study  set on GOUGH_OK: the maker's, valid until its next call
 *  @return GOUGH_OK; GOUGH_ERROR_INPUT if the values do not make a valid study, with the reason in @p error;
 *  GOUGH_ERROR_FILE if out of memory. */
GOUGH_API gough_status gough_sweep_make(gough_sweep_maker *maker, size_t run,
                                        const gough_study **study, gough_error *error);

/** Number that selects the noise of a run: disturbance.noise.run if its study gives it (0 counts), else @p run. */
GOUGH_API uint64_t gough_sweep_noise_run(const gough_study *study, size_t run);

/** The same for a sampled controller and control.sampling.run. */
GOUGH_API uint64_t gough_sweep_sampling_run(const gough_study *study, size_t run);

/** Frees a maker; NULL is allowed. */
GOUGH_API void gough_sweep_maker_free(gough_sweep_maker *maker);

/** Parts of a study changed by the swept values, as flags; the other parts are the same memory in all studies of a maker. */
enum {
    GOUGH_SWEEP_MACHINE = GOUGH_PART_MACHINE, /**< platform, load, gravity */
    GOUGH_SWEEP_HEIGHT =
        GOUGH_PART_HEIGHT, /**< the height at home; set together with GOUGH_SWEEP_MACHINE */
    GOUGH_SWEEP_MOTION = GOUGH_PART_MOTION,           /**< the program */
    GOUGH_SWEEP_DISTURBANCE = GOUGH_PART_DISTURBANCE, /**< the disturbances */
    GOUGH_SWEEP_CONTROL = GOUGH_PART_CONTROL,         /**< the control law */
    GOUGH_SWEEP_INITIAL = GOUGH_PART_INITIAL,         /**< where runs start */
    GOUGH_SWEEP_SIMULATION = GOUGH_PART_SIMULATION,   /**< how they are run */
    GOUGH_SWEEP_EXTERNAL = GOUGH_PART_EXTERNAL,       /**< the external loads */
    GOUGH_SWEEP_WORKSPACE = GOUGH_PART_WORKSPACE      /**< demands on all poses */
};

/** The flags of one key, or of all together for @p key at or beyond the last. */
GOUGH_API unsigned gough_sweep_touches(const gough_sweep *sweep, size_t key);

/* ---- running it ----------------------------------------------------------------------------------------------- */

/** Result of one run of a sweep. */
typedef struct gough_sweep_row {
    size_t run;          /**< its number, from 1 */
    const double *value; /**< swept values; valid during the call only */
    gough_outcome
        outcome; /**< units of the study, radians; cause GOUGH_END_INVALID if the values do not make a valid study */
} gough_sweep_row;

/** Called in the caller's thread for each run in order; a value other than 0 stops the sweep. */
typedef int (*gough_sweep_sink)(void *context, const gough_sweep_row *row);

/** How to run; start from gough_sweep_options_default(). */
typedef struct gough_sweep_options {
    size_t size;  /**< of this struct in bytes, from gough_sweep_options_default(), or 0 */
    int lanes;    /**< as in gough_batch_options */
    int threads;  /**< as in gough_batch_options */
    size_t first; /**< first run; 0: 1 */
    size_t last;  /**< last run; 0: all */
    bool sizing;  /**< as in gough_batch_options; tables then have a column for each gough_sizing */
    bool forces;  /**< as in gough_batch_options */
    /** Called in the caller's thread about ten times a second with the number of finished runs; nonzero stops. May be NULL. */
    int (*progress)(void *context, size_t done);
    void *context; /**< passed to progress */
} gough_sweep_options;

/** Fills in the defaults: all runs, widest lanes, all processors.
 *  @param size  sizeof(gough_sweep_options)
 *  @return as gough_platform_init() */
GOUGH_API gough_status gough_sweep_options_init(gough_sweep_options *options, size_t size);

/** The options that gough_sweep_options_init() fills in. */
static inline gough_sweep_options gough_sweep_options_default(void) {
    gough_sweep_options options;
    (void)gough_sweep_options_init(&options, sizeof options);
    return options;
}

/** Runs a sweep. Memory does not grow with the number of runs.
 *  @return GOUGH_OK; GOUGH_ERROR_NUMERICAL if sink or progress stopped it; GOUGH_ERROR_INPUT for invalid options;
 *  GOUGH_ERROR_FILE if out of memory or no thread could be started. */
GOUGH_API gough_status gough_sweep_run(const gough_sweep *sweep, const gough_sweep_options *options,
                                       gough_sweep_sink sink, void *context, gough_error *error);

/** A function that runs a sweep in place of gough_sweep_run() and keeps its promises, such as one that shares the runs out among
 *  machines. @p context is the caller's own. */
typedef gough_status (*gough_sweep_runner)(void *context, const gough_sweep *sweep,
                                           const gough_sweep_options *options,
                                           gough_sweep_sink sink, void *sink_context,
                                           gough_error *error);

/** A digest of everything that the numbers of a sweep depend on: study, settings, values, recorded motion, the kind of run, the
 *  version, and numbers that this build computes on this machine. Processes that share a sweep have the same digest.
 *  @return 0 if out of memory, or for options of another size */
GOUGH_API uint64_t gough_sweep_identity(const gough_sweep *sweep,
                                        const gough_sweep_options *options);

/* ---- its files ------------------------------------------------------------------------------------------------ */

/** Least and greatest value of a quantity over the runs of a sweep, in units of the study and radians. */
typedef struct gough_sweep_range {
    double least;        /**< NaN: no run has a value */
    double greatest;     /**< likewise */
    size_t least_run;    /**< which run has the least; 0: no run */
    size_t greatest_run; /**< likewise */
} gough_sweep_range;

/** Summary of a sweep. Runs that reached their duration count as done. Ranges are over these runs; in a sweep of forces, which no
 *  limit ends, also over the runs in which a limit is exceeded. */
typedef struct gough_sweep_summary {
    gough_units units;          /**< of the file's numbers; those here are in the study's */
    size_t runs;                /**< of the file */
    size_t resumed;             /**< of these, found in FILE.part */
    size_t ended[GOUGH_CAUSES]; /**< by gough_cause */
    size_t first_invalid;       /**< a run; 0: none */
    size_t first_not_finite;    /**< a run that ended so; 0: none */
    gough_sweep_range position; /**< of gough_outcome.position_deviation */
    gough_sweep_range angle;    /**< of gough_outcome.angle_deviation */
    gough_sweep_range force;    /**< of gough_outcome.force */
    gough_sweep_range speed;    /**< of gough_outcome.speed */
    gough_sweep_range power;    /**< least and greatest power of any leg; below 0 it brakes */
    gough_sweep_range sizing[GOUGH_SIZINGS]; /**< by gough_sizing, if the sweep has them */
    bool has_sizing;                         /**< true if it has */
    bool forces;                             /**< true for a sweep of forces along the program */
} gough_sweep_summary;

/** Output of a sweep. */
typedef struct gough_sweep_output {
    const char
        *path; /**< .h5 or .csv; "-": CSV on standard output; NULL: none; for a shard: .shard */
    bool
        dimensionless; /**< in R_b, M and √(R_b/g) of the study as written; swept values keep its units */
    size_t shard;              /**< number of this shard, from 1; 0: the whole sweep */
    size_t shards;             /**< number of shards; 0: the whole sweep */
    const char *const *also;   /**< further tables with the same rows; not for a shard */
    size_t also_count;         /**< number of further tables */
    gough_sweep_runner runner; /**< runs the sweep; NULL: gough_sweep_run() */
    void *runner_context;      /**< passed to it */
} gough_sweep_output;

/** Runs a sweep into a file, which is complete or absent. Until it is complete, finished runs are kept in PATH.part, to which
 *  records are only appended, and the same call resumes from there. PATH.part of another study, of other settings, of another
 *  version or in use by another process is GOUGH_ERROR_INPUT.
 *  @param options  `first` and `last` are ignored
 *  @return as gough_sweep_run(), GOUGH_ERROR_FILE also if a file could not be written; PATH.part is then kept. */
GOUGH_API gough_status gough_sweep_write(const gough_sweep *sweep,
                                         const gough_sweep_options *options,
                                         const gough_sweep_output *output,
                                         gough_sweep_summary *summary, gough_error *error);

/** Joins all shards of a sweep, in any order, into the file that the whole sweep would have written, byte for byte.
 *  @return GOUGH_OK; GOUGH_ERROR_INPUT if a file is not a shard, belongs to a different sweep, is given twice or is missing;
 *  GOUGH_ERROR_FILE. */
GOUGH_API gough_status gough_sweep_merge(const char *const *shard, size_t count, const char *path,
                                         gough_sweep_summary *summary, gough_error *error);

#ifdef __cplusplus
}
#endif
#endif
