/* --set key=value: applied before the checks, with its errors at its key. */
#include <math.h>
#include <string.h>

#include "study/helpers.h"
#include "support/suite.h"

#define EXACTLY(a, b) ck_assert_msg((a) <= (b) && (a) >= (b), "%s is %.17g", #a, (double)(a))

START_TEST(a_setting_replaces_a_value) {
    reading made = expect_good("control: {stiffness: 50, damping: 1}\n",
                               SETTINGS("control.stiffness=75", "platform.height=1.5"));
    EXACTLY(made.study->model->control.stiffness[3], 75);
    EXACTLY(made.study->model->control.damping[3], 1);
    EXACTLY(made.study->model->machine.platform.height, 1.5);
    ck_assert_ptr_nonnull(strstr(made.study->text, "stiffness: 50"));
    reading_free(&made);
}
END_TEST

START_TEST(a_setting_creates_what_is_not_there) {
    reading made = expect_good("", SETTINGS("control.stiffness=75", "motion.heave=0.1*sin(t)",
                                            "simulation.constraints.baumgarte=[1, 2]"));
    EXACTLY(made.study->model->control.stiffness[0], 75);
    EXACTLY(made.study->simulation.baumgarte[1], 2);
    ck_assert_int_eq(made.study->simulation.constraints, GOUGH_BAUMGARTE);
    ck_assert(!gough_formula_is_zero(&made.study->model->motion.formula[GOUGH_HEAVE]));
    reading_free(&made);
    made = expect_good("simulation: {constraints: none}\n",
                       SETTINGS("simulation.constraints.baumgarte=[1, 2]"));
    ck_assert_int_eq(made.study->simulation.constraints, GOUGH_BAUMGARTE);
    reading_free(&made);
}
END_TEST

START_TEST(a_setting_reaches_an_element_by_its_number) {
    reading made = expect_good("control: {stiffness: [1, 2, 3, 4, 5, 6]}\n"
                               "motion: {moves: [{start: 1, duration: 1, heave: 0.1}, "
                               "{start: 2, duration: 1, heave: 0}]}\n",
                               SETTINGS("control.stiffness.2=20", "load.inertia.3=0.1",
                                        "motion.moves.2.start=2.5", "control.stiffness.6=60"));
    EXACTLY(made.study->model->control.stiffness[0], 1);
    EXACTLY(made.study->model->control.stiffness[1], 20);
    EXACTLY(made.study->model->control.stiffness[5], 60);
    EXACTLY(made.study->model->machine.load.inertia[2][2], 0.1);
    EXACTLY(made.study->model->motion.move[1].start, 2.5);
    reading_free(&made);
}
END_TEST

START_TEST(the_last_setting_wins_and_an_empty_one_takes_away) {
    reading made =
        expect_good("simulation: {tolerance: 1e-6, duration: 7}\n",
                    SETTINGS("control.stiffness=1", "control.stiffness=2",
                             "simulation.tolerance=", "simulation.step=0.01", "control.damping="));
    EXACTLY(made.study->model->control.stiffness[0], 2);
    EXACTLY(made.study->simulation.step, 0.01);
    EXACTLY(made.study->simulation.duration, 7);
    reading_free(&made);
}
END_TEST

START_TEST(a_setting_mends_what_the_file_has_wrong) {
    reading made = expect_good("control: {stiffness: high}\n", SETTINGS("control.stiffness=3"));
    reading_free(&made);
    made = expect_good("titel: x\n", SETTINGS("titel=", "motion={}"));
    reading_free(&made);
}
END_TEST

static void expect(const char *more, const char *const settings[], const char *messages) {
    reading made = read_more(more, settings);
    ck_assert_int_eq(made.status, GOUGH_ERROR_INPUT);
    ck_assert_str_eq(made.messages, messages);
    reading_free(&made);
}

START_TEST(errors_stand_at_the_setting) {
    expect(
        "", SETTINGS("control.stiffness=high"),
        "--set control.stiffness: error: `control.stiffness` must be a number such as 1.5, found "
        "`high`\n"
        "control.stiffness=high\n"
        "                  ^\n");
    expect("", SETTINGS("control.stifness=5"),
           "--set control.stifness: error: unknown key `stifness`; did you mean `stiffness`?\n"
           "control.stifness=5\n"
           "        ^\n");
    expect("", SETTINGS("contrl.stiffness=5"),
           "--set contrl.stiffness: error: unknown key `contrl`; did you mean `control`?\n"
           "contrl.stiffness=5\n"
           "^\n");
    expect("", SETTINGS("control.stifness="),
           "--set control.stifness: error: unknown key `stifness`; did you mean `stiffness`?\n"
           "control.stifness=\n"
           "        ^\n");
    expect("", SETTINGS("motion.heave=2*x"),
           "--set motion.heave: error: `motion.heave`: unknown name 'x': did you mean 't'?\n"
           "motion.heave=2*x\n"
           "               ^\n");
    expect(
        "", SETTINGS("load.inertia.4=1"),
        "--set load.inertia.4: error: there is no element `4` in this list of 3, numbered from 1\n"
        "load.inertia.4=1\n"
        "             ^\n");
    expect("control: {stiffness: 5}\n", SETTINGS("control.stiffness.2=1"),
           "--set control.stiffness.2: error: `2` is the number of a list element, but there is no "
           "list here; set the whole list\n"
           "control.stiffness.2=1\n"
           "                  ^\n");
    expect("", SETTINGS("control={stiffness: *a}"),
           "--set control: error: aliases (*) are not allowed in a study; in a formula, write the "
           "factor first or use quotes\n"
           "control={stiffness: *a}\n"
           "                    ^\n");
    expect("", SETTINGS(".=5"),
           "--set .: error: a key such as control.stiffness was expected before the =\n"
           ".=5\n"
           "^\n");
    expect("", SETTINGS("load.mass="),
           "study.yaml:7:1: error: `load.mass` is missing: mass of the load, the top included\n"
           "load: {mass: 1, inertia: [0.08, 0.08, 0.15]}\n"
           "^\n");
    expect("", SETTINGS("title=a\xff"),
           "--set title: error: byte 0xFF is not UTF-8 here; save the file as UTF-8\n"
           "title=a\\xff\n"
           "       ^\n");
}
END_TEST

START_TEST(errors_of_the_file_come_first_then_those_of_settings_in_order) {
    expect("gravity: x\n", SETTINGS("units=b", "title=[c]"),
           "study.yaml:8:10: error: `gravity` must be a number such as 1.5, found `x`\n"
           "gravity: x\n"
           "         ^\n"
           "--set units: error: `units` must be one of si, dimensionless, found `b`\n"
           "units=b\n"
           "      ^\n"
           "--set title: error: `title` must be text, found a list\n"
           "title=[c]\n"
           "      ^\n");
}
END_TEST

int main(void) {
    return SUITE_RUN(
        "study/settings", 30, a_setting_replaces_a_value, a_setting_creates_what_is_not_there,
        a_setting_reaches_an_element_by_its_number,
        the_last_setting_wins_and_an_empty_one_takes_away, a_setting_mends_what_the_file_has_wrong,
        errors_stand_at_the_setting, errors_of_the_file_come_first_then_those_of_settings_in_order);
}
