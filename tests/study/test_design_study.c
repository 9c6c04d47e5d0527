/* Studies with a section `design`: keys with their bounds, the request in units of the run, models of other numbers, and the text
 * with other numbers, which reads back as the same model. */
#include <math.h>
#include <string.h>

#include "study/helpers.h"
#include "support/suite.h"

static const char text[] =
    "\xEF\xBB\xBF# a table\n"
    "units: {length: mm, angle: rad}\n"
    "platform:\n"
    "  base: {radius: 900, half_angle: 0.2}   # base\n"
    "  top: {radius: 600.0, half_angle: 0.2}\n"
    "  height: 9e2 # of the top\n"
    "  legs: {length: [[500, 1500], [500, 1500], [500, 1500], [500, 1500], [500, 1500], [500, "
    "1600]]}\n"
    "load: {mass: 300, inertia: [9e6, 9e6, 9e6], center_of_mass: [1, 2, 3]}\n"
    "workspace: {box: {heave: 100}}\n"
    "design:\n"
    "  vary:\n"
    "    platform.height: [600, 1500]\n"
    "    platform.legs.length.6.2: [1500, 1700]\n"
    "    load.center_of_mass.2: [-10, 10]\n"
    "    platform.top.half_angle: [0.1, 0.4]\n"
    "  minimize: {force: 1, footprint: 0.25}\n"
    "  telescope: 250\n"
    "  seed: 4294967295\n";

static gough_design_study *parse(const gough_setting *settings, size_t count) {
    gough_design_study *made = NULL;
    char *messages = NULL;
    const gough_status status = gough_design_study_parse("table.yaml", text, strlen(text), settings,
                                                         count, &made, &messages);
    ck_assert_msg(status == GOUGH_OK, "%s", messages ? messages : "");
    return made;
}

START_TEST(a_request_has_bounds_of_the_file_and_lengths_of_the_run) {
    gough_design_study *design = parse(NULL, 0);
    gough_design_request r;
    size_t count;
    const gough_design_key *key = gough_design_study_keys(design, &count);
    ck_assert_uint_eq(count, 4);
    ck_assert_str_eq(key[1].path, "platform.legs.length.6.2");
    ck_assert_str_eq(key[1].unit, "length");
    ck_assert_double_eq_tol(key[1].start, 1600, 1e-12);
    ck_assert_str_eq(gough_design_study_own(design)->name, "table.yaml");
    ck_assert_int_eq(gough_design_study_request(design, &r, sizeof r - 1), GOUGH_ERROR_INPUT);
    ck_assert_int_eq(gough_design_study_request(design, &r, sizeof r), GOUGH_OK);
    ck_assert(r.keys == 4 && r.seed == 4294967295U && r.evaluations == 0);
    ck_assert_double_eq_tol(r.least[0], 600, 1e-12);
    ck_assert_double_eq_tol(r.greatest[2], 10, 1e-12);
    ck_assert_double_eq_tol(r.start[0], 900, 1e-12);
    ck_assert_double_eq_tol(r.telescope, 0.25, 1e-15);
    ck_assert_double_eq_tol(r.weight[GOUGH_AIM_FOOTPRINT], 0.25, 1e-12);
    ck_assert_double_eq_tol(r.weight[GOUGH_AIM_STROKE], 0, 1e-12);
    gough_design_study_free(design);
    gough_design_study_free(NULL);
    ck_assert_int_eq(gough_design_request_init(&r, sizeof r - 1), GOUGH_ERROR_INPUT);
}
END_TEST

