/* Whether a matrix that a caller hands in is a rotation: orthonormal columns, right-handed. */
#ifndef GOUGH_PLANT_ROTATION_VALID_H
#define GOUGH_PLANT_ROTATION_VALID_H

#include <math.h>
#include <stdbool.h>

/* How far an element of RᵀR may be from the unit matrix. Rotations in single precision are within 1e-6, and lengths of legs are
 * then wrong by 1e-6 of the platform at most; what is farther off is no rotation but a mistake. */
static const double rotation_tolerance = 1e-6;

/* A NaN anywhere makes it false. */
static inline bool is_rotation(const double r[3][3]) {
    bool orthonormal = true;
    for (int a = 0; a < 3; a++) {
        for (int b = a; b < 3; b++) {
            const double product = r[0][a] * r[0][b] + r[1][a] * r[1][b] + r[2][a] * r[2][b];
            orthonormal &= fabs(product - (a == b ? 1 : 0)) <= rotation_tolerance;
        }
    }
    const double determinant = r[0][0] * (r[1][1] * r[2][2] - r[1][2] * r[2][1]) -
                               r[0][1] * (r[1][0] * r[2][2] - r[1][2] * r[2][0]) +
                               r[0][2] * (r[1][0] * r[2][1] - r[1][1] * r[2][0]);
    return orthonormal && determinant > 0;
}

#endif
