/* Records that come close to a pitch of 90°, (motion-10). There roll and yaw turn fast about nearly the same axis while the
 * platform hardly turns, and a spline through them makes false accelerations. The rows are then read as angles about other
 * axes. Angles in degrees. */
#include "study/turned.h"

#include <math.h>
#include <string.h>

#include "gough/dynamics.h"

static const double DEGREE = 3.14159265358979323846 / 180;

/* Rows within 20° of the pole are examined: farther away roll and yaw change less than three times as fast as the platform
 * turns, and a spline follows them as it follows other motion. */
static const double CLOSE = 20;

/* Angles about turned axes are used where a curve through roll, pitch and yaw leaves the rotations by so much that its
 * accelerations are wrong by this part of the greatest of the motion; and by more than the rounding of angles, in degrees. */
static const double WRONG = 0.01, ROUNDING = 1e-9;

/* The pole of the new axes must be this far from all rows: the new angles then change at most four times as fast as the
 * platform turns. */
static const double FAR = 15;

static void rotation_of(const double angle[3], double R[3][3]) {
    double radians[3];
    for (int a = 0; a < 3; a++) radians[a] = angle[a] * DEGREE;
    gough_rotation_from_angles(radians, R);
}

/* Angle of the rotation from one triple to another, from |R − S|² = 8 sin²(angle/2) */
static double turn_from(const double one[3], const double other[3]) {
    double R[3][3], S[3][3], sum = 0;
    rotation_of(one, R);
    rotation_of(other, S);
    for (int k = 0; k < 9; k++) {
        const double by = R[k / 3][k % 3] - S[k / 3][k % 3];
        sum += by * by;
    }
    return 2 * asin(fmin(1, sqrt(sum / 8))) / DEGREE;
}

static const double *angles_at(const double *value, size_t row) {
    return value + row * GOUGH_COMPONENTS + GOUGH_ROLL;
}

double study_turn_between(const study_record_table *table, size_t row) {
    return turn_from(angles_at(table->value, row), angles_at(table->value, row - 1));
}

/* distance of a row from a pitch of ±90° */
static double from_pole(const double *value, size_t row) {
    return fabs(90 - fabs(remainder(angles_at(value, row)[1], 360)));
}

/* ---- are roll and yaw wrong? ---- */

/* the angles half way from a row to the next on the cubic through four rows, or on a line or parabola through fewer */
static void half_way(const study_record_table *table, const double *value, size_t row,
                     double angle[3]) {
    const size_t points = table->count < 4 ? table->count : 4;
    const size_t latest = table->count - points, first = row > 1 ? row - 1 : 0;
    const size_t begin = first < latest ? first : latest;
    const double *time = table->time + begin, t = (table->time[row] + table->time[row + 1]) / 2;
    for (int a = 0; a < 3; a++) angle[a] = 0;
    for (size_t i = 0; i < points; i++) {
        double weight = 1;
        for (size_t k = 0; k < points; k++)
            if (k != i) weight *= (t - time[k]) / (time[i] - time[k]);
        for (int a = 0; a < 3; a++) angle[a] += weight * angles_at(value, begin + i)[a];
    }
}

/* greatest second derivative of the three angles, by differences */
static double greatest_acceleration(const study_record_table *table, const double *value) {
    double most = 0;
    for (size_t i = 1; i + 1 < table->count; i++) {
        const double before = table->time[i] - table->time[i - 1];
        const double after = table->time[i + 1] - table->time[i];
        for (int a = 0; a < 3; a++) {
            const double y = angles_at(value, i)[a];
            const double rise = (angles_at(value, i + 1)[a] - y) / after;
            const double rise_before = (y - angles_at(value, i - 1)[a]) / before;
            most = fmax(most, 2 * fabs(rise - rise_before) / (before + after));
        }
    }
    return most;
}

/* The later of the two rows near the pole between which a curve through roll, pitch and yaw and one through the angles about
 * turned axes differ most; 0 if all differences are small. An error of d between rows h apart is one of 8 d/h² in the
 * acceleration. */
