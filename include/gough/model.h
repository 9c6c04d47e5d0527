/** @file model.h
 *  The parts of a study: the platform, its load, the program, the control law and the disturbances.
 *
 *  Units: any consistent set (SI, or the dimensionless one of docs/theory/units.md); angles in radians.
 *  Frames: the base frame has x forward, y left, z up; at home the top frame is parallel to it, with its origin
 *  at (0, 0, height). A leg force is positive when it pushes the top away from the base.
 *  All structs are plain data: fill, copy and share them freely. Nothing here allocates or keeps state. An error argument may be
 *  NULL.
 *
 *  Accuracy: a few roundings of the largest number involved, unless a function says otherwise.
 *  Overlap: outputs must not overlap inputs or each other, unless a function works in place.
 *  Threads: every function may be called from several threads at once, on distinct outputs; inputs may be shared.
 */
#ifndef GOUGH_MODEL_H
#define GOUGH_MODEL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "gough/demands.h"
#include "gough/status.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { GOUGH_LEGS = 6 };

/** One of the two parts that each leg consists of: a straight body whose centre of mass lies on the leg's axis. A number for each
 *  leg, from 1 to 6. */
typedef struct gough_leg_part {
    double mass[GOUGH_LEGS];   /**< >= 0 */
    double center[GOUGH_LEGS]; /**< its centre of mass, from the joint on which it hangs towards the
                                     other joint of the leg */
    double inertia
        [GOUGH_LEGS]; /**< moment of inertia about the centre of mass, across the leg, >= 0 */
} gough_leg_part;

/** Friction of each leg, from 1 to 6, (mass-12), (mass-13): between the drive force and the force in the leg. */
typedef struct gough_friction {
    double viscous[GOUGH_LEGS];        /**< b, force per speed, >= 0 */
    double coulomb[GOUGH_LEGS];        /**< F_C, force at speed, >= 0 */
    double breakaway[GOUGH_LEGS];      /**< F_S, force at rest, >= F_C; 0: F_C */
    double stribeck_speed[GOUGH_LEGS]; /**< v_S, speed at which half of F_S − F_C is left, > 0 where
                                       F_S exceeds F_C */
    double smoothing_speed[GOUGH_LEGS]; /**< v_0, speed within which friction changes its sign, > 0;
                                             0: v_S/20, or 1e-3 √(g R_b) without v_S */
    double efficiency[GOUGH_LEGS]; /**< η of a screw that drives, 0 … 1; one of 0.5 or less locks
                                        itself, and no drive force gives a motion */
} gough_friction;

/** The six components of a motion: displacement of a point of the top from home, base axes, and the angles of
 *  R = Rz(yaw) Ry(pitch) Rx(roll), or of R = Rx(roll) Ry(pitch) Rz(yaw), as gough_order says. */
enum gough_component {
    GOUGH_SURGE,
    GOUGH_SWAY,
    GOUGH_HEAVE,
    GOUGH_ROLL,
    GOUGH_PITCH,
    GOUGH_YAW,
    GOUGH_COMPONENTS
};

/** The order in which the three angles of a motion turn the top. */
typedef enum gough_order {
    GOUGH_ZYX, /**< R = Rz(yaw) Ry(pitch) Rx(roll): about base axes roll comes first */
    GOUGH_XYZ, /**< R = Rx(roll) Ry(pitch) Rz(yaw): about base axes yaw comes first */
    GOUGH_ORDERS
} gough_order;

/** Name of a component (enum gough_component), "surge" … "yaw"; a static string. */
GOUGH_API const char *gough_component_name(int component);

/** Limits of each leg, from 1 to 6. Zero-filled: none of these. Of pairs the first number is the least, the second the greatest. */
typedef struct gough_leg_limits {
    /** Between the joints, >= 0; {0, 0}: length_min and length_max of the platform. */
    double length[GOUGH_LEGS][2];
    double stroke[GOUGH_LEGS][2]; /**< from the length at home, in place of length; {0, 0}: none */
    double speed[GOUGH_LEGS];     /**< greatest |leg rate|; 0: speed_max of the platform */
    /** Drive force; a leg that only pulls has {−1500, 0}; {0, 0}: as max_force has it. */
    double force[GOUGH_LEGS][2];
    double max_force[GOUGH_LEGS];    /**< greatest |drive force|; 0: force_max of the platform */
    double acceleration[GOUGH_LEGS]; /**< greatest |second derivative of the length|; 0: no limit */
    double base_swing[GOUGH_LEGS];   /**< greatest angle of the leg from its direction at home, in
                                          base axes, at most π; 0: no limit */
    double top_swing[GOUGH_LEGS];    /**< the same in the axes of the top */
    double diameter[GOUGH_LEGS]; /**< for the clearance of legs in workspace.h only; 0: a line */
} gough_leg_limits;

