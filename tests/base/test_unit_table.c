/* Units: every word with its size, every composed unit with its name and factor, all written down here once more; and the
 * sentences of errors in units. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/quantity.h"
#include "gough/units.h"
#include "support/suite.h"

/* sizes in SI, of angles in degrees */
static const struct {
    gough_base_unit base;
    int index;
    const char *word;
    double size;
} words[] = {{GOUGH_BASE_LENGTH, 0, "m", 1},
             {GOUGH_BASE_LENGTH, 1, "mm", 0.001},
             {GOUGH_BASE_LENGTH, 2, "um", 0.000001},
             {GOUGH_BASE_LENGTH, 3, "in", 0.0254},
             {GOUGH_BASE_LENGTH, 4, "ft", 12 * 0.0254},
             {GOUGH_BASE_FORCE, 0, "N", 1},
             {GOUGH_BASE_FORCE, 1, "kN", 1000},
             {GOUGH_BASE_FORCE, 2, "lbf", 0.45359237 * 9.80665},
             {GOUGH_BASE_MASS, 0, "kg", 1},
             {GOUGH_BASE_MASS, 1, "t", 1000},
             {GOUGH_BASE_MASS, 2, "lb", 0.45359237},
             {GOUGH_BASE_ANGLE, 0, "deg", 1},
             {GOUGH_BASE_ANGLE, 1, "rad", 57.29577951308232},
             {GOUGH_BASE_ANGLE, 2, "mrad", 0.05729577951308232},
             {GOUGH_BASE_ANGLE, 3, "arcsec", 1.0 / 3600},
             {GOUGH_BASE_TIME, 0, "s", 1},
             {GOUGH_BASE_TIME, 1, "ms", 0.001}};
enum { WORDS = sizeof words / sizeof words[0] };

static const gough_unit alone[GOUGH_BASE_UNITS] = {
    GOUGH_UNIT_LENGTH, GOUGH_UNIT_FORCE, GOUGH_UNIT_MASS, GOUGH_UNIT_ANGLE, GOUGH_UNIT_TIME};

static bool close_to(double a, double b) { return fabs(a - b) <= 1e-15 * fabs(b); }

START_TEST(each_word_has_its_size) {
    int count[GOUGH_BASE_UNITS] = {0};
    for (int i = 0; i < WORDS; i++) {
        const gough_base_unit base = words[i].base;
        const gough_units si = gough_units_si();
        gough_units units = si;
        count[base]++;
        ck_assert_str_eq(gough_unit_choice(base, words[i].index), words[i].word);
        ck_assert(gough_units_choose(&units, base, words[i].word));
        const double in_si = gough_unit_read(&si, alone[base], words[i].size);
        ck_assert_msg(close_to(gough_unit_read(&units, alone[base], 1), in_si), "%s",
                      words[i].word);
        ck_assert_msg(close_to(gough_unit_factor(&units, alone[base]) * in_si, 1), "%s",
                      words[i].word);
    }
    for (int b = 0; b < GOUGH_BASE_UNITS; b++)
        ck_assert_ptr_null(gough_unit_choice((gough_base_unit)b, count[b]));
    ck_assert_ptr_null(gough_unit_choice(GOUGH_BASE_LENGTH, -1));
}
END_TEST

START_TEST(a_word_of_another_unit_changes_nothing) {
    gough_units units = gough_units_si();
    const gough_units before = units;
    ck_assert(!gough_units_choose(&units, GOUGH_BASE_LENGTH, "kg"));
    ck_assert(!gough_units_choose(&units, GOUGH_BASE_LENGTH, ""));
    ck_assert(!gough_units_choose(&units, GOUGH_BASE_TIME, "min"));
    ck_assert(memcmp(units.name, before.name, sizeof units.name) == 0 && close_to(units.length, 1));
}
END_TEST

/* what is written as 50 mm is 0.05 m to the last digit; the way back costs a rounding */
START_TEST(thousandths_keep_their_digits) {
    gough_units units = gough_units_si();
    gough_units_choose(&units, GOUGH_BASE_LENGTH, "mm");
    gough_units_choose(&units, GOUGH_BASE_TIME, "ms");
    for (int i = 1; i < 2000; i++) {
        ck_assert(fabs(gough_unit_read(&units, GOUGH_UNIT_LENGTH, i) - i / 1000.0) <= 0);
        ck_assert(close_to(gough_unit_factor(&units, GOUGH_UNIT_TIME) * (i / 1000.0), i));
    }
}
END_TEST

