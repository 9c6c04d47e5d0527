/* Loops at rest whose drives lag, and continuous controllers with integrals: against the characteristic polynomials of heave, in
 * which all legs are alike, and against what holds for all modes at once. */
#include <complex.h>
#include <stdio.h>

#include "gough/floquet.h"
#include "gough/linear.h"
#include "linear/rest_model.h"
#include "support/machines.h"
#include "support/suite.h"

static gough_model *paper_model(double stiffness, double damping) {
    gough_model *model = new_model(stiffness, damping);

    paper_machine(&model->machine);
    return model;
}

static void give_lag(gough_model *model, double time_constant, double frequency, double ratio) {
    gough_actuators *a = &model->machine.platform.actuators;

    a->kind = GOUGH_ACTUATOR_LAG;
    for (int v = 0; v < 6; v++) {
        a->time_constant[v] = time_constant;
        a->frequency[v] = frequency;
        a->damping_ratio[v] = ratio;
    }
}

/* heave: ẍ = λ²x + κ f, κ = 6 h²/(M l²) */
static const double square = 0.49 / 1.49, kappa = 6 / 1.49;

/* Σ c_k s^k over the largest of its terms, at each eigenvalue of heave */
static void heave_is_root_of(const gough_rest *rest, const double *c, int degree) {
    int roots = 0;

    for (size_t k = 0; k < rest->size; k++) {
        const gough_eigenvalue *e = &rest->eigenvalue[k];
        const double complex s = e->value[0] + I * e->value[1];
        double complex sum = 0, power = 1;
        double largest = 0;

        if (strcmp(e->mode.name, "heave") != 0) continue;
        for (int i = 0; i <= degree; i++, power *= s) {
            sum += c[i] * power;
            largest = fmax(largest, cabs(c[i] * power));
        }
        ck_assert_msg(cabs(sum) <= 1e-9 * largest, "%.12g %+.12gi: %g", creal(s), cimag(s),
                      cabs(sum));
        roots++;
    }
    ck_assert_int_eq(roots, degree);
}

START_TEST(lag_of_first_order_in_heave) {
    const double G = 2, D = 0.3, lag = 0.07;
    gough_model *model = paper_model(G, D);
    give_lag(model, lag, 0, 0);
    const gough_rest rest = at_rest(model, NULL);
    /* (s² − λ²)(T_a s + 1) + κ (G + D s) */
    const double c[4] = {kappa * G - square, kappa * D - lag * square, 1, lag};

    ck_assert_int_eq((int)rest.size, 18);
    heave_is_root_of(&rest, c, 3);
    ck_assert(rest.stable && rest.decaying && rest.growing == 0);
    free(model);
}
END_TEST

START_TEST(lag_of_second_order_in_heave) {
    const double G = 2, D = 0.3, w = 2 * pi * 3, z = 0.6;
    gough_model *model = paper_model(G, D);
    give_lag(model, 0, 3, z);
    const gough_rest rest = at_rest(model, NULL);
    /* (s² − λ²)(s² + 2ζω s + ω²) + ω² κ (G + D s) */
    const double c[5] = {w * w * (kappa * G - square), w * w * kappa * D - 2 * z * w * square,
                         w * w - square, 2 * z * w, 1};

    ck_assert_int_eq((int)rest.size, 24);
    heave_is_root_of(&rest, c, 4);
    free(model);
}
END_TEST

START_TEST(integral_in_heave) {
    const double G = 2, D = 0.3, K = 0.2;

    for (int lags = 0; lags < 2; lags++) {
        gough_model *model = paper_model(G, D);
        for (int v = 0; v < 6; v++) model->control.integral[v] = K;
        if (lags) give_lag(model, 0.02, 0, 0);
        const gough_rest rest = at_rest(model, NULL);
        /* s (s² − λ²)(T_a s + 1) + κ (G s + D s² + K_I) */
        const double T = lags ? 0.02 : 0;
        const double c[5] = {kappa * K, kappa * G - square, kappa * D - T * square, 1, T};

        ck_assert_int_eq((int)rest.size, lags ? 24 : 18);
        heave_is_root_of(&rest, c, lags ? 4 : 3);
        ck_assert(rest.decaying);
        free(model);
    }
    /* only where it has a gain: an integral without one remembers, but does nothing */
    gough_model *model = paper_model(G, D);
    model->control.integral[2] = K;
    ck_assert_int_eq((int)at_rest(model, NULL).size, 13);
    /* and no further than D (G − threshold) of the mode that it makes grow */
    for (int v = 0; v < 6; v++) model->control.integral[v] = 1.2 * D * (G * kappa - square);
    ck_assert(at_rest(model, NULL).growing > 0);
    free(model);
}
END_TEST

