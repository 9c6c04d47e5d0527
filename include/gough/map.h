/** @file map.h
 *  The stability map: which mode grows, and how fast, over stiffness and, as a second axis, amplitude, frequency, damping, or
 *  period or delay of a sampled controller. The intervals of stiffness in which a mode grows (resonance tongues, intervals below a
 *  threshold or beyond what the delay bears) are found independently of the grid; those of sampled controllers, of drives that
 *  lag, of integrals and of matrices of gains between its points. Theory: docs/theory/floquet.md, docs/theory/loop.md. The bits
 *  are the same for any number of lanes and threads. In libgough-analyse.
 *
 *  A row of the map is one value of the second axis; without a second axis there is one row. If the program of a row is at rest,
 *  the row has growth rates at rest only. Numbers are in the units of the model. An error argument may be NULL.
 *
 *  Accuracy: that of gough_map_options.accuracy for multipliers, and of its `resolution` for the edges of intervals.
 *  Overlap: the arrays of the map, memory and inputs must not overlap.
 *  Threads: every function may be called from several threads at once, on distinct outputs, if LAPACK allows that, as usual
 *  builds do. gough_map_find() starts threads of its own and waits for them.
 */
#ifndef GOUGH_MAP_H
#define GOUGH_MAP_H

#include "gough/floquet.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The second axis. */
typedef enum gough_map_axis {
    GOUGH_MAP_NONE,      /**< no second axis: one row */
    GOUGH_MAP_AMPLITUDE, /**< factor on the motion, in addition to the model's own amplitude */
    GOUGH_MAP_FREQUENCY, /**< factor on the motion's frequency, in addition to the model's own, > 0 */
    GOUGH_MAP_DAMPING, /**< D of all legs, in place of the model's; of a matrix as with the stiffness */
    GOUGH_MAP_PERIOD, /**< T of the controller in place of the model's, > 0; delay and preview change in proportion. A
                              continuous controller becomes a sampled one without delay */
    GOUGH_MAP_DELAY /**< τ of a sampled controller, in place of the model's */
} gough_map_axis;

/** What a mode moves in, for gough_map_options.modes. */
enum {
    GOUGH_MAP_SWAY = 1,  /**< surge and sway */
    GOUGH_MAP_HEAVE = 2, /**< heave */
    GOUGH_MAP_TILT = 4,  /**< roll and pitch */
    GOUGH_MAP_YAW = 8    /**< yaw */
};

/** Values of an axis. */
typedef struct gough_map_range {
    double from;      /**< the first */
    double to;        /**< the last; > from if there is more than one */
    size_t count;     /**< number of values, ≥ 1 */
    bool logarithmic; /**< equal ratios instead of equal steps; from > 0 */
} gough_map_range;

/** Value number @p i, 0 … count − 1; the ends are exact. */
GOUGH_API double gough_map_value(const gough_map_range *range, size_t i);

/** Options of a map; start from gough_map_options_default(). */
typedef struct gough_map_options {
    size_t size; /**< of this struct in bytes, from gough_map_options_default(), or 0 */
    /** G, the same in all legs, ≥ 0. Of a matrix of stiffnesses the largest on its diagonal, or in it if the diagonal is 0; the
     *  others keep their proportion */
    gough_map_range stiffness;
    gough_map_axis axis;    /**< which second axis */
    gough_map_range second; /**< its values; ignored for GOUGH_MAP_NONE */
    /** 0: all modes; else a sum of GOUGH_MAP_SWAY … GOUGH_MAP_YAW: only modes that move in nothing else count, as if the others
     *  were held */
    unsigned modes;
    double
        accuracy; /**< of multipliers, relative to the largest; 0: 1e-9. Rough programs, such as recorded
                            ones, may reach only 1e-6 */
    double
        resolution; /**< as a fraction of the stiffness range: narrower intervals may be missed; 0: 1e-6. Edges are at least this
                            accurate, mostly a thousand times better */
    size_t intervals; /**< room for intervals in each row */
    int lanes;        /**< 0: as many as the processor has; else 1, 2, 4 or 8, as for batches */
    int threads;      /**< 0: one per processor that the process may use */
    /** Called occasionally, from one thread at a time, with the fraction of the work done, 0 … 1; nonzero stops. May be NULL. */
    int (*progress)(void *context, double done);
    void *context; /**< passed to progress */
} gough_map_options;

/** Fills in the defaults: no axes, 256 intervals in each row, widest lanes, all processors, no progress.
 *  @param size  sizeof(gough_map_options)
 *  @return as gough_platform_init() */
GOUGH_API gough_status gough_map_options_init(gough_map_options *options, size_t size);

/** The options that gough_map_options_init() fills in. */
static inline gough_map_options gough_map_options_default(void) {
    gough_map_options options;
    (void)gough_map_options_init(&options, sizeof options);
    return options;
}

/** One point of the grid. A point without a result (its row has an error, or no periodic motion was found where the loop does not
 *  keep its program or its controller is sampled, or the modes that count have multipliers below 1e-9 of the largest there, which
 *  are rounding) has NaN, an empty mode, and is not stable. */
