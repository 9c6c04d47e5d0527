/** @file dynamics.h
 *  One pose at a time: leg lengths and rates, Jacobian, inverse and forward dynamics, reactions. Suitable for
 *  a controller's cycle: nothing here allocates, and all functions are safe to call concurrently.
 *
 *  A function that takes a state or a rotation checks first that the matrix is a rotation: each element of RᵀR within 1e-6
 *  of the unit matrix, and a positive determinant. Otherwise it returns GOUGH_ERROR_INPUT and writes nothing. The check costs
 *  about 40 multiplications and additions; it is the only branch that depends on data.
 */
#ifndef GOUGH_DYNAMICS_H
#define GOUGH_DYNAMICS_H

#include "gough/model.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Pose and velocity of the top frame in the base frame. */
typedef struct gough_state {
    double position[3];         /**< of the top frame's origin */
    double rotation[3][3];      /**< R: columns are the top frame's axes in the base frame */
    double velocity[3];         /**< of the origin */
    double angular_velocity[3]; /**< base axes */
} gough_state;

/** Acceleration of the top frame's origin and angular acceleration, base axes. */
typedef struct gough_acceleration {
    double linear[3];  /**< of the origin */
    double angular[3]; /**< derivative of the angular velocity */
} gough_acceleration;

/** Force and moment on the load in addition to legs and gravity: the force acts at the centre of mass; base axes. */
typedef struct gough_wrench {
    double force[3];  /**< at the centre of mass */
    double moment[3]; /**< a free moment */
} gough_wrench;

/** The home pose at rest. */
GOUGH_API gough_state gough_state_home(const gough_machine *machine);

/** R = Rz(yaw) Ry(pitch) Rx(roll), radians. */
GOUGH_API void gough_rotation_from_angles(const double angles[3], double rotation[3][3]);

/** Roll, pitch, yaw of R, with pitch in [−π/2, π/2]. At pitch ±π/2 only a combination of roll and yaw is determined; roll is
 *  then the result of atan2.
 *  @return GOUGH_OK, or GOUGH_ERROR_INPUT if R is not a rotation. */
GOUGH_API gough_status gough_angles_from_rotation(double rotation[3][3], double angles[3]);

/** Leg lengths, rates l̇ and second rates l̈ (legs-2), (legs-4), (legs-6).
 *  @param acceleration  may be NULL; @p second_rate is then not written
 *  @param[out] length,rate,second_rate  six numbers each; any may be NULL
 *  @return GOUGH_OK, or GOUGH_ERROR_INPUT if the matrix of the state is not a rotation.
 *  A leg of zero length has rates of NaN. */
GOUGH_API gough_status gough_leg_kinematics(const gough_machine *machine, const gough_state *state,
                                            const gough_acceleration *acceleration,
                                            double length[GOUGH_LEGS], double rate[GOUGH_LEGS],
                                            double second_rate[GOUGH_LEGS]);

/** Jacobian of the lengths, l̇ = J (v, ω) with v of the top frame's origin and ω, both in base axes (legs-5).
 *  @return GOUGH_OK, or GOUGH_ERROR_INPUT if the matrix of the state is not a rotation. */
GOUGH_API gough_status gough_jacobian(const gough_machine *machine, const gough_state *state,
                                      double jacobian[GOUGH_LEGS][6]);

/** The condition from which a pose counts as singular: eight digits of the leg forces are lost. */
#define GOUGH_GREATEST_CONDITION 1e8

/** How close the six equations are to singular.
 *  @param[out] condition    2-norm condition of J about the top frame's origin, moment columns divided by the mean
 *                           top-joint distance; INFINITY if singular; NaN if a leg has no length. May be NULL
 *  @param[out] determinant  of the same matrix; its sign is the side of the singular surface. May be NULL
 *  @return GOUGH_OK, or GOUGH_ERROR_INPUT if the matrix of the state is not a rotation. */
GOUGH_API gough_status gough_conditioning(const gough_machine *machine, const gough_state *state,
                                          double *condition, double *determinant);

/** Inverse dynamics, the paper's direct problem, (2.2), (2.4)–(2.6): the leg forces that give an acceleration.
 *  @param external  may be NULL for none
 *  @return GOUGH_OK; GOUGH_ERROR_NUMERICAL if condition > GOUGH_GREATEST_CONDITION or a number is not finite; GOUGH_ERROR_INPUT
 *  if the matrix of the state is not a rotation. Use @p force only if the status is GOUGH_OK. */
GOUGH_API gough_status gough_inverse_dynamics(const gough_machine *machine,
                                              const gough_state *state,
                                              const gough_acceleration *acceleration,
                                              const gough_wrench *external,
                                              double force[GOUGH_LEGS], double *condition);

/** Forward dynamics, the paper's inverse problem, (1.4)–(1.6): the acceleration under given leg forces.
 *  @return GOUGH_OK; GOUGH_ERROR_NUMERICAL if a leg has no length (accelerations are then not finite); GOUGH_ERROR_INPUT if
 *  the matrix of the state is not a rotation. */
GOUGH_API gough_status gough_forward_dynamics(const gough_machine *machine,
                                              const gough_state *state,
                                              const double force[GOUGH_LEGS],
                                              const gough_wrench *external,
                                              gough_acceleration *acceleration);

/** Multipliers of the six constraints (1.2), Λ_ii, Λ_jj, Λ_kk, Λ_ij, Λ_jk, Λ_ki in the central frame (body-6), under given
 *  leg forces. A moment on the load enters as Q_e = ½ m × e.
 *  @return GOUGH_OK, or GOUGH_ERROR_INPUT if the matrix of the state is not a rotation. */
GOUGH_API gough_status gough_reactions(const gough_machine *machine, const gough_state *state,
                                       const double force[GOUGH_LEGS], const gough_wrench *external,
                                       double reactions[6]);

/** Control law F = F^p + G (l^p − l) + D (l̇^p − l̇), (law-1): for a real-time loop that has its own F^p, l^p and l̇^p. */
GOUGH_API void gough_control_law(const gough_control *control,
                                 const double program_force[GOUGH_LEGS],
                                 const double program_length[GOUGH_LEGS],
                                 const double program_rate[GOUGH_LEGS],
                                 const double length[GOUGH_LEGS], const double rate[GOUGH_LEGS],
                                 double force[GOUGH_LEGS]);

/** The program's state and acceleration of the top at t. Not finite if a formula is not. */
GOUGH_API void gough_program(const gough_machine *machine, const gough_motion *motion, double t,
                             gough_state *state, gough_acceleration *acceleration);

#ifdef __cplusplus
}
#endif
#endif
