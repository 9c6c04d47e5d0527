/* Rotations of a record, (motion-11) and (motion-12). */
#include "study/record_rotation.h"

#include <math.h>
#include <string.h>

#include "gough/dynamics.h"

static const double DEGREE = 3.14159265358979323846 / 180;

static void to_degrees(double angle[3]) {
    for (int a = 0; a < 3; a++) angle[a] = angle[a] / DEGREE + 0.0;
}

/* ---- quaternions and matrices ---- */

bool study_quaternion_angles(const double q[4], gough_order order, double angle[3]) {
    double R[3][3];
    if (gough_rotation_of_quaternion(q, R) != GOUGH_OK) return false; /* a cell with its scale */
    gough_angles_in_order(order, R, angle);
    to_degrees(angle);
    return true;
}

/* X ← X (3 − XᵀX)/2, which converges to the orthonormal factor of X quadratically where XᵀX is near 1 */
static void polish(double X[3][3]) {
    double G[3][3], Y[3][3];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            G[i][j] =
                1.5 * (i == j) - 0.5 * (X[0][i] * X[0][j] + X[1][i] * X[1][j] + X[2][i] * X[2][j]);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            Y[i][j] = X[i][0] * G[0][j] + X[i][1] * G[1][j] + X[i][2] * G[2][j];
    memcpy(X, Y, sizeof Y);
}

bool study_matrix_angles(const double r[9], gough_order order, double angle[3]) {
    double R[3][3];
    memcpy(R, r, sizeof R);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const double product = R[0][i] * R[0][j] + R[1][i] * R[1][j] + R[2][i] * R[2][j];
            if (!(fabs(product - (i == j)) <= 0.1)) return false;
        }
    const double determinant = R[0][0] * (R[1][1] * R[2][2] - R[1][2] * R[2][1]) -
                               R[0][1] * (R[1][0] * R[2][2] - R[1][2] * R[2][0]) +
                               R[0][2] * (R[1][0] * R[2][1] - R[1][1] * R[2][0]);
    if (!(determinant > 0)) return false;
    for (int k = 0; k < 6; k++) polish(R);
    gough_angles_in_order(order, R, angle);
    to_degrees(angle);
    return true;
}

/* ---- steps ---- */

/* Near a pitch of 90° errors of roll and yaw grow as its secant; there angles about other axes are used. */
static double secant(double pitch) { return 1 / fmax(cos(pitch * DEGREE), 0.1); }

/* (motion-12): an error e of a quaternion turns the rotation by the vector of 2 q* e. The mean square of each component is four
 * times that of e's, and the length of the vector at most 2 |e| ≤ 4 max|eᵢ|; an angle changes by at most that times the secant. */
study_quantum study_quaternion_step(study_quantum step, double pitch) {
    const double whole = secant(pitch) / DEGREE;
    return (study_quantum){4 * whole * step.greatest, 2 * whole * step.mean};
}

/* (motion-12): an error E of a matrix turns it by the skew part of RᵀE: each component is half the difference of two elements,
 * which have the mean square of E's and are at most √3 max|E|; three such components are at most 3 max|E| long. */
study_quantum study_matrix_step(study_quantum step, double pitch) {
    const double whole = secant(pitch) / DEGREE;
    return (study_quantum){3 * whole * step.greatest, whole * step.mean / sqrt(2)};
}

/* ---- other orders, and from the first row ---- */

static void rotation_of(const double *angle, gough_order order, double R[3][3]) {
    const double radians[3] = {angle[0] * DEGREE, angle[1] * DEGREE, angle[2] * DEGREE};
    gough_rotation_in_order(order, radians, R);
}

void study_angles_reorder(size_t count, double *angle, size_t stride, gough_order from,
                          gough_order to) {
    double R[3][3];
    for (size_t i = 0; i < count; i++) {
        rotation_of(angle + i * stride, from, R);
        gough_angles_in_order(to, R, angle + i * stride);
        to_degrees(angle + i * stride);
    }
}

/* Steps of displacements in turned axes, and of angles that mix. */
static void turn_steps(const double first[3][3], bool level, double pitch,
                       study_quantum step[GOUGH_COMPONENTS]) {
    study_quantum turned[3] = {{0, 0}, {0, 0}, {0, 0}}, angle = {0, 0};
    for (int j = 0; j < 3; j++) {
        for (int i = 0; i < 3; i++) {
            turned[j].greatest += fabs(first[i][j]) * step[i].greatest;
            turned[j].mean += first[i][j] * first[i][j] * step[i].mean * step[i].mean;
        }
        turned[j].mean = sqrt(turned[j].mean);
        angle.greatest += step[GOUGH_ROLL + j].greatest;
        angle.mean = fmax(angle.mean, step[GOUGH_ROLL + j].mean);
    }
    memcpy(step, turned, sizeof turned);
    if (level) return; /* only yaw is counted from another zero */
    angle.greatest *= secant(pitch);
    angle.mean *= secant(pitch);
    for (int a = GOUGH_ROLL; a < GOUGH_COMPONENTS; a++) step[a] = angle;
}

void study_poses_from_first(size_t count, double *value, gough_order order,
                            study_quantum step[GOUGH_COMPONENTS]) {
    double F[3][3], p[3], pitch = 0;
    const bool turned =
        fabs(value[GOUGH_ROLL]) + fabs(value[GOUGH_PITCH]) + fabs(value[GOUGH_YAW]) > 0;
    const bool level =
        order == GOUGH_ZYX && !(fabs(value[GOUGH_ROLL]) + fabs(value[GOUGH_PITCH]) > 0);
    memcpy(p, value, sizeof p);
    rotation_of(value + GOUGH_ROLL, order, F);
    const double yaw = value[GOUGH_YAW];
    for (size_t i = 0; i < count; i++) {
        double *row = value + i * GOUGH_COMPONENTS, R[3][3], S[3][3];
        const double d[3] = {row[0] - p[0], row[1] - p[1], row[2] - p[2]};
        for (int j = 0; j < 3; j++)
            row[j] = turned ? F[0][j] * d[0] + F[1][j] * d[1] + F[2][j] * d[2] : d[j];
        if (level) {
            row[GOUGH_YAW] -= yaw; /* Rz(−ψ₁) Rz(ψ) Ry Rx, to the last digit */
            continue;
        }
        rotation_of(row + GOUGH_ROLL, order, R);
        for (int r = 0; r < 3; r++)
            for (int c = 0; c < 3; c++)
                S[r][c] = F[0][r] * R[0][c] + F[1][r] * R[1][c] + F[2][r] * R[2][c];
        gough_angles_in_order(order, S, row + GOUGH_ROLL);
        to_degrees(row + GOUGH_ROLL);
        pitch = fmax(pitch, fabs(row[GOUGH_PITCH]));
    }
    if (turned) turn_steps((const double(*)[3])F, level, pitch, step);
}