/** Limits of the platform: of a point of the top, and of its rotation. A pair for each gough_component; {0, 0}: no limit. */
typedef struct gough_platform_limits {
    double pose[GOUGH_COMPONENTS][2];  /**< displacement of the point from home, base axes, and the
                                            angles, as in a motion */
    double speed[GOUGH_COMPONENTS][2]; /**< velocity of the point and angular velocity, base axes */
    double acceleration[GOUGH_COMPONENTS]
                       [2]; /**< acceleration of the point and angular acceleration, base axes */
    double about[3];        /**< the point, top frame */
    bool about_given;       /**< false: the point `about` of the motion */
} gough_platform_limits;

/** How a drive turns its command into a force. */
typedef enum gough_actuator_kind {
    GOUGH_ACTUATOR_IDEAL, /**< the force is the command */
    GOUGH_ACTUATOR_LAG,   /**< the force follows the command late, by a first or second order */
    GOUGH_ACTUATOR_KINDS
} gough_actuator_kind;

/** The drives of the legs, (act-1). Each number is one for each leg, from 1 to 6. Zero-filled: ideal drives. All drives are of one
 *  kind and one order. */
typedef struct gough_actuators {
    gough_actuator_kind kind;         /**< of all six */
    double max_force[GOUGH_LEGS][2];  /**< least and greatest command that a drive takes, beyond
                                             which it stays at them; {0, 0}: no limit */
    double time_constant[GOUGH_LEGS]; /**< T_a of a lag of first order, > 0; 0: second order */
    double frequency[GOUGH_LEGS];     /**< ω_a/2π of a lag of second order, in cycles per unit of
                                             time, > 0; 0: first order */
    double damping_ratio[GOUGH_LEGS]; /**< ζ_a of a lag of second order, > 0 */
    double max_rate[GOUGH_LEGS];      /**< greatest |df/dt| of a lag of first order; 0: no limit */
} gough_actuators;

/** How exactly joints and measured lengths are known. Each number is one for each leg, from 1 to 6. Zero-filled: exactly. No
 *  motion and no force follows from them, only how well a pose is known, gough_pose_resolution(). */
typedef struct gough_tolerances {
    double joint[GOUGH_LEGS];  /**< greatest distance of each of the two joints of a leg from its
                                    place, >= 0 */
    double length[GOUGH_LEGS]; /**< greatest error of a measured length, >= 0 */
} gough_tolerances;

/** Joints, limits, drives, and mass and friction of the legs. gough_platform_default() has no joints, no limits, ideal drives, and
 *  legs without mass and friction. */
typedef struct gough_platform {
    double base[GOUGH_LEGS][3]; /**< base joints, base frame */
    double top[GOUGH_LEGS][3];  /**< top joints, top frame; leg n joins base[n] and top[n] */
    double height;              /**< z of the top frame's origin at home */
    /** R_b, the unit of length of the dimensionless form; 0: mean distance of the base joints from their centroid. */
    double base_radius;
    double length_min; /**< least length of all legs; 0: no limit */
    double length_max; /**< greatest length of all legs; INFINITY: no limit */
    double speed_max;  /**< greatest |leg rate| of all legs; INFINITY: no limit */
    double force_max;  /**< greatest |drive force| of all legs; INFINITY: no limit */

    gough_leg_part cylinder;           /**< hangs on the base joint */
    gough_leg_part piston;             /**< hangs on the top joint */
    double reflected_mass[GOUGH_LEGS]; /**< what rotor, screw and oil weigh along the leg, >= 0 */
    /** Use the equations of legs with mass, even if it is 0; set by gough_machine_init() where some is not. */
    bool legs_have_mass;
    gough_friction friction;      /**< of the legs */
    gough_actuators actuators;    /**< drives of the legs */
    gough_leg_limits legs;        /**< limits of single legs */
    gough_platform_limits limits; /**< of the platform */
    gough_tolerances tolerances;  /**< of joints and measured lengths */
} gough_platform;

