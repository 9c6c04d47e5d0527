/* Studies that are almost right, and what is said about each: shapes, formulas that YAML cuts, keys that vary, bytes. */
#define _GNU_SOURCE
#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "gough/sweep.h"

#include "study/arena.h"
#include "study/helpers.h"
#include "support/suite.h"

typedef struct pair {
    const char *more, *said;
} pair;

/* The good study and more lines: an error with this in its text, or none where it is NULL. */
static void expect_each(const pair *each, size_t count) {
    for (size_t i = 0; i < count; i++) {
        reading made = read_more(each[i].more, NULL);
        ck_assert_msg((made.status == GOUGH_OK) == !each[i].said, "%s: %s", each[i].more,
                      made.messages ? made.messages : "accepted");
        ck_assert_msg(!each[i].said || strstr(made.messages, each[i].said),
                      "%s: expected %s, found %s", each[i].more, each[i].said, made.messages);
        reading_free(&made);
    }
}

#define EXPECT_EACH(...)                                                                           \
    expect_each((const pair[]){__VA_ARGS__}, sizeof((const pair[]){__VA_ARGS__}) / sizeof(pair))

START_TEST(numbers_that_are_none_are_told_apart) {
    EXPECT_EACH({"control:\n  stiffness: 1,5\n", "with a decimal point, found a comma in `1,5`"},
                {"control:\n  stiffness: 1,x\n", "has text after the number: `,x`; remove it"},
                {"control:\n  stiffness: 1, 5\n", "has text after the number: `, 5`; remove it"},
                {"control: {stiffness: 0x10}\n",
                 "must be a decimal number such as 1000 or 1e3, found `0x10`"},
                {"control: {stiffness: 0X10}\n",
                 "must be a decimal number such as 1000 or 1e3, found `0X10`"},
                {"control: {stiffness: 0o17}\n",
                 "must be a decimal number such as 1000 or 1e3, found `0o17`"},
                {"control: {stiffness: 1_000}\n",
                 "must be a decimal number such as 1000 or 1e3, found `1_000`"},
                {"control: {stiffness: \"1 \"}\n", "has text after the number: ` `; remove it"},
                {"control: {stiffness: +inf}\n", "must be a finite number, found `+inf`"},
                {"gravity: x\n", "`gravity` must be a number such as 1.5"},
                {"control: {stiffness: 2 * 3}\n", "only motion and disturbance take formulas"},
                {"simulation: {method: zzzzzzzz}\n", "found `zzzzzzzz`\n"},
                {"simulation: {method: rk5}\n", "did you mean `rk4`?"});
    expect_said("title: \"a\\nb\\x07\"\n", "study.yaml:1:13: error: control character U+0007");
    expect_said("title: \"a\tb\\x07\"\n", "study.yaml:1:12: error: control character U+0007");
}
END_TEST

START_TEST(parts_of_cut_formulas_are_not_called_unknown_keys) {
    reading made = read_more("motion: {heave: atan2((t, 1), yaw: 1}\n", NULL);
    ck_assert_int_eq(made.status, GOUGH_ERROR_INPUT);
    ck_assert_ptr_nonnull(strstr(made.messages, "YAML splits the formula `motion.heave` at this"));
    ck_assert_int_eq(occurrences(made.messages, ": error: "), 1);
    reading_free(&made);
    EXPECT_EACH({"motion: {heave: [1], q)}\n", "unknown key `q)`"},
                {"motion: {heave: atan2((t, 1, yaw: 2}\n", "unknown key `1`"},
                {"motion: {heave: 1 +, q): 2}\n", "unknown key `q)`"},
                {"motion: {heave: 1 +, q)}\n", "unknown key `q)`"},
                {"motion: {heave: atan2((t, q): 2}\n", "unknown key `q)`"},
                {"motion: {heave: ramp(t , yaw: 2}\n", "YAML splits the formula"},
                {"motion: {heave: ramp(t\t, yaw: 2}\n", "YAML splits the formula"},
                {"disturbance: {force: [[1], 2]}\n", "must be a list of three formulas"},
                {"disturbance:\n  force:\n    - ramp(t\n    - 0\n", "found a list of 2"});
}
END_TEST

