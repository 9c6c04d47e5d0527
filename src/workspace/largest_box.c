/* The largest box of a shape, (space-8): gough_workspace_box(). From above by poses that are not allowed, from below by
 * certificates. */
#define NUMBER_DOUBLE
#include <string.h>

#include "workspace/certify.h"

/* the part by which the two bounds may differ; the first box tried is smaller than the upper bound by half of it */
static const double GAP = 1e-4;
/* poses tried along a ray before the halving begins, halvings, doublings of the shape, boxes certified at most */
enum { ALONG_RAY = 16, HALVINGS = 40, DOUBLINGS = 12, CERTIFICATES = 40, SHARE = 2 };

typedef struct search {
    const space *s;
    const gough_box *shape;
    gough_largest_box *best;
    size_t left; /* boxes that may still be tested */
} search;

/* a pose of the shape: side −1, 0 or 1 of each component, times a scale */
static void pose_on_ray(const gough_box *shape, const int side[GOUGH_COMPONENTS], double scale,
                        double pose[GOUGH_COMPONENTS]) {
    for (int c = 0; c < GOUGH_COMPONENTS; c++)
        pose[c] = side[c] < 0   ? scale * shape->least[c]
                  : side[c] > 0 ? scale * shape->greatest[c]
                                : 0;
}

static gough_box scaled(const gough_box *shape, double scale) {
    gough_box box;
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        /* no −0 */
        box.least[c] = scale * shape->least[c] + 0.0;
        box.greatest[c] = scale * shape->greatest[c] + 0.0;
    }
    return box;
}

/* the scale of the smallest box of the shape that contains a pose */
static double scale_of(const gough_box *shape, const double pose[GOUGH_COMPONENTS]) {
    double scale = 0;
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        if (pose[c] > 0) scale = fmax(scale, pose[c] / shape->greatest[c]);
        if (pose[c] < 0) scale = fmax(scale, pose[c] / shape->least[c]);
    }
    return scale;
}

/* Whether a pose is not allowed; if so, it bounds the scale. */
static bool try_pose(search *q, const double pose[GOUGH_COMPONENTS]) {
    const judge j = pose_judge(q->s, pose);
    const double scale = scale_of(q->shape, pose);
    q->best->tests++;
    if (j.verdict != GOUGH_OUTSIDE) return false;
    if (scale < q->best->upper) {
        q->best->upper = scale;
        q->best->binding = j.binding;
        memcpy(q->best->pose, pose, sizeof q->best->pose);
    }
    return true;
}

/* the first pose that is not allowed between two of a line, one allowed and one not, by halving */
static void halve(search *q, const double allowed[GOUGH_COMPONENTS],
                  const double outside[GOUGH_COMPONENTS]) {
    double in = 0, out = 1;
    for (int i = 0; i < HALVINGS; i++) {
        const double middle = 0.5 * (in + out);
        double pose[GOUGH_COMPONENTS];
        for (int c = 0; c < GOUGH_COMPONENTS; c++)
            pose[c] = allowed[c] + middle * (outside[c] - allowed[c]);
        if (try_pose(q, pose))
            out = middle;
        else
            in = middle;
    }
}

/* the ray from home on which the components have these sides, up to a scale */
static void try_ray(search *q, const int side[GOUGH_COMPONENTS], double scale) {
    double last[GOUGH_COMPONENTS] = {0, 0, 0, 0, 0, 0}, pose[GOUGH_COMPONENTS];
    for (int i = 1; i <= ALONG_RAY; i++) {
        const double at = scale * i / ALONG_RAY;
        if (at >= q->best->upper * (1 + 1.0 / ALONG_RAY)) return;
        pose_on_ray(q->shape, side, at, pose);
        if (try_pose(q, pose)) {
            halve(q, last, pose);
            return;
        }
        memcpy(last, pose, sizeof last);
    }
}

