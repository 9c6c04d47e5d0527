/* The volume of the positions at one orientation, (space-17): gough_workspace_volume(). Bounds by splitting a box about all of
 * them; the value, where lengths are all that limits it, from upright lines. */
#define NUMBER_DOUBLE
#include <string.h>

#include "workspace/certify.h"
#include "workspace/lines.h"
#include "workspace/stiff.h"

/* the depth at which cells are first left undecided, and by how much it grows; cells of
 * lengths alone for each box that a search may test, and boxes for each cell otherwise */
enum { FIRST_DEPTH = 9, DEEPER = 3, DEEPEST = 45, CELLS = 5 };
static const double GAP = 0.2;

typedef struct cells {
    space *s;
    const double *orientation;
    int depth;
    bool exact; /* the value comes from lines */
    double inside, undecided, likely;
    hull allowed,
        doubtful; /* of the cells that are not outside; of those that may have poses on the other side */
    size_t tests;
} cells;

/* ---- bounds ---- */

/* whether no pose of a cell is singular, and all are on the side of home */
static bool is_regular(const space *s, const box_view *view) {
    taylor_vector n[LEGS];
    stiff J;
    for (int v = 0; v < LEGS; v++) n[v] = box_direction(view, v);
    stiff_of(s, view, n, &J);
    return stiff_side(&J) == s->reach->side;
}

static void count_cell(cells *q, const double least[3], const double greatest[3], int depth);

/* both halves across the longest side */
static void count_halves(cells *q, const double least[3], const double greatest[3], int depth,
                         const box_view *view) {
    const bool before = q->s->regular;
    double low[3], high[3];
    int side = 0;
    for (int c = 1; c < 3; c++)
        if (view->half[c] > view->half[side]) side = c;
    memcpy(low, least, sizeof low), memcpy(high, greatest, sizeof high);
    low[side] = high[side] = view->centre[side];
    /* what holds of a cell holds of its parts, which need not be asked again */
    q->s->regular = before || is_regular(q->s, view);
    count_cell(q, least, high, depth + 1);
    count_cell(q, low, greatest, depth + 1);
    q->s->regular = before;
}

static const hull NOWHERE = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

static void widen(hull *h, const double least[3], const double greatest[3]) {
    for (int c = 0; c < 3; c++) {
        h->least[c] = fmin(h->least[c], least[c]);
        h->greatest[c] = fmax(h->greatest[c], greatest[c]);
    }
}

/* A cell with the fixed orientation. */
static void count_cell(cells *q, const double least[3], const double greatest[3], int depth) {
    double volume = 1;
    gough_box box;
    box_view view;
    for (int c = 0; c < 3; c++) {
        box.least[c] = least[c], box.greatest[c] = greatest[c];
        box.least[3 + c] = box.greatest[3 + c] = q->orientation[c];
        volume *= greatest[c] - least[c];
    }
    box_view_of(q->s, &box, &view);
    const judge j = box_judge(q->s, &view);
    q->tests++;
    if (j.verdict == GOUGH_OUTSIDE) {
        if (j.binding.bind == GOUGH_BIND_SINGULAR) widen(&q->doubtful, least, greatest);
        return;
    }
    if (j.verdict == GOUGH_INSIDE) {
        widen(&q->allowed, least, greatest);
        q->inside += volume;
    } else if (depth >= q->depth) {
        widen(&q->allowed, least, greatest);
        if (!q->s->regular) widen(&q->doubtful, least, greatest);
        const double in = fmax(0, j.in), left = fmax(0, 1 - in - j.out);
        q->inside += in * volume;
        q->undecided += left * volume;
        volume *= left;
        if (!q->exact && pose_judge(q->s, view.centre).verdict == GOUGH_INSIDE) q->likely += volume;
    } else {
        count_halves(q, least, greatest, depth, &view);
    }
}

/* A box about all positions: each leg keeps the point in a ball. */
static bool find_extent(const space *s, const double orientation[3], double least[3],
                        double greatest[3], vector centre[LEGS], triad *R) {
    const gough_limits *l = &s->reach->limits;
    double pose[GOUGH_COMPONENTS] = {0, 0, 0, orientation[0], orientation[1], orientation[2]};
    gough_box one;
    box_view view;
    bool about = true, bounded = true;
    memcpy(one.least, pose, sizeof pose), memcpy(one.greatest, pose, sizeof pose);
    box_view_of(s, &one, &view);
    *R = view.R;
    for (int k = 0; k < 3; k++) {
        about &= fabs(s->reach->about[k] - l->about[k]) <= 0;
        least[k] = -INFINITY, greatest[k] = INFINITY;
    }
    for (int v = 0; v < LEGS; v++) {
        /* q = p + d + arm: the centre of the balls of d */
        centre[v] = subtract(subtract(s->h.base[v], s->home), view.arm[v]);
        const double at[3] = {centre[v].x, centre[v].y, centre[v].z};
        for (int k = 0; k < 3; k++) {
            least[k] = fmax(least[k], at[k] - l->length[v][1]);
            greatest[k] = fmin(greatest[k], at[k] + l->length[v][1]);
        }
    }
    for (int k = 0; k < 3; k++) {
        if (about) {
            least[k] = fmax(least[k], l->pose[k][0]);
            greatest[k] = fmin(greatest[k], l->pose[k][1]);
        }
        bounded &= isfinite(least[k]) && isfinite(greatest[k]);
        greatest[k] = fmax(greatest[k], least[k]);
    }
    return bounded;
}

/* ---- together ---- */

static bool is_lengths_only(const space *s) {
    const gough_limits *l = &s->reach->limits;
    bool only = s->only_lengths;
    for (int c = 0; c < GOUGH_COMPONENTS; c++)
        only &= !(l->pose[c][0] > -INFINITY) && !(l->pose[c][1] < INFINITY);
    return only;
}

gough_status gough_workspace_volume(const gough_reach *reach, const double orientation[3],
                                    gough_volume *volume, gough_error *error) {
    double least[3], greatest[3];
    vector centre[LEGS];
    triad R;
    space s;
    cells q = {.orientation = orientation};
    if (!isfinite(orientation[0] + orientation[1] + orientation[2]))
        return gough_fail(error, GOUGH_ERROR_INPUT, "the angles of an orientation must be finite");
    if (!reach_is_valid(reach)) return reach_refuse(error);
    space_begin(&s, reach);
    s.parts_wanted = true;
    if (!find_extent(&s, orientation, least, greatest, centre, &R))
        return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                          "no limit bounds the positions, so they have no volume: give "
                          "platform.legs.length or platform.legs.stroke");
    const size_t most = s.only_lengths  ? CELLS * reach->most_tests
                        : s.parts.force ? reach->most_tests / CELLS
                                        : reach->most_tests;
    q.s = &s, q.exact = is_lengths_only(&s);
    for (q.depth = FIRST_DEPTH; q.depth <= DEEPEST; q.depth += DEEPER) {
        const size_t before = q.tests;
        q.inside = q.undecided = q.likely = 0;
        q.allowed = q.doubtful = NOWHERE;
        count_cell(&q, least, greatest, 0);
        if (q.undecided <= GAP * (q.inside + q.undecided)) break;
        if (q.tests - before >= most) break;
    }
    *volume = (gough_volume){.least = q.inside * (1 - 1e-12),
                             .greatest = (q.inside + q.undecided) * (1 + 1e-12),
                             .value = q.inside + q.likely,
                             .exact = q.exact,
                             .tests = q.tests};
    if (volume->exact) volume->value = lines_volume(&s, &R, &q.allowed, &q.doubtful, centre);
    return GOUGH_OK;
}
