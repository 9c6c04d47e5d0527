/* The volume of the positions at one orientation, (space-17): gough_workspace_volume(). Bounds by splitting a box about all of
 * them; the value, where lengths are all that limits it, from vertical lines, which meet the limits in closed form. */
#define NUMBER_DOUBLE
#include <string.h>

#include "workspace/certify.h"
#include "workspace/stiff.h"

/* lines across each side of the box; the depth at which cells are first left undecided, and by how much it grows; cells of
 * lengths alone for each box that a search may test, and boxes for each cell otherwise */
enum { LINES = 801, FIRST_DEPTH = 9, DEEPER = 3, DEEPEST = 45, CELLS = 5, PIECES = 2 * LEGS + 2 };
static const double GAP = 0.2;

typedef struct cells {
    space *s;
    const double *orientation;
    int depth;
    bool exact; /* the value comes from lines */
    double inside, undecided, likely;
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
    if (j.verdict == GOUGH_OUTSIDE) return;
    if (j.verdict == GOUGH_INSIDE) {
        q->inside += volume;
    } else if (depth >= q->depth) {
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
                        double greatest[3], vector centre[LEGS]) {
    const gough_limits *l = &s->reach->limits;
    double pose[GOUGH_COMPONENTS] = {0, 0, 0, orientation[0], orientation[1], orientation[2]};
    gough_box one;
    box_view view;
    bool about = true, bounded = true;
    memcpy(one.least, pose, sizeof pose), memcpy(one.greatest, pose, sizeof pose);
    box_view_of(s, &one, &view);
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

/* ---- lines ---- */

typedef struct pieces {
    int count;
    double end[PIECES][2];
} pieces;

/* keeps what lies between two heights, or with `out` what does not */
static void cut(pieces *p, double low, double high, bool out) {
    pieces kept = {.count = 0};
    for (int i = 0; i < p->count; i++) {
        const double part[2][2] = {{out ? p->end[i][0] : fmax(p->end[i][0], low),
                                    out ? fmin(p->end[i][1], low) : fmin(p->end[i][1], high)},
                                   {fmax(p->end[i][0], high), p->end[i][1]}};
        for (int k = 0; k < (out ? 2 : 1); k++) {
            if (!(part[k][0] < part[k][1]) || kept.count == PIECES) continue;
            memcpy(kept.end[kept.count++], part[k], sizeof part[k]);
        }
    }
    *p = kept;
}

/* (space-17): heights of one line at which all legs keep their lengths */
static pieces allowed_on(const space *s, const vector centre[LEGS], double x, double y, double low,
                         double high) {
    pieces p = {1, {{low, high}}};
    for (int v = 0; v < LEGS; v++) {
        const double *limit = s->reach->limits.length[v], dx = x - centre[v].x,
                     dy = y - centre[v].y, square = dx * dx + dy * dy;
        const double outer = limit[1] * limit[1] - square, inner = limit[0] * limit[0] - square;
        if (!(outer > 0)) return (pieces){.count = 0};
        cut(&p, centre[v].z - sqrt(outer), centre[v].z + sqrt(outer), false);
        if (inner > 0) cut(&p, centre[v].z - sqrt(inner), centre[v].z + sqrt(inner), true);
    }
    return p;
}

/* the determinant at a pose times the lengths of the legs, positive on the side of home */
static double side_of(const space *s, const double pose[GOUGH_COMPONENTS]) {
    gough_box one;
    box_view view;
    memcpy(one.least, pose, sizeof one.least), memcpy(one.greatest, pose, sizeof one.greatest);
    box_view_of(s, &one, &view);
    double value = legs_determinant(&s->h, &view.x, &view.g).determinant * s->reach->side;
    for (int v = 0; v < LEGS; v++) value *= view.g.length[v];
    return value;
}

/* a cubic on [−1, 1] by its values at −1, −1/3, 1/3, 1 */
static void cubic_through(const double f[4], double c[4]) {
    const double even = f[0] + f[3], odd = f[3] - f[0], inner = f[1] + f[2], slope = f[2] - f[1];
    c[0] = (9 * inner - even) / 16;
    c[1] = (27 * slope - odd) / 16;
    c[2] = 9 * (even - inner) / 16;
    c[3] = 9 * (odd - 3 * slope) / 16;
}

static double cubic_at(const double c[4], double x) {
    return ((c[3] * x + c[2]) * x + c[1]) * x + c[0];
}

/* how much of an interval in which a cubic rises or falls throughout is above 0 */
static double above_zero(const double c[4], double low, double high) {
    const bool starts = cubic_at(c, low) > 0, ends = cubic_at(c, high) > 0;
    double one = low, two = high;
    if (starts == ends) return starts ? high - low : 0;
    for (int n = 0; n < 60; n++) {
        const double middle = 0.5 * (one + two);
        if ((cubic_at(c, middle) > 0) == starts)
            one = middle;
        else
            two = middle;
    }
    return starts ? two - low : high - one;
}

/* (space-17): how much of a piece of a line is on the side of home: the determinant times the lengths is a cubic of the height */
static double on_home_side(const space *s, double pose[GOUGH_COMPONENTS], const double end[2]) {
    const double middle = 0.5 * (end[0] + end[1]), half = 0.5 * (end[1] - end[0]);
    double f[4], c[4], turn[4] = {-1, -1, -1, 1}, sum = 0;
    for (int n = 0; n < 4; n++) {
        pose[2] = middle + half * (2.0 * n / 3 - 1);
        f[n] = side_of(s, pose);
    }
    cubic_through(f, c);
    /* between the ends and where it turns it rises or falls */
    const double under = c[2] * c[2] - 3 * c[1] * c[3];
    if (under > 0) {
        const double q = -(c[2] + copysign(sqrt(under), c[2]));
        const double one = q / (3 * c[3]), two = c[1] / q;
        turn[1] = fmin(fmax(fmin(one, two), -1), 1);
        turn[2] = fmin(fmax(fmax(one, two), -1), 1);
    }
    for (int n = 0; n < 3; n++) {
        if (turn[n] < turn[n + 1]) sum += above_zero(c, turn[n], turn[n + 1]);
    }
    return sum * half;
}

static double volume_of_lines(const space *s, const double orientation[3], const double least[3],
                              const double greatest[3], const vector centre[LEGS]) {
    const double dx = (greatest[0] - least[0]) / LINES, dy = (greatest[1] - least[1]) / LINES;
    double sum = 0;
    for (int i = 0; i < LINES; i++) {
        double row = 0;
        for (int k = 0; k < LINES; k++) {
            const double x = least[0] + (i + 0.5) * dx, y = least[1] + (k + 0.5) * dy;
            const pieces p = allowed_on(s, centre, x, y, least[2], greatest[2]);
            for (int n = 0; n < p.count; n++) {
                double pose[GOUGH_COMPONENTS] = {
                    x, y, 0, orientation[0], orientation[1], orientation[2]};
                row += on_home_side(s, pose, p.end[n]);
            }
        }
        sum += row;
    }
    return sum * dx * dy;
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
    space s;
    cells q = {.orientation = orientation};
    if (!isfinite(orientation[0] + orientation[1] + orientation[2]))
        return gough_fail(error, GOUGH_ERROR_INPUT, "the angles of an orientation must be finite");
    if (!reach_is_valid(reach)) return reach_refuse(error);
    space_begin(&s, reach);
    s.parts_wanted = true;
    if (!find_extent(&s, orientation, least, greatest, centre))
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
        count_cell(&q, least, greatest, 0);
        if (q.undecided <= GAP * (q.inside + q.undecided)) break;
        if (q.tests - before >= most) break;
    }
    *volume = (gough_volume){.least = q.inside * (1 - 1e-12),
                             .greatest = (q.inside + q.undecided) * (1 + 1e-12),
                             .value = q.inside + q.likely,
                             .exact = q.exact,
                             .tests = q.tests};
    if (volume->exact) volume->value = volume_of_lines(&s, orientation, least, greatest, centre);
    return GOUGH_OK;
}
