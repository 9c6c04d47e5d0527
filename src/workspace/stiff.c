/* (space-9), (space-10): the Jacobian over a box. Theory: docs/theory/workspace.md. */
#define NUMBER_DOUBLE
#include "workspace/stiff.h"

#include <string.h>

#include "base/limits.h"

/* roundings of the products of a row and of its singular values, relative to the greatest */
static const double MATRIX_ROUNDED = 256 * DBL_EPSILON;

/* (legs-5): a row is the leg's direction and its moment about the top frame's origin */
static void fill_rows(const space *s, const box_view *view, const affine_vector n[LEGS], stiff *J) {
    const double inverse = 1 / s->h.reach;
    for (int v = 0; v < LEGS; v++) {
        const affine_vector arm = box_turned(view, out_of(&view->x.q, s->h.top[v]));
        const affine_vector moment = affine_cross(&arm, &n[v]);
        for (int i = 0; i < 3; i++) {
            J->row[v][i] = n[v].x[i];
            J->row[v][3 + i] = affine_scale(inverse, moment.x[i]);
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
    double c = 0, g[SIDES] = {0, 0, 0, 0, 0, 0}, rest = 0, size = 0, sum;
    for (int m = 0; m < 6; m++) {
        const double y = J->inverse[i][m];
        const affine *a = &J->row[m][j];
        c += y * a->c, size += fabs(y * a->c), rest += fabs(y) * a->r;
        for (int k = 0; k < SIDES; k++) g[k] += y * a->g[k];
    }
    sum = fabs(c - (i == j)) + rest;
    for (int k = 0; k < SIDES; k++) sum += fabs(g[k]);
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
        /* a NaN is no bound */
        if (!(sum <= J->spread)) J->spread = sum;
    }
    return sqrt(square) * (1 + MATRIX_ROUNDED);
}

/* (space-10): singular values move by no more than the norm of what is added, the least also by no more than its share */
static void bound_values(stiff *J, double part) {
    /* the rotations of the columns leave J_c V in place of J_c */
    double(*a)[6] = J->column, square = 0, most, least;
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++) {
            const double wide = affine_spread(&J->row[i][j]);
            a[i][j] = J->row[i][j].c, square += wide * wide;
        }
    singular_values(a, &most, &least);
    const double way = sqrt(square) * (1 + MATRIX_ROUNDED), rounding = MATRIX_ROUNDED * most;
    J->least[0] = fmax(0, fmax(least - way, least * (1 - part)) - rounding);
    J->least[1] = least + way + rounding;
    J->most[0] = fmax(0, most - way - rounding), J->most[1] = most + way + rounding;
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
        if (!(sum <= off)) off = sum;
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
static void turned(const stiff *J, const turns *t, affine A[6][6]) {
    int order[6];
    for (int j = 0; j < 6; j++) {
        int place = j;
        for (; place > 0 && t->value[order[place - 1]] < t->value[j]; place--)
            order[place] = order[place - 1];
        order[place] = j;
    }
    for (int j = 0; j < 6; j++) {
        affine right[6];
        for (int v = 0; v < 6; v++) {
            right[v] = affine_of(0);
            for (int m = 0; m < 6; m++)
                right[v] = affine_add(right[v], affine_scale(t->V[m][order[j]], J->row[v][m]));
        }
        for (int i = 0; i < 6; i++) {
            A[i][j] = affine_of(0);
            for (int m = 0; m < 6; m++)
                A[i][j] = affine_add(A[i][j], affine_scale(t->U[m][order[i]], right[m]));
        }
    }
}

/* lengths of the parts of column k and of row k from the element `from` to the one before `to` */
static void sides_of(affine A[6][6], int k, int from, int to, double side[2]) {
    double column = 0, row = 0;
    for (int i = from; i < to; i++) {
        const double above = affine_magnitude(&A[i][k]), beside = affine_magnitude(&A[k][i]);
        column += above * above, row += beside * beside;
    }
    side[0] = sqrt(column) * (1 + MATRIX_ROUNDED), side[1] = sqrt(row) * (1 + MATRIX_ROUNDED);
}

/* singular values of two rows (a, b), (c, d) of numbers that are not below 0: with the sum of their squares and the determinant */
static void two_values(double a, double b, double c, double d, double *least, double *most) {
    const double sum = a * a + b * b + c * c + d * d, det = fmax(0, a * d - b * c);
    const double large = sqrt(0.5 * (sum + sqrt(fmax(0, (sum - 2 * det) * (sum + 2 * det)))));
    *most = large * (1 + MATRIX_ROUNDED);
    *least = large > 0 ? det / large * (1 - MATRIX_ROUNDED) - MATRIX_ROUNDED * (b * c) / large : 0;
}

/* One row and column after the other is added to a block: for the least value from the greatest on, for the greatest from the
 * least on. */
void stiff_refine(stiff *J) {
    turns t;
    affine A[6][6];
    double least = INFINITY, most = 0, side[2], unused;
    find_turns(J, &t);
    if (!(t.off < 0.5)) return;
    turned(J, &t, A);
    for (int k = 0; k < 6; k++) {
        const double own = fmax(0, affine_least(&A[k][k]));
        sides_of(A, k, 0, k, side);
        if (k == 0)
            least = own;
        else
            two_values(least, side[0], side[1], own, &least, &unused);
    }
    for (int k = 5; k >= 0; k--) {
        sides_of(A, k, k + 1, 6, side);
        two_values(most, side[0], side[1], affine_magnitude(&A[k][k]), &unused, &most);
    }
    J->least[0] = fmax(J->least[0], least * (1 - t.off));
    J->most[1] = fmin(J->most[1], most * (1 + 2 * t.off));
}

void stiff_of(const space *s, const box_view *view, const affine_vector n[LEGS], stiff *J) {
    fill_rows(s, view, n, J);
    invert_centre(J);
    bound_values(J, find_spread(J));
}