START_TEST(shapes_of_motion_are_checked) {
    EXPECT_EACH({"motion: {moves: []}\n", "`motion.moves` must be a list of moves such as"},
                {"motion: {moves: [1]}\n", "must be a mapping such as {start: 1"},
                {"motion: {smooth: rounding, sampels: a.csv}\n", "did you mean `samples`?"},
                {"motion: {smooth: rounding}\n", "but there is no `motion.samples`"},
                {"motion: {moves: [{start: 0, duration: 1, heave: 0.1}, {start: 1, duration: 1, "
                 "heave: 0}, {start: 2, duration: 1, heave: 0.1}, {start: 3, duration: 1, heave: "
                 "0}, {start: 4, duration: 1, heave: 0.1}, {start: 5, duration: 1, heave: 0}, "
                 "{start: 6, duration: 1, heave: 0.1}]}\n",
                 NULL});
    reading made = read_more("motion: {smooth: rounding, sampels: a.csv}\n", NULL);
    ck_assert_int_eq(occurrences(made.messages, ": error: "), 1);
    reading_free(&made);
}
END_TEST

START_TEST(a_record_shorter_than_the_default_run_is_refused_at_the_motion) {
    char text[1000], *path = write_file("motion.csv", "t,heave\n0,1\n1,2\n", 16);
    snprintf(text, sizeof text, "%smotion: {samples: '%s'}\n", good_study, path);
    expect_said(text, "study.yaml:8:1: error: ");
    forget_file(path);
}
END_TEST

START_TEST(what_varies_is_checked_against_the_study) {
#define KEYS(text) "sweep: {keys: {" text "}}\n"
    EXPECT_EACH(
        {KEYS("load.inertia.0: [1]"), "is not a key of a study"},
        {KEYS("load.inertia.1234567: [1]"), "is not a key of a study"},
        {KEYS("load.inertia.x: [1]"), "is not a key of a study"},
        {KEYS("load.inertia.: [1]"), "is not a key of a study"},
        {KEYS("load.inertia.4: [1]"), "is not a key of a study"},
        {KEYS("load.inertia.1.1.1: [1]"), "is not a key of a study"},
        {KEYS("load.inertia: [1]"), "vary its elements, numbered from 1, as in `load.inertia.1`"},
        {KEYS("load.center_of_mass: [1]"), "as in `load.center_of_mass.1`"},
        {KEYS("motion.moves.x.heave: [1]"), "is not a key of a study"},
        {KEYS("motion.moves.1: [1]"), "is not a key of a study"},
        {KEYS("motion.moves.1.heave: [1]"), "has no list `motion.moves` with such an element"},
        {KEYS("motion.moves.1.heave: [1]") "motion: {heave: 1}\n",
         "has no list `motion.moves` with such an element"},
        {KEYS("motion.moves.1.heave: [1]") "motion: {moves: [1]}\n",
         "has no list `motion.moves` with such an element"},
        {KEYS("control.stiffness.1: [1]"), "has no list `control.stiffness` with such an element"},
        {KEYS("motion.smooth.heave: [1]") "motion: {heave: 1}\n", NULL},
        {KEYS("gravity.3: [1, 2]"), "has no list `gravity` with such an element"},
        {KEYS("gravity.3: [-1, -2]") "gravity: [0, 0, -1]\n", NULL},
        {KEYS("simulation.constraints.baumgarte.1: [1, 2]") "simulation: {constraints: {baumgarte: "
                                                            "[1, 2]}}\n",
         NULL},
        {KEYS("load.mass: {uniform: [1, 2], from: 1}"), "has both `from` and `uniform`"},
        {KEYS("load.mass: {normal: [1, 2], to: 1}"), "has both `to` and `normal`"},
        {KEYS("load.mass: {from: 1, uniform: [1, 2]}"), "has both `uniform` and `from`"},
        {KEYS("load.mass: {from: 1, to: 2, steps: 3, scale: lin}"), NULL},
        {KEYS("load.mass: {from: 1, to: -1, steps: 3, scale: log}"), "its ends must be greater"},
        {KEYS("load.mass: {from: -1, to: 1, steps: 3, scale: log}"), "its ends must be greater"},
        {KEYS("control.stiffness: [1], control.stiffness.2: [2]") "control: {stiffness: [1, 2, 3, "
                                                                  "4, 5, 6]}\n",
         "set the same number"},
        {KEYS("control.stiffness.2: [1], control.stiffness: [2]") "control: {stiffness: [1, 2, 3, "
                                                                  "4, 5, 6]}\n",
         "set the same number"},
        {"sweep: {combine: zip, keys: {load.mass: [1, 2], gravity: {uniform: [1, 2]}}}\n", NULL},
        {"sweep: {combine: product, keys: {load.mass: [1, 2]}}\n", NULL},
        {"sweep: [1]\n", "`sweep` must be a mapping"});
    reading made = read_more(KEYS("load.inertia.1: [0.1]"), SETTINGS("load.inertia=[[1, 0, 0], [0, "
                                                                     "1, 0], [0, 0, 1]]"));
    ck_assert_int_eq(made.status, GOUGH_ERROR_INPUT);
    ck_assert_ptr_nonnull(strstr(made.messages, "vary an element of it, as in `load.inertia.1.1`"));
    reading_free(&made);
}
END_TEST

