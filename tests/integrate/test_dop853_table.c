/* The coefficients of DOP853 against the theory of order: all conditions of rooted trees for the
 * step, its error weights and its dense output, and the orders observed on an equation with a known
 * solution.
 */
#include <check.h>
#include <math.h>
#include <stdlib.h>

#define NUMBER_QUAD
#include "integrate/dop853_table.h"

/* Weights of the step reach 6, rows of stages 43: what the conditions leave after cancelling is
 * some ten to a hundred roundings. The thirty digits in print leave 3e-29, far more. */
#define STEP_TOLERANCE (300 * REAL_EPSILON)
/* weights of dense output reach 528; the digits in print leave 2e-26 */
#define DENSE_TOLERANCE (3000 * REAL_EPSILON)

enum { SLOPES = 16, MOST_ORDER = 8, MOST_TREES = 200 };

static real magnitude(real x) { return x < 0 ? -x : x; }

static real power(real x, int exponent) {
    real product = 1;
    for (int i = 0; i < exponent; i++) product *= x;
    return product;
}

/* ---- rooted trees ---- */

/* A root with smaller trees on it, by number, largest first. The density is the product, over all
 * nodes, of the order of what stands on them. */
typedef struct {
    int order, children, child[MOST_ORDER - 1];
    int density;
} tree;

/* all trees by order, and for each the product, over what it bears, of a times their products */
typedef struct {
    int count;
    tree trees[MOST_TREES];
    real phi[MOST_TREES][SLOPES];
} wood;

/* grow all trees that begin as `start` does and bear `room` more nodes, on trees up to `most` */
static void grow(wood *w, tree start, int room, int most) {
    if (room == 0) {
        ck_assert_int_lt(w->count, MOST_TREES);
        w->trees[w->count++] = start;
        return;
    }
    for (int i = most; i >= 0; i--) {
        const tree *bough = &w->trees[i];
        if (bough->order > room) continue;
        tree next = start;
        next.child[next.children++] = i;
        next.density *= bough->density;
        grow(w, next, room - bough->order, i);
    }
}

static void weigh(wood *w, int index) {
    const tree *t = &w->trees[index];
    for (int i = 0; i < SLOPES; i++) {
        real product = 1;
        for (int k = 0; k < t->children; k++) {
            real sum = 0;
            for (int j = 0; j < i; j++) sum += dop853_a[i][j] * w->phi[t->child[k]][j];
            product *= sum;
        }
        w->phi[index][i] = product;
    }
}

static wood *all_trees(void) {
    wood *w = calloc(1, sizeof *w);
    ck_assert_ptr_nonnull(w);
    for (int order = 1; order <= MOST_ORDER; order++) {
        const tree root = {.order = order, .density = order};
        grow(w, root, order - 1, w->count - 1);
    }
    for (int i = 0; i < w->count; i++) weigh(w, i);
    return w;
}

static real weighed_by(const real *weights, int stages, const real *phi) {
    real sum = 0;
    for (int i = 0; i < stages; i++) sum += weights[i] * phi[i];
    return sum;
}

/* the largest sum of weights on trees of one order, to be zero for weights of a difference */
static real largest_on_order(const wood *w, const real *weights, int order) {
    real largest = 0;
    for (int i = 0; i < w->count; i++) {
        const real sum = magnitude(weighed_by(weights, DOP853_STAGES, w->phi[i]));
        if (w->trees[i].order != order) continue;
        ck_assert(sum < 1); /* nor is it no number */
        if (sum > largest) largest = sum;
    }
    return largest;
}

START_TEST(counts_of_trees_are_known) {
    static const int counts[MOST_ORDER + 1] = {0, 1, 1, 2, 4, 9, 20, 48, 115};
    wood *w = all_trees();
    int found[MOST_ORDER + 1] = {0};
    for (int i = 0; i < w->count; i++) found[w->trees[i].order]++;
    for (int order = 1; order <= MOST_ORDER; order++) {
        ck_assert_int_eq(found[order], counts[order]);
    }
    free(w);
}
END_TEST

/* ---- the step ---- */

START_TEST(place_of_each_slope_is_the_sum_of_its_row) {
    for (int i = 0; i < SLOPES; i++) {
        real sum = 0;
        for (int j = 0; j < SLOPES - 1; j++) sum += dop853_a[i][j];
        ck_assert(magnitude(sum - dop853_c[i]) <= STEP_TOLERANCE);
    }
}
END_TEST

