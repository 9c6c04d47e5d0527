/** @file map.h
 *  The stability map: over stiffness, and over amplitude, frequency or damping as a second axis, what grows and how fast, with
 *  the intervals of stiffness in which a mode grows (resonance tongues, and what lies below a threshold) found whatever the grid.
 *  Theory: docs/theory/floquet.md. In lanes and threads; the same bits for any number of either. Part of libgough-analyse.
 *
 *  A row of the map is one value of the second axis; without a second axis there is one row. In a row whose program rests the
 *  map is that of rest: then growth rates only.
 */
#ifndef GOUGH_MAP_H
#define GOUGH_MAP_H

#include "gough/analyse.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What varies besides the stiffness. */
typedef enum gough_map_axis {
    GOUGH_MAP_NONE,      /**< nothing: one row */
    GOUGH_MAP_AMPLITUDE, /**< factor on the motion, on top of the study's own */
    GOUGH_MAP_FREQUENCY, /**< factor on the motion's frequency, on top of the study's own, > 0 */
    GOUGH_MAP_DAMPING    /**< D of all legs, in place of the study's */
} gough_map_axis;

/** Values of an axis. */
typedef struct gough_map_range {
    double from;      /**< the first */
    double to;        /**< the last, > from where there are more than one */
    size_t count;     /**< how many, ≥ 1 */
    bool logarithmic; /**< equal ratios instead of equal steps; from > 0 */
} gough_map_range;

/** The value number @p i, 0 … count − 1; the ends exactly. */
GOUGH_API double gough_map_value(const gough_map_range *range, size_t i);

/** What to map; start from gough_map_options_default(). */
typedef struct gough_map_options {
    gough_map_range stiffness; /**< G, the same in all legs, ≥ 0 */
    gough_map_axis axis;       /**< which second axis */
    gough_map_range second;    /**< its values; not looked at for GOUGH_MAP_NONE */
    double
        accuracy; /**< of multipliers, relative to the largest; 0: 1e-9. Rough programs, as recorded ones are,
                            may get 1e-6 only */
    double
        resolution; /**< narrower intervals may be missed: a part of the stiffness range; 0: 1e-6. Edges are found to this too,
                            at worst, and mostly a thousand times better */
    size_t intervals; /**< room for intervals in each row */
    int lanes;   /**< 0: the widest that the processor has; else 1, 2, 4 or 8, as for batches */
    int threads; /**< 0: one per processor that the process may use */
    /** Called now and then from one thread at a time with the part of the work done, 0 … 1; nonzero stops. May be NULL. */
    int (*progress)(void *context, double done);
    void *context; /**< handed to progress */
} gough_map_options;

/** No axes yet, 256 intervals a row, widest lanes, all processors, no progress. */
GOUGH_API gough_map_options gough_map_options_default(void);

/** One point of the grid. Without values (its row has none, or without feed-forward no periodic motion was found there): NaN, "",
 *  not stable. */
typedef struct gough_map_point {
    double growth; /**< largest |μ|: growth per period; NaN where the program rests */
    double rate;   /**< ln(growth)/T; at rest the largest Re λ */
    char
        mode[GOUGH_MODE_NAME]; /**< what grows fastest, or decays slowest: "heave", "sway–tilt" … */
    bool stable;               /**< no |μ| over 1 + 1e-7; at rest no Re λ over 1e-7 √(g/R_b) */
} gough_map_point;

/** Why a mode grows in an interval of stiffness. */
typedef enum gough_interval_kind {
    GOUGH_INTERVAL_STATIC, /**< below its threshold: it grows from G = 0 on, without swinging */
    GOUGH_INTERVAL_PLUS, /**< resonance at μ = +1: the mode swings a whole number of times in each period */
    GOUGH_INTERVAL_MINUS,      /**< resonance at μ = −1: a whole number and a half */
    GOUGH_INTERVAL_COMBINATION /**< two modes together, μ not real */
} gough_interval_kind;

/** "static", "resonance +1", "resonance -1", "combination". */
GOUGH_API const char *gough_interval_kind_name(gough_interval_kind kind);

/** An interval of stiffness in which a mode grows. Those of different modes may overlap. */
typedef struct gough_interval {
    double
        from; /**< G of its lower edge, which may lie below the range asked for, where the interval reaches into it */
    double to;                /**< of its upper edge */
    bool cut;                 /**< it goes on above the range: `to` is the end of the range */
    double stiffness;         /**< where in the range it grows most */
    double growth;            /**< growth per period there, NaN at rest */
    double rate;              /**< growth rate there */
    gough_interval_kind kind; /**< why */
    int modes; /**< how many do so alike: 2 where a symmetric machine sways in two directions */
    gough_mode mode; /**< what moves there, at the beginning of the period */
} gough_interval;

/** One row: a value of the second axis. */
typedef struct gough_map_row {
    double value;            /**< of the second axis, 0 where there is none */
    gough_error error;       /**< status GOUGH_OK, or why this row has no values */
    gough_period period;     /**< of its program */
    size_t intervals;        /**< how many are in its part of the list, by rising `from` */
    size_t intervals_missed; /**< how many more there were, narrower than these */
    size_t
        meetings; /**< where multipliers met that could have left the unit circle and did not, or in less than the resolution;
                          counted without damping and with feed-forward only */
    size_t steps; /**< of the integration in a period */
} gough_map_row;

/** The caller's memory for the answer. */
typedef struct gough_map {
    gough_map_point *point;   /**< [row][stiffness]: rows × options.stiffness.count */
    gough_map_row *row;       /**< one a value of the second axis */
    gough_interval *interval; /**< [row][options.intervals] */
} gough_map;

/** Rows of a map: 1 without a second axis. */
GOUGH_API size_t gough_map_rows(const gough_map_options *options);

/** Checks the options and says how much memory gough_map_find() needs beside the answer, aligned to 64.
 *  @return GOUGH_OK or GOUGH_ERROR_INPUT: an axis that has no values, or impossible ones, or would take more than 2^31 points. */
GOUGH_API gough_status gough_map_size(const gough_model *model, const gough_map_options *options,
                                      size_t *bytes, gough_error *error);

/** The map. The disturbances of the study are no part of it.
 *  @param memory  of gough_map_size(), aligned to 64; nothing else is allocated
 *  @return GOUGH_OK, also where rows have no values: a program that is not periodic or passes a singular pose at that amplitude,
 *  say (their errors tell); GOUGH_ERROR_INPUT for options; GOUGH_ERROR_NUMERICAL if progress stopped it. Without feed-forward
 *  the periodic motion depends on G and is sought at each: some hundred times slower, and intervals are sought on the grid
 *  only. Safe to call concurrently. */
GOUGH_API gough_status gough_map_find(const gough_model *model, const gough_map_options *options,
                                      gough_map *map, void *memory, gough_error *error);

#ifdef __cplusplus
}
#endif
#endif