/* (loop-9): at G = D/T_a all six modes are neutral at once, beside six that die out in T_a */
START_TEST(all_modes_are_neutral_at_once) {
    const double lag = 0.05, D = 0.3;
    gough_model *model = paper_model(D / lag, D);
    give_lag(model, lag, 0, 0);
    gough_rest rest = at_rest(model, NULL);
    int neutral = 0, fast = 0;

    for (int k = 0; k < 18; k++) {
        const double *value = rest.eigenvalue[k].value;
        if (fabs(value[0]) <= 1e-9 && fabs(value[1]) > 0.1) neutral++;
        if (fabs(value[0] + 1 / lag) <= 1e-8 && fabs(value[1]) <= 1e-8) fast++;
    }
    ck_assert_int_eq(neutral, 12);
    ck_assert_int_eq(fast, 6);
    set_gains(model, D / lag * (1 + 1e-5), D);
    rest = at_rest(model, NULL);
    ck_assert_int_eq(rest.growing, 12);
    ck_assert(!rest.stable);
    set_gains(model, D / lag * (1 - 1e-5), D);
    rest = at_rest(model, NULL);
    ck_assert(rest.stable && rest.decaying);
    /* the threshold of the paper stays */
    set_gains(model, 0.894107, D);
    ck_assert_int_eq(at_rest(model, NULL).growing, 2);
    set_gains(model, 0.894109, D);
    ck_assert(at_rest(model, NULL).decaying);
    free(model);
}
END_TEST

/* the whole matrix has the same eigenvalues: their sum is its trace, and that of their squares that of its square */
START_TEST(matrix_of_the_whole_loop) {
    gough_model *model = paper_model(2, 0.3);
    double matrix[GOUGH_LINEAR_MOST * GOUGH_LINEAR_MOST], trace[2] = {0, 0}, sum[2] = {0, 0};
    gough_error error = {0};

    give_lag(model, 0, 2, 0.5);
    for (int v = 0; v < 6; v++) model->control.integral[v] = 0.1 * (v + 1);
    const gough_rest rest = at_rest(model, NULL);
    const size_t n = gough_linear_size(model);
    ck_assert_int_eq((int)n, GOUGH_LINEAR_MOST);
    ck_assert_msg(gough_linearise(model, 0, NULL, n, matrix, &error) == GOUGH_OK, "%s",
                  error.message);
    for (size_t i = 0; i < n; i++) {
        const double complex s = rest.eigenvalue[i].value[0] + I * rest.eigenvalue[i].value[1];
        sum[0] += creal(s);
        sum[1] += creal(s * s);
        trace[0] += matrix[n * i + i];
        for (size_t j = 0; j < n; j++) trace[1] += matrix[n * i + j] * matrix[n * j + i];
    }
    for (int i = 0; i < 2; i++)
        ck_assert_msg(fabs(sum[i] - trace[i]) <= 1e-9 * fabs(trace[i]), "%.15g, not %.15g", sum[i],
                      trace[i]);
    free(model);
}
END_TEST

/* with a very short lag the loop is that of ideal drives; what is sampled does not count here */
START_TEST(limits_of_the_loop) {
    gough_model *model = paper_model(2, 0.3);
    const gough_rest ideal = at_rest(model, NULL);

    give_lag(model, 1e-8, 0, 0);
    const gough_rest late = at_rest(model, NULL);
    model->machine.platform.actuators.kind = GOUGH_ACTUATOR_IDEAL;
    model->machine.platform.actuators.max_force[0][1] = 1e-3; /* below what bears the load */
    model->control.sampling.period = 0.1;
    const gough_rest sampled = at_rest(model, NULL);
    for (int k = 0; k < 12; k++) {
        for (int i = 0; i < 2; i++) {
            const double *right = ideal.eigenvalue[k].value;
            ck_assert(fabs(late.eigenvalue[k].value[0] - right[0]) <= 1e-6);
            ck_assert(fabs(sampled.eigenvalue[k].value[i] - right[i]) <= 0);
        }
    }
    free(model);
}
END_TEST