START_TEST(rows_use_earlier_slopes_only) {
    for (int i = 0; i < SLOPES; i++) {
        for (int j = i; j < SLOPES - 1; j++) ck_assert(!(magnitude(dop853_a[i][j]) > 0));
    }
}
END_TEST

START_TEST(row_after_the_stages_is_the_step) {
    for (int j = 0; j < DOP853_STAGES; j++) {
        ck_assert(!(magnitude(dop853_a[DOP853_STAGES][j] - dop853_b[j]) > 0));
    }
}
END_TEST

/* sum b c^k = 1/(k+1) */
START_TEST(step_integrates_powers_to_the_seventh) {
    for (int k = 0; k < MOST_ORDER; k++) {
        real sum = 0;
        for (int i = 0; i < DOP853_STAGES; i++) sum += dop853_b[i] * power(dop853_c[i], k);
        ck_assert(magnitude(sum - (real)1 / (k + 1)) <= STEP_TOLERANCE);
    }
}
END_TEST

/* b a^(n-1) 1 = 1/n!, the step on y' = y */
START_TEST(step_agrees_with_the_exponential_series) {
    real chain[DOP853_STAGES], next[DOP853_STAGES], factorial = 1;
    for (int i = 0; i < DOP853_STAGES; i++) chain[i] = 1;
    for (int n = 1; n <= MOST_ORDER; n++) {
        factorial *= n;
        const real sum = weighed_by(dop853_b, DOP853_STAGES, chain);
        ck_assert(magnitude(sum - 1 / factorial) <= STEP_TOLERANCE);
        for (int i = 0; i < DOP853_STAGES; i++) next[i] = weighed_by(dop853_a[i], i, chain);
        for (int i = 0; i < DOP853_STAGES; i++) chain[i] = next[i];
    }
}
END_TEST

START_TEST(step_meets_all_conditions_of_order_8) {
    wood *w = all_trees();
    ck_assert_int_eq(w->count, MOST_TREES);
    for (int i = 0; i < w->count; i++) {
        const real sum = weighed_by(dop853_b, DOP853_STAGES, w->phi[i]);
        ck_assert(magnitude(sum - (real)1 / w->trees[i].density) <= STEP_TOLERANCE);
    }
    free(w);
}
END_TEST

/* ---- error weights ---- */

START_TEST(error_weights_vanish_to_their_order_and_not_beyond) {
    wood *w = all_trees();
    for (int order = 1; order <= 5; order++) {
        ck_assert(largest_on_order(w, dop853_error5, order) <= STEP_TOLERANCE);
    }
    ck_assert(largest_on_order(w, dop853_error5, 6) > (real)1e-4);
    for (int order = 1; order <= 3; order++) {
        ck_assert(largest_on_order(w, dop853_error3, order) <= STEP_TOLERANCE);
    }
    ck_assert(largest_on_order(w, dop853_error3, 4) > (real)1e-2);
    free(w);
}
END_TEST

/* the embedded step of order 3 uses three slopes, at 0, 127/195 and 1 */
START_TEST(embedded_step_of_order_3_has_three_weights) {
    for (int j = 0; j < DOP853_STAGES; j++) {
        const real weight = dop853_b[j] - dop853_error3[j];
        const real wanted = j == 0    ? (real)31 / 127
                            : j == 8  ? (real)12675 / 17272
                            : j == 11 ? (real)3 / 136
                                      : 0;
        ck_assert(magnitude(weight - wanted) <= 8 * REAL_EPSILON);
    }
}
END_TEST

/* ---- dense output ---- */

/* weights of the slopes in (y(theta) - y0) / h */
static void dense_weights(real theta, real weights[SLOPES]) {
    const real s = theta, t = 1 - theta;
    for (int i = 0; i < SLOPES; i++) {
        const real first = i == 0, last = i == DOP853_STAGES;
        const real dy = i < DOP853_STAGES ? dop853_b[i] : 0, p = first - dy, q = dy - last - p;
        const real r =
            dop853_d[0][i] + s * (dop853_d[1][i] + t * (dop853_d[2][i] + s * dop853_d[3][i]));
        weights[i] = s * (dy + t * (p + s * (q + t * r)));
    }
}

/* A polynomial of degree 7 that is zero at 0 is zero when it is so at seven places more. */
START_TEST(dense_output_meets_all_conditions_of_order_7_at_every_place) {
    wood *w = all_trees();
    for (int k = 1; k <= 8; k++) {
        real weights[SLOPES];
        const real theta = (real)k / 8;
        dense_weights(theta, weights);
        for (int i = 0; i < w->count; i++) {
            const tree *t = &w->trees[i];
            if (t->order > 7) continue;
            const real sum = weighed_by(weights, SLOPES, w->phi[i]);
            ck_assert(magnitude(sum - power(theta, t->order) / t->density) <= DENSE_TOLERANCE);
        }
    }
    free(w);
}
END_TEST

