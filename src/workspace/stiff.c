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
    double a[6][6], square = 0, most, least;
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

void stiff_of(const space *s, const box_view *view, const affine_vector n[LEGS], stiff *J) {
    fill_rows(s, view, n, J);
    invert_centre(J);
    bound_values(J, find_spread(J));
}