static gough_units inches(void) {
    gough_units units = gough_units_si();
    gough_units_choose(&units, GOUGH_BASE_LENGTH, "in");
    gough_units_choose(&units, GOUGH_BASE_FORCE, "lbf");
    gough_units_choose(&units, GOUGH_BASE_MASS, "lb");
    gough_units_choose(&units, GOUGH_BASE_ANGLE, "mrad");
    gough_units_choose(&units, GOUGH_BASE_TIME, "ms");
    return units;
}

START_TEST(composed_units_have_their_names_and_factors) {
    static const double in = 0.0254, lbf = 4.4482216152605, lb = 0.45359237, ms = 0.001,
                        mrad = 0.001;
    const struct {
        gough_unit unit;
        const char *label, *word;
        double size;
    } all[] = {{GOUGH_UNIT_NONE, "1", "", 1},
               {GOUGH_UNIT_LENGTH, "in", " in", in},
               {GOUGH_UNIT_MASS, "lb", " lb", lb},
               {GOUGH_UNIT_TIME, "ms", " ms", ms},
               {GOUGH_UNIT_ANGLE, "mrad", " mrad", mrad},
               {GOUGH_UNIT_RATE, "1/ms", " 1/ms", 1 / ms},
               {GOUGH_UNIT_SPEED, "in/ms", " in/ms", in / ms},
               {GOUGH_UNIT_ANGULAR_SPEED, "mrad/ms", " mrad/ms", mrad / ms},
               {GOUGH_UNIT_ACCELERATION, "in/ms2", " in/ms^2", in / ms / ms},
               {GOUGH_UNIT_ANGULAR_ACCELERATION, "mrad/ms2", " mrad/ms^2", mrad / ms / ms},
               {GOUGH_UNIT_FORCE, "lbf", " lbf", lbf},
               {GOUGH_UNIT_MOMENT, "lbf in", " lbf in", lbf * in},
               {GOUGH_UNIT_POWER, "W", " W", 1},
               {GOUGH_UNIT_ENERGY, "J", " J", 1},
               {GOUGH_UNIT_STIFFNESS, "lbf/in", " lbf/in", lbf / in},
               {GOUGH_UNIT_DAMPING, "lbf ms/in", " lbf ms/in", lbf * ms / in},
               {GOUGH_UNIT_INERTIA, "lb in2", " lb in^2", lb * in * in},
               {GOUGH_UNIT_FORCE_RATE, "lbf/ms", " lbf/ms", lbf / ms},
               {GOUGH_UNIT_INTEGRAL_GAIN, "lbf/(in ms)", " lbf/(in ms)", lbf / in / ms}};
    const gough_units units = inches();
    ck_assert_uint_eq(sizeof all / sizeof all[0], GOUGH_UNIT_INTEGRAL_GAIN + 1);
    for (int i = 0; i <= GOUGH_UNIT_INTEGRAL_GAIN; i++) {
        ck_assert_int_eq(all[i].unit, i);
        ck_assert_str_eq(gough_unit_label(&units, all[i].unit), all[i].label);
        ck_assert_str_eq(gough_unit_word(&units, all[i].unit), all[i].word);
        ck_assert_msg(fabs(gough_unit_read(&units, all[i].unit, 1) / all[i].size - 1) <= 1e-15,
                      "%s", all[i].label);
        ck_assert_msg(fabs(gough_unit_factor(&units, all[i].unit) * all[i].size - 1) <= 1e-15, "%s",
                      all[i].label);
    }
}
END_TEST

/* every combination: the label of stiffness, damping, moment and inertia is made of those of its base units */
START_TEST(every_combination_is_named_by_its_words) {
    for (int l = 0; l < 5; l++)
        for (int f = 0; f < 3; f++)
            for (int t = 0; t < 2; t++) {
                gough_units units = gough_units_si();
                const char *length = gough_unit_choice(GOUGH_BASE_LENGTH, l),
                           *force = gough_unit_choice(GOUGH_BASE_FORCE, f),
                           *mass = gough_unit_choice(GOUGH_BASE_MASS, f),
                           *time = gough_unit_choice(GOUGH_BASE_TIME, t);
                char text[32];
                gough_units_choose(&units, GOUGH_BASE_LENGTH, length);
                gough_units_choose(&units, GOUGH_BASE_FORCE, force);
                gough_units_choose(&units, GOUGH_BASE_MASS, mass);
                gough_units_choose(&units, GOUGH_BASE_TIME, time);
                snprintf(text, sizeof text, "%s %s/%s", force, time, length);
                ck_assert_str_eq(gough_unit_label(&units, GOUGH_UNIT_DAMPING), text);
                snprintf(text, sizeof text, "%s/%s", force, length);
                ck_assert_str_eq(gough_unit_label(&units, GOUGH_UNIT_STIFFNESS), text);
                snprintf(text, sizeof text, "%s %s", force, length);
                ck_assert_str_eq(gough_unit_label(&units, GOUGH_UNIT_MOMENT), text);
                snprintf(text, sizeof text, "%s %s2", mass, length);
                ck_assert_str_eq(gough_unit_label(&units, GOUGH_UNIT_INERTIA), text);
                snprintf(text, sizeof text, "%s/(%s %s)", force, length, time);
                ck_assert_str_eq(gough_unit_label(&units, GOUGH_UNIT_INTEGRAL_GAIN), text);
                snprintf(text, sizeof text, "%s/%s", force, time);
                ck_assert_str_eq(gough_unit_label(&units, GOUGH_UNIT_FORCE_RATE), text);
                snprintf(text, sizeof text, "%s/%s2", length, time);
                ck_assert_str_eq(gough_unit_label(&units, GOUGH_UNIT_ACCELERATION), text);
            }
}
END_TEST