START_TEST(dense_output_ends_in_the_step) {
    real weights[SLOPES];
    dense_weights(1, weights);
    for (int i = 0; i < SLOPES; i++) {
        const real b = i < DOP853_STAGES ? dop853_b[i] : 0;
        ck_assert(magnitude(weights[i] - b) <= STEP_TOLERANCE);
    }
}
END_TEST

/* ---- observed orders, on y' = -2 t y^2 with y = 1/(1 + t^2) ---- */

static real slope(real t, real y) { return -2 * t * y * y; }
static real solution(real t) { return 1 / (1 + t * t); }

static void slopes_of_step(real t, real y, real h, real k[SLOPES]) {
    for (int i = 0; i < SLOPES; i++) {
        k[i] = slope(t + dop853_c[i] * h, y + h * weighed_by(dop853_a[i], i, k));
    }
}

/* error at t = 1 after equal steps from t = 0 */
static double error_of_steps(int steps) {
    const real h = (real)1 / steps;
    real y = solution(0), k[SLOPES];
    for (int n = 0; n < steps; n++) {
        slopes_of_step(n * h, y, h, k);
        y += h * weighed_by(dop853_b, DOP853_STAGES, k);
    }
    return fabs((double)(y - solution(1)));
}

/* error of dense output at a third of one step from t = 1/2 */
static double error_of_dense_output(int steps) {
    const real t = (real)1 / 2, h = (real)1 / steps, theta = (real)1 / 3;
    real k[SLOPES], weights[SLOPES];
    slopes_of_step(t, solution(t), h, k);
    dense_weights(theta, weights);
    const real y = solution(t) + h * weighed_by(weights, SLOPES, k);
    return fabs((double)(y - solution(t + theta * h)));
}

static double estimate(const real *weights, int steps) {
    const real t = (real)1 / 2, h = (real)1 / steps;
    real k[SLOPES];
    slopes_of_step(t, solution(t), h, k);
    return fabs((double)(h * weighed_by(weights, DOP853_STAGES, k)));
}

static double estimate_of_order_5(int steps) { return estimate(dop853_error5, steps); }
static double estimate_of_order_3(int steps) { return estimate(dop853_error3, steps); }

/* The error halves with the step as its order says, up to the next term, which halves likewise. */
static void assert_observed_order(double (*error)(int steps), int steps, double order) {
    double before = error(steps);
    for (int halving = 1; halving <= 4; halving++) {
        steps *= 2;
        const double after = error(steps);
        if (halving >= 3) ck_assert_double_eq_tol(log2(before / after), order, 0.15);
        before = after;
    }
}

START_TEST(step_has_order_8) { assert_observed_order(error_of_steps, 8, 8); }
END_TEST

/* one step: an order more than after many */
START_TEST(dense_output_has_local_order_8) { assert_observed_order(error_of_dense_output, 8, 8); }
END_TEST

START_TEST(estimates_have_local_orders_6_and_4) {
    assert_observed_order(estimate_of_order_5, 8, 6);
    assert_observed_order(estimate_of_order_3, 8, 4);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("dop853_table");
    TCase *cases = tcase_create("order");
    tcase_add_test(cases, counts_of_trees_are_known);
    tcase_add_test(cases, place_of_each_slope_is_the_sum_of_its_row);
    tcase_add_test(cases, rows_use_earlier_slopes_only);
    tcase_add_test(cases, row_after_the_stages_is_the_step);
    tcase_add_test(cases, step_integrates_powers_to_the_seventh);
    tcase_add_test(cases, step_agrees_with_the_exponential_series);
    tcase_add_test(cases, step_meets_all_conditions_of_order_8);
    tcase_add_test(cases, error_weights_vanish_to_their_order_and_not_beyond);
    tcase_add_test(cases, embedded_step_of_order_3_has_three_weights);
    tcase_add_test(cases, dense_output_meets_all_conditions_of_order_7_at_every_place);
    tcase_add_test(cases, dense_output_ends_in_the_step);
    tcase_add_test(cases, step_has_order_8);
    tcase_add_test(cases, dense_output_has_local_order_8);
    tcase_add_test(cases, estimates_have_local_orders_6_and_4);
    suite_add_tcase(suite, cases);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
