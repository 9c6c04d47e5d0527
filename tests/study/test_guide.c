/* The guide to the study file says what the table of keys says, and its examples are right. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "study/helpers.h"
#include "support/suite.h"

static char *read_guide(void) {
    const char *source = getenv("SOURCE");
    char path[1000];
    ck_assert_msg(source != NULL, "SOURCE must name the folder of the sources");
    snprintf(path, sizeof path, "%s/docs/guide/study-file.md", source);
    FILE *file = fopen(path, "rb");
    ck_assert_msg(file != NULL, "%s cannot be opened", path);
    char *text = calloc(1, 200000);
    ck_assert_ptr_nonnull(text);
    ck_assert_uint_lt(fread(text, 1, 199999, file), 199999);
    fclose(file);
    return text;
}

START_TEST(guide_has_the_row_of_every_key) {
    char *guide = read_guide(), row[1000];
    size_t count;
    const gough_key *key = gough_study_keys(&count);
    const char *before = guide;
    for (size_t i = 0; i < count; i++, key++) {
        snprintf(row, sizeof row, "\n| `%s` | %s | %s | %s | %s | %s |\n", key->path, key->type,
                 key->unit, key->range, key->fallback, key->sentence);
        const char *at = strstr(guide, row);
        ck_assert_msg(at != NULL, "docs/guide/study-file.md lacks the row%s", row);
        ck_assert_msg(at > before, "%s stands in another order than in the table", key->path);
        before = at;
    }
    free(guide);
}
END_TEST

START_TEST(guide_has_no_row_of_another_key) {
    char *guide = read_guide();
    size_t count;
    gough_study_keys(&count);
    ck_assert_int_eq(occurrences(guide, "\n| `"), (int)count);
    free(guide);
}
END_TEST

/* The n-th block of YAML in the guide, cut out in place. */
static char *block(char *guide, int n) {
    char *at = guide;
    for (int i = 0; i <= n; i++) {
        at = strstr(at, "```yaml\n");
        if (!at) return NULL;
        at += strlen("```yaml\n");
    }
    *strstr(at, "```") = '\0';
    return at;
}

START_TEST(examples_of_the_guide_are_right) {
    char *guide = read_guide(), *study = block(guide, 0);
    reading made = read_bytes(study, strlen(study), NULL);
    ck_assert_msg(made.status == GOUGH_OK, "%s", made.messages ? made.messages : "");
    reading_free(&made);
    free(guide);
    guide = read_guide();
    char *limits = block(guide, 1), with[2000];
    ck_assert_ptr_nonnull(strstr(limits, "limits:"));
    snprintf(with, sizeof with,
             "platform:\n  base: {radius: 0.25, half_angle: 10}\n  top: {radius: 0.15, half_angle: "
             "10}\n  height: 0.28\n%sload: {mass: 6, inertia: [0.05, 0.05, 0.08]}\n",
             limits + strlen("platform:\n"));
    made = read_bytes(with, strlen(with), NULL);
    ck_assert_msg(made.status == GOUGH_OK, "%s", made.messages ? made.messages : "");
    reading_free(&made);
    free(guide);
    guide = read_guide();
    char *drives = block(guide, 2);
    ck_assert_ptr_nonnull(strstr(drives, "actuators:"));
    made = expect_good(drives, NULL);
    ck_assert_int_eq(made.study->model->machine.platform.actuators.kind, GOUGH_ACTUATOR_LAG);
    reading_free(&made);
    free(guide);
    guide = read_guide();
    char *control = block(guide, 4);
    made = expect_good(control, NULL);
    ck_assert(made.study->model->control.sampling.period == 0.001);
    reading_free(&made);
    free(guide);
    guide = read_guide();
    char *loads = block(guide, 3);
    ck_assert_ptr_nonnull(strstr(loads, "external:"));
    made = expect_good(loads, NULL);
    ck_assert_uint_eq(made.study->model->machine.externals, 2);
    reading_free(&made);
    free(guide);
    guide = read_guide();
    char *moves = block(guide, 5);
    ck_assert_ptr_nonnull(strstr(moves, "moves:"));
    made = expect_good(moves, NULL);
    reading_free(&made);
    free(guide);
}
END_TEST

START_TEST(functions_of_the_guide_are_those_of_formulas) {
    static const char *const functions[] = {"sin",  "cos",  "tan",         "asin",
                                            "acos", "atan", "exp",         "log",
                                            "sqrt", "tanh", "atan2(y, x)", "ramp(t, T)"};
    char *guide = read_guide(), name[40], formula[60];
    for (size_t i = 0; i < sizeof functions / sizeof functions[0]; i++) {
        snprintf(name, sizeof name, "`%s`", functions[i]);
        ck_assert_ptr_nonnull(strstr(guide, name));
        snprintf(formula, sizeof formula, "motion:\n  heave: %.*s(%s)\n",
                 (int)strcspn(functions[i], "("), functions[i],
                 strchr(functions[i], '(') ? "t, 2" : "t");
        reading made = expect_good(formula, NULL);
        reading_free(&made);
    }
    free(guide);
}
END_TEST

int main(void) {
    return SUITE_RUN("study/guide", 30, guide_has_the_row_of_every_key,
                     guide_has_no_row_of_another_key, examples_of_the_guide_are_right,
                     functions_of_the_guide_are_those_of_formulas);
}
