/* Where a point of the top is, its velocity and its acceleration. Any consistent units, base axes. */
#ifndef GOUGH_PLANT_PLATFORM_POINT_H
#define GOUGH_PLANT_PLATFORM_POINT_H

/* The top frame's origin and the top's rotation, with their derivatives. */
typedef struct top_motion {
    const double *position, *velocity, *acceleration; /* of the origin */
    const double *angular_velocity, *angular_acceleration;
    const double (*rotation)[3]; /* columns are the top's axes */
} top_motion;

static inline double point_dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void point_cross(const double a[3], const double b[3], double out[3]) {
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        out[i] = a[j] * b[k] - a[k] * b[j];
    }
}

/* A point at `at` in the top frame: where it is, v = ṗ + ω×r, a = p̈ + α×r + ω×(ω×r). */
static inline void platform_point(const top_motion *m, const double at[3], double point[3],
                                  double velocity[3], double acceleration[3]) {
    double r[3], turn[3], tangential[3], central[3];

    for (int i = 0; i < 3; i++) r[i] = point_dot(m->rotation[i], at);
    point_cross(m->angular_velocity, r, turn);
    point_cross(m->angular_acceleration, r, tangential);
    point_cross(m->angular_velocity, turn, central);
    for (int i = 0; i < 3; i++) {
        point[i] = m->position[i] + r[i];
        velocity[i] = m->velocity[i] + turn[i];
        acceleration[i] = m->acceleration[i] + tangential[i] + central[i];
    }
}

#endif
