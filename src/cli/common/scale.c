/* Numbers of a struct turned from units of the run into units of the output, by a table of their dimensions. */
#include "cli/common/scale.h"

#include <math.h>

static const double DEGREES = 57.295779513082320877;

const dimension DIMENSION_LENGTH = {1, 0, 0, 0}, DIMENSION_TIME = {0, 0, 1, 0},
                DIMENSION_RATE = {0, 0, -1, 0}, DIMENSION_ANGLE = {0, 0, 0, 1},
                DIMENSION_SPEED = {1, 0, -1, 0}, DIMENSION_FORCE = {1, 1, -2, 0},
                DIMENSION_POWER = {2, 1, -3, 0}, DIMENSION_ENERGY = {2, 1, -2, 0},
                DIMENSION_STIFFNESS = {0, 1, -2, 0}, DIMENSION_DAMPING = {0, 1, -1, 0};

double scale_unit(const gough_units *units, dimension d) {
    return pow(units->length, d.length) * pow(units->mass, d.mass) * pow(units->time, d.time);
}

double scale_factor(const gough_units *units, dimension d) {
    return (d.degrees ? DEGREES : 1) / scale_unit(units, d);
}

void scale_members(void *object, const scaled_member *member, size_t count,
                   const gough_units *units) {
    for (size_t m = 0; m < count; m++) {
        const dimension d = *member[m].dimension;
        const double unit = scale_unit(units, d), turn = d.degrees ? DEGREES : 1;
        double *value = (double *)(void *)((char *)object + member[m].at);
        for (size_t i = 0; i < member[m].count; i++) value[i] = value[i] / unit * turn;
    }
}
