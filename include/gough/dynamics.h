/** @file dynamics.h
 *  One pose at a time: leg lengths and rates, Jacobian, inverse and forward dynamics, reactions, control law. The functions
 *  suit a real-time control loop: they allocate nothing and keep no state.
 *
 *  Units are any consistent set, such as SI; angles are in radians. Forces of legs are those of their drives, which differ from the
 *  forces in the legs by friction, (mass-13); they push when positive. The machine must have been
 *  filled by gough_machine_init(). Its external loads count only where gough_external_wrench() is passed on.
 *
 *  A function that takes a state or a rotation checks first that the matrix is a rotation: each element of RᵀR within 1e-6
 *  of the unit matrix, and a positive determinant. Otherwise it returns GOUGH_ERROR_INPUT and writes nothing. The check costs
 *  about 40 multiplications and additions; it is the only branch that depends on data. Other inputs are not checked: results
 *  are NaN or infinite if they are.
 *
 *  Accuracy: as each function says; ε is 2.2e-16.
 *  Overlap: outputs must not overlap inputs or each other, except in gough_control_law().
 *  Threads: every function may be called from several threads at once, with the same machine too, on distinct outputs.
 */
#ifndef GOUGH_DYNAMICS_H
#define GOUGH_DYNAMICS_H

#include "gough/model.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Pose and velocity of the top frame, in the base frame. */
typedef struct gough_state {
    double position[3];         /**< of the top frame's origin */
    double rotation[3][3];      /**< R: columns are the top frame's axes in the base frame */
    double velocity[3];         /**< of the origin */
    double angular_velocity[3]; /**< base axes, radians per unit of time */
} gough_state;

/** Acceleration of the top frame's origin and angular acceleration of the top, base axes. */
typedef struct gough_acceleration {
    double linear[3];  /**< of the origin */
    double angular[3]; /**< derivative of the angular velocity */
} gough_acceleration;

/** Force and moment on the load in addition to legs and gravity, base axes. */
typedef struct gough_wrench {
    double force[3];  /**< at the centre of mass */
    double moment[3]; /**< a couple, besides the force */
} gough_wrench;

/** Fills in the home pose at rest: the top frame parallel to the base frame, its origin `height` above that of the base frame.
 *  @param size  sizeof(gough_state)
 *  @return as gough_platform_init(). Exact. */
GOUGH_API gough_status gough_state_init(gough_state *state, size_t size,
                                        const gough_machine *machine);

/** The state that gough_state_init() fills in. */
static inline gough_state gough_state_home(const gough_machine *machine) {
    gough_state state;
    (void)gough_state_init(&state, sizeof state, machine);
    return state;
}

/** R = Rz(yaw) Ry(pitch) Rx(roll) (motion-1).
 *  @param angles         roll, pitch, yaw in radians
 *  @param[out] rotation  columns are the top frame's axes in the base frame
 *
 *  Each element has an error below 4 ε: roundings of sines and cosines and their products. */
GOUGH_API void gough_rotation_from_angles(const double angles[3], double rotation[3][3]);

/** Roll, pitch and yaw of R in radians, the inverse of gough_rotation_from_angles(): pitch in [−π/2, π/2], roll and yaw in
 *  [−π, π]. At a pitch of ±π/2 (gimbal lock) only a combination of roll and yaw is determined; their single values are then
 *  arbitrary.
 *  @return GOUGH_OK, or GOUGH_ERROR_INPUT if R is not a rotation.
 *
 *  The angles are accurate to a few ε divided by the cosine of the pitch. */
GOUGH_API gough_status gough_angles_from_rotation(double rotation[3][3], double angles[3]);

/** R of angles in an order, (motion-1): gough_rotation_from_angles() is that of GOUGH_ZYX.
 *  @param order  GOUGH_ZYX or GOUGH_XYZ; anything else gives NaN
 *
 *  As accurate as gough_rotation_from_angles(). */
GOUGH_API void gough_rotation_in_order(gough_order order, const double angles[3],
                                       double rotation[3][3]);

/** R of a quaternion w, x, y, z, the scalar first, of any length above 0.
 *  @return GOUGH_OK, or GOUGH_ERROR_INPUT if a number is not finite or all are 0; then nothing is written.
 *
 *  Accurate to a few ε. */
GOUGH_API gough_status gough_rotation_of_quaternion(const double quaternion[4],
                                                    double rotation[3][3]);

