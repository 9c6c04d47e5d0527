/* Records of motion by a mapping: what is read is what the keys say, by identities of rotations and by exact numbers. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gough/dynamics.h"
#include "study/helpers.h"
#include "support/suite.h"

static const double degree = 3.14159265358979323846 / 180;

/* Reads a study in these units with such a mapping behind `file`. */
static reading read_record(const char *units, const char *keys, const char *record, size_t length) {
    char text[3000], *path = write_file("record.txt", record, length);
    snprintf(
        text, sizeof text,
        "units: %s\nplatform: {base: {radius: 1, half_angle: 15}, top: {radius: 0.6, half_angle: "
        "15}, height: 1.2}\nload: {mass: 1, inertia: [0.08, 0.08, 0.15]}\n"
        "motion: {samples: {file: '%s', %s}}\nsimulation: {duration: 0.5}\n",
        units, path, keys);
    reading made = read_bytes(text, strlen(text), NULL);
    ck_assert_msg(made.status == GOUGH_OK, "%s: %s", keys, made.messages ? made.messages : "");
    forget_file(path);
    return made;
}

static const gough_samples *samples_of(const reading *made) {
    return &made->study->model->motion.samples;
}

static double at(const reading *made, size_t row, int c) {
    return samples_of(made)->value[row * GOUGH_COMPONENTS + (size_t)c];
}

/* scale × (the cell in the study's unit) + offset: 12 mm are 0.012 m to the last digit */
START_TEST(values_are_scaled_and_moved_as_written) {
    static const char record[] = "0;12;1,5;0,25\n250;-7;2;0,5\n500;3;3;1\n";
    static const char keys[] =
        "time: {column: 1, unit: ms}, columns: {heave: {column: 2, unit: mm}, "
        "surge: {column: 3, unit: cm, scale: -2, offset: 0.5}, yaw: {column: "
        "4, unit: rad}}";
    reading made = read_record("si", keys, record, sizeof record - 1);
    ck_assert(fabs(samples_of(&made)->time[1] - 0.25) <= 0);
    ck_assert(fabs(at(&made, 0, GOUGH_HEAVE) - 0.012) <= 0);
    ck_assert(fabs(at(&made, 1, GOUGH_HEAVE) + 0.007) <= 0);
    ck_assert(fabs(at(&made, 0, GOUGH_SURGE) - (-2 * 0.015 + 0.5)) <= 1e-16);
    ck_assert(fabs(at(&made, 2, GOUGH_SURGE) - (-2 * 0.03 + 0.5)) <= 1e-16);
    ck_assert(fabs(at(&made, 1, GOUGH_YAW) - 0.5) <= 2e-16);
    ck_assert(fabs(made.study->record->column[GOUGH_HEAVE].step - 0.001) <= 1e-18);
    ck_assert(fabs(made.study->record->column[GOUGH_SURGE].step - 2e-3) <= 1e-18);
    reading_free(&made);
    /* cells without a unit are in that of the study; the offset too */
    made =
        read_record("{length: mm, time: ms}",
                    "time: 1, columns: {heave: {column: 2, offset: 8}, sway: {column: 3, unit: m}}",
                    record, sizeof record - 1);
    ck_assert(fabs(at(&made, 0, GOUGH_HEAVE) - 0.02) <= 4e-18);
    ck_assert(fabs(at(&made, 0, GOUGH_SWAY) - 1.5) <= 0);
    ck_assert(fabs(samples_of(&made)->time[2] - 0.5) <= 0);
    reading_free(&made);
}
END_TEST

enum { ROWS = 4 };
static const double angles[ROWS][3] = {{10, -20, 170},
                                       {12, -25, 175},
                                       {14, -22, 179},
                                       {11, -18, 172}},
                    places[ROWS][3] = {{1, 2, 3}, {1.5, 2.25, 2}, {2, 1, 2.5}, {2.5, 1, 3}};

static void rotation(gough_order order, const double degrees[3], double R[3][3]) {
    const double radians[3] = {degrees[0] * degree, degrees[1] * degree, degrees[2] * degree};
    gough_rotation_in_order(order, radians, R);
}

/* Rx(roll) Ry(pitch) Rz(yaw), or the other way round, as products of three turns about axes */
static void turns(bool xyz, const double degrees[3], double R[3][3]) {
    double product[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int k = 0; k < 3; k++) {
        const int axis = xyz ? k : 2 - k, a = (axis + 1) % 3, b = (axis + 2) % 3;
        const double c = cos(degrees[axis] * degree), s = sin(degrees[axis] * degree);
        for (int r = 0; r < 3; r++) {
            const double x = product[r][a], y = product[r][b];
            product[r][a] = c * x + s * y;
            product[r][b] = c * y - s * x;
        }
    }
    memcpy(R, product, sizeof product);
}

