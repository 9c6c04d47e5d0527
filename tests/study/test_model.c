/* What a right study becomes: exactly the intended model, and what --set makes of it. */
#include <math.h>
#include <string.h>

#include "study/helpers.h"
#include "support/suite.h"

static const double pi = 3.14159265358979323846;

/* numbers typed in the file arrive as the same double that the compiler makes of them */
#define EXACTLY(a, b) ck_assert_msg((a) <= (b) && (a) >= (b), "%s is %.17g", #a, (double)(a))
#define NEARLY(a, b) ck_assert_msg(fabs((a) - (b)) <= 1e-15, "%s is %.17g", #a, (double)(a))

static double value(const gough_formula *formula, double t) {
    double jet[3];
    gough_formula_evaluate(formula, t, jet);
    return jet[0];
}

static const char *const everything =
    "title: 'All of it'\n"
    "units: si\n"
    "platform:\n"
    "  base: {joints: [[1, 0.2, 0], [-0.3, 1, 0], [-0.7, 0.7, 0.01], [-0.7, -0.7, 0], [-0.3, -1, "
    "0], [1, -0.2, 0]]}\n"
    "  top: {radius: 0.6, half_angle: 10}\n"
    "  height: 1.25\n"
    "  legs: {length: [0.5, 2.5], max_speed: .75, max_force: +1.5e4}\n"
    "load:\n"
    "  mass: 10.5\n"
    "  center_of_mass: [0.01, -0.02, 0.3]\n"
    "  inertia:\n"
    "    - [0.8, 0.01, 0.02]\n"
    "    - [0.01, 0.9, 0.03]\n"
    "    - [0.02, 0.03, 1.5]\n"
    "gravity: [0.1, 0.2, -9.7]\n"
    "motion:\n"
    "  surge: 0.1*t\n"
    "  heave: \"0.1*sin(t)\"\n"
    "  yaw: 5\n"
    "  about: [0, 0.1, 0.2]\n"
    "  period: 6.25\n"
    "disturbance:\n"
    "  leg_force: [1, t, 0, 0, 0, 'atan2(t, 1)']\n"
    "  vertical_force: 2*t\n"
    "  force: [0, t^2, 0]\n"
    "  moment: [0, 0, -3]\n"
    "control: {feedforward: none, stiffness: [1, 2, 3, 4, 5, 6], damping: 2.5}\n"
    "initial:\n"
    "  heave: 0.125\n"
    "  roll: 3\n"
    "  velocity: [0, 0, 1]\n"
    "  angular_velocity: [180, 0, -90]\n"
    "simulation:\n"
    "  duration: 10\n"
    "  output_step: 0.1\n"
    "  method: rk4\n"
    "  step: 0.01\n"
    "  constraints: {baumgarte: [3, 4]}\n";

static reading read_everything(void) {
    reading made = read_bytes(everything, strlen(everything), NULL);
    ck_assert_msg(made.status == GOUGH_OK, "%s", made.messages ? made.messages : "");
    return made;
}

START_TEST(machine_has_the_numbers_of_the_file) {
    reading made = read_everything();
    const gough_machine *machine = &made.study->model->machine;
    const gough_platform expected = gough_platform_symmetric(1, 0, 0.6, 10 * pi / 180, 1.25);
    const gough_platform *platform = &machine->platform;
    ck_assert_str_eq(made.study->title, "All of it");
    ck_assert_str_eq(made.study->text, everything);
    ck_assert_str_eq(made.study->name, "study.yaml");
    ck_assert(!made.study->dimensionless);
    EXACTLY(platform->base[0][1], 0.2);
    EXACTLY(platform->base[2][2], 0.01);
    EXACTLY(platform->base[5][0], 1);
    for (int leg = 0; leg < GOUGH_LEGS; leg++)
        for (int i = 0; i < 3; i++) NEARLY(platform->top[leg][i], expected.top[leg][i]);
    EXACTLY(platform->height, 1.25);
    const gough_limits limits = gough_limits_of(machine, &made.study->model->motion);
    for (int leg = 0; leg < GOUGH_LEGS; leg++) {
        EXACTLY(limits.length[leg][0], 0.5);
        EXACTLY(limits.length[leg][1], 2.5);
        EXACTLY(limits.speed[leg], 0.75);
        EXACTLY(limits.force[leg][0], -15000);
        EXACTLY(limits.force[leg][1], 15000);
    }
    EXACTLY(machine->load.mass, 10.5);
    EXACTLY(machine->load.center_of_mass[1], -0.02);
    EXACTLY(machine->load.inertia[1][1], 0.9);
    EXACTLY(machine->load.inertia[2][1], 0.03);
    EXACTLY(machine->gravity[0], 0.1);
    EXACTLY(machine->gravity[2], -9.7);
    /* the base is a list of points, so R_b is their mean distance from their centroid */
    ck_assert(machine->base_radius > 0.9 && machine->base_radius < 1.1);
    reading_free(&made);
}
END_TEST

