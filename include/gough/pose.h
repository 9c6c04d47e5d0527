/** @file pose.h
 *  The pose from leg lengths (forward kinematics), with a certificate: the pose that is joined to a known one, for a controller or
 *  a record of lengths, and all poses that the lengths allow. Theory: docs/theory/pose.md.
 *
 *  Six lengths do not determine a pose: up to forty have the same lengths. gough_pose_from_lengths() follows the pose from a known
 *  one and either proves that it has arrived at the pose joined to it, or says how far it came. It never answers with a pose of
 *  another branch. gough_poses_all() finds every pose, from nothing but the lengths.
 *
 *  What is proved holds for the machine as its numbers describe it, with errors of rounding enclosed: for the lengths as they are
 *  given, for joints at their places. How errors of joints and lengths move the pose is another question.
 *
 *  Units: any consistent set; angles are in radians. Frames: those of gough_state. The machine must have been filled by
 *  gough_machine_init(). Limits of the legs are not checked, nor whether legs or joints collide. An error argument may be NULL.
 *
 *  Accuracy: each function returns bounds of the errors of its poses, which it proves.
 *  Overlap: outputs must not overlap inputs or each other; the pose that is followed is changed in place.
 *  Threads: every function may be called from several threads at once, with the same machine too, on distinct outputs.
 */
#ifndef GOUGH_POSE_H
#define GOUGH_POSE_H

#include "gough/dynamics.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What is certain about a pose that was followed from another. */
typedef struct gough_pose_certificate {
    int steps; /**< certified steps; 1 unless the change is large */
    double
        reached; /**< part of the change of the squared lengths for which the pose is certain; 1: all of it */
    double
        margin; /**< 1 for no change; 0 for one at the limit of what one step can certify; below 0 for one that needs more
                         steps. Of the whole change, (pose-6) */
    double position_error; /**< bound of the error of the position, a length */
    double angle_error;    /**< bound of the angle between the rotation and the true one */
    double
        unique_position; /**< the lengths have no other pose within this distance whose rotation is */
    double unique_angle; /**< within this angle */
} gough_pose_certificate;

/** Pose of a top in single precision. */
typedef struct gough_pose_single {
    float position[3];    /**< of the top frame's origin, base frame */
    float rotation[3][3]; /**< R: columns are the top frame's axes in the base frame */
} gough_pose_single;

/** Follows a pose to given leg lengths, (pose-6): for a controller that measures lengths, from the pose of its last cycle.
 *
 *  The lengths change from those of the pose given to those asked for, their squares along a straight line. The function proves
 *  that on the whole of this line there is one pose joined to the first, and that it is never singular: by one step if the change
 *  is small (a few percent of the lengths), else by several.
 *  @param length      six lengths, joint to joint, > 0
 *  @param most_steps  steps at most, >= 1: 1 in a control loop, 1000 for a way across the workspace. Each step takes about the same
 *                     time, at most twelve iterations of Newton's method
 *  @param[in,out] pose  position and rotation from which the way begins, and at which it ends; the velocities are neither used nor
 *                     changed. After GOUGH_ERROR_NUMERICAL it is the last pose that is certain, for the part of the
 *                     way that the certificate says; unchanged if that is 0
 *  @param[out] certificate  may be NULL
 *  @return GOUGH_OK; GOUGH_ERROR_NUMERICAL with a sentence if the way is not certain to its end: it meets a singular pose or
 *          passes one so closely that rounding hides on which side, or it needs more steps than @p most_steps;
 *          GOUGH_ERROR_INPUT with a sentence, and everything unchanged, if a length is not above 0 and finite, @p most_steps
 *          is below 1, or the matrix of the pose is not a rotation.
 *
 *  Allocates nothing. Position and rotation have errors below those of the certificate, which are in general 1e-13 to 1e-12 of the
 *  machine's size times the condition number, in truth a thousandth of that. Where the way ends at a singular pose, another line
 *  of lengths may well lead to the same end: that is not decided here. */
GOUGH_API gough_status gough_pose_from_lengths(const gough_machine *machine,
                                               const double length[GOUGH_LEGS], int most_steps,
                                               gough_state *pose,
                                               gough_pose_certificate *certificate,
                                               gough_error *error);

/** Follows a pose as gough_pose_from_lengths() does, for lengths known only at the beginning and at the end, as in a record:
 *  what is proved holds for every course between them that stays within a tube about the straight line of the lengths, (pose-7).
 *  @param tube  six widths >= 0: greatest distance of each length from the straight line in time between its values, with the error
 *               of the values themselves. If no length accelerates by more than a between two samples that are Δt apart, a Δt²/8
 *  @return as gough_pose_from_lengths(), and GOUGH_ERROR_INPUT if a width is negative or not finite. GOUGH_ERROR_NUMERICAL too
 *          if the tube is so wide that it may contain lengths of a singular pose.
 *
 *  The errors of the certificate are those of the pose of the lengths as given, accurate to rounding; those of the values
 *  themselves do not enter. */
GOUGH_API gough_status gough_pose_tube(const gough_machine *machine,
                                       const double length[GOUGH_LEGS],
                                       const double tube[GOUGH_LEGS], int most_steps,
                                       gough_state *pose, gough_pose_certificate *certificate,
                                       gough_error *error);

/** gough_pose_from_lengths() in single precision, for processors without double: the same text, the same proofs, with the
 *  rounding of float enclosed. The machine is prepared in each call.
 *  @return as gough_pose_from_lengths(). Errors are below those of the certificate, in general 1e-4 to 1e-3 of the machine's
 *          size times the condition number; the true errors are in general a thousandth of that. */
