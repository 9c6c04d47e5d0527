/* Machines of all families for the tests of poses, and what an independent road needs: lengths by vectors, Newton's method in
 * rotation and position. Lengths in any unit, angles in radians. */
#ifndef TESTS_POSE_POSE_MACHINES_H
#define TESTS_POSE_POSE_MACHINES_H

#include "gough/pose.h"
#include "support/machines.h"

typedef enum {
    FAMILY_GENERAL,
    FAMILY_PLANE_BASE,
    FAMILY_PLANE_BOTH,
    FAMILY_SIX_FIVE,
    FAMILY_SIX_FOUR,
    FAMILY_SIX_THREE,
    FAMILY_THREE_THREE,
    FAMILY_RINGS,
    FAMILIES
} family;

/* A random machine of a family; all have base and top of about 1 and 0.6 and a height of about 1.2. */
void family_machine(family which, dice *d, gough_machine *machine);

/* Dietmaier's machine, whose home is of no matter, and its lengths: tests/data/dietmaier.csv in $SOURCE. Each fourth of its poses,
 * from the first on, is printed in the paper: position and the first two columns of R. */
enum { DIETMAIER_POSES = 10 };
void dietmaier_machine(gough_machine *machine, double length[GOUGH_LEGS],
                       double pose[DIETMAIER_POSES][9]);

/* A random pose near home: by at most so much in each direction and each angle. */
gough_state random_pose(const gough_machine *machine, double shift, double turn, dice *d);

/* Lengths by |p + R a − b|, in long double. */
void lengths_by_vectors(const gough_machine *machine, const gough_state *state,
                        double length[GOUGH_LEGS]);

/* Newton's method for the pose in rotation and position, with its own Jacobian; true if it converged. */
bool newton_by_vectors(const gough_machine *machine, const double length[GOUGH_LEGS],
                       gough_state *state);

/* The largest difference of position and of an element of the rotation; the distance; the angle between rotations. */
double pose_difference(const gough_state *a, const gough_state *b);
double pose_distance(const gough_state *a, const gough_state *b);
double pose_angle(const gough_state *a, const gough_state *b);

/* A found pose as a state at rest. */
gough_state state_of(const gough_pose *pose);

#endif
