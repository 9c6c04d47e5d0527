/* The weights of symmetric compositions against the algebra of composed flows, and the orders
 * observed with a step of Stormer and Verlet on a motion with a known solution.
 */
#include <check.h>
#include <math.h>
#include <stdlib.h>

#define NUMBER_QUAD
#include "integrate/composition.h"

/* products of up to seventeen factors, weights below one */
#define TOLERANCE (16 * REAL_EPSILON)

enum { ROWS = 4, MOST_GRADE = 7, MOST_WORDS = 40 };

static real magnitude(real x) { return x < 0 ? -x : x; }

static real power(real x, int exponent) {
    real product = 1;
    for (int i = 0; i < exponent; i++) product *= x;
    return product;
}

/* ---- series in letters that do not commute ----
 *
 * A symmetric step of order 2 and length g h is exp(g h Y1 + (g h)^3 Y3 + (g h)^5 Y5 + ...) for
 * some operators Y. Composed steps are the product of such series; the order is p when the product
 * equals exp(h Y1) in all words of grade up to p. The grade of a word is the sum of its letters,
 * which are 1, 3, 5, 7.
 */
typedef struct {
    int length, grade, letter[MOST_GRADE];
} word;

typedef struct {
    int count;
    word words[MOST_WORDS];
} words;

typedef struct {
    real of[MOST_WORDS];
} series;

static void spell(words *all, word start) {
    ck_assert_int_lt(all->count, MOST_WORDS);
    all->words[all->count++] = start;
    for (int letter = 1; letter + start.grade <= MOST_GRADE; letter += 2) {
        word next = start;
        next.letter[next.length++] = letter;
        next.grade += letter;
        spell(all, next);
    }
}

static words all_words(void) {
    words all = {0};
    spell(&all, (word){0});
    return all;
}

/* the number of the word that stands in w from letter `begin` up to letter `end` */
static int number_of_part(const words *all, const word *w, int begin, int end) {
    for (int i = 0; i < all->count; i++) {
        const word *v = &all->words[i];
        if (v->length != end - begin) continue;
        int same = 0;
        while (same < v->length && v->letter[same] == w->letter[begin + same]) same++;
        if (same == v->length) return i;
    }
    ck_abort_msg("every part of a word is a word");
    return -1;
}

static series step_series(const words *all, real g) {
    series s;
    for (int i = 0; i < all->count; i++) {
        real factorial = 1;
        for (int k = 2; k <= all->words[i].length; k++) factorial *= k;
        s.of[i] = power(g, all->words[i].grade) / factorial;
    }
    return s;
}

static series product(const words *all, const series *a, const series *b) {
    series s;
    for (int i = 0; i < all->count; i++) {
        const word *w = &all->words[i];
        s.of[i] = 0;
        for (int cut = 0; cut <= w->length; cut++) {
            s.of[i] += a->of[number_of_part(all, w, 0, cut)] *
                       b->of[number_of_part(all, w, cut, w->length)];
        }
    }
    return s;
}

/* the largest distance of a composition from exp(Y1) in words of one grade */
static real distance_in_grade(int row, int grade) {
    const words all = all_words();
    series s = step_series(&all, 0);
    for (int i = 0; i < composition_stages[row]; i++) {
        const series next = step_series(&all, composition_weights[row][i]);
        s = product(&all, &s, &next);
    }
    const series one = step_series(&all, 1);
    real largest = 0;
    for (int i = 0; i < all.count; i++) {
        const word *w = &all.words[i];
        if (w->grade != grade) continue;
        /* exp(Y1) knows the letter 1 only */
        const real wanted = w->length == w->grade ? one.of[i] : 0;
        const real distance = magnitude(s.of[i] - wanted);
        ck_assert(distance < 2); /* nor is it no number */
        if (distance > largest) largest = distance;
    }
    return largest;
}

