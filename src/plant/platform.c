/* Platforms: no joints and no limits yet, or joints in pairs on two circles. */
#include <math.h>

#include "gough/model.h"
#include "gough/sizes.h"

gough_status gough_platform_init(gough_platform *platform, size_t size) {
    if (size != sizeof *platform) return gough_size_refuse(platform, size);
    *platform =
        (gough_platform){.length_max = INFINITY, .speed_max = INFINITY, .force_max = INFINITY};
    for (int v = 0; v < GOUGH_LEGS; v++) platform->friction.efficiency[v] = 1;
    return GOUGH_OK;
}

/* Point of a circle at `angle` from a direction whose cosine and sine are known exactly, so that
 * the three pairs are turned into each other, and mirrored, to the last bit but one. */
static void on_circle(double radius, const double direction[2], double angle, double joint[3]) {
    const double c = cos(angle), s = sin(angle);
    joint[0] = radius * (direction[0] * c - direction[1] * s);
    joint[1] = radius * (direction[1] * c + direction[0] * s);
    joint[2] = 0;
}

gough_status gough_platform_init_symmetric(gough_platform *platform, size_t size,
                                           double base_radius, double base_half_angle,
                                           double top_radius, double top_half_angle,
                                           double height) {
    static const double HALF = 0.5, SINE = 0.86602540378443864676; /* of 30° and 60° */
    const double base_pair[3][2] = {{1, 0}, {-HALF, SINE}, {-HALF, -SINE}};
    const double top_pair[3][2] = {{HALF, SINE}, {-1, 0}, {HALF, -SINE}};

    if (gough_platform_init(platform, size) != GOUGH_OK) return GOUGH_ERROR_INPUT;
    platform->base_radius = base_radius;
    platform->height = height;
    for (int pair = 0; pair < 3; pair++) {
        /* an odd leg rises from the pair's far joint to the near joint of the top's next pair,
         * an even leg from the next base pair's near joint to the far joint there */
        on_circle(base_radius, base_pair[pair], base_half_angle, platform->base[2 * pair]);
        on_circle(top_radius, top_pair[pair], -top_half_angle, platform->top[2 * pair]);
        on_circle(base_radius, base_pair[(pair + 1) % 3], -base_half_angle,
                  platform->base[2 * pair + 1]);
        on_circle(top_radius, top_pair[pair], top_half_angle, platform->top[2 * pair + 1]);
    }
    return GOUGH_OK;
}
