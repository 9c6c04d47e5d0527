/* Values that are right each by itself and wrong together: keys that exclude or need one another, impossible machines, and
 * options that do not fit; each error at the key that it is about. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "study/helpers.h"
#include "support/suite.h"

/* Expects exactly one error, at that place, with this in its sentence. */
static void expect_one(const char *text, const char *place, const char *part) {
    char begin[100];
    reading made = read_bytes(text, strlen(text), NULL);
    snprintf(begin, sizeof begin, "study.yaml:%s: error: ", place);
    ck_assert_msg(made.status == GOUGH_ERROR_INPUT, "accepted:\n%s", text);
    ck_assert_msg(strncmp(made.messages, begin, strlen(begin)) == 0, "expected %s\nfound %s", begin,
                  made.messages);
    ck_assert_msg(strstr(made.messages, part), "expected %s\nfound %s", part, made.messages);
    ck_assert_int_eq(occurrences(made.messages, ": error: "), 1);
    reading_free(&made);
}

static void expect_one_more(const char *more, const char *place, const char *part) {
    char text[4000];
    snprintf(text, sizeof text, "%s%s", good_study, more);
    expect_one(text, place, part);
}

/* A study of a platform and a load written in one line each. */
static void expect_machine(const char *base, const char *top, const char *load, const char *place,
                           const char *part) {
    char text[4000];
    snprintf(text, sizeof text, "platform:\n  base: %s\n  top: %s\n  height: 1\nload: %s\n", base,
             top, load);
    expect_one(text, place, part);
}

static const char *const ring = "{radius: 1, half_angle: 15}";
static const char *const small_ring = "{radius: 0.6, half_angle: 15}";
static const char *const body = "{mass: 1, inertia: [1, 1, 1]}";

START_TEST(a_ring_is_given_in_one_way_and_whole) {
    expect_machine("{radius: 1}", ring, body, "2:3", "`platform.base.half_angle` is missing");
    expect_machine(ring, "{half_angle: 15}", body, "3:3", "`platform.top.radius` is missing");
    expect_machine("{}", ring, body, "2:3",
                   "`platform.base` needs radius and half_angle, or joints");
    expect_machine("{radius: 1, joints: [[1, 0, 0], [0, 1, 0], [1, 1, 0], [2, 0, 0], [0, 2, 0], "
                   "[2, 2, 0]]}",
                   ring, body, "2:21", "has both `joints` and `radius`");
}
END_TEST

START_TEST(joints_of_one_ring_may_be_listed_and_the_other_round) {
    static const char text[] = "platform:\n"
                               "  base: {radius: 2, half_angle: 15}\n"
                               "  top: {joints: [[1, 0, 0], [0, 1, 0], [-1, 1, 0], [-2, 0, 0], "
                               "[0, -1, 0], [1, -1, 0.5]]}\n"
                               "  height: 1\n"
                               "load: {mass: 1, inertia: [1, 1, 1]}\n";
    reading made = read_bytes(text, sizeof text - 1, NULL);
    ck_assert_msg(made.status == GOUGH_OK, "%s", made.messages ? made.messages : "");
    ck_assert(made.study->model->machine.base_radius >= 2);
    ck_assert(made.study->model->machine.base_radius <= 2);
    ck_assert(made.study->model->machine.platform.top[5][2] >= 0.5);
    reading_free(&made);
}
END_TEST