/** Fills in a platform without joints and without limits.
 *  @param size  sizeof(gough_platform)
 *  @return GOUGH_OK; GOUGH_ERROR_INPUT if the library's struct has another size: then all @p size bytes are 0xff, which no
 *  function accepts. */
GOUGH_API gough_status gough_platform_init(gough_platform *platform, size_t size);

/** The platform that gough_platform_init() fills in. */
static inline gough_platform gough_platform_default(void) {
    gough_platform platform;
    (void)gough_platform_init(&platform, sizeof platform);
    return platform;
}

/** Fills in joints in pairs on two circles: base pairs at ±half_angle about 0°, 120°, 240°, top pairs about 60°, 180°, 300°;
 *  leg 1 runs from base angle +base_half_angle to top angle 60° − top_half_angle, legs 2 … 6 follow counter-clockwise,
 *  each joining neighbours. Half angles in radians. Sets base_radius and height; there are no limits.
 *  @param size  sizeof(gough_platform)
 *  @return as gough_platform_init(). Joints are exact to a few roundings of the radius. */
GOUGH_API gough_status gough_platform_init_symmetric(gough_platform *platform, size_t size,
                                                     double base_radius, double base_half_angle,
                                                     double top_radius, double top_half_angle,
                                                     double height);

/** The platform that gough_platform_init_symmetric() fills in. */
static inline gough_platform gough_platform_symmetric(double base_radius, double base_half_angle,
                                                      double top_radius, double top_half_angle,
                                                      double height) {
    gough_platform platform;
    (void)gough_platform_init_symmetric(&platform, sizeof platform, base_radius, base_half_angle,
                                        top_radius, top_half_angle, height);
    return platform;
}

/** Everything that moves with the top, as one rigid body. */
typedef struct gough_load {
    double mass;              /**< > 0 */
    double center_of_mass[3]; /**< top frame */
    double inertia[3][3];     /**< about the centre of mass, axes of the top frame; symmetric */
} gough_load;

struct gough_external;

/** A validated machine and the quantities derived from it. Fill it with gough_machine_init() and
 *  gough_machine_set_external() only; it is constant afterwards and may be shared. */
typedef struct gough_machine {
    gough_platform platform;        /**< as given */
    gough_load load;                /**< as given */
    double gravity[3];              /**< base axes */
    double base_radius;             /**< R_b > 0 */
    double gravity_magnitude;       /**< |g|, may be 0 */
    double principal_axes[3][3];    /**< columns: axes of the central frame Cxyz in the top frame */
    double second_moments[3];       /**< I_x = ∫x²dm, …, in the central frame, (1.1) */
    double home_length[GOUGH_LEGS]; /**< leg lengths at home */
    double home_condition;          /**< condition number at home, as from gough_conditioning() */
    double breakaway[GOUGH_LEGS];   /**< F_S of each leg, >= F_C */
    double smoothing_speed[GOUGH_LEGS];    /**< v_0 of each leg, > 0 */
    const struct gough_external *external; /**< known loads, in the caller's memory, which must
                                                outlive the machine; NULL: none */
    size_t externals;                      /**< how many */
} gough_machine;

/** Checks geometry and inertia and computes the derived quantities, (1.1), (2.7).
 *  @return GOUGH_OK, or GOUGH_ERROR_INPUT with a sentence: a number is not finite, the mass is not positive, no body can have
 *  the inertia, two legs share both joints, all base or all top joints lie on one line, a leg has no length at home, or the
 *  machine is singular in every pose (similar hexagons). A machine singular only at home is accepted (see home_condition).
 *  A flat body (J_x + J_y = J_z within 1e-12) is accepted, and its vanishing second moment is set to 0. Refused too: mass, inertia
 *  or friction of a leg that is negative, an efficiency outside 0 … 1, breakaway below coulomb, breakaway above it
 *  without a stribeck_speed, dry friction without smoothing_speed where neither v_S nor gravity gives one; limits that are not
 *  finite, whose least value is not below the greatest, a stroke that leaves a leg no length, both length and stroke, or both
 *  force and max_force of a leg; drives with a number that is negative or not finite, ideal ones with a lag, and others without
 *  one, with two, or of different orders.
 *  @param gravity       acceleration of free fall, base axes; {0, 0, −9.80665} for a machine that stands on the earth, in SI units;
 *                       may be zero
 *  @param[out] machine  copies of the arguments and the derived quantities, without external loads; unchanged after an error
 *
 *  Accurate to 1e-14 of the largest inertia and length, and to 1e-12 times the condition number for home_condition. The platform
 *  and load may be those in the machine itself. */