/** Roll, pitch and yaw of R in an order, as from gough_angles_from_rotation(): the pitch is within ±π/2 in both orders, and
 *  at ±π/2 only a combination of roll and yaw is determined.
 *  @return GOUGH_OK, or GOUGH_ERROR_INPUT if R is not a rotation or there is no such order.
 *
 *  As accurate as gough_angles_from_rotation(). */
GOUGH_API gough_status gough_angles_in_order(gough_order order, double rotation[3][3],
                                             double angles[3]);

/** Leg lengths, joint to joint (inverse kinematics), their rates l̇ and second rates l̈: (legs-2), (legs-4), (legs-6).
 *  @param acceleration  may be NULL; @p second_rate is then not written
 *  @param[out] length,rate,second_rate  six numbers each, in the order of the legs; any may be NULL
 *  @return GOUGH_OK, or GOUGH_ERROR_INPUT if the matrix of the state is not a rotation.
 *
 *  Limits of the legs are not checked. If the joints of a leg coincide, its length is 0 and its rates are NaN. Lengths are accurate
 *  to 10 ε of the machine's size, rates to 20 ε of the velocities of the joints, second rates to 100 ε of their accelerations. */
GOUGH_API gough_status gough_leg_kinematics(const gough_machine *machine, const gough_state *state,
                                            const gough_acceleration *acceleration,
                                            double length[GOUGH_LEGS], double rate[GOUGH_LEGS],
                                            double second_rate[GOUGH_LEGS]);

/** Jacobian of the leg lengths (legs-5): l̇ = J (v, ω), with the velocity v of the top frame's origin and the angular velocity
 *  ω, both in base axes. Its transpose gives the wrench of the legs: force and moment about that origin are Jᵀ f.
 *  @param[out] jacobian  a row for each leg; the first three columns have no unit, the last three are lengths
 *  @return GOUGH_OK, or GOUGH_ERROR_INPUT if the matrix of the state is not a rotation.
 *
 *  The velocities of the state are not used. The row of a leg of zero length is NaN. Elements are accurate to a few ε of the
 *  machine's size over the length of the leg. */
GOUGH_API gough_status gough_jacobian(const gough_machine *machine, const gough_state *state,
                                      double jacobian[GOUGH_LEGS][6]);

/** Greatest condition number of a pose; above it the pose counts as singular, because eight digits of the leg forces are lost. */
#define GOUGH_GREATEST_CONDITION 1e8

/** How close a pose is to a singular one.
 *  @param[out] condition    condition number, in the 2-norm, of J (gough_jacobian()) with its last three columns divided by the
 *                           mean distance of the top joints from the top frame's origin: 1 is best; very large or
 *                           INFINITY in a singular pose, NaN if a leg has no length. It has no unit and does not depend on the
 *                           scale of the machine. May be NULL
 *  @param[out] determinant  determinant of the same matrix with its columns divided in this way, without a unit: 0 up to
 *                           rounding in a singular pose; its sign changes across a singular surface. May be NULL
 *  @return GOUGH_OK, for singular poses too; GOUGH_ERROR_INPUT if the matrix of the state is not a rotation.
 *
 *  Depends on the pose only, not on velocities, load or gravity. The condition number has a relative error below 1e-12
 *  times itself; the determinant is accurate to a few ε. */
GOUGH_API gough_status gough_conditioning(const gough_machine *machine, const gough_state *state,
                                          double *condition, double *determinant);

/** Inverse dynamics: the leg forces that give the top an acceleration, by six linear equations (legs-7); the paper's direct
 *  problem, (2.2), (2.4)–(2.6).
 *  @param acceleration    of the top frame's origin, and angular acceleration
 *  @param external        force and moment on the load besides legs and gravity; NULL for none
 *  @param[out] force      six leg forces along the legs; a push is positive
 *  @param[out] condition  condition number of the pose, as from gough_conditioning(); may be NULL
 *  @return GOUGH_OK; GOUGH_ERROR_NUMERICAL if the condition exceeds GOUGH_GREATEST_CONDITION or a force is not finite;
 *          GOUGH_ERROR_INPUT if the matrix of the state is not a rotation. Use @p force only if the status is GOUGH_OK.
 *
 *  Mass and friction of the legs are counted, (mass-4), (mass-13), with the rates of the state; those of a screw that locks itself
 *  too. Limits of the legs are not checked. The forces have a relative error below 3e-14 times the condition number, of the
 *  largest force that weight and inertia of load and legs ask for. */
GOUGH_API gough_status gough_inverse_dynamics(const gough_machine *machine,
                                              const gough_state *state,
                                              const gough_acceleration *acceleration,
                                              const gough_wrench *external,
                                              double force[GOUGH_LEGS], double *condition);

