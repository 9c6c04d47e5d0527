/* (space-9), (space-10): the Jacobian over a box. Theory: docs/theory/workspace.md. */
#define NUMBER_DOUBLE
#include "workspace/stiff.h"

#include <string.h>

#include "base/limits.h"

/* roundings of the products of a row and of its singular values, relative to the greatest */
static const double MATRIX_ROUNDED = 256 * DBL_EPSILON;

/* unit vectors that stand for all of a plane; the part of a distance between two rows that must be certain for them to be far from
 * each other */
enum { ANGLES = 32 };
static const double FAR = 0.5;

/* (legs-5): a row is the leg's direction and its moment about the top frame's origin */
static void fill_rows(const space *s, const box_view *view, const taylor_vector n[LEGS], stiff *J) {
    const double inverse = 1 / s->h.reach;
    for (int v = 0; v < LEGS; v++) {
        const taylor_vector arm = box_turned(view, out_of(&view->x.q, s->h.top[v]));
        const taylor_vector moment = taylor_cross(&arm, &n[v]);
        for (int i = 0; i < 3; i++) {
            J->row[v][i] = n[v].x[i];
            J->row[v][3 + i] = taylor_scale(inverse, moment.x[i]);
        }
    }
}

/* inverse and determinant at the centre */
static void invert_centre(stiff *J) {
    double a[6][6], unit[6][6];
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++) a[i][j] = J->row[i][j].c, unit[i][j] = i == j;
    const elimination e = solve_six(a, unit, 6);
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++) J->inverse[i][j] = unit[j][i];
    J->sign = (e.determinant > 0) - (e.determinant < 0);
}

/* |J_c⁻¹ J − 1| in place (i, j), with rounding */
static double deviation(const stiff *J, int i, int j) {
    double c = 0, g[SIDES] = {0}, h[CURVES] = {0}, rest = 0, size = 0, sum;
    for (int m = 0; m < 6; m++) {
        const double y = J->inverse[i][m];
        const taylor *a = &J->row[m][j];
        c += y * a->c, size += fabs(y * a->c), rest += fabs(y) * a->r;
        for (int k = 0; k < SIDES && a->varies; k++) g[k] += y * a->g[k];
        for (int k = 0; k < CURVES && a->varies; k++) h[k] += y * a->h[k];
    }
    sum = fabs(c - (i == j)) + rest;
    for (int k = 0; k < SIDES; k++) sum += fabs(g[k]);
    for (int k = 0; k < CURVES; k++) sum += fabs(h[k]);
    return sum * (1 + MATRIX_ROUNDED) + MATRIX_ROUNDED * size;
}

/* (space-9): ‖J_c⁻¹ J − 1‖ in the maximum norm and in Frobenius' */
static double find_spread(stiff *J) {
    double square = 0;
    J->spread = 0;
    for (int i = 0; i < 6; i++) {
        double sum = 0;
        for (int j = 0; j < 6; j++) {
            const double x = deviation(J, i, j);
            sum += x, square += x * x;
        }
        J->spread = bound_of(J->spread, sum);
    }
    return sqrt(square) * (1 + MATRIX_ROUNDED);
}

/* (space-10): singular values move by no more than the norm of what is added, the least also by no more than its share */
static void bound_values(stiff *J, double part) {
    /* the rotations of the columns leave J_c V in place of J_c */
    double(*a)[6] = J->column, square = 0, most, least;
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++) {
            const double wide = taylor_spread(&J->row[i][j]);
            a[i][j] = J->row[i][j].c, square += wide * wide;
        }
    singular_values(a, &most, &least);
    const double way = sqrt(square) * (1 + MATRIX_ROUNDED), rounding = MATRIX_ROUNDED * most;
    J->least[0] = fmax(0, fmax(least - way, least * (1 - part)) - rounding);
    J->least[1] = least + way + rounding;
    J->most[0] = fmax(0, most - way - rounding), J->most[1] = most + way + rounding;
    J->condition = J->least[0] > 0 ? J->most[1] / J->least[0] * (1 + ROUNDED) : INFINITY;
    if (!(most < greatest_condition * least)) J->sign = 0;
}

/* ---- (space-19) ---- */

/* J_c V = U S: the columns of both turns, and the singular values */
typedef struct turns {
    double U[6][6], V[6][6], value[6];
    double off; /* ‖U‖‖V‖ is at most 1 + off, its inverse at least 1 − off */
} turns;

/* how far TᵀT is from 1 */
static double off_one(double T[6][6]) {
    double off = 0;
    for (int i = 0; i < 6; i++) {
        double sum = MATRIX_ROUNDED;
        for (int j = 0; j < 6; j++) {
            double dot = i == j ? -1 : 0;
            for (int m = 0; m < 6; m++) dot += T[m][i] * T[m][j];
            sum += fabs(dot);
        }
        off = bound_of(off, sum);
    }
    return off;
}

static void find_turns(const stiff *J, turns *t) {
    for (int j = 0; j < 6; j++) {
        double square = 0;
        for (int v = 0; v < 6; v++) square += J->column[v][j] * J->column[v][j];
        t->value[j] = sqrt(square);
        for (int i = 0; i < 6; i++) {
            t->U[i][j] = J->column[i][j] / t->value[j], t->V[i][j] = 0;
            for (int m = 0; m < 6; m++) t->V[i][j] += J->inverse[i][m] * J->column[m][j];
        }
    }
    t->off = off_one(t->U) + off_one(t->V);
}