static size_t find_wrong(const study_record_table *table, const double *turned,
                         const double axes[4]) {
    double worst = WRONG * greatest_acceleration(table, turned);
    size_t found = 0;
    for (size_t i = 0; i + 1 < table->count; i++) {
        if (fmin(from_pole(table->value, i), from_pole(table->value, i + 1)) > CLOSE) continue;
        const double h = table->time[i + 1] - table->time[i];
        double middle[2 * GOUGH_COMPONENTS] = {0};
        half_way(table, table->value, i, middle + GOUGH_ROLL);
        gough_samples_turn(1, middle, 180, axes);
        half_way(table, turned, i, middle + GOUGH_COMPONENTS + GOUGH_ROLL);
        const double apart = turn_from(angles_at(middle, 0), angles_at(middle, 1));
        if (!(apart > ROUNDING) || !(8 * apart / h / h > worst)) continue;
        worst = 8 * apart / h / h;
        found = i + 1;
    }
    return found;
}

/* ---- what errors are about turned axes ---- */

/* the difference of two angles without whole turns */
static double apart(double a, double b) { return a - b - 360 * rint((a - b) / 360); }

/* What independent errors of roll, pitch and yaw are for the angles about turned axes, in degrees. */
typedef struct spread {
    double greatest[3]; /* largest sum of the errors in a row */
    double mean
        [3]; /* root mean square of those that have the root mean square `mean` of study_quantum */
} spread;

/* By moving each angle of each row: the errors are halves of steps. */
static spread spread_of(const study_record_table *table, const double axes[4],
                        const study_quantum step[3]) {
    spread found = {{0, 0, 0}, {0, 0, 0}};
    for (size_t i = 0; i < table->count; i++) {
        const double *value = table->value + i * GOUGH_COMPONENTS;
        double here[GOUGH_COMPONENTS], sum[3] = {0, 0, 0};
        memcpy(here, value, sizeof here);
        gough_samples_turn(1, here, 180, axes);
        for (int a = 0; a < 3; a++) {
            if (!(step[a].greatest > 0)) continue;
            const double share = step[a].mean / step[a].greatest;
            double moved[GOUGH_COMPONENTS];
            memcpy(moved, value, sizeof moved);
            moved[GOUGH_ROLL + a] += step[a].greatest / 2;
            gough_samples_turn(1, moved, 180, axes);
            for (int b = 0; b < 3; b++) {
                const double error = 2 * fabs(apart(moved[GOUGH_ROLL + b], here[GOUGH_ROLL + b]));
                sum[b] += error;
                found.mean[b] += error * error * share * share / (double)table->count;
            }
        }
        for (int b = 0; b < 3; b++) found.greatest[b] = fmax(found.greatest[b], sum[b]);
    }
    for (int b = 0; b < 3; b++) found.mean[b] = sqrt(found.mean[b]);
    return found;
}

/* the steps of the columns and the deviations asked for, as those of the angles about turned axes */
static void carry_over(const study_record_table *table, const double axes[4],
                       study_smoothing *smoothing, study_quantum step[GOUGH_COMPONENTS]) {
    const spread rounding = spread_of(table, axes, step + GOUGH_ROLL);
    study_quantum allowed[3];
    for (int a = 0; a < 3; a++) {
        const double deviation = smoothing->deviation[GOUGH_ROLL + a];
        allowed[a] = (study_quantum){deviation, deviation};
    }
    const spread deviations = spread_of(table, axes, allowed);
    for (int a = 0; a < 3; a++) {
        step[GOUGH_ROLL + a] = (study_quantum){rounding.greatest[a], rounding.mean[a]};
        smoothing->deviation[GOUGH_ROLL + a] = deviations.mean[a];
    }
}

/* ---- the record ---- */

static bool comes_close(const study_record_table *table) {
    for (size_t i = 0; i < table->count; i++)
        if (from_pole(table->value, i) <= CLOSE) return true;
    return false;
}

void study_record_turn(study_record_table *table, study_recording *recording,
                       study_quantum step[GOUGH_COMPONENTS], double *copy) {
    const size_t values = table->count * GOUGH_COMPONENTS;
    double axes[4];
    if (!comes_close(table)) return;
    const double distance = gough_samples_axes(table->count, table->value, 180, axes);
    table->crowded = !(distance >= FAR);
    if (table->crowded) return;
    memcpy(copy, table->value, values * sizeof *copy);
    gough_samples_turn(table->count, copy, 180, axes);
    gough_samples_unwrap(table->count, copy, 180);
    const size_t wrong = find_wrong(table, copy, axes);
    if (!wrong) return;
    table->turned = wrong;
    table->pole = fmin(from_pole(table->value, wrong - 1), from_pole(table->value, wrong));
    carry_over(table, axes, &recording->smoothing, step);
    memcpy(table->value, copy, values * sizeof *copy);
    memcpy(recording->samples->axes, axes, sizeof axes);
    recording->record->turned = true;
    recording->record->pole_distance = distance;
}
