/** @file study.h
 *  Study files: reads YAML and returns a validated model, or every error with its place. These functions allocate and read files.
 *
 *  Accuracy: numbers of a file are read to the nearest double and then converted to SI and radians, which costs a few roundings.
 *  Overlap: nothing that a study owns may be passed where it is written.
 *  Threads: functions may be called from several threads at once, on distinct studies; a study that is not changed may be shared.
 */
#ifndef GOUGH_STUDY_H
#define GOUGH_STUDY_H

#include "gough/design.h"
#include "gough/fields.h"
#include "gough/model.h"
#include "gough/simulate.h"
#include "gough/units.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    GOUGH_REMARKS = 32,      /**< at most about one record */
    GOUGH_REMARK_TEXT = 400, /**< bytes of a sentence, its end included */
};

/** A sentence about a valid study: what was changed when it was read, or a warning that results may be wrong. */
typedef struct gough_remark {
    bool warning;                     /**< results may be wrong */
    char sentence[GOUGH_REMARK_TEXT]; /**< UTF-8, in the study's units, without a full stop */
} gough_remark;

/** One column of recorded motion, in the study's units. */
typedef struct gough_record_column {
    bool given; /**< the file has it */
    double
        step; /**< step in which its values are written, the largest if steps differ; 0: none found. Of angles about
                   turned axes: twice the largest error that the steps of roll, pitch and yaw can make */
    double
        rounding; /**< greatest acceleration that rounding to the steps of values and times can make */
    double motion;       /**< greatest acceleration of the motion, without that */
    double cutoff;       /**< of the smoothing, in cycles per unit of time; INFINITY: as recorded */
    double change;       /**< root mean square of what smoothing changed */
    double worst_change; /**< and the greatest */
} gough_record_column;

/** What the reader found in recorded motion (`motion.samples`). */
typedef struct gough_record {
    double time_step; /**< step in which the times are written; 0: none found */
    double interval;  /**< time between rows, without gaps; the mean if rows are uneven */
    bool even;    /**< rows are at whole multiples of the interval, but for rounding of the times */
    bool retimed; /**< the rounding was removed from the times */
    gough_unwrapping unwrapped; /**< what was done to the angles */
    bool turned; /**< roll, pitch, yaw below are angles about turned axes, gough_samples.axes */
    double
        pole_distance; /**< if so, the least distance of a row from the pole of these, in the study's unit of angle */
    gough_record_column column[GOUGH_COMPONENTS]; /**< surge … yaw */
    size_t remarks;                               /**< how many sentences follow */
    gough_remark remark[GOUGH_REMARKS];           /**< in the order of what they are about */
} gough_record;

/** A study as read. All memory belongs to it; free it with gough_study_free(). */
typedef struct gough_study {
    char *title;        /**< UTF-8, never NULL; "" if none */
    char *text;         /**< the file's text as read, terminated */
    char *name;         /**< the path it was read from, for messages */
    bool dimensionless; /**< units: dimensionless */
    gough_units
        units; /**< in which its numbers are written and read; the model is in SI, or dimensionless */
    gough_model *model;          /**< validated */
    gough_simulation simulation; /**< how to run it */
    const gough_record *record;  /**< analysis of its recorded motion; NULL: it has none */
    bool swept;                  /**< true if it has a section `sweep`, see sweep.h */
    bool
        noise_run_given; /**< true if it has disturbance.noise.run, even 0: all runs of a sweep have the same noise */
    bool
        sampling_run_given; /**< likewise for control.sampling.run and the random numbers of a sampled controller */
    char *samples; /**< path of its recorded motion; NULL: none */
    void *memory_; /**< private: samples, moves */
} gough_study;

/** One override, as from `--set control.stiffness=50`. */
typedef struct gough_setting {
    const char *key; /**< dotted path; list elements are numbered from 1: disturbance.leg_force.2 */
    const char *value; /**< the value as YAML */
} gough_setting;

/** Opens a file for reading. It is a regular file or a descriptor of the process (`/dev/stdin`, `/dev/fd/3`); "-" is standard
 *  input, which the caller must not close. Folders, and pipes and devices by name, are refused, because reading them may block.
 *  @return the descriptor; -1 with a sentence, GOUGH_ERROR_FILE */
