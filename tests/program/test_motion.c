/* Programs: minimum-jerk moves, splines through samples, units of angles. */
#include <check.h>
#include <math.h>
#include <string.h>

#define NUMBER_QUAD
#include "program/helpers.h"
#include "program/program.h"

enum { MAX_ROWS = 400 };

static void evaluate(const gough_motion *motion, double t, double out[GOUGH_COMPONENTS][3]) {
    gough_motion_evaluate(motion, t, out);
}

static void close_to(const double found[3], double v, double d, double dd, double tolerance) {
    const double right[3] = {v, d, dd};
    for (int k = 0; k < 3; k++)
        ck_assert_msg(fabs(found[k] - right[k]) <= tolerance, "derivative %d: %.17g, not %.17g", k,
                      found[k], right[k]);
}

/* ---- moves ---- */

static const gough_move MOVES[] = {
    {.start = 1,
     .duration = 2,
     .target = {[GOUGH_HEAVE] = 0.1, [GOUGH_YAW] = 0.5},
     .given = {[GOUGH_HEAVE] = true, [GOUGH_YAW] = true}},
    {.start = 4,
     .duration = 0.5,
     .target = {[GOUGH_HEAVE] = -0.2},
     .given = {[GOUGH_HEAVE] = true}},
};
static const gough_motion MOVING = {.kind = GOUGH_MOTION_MOVES, .move = MOVES, .moves = 2};

START_TEST(moves_start_and_end_at_rest) {
    double c[GOUGH_COMPONENTS][3];
    const double at[] = {-1, 0, 1};
    for (int i = 0; i < 3; i++) {
        evaluate(&MOVING, at[i], c);
        for (int k = 0; k < GOUGH_COMPONENTS; k++) close_to(c[k], 0, 0, 0, 0);
    }
    evaluate(&MOVING, 3, c);
    close_to(c[GOUGH_HEAVE], 0.1, 0, 0, 0);
    close_to(c[GOUGH_YAW], 0.5, 0, 0, 0);
    close_to(c[GOUGH_SURGE], 0, 0, 0, 0);
    evaluate(&MOVING, 4.5, c);
    close_to(c[GOUGH_HEAVE], -0.2, 0, 0, 0);
    evaluate(&MOVING, 100, c);
    close_to(c[GOUGH_HEAVE], -0.2, 0, 0, 0);
    close_to(c[GOUGH_YAW], 0.5, 0, 0, 0); /* not named by the second move: kept */
}
END_TEST

/* half way: half the distance, at the peak speed 15/8 of the mean, without acceleration */
START_TEST(moves_are_of_minimum_jerk) {
    double c[GOUGH_COMPONENTS][3];
    evaluate(&MOVING, 2, c);
    close_to(c[GOUGH_HEAVE], 0.05, 0.1 / 2 * 15 / 8, 0, 1e-16);
    evaluate(&MOVING, 4.25, c);
    close_to(c[GOUGH_HEAVE], -0.05, -0.3 / 0.5 * 15 / 8, 0, 1e-15);
    /* a quarter through 10 s³ − 15 s⁴ + 6 s⁵, by its derivatives 30 s²(1−s)² and 60 s(1−s)(1−2s) */
    evaluate(&MOVING, 1.5, c);
    close_to(c[GOUGH_HEAVE], 0.1 * (10 / 64. - 15 / 256. + 6 / 1024.), 0.05 * 30 * 9 / 256.,
             0.025 * 60 * 3 / 32., 1e-16);
}
END_TEST

START_TEST(moves_join_smoothly) {
    double before[GOUGH_COMPONENTS][3], after[GOUGH_COMPONENTS][3];
    const double joints[] = {1, 3, 4, 4.5}, h = 1e-9;
    for (int i = 0; i < 4; i++) {
        evaluate(&MOVING, joints[i] - h, before);
        evaluate(&MOVING, joints[i] + h, after);
        /* the third derivative is at most 60·0.3/0.5³ = 144 */
        for (int k = 0; k < 3; k++)
            ck_assert(fabs(after[GOUGH_HEAVE][k] - before[GOUGH_HEAVE][k]) <= 4e-7);
    }
}
END_TEST

