/** @file cueing.h
 *  Motion cueing: the motion of a simulator's platform made of the motion of a vehicle, by the classical washout filter, sample by
 *  sample. Theory: docs/theory/cueing.md.
 *
 *  What a person in the vehicle feels is the specific force, acceleration less gravity, and the rates of rotation. The platform
 *  reproduces the onset of forces by moving, sustained forces by leaning, and the onset of rotations by turning; then it returns to
 *  home so slowly that people hardly feel it.
 *
 *  Units: any consistent set; angles are in radians, frequencies in cycles per unit of time. Frames: vehicle axes are x forward, y
 *  left, z up; the platform's are those of gough_state, with z up and its own x forward. Angles are roll, pitch and yaw in the
 *  order of GOUGH_ZYX. An error argument may be NULL.
 *
 *  Accuracy: for input that is straight between the samples, the linear filters are exact to some 1e-14 of the largest value; tilt
 *  and rotation follow the angles of the sample before, which is an error of first order in the time between samples.
 *  Overlap: outputs must not overlap inputs or each other; a filter is changed in place.
 *  Threads: every function may be called from several threads at once on distinct filters; nothing is allocated.
 */
#ifndef GOUGH_CUEING_H
#define GOUGH_CUEING_H

#include "gough/pose.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The parameters of a washout filter. Fill it with gough_washout_default(); the members may be changed afterwards. */
typedef struct gough_washout {
    double gravity; /**< magnitude of gravity, > 0 */
    double force_gain
        [3]; /**< of the specific force in x, y, z: the part of it that the platform shall give, >= 0 */
    double rate_gain[3]; /**< of the rates of rotation about x, y, z, >= 0 */
    double
        force_limit; /**< greatest component of the specific force after its gain, > 0; may be INFINITY */
    double
        rate_limit; /**< greatest component of the rates after their gain, > 0; may be INFINITY */
    double frequency[3];     /**< of the high pass of surge, sway and heave, > 0 */
    double damping_ratio[3]; /**< of that high pass, > 0 */
    double washout[3]; /**< frequency of its third pole, which brings the platform home, > 0 */
    double turn_frequency[3]; /**< of the high pass of roll, pitch and yaw, > 0 */
    double turn_damping_ratio
        [3]; /**< of that high pass, > 0: it is of second order; 0: of first order */
    double tilt_frequency
        [2]; /**< of the low pass of the forces in x and y that the platform leans for, > 0 */
    double tilt_damping_ratio[2]; /**< of that low pass, > 0 */
    double tilt_rate;             /**< greatest rate of leaning, > 0; may be INFINITY */
    double tilt_angle;            /**< greatest angle of leaning, > 0, at most π/2 */
} gough_washout;

/** Fills in parameters that are usual in flight simulators: Reid and Nahon, UTIAS report 296 (1986).
 *  @param size     sizeof(gough_washout)
 *  @param gravity  magnitude of gravity in the caller's units
 *  @param second   one second in the caller's unit of time
 *  @return GOUGH_OK; GOUGH_ERROR_INPUT if @p size is another. Exact but for the roundings of units. */
GOUGH_API gough_status gough_washout_init(gough_washout *washout, size_t size, double gravity,
                                          double second);

/** Calls gough_washout_init() and returns what it fills in. */
static inline gough_washout gough_washout_default(double gravity, double second) {
    gough_washout washout;
    (void)gough_washout_init(&washout, sizeof washout, gravity, second);
    return washout;
}

/** @return GOUGH_OK; GOUGH_ERROR_INPUT with a sentence if a member is out of its range or not a number. Exact. */
GOUGH_API gough_status gough_washout_check(const gough_washout *washout, gough_error *error);

/** One linear filter of up to three states, stepped exactly for input that is straight between samples, (cue-5). Its members are
 *  the library's own. */
typedef struct gough_linear_filter {
    int states;        /**< 1 to 3 */
    double next[3][3]; /**< what one sample makes of the states */
    double before[3];  /**< what the input of the sample before adds */
    double now[3];     /**< what the input of this sample adds */
    double state[3];   /**< as of the latest sample */
    double input;      /**< of the latest sample */
    bool begun;        /**< there was a sample */
} gough_linear_filter;