START_TEST(powers_follow_the_choice_of_force) {
    const gough_units chosen = gough_units_si(), consistent = {.length = 1, .mass = 1, .time = 1};
    int power[GOUGH_BASE_UNITS];
    gough_unit_powers(&chosen, GOUGH_UNIT_DAMPING, power);
    ck_assert(power[GOUGH_BASE_FORCE] == 1 && power[GOUGH_BASE_TIME] == 1 &&
              power[GOUGH_BASE_LENGTH] == -1 && power[GOUGH_BASE_MASS] == 0);
    gough_unit_powers(&consistent, GOUGH_UNIT_DAMPING, power);
    ck_assert(power[GOUGH_BASE_FORCE] == 0 && power[GOUGH_BASE_TIME] == -1 &&
              power[GOUGH_BASE_LENGTH] == 0 && power[GOUGH_BASE_MASS] == 1);
    gough_unit_powers(&chosen, GOUGH_UNIT_POWER, power);
    for (int b = 0; b < GOUGH_BASE_UNITS; b++) ck_assert_int_eq(power[b], 0);
    gough_unit_powers(&consistent, GOUGH_UNIT_POWER, power);
    ck_assert(power[GOUGH_BASE_LENGTH] == 2 && power[GOUGH_BASE_MASS] == 1 &&
              power[GOUGH_BASE_TIME] == -3);
}
END_TEST

START_TEST(a_struct_of_another_size_is_refused) {
    gough_units units;
    ck_assert_int_eq(gough_units_init(&units, sizeof units - 1), GOUGH_ERROR_INPUT);
}
END_TEST

/* ---- sentences ---- */

START_TEST(marks_are_not_part_of_a_sentence) {
    gough_error error;
    gough_fail(&error, GOUGH_ERROR_INPUT, "at t = %.9g" IN_TIME " it is %g" IN_LENGTH ", %d times",
               0.25, 2.0, 3);
    ck_assert_str_eq(error.message, "at t = 0.25 it is 2, 3 times");
    ck_assert_int_eq(error.quantities, 2);
}
END_TEST

START_TEST(sentences_are_written_in_units) {
    const gough_units units = inches(), si = gough_units_si();
    gough_units none = si;
    gough_error error;
    none.dimensionless = true;
    gough_fail(&error, GOUGH_ERROR_INPUT,
               "at t = %.9g" IN_TIME " it turns by %.3g%s and is %g" IN_LENGTH " long, %d times",
               0.25, 90.0, IN_DEGREES " (degrees)", 0.0508, 3);
    ck_assert_str_eq(error.message,
                     "at t = 0.25 it turns by 90 (degrees) and is 0.0508 long, 3 times");
    gough_error_say(&error, &none);
    ck_assert_str_eq(error.message,
                     "at t = 0.25 it turns by 90 (degrees) and is 0.0508 long, 3 times");
    gough_fail(&error, GOUGH_ERROR_INPUT,
               "at t = %.9g" IN_TIME " it turns by %.3g%s and is %g" IN_LENGTH " long, %d times",
               0.25, 90.0, IN_DEGREES " (degrees)", 0.0508, 3);
    gough_error_say(&error, &si);
    ck_assert_str_eq(error.message,
                     "at t = 0.25 s it turns by 90 deg and is 0.0508 m long, 3 times");
    gough_fail(&error, GOUGH_ERROR_INPUT,
               "at t = %.9g" IN_TIME " it turns by %.3g%s and is %g" IN_LENGTH " long, %d times",
               0.25, 90.0, IN_DEGREES " (degrees)", 0.0508, 3);
    gough_error_say(&error, &units);
    ck_assert_str_eq(error.message,
                     "at t = 250 ms it turns by 1.57e+03 mrad and is 2 in long, 3 times");
    gough_error_say(&error, &units);
    ck_assert_str_eq(error.message,
                     "at t = 250 ms it turns by 1.57e+03 mrad and is 2 in long, 3 times");
}
END_TEST

