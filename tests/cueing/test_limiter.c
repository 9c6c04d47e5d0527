/* The limiter of the legs: the parabolas of the lengths stay within stroke, speed and acceleration whatever is wanted, also between
 * the samples. Rates that are cut are the nearest ones: they are compared with the minima on all faces of the bounds. */
#include <float.h>
#include <stdio.h>

#include "cueing/hostile.h"
#include "support/suite.h"

/* ---- the nearest rates ---- */

/* the least value over the face where each rate is free (0), at its least (1) or at its greatest (2): INFINITY if the minimum
 * of the free ones lies beyond their bounds */
static double on_face(double H[6][6], const double w[6], const double least[6],
                      const double greatest[6], int face) {
    int kind[6];
    double y[6], a[6][7];
    for (int i = 0; i < 6; i++, face /= 3) {
        kind[i] = face % 3;
        y[i] = kind[i] == 1 ? least[i] : greatest[i];
    }
    for (int r = 0; r < 6; r++) {
        for (int c = 0; c < 6; c++) a[r][c] = kind[r] ? r == c : kind[c] ? 0 : H[r][c];
        a[r][6] = kind[r] ? y[r] : 0;
        for (int c = 0; c < 6 && !kind[r]; c++)
            a[r][6] += H[r][c] * w[c] - (kind[c] ? H[r][c] * y[c] : 0);
    }
    for (int p = 0; p < 6; p++)
        for (int r = 0; r < 6; r++) {
            const double factor = r == p ? 0 : a[r][p] / a[p][p];
            for (int c = p; c < 7; c++) a[r][c] -= factor * a[p][c];
        }
    double value = 0;
    for (int i = 0; i < 6; i++) {
        y[i] = a[i][6] / a[i][i];
        if (y[i] < least[i] - 1e-12 || y[i] > greatest[i] + 1e-12) return INFINITY;
    }
    for (int r = 0; r < 6; r++)
        for (int c = 0; c < 6; c++) value += H[r][c] * (y[r] - w[r]) * (y[c] - w[c]);
    return value;
}

START_TEST(the_nearest_rates_are_the_nearest) {
    dice d = {7};
    for (int n = 0; n < 60; n++) {
        double B[6][6], H[6][6], w[6], least[6], greatest[6], y[6], own = 0, best = INFINITY;
        for (int r = 0; r < 6; r++) {
            for (int c = 0; c < 6; c++) B[r][c] = dice_between(&d, -1, 1);
            w[r] = dice_between(&d, -2, 2);
            least[r] = dice_between(&d, -1, 0);
            greatest[r] = n % 7 == r ? least[r] : dice_between(&d, 0, 1);
        }
        for (int r = 0; r < 6; r++)
            for (int c = 0; c < 6; c++) {
                H[r][c] = r == c ? 0.01 : 0;
                for (int k = 0; k < 6; k++) H[r][c] += B[r][k] * B[c][k];
            }
        nearest_rates(H, w, least, greatest, y);
        for (int r = 0; r < 6; r++) {
            ck_assert_double_ge(y[r], least[r]);
            ck_assert_double_le(y[r], greatest[r]);
            for (int c = 0; c < 6; c++) own += H[r][c] * (y[r] - w[r]) * (y[c] - w[c]);
        }
        for (int face = 0; face < 729; face++)
            best = fmin(best, on_face(H, w, least, greatest, face));
        ck_assert_double_le(own, best + 1e-12 * (1 + best));
    }
}
END_TEST

/* ---- what is wanted gently ---- */