/* ---- samples ---- */

typedef struct recording {
    double time[MAX_ROWS], value[MAX_ROWS * GOUGH_COMPONENTS],
        curvature[MAX_ROWS * GOUGH_COMPONENTS], scratch[2 * MAX_ROWS];
    gough_motion motion;
} recording;

static recording kept; /* too large for a stack under sanitizers */

static void record(size_t rows, const double *time, double (*f)(int component, double t)) {
    kept.motion = (gough_motion){.kind = GOUGH_MOTION_SAMPLES,
                                 .samples = {rows, kept.time, kept.value, kept.curvature}};
    for (size_t i = 0; i < rows; i++) {
        kept.time[i] = time[i];
        for (int c = 0; c < GOUGH_COMPONENTS; c++)
            kept.value[i * GOUGH_COMPONENTS + (size_t)c] = f(c, time[i]);
    }
    ck_assert_uint_le(gough_samples_scratch(rows), sizeof kept.scratch / sizeof(double));
    gough_error error = {.message = ""};
    ck_assert_msg(gough_samples_prepare(&kept.motion.samples, kept.scratch, &error) == GOUGH_OK,
                  "%s", error.message);
}

static double cubic(int c, double t) {
    return 1 + c + (2 - c) * t - 0.5 * t * t + 0.1 * c * t * t * t;
}
static double cubic_1(int c, double t) { return 2 - c - t + 0.3 * c * t * t; }
static double cubic_2(int c, double t) { return -1 + 0.6 * c * t; }

START_TEST(spline_reproduces_cubics_on_unequal_times) {
    static const double TIME[] = {-1, -0.9, 0.4, 0.5, 1.7, 3, 3.1, 5};
    for (size_t rows = 4; rows <= 8; rows++) {
        record(rows, TIME, cubic);
        for (double t = TIME[0]; t <= TIME[rows - 1]; t += 0.01) {
            double c[GOUGH_COMPONENTS][3];
            evaluate(&kept.motion, t, c);
            for (int k = 0; k < GOUGH_COMPONENTS; k++)
                close_to(c[k], cubic(k, t), cubic_1(k, t), cubic_2(k, t), 2e-12);
        }
    }
}
END_TEST

static double parabola(int c, double t) { return c - t + 0.25 * c * t * t; }

START_TEST(three_rows_give_a_parabola) {
    static const double TIME[] = {0, 1, 4};
    record(3, TIME, parabola);
    for (double t = 0; t <= 4; t += 0.125) {
        double c[GOUGH_COMPONENTS][3];
        evaluate(&kept.motion, t, c);
        for (int k = 0; k < GOUGH_COMPONENTS; k++)
            close_to(c[k], parabola(k, t), -1 + 0.5 * k * t, 0.5 * k, 4e-15);
    }
}
END_TEST

static double line(int c, double t) { return c + 2 * t; }

START_TEST(two_rows_give_a_line) {
    static const double TIME[] = {0, 4};
    record(2, TIME, line);
    double c[GOUGH_COMPONENTS][3];
    evaluate(&kept.motion, 1, c);
    for (int k = 0; k < GOUGH_COMPONENTS; k++) close_to(c[k], k + 2, 2, 0, 0);
}
END_TEST

START_TEST(end_values_hold_outside_the_samples) {
    static const double TIME[] = {0, 1, 2, 4, 5};
    record(5, TIME, cubic);
    double c[GOUGH_COMPONENTS][3];
    evaluate(&kept.motion, -1e-9, c);
    for (int k = 0; k < GOUGH_COMPONENTS; k++) close_to(c[k], cubic(k, 0), 0, 0, 0);
    evaluate(&kept.motion, 5.5, c);
    for (int k = 0; k < GOUGH_COMPONENTS; k++) close_to(c[k], cubic(k, 5), 0, 0, 0);
    evaluate(&kept.motion, NAN, c);
    ck_assert(isnan(c[0][0]));
}
END_TEST

static double wave(int c, double t) { return sin((1 + 0.2 * c) * t + c); }