GOUGH_API int gough_open_input(const char *path, gough_error *error);

/** Kinds of input, as flags. */
enum {
    GOUGH_INPUT_STUDY = 1, /**< a study */
    GOUGH_INPUT_CSV = 2,   /**< a table in CSV */
    GOUGH_INPUT_HDF5 = 4,  /**< a table in HDF5 */
    GOUGH_INPUT_SHARD = 8  /**< a shard of a sweep */
};

/** What an open file is by its first bytes, for a message where another kind is wanted; its place in the file does not move.
 *  @param file    descriptor, as from gough_open_input()
 *  @param wanted  flags of the kinds that are right
 *  @return words to follow "is", such as "a table of results in HDF5, which `gough plot` draws"; NULL if the file is of a wanted
 *  kind, of no kind that gough reads or writes, or not a regular file. The words live as long as the program. */
GOUGH_API const char *gough_input_kind(int file, unsigned wanted);

/** One column of a file of recorded motion. */
typedef struct gough_motion_column {
    const char *name; /**< as the file has it, without quotes; "" if no row names it */
    const char *unit; /**< beside the name or below it, "" if none */
    const char *
        quantity; /**< "t", "heave", "qw", "r11" …: what the mapping below takes it for; "" if it leaves it out */
    bool certain; /**< the name and unit leave no doubt about that */
    size_t
        numbers; /**< rows in which it has a number; what follows is of these, in the unit of the file, NaN if none */
    double least;    /**< least number */
    double greatest; /**< greatest number */
    double
        step; /**< step in which its numbers are written, the largest if steps differ; 0: none found */
    double
        acceleration; /**< that rounding to this step can make, per square of the unit of the times; NaN without times */
    double jump;     /**< greatest change from a row to the next */
    size_t jump_row; /**< the later of these rows, from 1; 0 if nothing changes */
} gough_motion_column;

/** What a file of recorded motion is, for whoever writes the mapping of `motion.samples`. */
typedef struct gough_motion_file {
    size_t rows;                       /**< of numbers */
    size_t columns;                    /**< of the file */
    const gough_motion_column *column; /**< each of them */
    char separator; /**< a comma, a semicolon, a tab, or ' ' for blanks and tabs */
    char decimal;   /**< '.' or ',' */
    bool named;     /**< a row names the columns */
    size_t first;   /**< line of the first row of numbers, from 1 */
    size_t time;    /**< column of the times, from 1; 0: none is known */
    double
        interval; /**< time between two rows, NaN without times; all times in the unit of the file */
    double time_step; /**< step in which the times are written; 0: none found */
    bool even;    /**< rows are at whole multiples of the interval, but for rounding of the times */
    bool certain; /**< a bare file name is enough; else the mapping is a proposal */
    const char *mapping; /**< value of `motion.samples` as one line of YAML */
    void *memory_;       /**< private */
} gough_motion_file;

/** Reads a file of recorded motion and describes it. At most 2 000 000 rows; it takes the memory of all numbers of the file and
 *  half as much besides.
 *  @param path  a regular file; the mapping names it so
 *  @param[out] file      set on GOUGH_OK only; free with gough_motion_file_free()
 *  @param[out] messages  as from gough_study_read()
 *  @return as gough_study_read() */
GOUGH_API gough_status gough_motion_file_read(const char *path, gough_motion_file **file,
                                              char **messages);

/** Frees a description; NULL is ignored. */
GOUGH_API void gough_motion_file_free(gough_motion_file *file);

/** Reads, checks and prepares a study.
 *
 *  All errors are reported together, up to a hundred messages in the order of the file: `file:line:column: error: sentence`,
 *  followed by the line and a caret; for an override `--set KEY: error: sentence`. Columns count characters from 1.
 *  @param path      file; "-" reads standard input
 *  @param settings  overrides, applied in order before the checks; an empty value removes the key
 *  @param[out] study     set on GOUGH_OK only; free with gough_study_free()
 *  @param[out] messages  text with every error found, NULL if none; free with gough_study_free_messages()
 *  @return GOUGH_OK, GOUGH_ERROR_INPUT (the text or the machine it describes is invalid) or GOUGH_ERROR_FILE (it or its samples
 *  cannot be read), for any bytes. A study has at most 64 KiB of UTF-8, one document, no anchors, aliases or tags. */