START_TEST(at_most_a_thousand_keys_vary) {
    char *text = malloc(40000);
    size_t length = (size_t)sprintf(text, "%ssweep: {keys: {", good_study);
    for (int i = 0; i < 1001; i++) length += (size_t)sprintf(text + length, "k%d: [1], ", i);
    sprintf(text + length, "}}\n");
    expect_said(text, "`sweep.keys` has 1001 keys; at most 1000 can vary");
    free(text);
}
END_TEST

static gough_sweep *new_sweep(const char *more) {
    char text[3000];
    gough_sweep *sweep = NULL;
    char *messages = NULL;
    snprintf(text, sizeof text, "%s%s", good_study, more);
    ck_assert_msg(gough_sweep_parse("study.yaml", text, strlen(text), NULL, 0, &sweep, &messages) ==
                      GOUGH_OK,
                  "%s", messages);
    return sweep;
}

/* 600 decades, downwards: neither their ratio nor a step's power of ten is a double */
START_TEST(a_logarithmic_grid_may_span_all_doubles) {
    static const double wanted[] = {1e300, 1e150, 1, 1e-150, 1e-300};
    gough_sweep *sweep = new_sweep(
        "sweep: {keys: {control.stiffness: {from: 1e300, to: 1e-300, steps: 5, scale: log}}}\n");
    for (size_t run = 1; run <= 5; run++) {
        double value;
        gough_sweep_values(sweep, run, &value);
        ck_assert(value / wanted[run - 1] > 1 - 1e-12 && value / wanted[run - 1] < 1 + 1e-12);
    }
    gough_sweep_free(sweep);
}
END_TEST

START_TEST(a_study_without_a_sweep_is_none) {
    gough_sweep *sweep = NULL;
    char text[3000], *messages = NULL;
    const size_t length = strlen(good_study);
    ck_assert_int_eq(gough_sweep_parse("a.yaml", good_study, length, NULL, 0, &sweep, NULL),
                     GOUGH_ERROR_INPUT);
    ck_assert_int_eq(gough_sweep_parse("a.yaml", good_study, length, NULL, 0, &sweep, &messages),
                     GOUGH_ERROR_INPUT);
    ck_assert_ptr_nonnull(strstr(messages, "the study has no section `sweep`"));
    gough_study_free_messages(messages);
    snprintf(text, sizeof text, "%sswep: {keys: {load.mass: [1, 2]}}\n", good_study);
    ck_assert_int_eq(gough_sweep_parse("a.yaml", text, strlen(text), NULL, 0, &sweep, &messages),
                     GOUGH_ERROR_INPUT);
    ck_assert_ptr_nonnull(strstr(messages, "did you mean `sweep`?"));
    ck_assert_ptr_null(strstr(messages, "has no section"));
    gough_study_free_messages(messages);
}
END_TEST

