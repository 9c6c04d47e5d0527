/* (design-1) … (design-4): the excess of a design over its limits, and its aims. Theory: docs/theory/design.md. */
#include "design/score.h"

#include <math.h>
#include <string.h>

#include "gough/workspace.h"

static const double PI = 3.14159265358979323846;

/* ---- poses ---- */

void demand_poses(demand *d) {
    const gough_box *b = &d->box;
    d->poses = 0;
    for (int corner = 0; corner < DESIGN_CORNERS; corner++) {
        double *pose = d->pose[d->poses];
        bool again = false;
        for (int c = 0; c < GOUGH_COMPONENTS; c++) {
            const bool flat = !(b->greatest[c] > b->least[c]);
            again |= flat && (corner >> c & 1);
            pose[c] = corner >> c & 1 ? b->greatest[c] : b->least[c];
        }
        if (!again) d->poses++;
    }
    for (int c = 0; c < GOUGH_COMPONENTS; c++)
        d->pose[d->poses][c] = 0.5 * b->least[c] + 0.5 * b->greatest[c];
    d->poses++;
}

bool pose_is_allowed(const gough_reach *reach, const double pose[GOUGH_COMPONENTS],
                     gough_binding *binding) {
    gough_box one;
    memcpy(one.least, pose, sizeof one.least);
    memcpy(one.greatest, pose, sizeof one.greatest);
    return gough_box_test(reach, &one, binding) == GOUGH_INSIDE;
}

/* ---- limits with more room, (design-1) ---- */

/* the width of a range, or the size of its one limit; INFINITY: it has none */
static double range_size(const double range[2]) {
    if (isfinite(range[1] - range[0])) return range[1] - range[0];
    return fmin(fabs(range[0]), fabs(range[1]));
}

/* of forces, the larger of both limits */
static double force_size(const double range[2]) {
    const double low = fabs(range[0]), high = fabs(range[1]);
    return low < INFINITY && high < INFINITY ? fmax(low, high) : fmin(low, high);
}

static void ease_end(double *end, double sign, double size, double part) {
    if (isfinite(size)) *end += sign * part * size;
}

static void ease_leg(gough_limits *l, int v, const double part[GOUGH_BINDS]) {
    const double length = range_size(l->length[v]), force = force_size(l->force[v]);
    ease_end(&l->length[v][0], -1, length, part[GOUGH_BIND_SHORTEST]);
    ease_end(&l->length[v][1], 1, length, part[GOUGH_BIND_LONGEST]);
    ease_end(&l->force[v][0], -1, force, part[GOUGH_BIND_PULL]);
    ease_end(&l->force[v][1], 1, force, part[GOUGH_BIND_PUSH]);
    l->length[v][0] = fmax(l->length[v][0], 0);
    l->speed[v] *= 1 + part[GOUGH_BIND_SPEED];
    l->acceleration[v] *= 1 + part[GOUGH_BIND_ACCELERATION];
    if (l->base_swing[v] < PI)
        l->base_swing[v] = fmin(l->base_swing[v] * (1 + part[GOUGH_BIND_BASE_SWING]), PI);
    if (l->top_swing[v] < PI)
        l->top_swing[v] = fmin(l->top_swing[v] * (1 + part[GOUGH_BIND_TOP_SWING]), PI);
    l->diameter[v] *= fmax(1 - part[GOUGH_BIND_CLEARANCE], 0);
}

gough_reach reach_eased(const gough_reach *reach, const double part[GOUGH_BINDS]) {
    gough_reach eased = *reach;
    for (int v = 0; v < GOUGH_LEGS; v++) ease_leg(&eased.limits, v, part);
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        const double size = range_size(reach->limits.pose[c]);
        ease_end(&eased.limits.pose[c][0], -1, size, part[GOUGH_BIND_POSE]);
        ease_end(&eased.limits.pose[c][1], 1, size, part[GOUGH_BIND_POSE]);
    }
    eased.asked.least_singular_value *= fmax(1 - part[GOUGH_BIND_SINGULAR_VALUE], 0);
    return eased;
}

/* all limits by one part, with what is to be spare */
static gough_reach eased_by(const gough_reach *reach, const double spare[GOUGH_BINDS], double by) {
    double part[GOUGH_BINDS];
    for (int kind = 0; kind < GOUGH_BINDS; kind++) part[kind] = by - spare[kind];
    return reach_eased(reach, part);
}

gough_status reach_of_design(const demand *d, const gough_model *model, gough_reach *reach,
                             gough_error *error) {
    const gough_status status = gough_reach_init(reach, sizeof *reach, model, error);
    if (status) return status;
    reach->asked.least_singular_value =
        fmax(reach->asked.least_singular_value, d->request->least_singular_value);
    return GOUGH_OK;
}

/* ---- excess, (design-2) ---- */

static const double FIRST = 1e-3, GREATEST = 1e3, FINEST = 1e-9, PART = 1e-4;