START_TEST(motion_and_forces_are_those_of_the_file) {
    reading made = read_everything();
    const gough_model *model = made.study->model;
    double component[GOUGH_COMPONENTS][3];
    gough_motion_evaluate(&model->motion, 2, component);
    ck_assert_int_eq(model->motion.kind, GOUGH_MOTION_FORMULAS);
    NEARLY(component[GOUGH_SURGE][0], 0.2);
    NEARLY(component[GOUGH_SURGE][1], 0.1);
    NEARLY(component[GOUGH_SWAY][0], 0);
    NEARLY(component[GOUGH_HEAVE][0], 0.1 * sin(2));
    NEARLY(component[GOUGH_YAW][0], 5 * pi / 180);
    EXACTLY(model->motion.about[1], 0.1);
    EXACTLY(model->motion.period, 6.25);
    NEARLY(value(&model->disturbance.leg_force[0], 2), 1);
    NEARLY(value(&model->disturbance.leg_force[1], 2), 2);
    NEARLY(value(&model->disturbance.leg_force[5], 2), atan2(2, 1));
    ck_assert(gough_formula_is_zero(&model->disturbance.leg_force[3]));
    NEARLY(value(&model->disturbance.vertical_force, 2), 4);
    NEARLY(value(&model->disturbance.force[1], 2), 4);
    NEARLY(value(&model->disturbance.moment[2], 2), -3);
    ck_assert(!model->control.feedforward);
    EXACTLY(model->control.stiffness[4], 5);
    EXACTLY(model->control.damping[5], 2.5);
    reading_free(&made);
}
END_TEST

START_TEST(start_and_run_are_those_of_the_file) {
    reading made = read_everything();
    const gough_initial *initial = &made.study->model->initial;
    const gough_simulation *run = &made.study->simulation;
    ck_assert(initial->given[GOUGH_HEAVE] && initial->given[GOUGH_ROLL]);
    ck_assert(!initial->given[GOUGH_SURGE] && !initial->given[GOUGH_YAW]);
    EXACTLY(initial->component[GOUGH_HEAVE], 0.125);
    NEARLY(initial->component[GOUGH_ROLL], 3 * pi / 180);
    ck_assert(initial->velocity_given && initial->angular_velocity_given);
    EXACTLY(initial->velocity[2], 1);
    NEARLY(initial->angular_velocity[0], pi);
    NEARLY(initial->angular_velocity[2], -pi / 2);
    EXACTLY(run->duration, 10);
    EXACTLY(run->output_step, 0.1);
    EXACTLY(run->step, 0.01);
    ck_assert_int_eq(run->method, GOUGH_RK4);
    ck_assert_int_eq(run->constraints, GOUGH_BAUMGARTE);
    EXACTLY(run->baumgarte[0], 3);
    EXACTLY(run->baumgarte[1], 4);
    ck_assert_int_eq(run->precision, GOUGH_DOUBLE);
    reading_free(&made);
}
END_TEST

