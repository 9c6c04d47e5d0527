/* Mass and friction of legs in a study: one number or six, and what is refused, each at its place. */
#include <stdio.h>
#include <string.h>

#include "study/helpers.h"
#include "support/suite.h"

#define EXACTLY(a, b) ck_assert_msg((a) <= (b) && (a) >= (b), "%s is %.17g", #a, (double)(a))

/* a study whose platform.legs is `legs`, in flow style */
static void text_of(const char *legs, char text[2000]) {
    snprintf(text, 2000,
             "units: dimensionless\n"
             "platform:\n"
             "  base: {radius: 1.0, half_angle: 15}\n"
             "  top: {radius: 0.6, half_angle: 15}\n"
             "  height: 1.2\n"
             "  legs: %s\n"
             "load: {mass: 1, inertia: [0.08, 0.08, 0.15]}\n",
             legs);
}

static reading read_legs(const char *legs) {
    char text[2000];

    text_of(legs, text);
    return read_bytes(text, strlen(text), NULL);
}

/* the message, at this place of line 6 */
static void refused(const char *legs, int column, const char *sentence) {
    char text[2000], begins[1200];

    text_of(legs, text);
    snprintf(begins, sizeof begins, "study.yaml:6:%d: error: %s", column, sentence);
    expect_said(text, begins);
}

/* every key of the legs with one value */
static void every_key(const char *value, char legs[1000]) {
    static const char *const key[] = {
        "{cylinder: {mass: ", ", center: ",    ", inertia: ",         "}, piston: {mass: ",
        ", center: ",         ", inertia: ",   "}, reflected_mass: ", ", friction: {viscous: ",
        ", coulomb: ",        ", breakaway: ", ", stribeck_speed: ",  ", smoothing_speed: ",
        ", efficiency: "};

    legs[0] = '\0';
    for (size_t i = 0; i < sizeof key / sizeof key[0]; i++) {
        strcat(legs, key[i]);
        strcat(legs, value);
    }
    strcat(legs, "}}");
}

START_TEST(six_equal_numbers_are_one_number) {
    char one[1000], six[1000];

    every_key("0.7", one);
    every_key("[0.7, 0.7, 0.7, 0.7, 0.7, 0.7]", six);
    reading a = read_legs(one), b = read_legs(six);
    ck_assert_msg(a.status == GOUGH_OK && b.status == GOUGH_OK, "%s%s", a.messages, b.messages);
    const gough_machine *m = &a.study->model->machine;
    ck_assert(memcmp(m, &b.study->model->machine, sizeof *m) == 0);
    ck_assert(m->platform.legs_have_mass);
    EXACTLY(m->platform.piston.center[5], 0.7);
    EXACTLY(m->breakaway[3], 0.7);
    reading_free(&a);
    reading_free(&b);
}
END_TEST

START_TEST(what_is_left_out_follows_from_the_rest) {
    reading light = read_legs("{length: [0.5, 2]}"), zero = read_legs("{piston: {mass: 0}}"),
            rough = read_legs("{friction: {coulomb: 0.3, stribeck_speed: 0.2}}"),
            dry = read_legs("{friction: {coulomb: [0, 0.1, 0.2, 0.3, 0.4, 0.5]}}");
    const gough_machine *m = &light.study->model->machine;

    ck_assert(!m->platform.legs_have_mass);
    EXACTLY(m->platform.friction.efficiency[0], 1);
    m = &zero.study->model->machine;
    ck_assert(m->platform.legs_have_mass); /* the equations of legs with mass, all of it 0 */
    m = &rough.study->model->machine;
    ck_assert(!m->platform.legs_have_mass);
    EXACTLY(m->breakaway[2], 0.3);
    EXACTLY(m->smoothing_speed[2], 0.2 / 20);
    m = &dry.study->model->machine;
    EXACTLY(m->smoothing_speed[1], 1e-3); /* √(g R_b) is 1 */
    EXACTLY(m->breakaway[5], 0.5);
    reading_free(&light);
    reading_free(&zero);
    reading_free(&rough);
    reading_free(&dry);
}
END_TEST

START_TEST(a_mass_needs_its_centre_and_its_inertia) {
    refused(
        "{cylinder: {mass: 1, inertia: 2}}", 21,
        "`platform.legs.cylinder` has a mass but no `center`: the distance of its centre of mass");
    refused("{piston: {center: 0.3, mass: [0, 0, 1, 0, 0, 0]}}", 32,
            "`platform.legs.piston` has a mass but no `inertia`: its moment of inertia");
    reading none = read_legs("{piston: {mass: 0}}");
    ck_assert_int_eq(none.status, GOUGH_OK);
    reading_free(&none);
}
END_TEST

START_TEST(friction_that_contradicts_itself_is_refused) {
    refused("{friction: {coulomb: 2, breakaway: 1, stribeck_speed: 1}}", 33,
            "the breakaway friction, 1, must not be below the Coulomb friction, 2, in leg 1");
    refused("{friction: {coulomb: 2, breakaway: 0}}", 44,
            "`platform.legs.friction.breakaway` must not be below `coulomb`");
    refused("{friction: {coulomb: 1, breakaway: 2}}", 33,
            "breakaway friction above Coulomb friction needs a stribeck_speed, in leg 1");
    refused("{friction: {coulomb: 1, efficiency: 0}}", 45,
            "`platform.legs.friction.efficiency` must be greater than 0, and at most 1, found 0");
    reading none = read_legs("{friction: {coulomb: 0, breakaway: 0}}");
    ck_assert_msg(none.status == GOUGH_OK, "%s", none.messages);
    reading_free(&none);
}
END_TEST

START_TEST(lists_of_five_and_negative_numbers_are_refused) {
    refused("{reflected_mass: [1, 2, 3, 4, 5]}", 26,
            "`platform.legs.reflected_mass` must be a number or a list of six numbers");
    refused("{cylinder: {mass: -1, center: 0, inertia: 0}}", 27,
            "`platform.legs.cylinder.mass` must be 0 or greater, found -1");
    refused("{friction: {viscous: [1, 1, 1, -2, 1, 1]}}", 40,
            "`platform.legs.friction.viscous.4` must be 0 or greater, found -2");
}
END_TEST

/* without gravity there is no speed to take */
START_TEST(dry_friction_without_gravity_needs_its_speed) {
    char text[2000];

    text_of("{friction: {coulomb: 1}}", text);
    strcat(text, "gravity: 0\n");
    expect_said(text, "study.yaml:6:10: error: dry friction needs a smoothing_speed where there is "
                      "neither a stribeck_speed nor gravity, in leg 1");
}
END_TEST

START_TEST(rattle_needs_legs_without_dry_friction) {
    char text[2000];

    text_of("{friction: {efficiency: 0.9}}", text);
    strcat(text, "simulation: {method: rattle2, step: 0.01, output_step: 0.1}\n");
    expect_said(text, "study.yaml:8:14: error: simulation.method: the method rattle2 needs legs "
                      "without dry friction; use dop853 or rk4 here");
}
END_TEST

int main(void) {
    return SUITE_RUN(
        "study/legs", 60, six_equal_numbers_are_one_number, what_is_left_out_follows_from_the_rest,
        a_mass_needs_its_centre_and_its_inertia, friction_that_contradicts_itself_is_refused,
        lists_of_five_and_negative_numbers_are_refused,
        dry_friction_without_gravity_needs_its_speed, rattle_needs_legs_without_dry_friction);
}
