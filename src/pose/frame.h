/* Between a machine with its poses and the unknowns of this room: both rings about their centroids, lengths divided by a power of
 * two, (pose-3), so that all unknowns are of one size and no digit is lost. Plain
 * double, but for the joints. */
#ifndef GOUGH_POSE_FRAME_H
#define GOUGH_POSE_FRAME_H

#include <math.h>

#include "base/quantity.h"
#include "gough/dynamics.h"
#include "kernel/number.h"

typedef struct pose_frame {
    double base[3], top[3]; /* centroids of the joints, base and top frame */
    double top_distance;    /* of the top's from the top frame's origin */
    double scale; /* a power of two near the rms of the joints' distances and the lengths */
} pose_frame;

static inline double pose_norm(const double v[3]) {
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static inline pose_frame pose_frame_of(const gough_machine *machine,
                                       const double length[GOUGH_LEGS]) {
    const gough_platform *p = &machine->platform;
    pose_frame f = {{0, 0, 0}, {0, 0, 0}, 0, 1};
    double sum = 0;
    int exponent;

    for (int v = 0; v < GOUGH_LEGS; v++) {
        for (int k = 0; k < 3; k++) {
            f.base[k] += p->base[v][k] / GOUGH_LEGS;
            f.top[k] += p->top[v][k] / GOUGH_LEGS;
        }
    }
    for (int v = 0; v < GOUGH_LEGS; v++) {
        sum += length[v] * length[v];
        for (int k = 0; k < 3; k++) {
            const double b = p->base[v][k] - f.base[k], a = p->top[v][k] - f.top[k];
            sum += a * a + b * b;
        }
    }
    frexp(sqrt(sum / (3 * GOUGH_LEGS)), &exponent);
    f.scale = ldexp(1, exponent);
    f.top_distance = pose_norm(f.top);
    return f;
}

/* joints of leg v about the centroids, divided by the scale */
static inline void pose_frame_joints(const pose_frame *f, const gough_machine *machine, int v,
                                     number b[3], number a[3]) {
    const gough_platform *p = &machine->platform;
    const number inverse = number_of(1 / f->scale);

    for (int k = 0; k < 3; k++) {
        b[k] = (number_of(p->base[v][k]) - number_of(f->base[k])) * inverse;
        a[k] = (number_of(p->top[v][k]) - number_of(f->top[k])) * inverse;
    }
}

/* R h of a quaternion, with the inverse of h */
static inline void pose_rotation(const double e[4], double inverse, double R[3][3]) {
    const double two = 2 * inverse;

    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const double *v = e + 1;
        R[i][i] = 1 - two * (v[j] * v[j] + v[k] * v[k]);
        R[i][j] = two * (v[i] * v[j] - e[0] * v[k]);
        R[i][k] = two * (v[i] * v[k] + e[0] * v[j]);
    }
}

/* a unit quaternion of a rotation: the largest component from the diagonal, the others from it */
static inline void pose_quaternion(const double R[3][3], double e[4]) {
    const double square[4] = {1 + R[0][0] + R[1][1] + R[2][2], 1 + R[0][0] - R[1][1] - R[2][2],
                              1 - R[0][0] + R[1][1] - R[2][2], 1 - R[0][0] - R[1][1] + R[2][2]};
    int largest = 0;
    double norm = 0;

    for (int i = 1; i < 4; i++)
        if (square[i] > square[largest]) largest = i;
    for (int i = 0; i < 4; i++) {
        const int a = i < largest ? i : largest, b = i < largest ? largest : i;
        if (a == b)
            e[i] = square[i];
        else if (a == 0)
            e[i] = R[(b + 1) % 3][b % 3] - R[b % 3][(b + 1) % 3];
        else
            e[i] = R[a - 1][b - 1] + R[b - 1][a - 1];
        norm += e[i] * e[i];
    }
    for (int i = 0; i < 4; i++) e[i] /= sqrt(norm);
}

/* (pose-1): x of a pose with e·e = 1 and e·g = 0, g = t e with t from centroid to centroid */
static inline void pose_soma(const pose_frame *f, const gough_state *s, double x[8]) {
    double t[3], *const e = x, *const g = x + 4;

    pose_quaternion(s->rotation, e);
    for (int r = 0; r < 3; r++) {
        double c = 0;
        for (int k = 0; k < 3; k++) c += s->rotation[r][k] * f->top[k];
        t[r] = (s->position[r] + c - f->base[r]) / f->scale;
    }
    g[0] = -(t[0] * e[1] + t[1] * e[2] + t[2] * e[3]);
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        g[1 + i] = e[0] * t[i] + t[j] * e[1 + k] - t[k] * e[1 + j];
    }
}

/* (pose-1) inverted: t h = e0 g − g0 e + e × g. Returns |t|, in units of the scale */
static inline double pose_of_soma(const pose_frame *f, const double x[8], double position[3],
                                  double rotation[3][3]) {
    const double *const e = x, *const g = x + 4;
    const double inverse = 1 / (e[0] * e[0] + e[1] * e[1] + e[2] * e[2] + e[3] * e[3]);
    double t[3];

    pose_rotation(e, inverse, rotation);
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        t[i] = inverse *
               (e[0] * g[1 + i] - g[0] * e[1 + i] + e[1 + j] * g[1 + k] - e[1 + k] * g[1 + j]);
    }
    for (int r = 0; r < 3; r++) {
        double c = 0;
        for (int k = 0; k < 3; k++) c += rotation[r][k] * f->top[k];
        position[r] = f->scale * t[r] + f->base[r] - c;
    }
    return pose_norm(t);
}

/* (pose-9): a bound r of the components of x, with e·e = 1, as a length and an angle. A vector of four is at most twice its
 * largest component; the rest is what second order adds */
static inline void pose_errors(const pose_frame *f, double r, double distance, double *position,
                               double *angle) {
    const double more = 1.01;

    *angle = more * 4 * r;
    *position = more * 2 * r * f->scale * (1 + distance) + *angle * f->top_distance;
}

/* (pose-10): the components of poses so near differ by less than u */
static inline void pose_unique(const pose_frame *f, double u, double distance, double *position,
                               double *angle) {
    const double part = u / (1 + distance + 2 * f->top_distance / f->scale);

    *position = f->scale * part;
    *angle = 2 * part;
}

static inline gough_status pose_check_lengths(const double length[GOUGH_LEGS], gough_error *error) {
    for (int v = 0; v < GOUGH_LEGS; v++) {
        if (length[v] > 0 && length[v] < INFINITY) continue;
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "the length of leg %d must be finite and above 0, not %g" IN_LENGTH,
                          v + 1, length[v]);
    }
    return GOUGH_OK;
}

#endif