/* a program that begins at rest at home; its pose, lengths and rates */
static void gentle(const gough_machine *m, double t, gough_state *s, double length[6],
                   double rate[6]) {
    const double size[3] = {0.05, 0.04, 0.03};
    const double angle[3] = {0.03 * (1 - cos(t)), 0.02 * (1 - cos(1.3 * t)), 0};
    const double roll = 0.03 * sin(t), pitch = 0.026 * sin(1.3 * t);
    *s = gough_state_home(m);
    for (int i = 0; i < 3; i++) {
        s->position[i] += size[i] * (1 - cos((1 + 0.2 * i) * t));
        s->velocity[i] = size[i] * (1 + 0.2 * i) * sin((1 + 0.2 * i) * t);
    }
    gough_rotation_from_angles(angle, s->rotation);
    /* ω = Ry (roll', 0, 0) + (0, pitch', 0), since there is no yaw */
    s->angular_velocity[0] = roll * cos(angle[1]);
    s->angular_velocity[1] = pitch;
    s->angular_velocity[2] = -roll * sin(angle[1]);
    ck_assert_int_eq(gough_leg_kinematics(m, s, NULL, length, rate, NULL), GOUGH_OK);
}

static double apart_by(double h) {
    gough_model *model = malloc(sizeof *model);
    hostile_machine(model);
    gough_limiter q;
    gough_state s, home = gough_state_home(&model->machine);
    double apart = 0;
    hostile_begin(&q, model, &home, h);
    for (int k = 0; k * h < 6; k++) {
        double length[6], rate[6], unused[6];
        bool limited[6];
        gough_error error = {.message = ""};
        gentle(&model->machine, k * h, &s, length, unused);
        gentle(&model->machine, (k + 1) * h, &s, unused, rate);
        ck_assert_msg(!gough_limiter_sample(&q, length, rate, limited, &error), "%s",
                      error.message);
        for (int v = 0; v < 6; v++) ck_assert(!limited[v]);
        for (int i = 0; i < 3; i++)
            if (!(fabs(q.state.position[i] - s.position[i]) <= apart)) /* NaN stays */
                apart = fabs(q.state.position[i] - s.position[i]);
    }
    free(model);
    return apart;
}

START_TEST(a_gentle_program_is_followed) {
    const double coarse = apart_by(0.02), fine = apart_by(0.01);
    printf("apart %.3g and %.3g m\n", coarse, fine);
    ck_assert_double_le(coarse, 1e-4);
    ck_assert_double_le(fine, 0.35 * coarse);
}
END_TEST

/* ---- what is wanted wildly ---- */

START_TEST(wild_records_exceed_no_bound) {
    const hostile_count count = hostile_records(300, 1);
    ck_assert_double_le(count.beyond, 1e-12);
    ck_assert_double_le(count.nearest, 1e-3); /* the stroke is used to its ends */
    ck_assert_int_gt(count.limited, 10000);
    ck_assert_int_gt(count.whole, 100);
    printf("%d records to their end, %d ended for want of a certain pose; beyond by %.2g\n",
           count.whole, count.ended, count.beyond);
}
END_TEST

/* A leg that turns round within a step is longest between the samples, (cue-9). Without that bound a leg that moves slowly outwards
 * near its end exceeds its stroke. */
START_TEST(turning_round_within_a_step_keeps_the_stroke) {
    gough_model *model = malloc(sizeof *model);
    hostile_machine(model);
    const gough_state home = gough_state_home(&model->machine);
    gough_limiter q;
    double wish[6], length[6];
    hostile_begin(&q, model, &home, 0.01);
    const double a = q.bounds.acceleration[0], room = 1e-5, rate = sqrt(2 * a * room) * 0.999;
    for (int v = 0; v < 6; v++) {
        q.bounds.length[v][1] = q.length[v] + room;
        q.rate[v] = rate;
        length[v] = q.length[v], wish[v] = 0;
    }
    ck_assert_int_eq(gough_limiter_sample(&q, length, wish, NULL, NULL), GOUGH_OK);
    for (int v = 0; v < 6; v++) {
        /* l + v t + (y − v) t²/2h is greatest at t = v h/(v − y) */
        ck_assert_double_lt(q.rate[v], 0);
        const double longest = rate * rate * 0.01 / (2 * (rate - q.rate[v]));
        ck_assert_double_le(longest, room * (1 + 1e-9));
    }
    free(model);
}
END_TEST

