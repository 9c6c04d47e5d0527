/** @file workspace.h
 *  Where the top can go: whether whole boxes of poses keep the limits of legs, joints and platform, how far each axis reaches, and
 *  the largest box of a given shape in which all combinations of axes are free. Theory: docs/theory/workspace.md.
 *
 *  Answers are certified: of a box that is inside, every pose keeps every limit. That is proved by bounds that enclose errors of
 *  rounding, not found by samples. Poses are given by components, surge … yaw, of a point of the top from home.
 *
 *  Units: any consistent set; angles are in radians. Frames: those of gough_state. An error argument may be NULL.
 *
 *  Accuracy: as each function says.
 *  Overlap: outputs must not overlap inputs or each other.
 *  Threads: every function may be called from several threads at once, with the same gough_reach too, on distinct outputs.
 */
#ifndef GOUGH_WORKSPACE_H
#define GOUGH_WORKSPACE_H

#include "gough/dynamics.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A machine with all that it has to keep. Fill it with gough_reach_init(); the members may be changed afterwards. */
typedef struct gough_reach {
    const gough_machine *machine; /**< must outlive the struct */
    gough_order order;            /**< of the angles */
    double about[3];              /**< the point whose components poses are given by, top frame */
    gough_limits
        limits; /**< of legs, joints and the platform's pose; its limits of speed and acceleration do
                                       not concern poses */
    gough_workspace
        asked; /**< motions and loads that the legs must bear; its box, about and orientation are not read
                                       here */
    int side;          /**< sign of the determinant of gough_conditioning() at home, 1 or −1 */
    size_t most_tests; /**< boxes that one search may test before it gives up */
} gough_reach;

/** Gathers what a model asks of its machine: limits, and the members of its gough_workspace.
 *  @param size  sizeof(gough_reach)
 *  @return GOUGH_OK; GOUGH_ERROR_INPUT with a sentence if a number of the gough_workspace is not finite or out of range, or
 *          @p size is another; GOUGH_ERROR_NUMERICAL if the machine is singular at home, from where its workspace begins. Exact,
 *          but for the roundings of the limits. */
GOUGH_API gough_status gough_reach_init(gough_reach *reach, size_t size, const gough_model *model,
                                        gough_error *error);

/** A box of poses: all with each component between these; lengths and radians, from home. */
typedef struct gough_box {
    double least[GOUGH_COMPONENTS];    /**< surge … yaw */
    double greatest[GOUGH_COMPONENTS]; /**< each at least as large */
} gough_box;

/** What is known of a box. */
typedef enum gough_verdict {
    GOUGH_INSIDE, /**< every pose keeps every limit */
    GOUGH_OUTSIDE, /**< from gough_box_test(): no pose keeps them all; from gough_box_certify(): some pose does not */
    GOUGH_UNDECIDED, /**< the bounds are too wide to tell, or the search has given up */
    GOUGH_VERDICTS   /**< number of values */
} gough_verdict;

/** The limits of a pose. */
typedef enum gough_bind {
    GOUGH_BIND_NONE,           /**< no limit */
    GOUGH_BIND_SHORTEST,       /**< least length of a leg */
    GOUGH_BIND_LONGEST,        /**< greatest length of a leg */
    GOUGH_BIND_BASE_SWING,     /**< swing of a base joint */
    GOUGH_BIND_TOP_SWING,      /**< swing of a top joint */
    GOUGH_BIND_CLEARANCE,      /**< two legs touch */
    GOUGH_BIND_POSE,           /**< a component of the platform */
    GOUGH_BIND_SINGULAR,       /**< a singular pose */
    GOUGH_BIND_SINGULAR_VALUE, /**< least singular value */
    GOUGH_BIND_SPEED,          /**< greatest rate of a leg, for the velocities asked for */
    GOUGH_BIND_ACCELERATION,   /**< greatest acceleration of a leg's length, for those asked for */
    GOUGH_BIND_PUSH,           /**< greatest drive force of a leg */
    GOUGH_BIND_PULL,           /**< least drive force of a leg */
    GOUGH_BINDS                /**< number of values */
} gough_bind;

/** Fixed word for a gough_bind, as in the JSON of `gough workspace`: "none", "shortest", "longest", "base_swing", "top_swing",
 *  "clearance", "pose", "singular", "singular_value", "speed", "acceleration", "push", "pull". Other values give "unknown". */
GOUGH_API const char *gough_bind_name(gough_bind bind);

