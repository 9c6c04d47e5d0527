/* One box of poses against all limits, (space-4) … (space-6). Theory: docs/theory/workspace.md. */
#define NUMBER_DOUBLE
#include "workspace/box_test.h"

#include <string.h>

#include "workspace/ask.h"
#include "workspace/certify.h"
#include "workspace/clearance.h"
#include "workspace/slope_parts.h"

static void test_lengths(const space *s, const box_view *view, judge *j) {
    for (int v = 0; v < LEGS; v++) {
        const double *limit = s->reach->limits.length[v], size = view->g.length[v];
        double bound[2];
        if (!(limit[0] > 0) && !(limit[1] < INFINITY)) continue;
        if (s->parts_wanted) {
            const taylor l = box_length(view, v), few = taylor_less(l, taylor_of(limit[0])),
                         many = taylor_less(taylor_of(limit[1]), l);
            judge_slope(j, &few, 0, 0, size, GOUGH_BIND_SHORTEST, v);
            if (limit[1] < INFINITY) judge_slope(j, &many, 0, 0, size, GOUGH_BIND_LONGEST, v);
            continue;
        }
        box_lengths(view, v, bound);
        judge_whole(j, bound[0] - limit[0], bound[1] - limit[0], size, GOUGH_BIND_SHORTEST, v);
        judge_whole(j, limit[1] - bound[1], limit[1] - bound[0], size, GOUGH_BIND_LONGEST, v);
    }
}

/* the platform's components, of the point that its limits are about */
static void test_pose(const space *s, const box_view *view, judge *j) {
    const gough_limits *l = &s->reach->limits;
    const vector arm = subtract(vector_of(l->about), s->about);
    taylor_vector point = box_shifted(view), turned = box_turned(view, out_of(&view->R, arm));
    const double home[3] = {arm.x, arm.y, arm.z};

    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        double least = view->centre[c] - view->half[c], most = view->centre[c] + view->half[c];
        if (!(l->pose[c][0] > -INFINITY) && !(l->pose[c][1] < INFINITY)) continue;
        if (c < 3) {
            const taylor way = taylor_less(turned.x[c], taylor_of(home[c]));
            const taylor moved = taylor_add(point.x[c], way);
            least = taylor_least(&moved), most = taylor_most(&moved);
        }
        const double size = fmax(fabs(l->pose[c][0]), fabs(l->pose[c][1])),
                     finite = size < INFINITY ? size : 1;
        judge_whole(j, least - l->pose[c][0], most - l->pose[c][0], finite, GOUGH_BIND_POSE, c);
        judge_whole(j, l->pose[c][1] - most, l->pose[c][1] - least, finite, GOUGH_BIND_POSE, c);
    }
}

/* (space-6): the cosine of the angle between two directions against that of its limit */
static void test_angle(const taylor_vector *a, const taylor_vector *b, double most, gough_bind bind,
                       int v, judge *j) {
    const taylor cosine = taylor_dot(a, b);
    const double limit = cos(most);
    const taylor margin = taylor_less(cosine, taylor_of(limit));
    judge_slope(j, &margin, 0, 0, 1 - limit, bind, v);
}

static void test_swing(const space *s, const box_view *view, const taylor_vector n[LEGS],
                       judge *j) {
    const gough_limits *l = &s->reach->limits;
    for (int v = 0; v < LEGS; v++) {
        taylor_vector still, turned;
        box_home_directions(s, view, v, &still, &turned);
        if (l->base_swing[v] < REAL_PI)
            test_angle(&n[v], &still, l->base_swing[v], GOUGH_BIND_BASE_SWING, v, j);
        if (l->top_swing[v] < REAL_PI)
            test_angle(&n[v], &turned, l->top_swing[v], GOUGH_BIND_TOP_SWING, v, j);
    }
}

/* (space-9), (space-10): the sign of the determinant, and the least singular value */
static void test_singular(const space *s, stiff *J, judge *j) {
    const double least = s->reach->asked.least_singular_value;
    const int side = stiff_side(J);
    if (side == 0)
        judge_whole(j, -J->spread, 0, 1, GOUGH_BIND_SINGULAR, 0);
    else if (side != s->reach->side)
        judge_whole(j, -1, -1, 1, GOUGH_BIND_SINGULAR, 0);
    if (!(least > 0)) return;
    if (J->least[0] < least && J->least[1] >= least && J->spread > 0) stiff_refine(J, false);
    judge_whole(j, J->least[0] - least, J->least[1] - least, least, GOUGH_BIND_SINGULAR_VALUE, 0);
}

