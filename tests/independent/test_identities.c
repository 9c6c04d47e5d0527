/* Identities along simulated runs, whatever formulation they came from: accelerations are
 * differences of velocities, velocities are differences of poses, power is the rate of change of
 * energy, forces are the rate of change of momentum. A round trip through inverse and forward
 * dynamics proves none of these.
 * Sanitized: campaign: run/ends and run/order run the same code under sanitizers.
 */
#include <check.h>
#include <math.h>
#include <string.h>

#include "independent/studies.h"

enum { ROWS = 8001, REACH = 4 };

/* Rows each 0.0025: the stencil's own error is (0.0025 ω)⁸/630, 1e-13 at the fastest frequency,
 * some 25; differences of rows whose errors are 1e-13 come out with 1e-10. */
static const double STEP = 0.0025, TOLERANCE = 1e-7;

static gough_model model; /* large */
static double rows[ROWS][GOUGH_COLUMNS];
static int count;

static int keep(void *context, const gough_row *row) {
    (void)context;
    ck_assert_int_lt(count, ROWS);
    memcpy(rows[count++], row->value, sizeof rows[0]);
    return 0;
}

static const struct {
    const char *name;
    bool feedforward;
    double stiffness, damping;
    gough_method method;
    double step, duration;
} RUNS[] = {
    {"feedback", true, 50, 2, GOUGH_DOP853, 0, 20},
    {"feedback without damping", true, 50, 0, GOUGH_DOP853, 0, 20},
    {"no feed-forward", false, 100, 5, GOUGH_DOP853, 0, 20},
    {"open loop", true, 0, 0, GOUGH_DOP853, 0, 1.5},
    {"rattle8", true, 50, 2, GOUGH_RATTLE8, 0.0025, 20},
};
enum { RUN_COUNT = sizeof RUNS / sizeof RUNS[0] };

static void simulate(int run) {
    gough_end end;
    gough_error error = {.message = ""};
    general_study(&model, NULL, RUNS[run].feedforward, RUNS[run].stiffness, RUNS[run].damping);
    gough_simulation options = gough_simulation_default();
    options.duration = RUNS[run].duration;
    options.output_step = STEP;
    options.tolerance = 1e-13;
    options.method = RUNS[run].method;
    options.step = RUNS[run].step;
    count = 0;
    const gough_status status = gough_simulate(&model, &options, keep, NULL, &end, &error);
    ck_assert_msg(status == GOUGH_OK, "%s: %s%s", RUNS[run].name, error.message, end.message);
    ck_assert_int_eq(count, (int)(RUNS[run].duration / STEP + 1.5));
}

/* ---- differences ---- */

/* central difference of order 8 of a quantity of rows, at row i */
static double difference(double (*quantity)(const double *row, int which), int which, int i) {
    static const double WEIGHT[REACH] = {4. / 5, -1. / 5, 4. / 105, -1. / 280};
    double sum = 0;
    for (int k = 1; k <= REACH; k++)
        sum += WEIGHT[k - 1] * (quantity(rows[i + k], which) - quantity(rows[i - k], which));
    return sum / STEP;
}

static double column(const double *row, int which) { return row[which]; }

static void columns_are_rates(int value, int rate, int columns, int run) {
    double worst = 0;
    for (int i = REACH; i < count - REACH; i++) {
        for (int c = 0; c < columns; c++) {
            const double error = fabs(difference(column, value + c, i) - rows[i][rate + c]);
            worst = error <= worst ? worst : error;
        }
    }
    ck_assert_msg(worst <= TOLERANCE, "%s: column %d is the rate of %d but for %g", RUNS[run].name,
                  rate, value, worst);
}

static void velocities_are_differences_of_positions(int run) {
    columns_are_rates(GOUGH_X, GOUGH_VX, 3, run);
}

static void accelerations_are_differences_of_velocities(int run) {
    columns_are_rates(GOUGH_VX, GOUGH_AX, 3, run);
    columns_are_rates(GOUGH_WX, GOUGH_ALX, 3, run);
}

static void leg_rates_are_differences_of_lengths(int run) {
    columns_are_rates(GOUGH_L, GOUGH_DL, 6, run);
}

/* ---- rotation ---- */