/* the rotation that the program has at a row */
static void rotation_at(const reading *made, size_t row, double R[3][3]) {
    double degrees[3];
    for (int a = 0; a < 3; a++) degrees[a] = at(made, row, GOUGH_ROLL + a) / degree;
    rotation(made->study->model->motion.order, degrees, R);
}

static double apart(const double A[3][3], const double B[3][3]) {
    double most = 0;
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) most = fmax(most, fabs(A[r][c] - B[r][c]));
    return most;
}

#define CONST(R) ((const double(*)[3])(R))

static size_t put_row(char *text, int row, const double *number, int count) {
    size_t used = (size_t)sprintf(text, "%g", row * 0.25);
    for (int i = 0; i < count; i++) used += (size_t)sprintf(text + used, " %.15g", number[i]);
    return used + (size_t)sprintf(text + used, "\n");
}

START_TEST(angles_of_another_order_are_the_same_rotations) {
    for (int xyz = 0; xyz < 2; xyz++) {
        char record[1000] = "";
        size_t length = 0;
        for (int i = 0; i < ROWS; i++) length += put_row(record + length, i, angles[i], 3);
        reading made = read_record("si",
                                   xyz ? "time: 1, columns: {roll: 2, pitch: 3, yaw: 4}, order: xyz"
                                       : "time: 1, columns: {roll: 2, pitch: 3, yaw: 4}",
                                   record, length);
        for (size_t i = 0; i < ROWS; i++) {
            double expected[3][3], found[3][3];
            turns(xyz, angles[i], expected);
            rotation_at(&made, i, found);
            ck_assert(apart(CONST(expected), CONST(found)) <= 1e-14);
        }
        reading_free(&made);
    }
}
END_TEST

START_TEST(quaternions_and_matrices_are_the_same_rotations) {
    static const char *const keys[] = {"time: 1, columns: {qw: 2, qx: 3, qy: 4, qz: 5}",
                                       "time: 1, columns: {r11: 2, r12: 3, r13: 4, r21: 5, r22: 6, "
                                       "r23: 7, r31: 8, r32: 9, r33: 10}"};
    for (int matrix = 0; matrix < 2; matrix++) {
        char record[2000] = "";
        size_t length = 0;
        double R[ROWS][3][3];
        for (int i = 0; i < ROWS; i++) {
            /* half angles of three turns, multiplied as quaternions; of length 2 */
            double q[4] = {2, 0, 0, 0};
            turns(false, angles[i], R[i]);
            for (int k = 2; k >= 0; k--) {
                const double c = cos(angles[i][k] * degree / 2), s = sin(angles[i][k] * degree / 2);
                const double p[4] = {q[0], q[1], q[2], q[3]};
                const double u[3] = {k == 0, k == 1, k == 2};
                q[0] = c * p[0] - s * (p[1] * u[0] + p[2] * u[1] + p[3] * u[2]);
                q[1] = c * p[1] + s * (p[0] * u[0] + p[2] * u[2] - p[3] * u[1]);
                q[2] = c * p[2] + s * (p[0] * u[1] + p[3] * u[0] - p[1] * u[2]);
                q[3] = c * p[3] + s * (p[0] * u[2] + p[1] * u[1] - p[2] * u[0]);
            }
            length += put_row(record + length, i, matrix ? R[i][0] : q, matrix ? 9 : 4);
        }
        reading made = read_record("si", keys[matrix], record, length);
        for (size_t i = 0; i < ROWS; i++) {
            double found[3][3];
            rotation_at(&made, i, found);
            ck_assert_msg(apart(CONST(R[i]), CONST(found)) <= 1e-13, "%d: row %zu", matrix, i);
        }
        reading_free(&made);
    }
}
END_TEST

/* p = p₁ + R₁ p', R = R₁ R' */
START_TEST(poses_from_the_first_row_lead_back_to_those_of_the_file) {
    char record[2000] = "";
    size_t length = 0;
    for (int i = 0; i < ROWS; i++) {
        const double row[6] = {places[i][0], places[i][1], places[i][2],
                               angles[i][0], angles[i][1], angles[i][2]};
        length += put_row(record + length, i, row, 6);
    }
    reading made = read_record("si",
                               "time: 1, columns: {surge: 2, sway: 3, heave: 4, roll: 5, pitch: 6, "
                               "yaw: 7}, from_first: true",
                               record, length);
    double first[3][3];
    turns(false, angles[0], first);
    for (size_t i = 0; i < ROWS; i++) {
        double expected[3][3], found[3][3], back[3][3];
        turns(false, angles[i], expected);
        rotation_at(&made, i, found);
        for (int r = 0; r < 3; r++) {
            double place = places[0][r];
            for (int c = 0; c < 3; c++) {
                back[r][c] = 0;
                place += first[r][c] * at(&made, i, c);
                for (int k = 0; k < 3; k++) back[r][c] += first[r][k] * found[k][c];
            }
            ck_assert(fabs(place - places[i][r]) <= 1e-14);
        }
        ck_assert(apart(CONST(expected), CONST(back)) <= 1e-14);
    }
    reading_free(&made);
}
END_TEST