START_TEST(characters_that_are_none_are_named) {
    expect_said("title: a\xEF\xBF\xBE\n", "study.yaml:1:9: error: control character U+FFFE");
    expect_said("title: a\xEF\xBF\xBF\n", "study.yaml:1:9: error: control character U+FFFF");
    expect_said("\xFE\xFFt", "study.yaml:1:1: error: this looks like UTF-16");
    expect_said("\xC3t", "study.yaml:1:1: error: byte 0xC3 is not UTF-8 here");
}
END_TEST

START_TEST(syntax_errors_have_their_place_in_any_line_ends) {
    expect_said("a: 1\rb: 'x\r", "these quotes are not closed");
    expect_said("a: 1\r\nb: 2\r\n c: 3\r\n",
                "study.yaml:2:4: error: a colon and a space are missing");
    expect_said("'abc\n", "these quotes are not closed");
    expect_said("a: [1, 2\n", "this bracket is not closed");
    expect_said("a: {b: 2\n", "this brace is not closed");
    expect_said("a: ]\n", "error: ");
    /* a key that is a list, and one level too deep: the first is said */
    reading made = read_bytes("[[[[[[[[[[[{[a]: 1}]]]]]]]]]]]\n", 31, NULL);
    ck_assert_int_eq(occurrences(made.messages, ": error: "), 1);
    ck_assert_ptr_nonnull(strstr(made.messages, "study.yaml:1:13: error: nested too deeply"));
    reading_free(&made);
}
END_TEST

/* What the shell hands over has a name among the descriptors; a folder there is refused, a file read. */
START_TEST(descriptors_are_read_by_their_names) {
    char path[64], *file = write_file("study.yaml", good_study, strlen(good_study));
    gough_study *study = NULL;
    char *messages = NULL;
    const int given = open(file, O_RDONLY), folder = open("/", O_RDONLY);
    snprintf(path, sizeof path, "/proc/self/fd/%d", given);
    ck_assert_int_eq(gough_study_read(path, NULL, 0, &study, &messages), GOUGH_OK);
    gough_study_free(study);
    snprintf(path, sizeof path, "/dev/fd/%d", folder);
    ck_assert_int_eq(gough_study_read(path, NULL, 0, &study, &messages), GOUGH_ERROR_FILE);
    ck_assert_ptr_nonnull(strstr(messages, "is a folder; a regular file is needed"));
    gough_study_free_messages(messages);
    ck_assert_int_eq(gough_study_read("/dev/null", NULL, 0, &study, &messages), GOUGH_ERROR_FILE);
    ck_assert_ptr_nonnull(strstr(messages, "is a device; a regular file is needed"));
    gough_study_free_messages(messages);
    close(given);
    close(folder);
    forget_file(file);
}
END_TEST

START_TEST(a_study_made_by_hand_has_no_places) {
    gough_study study = {.dimensionless = true};
    char place[10] = "x";
    ck_assert_uint_eq(gough_study_place(&study, "platform.height", place, sizeof place), 0);
    ck_assert_str_eq(place, "");
}
END_TEST

START_TEST(a_size_beyond_all_memory_is_exhausted_memory) {
    study_arena arena = {NULL, false};
    ck_assert_ptr_null(study_arena_take(&arena, SIZE_MAX));
    ck_assert(arena.exhausted);
    study_arena_free(&arena);
}
END_TEST

int main(void) {
    return SUITE_RUN(
        "study/refused", 30, numbers_that_are_none_are_told_apart,
        parts_of_cut_formulas_are_not_called_unknown_keys, shapes_of_motion_are_checked,
        a_record_shorter_than_the_default_run_is_refused_at_the_motion,
        what_varies_is_checked_against_the_study, at_most_a_thousand_keys_vary,
        a_logarithmic_grid_may_span_all_doubles, a_study_without_a_sweep_is_none,
        characters_that_are_none_are_named, syntax_errors_have_their_place_in_any_line_ends,
        descriptors_are_read_by_their_names, a_study_made_by_hand_has_no_places,
        a_size_beyond_all_memory_is_exhausted_memory);
}
