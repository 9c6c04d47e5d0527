/* Angles about turned axes: the same rotations, poles far away, true roll, pitch and yaw from them. A motion known in closed
 * form passes the pole: R = Rx(tilt) Ry(θ) has sin(pitch) = cos(tilt) sin(θ). */
#include <math.h>
#include <string.h>

#define NUMBER_QUAD
#include "program/angles.h"
#include "program/helpers.h"
#include "program/program.h"
#include "support/suite.h"

static const double PI = 3.14159265358979323846;

enum { ROWS = 41 };

/* F e_x = e_y, F e_y = e_z, F e_z = e_x: Rx(tilt) Ry(θ) is Rz(tilt) Rx(θ) about these axes */
static const double CYCLIC[4] = {1, 1, 1, 1};

/* ---- rotations by another way: by vectors and quaternions ---- */

static void turn_vector(double v[3], int axis, double angle) {
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    const double x = v[a], y = v[b];
    v[a] = cos(angle) * x - sin(angle) * y;
    v[b] = sin(angle) * x + cos(angle) * y;
}

/* Rz Ry Rx v */
static void turn_by_angles(double v[3], const double angle[3]) {
    for (int axis = 0; axis < 3; axis++) turn_vector(v, axis, angle[axis]);
}

/* q v q⁻¹ by v + 2 w (u × v) + 2 u × (u × v), sign −1: the inverse */
static void turn_by_quaternion(double v[3], const double axes[4], double sign) {
    const double n =
        sqrt(axes[0] * axes[0] + axes[1] * axes[1] + axes[2] * axes[2] + axes[3] * axes[3]);
    const double w = axes[0] / n,
                 u[3] = {sign * axes[1] / n, sign * axes[2] / n, sign * axes[3] / n};
    double c[3], d[3];
    for (int i = 0; i < 3; i++)
        c[i] = u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3];
    for (int i = 0; i < 3; i++)
        d[i] = u[(i + 1) % 3] * c[(i + 2) % 3] - u[(i + 2) % 3] * c[(i + 1) % 3];
    for (int i = 0; i < 3; i++) v[i] += 2 * w * c[i] + 2 * d[i];
}

/* F Rz Ry Rx Fᵀ v */
static void turn_about(double v[3], const double axes[4], const double angle[3]) {
    turn_by_quaternion(v, axes, -1);
    turn_by_angles(v, angle);
    turn_by_quaternion(v, axes, 1);
}

static double largest_difference(const double axes[4], const double turned[3],
                                 const double angle[3]) {
    double most = 0;
    for (int c = 0; c < 3; c++) {
        double one[3] = {c == 0, c == 1, c == 2}, other[3] = {c == 0, c == 1, c == 2};
        turn_about(one, axes, turned);
        turn_by_angles(other, angle);
        for (int r = 0; r < 3; r++) most = fmax(most, fabs(one[r] - other[r]));
    }
    return most;
}

START_TEST(turned_angles_are_the_same_rotation) {
    static const double AXES[4][4] = {{1, 1, 1, 1}, {1, 0, 0, 0}, {2, -1, 0, 1}, {0.3, -5, 0.1, 2}};
    double before[ROWS * GOUGH_COMPONENTS], after[ROWS * GOUGH_COMPONENTS];
    random_source random = random_seeded(11);
    for (int k = 0; k < 4; k++) {
        for (int i = 0; i < ROWS * GOUGH_COMPONENTS; i++)
            before[i] = after[i] = random_between(&random, -1000, 1000);
        gough_samples_turn(ROWS, after, 180, AXES[k]);
        for (int i = 0; i < ROWS; i++) {
            double angle[3], turned[3];
            for (int a = 0; a < 6; a++) {
                const double one = before[6 * i + a], other = after[6 * i + a];
                if (a < 3) ck_assert(fabs(one - other) <= 0);
                if (a >= 3) angle[a - 3] = one * PI / 180, turned[a - 3] = other * PI / 180;
                if (a >= 3) ck_assert(fabs(other) <= (a == 4 ? 90 : 180) + 1e-9);
            }
            /* 1000° are known to 1e-13 of themselves in radians */
            ck_assert(largest_difference(AXES[k], turned, angle) <= 1e-13);
        }
    }
}
END_TEST

START_TEST(zero_stays_zero) {
    double value[GOUGH_COMPONENTS] = {1, 2, 3, 0, 0, 0};
    gough_samples_turn(1, value, PI, (double[4]){2, -1, 0, 1});
    for (int a = 3; a < 6; a++) ck_assert(fabs(value[a]) <= 1e-16);
}
END_TEST