/* unequal times: every interval between half and three halves of the mean */
static void record_wave(size_t rows) {
    static double time[MAX_ROWS];
    for (size_t i = 0; i < rows; i++) {
        const double x = (double)i / (double)(rows - 1);
        time[i] =
            10 * (x + 0.5 * sin(6 * 3.14159265358979323846 * x) / (6 * 3.14159265358979323846));
    }
    record(rows, time, wave);
}

START_TEST(spline_passes_through_its_rows_with_two_continuous_derivatives) {
    record_wave(40);
    for (size_t i = 1; i + 1 < 40; i++) {
        /* the limits from both sides, in quad, so that only the spline's own double numbers
         * limit it */
        const real h = (real)1e-22;
        jet left[GOUGH_COMPONENTS], right[GOUGH_COMPONENTS];
        motion_components(&kept.motion, (real)kept.time[i] - h, left);
        motion_components(&kept.motion, (real)kept.time[i] + h, right);
        for (int c = 0; c < GOUGH_COMPONENTS; c++) {
            const double value = kept.value[i * GOUGH_COMPONENTS + (size_t)c];
            ck_assert(fabs((double)(left[c].v - (real)value)) <= 1e-20);
            ck_assert(fabs((double)(right[c].v - left[c].v)) <= 1e-20);
            ck_assert(fabs((double)(right[c].d - left[c].d)) <= 1e-15);
            ck_assert(fabs((double)(right[c].dd - left[c].dd)) <= 1e-20);
        }
    }
}
END_TEST

START_TEST(not_a_knot_third_derivative_is_continuous_next_to_the_ends) {
    record_wave(40);
    const size_t rows[] = {1, 38};
    for (int e = 0; e < 2; e++) {
        const size_t i = rows[e];
        for (size_t c = 0; c < GOUGH_COMPONENTS; c++) {
            const double *m = kept.curvature + i * GOUGH_COMPONENTS + c;
            const double before = (m[0] - m[-GOUGH_COMPONENTS]) / (kept.time[i] - kept.time[i - 1]);
            const double after = (m[GOUGH_COMPONENTS] - m[0]) / (kept.time[i + 1] - kept.time[i]);
            ck_assert(fabs(after - before) <= 1e-12);
        }
    }
}
END_TEST

static double worst_error(size_t rows) {
    record_wave(rows);
    double worst = 0;
    for (double t = 0; t <= 10; t += 0.003) {
        double c[GOUGH_COMPONENTS][3];
        evaluate(&kept.motion, t, c);
        for (int k = 0; k < GOUGH_COMPONENTS; k++) {
            ck_assert(isfinite(c[k][0]));
            worst = fmax(worst, fabs(c[k][0] - wave(k, t)));
        }
    }
    return worst;
}

START_TEST(spline_has_order_4) {
    const double order = log2(worst_error(161) / worst_error(321));
    ck_assert_msg(fabs(order - 4) <= 0.15, "order %g", order);
}
END_TEST

static const struct {
    size_t rows;
    double time[4];
    double value;
    const char *sentence;
} BAD_SAMPLES[] = {
    {0, {0}, 0, "2 rows"},
    {1, {0}, 0, "2 rows"},
    {3, {0, 1, 1}, 0, "row 3: the time 1 does not increase"},
    {3, {0, 1, 0.5}, 0, "row 3: the time 0.5 does not increase"},
    {3, {0, NAN, 2}, 0, "row 2: the time is not finite"},
    {3, {0, 1, INFINITY}, 0, "row 3: the time is not finite"},
    {4, {0, 1, 2, 3}, NAN, "row 2: heave is not finite"},
    {4, {0, 1e-200, 2e-200, 3e-200}, 1, "too close"},
};

START_TEST(bad_samples_are_refused_with_their_row) {
    double value[4 * GOUGH_COMPONENTS] = {0}, curvature[4 * GOUGH_COMPONENTS], scratch[8];
    value[GOUGH_COMPONENTS + GOUGH_HEAVE] = BAD_SAMPLES[_i].value;
    const gough_samples samples = {.count = BAD_SAMPLES[_i].rows,
                                   .time = BAD_SAMPLES[_i].time,
                                   .value = value,
                                   .curvature = curvature};
    gough_error error = {.message = ""};
    ck_assert_int_eq(gough_samples_prepare(&samples, scratch, &error), GOUGH_ERROR_INPUT);
    ck_assert_msg(strstr(error.message, BAD_SAMPLES[_i].sentence) != NULL, "%s", error.message);
}
END_TEST