GOUGH_API gough_status gough_machine_init(gough_machine *machine, const gough_platform *platform,
                                          const gough_load *load, const double gravity[3],
                                          gough_error *error);

/* ---- formulas in t ------------------------------------------------------------------------------------------- */

enum { GOUGH_FORMULA_OPERATIONS = 192, GOUGH_FORMULA_DEPTH = 24 };

/** A compiled formula in t: postfix operations on a small stack. A `count` of 0 means the constant 0. */
typedef struct gough_formula {
    int count; /**< operations in use */
    struct {
        int code;                          /**< operation; private */
        int constant;                      /**< which operands do not depend on t; private */
        double value;                      /**< of a number; private */
    } operation[GOUGH_FORMULA_OPERATIONS]; /**< private */
} gough_formula;

/** Compiles a formula: numbers, t, pi, + − * / ^ (right-associative; -t^2 is -(t^2)), parentheses and the functions
 *  sin cos tan asin acos atan atan2(y, x) exp log sqrt tanh ramp(t, T). ramp rises from 0 to 1 over 0 … T, twice
 *  continuously differentiable. Trigonometric functions take radians.
 *  @param text,length  the formula, which need not be terminated
 *  @param[out] offset  byte offset of the character with the error (may be NULL)
 *  @return GOUGH_OK or GOUGH_ERROR_INPUT with a sentence (unknown name and the nearest one, missing parenthesis, too long,
 *  too deep, empty, …). Does not allocate; safe to call concurrently; independent of the locale. */
GOUGH_API gough_status gough_formula_compile(gough_formula *formula, const char *text,
                                             size_t length, size_t *offset, gough_error *error);

/** Makes a compiled formula f(t) to size·f(rate·t), as a change of units needs; factors of 1 change nothing.
 *  @param size,rate  finite, not 0
 *  @return GOUGH_OK, or GOUGH_ERROR_INPUT with a sentence if it then has too many operations or pending values; it is then
 *  unchanged. Does not allocate. */
GOUGH_API gough_status gough_formula_scale(gough_formula *formula, double size, double rate,
                                           gough_error *error);

/** Fills in a formula with a constant value, which must be finite.
 *  @param size  sizeof(gough_formula)
 *  @return as gough_platform_init() */
GOUGH_API gough_status gough_formula_init(gough_formula *formula, size_t size, double value);

/** The formula that gough_formula_init() fills in. */
static inline gough_formula gough_formula_constant(double value) {
    gough_formula formula;
    (void)gough_formula_init(&formula, sizeof formula, value);
    return formula;
}

/** True if the formula is the constant 0, so that a disturbance is absent. */
GOUGH_API bool gough_formula_is_zero(const gough_formula *formula);

/** Value, first and second derivative at t, exact up to rounding (evaluated on jets, without differences). Outside the domain
 *  of a function, and if the formula has an impossible number of operations, the results are not finite. Does not allocate. */
GOUGH_API void gough_formula_evaluate(const gough_formula *formula, double t, double jet[3]);

/* ---- known loads ---------------------------------------------------------------------------------------------- */

/** Most external loads of a machine. */
enum { GOUGH_EXTERNALS = 8 };

/** A known load on the top besides its weight, such as a counterbalance, wind or a cutting force, (law-4). Zero-filled:
 *  no force. */
typedef struct gough_external {
    gough_formula force[3];  /**< formulas in t, along the axes below */
    gough_formula moment[3]; /**< a couple, besides the force, along the same axes */
    double at[3];            /**< the point on which the force acts, top frame */
    bool at_given; /**< false: the force acts at the centre of mass, and `at` is not used */
    bool turns; /**< the axes are those of the top, with which it turns; false: those of the base */
} gough_external;

/** Gives a machine its external loads. Everything that computes forces or motion of the machine counts with them, but not the
 *  functions of dynamics.h, which know no time: give those the wrench of gough_external_wrench().
 *  @param external  @p count loads, in memory that outlives the machine; their formulas may be changed there between
 *                   runs. NULL if @p count is 0
 *  @return GOUGH_OK; GOUGH_ERROR_INPUT, with the machine unchanged, if there are more than GOUGH_EXTERNALS or a point is not
 *  finite. A formula that is not finite is reported when it is evaluated. Computes nothing: exact. */
GOUGH_API gough_status gough_machine_set_external(gough_machine *machine,
                                                  const gough_external *external, size_t count,
                                                  gough_error *error);