START_TEST(a_written_study_reads_back_as_the_same_model) {
    static const gough_setting settings[] = {{"load.mass", "250"}, {"platform.height", "1000"}};
    const double value[] = {1234.5678901234567, 1700, -1.0 / 3, 0.1};
    gough_design_study *design = parse(settings, 2), *again = NULL;
    gough_design_request r;
    const gough_model *model = NULL;
    gough_error error = {.message = ""};
    const char *written = NULL;
    gough_design_study_request(design, &r, sizeof r);
    ck_assert_double_eq_tol(r.start[0], 1000, 1e-12);
    ck_assert_int_eq(r.make(r.context, value, &model, &error), GOUGH_OK);
    ck_assert_double_eq_tol(model->machine.platform.height, 1.2345678901234567, 1e-15);
    ck_assert_msg(gough_design_study_text(design, value, &written, &error) == GOUGH_OK, "%s",
                  error.message);
    ck_assert_ptr_nonnull(strstr(written, "\xEF\xBB\xBF# a table\n"));
    ck_assert_ptr_nonnull(strstr(written, "  height: 1234.5678901234567 # of the top\n"));
    ck_assert_ptr_nonnull(strstr(written, "[500, 1700]]}"));
    ck_assert_ptr_nonnull(strstr(written, "load: {mass: 250,"));
    ck_assert_int_eq(
        gough_design_study_parse("again.yaml", written, strlen(written), NULL, 0, &again, NULL),
        GOUGH_OK);
    const gough_model *own = gough_design_study_own(again)->model;
    ck_assert_mem_eq(&own->machine.platform.height, &model->machine.platform.height,
                     sizeof(double));
    ck_assert_mem_eq(own->machine.platform.top, model->machine.platform.top,
                     sizeof own->machine.platform.top);
    ck_assert_mem_eq(own->machine.platform.legs.length, model->machine.platform.legs.length,
                     sizeof own->machine.platform.legs.length);
    ck_assert_mem_eq(&own->machine.load, &model->machine.load, sizeof own->machine.load);
    gough_design_study_free(design);
    gough_design_study_free(again);
}
END_TEST

START_TEST(numbers_out_of_range_make_no_model_and_no_text) {
    const double wrong[] = {900, 1600, 0, 2}, right[] = {900, 1600, 0, 0.3};
    gough_design_study *design = parse(NULL, 0);
    gough_design_request r;
    const gough_model *model = NULL;
    gough_error error = {.message = ""};
    const char *written = text;
    gough_design_study_request(design, &r, sizeof r);
    ck_assert_int_eq(r.make(r.context, wrong, &model, &error), GOUGH_ERROR_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "half_angle"));
    ck_assert_int_eq(gough_design_study_text(design, wrong, &written, &error), GOUGH_ERROR_INPUT);
    ck_assert_ptr_null(written);
    ck_assert_int_eq(r.make(r.context, right, &model, &error), GOUGH_OK);
    gough_design_study_free(design);
}
END_TEST

START_TEST(settings_that_are_no_single_values_are_not_written) {
    static const char *const cases[][2] = {{"load.inertia", "[8e6, 8e6, 8e6]"},
                                           {"title", "new"},
                                           {"design.telescope", ""},
                                           {"load.mass", "300 # heavy"},
                                           {"sweep.keys.load.mass", "[1, 2]"}};
    const double value[] = {900, 1600, 0, 0.3};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const gough_setting setting = {cases[i][0], cases[i][1]};
        gough_design_study *design = parse(&setting, 1);
        gough_error error = {.message = ""};
        const char *written = text;
        ck_assert_msg(gough_design_study_text(design, value, &written, &error) == GOUGH_ERROR_INPUT,
                      "%s", cases[i][0]);
        ck_assert_ptr_nonnull(strstr(error.message, "the study cannot be written with"));
        ck_assert_ptr_null(written);
        gough_design_study_free(design);
    }
}
END_TEST

int main(void) {
    return SUITE_RUN("study/design", 30, a_request_has_bounds_of_the_file_and_lengths_of_the_run,
                     a_written_study_reads_back_as_the_same_model,
                     numbers_out_of_range_make_no_model_and_no_text,
                     settings_that_are_no_single_values_are_not_written);
}
