/* Random machines whose joints lie in two level planes. */
#ifndef TESTS_LINEAR_PLANES_H
#define TESTS_LINEAR_PLANES_H

#include "support/machines.h"

/* six joints in a plane, each in a sector of its own */
static inline void scatter(dice *d, double size, double joint[GOUGH_LEGS][3]) {
    for (int v = 0; v < GOUGH_LEGS; v++) {
        const double angle = (v + dice_between(d, -0.4, 0.4)) * pi / 3;
        const double radius = size * dice_between(d, 0.6, 1.4);
        joint[v][0] = radius * cos(angle);
        joint[v][1] = radius * sin(angle);
        joint[v][2] = 0;
    }
}

/* false for one nearly singular at home; h: the height of the top joints over the base joints */
static inline bool random_machine(dice *d, gough_machine *machine, double *h) {
    const double gravity[3] = {0, 0, -dice_between(d, 1, 10)}, below = dice_between(d, -0.3, 0.3),
                 above = dice_between(d, -0.3, 0.3);
    gough_platform platform = gough_platform_default();
    gough_load load = {.mass = dice_between(d, 0.5, 20),
                       .center_of_mass = {0.1, -0.05, dice_between(d, -0.2, 0.4)},
                       .inertia = {{0.3, 0.01, -0.02}, {0.01, 0.4, 0.03}, {-0.02, 0.03, 0.5}}};
    gough_error error;

    scatter(d, 1, platform.base);
    scatter(d, 0.6, platform.top);
    for (int v = 0; v < GOUGH_LEGS; v++) {
        const double a = 0.5 * (v % 2 ? 1 : -1), x = platform.top[v][0], y = platform.top[v][1];
        platform.top[v][0] = x * cos(a) - y * sin(a);
        platform.top[v][1] = x * sin(a) + y * cos(a);
        platform.base[v][2] = below;
        platform.top[v][2] = above;
    }
    platform.height = dice_between(d, 0.8, 1.5);
    *h = platform.height + above - below;
    return gough_machine_init(machine, &platform, &load, gravity, &error) == GOUGH_OK &&
           machine->home_condition < 100;
}

#endif
