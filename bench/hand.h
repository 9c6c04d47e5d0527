/* The same machine written out by hand, as someone would who needs this one run: position, unit quaternion, velocity and angular
 * velocity of the body, 13 numbers; the heave and its forces in closed form. What other programs are given to work on. */
#ifndef BENCH_HAND_H
#define BENCH_HAND_H

#include <stdbool.h>

#include "bench/reference.h"

enum { HAND_STATE = 13 };

typedef struct {
    double base[6][3], top[6][3], height, distance2, mass, J[3], gravity, stiffness;
    bool heavy;
    double cylinder[3], piston[3], reflected; /* mass, centre, inertia */
} hand;

hand hand_of(const reference *r);
/* length and force of each leg along the program: l² = h² + d², F = M (z̈ + g) l/(6 h) */
void hand_program(const hand *h, double t, double *length, double *force);
void hand_begin(const reference *r, double y[HAND_STATE]);
void hand_rates(const hand *h, double t, const double *y, double *rate);
/* quaternion (w, x, y, z) of roll, pitch, yaw, and the matrix of a quaternion */
void hand_quaternion(const double angles[3], double q[4]);
void hand_matrix(const double q[4], double R[3][3]);

#endif