/* ---- the program --------------------------------------------------------------------------------------------- */

/** A point-to-point move with minimum jerk, from the program's current pose (home before the first move) to the target. */
typedef struct gough_move {
    double start;                    /**< time at which it begins, >= 0 */
    double duration;                 /**< > 0 */
    double target[GOUGH_COMPONENTS]; /**< lengths and radians, measured from home */
    bool given[GOUGH_COMPONENTS];    /**< which components move; the others keep their values */
    /** Read by gough_move_find() only: whether the duration shall be the least that the limits of the machine allow */
    bool least;
    double
        speed; /**< likewise: greatest speed of the point, > 0; 0: no limit, as for those below */
    double acceleration;  /**< likewise: its greatest acceleration */
    double angular_speed; /**< likewise: greatest rate of roll, pitch and yaw, each by itself */
    double angular_acceleration; /**< likewise: greatest second derivative of these angles */
} gough_move;

/** Recorded motion, in the caller's memory, which must outlive the motion. Rows in order of time.
 *  value and curvature are row-major [count][GOUGH_COMPONENTS]; curvature (second derivatives of the C² cubic spline,
 *  not-a-knot at both ends; a parabola through 3 rows, a line through 2) is filled by gough_samples_prepare(). */
typedef struct gough_samples {
    size_t count;        /**< rows */
    const double *time;  /**< increasing */
    const double *value; /**< six components per row, lengths and radians */
    double *curvature;   /**< their second derivatives in time, the same size as value */
    /** All 0: the angles are roll, pitch and yaw. Otherwise the quaternion (w, x, y, z), of any length, of a rotation F: the
     *  angles are about turned axes, R = F Rz Ry Rx Fᵀ, (motion-10), or F Rx Ry Rz Fᵀ in the other order. */
    double axes[4];
} gough_samples;

/** Doubles of scratch memory that gough_samples_prepare() needs for @p count rows. */
GOUGH_API size_t gough_samples_scratch(size_t count);

/** Computes the spline through the samples (motion-4), whose times need not be equally spaced: fills samples->curvature.
 *  @param scratch  gough_samples_scratch(samples->count) doubles, free again afterwards
 *  @return GOUGH_OK, or GOUGH_ERROR_INPUT: fewer than 2 rows, times that do not increase, or a number that is not finite.
 *
 *  Exact for cubics but for rounding of the values, which second derivatives divide by the square of the interval between rows. */
GOUGH_API gough_status gough_samples_prepare(const gough_samples *samples, double *scratch,
                                             gough_error *error);

/** What unwrapping changed. */
typedef struct gough_unwrapping {
    size_t turns[3]; /**< rows at which roll, pitch, yaw jumped by whole turns */
    size_t flips;    /**< rows at which all three jumped to other angles of the same rotation */
    size_t first;    /**< index of the first such row; 0: none */
} gough_unwrapping;

/** Makes the angles of recorded motion continuous, in place, (motion-7): whole turns are added to an
 *  angle that jumps by more than half a turn from one row to the next, and where (roll + 180°, 180° − pitch, yaw + 180°), which
 *  is the same rotation, lies nearer to the row before than (roll, pitch, yaw), it takes their place. The first row and
 *  every rotation stay as they are. Call it before gough_samples_prepare().
 *  @param count      rows
 *  @param value      six components a row, as in gough_samples
 *  @param half_turn  180 for angles in degrees, π for radians
 *  @param[out] done  what was changed
 *  @param size       sizeof(gough_unwrapping)
 *  @return as gough_platform_init(): GOUGH_OK whatever the rows; gough_samples_prepare() reports those that are not finite.
 *
 *  Rows that need no change keep their bits; whole and half turns are added to the others with a few roundings. */
GOUGH_API gough_status gough_samples_make_continuous(size_t count, double *value, double half_turn,
                                                     gough_unwrapping *done, size_t size);

/** Calls gough_samples_make_continuous() and returns what was changed. */
static inline gough_unwrapping gough_samples_unwrap(size_t count, double *value, double half_turn) {
    gough_unwrapping done;
    (void)gough_samples_make_continuous(count, value, half_turn, &done, sizeof done);
    return done;
}

