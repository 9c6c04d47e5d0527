/* Messages of wrong studies, whole: place, sentence, line and caret. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "study/helpers.h"
#include "support/suite.h"

/* The good study has seven lines; `more` begins in line 8. */
static void expect_more(const char *more, const char *messages) {
    char text[4096];
    snprintf(text, sizeof text, "%s%s", good_study, more);
    expect_messages(text, NULL, messages);
}

START_TEST(points_at_unknown_key) {
    expect_more("control: {stifness: 50}\n",
                "study.yaml:8:11: error: unknown key `stifness`; did you mean `stiffness`?\n"
                "control: {stifness: 50}\n"
                "          ^\n");
    expect_more(
        "mass: 50\n",
        "study.yaml:8:1: error: unknown key `mass`; known here: title, units, platform, "
        "actuators, pose, load, gravity, external, motion, disturbance, control, initial, "
        "workspace, design, simulation, "
        "sweep; keys of that "
        "name "
        "elsewhere: `units.mass`, `platform.legs.cylinder.mass`, `platform.legs.piston.mass`, "
        "`load.mass`\n"
        "mass: 50\n"
        "^\n");
    expect_more("control: {zzz: 50}\n",
                "study.yaml:8:11: error: unknown key `zzz`; known here: feedforward, law, "
                "stiffness, damping, integral, tracking_time, model, sampling\n"
                "control: {zzz: 50}\n"
                "          ^\n");
}
END_TEST

START_TEST(points_at_duplicate_key) {
    expect_more("gravity: 1\ncontrol:\n  damping: 1\n  stiffness: 2\n  damping: 3\n",
                "study.yaml:12:3: error: duplicate key `damping`: it is already set in line 10\n"
                "  damping: 3\n"
                "  ^\n");
}
END_TEST

START_TEST(points_at_text_after_a_number) {
    expect_more("gravity: 9.81 m/s2\n",
                "study.yaml:8:14: error: `gravity` has text after the number: ` m/s2`; remove it\n"
                "gravity: 9.81 m/s2\n"
                "             ^\n");
    expect_more("gravity: 2*pi\n",
                "study.yaml:8:11: error: `gravity` must be a number, found `2*pi`; only motion and "
                "disturbance take formulas\n"
                "gravity: 2*pi\n"
                "          ^\n");
    expect_more("simulation: {duration: 20 s}\n",
                "study.yaml:8:26: error: `simulation.duration` has text after the number: ` s`; "
                "remove it\n"
                "simulation: {duration: 20 s}\n"
                "                         ^\n");
    expect_more("gravity: 0x10\n",
                "study.yaml:8:11: error: `gravity` must be a decimal number such as 1000 or 1e3, "
                "found `0x10`\n"
                "gravity: 0x10\n"
                "          ^\n");
    expect_more("gravity: 1_000\n",
                "study.yaml:8:11: error: `gravity` must be a decimal number such as 1000 or 1e3, "
                "found `1_000`\n"
                "gravity: 1_000\n"
                "          ^\n");
    expect_more("gravity: 9,81\n",
                "study.yaml:8:11: error: `gravity` must be a number with a decimal point, found a "
                "comma in `9,81`\n"
                "gravity: 9,81\n"
                "          ^\n");
}
END_TEST

/* Expects an error in a formula with the caret under that column of that line. */
static void expect_caret(const char *more, int line, int column) {
    char place[80];
    reading made = read_more(more, NULL);
    ck_assert_int_eq(made.status, GOUGH_ERROR_INPUT);
    snprintf(place, sizeof place, "study.yaml:%d:%d: error: `motion.heave`: ", line, column);
    ck_assert_msg(strncmp(made.messages, place, strlen(place)) == 0, "expected %s\nfound %s", place,
                  made.messages);
    /* the last line is blanks as wide as the columns before, then the caret */
    const char *end = made.messages + strlen(made.messages);
    ck_assert_str_eq(end - 2, "^\n");
    const char *begin = end - 2;
    while (begin[-1] == ' ' || begin[-1] == '\t') begin--;
    ck_assert_int_eq((int)(end - 2 - begin), column - 1);
    ck_assert_int_eq(begin[-1], '\n');
    reading_free(&made);
}

