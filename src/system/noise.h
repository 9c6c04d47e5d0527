/* Smooth random forces on legs and load, (law-3). Text over the number type. Theory: docs/theory/control.md. */
#ifndef GOUGH_SYSTEM_NOISE_H
#define GOUGH_SYSTEM_NOISE_H

#include "system/external.h"

/* root of 315/151: over an interval the squares of the four weights below have the mean 151/315 */
#define NOISE_SCALE REAL_LITERAL(1.44433123459675553728075145407450573874507)

/* (law-3): the normal numbers around the knot, the draw of channel c at knot k being c + 12 k */
static inline void noise_draw(struct system *r, real knot) {
    for (int i = 0; i < NUMBER_WIDTH; i++) {
        const gough_noise *n = &r->lane[i].disturbance->noise;
        const uint64_t first = (uint64_t)(long long)knot;
        for (int c = 0; c < NOISE_CHANNELS; c++) {
            const double size = c < LEGS ? n->leg_force : c < LEGS + 3 ? n->force : n->moment;
            for (int k = 0; k < 4; k++) {
                const uint64_t draw = (uint64_t)c + NOISE_CHANNELS * (first + (uint64_t)k);
                const real x = size > 0 ? gough_random_normal(n->seed, r->lane[i].number, draw) : 0;
                number_put(&r->noise.coefficient[c][k], i, NOISE_SCALE * (real)size * x);
            }
        }
    }
    r->noise.knot = knot;
    r->noise.fresh = 1;
}

/* (law-3): a uniform cubic spline whose coefficients are normal numbers, one interval in all lanes */
static inline void noise_add(struct system *r, real t, wanted *s) {
    const real place = t / (real)r->lane[0].disturbance->noise.interval, knot = real_floor(place);
    const real x = place - knot, y = 1 - x;
    const number weight[4] = {
        number_of_real(y * y * y / 6), number_of_real((3 * x * x * x - 6 * x * x + 4) / 6),
        number_of_real((3 * y * y * y - 6 * y * y + 4) / 6), number_of_real(x * x * x / 6)};
    number value[NOISE_CHANNELS];

    if (!(r->lane[0].disturbance->noise.interval > 0) || !(place < 0x1p53)) {
        wanted_blame(
            r,
            "disturbance.noise.interval, which must be > 0 and no tiny part of the run: the noise",
            t);
        return;
    }
    if (!r->noise.fresh || knot < r->noise.knot || knot > r->noise.knot) noise_draw(r, knot);
    for (int c = 0; c < NOISE_CHANNELS; c++) {
        const number *n = r->noise.coefficient[c];
        value[c] = weight[0] * n[0] + weight[1] * n[1] + weight[2] * n[2] + weight[3] * n[3];
    }
    number *shake = wanted_shake(r, s);
    for (int v = 0; v < LEGS; v++) shake[v] = shake[v] + value[v];
    s->push = add(s->push, (vector){value[LEGS], value[LEGS + 1], value[LEGS + 2]});
    s->turn = add(s->turn, (vector){value[LEGS + 3], value[LEGS + 4], value[LEGS + 5]});
}

#endif
