/* Box tests against interval arithmetic with outward rounding (MPFI, 160 bits), in another formulation: the lengths in all poses
 * of a box at once, from intervals of sines and cosines, cut into parts. What one proves, the other must not contradict.
 * Not sanitized: the library of intervals is not ours, and test_boxes.c runs the same functions.
 * Libraries: mpfi mpfr gmp */
#include <mpfi.h>
#include <stdio.h>

#include "support/suite.h"
#include "workspace/flight.h"

enum { BITS = 160, MOST_PARTS = 4000 };

typedef struct interval_pose {
    mpfi_t R[3][3], t[3], sine[3], cosine[3], x, y, z;
} interval_pose;

static void each(interval_pose *p, void (*go)(mpfi_ptr)) {
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) go(p->R[i][j]);
        go(p->t[i]), go(p->sine[i]), go(p->cosine[i]);
    }
    go(p->x), go(p->y), go(p->z);
}
static void start(mpfi_ptr x) { mpfi_init2(x, BITS); }
static void end(mpfi_ptr x) { mpfi_clear(x); }

/* to = a b c, with −1 for a sign */
static void product(mpfi_ptr to, mpfi_srcptr a, mpfi_srcptr b, mpfi_srcptr c) {
    mpfi_mul(to, a, b);
    if (c) mpfi_mul(to, to, c);
}

/* R = Rz Ry Rx, written out */
static void rotate(interval_pose *p) {
    mpfi_t *s = p->sine, *c = p->cosine;
    mpfi_t part;
    start(part);
    product(p->R[0][0], c[2], c[1], NULL);
    product(p->R[1][0], s[2], c[1], NULL);
    mpfi_neg(p->R[2][0], s[1]);
    for (int k = 0; k < 2; k++) {
        /* column 1: (cz sy sx − sz cx, sz sy sx + cz cx, cy sx); column 2 with sx → cx, cx → −sx */
        mpfi_srcptr sx = k ? c[0] : s[0], cx = k ? s[0] : c[0];
        product(p->R[0][1 + k], c[2], s[1], sx);
        product(part, s[2], cx, NULL);
        (k ? mpfi_add : mpfi_sub)(p->R[0][1 + k], p->R[0][1 + k], part);
        product(p->R[1][1 + k], s[2], s[1], sx);
        product(part, c[2], cx, NULL);
        (k ? mpfi_sub : mpfi_add)(p->R[1][1 + k], p->R[1][1 + k], part);
        product(p->R[2][1 + k], c[1], sx, NULL);
    }
    end(part);
}

/* all squared lengths of a leg over the box, to p->x */
static void square_of(const gough_model *model, interval_pose *p, int v) {
    const double *b = model->machine.platform.top[v], *a = model->machine.platform.base[v];
    mpfi_set_d(p->x, 0);
    for (int i = 0; i < 3; i++) {
        mpfi_set(p->y, p->t[i]);
        for (int j = 0; j < 3; j++) {
            mpfi_mul_d(p->z, p->R[i][j], b[j]);
            mpfi_add(p->y, p->y, p->z);
        }
        mpfi_sub_d(p->y, p->y, a[i]);
        if (i == 2) mpfi_add_d(p->y, p->y, model->machine.platform.height);
        mpfi_sqr(p->y, p->y);
        mpfi_add(p->x, p->x, p->y);
    }
}

/* of a box: 1 if intervals prove that all lengths are kept, −1 if they prove that one is exceeded in every pose, else 0 */
static int lengths_by_intervals(const gough_model *model, const gough_reach *reach,
                                const gough_box *box, interval_pose *p) {
    bool inside = true, outside = false;
    for (int k = 0; k < 3; k++) {
        mpfi_interv_d(p->t[k], box->least[k], box->greatest[k]);
        mpfi_interv_d(p->x, box->least[3 + k], box->greatest[3 + k]);
        mpfi_sin(p->sine[k], p->x);
        mpfi_cos(p->cosine[k], p->x);
    }
    rotate(p);
    for (int v = 0; v < GOUGH_LEGS; v++) {
        const double *limit = reach->limits.length[v];
        square_of(model, p, v);
        mpfi_sqrt(p->x, p->x);
        inside &= mpfi_cmp_d(p->x, limit[0]) > 0 && mpfi_cmp_d(p->x, limit[1]) < 0;
        outside |= mpfi_cmp_d(p->x, limit[0] * (1 - 2e-12)) < 0 ||
                   mpfi_cmp_d(p->x, limit[1] * (1 + 2e-12)) > 0;
    }
    return inside ? 1 : outside ? -1 : 0;
}

