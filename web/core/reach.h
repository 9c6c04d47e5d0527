/* What the page asks about poses and reach, of the study that live_begin() has taken in: the core's own searches, called one
 * at a time. Numbers and addresses only; units are those of the run, angles in radians. Theory: docs/theory/pose.md,
 * workspace.md. */
#ifndef GOUGH_WEB_CORE_REACH_H
#define GOUGH_WEB_CORE_REACH_H

#include "live.h"

/* Room for the numbers of a call: those that it takes are put there, and those that it returns are found there. */
double *LIVE_EXPORT(reach_numbers)(void);

/* Begins at home, after live_begin(). 0, or a gough_status with a sentence in reach_message(); poses can be asked for after an
 * error too. Returns: least and greatest length of each leg (0 and Infinity: none), the point at home (base frame), the
 * orientation of the surface, and the sign of the determinant at home. */
int LIVE_EXPORT(reach_begin)(void);

/* The last sentence: why a call has failed. "" if none has. */
const char *LIVE_EXPORT(reach_message)(void);

/* Travel of an axis, gough_workspace_travel(). Returns: both ends, and for each the limit, its leg or component from 0, and the
 * other leg. */
int LIVE_EXPORT(reach_travel)(int component);

/* Takes a start and a direction, six components each: gough_workspace_ray(). Returns: how far, the limit, its leg, the other. */
int LIVE_EXPORT(reach_ray)(void);

/* The word for a limit. */
const char *LIVE_EXPORT(reach_limit_name)(int limit);

/* Takes a pose: x, y, z of the top frame's origin, roll, pitch, yaw. The present pose is there then. Returns its six lengths. */
int LIVE_EXPORT(reach_place)(void);

/* Takes six lengths: the present pose follows them as far as that is certain, gough_pose_from_lengths(). Returns which part of the
 * way it has come. 0, or a gough_status with a sentence. */
int LIVE_EXPORT(reach_follow)(void);

/* Takes six lengths: gough_poses_all(). Returns: real, nonreal, infinite, singular, and the completeness. */
int LIVE_EXPORT(reach_poses)(void);

/* Pose i of the last reach_poses(), or the present one (−1); NULL outside. Six components from home, the position of the top
 * frame's origin, the rotation by rows, determinant, condition, and 1 if it is the present pose. */
const double *LIVE_EXPORT(reach_pose)(int i);

/* Pose i of the last reach_poses() becomes the present one. */
void LIVE_EXPORT(reach_take)(int i);

/* the study's model; NULL before live_begin() */
const struct gough_model *live_model(void);

#endif