/** Finds axes for the angles of recorded motion that comes close to a pitch of ±90°, where roll and yaw cannot follow it,
 *  (motion-10).
 *  @param count      rows
 *  @param value      six components a row, the angles being roll, pitch and yaw
 *  @param half_turn  180 for angles in degrees, π for radians
 *  @param[out] axes  for gough_samples_turn() and gough_samples.axes: of those tried, the axes about which the rows stay
 *                    farthest from the pole, a second angle of ±90°; (1, 0, 0, 0) if these are the axes of the base
 *  @return the least distance of a row from that pole, 0 to @p half_turn / 2, in the unit of the angles
 *  Takes time proportional to @p count. The distance is accurate to a few roundings of a half turn. */
GOUGH_API double gough_samples_axes(size_t count, const double *value, double half_turn,
                                    double axes[4]);

/** Replaces roll, pitch and yaw in each row by the angles of the same rotation about turned axes, in place, (motion-10). The
 *  second angle is within a quarter turn, the others within half a turn: call gough_samples_unwrap() next, and set
 *  gough_samples.axes. Zero angles stay zero.
 *  @param count,value,half_turn  as in gough_samples_axes()
 *  @param axes       a quaternion (w, x, y, z) of any length above 0
 *  Always succeeds. The rotations are the same to a few roundings of the angles. Close to the pole of the new axes, single angles
 *  lose digits. */
GOUGH_API void gough_samples_turn(size_t count, double *value, double half_turn,
                                  const double axes[4]);

/** Doubles of scratch memory that gough_samples_low_pass() and gough_samples_smooth() need for @p count rows. */
GOUGH_API size_t gough_samples_smooth_scratch(size_t count);

/** Zero-phase low-pass filter for one component of recorded motion, by a smoothing spline, in place, (motion-8).
 *  A sine of frequency f keeps its phase, and 1/(1 + (f/cutoff)⁶) of its amplitude: half of it at the cutoff, 98.5 % at half
 *  the cutoff. This is the response of a third-order Butterworth filter run forwards and backwards. Beyond the ends of the record
 *  a constant acceleration is assumed. The times need not be equally spaced; each row is weighted by the time it represents.
 *  @param count      rows; fewer than 4 are left as they are
 *  @param time       in increasing order
 *  @param value      six components a row, as in gough_samples; only @p component is read and written
 *  @param component  GOUGH_SURGE … GOUGH_YAW; unwrap angles first
 *  @param cutoff     > 0, in cycles per unit of time; INFINITY changes nothing
 *  @param scratch    gough_samples_smooth_scratch() doubles
 *  @return GOUGH_OK, or GOUGH_ERROR_INPUT with @p value unchanged: a number not finite, times not increasing, a cutoff not
 *  above 0. Takes time proportional to @p count. Accurate to 1e-6 of the largest value at any cutoff; rounding grows
 *  with the number of rows in a period of the cutoff. */
GOUGH_API gough_status gough_samples_low_pass(size_t count, const double *time, double *value,
                                              int component, double cutoff, double *scratch,
                                              gough_error *error);

/** As gough_samples_low_pass(), with the lowest cutoff (to 0.5 %) whose changes are no larger than allowed.
 *  @param deviation    allowed root mean square of the changes, in the unit of the component; 0 changes nothing
 *  @param greatest     allowed change of any one value, in the same unit; INFINITY: any
 *  @param[out] cutoff  the cutoff found, in cycles per unit of time; INFINITY if even the weakest smoothing (two cycles
 *                      per row) changes more; then nothing is changed. Never below half a cycle per record.
 *  The other parameters, the errors and the accuracy of the values are those of gough_samples_low_pass(). For values rounded to
 *  steps of q, the deviation is q/√12. */
GOUGH_API gough_status gough_samples_smooth(size_t count, const double *time, double *value,
                                            int component, double deviation, double greatest,
                                            double *cutoff, double *scratch, gough_error *error);

/** How a program is given. */
typedef enum gough_motion_kind {
    GOUGH_MOTION_FORMULAS, /**< a formula in t for each component */
    GOUGH_MOTION_MOVES,    /**< point-to-point moves */
    GOUGH_MOTION_SAMPLES   /**< recorded motion */
} gough_motion_kind;