/* ---- which axes ---- */

/* least angle between R F e_x and ± F e_z of all rows, from the pole's own definition */
static double distance(size_t rows, const double *value, const double axes[4]) {
    double least = 90;
    for (size_t i = 0; i < rows; i++) {
        double x[3] = {1, 0, 0}, z[3] = {0, 0, 1}, angle[3];
        for (int a = 0; a < 3; a++) angle[a] = value[6 * i + 3 + (size_t)a] * PI / 180;
        turn_by_quaternion(x, axes, 1);
        turn_by_quaternion(z, axes, 1);
        turn_by_angles(x, angle);
        least = fmin(least, acos(fabs(x[0] * z[0] + x[1] * z[1] + x[2] * z[2])) * 180 / PI);
    }
    return least;
}

static double written[4 * ROWS * GOUGH_COMPONENTS];

START_TEST(axes_stay_away_from_their_pole) {
    for (int kind = 0; kind < 2; kind++) {
        const size_t rows = kind == 0 ? ROWS : 4 * ROWS;
        double axes[4];
        for (size_t i = 0; i < rows; i++) {
            const double s = (double)i / (double)rows;
            double *angle = written + 6 * i + 3;
            angle[0] = kind == 0 ? 3 : 100 * sin(2 * PI * s);
            angle[1] = kind == 0 ? 60 + 60 * s : 89.9 * sin(4 * PI * s);
            angle[2] = kind == 0 ? 20 * s : 80 * cos(6 * PI * s);
        }
        const double found = gough_samples_axes(rows, written, 180, axes);
        const double right = distance(rows, written, axes);
        ck_assert_msg(fabs(found - right) <= 1e-6, "%g is %g", found, right);
        ck_assert_msg(found > (kind == 0 ? 60 : 30), "only %g", found);
        ck_assert(distance(rows, written, (double[4]){1, 0, 0, 0}) < 5);
        /* of quaternions with numbers up to 1 the best is as good in the one record, and bad in the other */
        double best = 0;
        for (int code = 0; code < 81; code++) {
            const double q[4] = {code / 27 - 1, code / 9 % 3 - 1, code / 3 % 3 - 1, code % 3 - 1};
            if (code != 40) best = fmax(best, distance(rows, written, q));
        }
        ck_assert_msg(kind == 0 ? fabs(found - best) <= 1e-3 : best < 15, "%g, %g", found, best);
    }
}
END_TEST

START_TEST(rotations_of_every_kind_leave_no_axes) {
    double axes[4];
    random_source random = random_seeded(5);
    for (int i = 0; i < 4 * ROWS * GOUGH_COMPONENTS; i++)
        written[i] = random_between(&random, -180, 180);
    ck_assert(gough_samples_axes(4 * ROWS, written, 180, axes) < 15);
}
END_TEST

/* ---- motion past the pole ---- */

typedef struct passing {
    double time[ROWS], value[ROWS * GOUGH_COMPONENTS], curvature[ROWS * GOUGH_COMPONENTS];
    double scratch[2 * ROWS];
    gough_motion motion;
} passing;

/* θ from 60° to 120° in one unit of time */
static const double FIRST = 60 * 3.14159265358979323846 / 180,
                    RATE = 60 * 3.14159265358979323846 / 180;

static void pass(passing *p, double tilt) {
    gough_error error;
    memset(p, 0, sizeof *p);
    for (int i = 0; i < ROWS; i++) {
        p->time[i] = i / (ROWS - 1.0);
        p->value[6 * i + GOUGH_ROLL] = FIRST + RATE * p->time[i];
        p->value[6 * i + GOUGH_YAW] = tilt;
    }
    p->motion.kind = GOUGH_MOTION_SAMPLES;
    p->motion.samples = (gough_samples){
        .count = ROWS, .time = p->time, .value = p->value, .curvature = p->curvature};
    memcpy(p->motion.samples.axes, CYCLIC, sizeof CYCLIC);
    ck_assert(gough_samples_prepare(&p->motion.samples, p->scratch, &error) == GOUGH_OK);
}

/* Roll, pitch and yaw of Rx(tilt) Ry(θ), whose columns are (c, sin tilt s, −cos tilt s), (0, cos tilt, sin tilt) and
 * (s, −sin tilt c, cos tilt c), with derivatives by θ that follow from them. */
