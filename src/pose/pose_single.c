/* The pose from leg lengths in single precision: gough/pose.h. */
#define NUMBER_FLOAT
#include "pose/follow.h"

gough_status gough_pose_from_lengths_single(const gough_machine *machine,
                                            const float length[GOUGH_LEGS], int most_steps,
                                            gough_pose_single *pose,
                                            gough_pose_certificate *certificate,
                                            gough_error *error) {
    gough_state state = {.velocity = {0}};
    double lengths[GOUGH_LEGS];
    gough_status status;

    for (int v = 0; v < GOUGH_LEGS; v++) lengths[v] = (double)length[v];
    for (int r = 0; r < 3; r++) {
        state.position[r] = (double)pose->position[r];
        for (int c = 0; c < 3; c++) state.rotation[r][c] = (double)pose->rotation[r][c];
    }
    status = follow(machine, lengths, NULL, most_steps, &state, certificate, error);
    if (status == GOUGH_ERROR_INPUT) return status;
    for (int r = 0; r < 3; r++) {
        pose->position[r] = (float)state.position[r];
        for (int c = 0; c < 3; c++) pose->rotation[r][c] = (float)state.rotation[r][c];
    }
    return status;
}