typedef struct gough_map_point {
    double growth; /**< largest |μ|: growth per period; NaN if the program is at rest */
    double rate;   /**< ln(growth)/T; at rest the largest Re λ */
    char mode
        [GOUGH_MODE_NAME]; /**< the mode that grows fastest or decays slowest: "heave", "sway–tilt" …; "": neither */
    bool stable; /**< no |μ| over 1 + 1e-7; at rest no Re λ over 1e-7 √(g/R_b) */
} gough_map_point;

/** Why a mode grows in an interval of stiffness. */
typedef enum gough_interval_kind {
    GOUGH_INTERVAL_STATIC, /**< below its threshold: it grows from G = 0 on, without oscillating */
    GOUGH_INTERVAL_PLUS, /**< resonance at μ = +1: the mode makes a whole number of oscillations in each period */
    GOUGH_INTERVAL_MINUS, /**< resonance at μ = −1: a whole number and a half of oscillations */
    GOUGH_INTERVAL_COMBINATION, /**< combination resonance of two modes, μ not real */
    /** of a sampled controller, or another loop each of whose points is computed on its own, μ not real where the interval begins:
     *  the delay of the forces drives the mode, or two modes resonate. At rest, whenever the mode oscillates */
    GOUGH_INTERVAL_OSCILLATION
} gough_interval_kind;

/** "static", "resonance +1", "resonance -1", "combination", "oscillation". */
GOUGH_API const char *gough_interval_kind_name(gough_interval_kind kind);

/** An interval of stiffness in which a mode grows. Those of different modes may overlap. */
typedef struct gough_interval {
    double
        from; /**< G of its lower edge, which may lie below the requested range if the interval extends into it */
    double to; /**< G of its upper edge */
    bool cut;  /**< true if it continues above the range; `to` is then the end of the range */
    double stiffness;         /**< the G in the range with the greatest growth */
    double growth;            /**< growth per period there, NaN at rest */
    double rate;              /**< growth rate there */
    gough_interval_kind kind; /**< why */
    int modes; /**< number of modes with the same growth: 2 if a symmetric machine sways in two directions */
    gough_mode mode; /**< the mode there, at the beginning of the period */
} gough_interval;

/** One row: a value of the second axis. */
typedef struct gough_map_row {
    double value;        /**< of the second axis; 0 without one */
    gough_error error;   /**< status GOUGH_OK, or why this row has no results */
    gough_period period; /**< of its program */
    size_t intervals;    /**< number in its part of the list, ordered by `from` */
    size_t
        intervals_missed; /**< number of further intervals, narrower than these, for which there was no room */
    size_t
        meetings; /**< places where multipliers meet that could leave the unit circle but do not, or within less than the
                          resolution; counted only without damping and with feed-forward */
    size_t steps; /**< number of integration steps in a period */
    double
        sampling; /**< period of the controller that was used, as in gough_sampled_floquet; 0: continuous */
    size_t
        periods; /**< of the program that its samples fill, likewise; 0 at rest, and with a continuous controller */
} gough_map_row;

/** The map, in the caller's memory. */
typedef struct gough_map {
    gough_map_point *point;   /**< [row][stiffness]: rows × options.stiffness.count */
    gough_map_row *row;       /**< one for each value of the second axis */
    gough_interval *interval; /**< [row][options.intervals] */
} gough_map;

/** Rows of a map: 1 without a second axis. */
GOUGH_API size_t gough_map_rows(const gough_map_options *options);

/** Checks the options and computes the size of the memory that gough_map_find() needs in addition to the map, in bytes.
 *  @return GOUGH_OK or GOUGH_ERROR_INPUT: an axis without values or with invalid ones, or a map of more than 2^31 points. */
GOUGH_API gough_status gough_map_size(const gough_model *model, const gough_map_options *options,
                                      size_t *bytes, gough_error *error);

/** Computes the map. The study's disturbances are ignored.
 *
 *  With a sampled controller each point is on its own, as from gough_floquet_sampled(), or gough_sampled_at_rest() where the
 *  program rests; the period of the controller that is used is that of these functions. With drives that lag, or whose limits the
 *  program reaches, with integrals and with matrices of gains it is so too, as from gough_floquet_multipliers() or
 *  gough_stability_at_rest(). The kind of an interval is then that at
 *  its beginning, and one that extends below the range begins with the range. Between two neighbouring points of the grid an
 *  interval, or a gap between intervals, is found only if growth rises, or falls, towards it from both sides. Edges are accurate
 *  to 1e-7 of the greatest stiffness, or 1e-4 where the periodic motion itself ends.
 *  @param memory  of gough_map_size(), aligned to 64; nothing else is allocated
 *  @param[out] map  its three arrays must have room for the number of elements given there
 *  @return GOUGH_OK, even if rows have no results, for example because the program is not periodic or passes a singular pose at
 *  that amplitude (see their errors); GOUGH_ERROR_INPUT for invalid options; GOUGH_ERROR_NUMERICAL if progress stopped it.
 *  Without feed-forward the periodic motion depends on G and must be found for each G: this is about a hundred times slower, and
 *  intervals are found on the grid only. Multipliers and edges are as accurate as the options ask. */
GOUGH_API gough_status gough_map_find(const gough_model *model, const gough_map_options *options,
                                      gough_map *map, void *memory, gough_error *error);

#ifdef __cplusplus
}
#endif
#endif