/* R = Rz(yaw) Ry(pitch) Rx(roll) of a row */
static void rotation_of(const double *row, double R[3][3]) {
    const double cr = cos(row[GOUGH_ROLL_ANGLE]), sr = sin(row[GOUGH_ROLL_ANGLE]);
    const double cp = cos(row[GOUGH_PITCH_ANGLE]), sp = sin(row[GOUGH_PITCH_ANGLE]);
    const double cy = cos(row[GOUGH_YAW_ANGLE]), sy = sin(row[GOUGH_YAW_ANGLE]);
    R[0][0] = cy * cp, R[0][1] = cy * sp * sr - sy * cr, R[0][2] = cy * sp * cr + sy * sr;
    R[1][0] = sy * cp, R[1][1] = sy * sp * sr + cy * cr, R[1][2] = sy * sp * cr - cy * sr;
    R[2][0] = -sp, R[2][1] = cp * sr, R[2][2] = cp * cr;
}

static double rotation_entry(const double *row, int which) {
    double R[3][3];
    rotation_of(row, R);
    return R[which / 3][which % 3];
}

/* Ṙ Rᵀ is skew, and its axial vector is ω */
static void angular_velocities_are_differences_of_rotations(int run) {
    double worst = 0;
    for (int i = REACH; i < count - REACH; i++) {
        double R[3][3], rate[3][3], W[3][3];
        rotation_of(rows[i], R);
        for (int e = 0; e < 9; e++) rate[e / 3][e % 3] = difference(rotation_entry, e, i);
        for (int a = 0; a < 3; a++)
            for (int b = 0; b < 3; b++)
                W[a][b] = rate[a][0] * R[b][0] + rate[a][1] * R[b][1] + rate[a][2] * R[b][2];
        const double *w = rows[i] + GOUGH_WX;
        const double skew[3][3] = {{0, -w[2], w[1]}, {w[2], 0, -w[0]}, {-w[1], w[0], 0}};
        for (int a = 0; a < 3; a++) {
            for (int b = 0; b < 3; b++) {
                const double error = fabs(W[a][b] - skew[a][b]);
                worst = error <= worst ? worst : error;
            }
        }
    }
    ck_assert_msg(worst <= TOLERANCE, "%s: off by %g", RUNS[run].name, worst);
}

/* ---- momentum and energy of the load ---- */