GOUGH_API gough_status gough_study_read(const char *path, const gough_setting *settings,
                                        size_t setting_count, gough_study **study, char **messages);

/** The same for a text in memory, which need not be terminated; @p name is the file's name in messages, and
 *  relative paths of samples start from its folder. */
GOUGH_API gough_status gough_study_parse(const char *name, const char *text, size_t length,
                                         const gough_setting *settings, size_t setting_count,
                                         gough_study **study, char **messages);

/** The place of the key with which a sentence about a study begins, such as "motion.heave … is not finite at t = 2".
 *  @param sentence    of an error or an end of a run
 *  @param[out] place  "own.yaml:12:10" or "--set motion.heave", at most @p size bytes, terminated; "" if it has no place
 *  @return the length of the whole place; 0 if the sentence begins with no key that the study or its settings give. */
GOUGH_API size_t gough_study_place(const gough_study *study, const char *sentence, char *place,
                                   size_t size);

/** Frees a study; NULL is allowed. */
GOUGH_API void gough_study_free(gough_study *study);
/** Frees messages; NULL is allowed. */
GOUGH_API void gough_study_free_messages(char *messages);

/** One key of a study file. The reader checks against this table, and the guide repeats it. */
typedef gough_field gough_key;

/** The table of keys in the order of the guide; @p count receives their number. They are the first of gough_fields(). */
GOUGH_API const gough_key *gough_study_keys(size_t *count);

/* ---- designs ------------------------------------------------------------------------------------------------- */

/** A study with its section `design`, as read. Opaque; for one thread at a time. */
typedef struct gough_design_study gough_design_study;

/** One key that varies. */
typedef struct gough_design_key {
    const char *path; /**< "platform.top.radius" */
    const char *unit; /**< as in the table of keys: "length", "angle [degrees]", "" … */
    double least;     /**< in the units of the study file */
    double greatest;  /**< likewise */
    double start;     /**< the study's own value */
} gough_design_key;

/** Reads a study and its section `design`; parameters, messages and status as gough_study_parse(). A study without that section
 *  or without workspace.box is an error, and so is a key that the study does not give or that belongs to the requirement.
 *  @param[out] design  set on GOUGH_OK only; free with gough_design_study_free() */
GOUGH_API gough_status gough_design_study_parse(const char *name, const char *text, size_t length,
                                                const gough_setting *settings, size_t setting_count,
                                                gough_design_study **design, char **messages);

/** Frees it; NULL is allowed. */
GOUGH_API void gough_design_study_free(gough_design_study *design);

/** The study as written. */
GOUGH_API const gough_study *gough_design_study_own(const gough_design_study *design);

/** The keys that vary, in the order of the file, which is also the order of the request's numbers. */
GOUGH_API const gough_design_key *gough_design_study_keys(const gough_design_study *design,
                                                          size_t *count);

/** The request of the study. Its numbers are in the units of the file; its maker keeps models in the memory of @p design.
 *  @param size  sizeof(gough_design_request)
 *  @return as gough_platform_init() */
GOUGH_API gough_status gough_design_study_request(gough_design_study *design,
                                                  gough_design_request *request, size_t size);

/** The text of the file with other values of the keys that vary; everything else, comments included, stays as it is. Values that
 *  settings gave are written too.
 *  @param value      one for each key, in the units of the file
 *  @param[out] text  terminated, in the memory of @p design; NULL unless GOUGH_OK is returned
 *  @return GOUGH_OK; GOUGH_ERROR_INPUT with a sentence if a setting changed a part of the file that cannot be written so;
 *          GOUGH_ERROR_FILE if out of memory. The text reads back as the same numbers, exactly. */
GOUGH_API gough_status gough_design_study_text(gough_design_study *design, const double *value,
                                               const char **text, gough_error *error);

#ifdef __cplusplus
}
#endif
#endif