/* ---- formulas of all six ---- */

static gough_motion six_formulas(double angle_unit) {
    gough_motion m = {.angle_unit = angle_unit};
    m.formula[GOUGH_SURGE] = formula_of("t");
    m.formula[GOUGH_SWAY] = formula_of("t^2");
    m.formula[GOUGH_ROLL] = formula_of("180*t");
    m.formula[GOUGH_YAW] = formula_of("90*t^2");
    return m;
}

START_TEST(angles_are_taken_in_their_unit) {
    const double pi = 3.14159265358979323846;
    double c[GOUGH_COMPONENTS][3];
    gough_motion m = six_formulas(pi / 180);
    evaluate(&m, 2, c);
    close_to(c[GOUGH_SURGE], 2, 1, 0, 0);
    close_to(c[GOUGH_SWAY], 4, 4, 2, 0);
    close_to(c[GOUGH_HEAVE], 0, 0, 0, 0);
    close_to(c[GOUGH_ROLL], 2 * pi, pi, 0, 1e-15);
    close_to(c[GOUGH_YAW], 2 * pi, 2 * pi, pi, 1e-15);
    m.angle_unit = 0;
    evaluate(&m, 2, c);
    close_to(c[GOUGH_ROLL], 360, 180, 0, 0);
    m.angle_unit = 0.5;
    evaluate(&m, 2, c);
    close_to(c[GOUGH_ROLL], 180, 90, 0, 0);
}
END_TEST

START_TEST(degrees_have_all_digits_in_quad) {
    const gough_motion m = six_formulas(3.14159265358979323846 / 180);
    jet out[GOUGH_COMPONENTS];
    motion_components(&m, 2, out);
    ck_assert(fabs((double)(out[GOUGH_ROLL].v - 2 * REAL_PI)) <= 1e-32);
    ck_assert(fabs((double)(out[GOUGH_YAW].dd - REAL_PI)) <= 1e-32);
}
END_TEST

/* ---- amplitude and frequency ---- */

/* of both motions at many times, relative to the greatest of each derivative; NAN differs from all */
static void same_motion(const gough_motion *one, const gough_motion *other, double until) {
    double greatest[3] = {0, 0, 0}, worst[3] = {0, 0, 0};
    for (int i = 0; i <= 300; i++) {
        double a[GOUGH_COMPONENTS][3], b[GOUGH_COMPONENTS][3];
        evaluate(one, until * i / 300, a);
        evaluate(other, until * i / 300, b);
        for (int c = 0; c < GOUGH_COMPONENTS; c++) {
            for (int k = 0; k < 3; k++) {
                ck_assert(isfinite(a[c][k]) && isfinite(b[c][k]));
                greatest[k] = fmax(greatest[k], fabs(b[c][k]));
                worst[k] = fmax(worst[k], fabs(a[c][k] - b[c][k]));
            }
        }
    }
    for (int k = 0; k < 3; k++) {
        ck_assert(greatest[k] > 0);
        ck_assert_msg(worst[k] <= 1e-15 * greatest[k], "derivative %d: %g of %g", k, worst[k],
                      greatest[k]);
    }
}