START_TEST(what_is_left_out_has_the_defaults) {
    reading made = expect_good("", NULL);
    const gough_model *model = made.study->model;
    const gough_platform *platform = &model->machine.platform;
    const gough_platform expected =
        gough_platform_symmetric(1, 15 * pi / 180, 0.6, 15 * pi / 180, 1.2);
    double component[GOUGH_COMPONENTS][3];
    ck_assert(made.study->dimensionless);
    for (int leg = 0; leg < GOUGH_LEGS; leg++)
        for (int i = 0; i < 3; i++) {
            NEARLY(platform->base[leg][i], expected.base[leg][i]);
            NEARLY(platform->top[leg][i], expected.top[leg][i]);
        }
    EXACTLY(model->machine.base_radius, 1);
    EXACTLY(model->machine.gravity[2], -1);
    const gough_limits limits = gough_limits_of(&model->machine, &model->motion);
    EXACTLY(limits.length[5][0], 0);
    ck_assert(isinf(limits.length[5][1]) && isinf(limits.speed[5]));
    ck_assert(isinf(limits.force[5][0]) && isinf(limits.force[5][1]));
    gough_motion_evaluate(&model->motion, 3, component);
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        EXACTLY(component[c][0], 0);
        ck_assert(!model->initial.given[c]);
    }
    ck_assert(!model->initial.velocity_given && !model->initial.angular_velocity_given);
    for (int leg = 0; leg < GOUGH_LEGS; leg++) {
        ck_assert(gough_formula_is_zero(&model->disturbance.leg_force[leg]));
        EXACTLY(model->control.stiffness[leg], 0);
        EXACTLY(model->control.damping[leg], 0);
    }
    ck_assert(gough_formula_is_zero(&model->disturbance.vertical_force));
    ck_assert(model->control.feedforward);
    EXACTLY(made.study->simulation.duration, 20);
    EXACTLY(made.study->simulation.output_step, 0.05);
    EXACTLY(made.study->simulation.tolerance, 1e-10);
    EXACTLY(made.study->simulation.step, 0);
    ck_assert_int_eq(made.study->simulation.method, GOUGH_DOP853);
    ck_assert_int_eq(made.study->simulation.constraints, GOUGH_PROJECTION);
    reading_free(&made);
}
END_TEST

START_TEST(gravity_depends_on_the_units) {
    reading made = expect_good("", (const char *const[]){"units=si", NULL});
    EXACTLY(made.study->model->machine.gravity[2], -9.80665);
    reading_free(&made);
    made = expect_good("", (const char *const[]){"units=", NULL});
    EXACTLY(made.study->model->machine.gravity[2], -9.80665);
    reading_free(&made);
    made = expect_good("gravity: 1.625\n", NULL);
    EXACTLY(made.study->model->machine.gravity[2], -1.625);
    reading_free(&made);
    made = expect_good("gravity: 0\n", NULL);
    EXACTLY(made.study->model->machine.gravity_magnitude, 0);
    reading_free(&made);
}
END_TEST

START_TEST(moves_are_those_of_the_file) {
    reading made = expect_good("motion:\n"
                               "  moves:\n"
                               "    - {start: 1, duration: 2, heave: 0.125, yaw: 90}\n"
                               "    - {start: 3.5, duration: 1, heave: 0}\n",
                               NULL);
    const gough_motion *motion = &made.study->model->motion;
    double component[GOUGH_COMPONENTS][3];
    ck_assert_int_eq(motion->kind, GOUGH_MOTION_MOVES);
    ck_assert_uint_eq(motion->moves, 2);
    EXACTLY(motion->move[0].start, 1);
    EXACTLY(motion->move[0].duration, 2);
    EXACTLY(motion->move[0].target[GOUGH_HEAVE], 0.125);
    NEARLY(motion->move[0].target[GOUGH_YAW], pi / 2);
    ck_assert(motion->move[0].given[GOUGH_HEAVE] && !motion->move[0].given[GOUGH_SURGE]);
    ck_assert(!motion->move[1].given[GOUGH_YAW]);
    gough_motion_evaluate(motion, 2, component); /* half way */
    NEARLY(component[GOUGH_HEAVE][0], 0.0625);
    gough_motion_evaluate(motion, 5, component);
    NEARLY(component[GOUGH_HEAVE][0], 0);
    NEARLY(component[GOUGH_YAW][0], pi / 2);
    reading_free(&made);
    /* ends that meet up to rounding: 0.1 + 0.2 > 0.3 in double */
    made = expect_good("motion: {moves: [{start: 0.1, duration: 0.2, heave: 0.1}, "
                       "{start: 0.3, duration: 1, heave: 0}]}\n",
                       NULL);
    reading_free(&made);
}
END_TEST

/* to a few roundings */
#define ABOUT(a, b)                                                                                \
    ck_assert_msg(fabs((a) / (b)-1) <= 1e-14, "%s is %.17g, not %.17g", #a, (double)(a),           \
                  (double)(b))