/* UᵀJV, rows and columns from the greatest singular value to the least */
static void turned(const stiff *J, const turns *t, taylor A[6][6]) {
    int order[6];
    for (int j = 0; j < 6; j++) {
        int place = j;
        for (; place > 0 && t->value[order[place - 1]] < t->value[j]; place--)
            order[place] = order[place - 1];
        order[place] = j;
    }
    for (int j = 0; j < 6; j++) {
        taylor right[6];
        for (int v = 0; v < 6; v++) {
            right[v] = taylor_of(0);
            for (int m = 0; m < 6; m++)
                right[v] = taylor_add(right[v], taylor_scale(t->V[m][order[j]], J->row[v][m]));
        }
        for (int i = 0; i < 6; i++) {
            A[i][j] = taylor_of(0);
            for (int m = 0; m < 6; m++)
                A[i][j] = taylor_add(A[i][j], taylor_scale(t->U[m][order[i]], right[m]));
        }
    }
}

/* AᵀA */
static void squared(taylor A[6][6], taylor M[6][6]) {
    for (int i = 0; i < 6; i++) {
        for (int j = 0; j <= i; j++) {
            taylor sum = taylor_times(A[0][i], A[0][j]);
            for (int m = 1; m < 6; m++) sum = taylor_add(sum, taylor_times(A[m][i], A[m][j]));
            M[i][j] = M[j][i] = sum;
        }
    }
}

/* The eigenvalue of M at one end of their order, the least (sign 1) or the greatest (sign −1): numbers with this sign, the least of
 * which is no greater than the eigenvalue with this sign. */
typedef struct edge {
    int forms;
    taylor form[ANGLES];
} edge;

/* Row k of a symmetric matrix eliminated from the rows before it; false where the pivot less the end may be 0. */
static bool eliminate(taylor T[6][6], int k, double end, double certain) {
    const taylor pivot = taylor_add(T[k][k], taylor_of(-end));
    if (!(taylor_least(&pivot) > certain * pivot.c)) return false;
    const taylor share = taylor_inverse(pivot);
    for (int i = 0; i < k; i++) {
        const taylor part = taylor_times(T[k][i], share);
        for (int j = 0; j <= i; j++) T[i][j] = taylor_less(T[i][j], taylor_times(part, T[k][j]));
    }
    return true;
}

/* yᵀT y for unit vectors of a plane at equal angles; between two of them the least one is lower by as much as a circle exceeds a
 * polygon about it */
static void find_forms(taylor T[6][6], edge *e) {
    const taylor half = taylor_scale(0.5, T[0][0]), other = taylor_scale(0.5, T[1][1]),
                 mean = taylor_add(half, other), difference = taylor_less(half, other);
    const double more = 1 / cos(REAL_PI / ANGLES) * (1 + ROUNDED);
    for (int i = 0; i < ANGLES; i++) {
        const double angle = 2 * REAL_PI * i / ANGLES;
        const taylor turned = taylor_add(taylor_scale(more * cos(angle), difference),
                                         taylor_scale(more * sin(angle), T[1][0]));
        e->form[i] = taylor_add(mean, turned);
    }
    e->forms = ANGLES;
}

/* (space-19): rows are eliminated, the farthest from the end first. The last but one only where it is far from the last: else both
 * stay together. False where the rows are not certain to lie beyond the end. */
static bool find_edge(taylor M[6][6], double sign, edge *e) {
    taylor T[6][6];
    for (int i = 0; i < 6; i++)
        for (int j = 0; j <= i; j++)
            T[i][j] = taylor_scale(sign, sign > 0 ? M[5 - i][5 - j] : M[i][j]);
    const double end = T[0][0].c;
    for (int k = 5; k > 1; k--)
        if (!eliminate(T, k, end, 0)) return false;
    if (eliminate(T, 1, end, FAR))
        e->form[0] = T[0][0], e->forms = 1;
    else
        find_forms(T, e);
    return true;
}

/* The least number of the forms, with what UᵀU and VᵀV are off. */
static double least_of(const edge *e) {
    double least = INFINITY;
    for (int i = 0; i < e->forms; i++) least = fmin(least, taylor_least(&e->form[i]));
    return least;
}

/* the square of the condition: each of the one end over each of the other */
static double greatest_ratio(const edge *low, const edge *high) {
    double most = 0;
    for (int i = 0; i < low->forms; i++) {
        const taylor share = taylor_inverse(low->form[i]);
        for (int j = 0; j < high->forms; j++) {
            const taylor ratio = taylor_times(taylor_scale(-1, high->form[j]), share);
            most = bound_of(most, taylor_most(&ratio));
        }
    }
    return most;
}

void stiff_refine(stiff *J, bool both) {
    turns t;
    taylor A[6][6], M[6][6];
    edge low, high;
    find_turns(J, &t);
    if (!(t.off < 0.5)) return;
    turned(J, &t, A);
    squared(A, M);
    if (!find_edge(M, 1, &low)) return;
    J->least[0] = fmax(J->least[0], sqrt(fmax(0, least_of(&low))) * (1 - t.off) * (1 - ROUNDED));
    if (!both || !find_edge(M, -1, &high)) return;
    J->most[1] = fmin(J->most[1], sqrt(fmax(0, -least_of(&high))) * (1 + 2 * t.off));
    J->condition = fmin(J->condition, sqrt(greatest_ratio(&low, &high)) * (1 + 4 * t.off));
}

void stiff_of(const space *s, const box_view *view, const taylor_vector n[LEGS], stiff *J) {
    fill_rows(s, view, n, J);
    invert_centre(J);
    bound_values(J, find_spread(J));
}