/* (motion-6), written out */
START_TEST(scaled_formulas_are_the_formulas_written_out) {
    gough_motion plain = {.angle_unit = 3.14159265358979323846 / 180}, written = plain;
    plain.formula[GOUGH_SURGE] = formula_of("0.05*cos(3*t) - 0.02*t");
    plain.formula[GOUGH_HEAVE] = formula_of("0.2*sin(t)*(1 - exp(-t/2))^2");
    plain.formula[GOUGH_PITCH] = formula_of("10*ramp(t, 4)");
    plain.formula[GOUGH_YAW] = formula_of("5*tanh(t - 3)");
    written.formula[GOUGH_SURGE] = formula_of("1.5*(0.05*cos(3*(0.75*t)) - 0.02*(0.75*t))");
    written.formula[GOUGH_HEAVE] = formula_of("1.5*(0.2*sin(0.75*t)*(1 - exp(-(0.75*t)/2))^2)");
    written.formula[GOUGH_PITCH] = formula_of("1.5*(10*ramp(0.75*t, 4))");
    written.formula[GOUGH_YAW] = formula_of("1.5*(5*tanh(0.75*t - 3))");
    plain.scaled = true;
    plain.amplitude = 1.5;
    plain.frequency = 0.75;
    same_motion(&plain, &written, 10);
}
END_TEST

START_TEST(scaled_moves_are_moves_further_and_sooner) {
    gough_move quick[2];
    gough_motion scaled = MOVING, written = MOVING;
    for (int i = 0; i < 2; i++) {
        quick[i] = MOVES[i];
        quick[i].start /= 2;
        quick[i].duration /= 2;
        for (int c = 0; c < GOUGH_COMPONENTS; c++) quick[i].target[c] *= -1.5;
    }
    written.move = quick;
    scaled.scaled = true;
    scaled.amplitude = -1.5;
    scaled.frequency = 2;
    same_motion(&scaled, &written, 3);
}
END_TEST

START_TEST(scaled_samples_are_rows_larger_and_later) {
    static double time[40], value[40 * GOUGH_COMPONENTS], curvature[40 * GOUGH_COMPONENTS];
    double scratch[80];
    gough_error error = {.message = ""};
    gough_motion written = {
        .kind = GOUGH_MOTION_SAMPLES,
        .samples = {.count = 40, .time = time, .value = value, .curvature = curvature}};
    record_wave(40);
    for (int i = 0; i < 40; i++) time[i] = kept.time[i] * 2;
    for (int i = 0; i < 40 * GOUGH_COMPONENTS; i++) value[i] = kept.value[i] * 0.25;
    ck_assert(gough_samples_prepare(&written.samples, scratch, &error) == GOUGH_OK);
    kept.motion.scaled = true;
    kept.motion.amplitude = 0.25;
    kept.motion.frequency = 0.5;
    same_motion(&kept.motion, &written, 25); /* the last row, at 20, holds */
}
END_TEST

START_TEST(factors_hold_only_where_they_are_asked_for) {
    double c[GOUGH_COMPONENTS][3];
    gough_motion m = {.amplitude = 7, .frequency = 3};
    m.formula[GOUGH_SWAY] = formula_of("t^2");
    evaluate(&m, 2, c);
    close_to(c[GOUGH_SWAY], 4, 4, 2, 0);
    m.scaled = true;
    evaluate(&m, 2, c);
    close_to(c[GOUGH_SWAY], 7 * 36, 7 * 3 * 12, 7 * 9 * 2, 0);
    m.amplitude = 0;
    evaluate(&m, 2, c);
    close_to(c[GOUGH_SWAY], 0, 0, 0, 0);
}
END_TEST

/* the range of heave = formula over a duration with rows `step` apart */
static void range_is(const char *formula, double duration, double step, double least,
                     double greatest) {
    double low[GOUGH_COMPONENTS], high[GOUGH_COMPONENTS];
    gough_error error;
    gough_motion m = {0};
    m.formula[GOUGH_HEAVE] = formula_of(formula);
    ck_assert_int_eq(gough_motion_range(&m, duration, step, low, high, &error), GOUGH_OK);
    /* a root is good to 1e-12 of its bracket; the rest is round-off */
    ck_assert_double_eq_tol(low[GOUGH_HEAVE], least, 1e-12 * (greatest - least));
    ck_assert_double_eq_tol(high[GOUGH_HEAVE], greatest, 1e-12 * (greatest - least));
    ck_assert(fabs(low[GOUGH_ROLL]) <= 0 && fabs(high[GOUGH_ROLL]) <= 0);
}