double ease_needed(const double spare[GOUGH_BINDS], const gough_reach *reach,
                   const double pose[GOUGH_COMPONENTS], double low) {
    double step = FIRST, high = low + step;
    const gough_reach as_it_is = eased_by(reach, spare, low);
    if (pose_is_allowed(&as_it_is, pose, NULL)) return low;
    for (gough_reach eased = eased_by(reach, spare, high); !pose_is_allowed(&eased, pose, NULL);
         eased = eased_by(reach, spare, high)) {
        if (high > GREATEST) return INFINITY;
        low = high, step *= 4, high += step;
    }
    while (high - low > fmax(FINEST, PART * fabs(high))) {
        const double middle = 0.5 * (low + high);
        const gough_reach eased = eased_by(reach, spare, middle);
        if (pose_is_allowed(&eased, pose, NULL))
            high = middle;
        else
            low = middle;
    }
    return high;
}

/* One part for all poses: each is tested with what the poses before it need. */
static double excess_of(const demand *d, const gough_reach *reach) {
    double part = 0;
    size_t singular = 0;
    gough_reach eased = eased_by(reach, d->spare, part);
    for (size_t i = 0; i < d->poses; i++) {
        if (pose_is_allowed(&eased, d->pose[i], NULL)) continue;
        const double needed = ease_needed(d->spare, reach, d->pose[i], part);
        if (needed < INFINITY)
            part = needed, eased = eased_by(reach, d->spare, part);
        else
            singular++;
    }
    return singular ? EXCESS_SINGULAR + (double)singular : part;
}

double telescope_lacks(const gough_design_request *request, double shortest, double longest) {
    if (isnan(request->telescope)) return -INFINITY;
    return (longest - (2 * shortest - request->telescope)) / longest;
}

/* ---- aims, (design-3) ---- */

/* (space-1) for the top frame's origin: p₀ + d − R a */
static void state_at(const gough_reach *reach, const double pose[GOUGH_COMPONENTS],
                     gough_state *state) {
    *state = gough_state_home(reach->machine);
    gough_rotation_in_order(reach->order, pose + GOUGH_ROLL, state->rotation);
    for (int i = 0; i < 3; i++) {
        double turned = 0;
        for (int k = 0; k < 3; k++) turned += state->rotation[i][k] * reach->about[k];
        state->position[i] += reach->about[i] + pose[i] - turned;
    }
}

static void find_lengths(const demand *d, const gough_reach *reach, score *s) {
    s->shortest = INFINITY, s->longest = 0;
    for (size_t i = 0; i < d->poses; i++) {
        gough_state state;
        double length[GOUGH_LEGS];
        state_at(reach, d->pose[i], &state);
        gough_leg_kinematics(reach->machine, &state, NULL, length, NULL, NULL);
        for (int v = 0; v < GOUGH_LEGS; v++) {
            s->shortest = fmin(s->shortest, length[v]);
            s->longest = fmax(s->longest, length[v]);
        }
    }
}

static double footprint_of(const gough_model *model) {
    const gough_platform *p = &model->machine.platform;
    double most = 0;
    for (int v = 0; v < GOUGH_LEGS; v++) {
        most = fmax(most, hypot(p->base[v][0], p->base[v][1]));
        most = fmax(most, hypot(p->top[v][0], p->top[v][1]));
    }
    return most;
}

/* The values that gough_workspace_envelope() samples at the corners; without tests it goes no further. */
static void find_forces(const demand *d, const gough_reach *reach, score *s) {
    gough_reach corners = *reach;
    gough_envelope e;
    corners.most_tests = 0;
    (void)gough_workspace_envelope(&corners, &d->box, &e, NULL);
    s->aim[GOUGH_AIM_FORCE] = fmax(e.of[GOUGH_WORST_PUSH].sampled, -e.of[GOUGH_WORST_PULL].sampled);
    s->aim[GOUGH_AIM_SPEED] = e.of[GOUGH_WORST_SPEED].sampled;
}

void score_of(const demand *d, const gough_model *model, score *s) {
    const double *weight = d->request->weight;
    gough_reach reach;
    *s = (score){.excess = EXCESS_NO_MODEL, .objective = NAN};
    for (int k = 0; k < GOUGH_AIMS; k++) s->aim[k] = NAN;
    if (!model) return;
    s->excess = EXCESS_SINGULAR_HOME;
    if (reach_of_design(d, model, &reach, NULL)) return;
    reach.asked.least_singular_value = fmax(reach.asked.least_singular_value, d->singular_value);
    find_lengths(d, &reach, s);
    s->excess = fmax(excess_of(d, &reach),
                     telescope_lacks(d->request, s->shortest, s->longest) + DESIGN_SPARE);
    s->aim[GOUGH_AIM_STROKE] = s->longest - s->shortest;
    s->aim[GOUGH_AIM_FOOTPRINT] = footprint_of(model);
    if (weight[GOUGH_AIM_FORCE] > 0 || weight[GOUGH_AIM_SPEED] > 0) find_forces(d, &reach, s);
    s->objective = 0;
    for (int k = 0; k < GOUGH_AIMS; k++)
        if (weight[k] > 0) s->objective += weight[k] * s->aim[k] / d->unit[k];
}