/* (space-16): distances of legs against their thickness */
static void test_clearance(const space *s, const box_view *view, const taylor_vector n[LEGS],
                           judge *j) {
    const double *diameter = s->reach->limits.diameter;
    for (int v = 0; v < LEGS; v++) {
        for (int w = v + 1; w < LEGS; w++) {
            const double thick = 0.5 * (diameter[v] + diameter[w]);
            double bound[2];
            if (!(thick > 0) || clearance_is_joint(s, v, w)) continue;
            clearance_of(s, view, n, v, w, thick, bound);
            const gough_binding before = j->binding;
            judge_whole(j, bound[0] - thick, bound[1] - thick, thick, GOUGH_BIND_CLEARANCE, v);
            if (memcmp(&before, &j->binding, sizeof before) != 0) j->binding.other = w;
        }
    }
}

/* a limit less a force, which lies between near + least and near + most */
static void judge_force(judge *j, double limit, const over_box *force, double weight,
                        gough_bind bind, int v) {
    const taylor margin = taylor_less(taylor_of(limit), force->near);
    judge_slope(j, &margin, force->above, force->sure, weight, bind, v);
}

/* rates, accelerations and forces of legs for the motions and loads that are asked for */
static void test_asked(const space *s, const box_view *view, const taylor_vector n[LEGS],
                       const stiff *J, judge *j) {
    const gough_limits *l = &s->reach->limits;
    asked_of_leg asked[LEGS];
    asked_of(s, view, n, J, s->parts, asked);
    for (int v = 0; v < LEGS; v++) {
        const asked_of_leg *a = &asked[v];
        const double low = fabs(l->force[v][0]), high = fabs(l->force[v][1]);
        const double weight = low < INFINITY && (low > high || !(high < INFINITY)) ? low : high;
        if (l->speed[v] < INFINITY)
            judge_whole(j, l->speed[v] - a->speed.most, l->speed[v] - a->speed.least, l->speed[v],
                        GOUGH_BIND_SPEED, v);
        if (l->acceleration[v] < INFINITY && s->parts.acceleration)
            judge_whole(j, l->acceleration[v] - a->acceleration.most,
                        l->acceleration[v] - a->acceleration.least, l->acceleration[v],
                        GOUGH_BIND_ACCELERATION, v);
        if (l->force[v][1] < INFINITY)
            judge_force(j, l->force[v][1], &a->push, weight, GOUGH_BIND_PUSH, v);
        if (l->force[v][0] > -INFINITY)
            judge_force(j, -l->force[v][0], &a->pull, weight, GOUGH_BIND_PULL, v);
    }
}

judge box_judge(const space *s, const box_view *view) {
    taylor_vector n[LEGS];
    judge j = judge_begin();
    stiff J;

    /* lengths first: they decide most boxes and cost least */
    test_lengths(s, view, &j);
    test_pose(s, view, &j);
    if (j.verdict == GOUGH_OUTSIDE || (j.verdict != GOUGH_INSIDE && !s->parts_wanted)) return j;
    if (s->regular && s->only_lengths) return j;
    for (int v = 0; v < LEGS; v++) n[v] = box_direction(view, v);
    test_swing(s, view, n, &j);
    test_clearance(s, view, n, &j);
    if (j.verdict == GOUGH_OUTSIDE) return j;
    const bool asked = s->parts.force || s->parts.acceleration || s->speed;
    if (s->regular && !asked && !(s->reach->asked.least_singular_value > 0)) return j;
    stiff_of(s, view, n, &J);
    test_singular(s, &J, &j);
    if (asked && (j.verdict == GOUGH_INSIDE || (s->parts_wanted && stiff_side(&J) != 0)))
        test_asked(s, view, n, &J, &j);
    return j;
}

bool box_is_box(const gough_box *box) {
    bool right = true;
    for (int c = 0; c < GOUGH_COMPONENTS; c++)
        right &= box->least[c] <= box->greatest[c] && isfinite(box->least[c]) &&
                 isfinite(box->greatest[c]);
    return right;
}

gough_verdict gough_box_test(const gough_reach *reach, const gough_box *box,
                             gough_binding *binding) {
    space s;
    box_view view;
    if (binding) *binding = (gough_binding){GOUGH_BIND_NONE, 0, 0};
    if (!box_is_box(box) || !reach_is_valid(reach)) return GOUGH_UNDECIDED;
    space_begin(&s, reach);
    box_view_of(&s, box, &view);
    const judge j = box_judge(&s, &view);
    if (binding) *binding = j.binding;
    return j.verdict;
}

const char *gough_bind_name(gough_bind bind) {
    static const char *const name[GOUGH_BINDS] = {
        "none",     "shortest",       "longest", "base_swing",   "top_swing", "clearance", "pose",
        "singular", "singular_value", "speed",   "acceleration", "push",      "pull"};
    return (unsigned)bind < GOUGH_BINDS ? name[bind] : "unknown";
}