static void closed_form(double tilt, double theta, double rate, double out[3][3]) {
    const double c = cos(theta), s = sin(theta), C = cos(tilt), S = sin(tilt);
    const double cosine2 = c * c + S * S * s * s; /* of pitch, squared */
    out[0][0] = atan2(S, C * c);
    out[1][0] = atan2(C * s, sqrt(cosine2));
    out[2][0] = atan2(S * s, c);
    /* d/dθ atan2(y, x) = (x y' − y x')/(x² + y²); x² + y² is cosine2 for both */
    const double slope2 = -2 * c * s * C * C; /* d cosine2/dθ */
    out[0][1] = rate * S * C * s / cosine2;
    out[1][1] = rate * C * c / sqrt(cosine2);
    out[2][1] = rate * S / cosine2;
    out[0][2] = rate * rate * S * C * (c / cosine2 - s * slope2 / cosine2 / cosine2);
    out[1][2] = rate * rate * C * (-s / sqrt(cosine2) - c * slope2 / 2 / pow(cosine2, 1.5));
    out[2][2] = -rate * rate * S * slope2 / cosine2 / cosine2;
}

/* by rounding of rows 1/40 apart, which grows with the inverse square in the second derivative */
static const double LOST[3] = {1e-14, 1e-12, 2e-11};

START_TEST(components_are_roll_pitch_and_yaw_with_their_derivatives) {
    passing p;
    for (int k = 0; k < 3; k++) {
        const double tilt = (double[]){0.3, 0.01, 0.1 * PI / 180}[k];
        pass(&p, tilt);
        for (double t = 0; t <= 1; t += 0.0625) {
            double found[GOUGH_COMPONENTS][3], right[3][3];
            gough_motion_evaluate(&p.motion, t, found);
            closed_form(tilt, FIRST + RATE * t, RATE, right);
            for (int a = 0; a < 3; a++)
                for (int order = 0; order < 3; order++)
                    ck_assert_msg(fabs(found[GOUGH_ROLL + a][order] - right[a][order]) <=
                                      LOST[order] / pow(tilt, order + 1),
                                  "tilt %g, t = %g, angle %d, order %d: %.17g, not %.17g", tilt, t,
                                  a, order, found[GOUGH_ROLL + a][order], right[a][order]);
        }
    }
}
END_TEST

START_TEST(amplitude_scales_the_angles_about_turned_axes) {
    const double tilt = 0.2, t = 0.375;
    double found[GOUGH_COMPONENTS][3], right[3][3];
    passing p;
    pass(&p, tilt);
    p.motion.scaled = true;
    p.motion.amplitude = 0.5;
    p.motion.frequency = 0.75;
    gough_motion_evaluate(&p.motion, t, found);
    closed_form(tilt / 2, (FIRST + RATE * 0.75 * t) / 2, RATE * 0.75 / 2, right);
    for (int a = 0; a < 3; a++)
        for (int order = 0; order < 3; order++)
            ck_assert(fabs(found[GOUGH_ROLL + a][order] - right[a][order]) <=
                      LOST[order] / tilt / tilt);
}
END_TEST

/* roll and yaw rise, and pitch has its extreme where θ is 90°, at the pole's distance `tilt`; 1e-9 is what half a turn within
 * 2e-9 of a unit of time loses */
START_TEST(ranges_are_those_of_roll_pitch_and_yaw) {
    static const double TILT[] = {0.3, 0.01, 0.1 * 3.14159265358979323846 / 180, 1e-6};
    double low[GOUGH_COMPONENTS], high[GOUGH_COMPONENTS], first[3][3], last[3][3];
    passing p;
    for (int k = 0; k < 4; k++) {
        pass(&p, TILT[k]);
        ck_assert_int_eq(gough_motion_range(&p.motion, 1, 0.25, low, high, NULL), GOUGH_OK);
        closed_form(TILT[k], FIRST, RATE, first);
        closed_form(TILT[k], FIRST + RATE, RATE, last);
        for (int a = 0; a < 3; a += 2) {
            ck_assert(fabs(low[GOUGH_ROLL + a] - first[a][0]) <= 1e-9);
            ck_assert(fabs(high[GOUGH_ROLL + a] - last[a][0]) <= 1e-9);
        }
        ck_assert(fabs(low[GOUGH_PITCH] - first[1][0]) <= 1e-9);
        ck_assert_msg(fabs(high[GOUGH_PITCH] - (PI / 2 - TILT[k])) <= 1e-9, "%g: %.17g", TILT[k],
                      high[GOUGH_PITCH]);
    }
    /* exactly through the pole: pitch within ±90°, half a turn of roll and yaw */
    pass(&p, 0);
    ck_assert_int_eq(gough_motion_range(&p.motion, 1, 0.25, low, high, NULL), GOUGH_OK);
    ck_assert(fabs(high[GOUGH_PITCH] - PI / 2) <= 1e-9);
    ck_assert(fabs(low[GOUGH_PITCH] - FIRST) <= 1e-9);
    ck_assert(fabs(high[GOUGH_YAW] - low[GOUGH_YAW] - PI) <= 1e-9);
}
END_TEST

