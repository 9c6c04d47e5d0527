/* Random disturbances: their size, smoothness and independence; the same for the same seed and run. */
#define NUMBER_DOUBLE
#include <stdio.h>

#include "support/machines.h"
#include "support/suite.h"
#include "system/system.h"

typedef struct {
    gough_model *model;
    gough_simulation simulation;
    struct system r;
} noisy;

static noisy *new_noisy(uint64_t seed, uint64_t which) {
    noisy *n = calloc(1, sizeof *n);
    system_lane lane;

    n->model = calloc(1, sizeof *n->model);
    n->simulation = gough_simulation_default();
    paper_machine(&n->model->machine);
    n->model->disturbance.noise =
        (gough_noise){.leg_force = 2, .force = 3, .moment = 0.5, .interval = 0.25, .seed = seed};
    lane = (system_lane){&n->model->machine, &n->model->control, &n->model->disturbance, which, 0};
    system_begin(&n->r, &n->model->motion, &n->simulation, &lane);
    return n;
}

static void free_noisy(noisy *n) {
    free(n->model);
    free(n);
}

/* all twelve channels at t; no feed-forward, so that nothing else acts */
static void noise_at(noisy *n, double t, double value[12]) {
    const wanted *s = system_wanted(&n->r, t);

    for (int v = 0; v < 6; v++) value[v] = s->force[v];
    vector_store(s->push, value + 6);
    vector_store(s->turn, value + 9);
}

START_TEST(noise_has_the_size_asked_for) {
    static const double size[12] = {2, 2, 2, 2, 2, 2, 3, 3, 3, 0.5, 0.5, 0.5};
    double mean[12] = {0}, product[12][12] = {{0}};
    noisy *n = new_noisy(3, 0);
    const int count = 40000; /* 10 000 intervals: statistics to about 2 % */

    for (int i = 0; i < count; i++) {
        double x[12];
        noise_at(n, i * 0.0625 + 0.01, x);
        for (int a = 0; a < 12; a++) {
            mean[a] += x[a] / size[a] / count;
            for (int b = 0; b < 12; b++) product[a][b] += x[a] * x[b] / size[a] / size[b] / count;
        }
    }
    for (int a = 0; a < 12; a++) {
        ck_assert_msg(fabs(mean[a]) <= 0.05, "channel %d: mean %g", a, mean[a]);
        for (int b = 0; b < 12; b++) {
            ck_assert_msg(fabs(product[a][b] - (a == b)) <= 0.06, "%d %d: %g", a, b, product[a][b]);
        }
    }
    free_noisy(n);
}
END_TEST

/* value, first and second difference on both sides of knots agree to the size of the next derivative */
START_TEST(noise_is_twice_differentiable) {
    const double h = 1e-4;
    noisy *n = new_noisy(4, 7);

    for (int knot = 1; knot < 40; knot++) {
        double x[5][12];
        for (int i = 0; i < 5; i++) noise_at(n, knot * 0.25 + (i - 2) * h, x[i]);
        for (int c = 0; c < 12; c++) {
            const double left = (x[0][c] - 2 * x[1][c] + x[2][c]) / (h * h);
            const double right = (x[2][c] - 2 * x[3][c] + x[4][c]) / (h * h);
            /* third derivatives are of the size 10 · 3/0.25³ = 2000, times 2 h; round-off 1e-7 */
            ck_assert_msg(fabs(right - left) <= 4000 * 2 * h, "knot %d: %g", knot, right - left);
        }
    }
    free_noisy(n);
}
END_TEST

START_TEST(noise_is_a_function_of_seed_run_and_time) {
    noisy *one = new_noisy(5, 11), *same = new_noisy(5, 11), *other = new_noisy(5, 12),
          *seeded = new_noisy(6, 11);
    double a[12], b[12], c[12], d[12];

    noise_at(same, 17.3, b); /* in another order */
    for (double t = 0; t < 20; t += 0.7) {
        noise_at(one, t, a);
        noise_at(same, t, b);
        noise_at(other, t, c);
        noise_at(seeded, t, d);
        ck_assert(memcmp(a, b, sizeof a) == 0);
        for (int i = 0; i < 12; i++) ck_assert(fabs(a[i] - c[i]) > 0 && fabs(a[i] - d[i]) > 0);
    }
    free_noisy(one);
    free_noisy(same);
    free_noisy(other);
    free_noisy(seeded);
}
END_TEST

/* both precisions see the same noise: one disturbed closed loop */
static int keep(void *context, const gough_row *row) {
    memcpy(context, row->value, sizeof row->value);
    return 0;
}

START_TEST(noise_is_the_same_in_both_precisions) {
    noisy *n = new_noisy(8, 1);
    double one[GOUGH_COLUMNS], two[GOUGH_COLUMNS];
    gough_error error = {0};
    gough_end end;

    n->model->control.feedforward = true;
    set_gains(n->model, 60, 5);
    n->model->disturbance.noise.leg_force = 0.01;
    n->model->disturbance.noise.force = n->model->disturbance.noise.moment = 0.01;
    n->simulation.duration = 3;
    n->simulation.tolerance = 1e-13;
    ck_assert_int_eq(gough_simulate(n->model, &n->simulation, keep, one, &end, &error), GOUGH_OK);
    n->simulation.precision = GOUGH_QUADRUPLE;
    ck_assert_int_eq(gough_simulate(n->model, &n->simulation, keep, two, &end, &error), GOUGH_OK);
    ck_assert(fabs(one[GOUGH_EX]) > 1e-6);
    for (int c = GOUGH_X; c <= GOUGH_WZ; c++) ck_assert(fabs(one[c] - two[c]) <= 1e-11);
    free_noisy(n);
}
END_TEST

START_TEST(noise_without_an_interval_is_an_error) {
    noisy *n = new_noisy(8, 1);
    gough_error error = {0};
    gough_end end;

    n->model->disturbance.noise.interval = 0;
    ck_assert_int_eq(gough_simulate(n->model, &n->simulation, NULL, NULL, &end, &error),
                     GOUGH_ERROR_INPUT);
    ck_assert(strstr(error.message, "noise") != NULL);
    free_noisy(n);
}
END_TEST

/* its knots are whole numbers, of which a tiny interval makes more than there are */
START_TEST(noise_of_a_tiny_interval_is_an_error) {
    noisy *n = new_noisy(1, 1);
    gough_error error = {0};
    gough_end end;

    n->model->disturbance.noise.interval = 1e-300;
    ck_assert_int_eq(gough_simulate(n->model, &n->simulation, NULL, NULL, &end, &error),
                     GOUGH_ERROR_INPUT);
    ck_assert(strstr(error.message, "disturbance.noise.interval") != NULL);
    noise_at(n, 1, (double[12]){0});
    ck_assert(n->r.fault.what != NULL);
    free_noisy(n);
}
END_TEST

int main(void) {
    return SUITE_RUN("noise", 60, noise_has_the_size_asked_for, noise_is_twice_differentiable,
                     noise_is_a_function_of_seed_run_and_time, noise_is_the_same_in_both_precisions,
                     noise_without_an_interval_is_an_error, noise_of_a_tiny_interval_is_an_error);
}