/* Unix milliseconds have 13 digits before the point: none of them is lost */
START_TEST(times_count_from_the_first_row_without_rounding) {
    static const char record[] = "1700000000123.25 0\n1700000000373.5 1\n1700000000623.75 0\n";
    reading made =
        read_record("si", "time: {column: 1, unit: ms, from: first}, columns: {heave: 2}", record,
                    sizeof record - 1);
    ck_assert(fabs(samples_of(&made)->time[0]) <= 0);
    ck_assert(fabs(samples_of(&made)->time[1] - 0.25025) <= 1e-16);
    ck_assert(made.study->record->even);
    reading_free(&made);
    made = read_record("si", "time: {step: 0.25}, columns: {heave: 2}", record, sizeof record - 1);
    ck_assert(fabs(samples_of(&made)->time[2] - 0.5) <= 0);
    ck_assert(made.study->record->even && fabs(made.study->record->interval - 0.25) <= 0);
    ck_assert(fabs(made.study->record->time_step) <= 0);
    reading_free(&made);
}
END_TEST

/* an error of a cell is at most half its last digit; that of an angle at most what the step of the record says */
START_TEST(steps_of_rotations_bound_their_rounding) {
    char record[6000] = "t,w,x,y,z\n";
    enum { MANY = 40 };
    double exact[MANY][3][3];
    size_t length = strlen(record);
    for (int i = 0; i < MANY; i++) {
        const double half = 0.3 * sin(i * 0.7), c = cos(half), s = sin(half);
        const double q[4] = {c, 0.6 * s, 0.64 * s, 0.48 * s};
        length += (size_t)sprintf(record + length, "%g,%.4f,%.4f,%.4f,%.4f\n", i * 0.05, q[0], q[1],
                                  q[2], q[3]);
        const double axis[3] = {0.6, 0.64, 0.48}, C = cos(2 * half), S = sin(2 * half);
        for (int r = 0; r < 3; r++)
            for (int k = 0; k < 3; k++) exact[i][r][k] = (r == k) * C + (1 - C) * axis[r] * axis[k];
        exact[i][0][1] -= S * axis[2], exact[i][1][0] += S * axis[2];
        exact[i][0][2] += S * axis[1], exact[i][2][0] -= S * axis[1];
        exact[i][1][2] -= S * axis[0], exact[i][2][1] += S * axis[0];
    }
    reading made =
        read_record("si", "time: t, columns: {qw: w, qx: x, qy: y, qz: z}", record, length);
    for (int a = 0; a < 3; a++) {
        const double step = made.study->record->column[GOUGH_ROLL + a].step * degree;
        double most = 0, squares = 0;
        for (size_t i = 0; i < MANY; i++) {
            double angle[3];
            ck_assert_int_eq(gough_angles_from_rotation(exact[i], angle), GOUGH_OK);
            const double error = fabs(at(&made, i, GOUGH_ROLL + a) - angle[a]);
            most = fmax(most, error);
            squares += error * error;
        }
        ck_assert(most > 0 && most <= step / 2);
        ck_assert(sqrt(squares / MANY) >= step / 60);
    }
    reading_free(&made);
}
END_TEST

/* a scale of -1 on the vector of a quaternion turns the other way round, and so does one on the angles of this motion */
START_TEST(scales_hold_for_columns_of_rotations) {
    static const char record[] = "0 2 0 0.5 0\n0.25 2 0 1 0\n0.5 2 0 0 0\n";
    reading one = read_record("si", "time: 1, columns: {qw: 2, qx: 3, qy: 4, qz: 5}", record,
                              sizeof record - 1);
    reading other =
        read_record("si",
                    "time: 1, columns: {qw: {column: 2, offset: 2}, qx: 3, qy: {column: "
                    "4, scale: -2}, qz: 5}",
                    record, sizeof record - 1);
    ck_assert(fabs(at(&one, 0, GOUGH_PITCH) - 2 * atan(0.25)) <= 1e-15);
    for (size_t row = 0; row < 3; row++)
        ck_assert(fabs(at(&one, row, GOUGH_PITCH) + at(&other, row, GOUGH_PITCH)) <= 1e-15);
    reading_free(&one);
    reading_free(&other);
}
END_TEST

int main(void) {
    return SUITE_RUN("study/records", 60, values_are_scaled_and_moved_as_written,
                     angles_of_another_order_are_the_same_rotations,
                     quaternions_and_matrices_are_the_same_rotations,
                     poses_from_the_first_row_lead_back_to_those_of_the_file,
                     times_count_from_the_first_row_without_rounding,
                     steps_of_rotations_bound_their_rounding, scales_hold_for_columns_of_rotations);
}
