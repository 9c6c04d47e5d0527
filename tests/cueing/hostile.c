/* Records for the limiter; a step is looked at as a parabola, at many times and where it is longest. */
#include "cueing/hostile.h"

#include <stdlib.h>

enum { SAMPLES = 200, WITHIN = 16 };

void hostile_machine(gough_model *model) {
    const gough_platform p = gough_platform_symmetric(2.5, 8 * pi / 180, 1.9, 10 * pi / 180, 2.6);
    const gough_load load = {.mass = 6000, .inertia = {{9000, 0, 0}, {0, 12000, 0}, {0, 0, 11000}}};
    const double gravity[3] = {0, 0, -9.80665};
    gough_error error = {0};
    memset(model, 0, sizeof *model);
    ck_assert_msg(gough_machine_init(&model->machine, &p, &load, gravity, &error) == GOUGH_OK, "%s",
                  error.message);
}

void hostile_begin(gough_limiter *q, const gough_model *model, const gough_state *pose, double h) {
    gough_leg_bounds b;
    const double about[3] = {0.1, 0, 1.1};
    gough_error error = {.message = ""};
    for (int v = 0; v < GOUGH_LEGS; v++) {
        b.length[v][0] = 2.4 + 0.01 * v, b.length[v][1] = 3.9 - 0.02 * v;
        b.speed[v] = 0.7 - 0.01 * v, b.acceleration[v] = 6 + 0.1 * v;
    }
    ck_assert_msg(gough_limiter_begin(q, sizeof *q, &model->machine, &b, about, 0.3, 10, h, pose,
                                      &error) == GOUGH_OK,
                  "%s", error.message);
}

/* rates and lengths that jump, swing, drive into the ends, or all at once */
static void wish(dice *d, int kind, int k, const gough_limiter *q, double size, double length[6],
                 double rate[6]) {
    for (int v = 0; v < 6; v++) {
        const double mid = 0.5 * (q->bounds.length[v][0] + q->bounds.length[v][1]);
        if (kind == 0 && k % 7 == 0) rate[v] = dice_between(d, -size, size);
        if (kind == 1) rate[v] = size * sin(0.05 * (1 + v) * k);
        if (kind == 2) rate[v] = (k / 40 + v) % 2 ? size : -size;
        if (kind == 3) rate[v] = dice_between(d, -size, size);
        if (kind == 4 && k % 25 == 0) length[v] = mid + size * dice_between(d, -1, 1);
        if (kind != 4) length[v] = q->length[v] + 0.01 * size * dice_between(d, -1, 1);
    }
}

/* the greater of both; NaN stays */
static void widen(double *most, double value) {
    if (!(value <= *most)) *most = value;
}

/* how far one step is beyond the bounds */
static double beyond(const gough_limiter *a, const gough_limiter *b, double h, double *nearest) {
    double most = -INFINITY;
    for (int v = 0; v < 6; v++) {
        const gough_leg_bounds *bounds = &a->bounds;
        const double change = (b->rate[v] - a->rate[v]) / h;
        widen(&most, fabs(b->rate[v]) - bounds->speed[v]);
        widen(&most, h * (fabs(change) - bounds->acceleration[v]));
        const double turn = fabs(change) > 0 ? -a->rate[v] / change : 0;
        for (int i = 0; i <= WITHIN + 1; i++) {
            const double t = i <= WITHIN ? h * i / WITHIN : fmin(h, fmax(0, turn));
            const double l = a->length[v] + t * (a->rate[v] + 0.5 * change * t);
            const double room = fmin(bounds->length[v][1] - l, l - bounds->length[v][0]);
            widen(&most, -room);
            *nearest = fmin(*nearest, room);
        }
    }
    return most;
}

hostile_count hostile_records(int records, uint64_t seed) {
    gough_model *model = malloc(sizeof *model);
    dice d = {seed};
    hostile_count count = {.beyond = -INFINITY, .nearest = INFINITY};
    hostile_machine(model);
    const gough_state home = gough_state_home(&model->machine);
    for (int record = 0; record < records; record++) {
        const double h = 0.002 * pow(20, dice_between(&d, 0, 1)),
                     size = pow(10, dice_between(&d, -1, 2));
        double length[6], rate[6] = {0};
        gough_limiter q, before;
        hostile_begin(&q, model, &home, fmin(h, 0.02));
        memcpy(length, q.length, sizeof length);
        int k = 0;
        for (; k < SAMPLES; k++) {
            bool limited[6];
            wish(&d, record % 5, k, &q, size, length, rate);
            before = q;
            if (gough_limiter_sample(&q, length, rate, limited, NULL)) break;
            widen(&count.beyond, beyond(&before, &q, q.period, &count.nearest));
            for (int v = 0; v < 6; v++)
                if (limited[v]) {
                    count.limited++;
                    break;
                }
        }
        if (k == SAMPLES)
            count.whole++;
        else
            count.ended++;
    }
    free(model);
    return count;
}