/** The limit that decides about a box or a pose. */
typedef struct gough_binding {
    gough_bind bind; /**< which */
    int which;       /**< its leg, from 0, or the component of the platform; 0 if it has neither */
    int other;       /**< the other leg of a clearance; else 0 */
} gough_binding;

/** Tests a box by one evaluation at its centre, (space-2) … (space-6): first and second order exactly, third order bounded. A box
 *  of one pose is allowed; it is undecided only within rounding of a limit.
 *  @param[out] binding  what is exceeded, or what is nearest to being so; may be NULL
 *  @return what holds of the box; GOUGH_UNDECIDED too if a number of the box is not finite or its ends are in the wrong order.
 *
 *  The proof encloses the errors of rounding. Allocates nothing; takes about the time of a few leg kinematics. */
GOUGH_API gough_verdict gough_box_test(const gough_reach *reach, const gough_box *box,
                                       gough_binding *binding);

/** What a search has found about a box. */
typedef struct gough_certificate {
    gough_verdict verdict;         /**< of the whole box */
    gough_binding binding;         /**< what the pose below exceeds, or where the search gave up */
    double pose[GOUGH_COMPONENTS]; /**< a pose that is not allowed, or where the search gave up */
    size_t tests;                  /**< boxes tested */
} gough_certificate;

/** Decides about a box by splitting it until every part is inside or a pose is found that is not.
 *  @param[out] certificate  what is found
 *  @return GOUGH_OK, whatever the verdict; GOUGH_ERROR_INPUT if a number of the box is not finite or its ends are in the wrong
 *          order.
 *
 *  As certain as gough_box_test(). GOUGH_UNDECIDED comes after most_tests boxes, or at a box so small that rounding hides on
 *  which side of a limit it lies. Allocates nothing. */
GOUGH_API gough_status gough_box_certify(const gough_reach *reach, const gough_box *box,
                                         gough_certificate *certificate, gough_error *error);

/** How far one axis reaches from home, the others staying there. */
typedef struct gough_travel {
    double end[2]; /**< least and greatest component up to which all poses are allowed */
    gough_binding binding
        [2]; /**< what ends it there; GOUGH_BIND_NONE: the search ended, at half a turn or ten times the
                                   size of the machine */
    size_t tests; /**< boxes tested */
} gough_travel;

/** Travel of an axis, by boxes along it, (space-7): certified up to its ends.
 *  @param component  GOUGH_SURGE … GOUGH_YAW
 *  @return GOUGH_OK; GOUGH_ERROR_INPUT if there is no such component; GOUGH_ERROR_NUMERICAL with a sentence if home itself exceeds
 *          a limit; then both ends are 0 and the bindings say which.
 *
 *  Ends are below the true ones by at most 1e-8 of the machine's size, or of a radian. */
GOUGH_API gough_status gough_workspace_travel(const gough_reach *reach, int component,
                                              gough_travel *travel, gough_error *error);

/** The largest box of a shape. */
typedef struct gough_largest_box {
    double scale; /**< the shape times this is inside, which is certified */
    double
        upper; /**< the shape times this is not; INFINITY: no pose was found that exceeds a limit */
    gough_box box;                 /**< the shape times scale */
    gough_binding binding;         /**< what stops a larger one */
    double pose[GOUGH_COMPONENTS]; /**< a pose of the box of scale `upper` that is not allowed */
    size_t tests;                  /**< boxes tested */
} gough_largest_box;

/** Finds the largest box of a shape, about home, in which all combinations of its components keep all limits, (space-8).
 *  @param shape  contains home: least <= 0 <= greatest. A component with both 0 stays at home
 *  @return GOUGH_OK; GOUGH_ERROR_INPUT with a sentence if the shape does not contain home or is a single pose;
 *          GOUGH_ERROR_NUMERICAL if home itself exceeds a limit.
 *
 *  `scale` is certified; `upper` is proved by a pose. They differ by less than 1e-4 of `upper` unless most_tests is
 *  too small. Allocates nothing. */
GOUGH_API gough_status gough_workspace_box(const gough_reach *reach, const gough_box *shape,
                                           gough_largest_box *largest, gough_error *error);

/** The first pose on a straight line of components that is not allowed. */
typedef struct gough_ray {
    double reach;          /**< all poses up to start + reach · direction are allowed */
    gough_binding binding; /**< what ends it; GOUGH_BIND_NONE: the search ended */
    size_t tests;          /**< boxes tested */
} gough_ray;