START_TEST(points_into_a_formula) {
    /* the character x in each, wherever YAML puts it */
    expect_caret("motion: {heave: sin(x)}\n", 8, 21);
    expect_caret("motion:\n  heave:   t + x*t # comment\n", 9, 16);
    expect_caret("motion:\n  heave: \"sin(x)\"\n", 9, 15);
    expect_caret("motion:\n  heave: 'sin(x)'\n", 9, 15);
    expect_caret("motion: {heave: \"\\u0073in(x)\"}\n", 8, 27);
    expect_caret("motion: {heave: \"t\\x2Bx\"}\n", 8, 23);
    expect_caret("motion: {heave: \"t +\\tx\"}\n", 8, 23);
    expect_caret("motion:\n  heave: sin(t)\n    + cos(x)\n", 10, 11);
    expect_caret("motion:\n  heave: \"sin(t)\n\n     + x\"\n", 11, 8);
    expect_caret("motion:\n  heave: \"sin(t)\\\n     + x\"\n", 10, 8);
    expect_caret("motion:\n  heave: |\n    sin(t)\n    + cos(x)\n", 11, 11);
    expect_caret("motion:\n  heave: >-\n    sin(t)\n    + cos(x)\n", 11, 11);
    expect_caret("motion:\n\n\n  # über\n  heave: 2*x\n", 12, 12);
    expect_caret("motion:\r\n  heave: 2*x\r\n", 9, 12);
}
END_TEST

START_TEST(points_at_the_end_of_an_open_formula) {
    expect_caret("motion: {heave: (t + 1}\n", 8, 17); /* the parenthesis that is not closed */
    expect_caret("motion: {heave: t +}\n", 8, 20);
}
END_TEST

START_TEST(counts_characters_not_bytes) {
    expect_more("control: {übermaß: 1}\n",
                "study.yaml:8:11: error: unknown key `übermaß`; known here: feedforward, "
                "law, stiffness, damping, integral, tracking_time, model, sampling\n"
                "control: {übermaß: 1}\n"
                "          ^\n");
    expect_messages("title: äöü\nunits: {ß: 1, \"ä\": [ö\n", NULL,
                    "study.yaml:2:20: error: this bracket is not closed\n"
                    "units: {ß: 1, \"ä\": [ö\n"
                    "                   ^\n");
}
END_TEST

START_TEST(keeps_tabs_before_the_caret) {
    expect_more("control:\t{damping:\t-1}\n",
                "study.yaml:8:20: error: `control.damping` must be 0 or greater, found -1\n"
                "control:\t{damping:\t-1}\n"
                "        \t         \t^\n");
}
END_TEST

/* Whether a formula in braces and the same in quotes are one model. */
static void reads_as(const char *cut, const char *quoted) {
    reading a = expect_good(cut, NULL), b = expect_good(quoted, NULL);
    const gough_model *m = a.study->model, *n = b.study->model;
    for (double t = 0; t < 9; t += 0.7) {
        double p[GOUGH_COMPONENTS][3], q[GOUGH_COMPONENTS][3];
        gough_motion_evaluate(&m->motion, t, p);
        gough_motion_evaluate(&n->motion, t, q);
        ck_assert_int_eq(memcmp(p, q, sizeof p), 0);
        for (int c = 0; c < 3; c++) {
            double f[3], g[3];
            gough_formula_evaluate(&m->disturbance.force[c], t, f);
            gough_formula_evaluate(&n->disturbance.force[c], t, g);
            ck_assert_int_eq(memcmp(f, g, sizeof f), 0);
        }
    }
    reading_free(&a);
    reading_free(&b);
}

START_TEST(reads_formulas_with_commas_inside_braces_and_brackets) {
    reads_as("motion: {yaw: 1*ramp(t,8)}\n", "motion: {yaw: \"1*ramp(t,8)\"}\n");
    reads_as("motion: {heave: 0.1*atan2(t, 1), yaw: 3}\n",
             "motion: {heave: \"0.1*atan2(t, 1)\", yaw: 3}\n");
    reads_as("motion: {heave: 0.1*atan2(ramp(t, 2) ,\n    1 + ramp( t,3 )), yaw: 3}\n",
             "motion: {heave: \"0.1*atan2(ramp(t, 2), 1 + ramp(t, 3))\", yaw: 3}\n");
    reads_as("disturbance: {force: [0, ramp(t, 1), atan2(t,ramp(t,2))]}\n",
             "disturbance: {force: [0, \"ramp(t, 1)\", \"atan2(t,ramp(t,2))\"]}\n");
    reading made = read_more("", SETTINGS("motion={yaw: 1*ramp(t,8), heave: 0.1*ramp(t,2)}",
                                          "disturbance.force=[ramp(t, 1), 0, 0]"));
    ck_assert_int_eq(made.status, GOUGH_OK);
    reading_free(&made);
    expect_more("motion: {heave: 0.1*sin(ramp(t, 1) + u), yaw: 3}\n",
                "study.yaml:8:38: error: `motion.heave`: unknown name 'u'\n"
                "motion: {heave: 0.1*sin(ramp(t, 1) + u), yaw: 3}\n"
                "                                     ^\n");
}
END_TEST

