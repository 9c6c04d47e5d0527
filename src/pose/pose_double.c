/* The pose from leg lengths in double precision: gough/pose.h. */
#define NUMBER_DOUBLE
#include "pose/follow.h"

gough_status gough_pose_from_lengths(const gough_machine *machine, const double length[GOUGH_LEGS],
                                     int most_steps, gough_state *pose,
                                     gough_pose_certificate *certificate, gough_error *error) {
    return follow(machine, length, NULL, most_steps, pose, certificate, error);
}

gough_status gough_pose_tube(const gough_machine *machine, const double length[GOUGH_LEGS],
                             const double tube[GOUGH_LEGS], int most_steps, gough_state *pose,
                             gough_pose_certificate *certificate, gough_error *error) {
    return follow(machine, length, tube, most_steps, pose, certificate, error);
}