static void cross(const double a[3], const double b[3], double out[3]) {
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* Centre of mass from the top frame's origin, its velocity, and angular momentum about it, base
 * axes. */
static void load_of(const double *row, double center[3], double velocity[3], double momentum[3]) {
    const gough_load *load = &model.machine.load;
    double R[3][3], arm[3], turn[3], local[3], L[3];
    rotation_of(row, R);
    for (int i = 0; i < 3; i++) {
        arm[i] = local[i] = 0;
        for (int j = 0; j < 3; j++) {
            arm[i] += R[i][j] * load->center_of_mass[j];
            local[i] += R[j][i] * row[GOUGH_WX + j];
        }
    }
    cross(row + GOUGH_WX, arm, turn);
    for (int i = 0; i < 3; i++) {
        center[i] = row[GOUGH_X + i] + arm[i];
        velocity[i] = row[GOUGH_VX + i] + turn[i];
        L[i] = 0;
        for (int j = 0; j < 3; j++) L[i] += load->inertia[i][j] * local[j];
    }
    for (int i = 0; i < 3; i++) {
        momentum[i] = 0;
        for (int j = 0; j < 3; j++) momentum[i] += R[i][j] * L[j];
    }
}

/* kinetic energy and that of the weight; and the two momenta, 1 … 6 */
static double balance(const double *row, int which) {
    const double mass = model.machine.load.mass, *gravity = model.machine.gravity;
    double center[3], velocity[3], momentum[3];
    load_of(row, center, velocity, momentum);
    if (which > 3) return momentum[which - 4];
    if (which > 0) return mass * velocity[which - 1];
    double energy = 0;
    for (int i = 0; i < 3; i++)
        energy += mass * velocity[i] * velocity[i] / 2 + momentum[i] * row[GOUGH_WX + i] / 2 -
                  mass * gravity[i] * center[i];
    return energy;
}

/* Force and moment about the centre of mass of legs, weight and disturbances, from joints,
 * lengths and forces of a row. */
static void loads_on(const double *row, double force[3], double moment[3], double external[6]) {
    const gough_platform *p = &model.machine.platform;
    double R[3][3], center[3], velocity[3], momentum[3];
    newton_real leg[6], vertical, on_load[3], turning[3];
    general_disturbance(row[GOUGH_T], leg, &vertical, on_load, turning);
    rotation_of(row, R);
    load_of(row, center, velocity, momentum);
    for (int i = 0; i < 3; i++) {
        external[i] = (double)on_load[i];
        external[i + 3] = (double)turning[i];
        force[i] = model.machine.load.mass * model.machine.gravity[i] + external[i];
        moment[i] = external[i + 3];
    }
    for (int n = 0; n < GOUGH_LEGS; n++) {
        double joint[3], along[3], arm[3], turn[3];
        for (int i = 0; i < 3; i++) {
            joint[i] = row[GOUGH_X + i];
            for (int j = 0; j < 3; j++) joint[i] += R[i][j] * p->top[n][j];
            along[i] = joint[i] - p->base[n][i];
            arm[i] = joint[i] - center[i];
        }
        const double length = sqrt(along[0] * along[0] + along[1] * along[1] + along[2] * along[2]);
        ck_assert(fabs(length - row[GOUGH_L + n]) <= 1e-14);
        for (int i = 0; i < 3; i++) along[i] *= row[GOUGH_F + n] / length;
        cross(arm, along, turn);
        for (int i = 0; i < 3; i++) {
            force[i] += along[i];
            moment[i] += turn[i];
        }
    }
}

/* Newton and Euler: the rates of change of both momenta are what acts */
static void forces_are_rates_of_change_of_momentum(int run) {
    double worst = 0;
    for (int i = REACH; i < count - REACH; i++) {
        double load[6], external[6];
        loads_on(rows[i], load, load + 3, external);
        for (int k = 0; k < 6; k++) {
            const double error = fabs(difference(balance, k + 1, i) - load[k]);
            worst = error <= worst ? worst : error;
        }
    }
    ck_assert_msg(worst <= TOLERANCE, "%s: off by %g", RUNS[run].name, worst);
}

/* what legs and disturbances put in is what the load's energy gains */
static void power_is_the_rate_of_change_of_energy(int run) {
    double worst = 0;
    for (int i = REACH; i < count - REACH; i++) {
        double force[3], moment[3], external[6], center[3], velocity[3], momentum[3], power = 0;
        loads_on(rows[i], force, moment, external);
        load_of(rows[i], center, velocity, momentum);
        for (int n = 0; n < GOUGH_LEGS; n++) {
            power += rows[i][GOUGH_P + n];
            ck_assert(fabs(rows[i][GOUGH_P + n] - rows[i][GOUGH_F + n] * rows[i][GOUGH_DL + n]) <=
                      1e-14);
        }
        for (int k = 0; k < 3; k++)
            power += external[k] * velocity[k] + external[k + 3] * rows[i][GOUGH_WX + k];
        const double error = fabs(difference(balance, 0, i) - power);
        worst = error <= worst ? worst : error;
    }
    ck_assert_msg(worst <= TOLERANCE, "%s: off by %g", RUNS[run].name, worst);
}

/* over the whole run: the energy gained is the integral of the power, by Boole's rule (error of
 * order 6) */
static void work_is_the_change_of_energy(int run) {
    static const double BOOLE[5] = {7, 32, 12, 32, 7};
    double work = 0;
    for (int i = 0; i + 4 < count; i += 4) {
        for (int k = 0; k <= 4; k++) {
            double force[3], moment[3], external[6], center[3], velocity[3], momentum[3];
            const double *row = rows[i + k];
            loads_on(row, force, moment, external);
            load_of(row, center, velocity, momentum);
            double power = 0;
            for (int n = 0; n < GOUGH_LEGS; n++) power += row[GOUGH_P + n];
            for (int a = 0; a < 3; a++)
                power += external[a] * velocity[a] + external[a + 3] * row[GOUGH_WX + a];
            work += BOOLE[k] * power * 4 * STEP / 90;
        }
    }
    const double gain = balance(rows[count - 1], 0) - balance(rows[0], 0);
    ck_assert_msg(fabs(work - gain) <= 1e-9, "%s: %.12g of work, %.12g gained", RUNS[run].name,
                  work, gain);
}

START_TEST(simulated_runs_keep_the_identities) {
    simulate(_i);
    velocities_are_differences_of_positions(_i);
    accelerations_are_differences_of_velocities(_i);
    leg_rates_are_differences_of_lengths(_i);
    angular_velocities_are_differences_of_rotations(_i);
    forces_are_rates_of_change_of_momentum(_i);
    power_is_the_rate_of_change_of_energy(_i);
    work_is_the_change_of_energy(_i);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("identities");
    TCase *tests = tcase_create("identities");
    tcase_set_timeout(tests, 120);
    tcase_add_loop_test(tests, simulated_runs_keep_the_identities, 0, RUN_COUNT);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? 0 : 1;
}
