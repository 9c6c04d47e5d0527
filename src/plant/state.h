/* Pose and rate as numbers of a state. */
#ifndef GOUGH_PLANT_STATE_H
#define GOUGH_PLANT_STATE_H

#include "kernel/top.h"
#include "plant/layout.h"

static inline vector vector_load(const number y[3]) { return (vector){y[0], y[1], y[2]}; }
static inline void vector_store(vector v, number y[3]) { y[0] = v.x, y[1] = v.y, y[2] = v.z; }

static inline coordinates coordinates_load(const number y[COORDINATES]) {
    return (coordinates){vector_load(y),
                         {vector_load(y + 3), vector_load(y + 6), vector_load(y + 9)}};
}

static inline void coordinates_store(const coordinates *x, number y[COORDINATES]) {
    vector_store(x->rho, y);
    vector_store(x->q.i, y + 3);
    vector_store(x->q.j, y + 6);
    vector_store(x->q.k, y + 9);
}

#endif
