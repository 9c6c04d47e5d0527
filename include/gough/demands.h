/** @file demands.h
 *  What a machine is to reach and to bear: the part of a model that gough/workspace.h asks about.
 *
 *  Units: any consistent set; angles in radians. Plain data: fill, copy and share it freely.
 */
#ifndef GOUGH_DEMANDS_H
#define GOUGH_DEMANDS_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/** What a machine must do in all poses of its workspace, for gough/workspace.h. Zero-filled: keep its limits, at rest under its
 *  own load. Half widths: each number may lie between −x and x, independently of the others; base axes. */
typedef struct gough_workspace {
    /** Shape of a box of poses, surge … yaw: least and greatest displacement of the point and angles from home; {0, 0}: that of
     *  home. */
    double box[6][2];
    double about[3];                /**< the point, top frame */
    bool about_given;               /**< false: the point `about` of the motion */
    double orientation[3];          /**< roll, pitch, yaw at which its volume is measured */
    double acceleration[3];         /**< half widths, of the top frame's origin */
    double angular_acceleration[3]; /**< half widths */
    double velocity[3];             /**< half widths, of the top frame's origin */
    double angular_velocity[3];     /**< half widths */
    double force[3];                /**< half widths, on the load at its centre of mass */
    double moment[3];               /**< half widths, on the load */
    double least_singular_value; /**< of the Jacobian of gough_conditioning(), >= 0; 0: above 0 */
} gough_workspace;

#ifdef __cplusplus
}
#endif
#endif