START_TEST(impossible_machines_are_errors_at_their_part) {
    expect_machine(ring, small_ring, "{mass: 1, inertia: [1, 1, 3]}", "5:17",
                   "no body has this inertia");
    expect_machine(ring, small_ring, "{mass: 1, inertia: [1, 1, -1]}", "5:17",
                   "no body has this inertia");
    expect_machine(ring, small_ring, "{mass: 1, inertia: [[1, 0.2, 0], [0.1, 1, 0], [0, 0, 1]]}",
                   "5:41", "`load.inertia` must be symmetric: the opposite element is `0.2`");
    /* similar hexagons: the same spacing in base and top, leg by leg */
    expect_machine("{joints: [[1, 0, 0], [0.5, 1, 0], [-0.5, 1, 0], [-1, 0, 0], [-0.5, -1, 0], "
                   "[0.5, -1, 0]]}",
                   "{joints: [[0.5, 0, 0], [0.25, 0.5, 0], [-0.25, 0.5, 0], [-0.5, 0, 0], [-0.25, "
                   "-0.5, 0], [0.25, -0.5, 0]]}",
                   body, "1:1", "singular in every pose");
    expect_machine("{joints: [[1, 0, 0], [1, 0, 0], [-0.5, 1, 0], [-1, 0, 0], [-0.5, -1, 0], "
                   "[0.5, -1, 0]]}",
                   "{joints: [[0.5, 0.3, 0], [0.5, 0.3, 0], [-0.25, 0.5, 0], [-0.5, 0, 0], [-0.3, "
                   "-0.5, 0], [0.25, -0.6, 0]]}",
                   body, "1:1", "share both joints");
    expect_machine("{joints: [[1, 0, 0], [2, 0, 0], [3, 0, 0], [4, 0, 0], [5, 0, 0], [6, 0, 0]]}",
                   small_ring, body, "2:3", "on one line");
    expect_machine(ring,
                   "{joints: [[1, 1, 0], [2, 2, 0], [3, 3, 0], [4, 4, 0], [5, 5, 0], [6, 6, 0]]}",
                   body, "3:3", "on one line");
}
END_TEST

START_TEST(machines_with_shared_joints_are_fine) {
    /* 3-3: half angles of 0 in base and top */
    static const char text[] = "platform: {base: {radius: 1, half_angle: 0}, top: {radius: 0.6, "
                               "half_angle: 0}, height: 1}\n"
                               "load: {mass: 1, inertia: [1, 1, 2]}\n";
    reading made = read_bytes(text, sizeof text - 1, NULL);
    ck_assert_msg(made.status == GOUGH_OK, "%s", made.messages ? made.messages : "");
    reading_free(&made);
}
END_TEST

START_TEST(limits_of_a_leg_are_in_order) {
    expect_one("platform:\n  base: {radius: 1, half_angle: 15}\n  top: {radius: 0.6, half_angle: "
               "15}\n  height: 1.2\n  legs:\n    length: [2, 1]\nload: {mass: 1, inertia: [1, 1, "
               "1]}\n",
               "6:13", "[least, greatest]");
    expect_one("platform:\n  base: {radius: 1, half_angle: 15}\n  top: {radius: 0.6, half_angle: "
               "15}\n  height: 1.2\n  legs:\n    length: [1, 1]\nload: {mass: 1, inertia: [1, 1, "
               "1]}\n",
               "6:13", "[least, greatest]");
}
END_TEST