/** Forward dynamics: the acceleration of the top under given leg forces (body-3), (body-4); the paper's inverse problem,
 *  (1.4)–(1.6).
 *  @param force              six leg forces along the legs; a push is positive
 *  @param external           force and moment on the load besides legs and gravity; NULL for none
 *  @param[out] acceleration  of the top frame's origin, and angular acceleration
 *  @return GOUGH_OK; GOUGH_ERROR_NUMERICAL if the acceleration is not finite, as when a leg has no length; GOUGH_ERROR_INPUT
 *          if the matrix of the state is not a rotation, or if a leg's efficiency is 0.5 or less: its screw locks itself, and no
 *          drive force determines a motion.
 *
 *  With legs that have mass: (mass-9), (mass-10). Defined in singular poses too: there the legs cannot carry every load, but any
 *  leg forces give an acceleration. The inverse of gough_inverse_dynamics() elsewhere. Accurate to roundings: 1e-14 of what the
 *  legs, weight and rotation give by themselves. */
GOUGH_API gough_status gough_forward_dynamics(const gough_machine *machine,
                                              const gough_state *state,
                                              const double force[GOUGH_LEGS],
                                              const gough_wrench *external,
                                              gough_acceleration *acceleration);

/** Reactions of the six constraints (1.2) that keep the body axes orthonormal: the multipliers Λ_ii, Λ_jj, Λ_kk, Λ_ij, Λ_jk,
 *  Λ_ki in the central frame (body-6), under given leg forces, in units of a moment.
 *  @param force           six leg forces along the legs; a push is positive
 *  @param external        NULL for none; its moment m enters as the generalised forces Q_e = ½ m × e of the axes e, its force has
 *                         no effect but on the accelerations of legs with mass
 *  @param[out] reactions  six numbers in the order above
 *  @return GOUGH_OK, or GOUGH_ERROR_INPUT as from gough_forward_dynamics().
 *
 *  With legs that have mass, the forces of the legs on the top are those of the motion that the drives give, (mass-5). Defined in
 *  singular poses too; NaN if a leg has no length. They are internal to the load and do no work. Accurate to roundings:
 *  1e-14 of the moments of the legs about the centre of mass. */
GOUGH_API gough_status gough_reactions(const gough_machine *machine, const gough_state *state,
                                       const double force[GOUGH_LEGS], const gough_wrench *external,
                                       double reactions[6]);

/** Forces at the joints of the legs of a top in motion, which size bearings and guides: (mass-5), (mass-6), (mass-8).
 *  @param acceleration  of the top frame's origin, and angular acceleration
 *  @param external      force and moment on the load besides legs and gravity; NULL for none
 *  @param[out] leg      six forces in the legs, between cylinder and piston: those of the drives less friction; a push is positive.
 *                       With the inertia of rotor, screw and oil in them
 *  @param[out] top      force of each leg on the top, base axes: along the leg only if the leg has no mass
 *  @param[out] base     force of the base on each leg, base axes
 *  @param[out] side     six side loads, at least 0: the force across the leg between cylinder and piston at the piston's centre
 *                       of mass. The couple about that point is left out; 0 if the legs have no mass. Any output may be NULL
 *  @return GOUGH_OK; GOUGH_ERROR_NUMERICAL if the condition exceeds GOUGH_GREATEST_CONDITION or a force is not finite;
 *          GOUGH_ERROR_INPUT if the matrix of the state is not a rotation. Use the outputs only if the status is GOUGH_OK.
 *
 *  The leg forces are those that the acceleration needs, (mass-4), as in gough_inverse_dynamics(), and as accurate; also those
 *  of screws that lock themselves. Without mass, top and base bear the leg force along the leg. The forces on the top balance
 *  weight and inertia of the load; those of the base balance load and legs together. */
GOUGH_API gough_status gough_joint_forces(const gough_machine *machine, const gough_state *state,
                                          const gough_acceleration *acceleration,
                                          const gough_wrench *external, double leg[GOUGH_LEGS],
                                          double top[GOUGH_LEGS][3], double base[GOUGH_LEGS][3],
                                          double side[GOUGH_LEGS]);