/** The program. A zero-filled struct means rest at home. */
typedef struct gough_motion {
    gough_motion_kind kind; /**< which of the fields below are used */
    double about[3];        /**< the point whose motion is given, in the top frame */
    gough_formula formula[GOUGH_COMPONENTS]; /**< lengths; angles, to be converted by angle_unit */
    /** Factor from the formulas' angles to radians; 0 means 1. (π/180 for study files; moves and samples are in radians.) */
    double angle_unit;
    const gough_move *move; /**< in the caller's memory, in order of time, not overlapping */
    size_t moves;           /**< number of moves */
    gough_samples samples;  /**< prepared by gough_samples_prepare() */
    gough_order order;      /**< of the angles */
    double period;          /**< of the motion after scaling; 0: found from the formulas */
    bool scaled;            /**< whether amplitude and frequency are used; false: both count as 1 */
    double amplitude; /**< if scaled: factor on all six components, as samples.axes define them */
    double frequency; /**< if scaled: factor on the time at which the program is evaluated, > 0 */
} gough_motion;

/** The six components at t with their first and second derivatives: component[c][order], radians. Before the first and
 *  after the last sample the components keep their end values. Not finite if a formula is not. Of records about turned axes,
 *  roll and yaw are within ±π and pitch within ±π/2; at a pitch of exactly ±π/2 derivatives are not finite. */
GOUGH_API void gough_motion_evaluate(const gough_motion *motion, double t,
                                     double component[GOUGH_COMPONENTS][3]);

/** The least and the greatest value of each component from t = 0 to @p duration, in radians where it is an angle.
 *
 *  These are the extremes of the motion, between rows too: to 1e-12 of the range for smooth programs. Pulses down
 *  to a hundredth of @p output_step wide are found. Of records about turned axes, pitch is within ±π/2, and roll and yaw are
 *  continuous from t = 0 on, where they are within ±π; where pitch reaches exactly ±π/2, they jump by half a turn.
 *  @param duration,output_step  as in gough_simulation, both positive and finite
 *  @return GOUGH_OK, or GOUGH_ERROR_INPUT if a component or one of its derivatives is not finite; the sentence names it and the
 *          time */
GOUGH_API gough_status gough_motion_range(const gough_motion *motion, double duration,
                                          double output_step, double least[GOUGH_COMPONENTS],
                                          double greatest[GOUGH_COMPONENTS], gough_error *error);

/** All limits that apply, each leg and component by itself: what follows from a platform and from the motion. */
typedef struct gough_limits {
    double length[GOUGH_LEGS][2];     /**< 0 and INFINITY: none */
    double speed[GOUGH_LEGS];         /**< INFINITY: none, as for all below */
    double force[GOUGH_LEGS][2];      /**< −INFINITY and INFINITY: none */
    double acceleration[GOUGH_LEGS];  /**< of the length */
    double base_swing[GOUGH_LEGS];    /**< radians */
    double top_swing[GOUGH_LEGS];     /**< radians */
    double diameter[GOUGH_LEGS];      /**< 0: a line */
    double pose[GOUGH_COMPONENTS][2]; /**< −INFINITY and INFINITY: none, as for those below */
    double rate[GOUGH_COMPONENTS][2]; /**< velocity of the point and angular velocity */
    double second_rate[GOUGH_COMPONENTS]
                      [2]; /**< acceleration of the point and angular acceleration */
    double about[3];       /**< the point, top frame */
} gough_limits;

/** Collects the limits of a machine that moves by a motion.
 *  @param machine  from gough_machine_init(); the limits in its platform may have been changed since
 *  @param motion   whose point `about` those of the platform concern where they have none of their own
 *  @param size     sizeof(gough_limits)
 *  @return as gough_platform_init(). Exact, but for the sum of stroke and length at home, rounded once. */
GOUGH_API gough_status gough_limits_collect(const gough_machine *machine,
                                            const gough_motion *motion, gough_limits *limits,
                                            size_t size);

/** The limits that gough_limits_collect() fills in. */
static inline gough_limits gough_limits_of(const gough_machine *machine,
                                           const gough_motion *motion) {
    gough_limits limits;
    (void)gough_limits_collect(machine, motion, &limits, sizeof limits);
    return limits;
}

/* ---- control, disturbance, initial state ---------------------------------------------------------------------- */

/** How a sampled controller finds the rate of the error of a leg's length. */
typedef enum gough_velocity {
    GOUGH_VELOCITY_EXACT,      /**< measured: l̇^p − l̇ */
    GOUGH_VELOCITY_DIFFERENCE, /**< from the errors of this sample and the one before */
    GOUGH_VELOCITIES
} gough_velocity;

/** A controller that looks at the legs at times k·period and holds its commands in between, (loop-1). Zero-filled: the controller
 *  is continuous, and the other members are not used. */