/* ---- refusals ---- */

START_TEST(what_cannot_be_limited_is_refused) {
    gough_model *model = malloc(sizeof *model);
    hostile_machine(model);
    const gough_state home = gough_state_home(&model->machine);
    const double about[3] = {0, 0, 1}, nowhere[3] = {0, NAN, 0};
    gough_limiter q, before;
    gough_error error = {.message = ""};
    hostile_begin(&q, model, &home, 0.01);
    const gough_leg_bounds good = q.bounds;
    for (int i = 0; i < 6; i++) {
        gough_leg_bounds b = good;
        if (i == 0) b.length[2][1] = INFINITY;
        if (i == 1) b.length[3][0] = b.length[3][1];
        if (i == 2) b.speed[1] = 0;
        if (i == 3) b.acceleration[5] = INFINITY;
        if (i == 4) b.length[0][0] = -1;
        if (i == 5) b.acceleration[0] = NAN;
        ck_assert_int_eq(gough_limiter_begin(&q, sizeof q, &model->machine, &b, about, 0.3, 10,
                                             0.01, &home, &error),
                         GOUGH_ERROR_INPUT);
        ck_assert_ptr_nonnull(strstr(error.message, "each leg needs a least and a greatest"));
    }
    const double numbers[][3] = {{0, 10, 0.01},     {0.3, -1, 0.01}, {0.3, 100, 0.01},
                                 {0.3, 10, 0},      {NAN, 10, 0.01}, {INFINITY, 10, 0.01},
                                 {0.3, 0, INFINITY}};
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++)
        ck_assert_int_eq(gough_limiter_begin(&q, sizeof q, &model->machine, &good, about,
                                             numbers[i][0], numbers[i][1], numbers[i][2], &home,
                                             &error),
                         GOUGH_ERROR_INPUT);
    ck_assert_int_eq(gough_limiter_begin(&q, sizeof q, &model->machine, &good, nowhere, 0.3, 10,
                                         0.01, &home, &error),
                     GOUGH_ERROR_INPUT);
    ck_assert_int_eq(
        gough_limiter_begin(&q, 1, &model->machine, &good, about, 0.3, 10, 0.01, &home, &error),
        GOUGH_ERROR_INPUT);
    gough_state far = home;
    far.position[2] += 5;
    ck_assert_int_eq(gough_limiter_begin(&q, sizeof q, &model->machine, &good, about, 0.3, 10, 0.01,
                                         &far, &error),
                     GOUGH_ERROR_INPUT);
    ck_assert_str_eq(error.message, "leg 1 is not within its stroke where the platform rests");
    far.position[2] -= 7; /* 2 below home */
    ck_assert_int_eq(gough_limiter_begin(&q, sizeof q, &model->machine, &good, about, 0.3, 10, 0.01,
                                         &far, &error),
                     GOUGH_ERROR_INPUT);
    far = home, far.rotation[0][0] = 2;
    ck_assert_int_eq(gough_limiter_begin(&q, sizeof q, &model->machine, &good, about, 0.3, 10, 0.01,
                                         &far, &error),
                     GOUGH_ERROR_INPUT);

    hostile_begin(&q, model, &home, 0.01);
    memcpy(&before, &q, sizeof q);
    double wish[6] = {0, 0, 0, NAN, 0, 0}, length[6];
    memcpy(length, q.length, sizeof length);
    ck_assert_int_eq(gough_limiter_sample(&q, length, wish, NULL, &error), GOUGH_ERROR_INPUT);
    ck_assert_mem_eq(&before, &q, sizeof q);
    free(model);
}
END_TEST

int main(void) {
    return SUITE_RUN("cueing/limiter", 60, the_nearest_rates_are_the_nearest,
                     a_gentle_program_is_followed, wild_records_exceed_no_bound,
                     turning_round_within_a_step_keeps_the_stroke,
                     what_cannot_be_limited_is_refused);
}