START_TEST(limits_of_data_sheets_are_checked) {
    static const struct {
        const char *line, *place, *part;
    } wrong[] = {
        {"legs: {length: [[1, 2], [1, 2], [1, 2], [1, 2], [1, 2]]}", "5:18",
         "`platform.legs.length` must be a list of two numbers or a list of six such pairs, found "
         "a list of 5"},
        {"legs: {length: [[1, 2], [1, 2], [1, 2], [2, 1], [1, 2], [1, 2]]}", "5:43",
         "`platform.legs.length.4` must be [least, greatest], the first below the second"},
        {"legs: {length: [[1, 2], [1, 2], [1, 2], 1, [1, 2], [1, 2]]}", "5:43",
         "`platform.legs.length.4` must be a list of two numbers, found `1`"},
        {"legs: {length: [1, 2], stroke: [-1, 1]}", "5:26",
         "`platform.legs` has both `length` and `stroke`; give one of them"},
        {"legs: {force: [-1, 2], max_force: 3}", "5:26",
         "`platform.legs` has both `force` and `max_force`; give one of them"},
        {"legs: {stroke: [-5, 1]}", "5:10",
         "the stroke of leg 1 begins at -5, but its length at home is only 1.3"},
        {"legs: {stroke: [0, 0]}", "5:18", "`platform.legs.stroke` must be [least, greatest]"},
        {"legs: {max_speed: [1, 1, 1, 1, 1]}", "5:21",
         "must be a number or a list of six numbers, found a list of 5"},
        {"legs: {max_force: [1, 1, 0, 1, 1, 1]}", "5:28",
         "`platform.legs.max_force.3` must be greater than 0, found 0"},
        {"joints: {base_swing: 0}", "5:24", "greater than 0, and at most 180 degrees, found 0"},
        {"limits: {heave: [1]}", "5:19",
         "`platform.limits.heave` must be a number or a list of two numbers, found a list of 1"},
        {"limits: {heave: -1}", "5:19",
         "`platform.limits.heave` as one number means both signs and must be greater than 0, found "
         "`-1`; a range is [least, greatest]"},
        {"limits: {yaw: [10, -10]}", "5:17",
         "`platform.limits.yaw` must be [least, greatest], the first below the second"},
        {"limits: {speed: {yaw: [1, 1]}}", "5:25", "`platform.limits.speed.yaw` must be [least"},
        {"limits: {heav: 1}", "5:12", "unknown key `heav`; did you mean `heave`?"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        char text[1000];
        snprintf(text, sizeof text,
                 "platform:\n  base: %s\n  top: %s\n  height: 1.2\n  %s\nload: %s\n", ring,
                 small_ring, wrong[i].line, body);
        expect_one(text, wrong[i].place, wrong[i].part);
    }
}
END_TEST

START_TEST(motion_is_given_in_one_way) {
    expect_one_more("motion: {heave: t, moves: [{start: 1, duration: 1, heave: 1}]}\n", "8:20",
                    "`motion` has both `moves` and `heave`");
    expect_one_more("motion: {samples: a.csv, heave: t}\n", "8:26",
                    "`motion` has both `heave` and `samples`");
    expect_one_more("motion: {moves: [{start: 1, duration: 1, heave: 1}], samples: a.csv}\n",
                    "8:54", "`motion` has both `samples` and `moves`");
}
END_TEST

START_TEST(smoothing_is_for_records_by_one_rule) {
    expect_one_more("motion: {heave: t, smooth: rounding}\n", "8:20",
                    "`motion.smooth` smooths recorded motion, but there is no `motion.samples`");
    expect_one_more("motion: {cutoff: 5}\n", "8:10",
                    "`motion.cutoff` smooths recorded motion, but there is no `motion.samples`");
    expect_said("motion: {samples: a.csv, smooth: rounding, cutoff: 5}\n",
                "1:44: error: `motion` has both `cutoff` and `smooth`");
    expect_said("motion: {samples: a.csv, smooth: {}}\n",
                "1:34: error: `motion.smooth` must be rounding, none or a mapping");
}
END_TEST

START_TEST(moves_follow_one_another) {
    expect_one_more("motion:\n  moves:\n  - {start: 1, duration: 1, heave: 1}\n  - {start: 1.5, "
                    "duration: 1, heave: 1}\n",
                    "11:13", "`motion.moves.2.start` is before the end of the previous move");
    expect_one_more("motion:\n  moves:\n  - {start: 1, duration: 1}\n", "10:5",
                    "`motion.moves.1` has no target");
    expect_one_more("motion:\n  moves:\n  - {heave: 1}\n", "10:5",
                    "`motion.moves.1.duration` is missing");
    expect_one_more("motion:\n  moves:\n  - {heave: 1, duration: fast}\n", "10:26",
                    "`motion.moves.1.duration` must be a number such as 1.5, found `fast`");
    expect_one_more("motion:\n  moves:\n  - {heave: 1, duration: 1, speed: 1}\n", "10:26",
                    "`motion.moves.1.duration` is too short for `motion.moves.1.speed`");
    expect_one_more("motion:\n  moves:\n  - {heave: 0.1, duration: least}\n", "10:5",
                    "`motion.moves.1.duration` cannot be found: no limit bounds this move");
    expect_one_more("motion:\n  moves:\n  - {yaw: 1, speed: 1}\n", "10:5",
                    "`motion.moves.1.duration` cannot be found: no limit bounds this move");
}
END_TEST

START_TEST(steps_and_methods_fit_each_other) {
    expect_one_more("simulation: {method: rattle4}\n", "8:22", "`rattle4` needs a fixed step");
    expect_one_more("simulation: {step: 0.03}\n", "8:14", "divide");
    expect_one_more("simulation: {duration: 1e9, output_step: 0.1}\n", "8:29", "rows");
    expect_one_more("simulation: {method: rattle2, step: 0.01, constraints: {baumgarte: [1, 1]}}\n",
                    "8:43", "Baumgarte");
    expect_one_more("simulation: {constraints: {}}\n", "8:27", "must be projection, none or");
}
END_TEST

/* so that one --set tries another stepper on a study that has a tolerance */
START_TEST(a_tolerance_beside_a_step_is_unused) {
    static const char *const method[] = {"dop853", "rk4", "rattle2", "rattle4"};
    for (size_t i = 0; i < sizeof method / sizeof method[0]; i++) {
        char more[100];
        snprintf(more, sizeof more, "simulation: {method: %s, step: 0.01, tolerance: 1e-9}\n",
                 method[i]);
        reading made = expect_good(more, NULL);
        ck_assert_str_eq(gough_method_name((int)made.study->simulation.method), method[i]);
        ck_assert(fabs(made.study->simulation.step - 0.01) <= 0);
        reading_free(&made);
    }
    expect_one_more("simulation: {method: rk4, step: 0.01, tolerance: 2}\n", "8:50",
                    "`simulation.tolerance` must be");
}
END_TEST

START_TEST(tolerance_of_quadruple_precision_is_accepted) {
    reading made = expect_good("simulation: {tolerance: 1e-20}\n", NULL);
    ck_assert_int_eq(made.study->simulation.precision, GOUGH_DOUBLE);
    reading_free(&made);
}
END_TEST

START_TEST(a_part_that_is_wrong_hides_no_error_of_another) {
    static const char text[] = "platform:\n"
                               "  base: {radius: 1, half_angle: 15}\n"
                               "  top: {radius: 0.6, half_angle: 15}\n"
                               "  height: 1.2\n"
                               "load: {mass: 1, inertia: [1, 1, 3]}\n"
                               "motion: {samples: none.csv}\n"
                               "control: {damping: -1}\n"
                               "simulation: {method: rk4}\n";
    reading made = read_bytes(text, sizeof text - 1, NULL);
    ck_assert_int_eq(made.status, GOUGH_ERROR_INPUT);
    ck_assert_int_eq(occurrences(made.messages, ": error: "), 4);
    ck_assert_ptr_nonnull(strstr(made.messages, ":5:17: error: no body has this inertia"));
    ck_assert_ptr_nonnull(strstr(made.messages, ":6:19: error: cannot open"));
    ck_assert_ptr_nonnull(strstr(made.messages, ":7:20: error: `control.damping` must be"));
    ck_assert_ptr_nonnull(strstr(made.messages, ":8:22: error: `rk4` needs a fixed step"));
    reading_free(&made);
}
END_TEST

int main(void) {
    return SUITE_RUN("study/combinations", 30, a_ring_is_given_in_one_way_and_whole,
                     joints_of_one_ring_may_be_listed_and_the_other_round,
                     impossible_machines_are_errors_at_their_part,
                     machines_with_shared_joints_are_fine, limits_of_a_leg_are_in_order,
                     limits_of_data_sheets_are_checked, motion_is_given_in_one_way,
                     smoothing_is_for_records_by_one_rule, moves_follow_one_another,
                     steps_and_methods_fit_each_other, a_tolerance_beside_a_step_is_unused,
                     tolerance_of_quadruple_precision_is_accepted,
                     a_part_that_is_wrong_hides_no_error_of_another);
}