typedef struct gough_sampling {
    double period; /**< T, > 0; 0: continuous */
    double delay;  /**< τ, from a sample until its command acts; 0 to less than 100 periods */
    double jitter; /**< largest further delay, at random in each sample; at most the period */
    gough_velocity velocity; /**< how rates are found */
    double cutoff;     /**< of the low pass of differences, in cycles per unit of time; 0: none */
    double resolution; /**< q, one count of the measured lengths; 0: none */
    double noise;      /**< root mean square of the error of a measured length */
    uint64_t seed;     /**< of noise and jitter: a different seed gives different numbers */
    uint64_t run;      /**< a different run gives different numbers */
    double preview;    /**< how far ahead of the sample F^p is taken, >= 0 */
} gough_sampling;

/** F = F^p + G (l^p − l) + D (l̇^p − l̇) + I, (law-1), (loop-1). With all gains 0, open loop. */
typedef struct gough_control {
    bool feedforward;      /**< F^p from inverse dynamics along the program; false: F^p ≡ 0 */
    bool ignores_legs;     /**< F^p is that of legs without mass */
    bool ignores_friction; /**< F^p is that of legs without friction */
    bool ignores_external; /**< F^p is that of a machine without external loads */
    bool coupled; /**< the errors of one leg move the others too: cross_stiffness and cross_damping
                       are used */
    double stiffness[GOUGH_LEGS]; /**< G, force per length, >= 0; if coupled, the diagonal of the
                                       matrix, of any sign */
    double damping[GOUGH_LEGS];   /**< D, force per speed, likewise */
    double cross_stiffness[GOUGH_LEGS]
                          [GOUGH_LEGS];           /**< if coupled: G outside its diagonal: [leg that
                                             pushes][leg whose error it is]; its own diagonal is 0 */
    double cross_damping[GOUGH_LEGS][GOUGH_LEGS]; /**< D likewise */
    double integral[GOUGH_LEGS]; /**< K_I, force per length and time, >= 0; 0: no integral I */
    double tracking_time;        /**< T_t, in which I gives way while the drives cannot follow the
                                      command, > 0; 0: it does not */
    gough_sampling sampling;     /**< in steps of time */
} gough_control;

/** Random forces: smooth noise, twice continuously differentiable, of zero mean, independent in each leg and along each
 *  axis; (law-3). The same seed and run give the same noise. Zero-filled: no noise. */
typedef struct gough_noise {
    double leg_force; /**< root mean square of the force added to each leg */
    double force;     /**< of each component of the force on the load, base axes */
    double moment;    /**< of each component of the moment on the load, base axes */
    double interval;  /**< time scale, the distance between its knots; > 0 if there is noise */
    uint64_t seed;    /**< a different seed gives different noise */
    uint64_t run;     /**< a different run gives different noise */
} gough_noise;

/** Forces unknown to the controller (law-2): formulas in t, and noise. Zero-filled: none. */
typedef struct gough_disturbance {
    gough_formula leg_force[GOUGH_LEGS]; /**< added to each leg */
    /** Errors of leg forces with this resultant in the program's pose: along z of the base, through the centre of mass. */
    gough_formula vertical_force;
    gough_formula force[3];  /**< on the load at its centre of mass, base axes */
    gough_formula moment[3]; /**< on the load, base axes */
    gough_noise noise;       /**< random part */
} gough_disturbance;

/** Where a run starts; angles in the order of the motion. Parts that are not given have the program's values at t = 0. */
typedef struct gough_initial {
    double component
        [GOUGH_COMPONENTS]; /**< from home, of the point `about` of the motion; lengths, radians */
    bool given[GOUGH_COMPONENTS]; /**< which components are set */
    double velocity[3];           /**< of that point, base axes */
    double angular_velocity[3];   /**< base axes, radians per unit of time */
    bool velocity_given;          /**< whether velocity is set */
    bool angular_velocity_given;  /**< whether angular_velocity is set */
} gough_initial;

/** A complete model. It is large (about 100 kB, mostly formulas): keep it static or on the heap. */
typedef struct gough_model {
    gough_machine machine;         /**< platform and load */
    gough_motion motion;           /**< the program */
    gough_control control;         /**< the control law */
    gough_disturbance disturbance; /**< forces unknown to the controller */
    gough_initial initial;         /**< where a run starts */
    gough_workspace workspace;     /**< demands on all poses */
} gough_model;

#ifdef __cplusplus
}
#endif
#endif