/* (motion-13): 15/8 of the way at the speed, and the root of 10/√3 of it at the acceleration */
START_TEST(durations_follow_from_limits) {
    reading made =
        expect_good("motion: {moves: [{heave: 0.1, speed: 0.2}, {surge: 0.03, heave: "
                    "0.14, acceleration: 0.5}, {yaw: 10, angular_speed: 5, start: 9}]}\n",
                    NULL);
    const gough_move *move = made.study->model->motion.move;
    EXACTLY(move[0].start, 0);
    ABOUT(move[0].duration, 15.0 / 8 * 0.1 / 0.2);
    EXACTLY(move[1].start, move[0].duration);
    ABOUT(move[1].duration, sqrt(10 / sqrt(3) * 0.05 / 0.5)); /* 3, 4, 5 */
    EXACTLY(move[2].start, 9);
    ABOUT(move[2].duration, 15.0 / 8 * 2);
    reading_free(&made);
    made = expect_good("motion: {frequency: 2, amplitude: 3, moves: [{heave: 0.1, speed: 0.2}]}\n",
                       NULL);
    ABOUT(made.study->model->motion.move[0].duration, 15.0 / 8 * 0.3 / 0.2 * 2);
    reading_free(&made);
}
END_TEST

START_TEST(motion_is_scaled_where_a_factor_is_given) {
    reading made = expect_good("motion: {heave: 0.5*t, yaw: 90*t}\n", NULL);
    double c[GOUGH_COMPONENTS][3];
    ck_assert(!made.study->model->motion.scaled);
    reading_free(&made);

    made = expect_good("motion: {heave: 0.5*t, yaw: 90*t, frequency: 0.25}\n", NULL);
    ck_assert(made.study->model->motion.scaled);
    EXACTLY(made.study->model->motion.amplitude, 1);
    EXACTLY(made.study->model->motion.frequency, 0.25);
    reading_free(&made);

    made = expect_good("motion: {heave: 0.5*t, yaw: 90*t, amplitude: 9}\n",
                       (const char *const[]){"motion.amplitude=-2", "motion.frequency=3", NULL});
    gough_motion_evaluate(&made.study->model->motion, 0.5, c);
    EXACTLY(c[GOUGH_HEAVE][0], -1.5);
    EXACTLY(c[GOUGH_HEAVE][1], -3);
    NEARLY(c[GOUGH_YAW][0], -1.5 * pi);
    reading_free(&made);

    made = expect_good("motion: {amplitude: 2, moves: [{start: 0, duration: 1, heave: 0.125}]}\n",
                       NULL);
    gough_motion_evaluate(&made.study->model->motion, 1, c);
    EXACTLY(c[GOUGH_HEAVE][0], 0.25);
    reading_free(&made);
}
END_TEST

START_TEST(motion_does_not_run_backwards_or_stand_by_its_frequency) {
    static const char *const bad[] = {"0", "-1", ".nan", "t"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        char setting[100] = "motion.frequency=";
        reading made = read_more("motion: {heave: 0.5*t}\n",
                                 (const char *const[]){strcat(setting, bad[i]), NULL});
        ck_assert_msg(made.status == GOUGH_ERROR_INPUT, "%s", setting);
        ck_assert_msg(strstr(made.messages, "motion.frequency"), "%s", made.messages);
        reading_free(&made);
    }
}
END_TEST

START_TEST(numbers_are_correctly_rounded) {
    static const struct {
        const char *text;
        double value;
    } numbers[] = {
        {"height=1", 1},
        {"height=+1.", 1},
        {"height=.5", 0.5},
        {"height=5e-1", 0.5},
        {"height=1E0", 1},
        {"height=0.1", 0.1},
        {"height=1.2000000000000001776356839400250464677810668945312500", 0x1.3333333333334p0},
        {"height=0.30000000000000004", 0.30000000000000004},
        {"height=1.00000000000000011102230246251565404236316680908203125", 1},
        {"height=1.00000000000000011102230246251565404236316680908203126", 0x1.0000000000001p0},
        {"height=00001.5", 1.5},
    };
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        char setting[200] = "platform.";
        strcat(setting, numbers[i].text);
        reading made = expect_good("", (const char *const[]){setting, NULL});
        EXACTLY(made.study->model->machine.platform.height, numbers[i].value);
        reading_free(&made);
    }
}
END_TEST

int main(void) {
    return SUITE_RUN("study/model", 30, machine_has_the_numbers_of_the_file,
                     motion_and_forces_are_those_of_the_file, start_and_run_are_those_of_the_file,
                     what_is_left_out_has_the_defaults, gravity_depends_on_the_units,
                     moves_are_those_of_the_file, durations_follow_from_limits,
                     motion_is_scaled_where_a_factor_is_given,
                     motion_does_not_run_backwards_or_stand_by_its_frequency,
                     numbers_are_correctly_rounded);
}