/** Follows a straight line of components from a pose, (space-7), as gough_workspace_travel() does along an axis.
 *  @param start      surge … yaw
 *  @param direction  a direction in the six components, lengths and radians; not all 0
 *  @return GOUGH_OK; GOUGH_ERROR_INPUT if a number is not finite or the direction is 0. The reach is 0 if the start itself is not
 *          allowed, with the limit that it exceeds.
 *
 *  As accurate as gough_workspace_travel(), in the size of the machine over that of the direction. */
GOUGH_API gough_status gough_workspace_ray(const gough_reach *reach,
                                           const double start[GOUGH_COMPONENTS],
                                           const double direction[GOUGH_COMPONENTS], gough_ray *ray,
                                           gough_error *error);

/** What is worst in a box of poses, over all motions and loads that are asked for. */
typedef enum gough_worst {
    GOUGH_WORST_PUSH,           /**< greatest drive force */
    GOUGH_WORST_PULL,           /**< least drive force; the leg pulls if it is below 0 */
    GOUGH_WORST_SHORTEST,       /**< least length of a leg */
    GOUGH_WORST_LONGEST,        /**< greatest length of a leg */
    GOUGH_WORST_SPEED,          /**< greatest rate of a leg */
    GOUGH_WORST_ACCELERATION,   /**< greatest acceleration of a leg's length */
    GOUGH_WORST_BASE_SWING,     /**< greatest angle of a leg from its direction at home */
    GOUGH_WORST_TOP_SWING,      /**< the same in the axes of the top */
    GOUGH_WORST_CLEARANCE,      /**< least distance of the surfaces of two legs */
    GOUGH_WORST_CONDITION,      /**< greatest condition number */
    GOUGH_WORST_SINGULAR_VALUE, /**< least singular value */
    GOUGH_WORSTS                /**< number of values */
} gough_worst;

/** Fixed word for a gough_worst, as in the JSON: "push" … "singular_value". Other values give "unknown". */
GOUGH_API const char *gough_worst_name(gough_worst worst);

/** One worst value. */
typedef struct gough_extreme {
    double bound; /**< no pose of the box has a worse one; infinite if the search found no bound */
    double sampled; /**< one that a pose of the box has */
    int leg;        /**< its leg, from 0; of a clearance the first of two; −1: of no leg */
    double pose[GOUGH_COMPONENTS]; /**< that pose */
} gough_extreme;

/** Worst values over a box. */
typedef struct gough_envelope {
    gough_extreme of[GOUGH_WORSTS]; /**< by gough_worst */
    size_t tests;                   /**< boxes tested */
} gough_envelope;

/** Finds the worst values over a box of poses, by splitting it, (space-18).
 *  @return GOUGH_OK; GOUGH_ERROR_INPUT if a number of the box is not finite or its ends are in the wrong order;
 *          GOUGH_ERROR_NUMERICAL with a sentence if the box may contain a singular pose, where forces have no bound.
 *
 *  Bounds are certified, with errors of rounding enclosed. They are drawn nearer until bound and sampled value differ by less
 *  than 1 % (of push and pull: or a tenth of that of the larger of both; lengths: 0.01 %; swing: or 0.02 degrees; clearance: or
 *  0.1 % of the least length), or until the search has tested its share of most_tests, 16000 boxes at most for each value. In a
 *  large box near singular poses they may stay apart, condition and singular value sooner than the others: their difference is
 *  what is not known. Allocates nothing; uses about 450 KiB of stack. */
GOUGH_API gough_status gough_workspace_envelope(const gough_reach *reach, const gough_box *box,
                                                gough_envelope *envelope, gough_error *error);

/** Volume of the positions that the point can take at one orientation. */
typedef struct gough_volume {
    double value;    /**< as it is estimated */
    double least;    /**< proved: it is at least this */
    double greatest; /**< proved: it is at most this */
    bool exact;      /**< the value is that of vertical lines in closed form, for limits of length
                     alone; else that of cells whose centres are allowed */
    size_t tests;    /**< boxes tested */
} gough_volume;

/** Measures the positions in which all limits are kept at one orientation, and the determinant has its sign at home, (space-17).
 *  @param orientation  roll, pitch, yaw
 *  @return GOUGH_OK; GOUGH_ERROR_INPUT if an angle is not finite; GOUGH_ERROR_NUMERICAL with a sentence if no limit bounds the
 *          positions.
 *
 *  The proved bounds differ by less than 20 % of the greatest unless most_tests is too small; limits of speeds or clearances
 *  need the most tests. An exact value is accurate to 1e-6 of itself, another to about two digits. */
GOUGH_API gough_status gough_workspace_volume(const gough_reach *reach, const double orientation[3],
                                              gough_volume *volume, gough_error *error);

#ifdef __cplusplus
}
#endif
#endif