START_TEST(says_quote_it_where_a_comma_cuts_a_formula_in_doubt) {
    reading doubt = read_more("motion: {heave: atan2(t, 1: 2, yaw: 3}\n", NULL);
    ck_assert_ptr_nonnull(strstr(doubt.messages,
                                 "study.yaml:8:24: error: YAML splits the formula "
                                 "`motion.heave` at this comma: inside braces or "
                                 "brackets, put it in quotes, as in \"atan2(t, 1)\"\n"));
    ck_assert_ptr_nonnull(strstr(doubt.messages, "study.yaml:8:26: error: unknown key `1`;"));
    reading_free(&doubt);
    expect_more("disturbance: {force: [0, ramp(t, '1)', 0]}\n",
                "study.yaml:8:32: error: YAML splits the formula `disturbance.force.2` at this "
                "comma: inside braces or brackets, put it in quotes, as in \"atan2(t, 1)\"\n"
                "disturbance: {force: [0, ramp(t, '1)', 0]}\n"
                "                               ^\n");
    reading made = expect_good("motion: {heave: \"atan2(t, 1)\", yaw: 'ramp(t, 2)'}\n", NULL);
    reading_free(&made);
}
END_TEST

START_TEST(shows_a_window_of_a_long_line) {
    char text[3000] = "";
    strcat(text, "title: ");
    for (int i = 0; i < 200; i++) strcat(text, "long line ");
    strcat(text, ": wrong\nunits: si\n");
    reading made = read_bytes(text, strlen(text), NULL);
    ck_assert_int_eq(made.status, GOUGH_ERROR_INPUT);
    ck_assert_uint_lt(strlen(made.messages), 500);
    ck_assert_ptr_nonnull(strstr(made.messages, "study.yaml:1:2"));
    ck_assert_ptr_nonnull(strstr(made.messages, "…"));
    reading_free(&made);
}
END_TEST

START_TEST(points_at_what_the_parser_dislikes) {
    expect_messages("platform:\n  base: {radius: 1\n", NULL,
                    "study.yaml:2:9: error: this brace is not closed\n"
                    "  base: {radius: 1\n"
                    "        ^\n");
    expect_messages("title: 'x\nunits: si\n", NULL,
                    "study.yaml:1:8: error: these quotes are not closed, or lines between them are "
                    "not indented\n"
                    "title: 'x\n"
                    "       ^\n");
    expect_messages("load:\n\tmass: 1\n", NULL,
                    "study.yaml:2:1: error: indent with spaces: YAML does not allow tabs here\n"
                    "\tmass: 1\n"
                    "^\n");
    expect_messages("title: a: b\n", NULL,
                    "study.yaml:1:9: error: two keys on one line: put quotes around text that "
                    "contains a colon\n"
                    "title: a: b\n"
                    "        ^\n");
    expect_messages("load: {\n  mass: 1\n}\n", NULL,
                    "study.yaml:3:1: error: the lines inside braces or brackets, including the "
                    "closing one, must be indented further than their key\n"
                    "}\n"
                    "^\n");
    expect_messages("load:\n  mass: 1\n inertia: [1, 1, 1]\n", NULL,
                    "study.yaml:3:2: error: the indentation of this line matches neither the keys "
                    "above it nor their contents\n"
                    " inertia: [1, 1, 1]\n"
                    " ^\n");
    expect_messages("title: x\nload\nunits: si\n", NULL,
                    "study.yaml:2:1: error: a colon and a space are missing after this key\n"
                    "load\n"
                    "^\n");
    expect_messages("title: x\nload: {mass: @1}\n", NULL,
                    "study.yaml:2:14: error: this is not YAML: plain scalar cannot start with "
                    "'@'\n"
                    "load: {mass: @1}\n"
                    "             ^\n");
}
END_TEST