/** A washout filter at work. Fill it with gough_cueing_begin(); its members are the library's own. */
typedef struct gough_cueing {
    gough_washout washout;              /**< its parameters */
    gough_linear_filter translation[3]; /**< surge, sway, heave */
    gough_linear_filter rotation[3];    /**< roll, pitch, yaw */
    gough_linear_filter lean[2];        /**< low passes of the forces in x and y */
    double period;                      /**< time between two samples */
    double tilt[2];                     /**< roll and pitch of leaning */
    double angle[3];                    /**< roll, pitch, yaw of the latest sample */
} gough_cueing;

/** What the platform shall do at a sample. */
typedef struct gough_cue {
    double component
        [GOUGH_COMPONENTS]; /**< surge … yaw of the person's head from where it is at home */
    double velocity[3];     /**< of the head, base frame */
    double acceleration[3]; /**< the same */
    double tilt[2];         /**< the part of roll and pitch that is leaning */
    double felt[3];         /**< specific force that the person will feel, axes of the platform */
    bool limited;           /**< force_limit, rate_limit or tilt_rate was at work */
} gough_cue;

/** Begins a washout filter at rest.
 *  @param size    sizeof(gough_cueing)
 *  @param period  time between two samples, > 0
 *  @return GOUGH_OK; GOUGH_ERROR_INPUT with a sentence if the parameters are refused by gough_washout_check(), or the period is
 *          not above 0 and finite; GOUGH_ERROR_NUMERICAL with a sentence if a frequency is so high, or the period so long, that the
 *          filter cannot be stepped in double precision.
 *
 *  The steps of the filters come from one exponential each, accurate to some 1e-15. */
GOUGH_API gough_status gough_cueing_begin(gough_cueing *cueing, size_t size,
                                          const gough_washout *washout, double period,
                                          gough_error *error);

/** Takes one sample of the vehicle's motion, (cue-1) … (cue-4), in a fixed time: for a control loop.
 *  @param force  specific force at the person's head, vehicle axes: (0, 0, g) at rest
 *  @param rate   rates of rotation about the vehicle's axes, radians per unit of time
 *  @param[out] cue  of this very sample
 *  @return GOUGH_OK; GOUGH_ERROR_INPUT with a sentence, and the filter unchanged, if a number is not finite;
 *          GOUGH_ERROR_NUMERICAL with a sentence if the pitch comes to 80° or more, where its angles lose their meaning: the gains
 *          or limits allow too much.
 *
 *  As accurate as the header says. */
GOUGH_API gough_status gough_cueing_sample(gough_cueing *cueing, const double force[3],
                                           const double rate[3], gough_cue *cue,
                                           gough_error *error);

/** Specific force at another point of the vehicle, (cue-1): f + ω̇ × r + ω × (ω × r).
 *  @param force         where it was measured
 *  @param rate          rates of rotation
 *  @param acceleration  their derivatives
 *  @param arm           from where it was measured to the other point, vehicle axes
 *  @param[out] out      there
 *
 *  Accurate to a few roundings of the largest term. */
GOUGH_API void gough_specific_force_at(const double force[3], const double rate[3],
                                       const double acceleration[3], const double arm[3],
                                       double out[3]);

/** How much of a small oscillating force along one axis is felt, (cue-6). */
typedef struct gough_felt_gain {
    double
        least; /**< least magnitude over all frequencies, parts of the force after its gain; of z, which has no leaning, 0 */
    double frequency; /**< where it is, in cycles per unit of time; of z 0 */
} gough_felt_gain;

/** Finds the least gain of (cue-6) over all frequencies. It lies between those of the high pass and of leaning.
 *  @param axis  0: x, 1: y, 2: z
 *  @return GOUGH_OK; GOUGH_ERROR_INPUT with a sentence if there is no such axis or the parameters are refused.
 *
 *  For small forces, and gains and frequencies that do not limit; accurate to 1e-9 of the gain. */