/* the same with the box cut into parts: 1 if all are inside, −1 if one is outside */
static int cut(const gough_model *model, const gough_reach *reach, const gough_box *box,
               interval_pose *p, int *left) {
    const int whole = lengths_by_intervals(model, reach, box, p);
    int side = 0;
    if (whole != 0 || --*left <= 0) return whole;
    for (int c = 1; c < GOUGH_COMPONENTS; c++)
        if (box->greatest[c] - box->least[c] > box->greatest[side] - box->least[side]) side = c;
    gough_box half[2] = {*box, *box};
    half[0].greatest[side] = half[1].least[side] = 0.5 * (box->least[side] + box->greatest[side]);
    const int one = cut(model, reach, &half[0], p, left);
    if (one < 0) return one;
    const int other = cut(model, reach, &half[1], p, left);
    return other < 0 ? other : one && other;
}

static gough_box random_box(dice *d) {
    gough_box box;
    const double size = pow(10, dice_between(d, -4, -0.7));
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        const double at = dice_between(d, -0.35, 0.35), half = size * dice_between(d, 0.1, 0.4);
        box.least[c] = at - half, box.greatest[c] = at + half;
    }
    return box;
}

START_TEST(interval_arithmetic_contradicts_no_box) {
    gough_model *model = malloc(sizeof *model);
    dice d = {61};
    interval_pose p;
    int proved[2] = {0, 0}, agreed = 0;
    flight_machine(model);
    gough_reach reach = flight_reach(model);
    for (int v = 0; v < GOUGH_LEGS; v++)
        reach.limits.base_swing[v] = reach.limits.top_swing[v] = INFINITY;
    each(&p, start);
    for (int n = 0; n < 1500; n++) {
        const gough_box box = random_box(&d);
        gough_certificate found;
        int left = MOST_PARTS / 20;
        const gough_verdict verdict = gough_box_test(&reach, &box, NULL);
        const int by_intervals = cut(model, &reach, &box, &p, &left);
        if (by_intervals != 0) proved[by_intervals > 0]++;
        ck_assert_msg(!(verdict == GOUGH_INSIDE && by_intervals < 0), "box %d of seed 61", n);
        ck_assert_msg(!(verdict == GOUGH_OUTSIDE && by_intervals > 0), "box %d of seed 61", n);
        ck_assert(gough_box_certify(&reach, &box, &found, NULL) == GOUGH_OK);
        ck_assert_msg(!(found.verdict == GOUGH_INSIDE && by_intervals < 0), "box %d", n);
        ck_assert_msg(!(found.verdict == GOUGH_OUTSIDE && by_intervals > 0 &&
                        found.binding.bind != GOUGH_BIND_SINGULAR),
                      "box %d", n);
        agreed += by_intervals != 0 && verdict != GOUGH_UNDECIDED;
    }
    printf("proved by intervals: %d outside, %d inside; by both: %d\n", proved[0], proved[1],
           agreed);
    ck_assert(proved[0] > 200 && proved[1] > 200 && agreed > 400);
    each(&p, end);
    free(model);
}
END_TEST

/* the largest box: corners of it, and poses so near the one that stops it that rounding matters */
START_TEST(interval_arithmetic_agrees_at_the_edge) {
    gough_model *model = malloc(sizeof *model);
    dice d = {62};
    interval_pose p;
    flight_machine(model);
    gough_reach reach = flight_reach(model);
    each(&p, start);
    for (int n = 0; n < 200; n++) {
        const double home[GOUGH_COMPONENTS] = {0, 0, 0, 0, 0, 0};
        double direction[GOUGH_COMPONENTS];
        gough_ray ray;
        for (int v = 0; v < GOUGH_LEGS; v++)
            reach.limits.base_swing[v] = reach.limits.top_swing[v] = INFINITY;
        for (int c = 0; c < GOUGH_COMPONENTS; c++) direction[c] = dice_between(&d, -1, 1);
        ck_assert(gough_workspace_ray(&reach, home, direction, &ray, NULL) == GOUGH_OK);
        for (int i = -2; i <= 2; i++) {
            const double at = ray.reach + 5e-9 * i;
            gough_box one;
            for (int c = 0; c < GOUGH_COMPONENTS; c++)
                one.least[c] = one.greatest[c] = at * direction[c];
            const int by_intervals = lengths_by_intervals(model, &reach, &one, &p);
            const gough_verdict verdict = gough_box_test(&reach, &one, NULL);
            ck_assert_msg(!(verdict == GOUGH_INSIDE && by_intervals < 0) &&
                              !(verdict == GOUGH_OUTSIDE && by_intervals > 0),
                          "line %d of seed 62 at %d", n, i);
            if (i <= 0) ck_assert(by_intervals >= 0 && verdict == GOUGH_INSIDE);
        }
    }
    each(&p, end);
    free(model);
}
END_TEST

int main(void) {
    return SUITE_RUN("intervals", 120, interval_arithmetic_contradicts_no_box,
                     interval_arithmetic_agrees_at_the_edge);
}