GOUGH_API gough_status gough_pose_from_lengths_single(const gough_machine *machine,
                                                      const float length[GOUGH_LEGS],
                                                      int most_steps, gough_pose_single *pose,
                                                      gough_pose_certificate *certificate,
                                                      gough_error *error);

/** Most poses that six lengths allow, unless they allow a whole curve of them: real and complex ones together. */
enum { GOUGH_POSES = 40 };

/** One pose of given lengths. */
typedef struct gough_pose {
    double position[3];    /**< of the top frame's origin, base frame */
    double rotation[3][3]; /**< R: columns are the top frame's axes in the base frame */
    double
        determinant; /**< as from gough_conditioning(): its sign tells sides of singular surfaces apart */
    double condition;      /**< condition number, as from gough_conditioning() */
    double position_error; /**< bound of the error of the position, a length */
    double angle_error;    /**< bound of the angle between the rotation and the true one */
    double
        unique_position; /**< the lengths have no other pose within this distance whose rotation is */
    double unique_angle; /**< within this angle */
} gough_pose;

/** How certain it is that all poses were found. */
typedef enum gough_completeness {
    GOUGH_COMPLETE_NO, /**< some path was lost or ended at a singular pose: there may be more poses */
    GOUGH_COMPLETE_COUNTED, /**< each of the 40 paths ended at a certified pose or, as it seems, at infinity; no proof */
    GOUGH_COMPLETE_PROVED, /**< 40 distinct poses, real and complex, are certified: there are no others */
    GOUGH_COMPLETENESSES /**< number of values */
} gough_completeness;

/** Fixed word for a gough_completeness, as in the JSON of `gough pose`: no, counted, proved. Other values give "unknown". */
GOUGH_API const char *gough_completeness_name(gough_completeness complete);

/** What gough_poses_all() found. */
typedef struct gough_poses {
    int real;     /**< real poses, each certified */
    int nonreal;  /**< complex ones, certified not to be real */
    int infinite; /**< paths that ended at infinity, where there is no pose */
    int singular; /**< the other paths: they were lost or ended at a pose that could not be certified, such as a singular one */
    gough_completeness complete; /**< whether these are all */
    int steps;                   /**< of all 40 paths together */
    int mixings; /**< how often the paths were followed: 1 unless the first time left a doubt */
} gough_poses;

/** All poses of six leg lengths, (pose-8): forty paths from the roots of a system stored in the library, each end certified.
 *  @param length      six lengths, joint to joint, > 0
 *  @param[out] pose   the real poses, from the nearest to home to the farthest: by the distance of the position plus the angle of
 *                     the rotation times the mean distance of the top joints from their centroid
 *  @param[out] found  how many, and whether these are all
 *  @return GOUGH_OK; GOUGH_ERROR_NUMERICAL with a sentence if no real pose was found; GOUGH_ERROR_INPUT with a sentence, and
 *          nothing written, if a length is not above 0 and finite.
 *
 *  Allocates nothing; uses about 200 KiB of stack. Each real pose exists, is real and is distinct from the others, and its errors
 *  are below the bounds that it has, in general 1e-13 or less of the machine's size. Counts are exact. Poses that are symmetric or
 *  mirror images of each other are all listed. Which paths were followed first depends on the processor; the results do not,
 *  except for bits within those errors. */
GOUGH_API gough_status gough_poses_all(const gough_machine *machine,
                                       const double length[GOUGH_LEGS],
                                       gough_pose pose[GOUGH_POSES], gough_poses *found,
                                       gough_error *error);

/** How errors of the lengths move the pose that follows from them, to first order: (pose-12). */
typedef struct gough_resolution {
    double map
        [6]
        [GOUGH_LEGS]; /**< the pose by the lengths: displacement of the point along x, y, z and rotation about them, base
                                    axes, for each unit of length of each leg */
    double
        component[6]; /**< greatest magnitude of each of these, for lengths with the errors given */
    double position;  /**< greatest displacement of the point */
    double direction
        [3]; /**< where it goes, a unit vector, or the opposite; zero if no displacement is possible */
    double position_lengths[GOUGH_LEGS]; /**< errors of the lengths that displace it so */
    double angle;                        /**< greatest rotation */
    double axis[3];                      /**< about which, as `direction` */
    double angle_lengths[GOUGH_LEGS];    /**< errors of the lengths that turn it so */
    double condition;                    /**< condition number, as from gough_conditioning() */
} gough_resolution;

/** How well the pose of a machine is known from lengths that have errors, each at most so large, independent of the others:
 *  (pose-12). A joint that lies up to ε from its place, in any direction, is to first order an error ε of the length of its leg.
 *  @param point   whose displacement is asked for, top frame
 *  @param error_of_length  six numbers >= 0: the greatest error of each length
 *  @return GOUGH_OK; GOUGH_ERROR_NUMERICAL with a sentence if the pose is singular, its condition above GOUGH_GREATEST_CONDITION;
 *          GOUGH_ERROR_INPUT with a sentence if a number is negative or not finite, or the matrix of the state is not a rotation.
 *          @p resolution is unchanged after an error.
 *
 *  Allocates nothing. The velocities of the state are not used. Accurate to 1e-15 times the square of the condition number. What
 *  is of second order is left out: about the square of the pose's error over the length of a leg, times the condition number. */
GOUGH_API gough_status gough_pose_resolution(const gough_machine *machine, const gough_state *state,
                                             const double point[3],
                                             const double error_of_length[GOUGH_LEGS],
                                             gough_resolution *resolution, gough_error *error);

#ifdef __cplusplus
}
#endif
#endif