START_TEST(ranges_are_extremes_of_the_motion_not_of_rows) {
    range_is("sin(16*pi*t)", 10, 1, -1, 1);
    range_is("t + 0.2*sin(5*t)", 2, 2, 0, 2 + 0.2 * sin(10.0));
    range_is("sin(t)", 1, 3, 0, sin(1.0));
    range_is("exp(-((t - 1.2345)/0.003)^2)", 10, 0.5, 0, 1);
    range_is("ramp(t - 1.2345, 0.0001) - 2*ramp(t - 1.2346, 0.0001)", 10, 0.5, -1, 1);
    /* a corner: the rate jumps */
    range_is("-sqrt((t - 0.7)^2)", 1, 1, -0.7, 0);
    /* two extremes close together, on a rise: t³/3 - e² t with e = 0.01, from -1 on */
    range_is("(t - 1)^3/3 - 0.0001*(t - 1)", 1.02, 2, -1.0 / 3 + 0.0001, 2e-6 / 3);
}
END_TEST

START_TEST(ranges_of_moves_and_scaled_programs) {
    double low[GOUGH_COMPONENTS], high[GOUGH_COMPONENTS];
    const gough_move move[2] = {{.start = 1.01,
                                 .duration = 0.02,
                                 .given = {[GOUGH_YAW] = true},
                                 .target = {0, 0, 0, 0, 0, 2}},
                                {.start = 1.03,
                                 .duration = 0.02,
                                 .given = {[GOUGH_YAW] = true},
                                 .target = {0, 0, 0, 0, 0, -1}}};
    const gough_motion m = {.kind = GOUGH_MOTION_MOVES,
                            .move = move,
                            .moves = 2,
                            .scaled = true,
                            .amplitude = -3,
                            .frequency = 2};
    ck_assert_int_eq(gough_motion_range(&m, 1, 1, low, high, NULL), GOUGH_OK);
    ck_assert_double_eq_tol(low[GOUGH_YAW], -6, 1e-12);
    ck_assert_double_eq_tol(high[GOUGH_YAW], 3, 1e-12);
}
END_TEST

START_TEST(ranges_name_what_is_not_finite) {
    double low[GOUGH_COMPONENTS], high[GOUGH_COMPONENTS];
    gough_error error;
    gough_motion m = {0};
    m.formula[GOUGH_PITCH] = formula_of("sqrt(0.6 - t)");
    ck_assert_int_eq(gough_motion_range(&m, 1, 1, low, high, &error), GOUGH_ERROR_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "motion.pitch"));
    ck_assert_ptr_nonnull(strstr(error.message, "is not finite at t = "));
}
END_TEST

/* ---- programs made by hand ---- */

static void program_is_refused(const gough_motion *m, const char *key, const char *sentence) {
    double low[GOUGH_COMPONENTS], high[GOUGH_COMPONENTS];
    gough_error error = {.message = ""};
    ck_assert_msg(gough_motion_range(m, 1, 1, low, high, &error) == GOUGH_ERROR_INPUT,
                  "accepted, for all that: %s", sentence);
    ck_assert_str_eq(error.key, key);
    ck_assert_msg(strstr(error.message, sentence) != NULL, "%s", error.message);
}

START_TEST(numbers_of_a_program_that_are_out_of_range_are_refused_by_their_key) {
    static const double BAD[] = {NAN, INFINITY, -INFINITY};
    for (size_t i = 0; i < sizeof BAD / sizeof BAD[0]; i++) {
        program_is_refused(&(gough_motion){.angle_unit = BAD[i]}, "motion", "the unit of angles");
        for (int c = 0; c < 3; c++) {
            gough_motion m = {.angle_unit = 1};
            m.about[c] = BAD[i];
            program_is_refused(&m, "motion.about", "three finite numbers");
        }
        program_is_refused(&(gough_motion){.angle_unit = 1, .period = BAD[i]}, "motion.period",
                           "0 or greater and finite");
        gough_motion m = {.angle_unit = 1, .scaled = true, .amplitude = 1, .frequency = BAD[i]};
        program_is_refused(&m, "motion.frequency", "greater than 0 and finite");
        m.frequency = 1, m.amplitude = BAD[i];
        program_is_refused(&m, "motion.amplitude", "must be finite");
    }
    program_is_refused(&(gough_motion){.period = -1}, "motion.period", "0 or greater");
    program_is_refused(&(gough_motion){.scaled = true}, "motion.frequency", "greater than 0");
}
END_TEST

