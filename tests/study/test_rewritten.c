/* A study's text with other numbers is given away only where it reads back as the tree with these numbers. Here the tree is that
 * of another file, which differs in one way. */
#include <math.h>
#include <string.h>

#include "study/arena.h"
#include "study/rewritten.h"
#include "support/suite.h"

#define HEAD                                                                                       \
    "units: si\nplatform: {height: 1, base: {radius: 1, half_angle: 10}, "                         \
    "top: {radius: 0.5, half_angle: 45}}\nload: {inertia: [1, 1, 1], mass: "

static const char file[] = HEAD "10}\ntitle: table\n";

/* Rewrites `file`, or `own` in its place, with settings and compares it with the tree of `other`. */
static void rewrite(const char *own, const char *other, const gough_setting *settings, size_t count,
                    const char *expected, const char *sentence) {
    study_arena arena = {NULL, false};
    study_axis axis = {.key = {.path = "load.mass"}};
    const double mass = 12.5;
    const gough_study *study = NULL;
    gough_error error = {.message = ""};
    const study_source mine = {"own.yaml", own ? own : file, strlen(own ? own : file), 0, false, 0,
                               0};
    const study_source its = {"other.yaml", other, strlen(other), 0, false, 0, 0};
    study_varied *varied = study_varied_new(&its, NULL, 0, &axis, 1);
    ck_assert_msg(varied != NULL, "%s", other);
    (void)study_varied_make(varied, &mass, &study, NULL);
    const char *text = study_rewritten(&arena, &mine, settings, count, varied, &error);
    if (expected) {
        ck_assert_msg(text != NULL, "%s", error.message);
        ck_assert_str_eq(text, expected);
    } else {
        ck_assert_ptr_null(text);
        ck_assert_msg(strstr(error.message, sentence) != NULL, "%s", error.message);
    }
    study_varied_free(varied);
    study_arena_free(&arena);
}

static const char elsewise[] = "its text would mean something else";

START_TEST(a_text_that_reads_back_is_given) {
    rewrite(NULL, file, NULL, 0, HEAD "12.5}\ntitle: table\n", NULL);
}
END_TEST

START_TEST(a_text_that_reads_as_another_tree_is_not_given) {
    static const char *const other[] = {
        HEAD "10}\n",                /* a key less */
        HEAD "10}\ntitle: tables\n", /* another length */
        HEAD "10}\ntitle: cable\n",  /* another letter */
        HEAD "10, center_of_mass: [0, 0, 0]}\ntitle: table\n",
    };
    for (size_t i = 0; i < sizeof other / sizeof other[0]; i++)
        rewrite(NULL, other[i], NULL, 0, NULL, elsewise);
    rewrite(HEAD "10}\ngravity: 9\n", HEAD "10}\ngravity: [0, 0, 9]\n", NULL, 0, NULL, elsewise);
    rewrite(HEAD "10}\ntitle: 3\n", HEAD "10}\ngravity: 3\n", NULL, 0, NULL, elsewise);
}
END_TEST

START_TEST(settings_take_the_place_of_plain_single_values) {
    static const gough_setting twice[] = {{"title", "chair"}, {"units", "si"}, {"title", "table"}};
    static const gough_setting title = {"title", "a\x01"};
    static const gough_setting empty = {"title", ""}, list = {"load.inertia", "[2, 2, 2]"};
    static const char cannot[] = "cannot be written with --set";
    rewrite(NULL, file, twice, 3, HEAD "12.5}\ntitle: table\n", NULL);
    rewrite(NULL, file, &title, 1, NULL, elsewise);
    rewrite(NULL, file, &empty, 1, NULL, cannot);
    rewrite(NULL, file, &list, 1, NULL, cannot);
    rewrite(HEAD "10}\ntitle: 'table'\n", file, &twice[2], 1, NULL, cannot);
    rewrite(HEAD "10}\ntitle:\n", file, &twice[2], 1, NULL, cannot);
    rewrite("a", HEAD "10}\n", NULL, 0, NULL, elsewise);
}
END_TEST

/* A value that the library refuses only when it runs, with nobody to tell. */
START_TEST(a_study_that_cannot_run_is_refused_without_a_place_for_the_reason) {
    static const char text[] = HEAD "10}\nsimulation: {tolerance: 1e-9}\n";
    study_axis axis = {.key = {.path = "simulation.tolerance"}, .touches = GOUGH_PART_SIMULATION};
    const double tolerance = 1e-20;
    const gough_study *study = NULL;
    const study_source source = {"its.yaml", text, sizeof text - 1, 0, false, 0, 0};
    static const gough_bound any = {"", -INFINITY, INFINITY, false};
    axis.bound = &any;
    study_varied *varied = study_varied_new(&source, NULL, 0, &axis, 1);
    ck_assert_ptr_nonnull(varied);
    ck_assert_int_eq(study_varied_make(varied, &tolerance, &study, NULL), GOUGH_ERROR_INPUT);
    gough_error error = {.message = ""};
    ck_assert_int_eq(study_varied_make(varied, &tolerance, &study, &error), GOUGH_ERROR_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "tolerance"));
    study_varied_free(varied);
}
END_TEST

int main(void) {
    return SUITE_RUN("study/rewritten", 60, a_text_that_reads_back_is_given,
                     a_text_that_reads_as_another_tree_is_not_given,
                     settings_take_the_place_of_plain_single_values,
                     a_study_that_cannot_run_is_refused_without_a_place_for_the_reason);
}