static void refuses(gough_model *model, size_t size, const char *words) {
    double matrix[GOUGH_LINEAR_MOST * GOUGH_LINEAR_MOST];
    gough_error error = {0};

    ck_assert_int_eq(gough_linearise(model, 0, NULL, size, matrix, &error), GOUGH_ERROR_INPUT);
    ck_assert_msg(strstr(error.message, words) != NULL, "%s", error.message);
}

START_TEST(refuses_other_sizes_and_samples) {
    gough_model *model = paper_model(2, 0.3);
    gough_floquet floquet;
    gough_error error = {0};

    set_formula(&model->motion.formula[GOUGH_HEAVE], "0.1*sin(t)");
    refuses(model, 18, "has 12 rows, not 18");
    give_lag(model, 0.05, 0, 0);
    refuses(model, 12, "has 18 rows, not 12");
    model->control.sampling.period = 0.1;
    refuses(model, 18, "sampled");
    ck_assert_int_eq(gough_floquet_multipliers(model, NULL, 0, &floquet, &error),
                     GOUGH_ERROR_INPUT);
    ck_assert_msg(strstr(error.message, "sampled controller") != NULL, "%s", error.message);
    free(model);
}
END_TEST

/* The matrix at rest is that of gough_linearise() for a program that rests there; of samples its powers have the traces of the
 * powers of the multipliers. Names are those of the numbers. */
START_TEST(the_matrix_is_that_of_the_eigenvalues_and_of_the_multipliers) {
    gough_model *model = paper_model(2, 0.3);
    double A[30 * 30], B[30 * 30], trace = 0, second = 0;
    double complex sum = 0, squares = 0;
    char name[GOUGH_DEVIATION_NAME];
    gough_sampled_rest rest;
    gough_error error = {0};
    gough_unit unit;

    give_lag(model, 0, 3, 0.7);
    model->control.integral[1] = 0.4;
    const size_t n = gough_deviation_size(model);
    ck_assert_uint_eq(n, 25);
    ck_assert_int_eq(gough_matrix_at_rest(model, NULL, n, A, &error), GOUGH_OK);
    ck_assert_int_eq(gough_linearise(model, 0, NULL, n, B, &error), GOUGH_OK);
    for (size_t i = 0; i < n * n; i++) ck_assert(fabs(A[i] - B[i]) <= 0);
    ck_assert(gough_deviation_name(model, 24, name, &unit));
    ck_assert_str_eq(name, "i2");
    ck_assert(gough_deviation_name(model, 19, name, &unit) && unit == GOUGH_UNIT_FORCE_RATE);
    ck_assert_str_eq(name, "fdot2");
    ck_assert(!gough_deviation_name(model, 25, name, &unit));
    ck_assert_int_eq(gough_matrix_at_rest(model, NULL, 12, A, &error), GOUGH_ERROR_INPUT);
    ck_assert_msg(strstr(error.message, "has 25 rows, not 12") != NULL, "%s", error.message);

    give_lag(model, 0.05, 0, 0);
    model->control.integral[1] = 0;
    model->control.sampling = (gough_sampling){.period = 0.1, .delay = 0.05};
    ck_assert_uint_eq(gough_deviation_size(model), 24);
    ck_assert(gough_deviation_name(model, 20, name, &unit) && unit == GOUGH_UNIT_FORCE);
    ck_assert_str_eq(name, "u3_1");
    ck_assert_int_eq(gough_matrix_at_rest(model, NULL, 24, A, &error), GOUGH_OK);
    ck_assert_int_eq(gough_sampled_at_rest(model, NULL, &rest, &error), GOUGH_OK);
    ck_assert_uint_eq(rest.listed, 24);
    for (size_t k = 0; k < 24; k++) {
        const double complex mu = rest.multiplier[k].value[0] + I * rest.multiplier[k].value[1];
        sum += mu;
        squares += mu * mu;
        trace += A[25 * k];
        for (size_t j = 0; j < 24; j++) second += A[24 * k + j] * A[24 * j + k];
    }
    ck_assert(cabs(sum - trace) <= 1e-12 && cabs(squares - second) <= 1e-12);
    free(model);
}
END_TEST

int main(void) {
    return SUITE_RUN("linear/rest_drives", 20, lag_of_first_order_in_heave,
                     lag_of_second_order_in_heave, integral_in_heave, all_modes_are_neutral_at_once,
                     matrix_of_the_whole_loop, limits_of_the_loop, refuses_other_sizes_and_samples,
                     the_matrix_is_that_of_the_eigenvalues_and_of_the_multipliers);
}