/** Drive forces between which friction alone holds the legs at rest: from F − F_S − e|F| to F + F_S + e|F|, by (mass-13) with the
 *  largest friction either way; F is the force in the leg, F_S breakaway friction and e = 1/efficiency − 1.
 *  @param external   force and moment on the load besides legs and gravity; NULL for none
 *  @param[out] force the six leg forces F that carry the load at rest: what the drives give without friction
 *  @param[out] low   below this drive force the leg gets shorter, however slowly before; may be NULL
 *  @param[out] high  above this drive force the leg gets longer; may be NULL
 *  @return as gough_inverse_dynamics()
 *
 *  The velocities of the state are not used. If 0 lies between low and high, the leg holds without its drive: with a pushing load
 *  and no other friction for an efficiency of 0.5 or less. The smooth law of friction creeps inside the band, (mass-12), and
 *  reaches F_S only nearly. As accurate as gough_inverse_dynamics(). */
GOUGH_API gough_status gough_holding_forces(const gough_machine *machine, const gough_state *state,
                                            const gough_wrench *external, double force[GOUGH_LEGS],
                                            double low[GOUGH_LEGS], double high[GOUGH_LEGS]);

/** Force and moment of the external loads of a machine on its top at time @p t, (law-4), for the functions above.
 *  @param[out] wrench  the sum of the loads as a force at the centre of mass and a moment, base axes; zero without loads
 *  @return GOUGH_OK; GOUGH_ERROR_INPUT if the matrix of the state is not a rotation or a formula is not finite at @p t
 *
 *  Velocities of the state are not used. Accurate to a few ε of the forces, and of them times their arms. */
GOUGH_API gough_status gough_external_wrench(const gough_machine *machine, const gough_state *state,
                                             double t, gough_wrench *wrench);

/** Checks a control law against what its members must be (model.h). gough_simulation_check() does so, too.
 *  @return GOUGH_OK, or GOUGH_ERROR_INPUT with a sentence: a gain that is not finite, or negative without being in a matrix; a
 *  negative integral or time; a tracking_time shorter than the period of the samples where there is an integral; of a sampled
 *  controller a delay of 100 periods or more, a jitter longer than the period, a cutoff of 1/(2 period) or more, or one of exact
 *  rates; a resolution, noise or preview that is negative. The other members of `sampling` are not checked if its period is 0. */
GOUGH_API gough_status gough_control_check(const gough_control *control, gough_error *error);

/** Whether a loop moves as its program does where nothing disturbs it, (law-5): its feed-forward is that of the machine as it is,
 *  so that the program is a motion of the loop, about which deviations may be counted. If it does not, it sags and lags. A loop
 *  with integrals in all six legs comes to rest on a program at rest, whatever its feed-forward lacks. Dry
 *  friction and losses of screws do not count, since they are left out of whatever is computed about such a motion; limits and
 *  lags of drives and the samples of a controller do not count either.
 *  @param machine  whose legs may have mass and friction, and which may have external loads
 *  @param control  what the feed-forward is, and what it ignores
 *  @param moving   whether the program moves; in a program at rest viscous friction has no force and
 *                  integrals in all legs bear what is not fed forward
 *  @return true if it does. Exact, a comparison of members: an external load counts even if its formulas are 0. */
GOUGH_API bool gough_keeps_program(const gough_machine *machine, const gough_control *control,
                                   bool moving);

/** Control law of one instant, F = F^p + G (l^p − l) + D (l̇^p − l̇) (law-1): for a real-time loop that measures l and l̇ and has
 *  its own F^p, l^p and l̇^p.
 *  @param control         stiffness G and damping D of each leg; without feed-forward, F^p is taken as 0
 *  @param program_force   F^p, such as from gough_inverse_dynamics(); read only with feed-forward, else it may be NULL
 *  @param program_length  l^p of the commanded motion
 *  @param program_rate    l̇^p of the commanded motion
 *  @param length          l, as measured
 *  @param rate            l̇, as measured
 *  @param[out] force      six leg forces; a push is positive. May be the same array as any input
 *
 *  Nothing is limited: saturation and limits of the legs are the caller's. A leg with a NaN in its inputs gets NaN, the others
 *  do not. Exact but for five roundings, of G l and D l̇ before their differences. */
GOUGH_API void gough_control_law(const gough_control *control,
                                 const double program_force[GOUGH_LEGS],
                                 const double program_length[GOUGH_LEGS],
                                 const double program_rate[GOUGH_LEGS],
                                 const double length[GOUGH_LEGS], const double rate[GOUGH_LEGS],
                                 double force[GOUGH_LEGS]);

/** What a sampled controller remembers from one sample to the next, (loop-1). Zero-filled before the first. */
typedef struct gough_control_memory {
    double error[GOUGH_LEGS];    /**< l^p − l of the last sample */
    double rate[GOUGH_LEGS];     /**< its rate, as found then */
    double integral[GOUGH_LEGS]; /**< I of the next sample */
    bool begun;                  /**< there has been a sample */
} gough_control_memory;

