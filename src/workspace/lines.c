/* The volume of positions between spheres, (space-17): upright lines in closed form, summed over a section and over all sections
 * between the places where either has no derivative. Theory: docs/theory/workspace.md. */
#define NUMBER_DOUBLE
#include "workspace/lines.h"

#include <stdlib.h>
#include <string.h>

/* Points across the whole of a side, and at least between two neighbouring edges; an edge is where a sphere of a leg begins or
 * ends. */
enum {
    POINTS = 640,
    FEWEST = 10,
    EDGES = 4 * LEGS + 2,
    PIECES = 2 * LEGS + 2,
    CUBIC_HALVINGS = 24
};

/* in halves of a piece of a line: how near a root of the cubic that of the determinant is sought first, and to what width */
static const double NEARBY = 1e-5, ROOT = 1e-9;

typedef struct lines {
    const space *s;
    triad R; /* the orientation */
    const hull *allowed, *doubtful;
    const vector *centre;
} lines;

/* ---- one line ---- */

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

/* A piece of an upright line at x and y; heights are counted from −1 to 1 along it. */
typedef struct upright {
    const lines *q;
    double x, y, middle, half;
} upright;

/* the determinant at a height times the lengths of the legs, positive on the side of home */
static double side_of(const upright *line, double height) {
    const space *s = line->q->s;
    const vector at = {line->x, line->y, line->middle + height * line->half};
    const coordinates x = coordinates_of_top(&s->h, s->about, add(s->home, at), &line->q->R);
    legs g;
    legs_at(&s->h, &x, &g);
    double value = legs_determinant(&s->h, &x, &g).determinant * s->reach->side;
    for (int v = 0; v < LEGS; v++) value *= g.length[v];
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

/* Where a cubic that rises or falls throughout an interval crosses 0, by the determinant itself: where the cubic has a threefold
 * root, as that of a machine that is flat there, its coefficients tell the root to few digits only. */
static double crossing(const upright *line, const double c[4], double low, double high,
                       bool starts) {
    double one = low, two = high;
    for (int n = 0; n < CUBIC_HALVINGS; n++) {
        const double middle = 0.5 * (one + two);
        if ((cubic_at(c, middle) > 0) == starts)
            one = middle;
        else
            two = middle;
    }
    double width = NEARBY;
    while (one > low && (side_of(line, one) > 0) != starts)
        one = fmax(low, one - width), width *= 8;
    while (two < high && (side_of(line, two) > 0) == starts)
        two = fmin(high, two + width), width *= 8;
    while (two - one > ROOT) {
        const double middle = 0.5 * (one + two);
        if ((side_of(line, middle) > 0) == starts)
            one = middle;
        else
            two = middle;
    }
    return 0.5 * (one + two);
}

/* how much of an interval in which a cubic rises or falls throughout is above 0 */
static double above_zero(const upright *line, const double c[4], double low, double high) {
    const bool starts = side_of(line, low) > 0, ends = side_of(line, high) > 0;
    if (starts == ends) return starts ? high - low : 0;
    const double root = crossing(line, c, low, high, starts);
    return starts ? root - low : high - root;
}

/* (space-17): how much of a piece of a line is on the side of home: the determinant times the lengths is a cubic of the height */
static double on_home_side(const upright *line) {
    double f[4], c[4], turn[4] = {-1, -1, -1, 1}, sum = 0;
    for (int n = 0; n < 4; n++) f[n] = side_of(line, 2.0 * n / 3 - 1);
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
        if (turn[n] < turn[n + 1]) sum += above_zero(line, c, turn[n], turn[n + 1]);
    }
    return sum * line->half;
}

/* ---- sums over lines ---- */

/* Places within the ends of a side, in order: the first and last are the ends. */
typedef struct edges {
    int count;
    double at[EDGES];
} edges;

static edges edges_begin(double least, double greatest) { return (edges){2, {least, greatest}}; }