START_TEST(programs_without_their_moves_or_rows_are_refused) {
    double two[2 * GOUGH_COMPONENTS] = {0, 1};
    const gough_samples whole = {.count = 2, .time = two, .value = two, .curvature = two};
    gough_motion m = {.kind = GOUGH_MOTION_MOVES, .moves = 2};
    program_is_refused(&m, "motion.moves", "2 moves are announced and none is given");

    for (int lacking = 0; lacking < 4; lacking++) {
        m = (gough_motion){.kind = GOUGH_MOTION_SAMPLES, .samples = whole};
        if (lacking == 0) m.samples.count = 1;
        if (lacking == 1) m.samples.time = NULL;
        if (lacking == 2) m.samples.value = NULL;
        if (lacking == 3) m.samples.curvature = NULL;
        program_is_refused(&m, "motion.samples", "at least two rows");
    }
    static const double AXES[][4] = {{NAN}, {0, INFINITY}, {1e-150}, {0, 0, 0, 1e150}};
    for (size_t i = 0; i < sizeof AXES / sizeof AXES[0]; i++) {
        m = (gough_motion){.kind = GOUGH_MOTION_SAMPLES, .samples = whole};
        memcpy(m.samples.axes, AXES[i], sizeof AXES[i]);
        program_is_refused(&m, "motion.samples", "a quaternion of finite numbers, or four zeros");
    }
}
END_TEST

START_TEST(components_have_names) {
    static const char *const NAMES[] = {"surge", "sway", "heave", "roll", "pitch", "yaw"};
    for (int c = 0; c < GOUGH_COMPONENTS; c++) ck_assert_str_eq(gough_component_name(c), NAMES[c]);
    ck_assert_str_eq(gough_component_name(-1), "");
    ck_assert_str_eq(gough_component_name(GOUGH_COMPONENTS), "");
}
END_TEST

int main(void) {
    Suite *suite = suite_create("motion");
    TCase *tests = tcase_create("motion");
    tcase_set_timeout(tests, 60);
    tcase_add_test(tests, moves_start_and_end_at_rest);
    tcase_add_test(tests, moves_are_of_minimum_jerk);
    tcase_add_test(tests, moves_join_smoothly);
    tcase_add_test(tests, spline_reproduces_cubics_on_unequal_times);
    tcase_add_test(tests, three_rows_give_a_parabola);
    tcase_add_test(tests, two_rows_give_a_line);
    tcase_add_test(tests, end_values_hold_outside_the_samples);
    tcase_add_test(tests, spline_passes_through_its_rows_with_two_continuous_derivatives);
    tcase_add_test(tests, not_a_knot_third_derivative_is_continuous_next_to_the_ends);
    tcase_add_test(tests, spline_has_order_4);
    tcase_add_loop_test(tests, bad_samples_are_refused_with_their_row, 0,
                        (int)(sizeof BAD_SAMPLES / sizeof BAD_SAMPLES[0]));
    tcase_add_test(tests, angles_are_taken_in_their_unit);
    tcase_add_test(tests, degrees_have_all_digits_in_quad);
    tcase_add_test(tests, scaled_formulas_are_the_formulas_written_out);
    tcase_add_test(tests, scaled_moves_are_moves_further_and_sooner);
    tcase_add_test(tests, scaled_samples_are_rows_larger_and_later);
    tcase_add_test(tests, factors_hold_only_where_they_are_asked_for);
    tcase_add_test(tests, ranges_are_extremes_of_the_motion_not_of_rows);
    tcase_add_test(tests, ranges_of_moves_and_scaled_programs);
    tcase_add_test(tests, ranges_name_what_is_not_finite);
    tcase_add_test(tests, numbers_of_a_program_that_are_out_of_range_are_refused_by_their_key);
    tcase_add_test(tests, programs_without_their_moves_or_rows_are_refused);
    tcase_add_test(tests, components_have_names);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? 0 : 1;
}