/** One sample of a sampled controller, (loop-1): for a real-time loop that measures l each period and sends the command to the
 *  drives. A run of the model computes the same bits from the same numbers.
 *  @param control         with sampling.period > 0; of its sampling, period, velocity and cutoff are used here
 *  @param actuators       whose max_force limits the command, and stops the integral as control->tracking_time says; NULL: no
 *                         limits
 *  @param memory          of the sample before; changed
 *  @param program_force   F^p, as in gough_control_law()
 *  @param program_length  l^p at the time of the sample
 *  @param program_rate    l̇^p
 *  @param length          l, as measured
 *  @param rate            l̇, as measured. Where the controller finds rates by differences it is read in the first sample only, and
 *                         NULL means the program's
 *  @param[out] command    of each drive; must not overlap an input
 *
 *  Exact but for the roundings of its few sums. */
GOUGH_API void gough_control_sample(const gough_control *control, const gough_actuators *actuators,
                                    gough_control_memory *memory,
                                    const double program_force[GOUGH_LEGS],
                                    const double program_length[GOUGH_LEGS],
                                    const double program_rate[GOUGH_LEGS],
                                    const double length[GOUGH_LEGS], const double rate[GOUGH_LEGS],
                                    double command[GOUGH_LEGS]);

/** State and acceleration of the top that the program commands at time @p t. If a formula is not finite there, neither are
 *  they. Recorded motion keeps its first or last pose outside its record, at rest. As accurate as gough_motion_evaluate(). */
GOUGH_API void gough_program(const gough_machine *machine, const gough_motion *motion, double t,
                             gough_state *state, gough_acceleration *acceleration);

/** What keeps a move from being faster. */
typedef enum gough_move_limit {
    GOUGH_MOVE_SPEED,                 /**< gough_move.speed, as with the next three */
    GOUGH_MOVE_ACCELERATION,          /**< of the point */
    GOUGH_MOVE_ANGULAR_SPEED,         /**< of an angle */
    GOUGH_MOVE_ANGULAR_ACCELERATION,  /**< of an angle */
    GOUGH_MOVE_LEG_SPEED,             /**< limits of the machine: the rate of a leg's length */
    GOUGH_MOVE_LEG_ACCELERATION,      /**< the second rate of a leg's length */
    GOUGH_MOVE_LEG_FORCE,             /**< the drive force of a leg */
    GOUGH_MOVE_PLATFORM_SPEED,        /**< a component of the velocity or angular velocity */
    GOUGH_MOVE_PLATFORM_ACCELERATION, /**< a component of the acceleration or angular acceleration */
    GOUGH_MOVE_LIMITS
} gough_move_limit;

/** The duration of a move, and the limit from which it follows. */
typedef struct gough_move_fit {
    double duration; /**< of gough_move; the motion takes duration/frequency if it is scaled */
    gough_move_limit limit; /**< the limit from which the duration follows */
    int which;              /**< leg, from 0, or component; −1 where the limit is of the point */
    double time;            /**< at which the limit is reached */
} gough_move_fit;

/** Finds the duration of a move from its limits, (motion-13): the least for which the program keeps speed, acceleration,
 *  angular_speed and angular_acceleration of the move, and with `least` also the limits of speed, acceleration and force of the
 *  legs and of speed and acceleration of the platform. Limits of lengths and poses are not looked at: no duration changes them.
 *  @param machine  from gough_machine_init(), with its external loads
 *  @param motion   of kind GOUGH_MOTION_MOVES; the durations of the moves before must be known, that of this one is not read
 *  @param index    the move, from 0
 *  @param[out] fit the duration and its limit
 *  @param size     sizeof(gough_move_fit)
 *  @return GOUGH_OK; GOUGH_ERROR_INPUT with a sentence if the motion is wrong or has no such move, if nothing bounds the move,
 *          if it keeps its limits with no duration, or if the leg forces along it cannot be computed
 *
 *  Speeds and accelerations of the move itself are exact to roundings. Limits of the machine are compared at 257 times of the move
 *  and at the vertices of parabolas through three of them; the duration is at most 3e-6 of itself above the least that keeps them
 *  there. If a longer move needs larger forces, as external loads that vary with time can make it, another, shorter duration may
 *  keep the limits too. */
GOUGH_API gough_status gough_move_find(const gough_machine *machine, const gough_motion *motion,
                                       size_t index, gough_move_fit *fit, size_t size,
                                       gough_error *error);

#ifdef __cplusplus
}
#endif
#endif
