/* Vectors and triads of numbers, by value. Components are along whatever axes the caller names. */
#ifndef GOUGH_KERNEL_VECTOR_H
#define GOUGH_KERNEL_VECTOR_H

#include "kernel/number.h"

typedef struct {
    number x, y, z;
} vector;

/* i, j, k: the unit vectors of the central frame Cxyz; as a matrix, its columns */
typedef struct {
    vector i, j, k;
} triad;

static inline vector vector_of(const double v[3]) {
    return (vector){number_of(v[0]), number_of(v[1]), number_of(v[2])};
}
KERNEL_SMALL vector add(vector a, vector b) { return (vector){a.x + b.x, a.y + b.y, a.z + b.z}; }
KERNEL_SMALL vector subtract(vector a, vector b) {
    return (vector){a.x - b.x, a.y - b.y, a.z - b.z};
}
KERNEL_SMALL vector scale(number s, vector a) { return (vector){s * a.x, s * a.y, s * a.z}; }
KERNEL_SMALL vector along(vector a, number s, vector b) {
    return (vector){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}
KERNEL_SMALL number dot(vector a, vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
KERNEL_SMALL vector cross(vector a, vector b) {
    return (vector){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static inline vector vector_select(mask m, vector a, vector b) {
    return (vector){number_select(m, a.x, b.x), number_select(m, a.y, b.y),
                    number_select(m, a.z, b.z)};
}
KERNEL_SMALL number norm(vector a) { return number_root(dot(a, a)); }

/* x i + y j + z k: from the axes of the triad to those it is given in */
KERNEL_SMALL vector out_of(const triad *q, vector a) {
    return along(along(scale(a.x, q->i), a.y, q->j), a.z, q->k);
}
/* (a·i, a·j, a·k): onto the axes of the triad */
KERNEL_SMALL vector onto(const triad *q, vector a) {
    return (vector){dot(a, q->i), dot(a, q->j), dot(a, q->k)};
}
/* the triad whose vectors are those of b, given on the axes of a: the matrix product a b */
static inline triad compose(const triad *a, const triad *b) {
    return (triad){out_of(a, b->i), out_of(a, b->j), out_of(a, b->k)};
}
static inline triad transpose(const triad *q) {
    return (triad){{q->i.x, q->j.x, q->k.x}, {q->i.y, q->j.y, q->k.y}, {q->i.z, q->j.z, q->k.z}};
}

#endif