/* rays to the middles of all sides, edges … and to the corners: 3^6 − 1 of them */
static void try_rays(search *q, double scale) {
    int side[GOUGH_COMPONENTS];
    for (int ray = 1; ray < 729; ray++) {
        bool moves = true;
        for (int c = 0, rest = ray; c < GOUGH_COMPONENTS; c++, rest /= 3) {
            side[c] = rest % 3 == 2 ? -1 : rest % 3;
            if (side[c] < 0) moves &= q->shape->least[c] < 0;
            if (side[c] > 0) moves &= q->shape->greatest[c] > 0;
        }
        if (moves) try_ray(q, side, scale);
    }
}

/* the largest scale whose angles are within half a turn */
static double greatest_scale(const gough_box *shape) {
    double scale = ldexp(1, DOUBLINGS);
    for (int c = GOUGH_ROLL; c < GOUGH_COMPONENTS; c++) {
        /* an angle of 0 limits no scale; of −0 and 0, fmax() may return either, and π/−0 is below every scale */
        const double turn = fmax(-shape->least[c], shape->greatest[c]);
        if (turn > 0) scale = fmin(scale, REAL_PI / turn);
    }
    return scale;
}

/* one box certified; false: neither bound has moved */
static bool try_box(search *q, double scale) {
    const gough_box box = scaled(q->shape, scale);
    const gough_certificate found = box_certify(q->s, &box, q->left / SHARE + 1);
    q->best->tests += found.tests;
    q->left -= found.tests < q->left ? found.tests : q->left;
    if (found.verdict == GOUGH_INSIDE) {
        q->best->scale = scale;
        return true;
    }
    if (found.verdict == GOUGH_UNDECIDED) return false;
    const double before[GOUGH_COMPONENTS] = {0, 0, 0, 0, 0, 0};
    const double upper = q->best->upper;
    (void)try_pose(q, found.pose);
    halve(q, before, found.pose);
    return q->best->upper < upper;
}

static void narrow(search *q, double greatest) {
    gough_largest_box *best = q->best;
    double refused = INFINITY;
    for (int i = 0; i < CERTIFICATES; i++) {
        const double top = fmin(fmin(best->upper, greatest), refused);
        if (best->scale >= top * (1 - GAP) || q->left < 100) return;
        /* the rays have mostly found the true bound: just below it first, by halving only if that failed */
        const double scale = refused < INFINITY ? 0.5 * (best->scale + top) : top * (1 - 0.5 * GAP);
        if (!try_box(q, scale)) refused = scale;
    }
}

static gough_status check_shape(const gough_box *shape, gough_error *error) {
    bool home = box_is_box(shape), moves = false;
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        home &= shape->least[c] <= 0 && shape->greatest[c] >= 0;
        moves |= shape->least[c] < 0 || shape->greatest[c] > 0;
    }
    if (!home)
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "the shape of a box must be finite and contain home: each least value at "
                          "most 0, each greatest at least 0");
    if (!moves)
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "the shape of a box must have an extent: all its values are 0");
    return GOUGH_OK;
}

gough_status gough_workspace_box(const gough_reach *reach, const gough_box *shape,
                                 gough_largest_box *largest, gough_error *error) {
    const double home[GOUGH_COMPONENTS] = {0, 0, 0, 0, 0, 0};
    space s;
    const gough_status status = check_shape(shape, error);
    if (status) return status;
    if (!reach_is_valid(reach)) return reach_refuse(error);
    space_begin(&s, reach);
    *largest = (gough_largest_box){.upper = INFINITY, .tests = 1};
    search q = {&s, shape, largest, reach->most_tests / 2};
    const judge at_home = pose_judge(&s, home);
    if (at_home.verdict == GOUGH_OUTSIDE) return reach_home_outside(&at_home.binding, error);
    const double greatest = greatest_scale(shape);
    for (double scale = fmin(1, greatest); !(largest->upper < INFINITY);) {
        try_rays(&q, scale);
        if (scale >= greatest) break;
        scale = fmin(2 * scale, greatest);
    }
    narrow(&q, greatest);
    largest->box = scaled(shape, largest->scale);
    return GOUGH_OK;
}
