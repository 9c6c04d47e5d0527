/* The Jacobian of the leg lengths over a box of poses, and how far from singular it stays, (space-9), (space-10). Rows are legs;
 * the last three columns are divided by the mean distance of the top joints from the top frame's origin. */
#ifndef GOUGH_WORKSPACE_STIFF_H
#define GOUGH_WORKSPACE_STIFF_H

#include "workspace/space.h"

typedef struct stiff {
    taylor row[LEGS][6];
    double inverse[6][LEGS]; /* at the centre, to rounding */
    double
        spread; /* greatest row sum of |J_c⁻¹ J − 1| over the box: below 1, no pose is singular */
    int sign;            /* of the determinant at the centre; 0: too near to 0 to tell */
    double least[2];     /* bounds of the least singular value over the box */
    double most[2];      /* and of the greatest */
    double condition;    /* the greatest condition is at most this */
    double column[6][6]; /* J_c V: columns at right angles, as long as the singular values of J_c */
} stiff;

void stiff_of(const space *s, const box_view *view, const taylor_vector n[LEGS], stiff *J);

/* (space-19): a bound of the least singular value that is exact to second order; with `both` also those of the greatest one and
 * of the condition. They are drawn nearer in J. */
void stiff_refine(stiff *J, bool both);

/* the sign that the determinant has in all poses of the box; 0 if it is not certain */
static inline int stiff_side(const stiff *J) { return J->spread < 1 ? J->sign : 0; }

#endif