/* a part's numbers are still known in the sentence around it, in their order */
START_TEST(numbers_of_a_part_are_carried) {
    const gough_units units = inches();
    gough_error part, error;
    gough_fail(&part, GOUGH_OK, "heave %g" IN_LENGTH, 0.0254);
    gough_fail(&error, GOUGH_ERROR_INPUT, "the pose (%s) fails at t = %g" IN_TIME, part.message,
               1.0);
    quantity_carry(&error, &part);
    gough_error_say(&error, &units);
    ck_assert_str_eq(error.message, "the pose (heave 1 in) fails at t = 1000 ms");
}
END_TEST

/* a sentence that fills its room is cut, not longer */
START_TEST(a_long_sentence_stays_in_its_room) {
    const gough_units units = inches();
    gough_error error;
    char text[600];
    memset(text, 'x', sizeof text);
    text[480] = '\0';
    gough_fail(&error, GOUGH_ERROR_INPUT, "%s %.17g" IN_LENGTH, text, 1.0 / 3);
    gough_error_say(&error, &units);
    ck_assert_uint_lt(strlen(error.message), sizeof error.message);
}
END_TEST

/* as records have them, in letters of either case */
START_TEST(units_of_records_have_their_sizes) {
    const double degree = 3.14159265358979323846 / 180;
    const struct {
        const char *word;
        gough_unit unit;
        double size;
    } known[] = {
        {"m", GOUGH_UNIT_LENGTH, 1},
        {"MM", GOUGH_UNIT_LENGTH, 1e-3},
        {"cm", GOUGH_UNIT_LENGTH, 1e-2},
        {"\u00b5m", GOUGH_UNIT_LENGTH, 1e-6},
        {"feet", GOUGH_UNIT_LENGTH, 0.3048},
        {"Degrees", GOUGH_UNIT_ANGLE, degree},
        {"\u00b0", GOUGH_UNIT_ANGLE, degree},
        {"rad", GOUGH_UNIT_ANGLE, 1},
        {"S", GOUGH_UNIT_TIME, 1},
        {"msec", GOUGH_UNIT_TIME, 1e-3},
        {"min", GOUGH_UNIT_TIME, 60},
        {"g", GOUGH_UNIT_ACCELERATION, 9.80665},
        {"Gal", GOUGH_UNIT_ACCELERATION, 0.01},
        {"mm/s", GOUGH_UNIT_SPEED, 1e-3},
        {"deg/ms", GOUGH_UNIT_ANGULAR_SPEED, degree * 1e3},
        {"cm/s2", GOUGH_UNIT_ACCELERATION, 1e-2},
        {"m/s^2", GOUGH_UNIT_ACCELERATION, 1},
        {"m/s\u00b2", GOUGH_UNIT_ACCELERATION, 1},
        {"m/s/s", GOUGH_UNIT_ACCELERATION, 1},
        {"rad/s^2", GOUGH_UNIT_ANGULAR_ACCELERATION, 1},
    };
    static const char *const unknown[] = {"",      "x",   "m/",  "/s",  "m/m",    "s/s",
                                          "N",     "g/s", "m2",  "m/2", "m/s/ms", "m/s^3",
                                          "m/s//", "kg",  "m s", "m/s "};
    gough_unit unit;
    double size;
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        ck_assert_msg(gough_unit_named(known[i].word, strlen(known[i].word), &unit, &size), "%s",
                      known[i].word);
        ck_assert_msg(unit == known[i].unit && fabs(size / known[i].size - 1) <= 1e-15, "%s",
                      known[i].word);
    }
    for (size_t i = 0; i < sizeof unknown / sizeof unknown[0]; i++)
        ck_assert_msg(!gough_unit_named(unknown[i], strlen(unknown[i]), &unit, &size), "%s",
                      unknown[i]);
}
END_TEST

int main(void) {
    return SUITE_RUN("base/unit_table", 30, units_of_records_have_their_sizes,
                     each_word_has_its_size, a_word_of_another_unit_changes_nothing,
                     thousandths_keep_their_digits, composed_units_have_their_names_and_factors,
                     every_combination_is_named_by_its_words, powers_follow_the_choice_of_force,
                     a_struct_of_another_size_is_refused, marks_are_not_part_of_a_sentence,
                     sentences_are_written_in_units, numbers_of_a_part_are_carried,
                     a_long_sentence_stays_in_its_room);
}
