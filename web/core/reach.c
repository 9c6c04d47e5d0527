/* Poses and reach in the page: the library's searches on the study that the page has taken in. */
#include "reach.h"

#include <math.h>
#include <string.h>

#include "gough/pose.h"
#include "gough/workspace.h"

/* numbers of a call at most, and of a pose; steps of a way across the workspace */
enum { NUMBERS = 24, OF_POSE = 21, MOST_STEPS = 1000 };

/* The module holds one study; this is what was asked of it last. */
static struct {
    gough_reach of;
    gough_state home, present;
    gough_poses found;
    gough_pose pose[GOUGH_POSES];
    double number[NUMBERS], shown[OF_POSE];
    gough_error error;
} reach;

double *reach_numbers(void) { return reach.number; }
const char *reach_message(void) { return reach.error.message; }
const char *reach_limit_name(int limit) { return gough_bind_name((gough_bind)limit); }

static void put_binding(double *to, const gough_binding *b) {
    to[0] = (double)b->bind, to[1] = (double)b->which, to[2] = (double)b->other;
}

/* the point that components are given by, of a state */
static void point_of(const gough_state *s, double point[3]) {
    for (int r = 0; r < 3; r++) {
        point[r] = s->position[r];
        for (int k = 0; k < 3; k++) point[r] += s->rotation[r][k] * reach.of.about[k];
    }
}

int reach_begin(void) {
    const gough_model *model = live_model();
    gough_limits limits;
    if (!model) return GOUGH_ERROR_INPUT;
    reach.error.message[0] = '\0';
    reach.found = (gough_poses){.real = 0};
    reach.home = reach.present = gough_state_home(&model->machine);
    const gough_status status = gough_reach_init(&reach.of, sizeof reach.of, model, &reach.error);
    if (status) memcpy(reach.of.about, model->motion.about, sizeof reach.of.about);
    reach.of.machine = &model->machine;
    limits = gough_limits_of(&model->machine, &model->motion);
    memcpy(reach.number, limits.length, sizeof limits.length);
    point_of(&reach.home, reach.number + 12);
    memcpy(reach.number + 15, model->workspace.orientation, 3 * sizeof(double));
    reach.number[18] = status ? 0 : reach.of.side;
    return (int)status;
}

int reach_travel(int component) {
    gough_travel travel = {.tests = 0};
    const gough_status status = gough_workspace_travel(&reach.of, component, &travel, &reach.error);
    for (int end = 0; end < 2; end++) {
        reach.number[end] = travel.end[end];
        put_binding(reach.number + 2 + 3 * end, &travel.binding[end]);
    }
    return (int)status;
}

int reach_ray(void) {
    double start[GOUGH_COMPONENTS], direction[GOUGH_COMPONENTS];
    gough_ray ray = {.reach = 0};
    memcpy(start, reach.number, sizeof start);
    memcpy(direction, reach.number + GOUGH_COMPONENTS, sizeof direction);
    const gough_status status =
        gough_workspace_ray(&reach.of, start, direction, &ray, &reach.error);
    reach.number[0] = ray.reach;
    put_binding(reach.number + 1, &ray.binding);
    return (int)status;
}

int reach_place(void) {
    const gough_model *model = live_model();
    if (!model) return GOUGH_ERROR_INPUT;
    memcpy(reach.present.position, reach.number, sizeof reach.present.position);
    gough_rotation_in_order(model->motion.order, reach.number + 3, reach.present.rotation);
    return (int)gough_leg_kinematics(&model->machine, &reach.present, NULL, reach.number, NULL,
                                     NULL);
}

int reach_follow(void) {
    const gough_model *model = live_model();
    gough_pose_certificate certificate = {.reached = 0};
    if (!model) return GOUGH_ERROR_INPUT;
    reach.error.message[0] = '\0';
    const gough_status status = gough_pose_from_lengths(&model->machine, reach.number, MOST_STEPS,
                                                        &reach.present, &certificate, &reach.error);
    reach.number[0] = certificate.reached;
    return (int)status;
}

int reach_poses(void) {
    const gough_model *model = live_model();
    if (!model) return GOUGH_ERROR_INPUT;
    reach.error.message[0] = '\0';
    reach.found = (gough_poses){.real = 0};
    const gough_status status =
        gough_poses_all(&model->machine, reach.number, reach.pose, &reach.found, &reach.error);
    reach.number[0] = reach.found.real, reach.number[1] = reach.found.nonreal;
    reach.number[2] = reach.found.infinite, reach.number[3] = reach.found.singular;
    reach.number[4] = (double)reach.found.complete;
    return (int)status;
}

/* whether a pose is the present one, from which no other of its lengths is so near */
static int is_present(const gough_pose *pose) {
    double square = 0, turn = 0;
    for (int r = 0; r < 3; r++) {
        square += pow(pose->position[r] - reach.present.position[r], 2);
        for (int k = 0; k < 3; k++)
            turn += pow(pose->rotation[r][k] - reach.present.rotation[r][k], 2);
    }
    return sqrt(square) < pose->unique_position &&
           2 * asin(fmin(1, sqrt(turn / 8))) < pose->unique_angle;
}

static void place_at(const gough_pose *pose, gough_state *state) {
    *state = reach.home;
    memcpy(state->position, pose->position, sizeof pose->position);
    memcpy(state->rotation, pose->rotation, sizeof pose->rotation);
}

const double *reach_pose(int i) {
    const gough_model *model = live_model();
    gough_state state = reach.present;
    double from[3], to[3], *x = reach.shown;
    if (!model || i < -1 || i >= reach.found.real) return NULL;
    if (i >= 0) place_at(&reach.pose[i], &state);
    point_of(&reach.home, from), point_of(&state, to);
    for (int k = 0; k < 3; k++) x[k] = to[k] - from[k];
    gough_angles_in_order(model->motion.order, state.rotation, x + 3);
    memcpy(x + 6, state.position, sizeof state.position);
    memcpy(x + 9, state.rotation, sizeof state.rotation);
    gough_conditioning(&model->machine, &state, &x[19], &x[18]);
    x[20] = i < 0 || is_present(&reach.pose[i]);
    return x;
}

void reach_take(int i) {
    if (i >= 0 && i < reach.found.real) place_at(&reach.pose[i], &reach.present);
}