START_TEST(composed_series_agree_with_the_flow_to_their_order) {
    const int row = _i, order = 2 * _i + 2;
    /* even grades follow from symmetry, so that grade 7 is enough for order 8 */
    for (int grade = 0; grade <= order && grade <= MOST_GRADE; grade++) {
        ck_assert(distance_in_grade(row, grade) <= TOLERANCE);
    }
}
END_TEST

START_TEST(composed_series_do_not_agree_beyond_their_order) {
    const int row = _i, order = 2 * _i + 2;
    ck_assert(distance_in_grade(row, order + 1) > (real)1e-6);
}
END_TEST

/* ---- sums ---- */

/* sum g = 1, and sum g^k = 0 for odd k below the order: the words of one letter */
START_TEST(sums_of_odd_powers_vanish) {
    const int row = _i, order = 2 * _i + 2;
    for (int k = 1; k < order; k += 2) {
        real sum = 0;
        for (int i = 0; i < composition_stages[row]; i++) {
            sum += power(composition_weights[row][i], k);
        }
        ck_assert(magnitude(sum - (k == 1)) <= TOLERANCE);
    }
}
END_TEST

START_TEST(weights_are_symmetric) {
    const int stages = composition_stages[_i];
    for (int i = 0; i < stages; i++) {
        const real *weights = composition_weights[_i];
        ck_assert(!(magnitude(weights[i] - weights[stages - 1 - i]) > 0));
    }
}
END_TEST

START_TEST(stages_stay_in_the_step) {
    real sum = 0;
    for (int i = 0; i < composition_stages[_i]; i++) {
        sum += composition_weights[_i][i];
        ck_assert(sum >= 0 && sum <= 1 + TOLERANCE);
    }
}
END_TEST

START_TEST(five_stages_are_of_suzuki) {
    /* 1/(4 - 4^(1/3)) is a root of (4 x - 1)^3 = 4 x^3 */
    const real x = composition_weights[1][0];
    ck_assert(magnitude(power(4 * x - 1, 3) - 4 * power(x, 3)) <= TOLERANCE);
}
END_TEST

/* ---- observed orders, on q'' = 2 q^3 with q = 1/(2 - t), p = q' = q^2 ---- */

static void verlet(real h, real *q, real *p) {
    *p += h * *q * *q * *q;
    *q += h * *p;
    *p += h * *q * *q * *q;
}

/* error in q at t = 1, where q is 1, after equal steps from t = 0 */
static double error_of_steps(int row, int steps) {
    const real h = (real)1 / steps;
    real q = (real)1 / 2, p = (real)1 / 4;
    for (int n = 0; n < steps; n++) {
        for (int i = 0; i < composition_stages[row]; i++) {
            verlet(composition_weights[row][i] * h, &q, &p);
        }
    }
    return fabs((double)(q - 1));
}

START_TEST(compositions_have_their_order) {
    int steps = 8;
    double before = error_of_steps(_i, steps);
    for (int halving = 1; halving <= 4; halving++) {
        steps *= 2;
        const double after = error_of_steps(_i, steps);
        /* errors come in even powers of the step, so that the next term is small by then */
        if (halving >= 3) ck_assert_double_eq_tol(log2(before / after), 2 * _i + 2, 0.15);
        before = after;
    }
}
END_TEST

int main(void) {
    Suite *suite = suite_create("composition");
    TCase *cases = tcase_create("order");
    tcase_add_loop_test(cases, composed_series_agree_with_the_flow_to_their_order, 0, ROWS);
    tcase_add_loop_test(cases, composed_series_do_not_agree_beyond_their_order, 0, ROWS - 1);
    tcase_add_loop_test(cases, sums_of_odd_powers_vanish, 0, ROWS);
    tcase_add_loop_test(cases, weights_are_symmetric, 0, ROWS);
    tcase_add_loop_test(cases, stages_stay_in_the_step, 0, ROWS);
    tcase_add_test(cases, five_stages_are_of_suzuki);
    tcase_add_loop_test(cases, compositions_have_their_order, 0, ROWS);
    suite_add_tcase(suite, cases);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
