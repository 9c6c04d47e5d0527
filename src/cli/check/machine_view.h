/* What `gough check` tells about a machine at home: from the public interface, in the study's units. */
#ifndef GOUGH_CLI_MACHINE_VIEW_H
#define GOUGH_CLI_MACHINE_VIEW_H

#include "gough/gough.h"

typedef struct machine_view {
    double arm; /* mean distance of the top joints from the top frame's origin: scales moments */
    double top_radius;  /* mean distance of the top joints from their centroid */
    double condition;   /* of the six equations at home */
    double determinant; /* of J at home, not scaled: length^3 */
    double
        least_singular; /* least singular value of J with moment columns over arm: 0 is singular */
    double weakest
        [6]; /* the motion that moves the legs least: direction and arm times rotation, unit length */
    double moments[3]; /* principal moments of inertia */
    double time_unit;  /* sqrt(R_b/g); NaN without gravity */
    double leg_mass;   /* of cylinders and pistons */
    double hanging; /* what of it the top bears at home, (mass-1); the base joints bear the rest */
} machine_view;

machine_view machine_view_of(const gough_machine *machine);

#endif