static void edges_add(edges *e, double at) {
    if (at > e->at[0] && at < e->at[1]) e->at[e->count++] = at;
}

static int by_size(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* of the n-th of `count` steps of the variable t from −1 to 1: x = (15 t − 10 t³ + 3 t⁵)/8, whose first two derivatives vanish at
 * both ends, and its derivative. The midpoint rule in t then sums roots at the ends as well as it sums what is smooth. */
static double place_of(int n, int count, double *slope) {
    const double t = (2.0 * n + 1) / count - 1, rest = 1 - t * t;
    *slope = 15.0 / 8 * rest * rest;
    return t * (15 - t * t * (10 - 3 * t * t)) / 8;
}

static double sum_between(const lines *q, double (*value)(const lines *q, double x, double at),
                          double x, edges *e) {
    const double whole = e->at[1] - e->at[0];
    double sum = 0;
    qsort(e->at, (size_t)e->count, sizeof *e->at, by_size);
    for (int i = 0; i + 1 < e->count; i++) {
        const double middle = 0.5 * (e->at[i] + e->at[i + 1]),
                     half = 0.5 * (e->at[i + 1] - e->at[i]);
        const int count = FEWEST + (int)(2 * half / whole * POINTS);
        double part = 0;
        for (int n = 0; n < count && half > 0; n++) {
            double slope;
            const double place = place_of(n, count, &slope);
            part += slope * value(q, x, middle + half * place);
        }
        sum += part * 2 * half / count;
    }
    return sum;
}

/* whether singular poses, or those beyond them, may be on a piece of a line */
static bool is_doubtful(const lines *q, double x, double y, const double end[2]) {
    const hull *d = q->doubtful;
    return x >= d->least[0] && x <= d->greatest[0] && y >= d->least[1] && y <= d->greatest[1] &&
           end[1] >= d->least[2] && end[0] <= d->greatest[2];
}

/* how much of a line is allowed */
static double line_at(const lines *q, double x, double y) {
    const pieces p =
        allowed_on(q->s, q->centre, x, y, q->allowed->least[2], q->allowed->greatest[2]);
    double sum = 0;
    for (int n = 0; n < p.count; n++) {
        const double *end = p.end[n];
        const upright line = {q, x, y, 0.5 * (end[0] + end[1]), 0.5 * (end[1] - end[0])};
        sum += is_doubtful(q, x, y, end) ? on_home_side(&line) : end[1] - end[0];
    }
    return sum;
}

/* the area of a section: lines begin and end like roots where they touch a sphere */
static double section_at(const lines *q, double unused, double x) {
    edges e = edges_begin(q->allowed->least[1], q->allowed->greatest[1]);
    (void)unused;
    for (int v = 0; v < LEGS; v++) {
        for (int k = 0; k < 2; k++) {
            const double limit = q->s->reach->limits.length[v][k], dx = x - q->centre[v].x,
                         square = limit * limit - dx * dx;
            if (!(square > 0) || !(square < INFINITY)) continue;
            edges_add(&e, q->centre[v].y - sqrt(square));
            edges_add(&e, q->centre[v].y + sqrt(square));
        }
    }
    return sum_between(q, line_at, x, &e);
}

double lines_volume(const space *s, const triad *R, const hull *allowed, const hull *doubtful,
                    const vector centre[LEGS]) {
    const lines q = {s, *R, allowed, doubtful, centre};
    if (!(allowed->least[0] < allowed->greatest[0])) return 0;
    edges e = edges_begin(allowed->least[0], allowed->greatest[0]);
    for (int v = 0; v < LEGS; v++) {
        for (int k = 0; k < 2; k++) {
            const double limit = s->reach->limits.length[v][k];
            edges_add(&e, centre[v].x - limit);
            edges_add(&e, centre[v].x + limit);
        }
    }
    return sum_between(&q, section_at, 0, &e);
}