START_TEST(says_all_errors_in_the_order_of_the_file) {
    expect_messages(
        "titel: Test\n"
        "units: imperial\n"
        "platform:\n"
        "  base: {radius: -1, half_angle: 15}\n"
        "  top: {radius: 0.6, half_angle: 15}\n"
        "  height: high\n"
        "  legs: {length: [2, 1]}\n"
        "load: {mass: 1}\n"
        "motion: {heave: sin(, yaw: 3}\n"
        "simulation: {method: rk4}\n",
        NULL,
        "study.yaml:1:1: error: unknown key `titel`; did you mean `title`?\n"
        "titel: Test\n"
        "^\n"
        "study.yaml:2:8: error: `units` must be one of si, dimensionless, found `imperial`\n"
        "units: imperial\n"
        "       ^\n"
        "study.yaml:4:18: error: `platform.base.radius` must be greater than 0, found -1\n"
        "  base: {radius: -1, half_angle: 15}\n"
        "                 ^\n"
        "study.yaml:6:11: error: `platform.height` must be a number such as 1.5, found `high`\n"
        "  height: high\n"
        "          ^\n"
        "study.yaml:7:18: error: `platform.legs.length` must be [least, greatest], the first below "
        "the second\n"
        "  legs: {length: [2, 1]}\n"
        "                 ^\n"
        "study.yaml:8:1: error: `load.inertia` is missing: inertia about the centre "
        "of mass, in the axes of the top frame: moments Jx, Jy, Jz, or the symmetric matrix\n"
        "load: {mass: 1}\n"
        "^\n"
        "study.yaml:9:21: error: YAML splits the formula `motion.heave` at this comma: inside "
        "braces or brackets, put it in quotes, as in \"atan2(t, 1)\"\n"
        "motion: {heave: sin(, yaw: 3}\n"
        "                    ^\n"
        "study.yaml:10:22: error: `rk4` needs a fixed step: set `simulation.step` to a divisor of "
        "output_step\n"
        "simulation: {method: rk4}\n"
        "                     ^\n");
}
END_TEST

START_TEST(keeps_a_hundred_errors_and_counts_the_rest) {
    char text[8000] = "";
    for (int i = 0; i < 250; i++) sprintf(text + strlen(text), "unknown_%d: 1\n", i);
    reading made = read_bytes(text, strlen(text), NULL);
    ck_assert_int_eq(occurrences(made.messages, ": error: "), 100);
    /* platform and load are missing besides */
    ck_assert_ptr_nonnull(strstr(made.messages, "… and 152 more errors, not shown here\n"));
    reading_free(&made);
}
END_TEST

static void place_is(const gough_study *study, const char *sentence, const char *place) {
    char found[100] = "x";
    const size_t length = gough_study_place(study, sentence, found, sizeof found);
    ck_assert_str_eq(found, place);
    ck_assert_uint_eq(length, strlen(place));
    ck_assert_uint_eq(gough_study_place(study, sentence, NULL, 0), length);
}

START_TEST(a_sentence_of_a_run_finds_its_key) {
    reading made = expect_good("motion:\n  yaw: t\n  heave: \"0.1*log(1 - t)\"\n"
                               "disturbance: {force: [0, log(3 - t), 0], leg_force: t}\n",
                               SETTINGS("motion.sway=sqrt(t)", "simulation.duration=3"));
    place_is(made.study, "motion.heave (value or derivatives) is not finite", "study.yaml:10:10");
    place_is(made.study, "motion.yaw", "study.yaml:9:8");
    place_is(made.study, "motion.roll is not finite", "study.yaml:9:3");
    place_is(made.study, "motion.sway is not finite", "--set motion.sway");
    place_is(made.study, "simulation.duration: the run", "--set simulation.duration");
    place_is(made.study, "disturbance.force.2 is not finite", "study.yaml:11:26");
    place_is(made.study, "disturbance.leg_force.4 is not finite", "study.yaml:11:53");
    place_is(made.study, "the machine is singular", "");
    place_is(made.study, "", "");
    place_is(made.study, "...", "");
    reading_free(&made);
}
END_TEST

START_TEST(control_characters_never_reach_the_terminal) {
    expect_more("control: {\"stiff\\e[31mness\": 1}\n",
                "study.yaml:8:11: error: unknown key `stiff\\x1b[31mness`; did you mean "
                "`stiffness`?\n"
                "control: {\"stiff\\e[31mness\": 1}\n"
                "          ^\n");
    reading made = read_bytes("title: \x1b[31m\n", 13, NULL);
    ck_assert_ptr_null(strchr(made.messages, '\x1b'));
    reading_free(&made);
}
END_TEST

int main(void) {
    return SUITE_RUN(
        "study/places", 30, points_at_unknown_key, points_at_duplicate_key,
        points_at_text_after_a_number, points_into_a_formula, points_at_the_end_of_an_open_formula,
        counts_characters_not_bytes, keeps_tabs_before_the_caret,
        reads_formulas_with_commas_inside_braces_and_brackets,
        says_quote_it_where_a_comma_cuts_a_formula_in_doubt, a_sentence_of_a_run_finds_its_key,
        shows_a_window_of_a_long_line, points_at_what_the_parser_dislikes,
        says_all_errors_in_the_order_of_the_file, keeps_a_hundred_errors_and_counts_the_rest,
        control_characters_never_reach_the_terminal);
}