/* Roll and yaw turn by half a turn and more between two times at which a slower motion would be evaluated: Rz(ψ) with ψ from −60°
 * to 60° is added to what turns yaw past the pole. */
START_TEST(half_turns_past_the_pole_are_followed) {
    const double tilt = 1e-4, turn = 120 * PI / 180;
    double low[GOUGH_COMPONENTS], high[GOUGH_COMPONENTS], last[3][3];
    gough_error error;
    passing p;
    pass(&p, tilt);
    for (int i = 0; i < ROWS; i++) {
        double *angle = p.value + 6 * i + GOUGH_ROLL, right[3][3];
        closed_form(tilt, FIRST - 0.03 + RATE * p.time[i], RATE, right);
        for (int a = 0; a < 3; a++) angle[a] = right[a][0];
        angle[2] += turn * (p.time[i] - 0.5);
    }
    gough_samples_turn(ROWS, p.value, PI, CYCLIC);
    gough_samples_unwrap(ROWS, p.value, PI);
    ck_assert(gough_samples_prepare(&p.motion.samples, p.scratch, &error) == GOUGH_OK);
    ck_assert_int_eq(gough_motion_range(&p.motion, 1, 0.25, low, high, NULL), GOUGH_OK);
    closed_form(tilt, FIRST - 0.03 + RATE, RATE, last);
    ck_assert(fabs(low[GOUGH_YAW] - (-turn / 2 + tilt * tan(FIRST - 0.03))) <= 1e-6);
    ck_assert_msg(fabs(high[GOUGH_YAW] - (turn / 2 + last[2][0])) <= 1e-6, "%g, not %g",
                  high[GOUGH_YAW], turn / 2 + last[2][0]);
    ck_assert(fabs(high[GOUGH_ROLL] - last[0][0]) <= 1e-6 && fabs(low[GOUGH_ROLL]) <= 1e-3);
}
END_TEST

/* F has the digits of the number type: R is a rotation to 33 digits */
START_TEST(quad_rotations_have_all_digits) {
    const jet component[GOUGH_COMPONENTS] = {[GOUGH_ROLL] = {0.7, 1, 0.1},
                                             [GOUGH_PITCH] = {-0.4, 0.3, 0.2},
                                             [GOUGH_YAW] = {1.9, -2, 0.5}};
    static const double AXES[2][4] = {{1, 1, 1, 0}, {2, -1, 0, 1}};
    for (int k = 0; k < 2; k++) {
        jet R[3][3];
        motion_rotation((angle_frame){AXES[k], GOUGH_ZYX}, component, R);
        for (int r = 0; r < 3; r++) {
            for (int s = 0; s < 3; s++) {
                jet sum = jet_constant(0);
                for (int c = 0; c < 3; c++) sum = jet_add(sum, jet_multiply(R[r][c], R[s][c]));
                ck_assert(real_magnitude(sum.v - (r == s ? 1 : 0)) <= 64 * REAL_EPSILON);
                ck_assert(real_magnitude(sum.d) <= 64 * REAL_EPSILON);
                ck_assert(real_magnitude(sum.dd) <= 640 * REAL_EPSILON);
            }
        }
    }
}
END_TEST

int main(void) {
    return SUITE_RUN("model/turn", 60, turned_angles_are_the_same_rotation, zero_stays_zero,
                     axes_stay_away_from_their_pole, rotations_of_every_kind_leave_no_axes,
                     components_are_roll_pitch_and_yaw_with_their_derivatives,
                     amplitude_scales_the_angles_about_turned_axes,
                     ranges_are_those_of_roll_pitch_and_yaw, half_turns_past_the_pole_are_followed,
                     quad_rotations_have_all_digits);
}