GOUGH_API gough_status gough_washout_felt(const gough_washout *washout, int axis,
                                          gough_felt_gain *gain, gough_error *error);

/** The gain of (cue-6) at one frequency.
 *  @param frequency  in cycles per unit of time, >= 0
 *  @param[out] gain  real and imaginary part of felt over wanted force
 *  @return as gough_washout_felt(). Accurate to some 1e-15. */
GOUGH_API gough_status gough_washout_gain(const gough_washout *washout, int axis, double frequency,
                                          double gain[2], gough_error *error);

/** What the legs can do. */
typedef struct gough_leg_bounds {
    double length[GOUGH_LEGS][2];    /**< least and greatest length, joint to joint, finite */
    double speed[GOUGH_LEGS];        /**< greatest rate, > 0; may be INFINITY */
    double acceleration[GOUGH_LEGS]; /**< greatest second rate, > 0 and finite */
} gough_leg_bounds;

/** A limiter that keeps a platform within what its legs can do, whatever is wanted of it. Fill it with gough_limiter_begin(); its
 *  members are the library's own, but for `state`, `length` and `rate`, which may be read. */
typedef struct gough_limiter {
    const gough_machine *machine; /**< must outlive the struct */
    gough_leg_bounds bounds;      /**< kept at all times */
    double about[3];              /**< the point whose motion counts, top frame */
    double weight;                /**< of angular accelerations, below */
    double gain;                  /**< by which lengths come back to those wanted, one over time */
    double period;                /**< time between two samples */
    gough_state state;            /**< pose of the latest sample; its velocities are not used */
    double length[GOUGH_LEGS];    /**< lengths of the latest sample */
    double rate[GOUGH_LEGS];      /**< their rates */
} gough_limiter;

/** Begins a limiter at rest.
 *  @param size     sizeof(gough_limiter)
 *  @param about    the point whose motion shall be as near as possible to the wanted one, top frame
 *  @param weight   a difference of one in angular acceleration counts as much as a difference of √weight in acceleration of the
 *                  point: a length squared, > 0
 *  @param gain     by which lengths come back to those wanted, one over time, >= 0 and below 1/period; 10 a second is usual
 *  @param period   time between two samples, > 0
 *  @param pose     where the platform rests, within the bounds
 *  @return GOUGH_OK; GOUGH_ERROR_INPUT with a sentence if a number is out of its range, the matrix of the pose is not a
 *          rotation, or its lengths are not within the bounds. Exact. */
GOUGH_API gough_status gough_limiter_begin(gough_limiter *limiter, size_t size,
                                           const gough_machine *machine,
                                           const gough_leg_bounds *bounds, const double about[3],
                                           double weight, double gain, double period,
                                           const gough_state *pose, gough_error *error);

/** Moves the platform on by one sample, (cue-8) … (cue-10), in a bounded time: for a control loop.
 *
 *  Between two samples the rate of each leg is a linear function of time and its length a parabola. They stay within the bounds of
 *  length, speed and acceleration at all times, not only at the samples. Each leg can always stop within its stroke, so that the
 *  next sample is possible whatever is wanted.
 *  @param wanted_length  six lengths of the wanted pose at the latest sample
 *  @param wanted_rate    their rates at the sample that comes
 *  @param[out] limited   for each leg whether a bound holds it; may be NULL
 *  @return GOUGH_OK, with the new pose, lengths and rates in the limiter; GOUGH_ERROR_NUMERICAL with a sentence if the lengths
 *          allowed have no pose that is certainly joined to the last one, or the last one is singular: the limiter is unchanged,
 *          and the platform has to be stopped by other means; GOUGH_ERROR_INPUT if a number is not finite.
 *
 *  Bounds are kept up to 1e-12 of the length. The pose is that of the lengths, within the bounds of gough_pose_from_lengths(). */
GOUGH_API gough_status gough_limiter_sample(gough_limiter *limiter,
                                            const double wanted_length[GOUGH_LEGS],
                                            const double wanted_rate[GOUGH_LEGS],
                                            bool limited[GOUGH_LEGS], gough_error *error);

#ifdef __cplusplus
}
#endif
#endif
