/* The section `sweep` of a study: which runs it asks for, and that the study of a run is the one read with its values as
 * settings. */
#include "gough/random.h"
#include "gough/sweep.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "study/helpers.h"
#include "support/suite.h"

/* The good study with these lines as a sweep; the test fails where it is none. */
static gough_sweep *sweep_of(const char *lines) {
    char text[4000], *messages = NULL;
    gough_sweep *sweep = NULL;
    snprintf(text, sizeof text, "%s%s", good_study, lines);
    const gough_status status =
        gough_sweep_parse("study.yaml", text, strlen(text), NULL, 0, &sweep, &messages);
    ck_assert_msg(status == GOUGH_OK, "%s", messages ? messages : "");
    gough_study_free_messages(messages);
    return sweep;
}

/* Expects a message of the study's reader and of the sweep's. */
static void refuse(const char *lines, const char *part) {
    char text[4000], *messages = NULL;
    gough_sweep *sweep = NULL;
    snprintf(text, sizeof text, "%s%s", good_study, lines);
    const gough_status status =
        gough_sweep_parse("study.yaml", text, strlen(text), NULL, 0, &sweep, &messages);
    ck_assert_int_eq(status, GOUGH_ERROR_INPUT);
    ck_assert_msg(strstr(messages, part) != NULL, "'%s' is not in:\n%s", part, messages);
    gough_study_free_messages(messages);
    expect_said(text, part);
}

static double value_of(const gough_sweep *sweep, size_t run, size_t key) {
    double value[8];
    gough_sweep_values(sweep, run, value);
    return value[key];
}

static bool same(double a, double b) { return memcmp(&a, &b, sizeof a) == 0; }

START_TEST(grids_have_their_ends_exactly) {
    gough_sweep *sweep = sweep_of("sweep: {keys: {load.mass: {from: 0.1, to: 0.7, steps: 7}}}\n");
    ck_assert_uint_eq(gough_sweep_runs(sweep), 7);
    ck_assert(same(value_of(sweep, 1, 0), 0.1));
    ck_assert(same(value_of(sweep, 7, 0), 0.7));
    for (size_t n = 1; n <= 7; n++)
        ck_assert(fabs(value_of(sweep, n, 0) - 0.1 * (double)n) <= 1e-15);
    gough_sweep_free(sweep);
    sweep = sweep_of("sweep: {keys: {load.mass: {from: 3, to: 1, steps: 2}}}\n");
    ck_assert(same(value_of(sweep, 1, 0), 3) && same(value_of(sweep, 2, 0), 1));
    gough_sweep_free(sweep);
}
END_TEST

START_TEST(logarithmic_grids_have_equal_ratios_and_clean_decades) {
    gough_sweep *sweep = sweep_of(
        "sweep: {keys: {control.stiffness: {from: 1, to: 1000, steps: 31, scale: log}}}\n");
    ck_assert(same(value_of(sweep, 11, 0), 10) && same(value_of(sweep, 21, 0), 100));
    ck_assert(same(value_of(sweep, 31, 0), 1000));
    for (size_t n = 2; n <= 31; n++)
        ck_assert(fabs(value_of(sweep, n, 0) / value_of(sweep, n - 1, 0) - pow(10, 0.1)) <= 1e-14);
    gough_sweep_free(sweep);
}
END_TEST

/* ends whose ratio or difference is too large for double precision */
START_TEST(wide_grids_do_not_overflow) {
    static const struct {
        const char *ends;
        double first, last;
    } grid[] = {{"{from: 1e-200, to: 1e200, steps: 5, scale: log}", -200, 200},
                {"{from: 1e200, to: 1e-200, steps: 5, scale: log}", 200, -200},
                {"{from: 1e-305, to: 1e305, steps: 62, scale: log}", -305, 305}};
    char text[200];
    for (size_t i = 0; i < sizeof grid / sizeof grid[0]; i++) {
        snprintf(text, sizeof text, "sweep: {keys: {control.stiffness: %s}}\n", grid[i].ends);
        gough_sweep *sweep = sweep_of(text);
        const size_t runs = gough_sweep_runs(sweep);
        for (size_t n = 1; n <= runs; n++) {
            const double part = (double)(n - 1) / (double)(runs - 1);
            const double decade = grid[i].first + (grid[i].last - grid[i].first) * part;
            /* an exponent near 400 has an absolute error of 1e-13 */
            ck_assert(fabs(log10(value_of(sweep, n, 0)) - decade) <= 1e-12);
        }
        gough_sweep_free(sweep);
    }
    gough_sweep *sweep =
        sweep_of("sweep: {keys: {initial.surge: {from: -1.6e308, to: 1.6e308, steps: 5}}}\n");
    for (size_t n = 1; n <= 5; n++)
        ck_assert(fabs(value_of(sweep, n, 0) - 0.8e308 * ((double)n - 3)) <= 1e293);
    gough_sweep_free(sweep);
    sweep = sweep_of("sweep: {runs: 20, keys: {initial.yaw: {uniform: [-1.6e308, 1.6e308]}}}\n");
    for (size_t n = 1; n <= 20; n++) ck_assert(fabs(value_of(sweep, n, 0)) <= 1.6e308);
    gough_sweep_free(sweep);
}
END_TEST

START_TEST(products_change_the_last_key_fastest) {
    gough_sweep *sweep = sweep_of("sweep:\n  keys:\n    load.mass: [1, 2]\n"
                                  "    initial.yaw: {uniform: [0, 1]}\n"
                                  "    control.stiffness: [10, 20, 30]\n");
    ck_assert_uint_eq(gough_sweep_runs(sweep), 6);
    for (size_t run = 1; run <= 6; run++) {
        ck_assert(same(value_of(sweep, run, 0), run <= 3 ? 1 : 2));
        ck_assert(same(value_of(sweep, run, 2), 10.0 * (double)((run - 1) % 3 + 1)));
    }
    gough_sweep_free(sweep);
}
END_TEST

START_TEST(zipped_keys_go_side_by_side) {
    gough_sweep *sweep = sweep_of("sweep:\n  combine: zip\n  keys:\n    load.mass: [1, 2, 5]\n"
                                  "    control.damping: {from: 0, to: 4, steps: 3}\n");
    ck_assert_uint_eq(gough_sweep_runs(sweep), 3);
    ck_assert(gough_sweep_zipped(sweep));
    ck_assert(same(value_of(sweep, 3, 0), 5) && same(value_of(sweep, 2, 1), 2));
    gough_sweep_free(sweep);
    refuse("sweep: {combine: zip, keys: {load.mass: [1, 2], gravity: [1, 2, 3]}}\n",
           "`gravity` has 3 values, but `load.mass` has 2");
}
END_TEST

START_TEST(draws_are_of_seed_run_and_key) {
    gough_sweep *sweep = sweep_of("sweep:\n  seed: 7\n  runs: 9000\n  keys:\n"
                                  "    load.mass: {uniform: [1, 3]}\n"
                                  "    initial.yaw: {normal: [2, 0.5]}\n");
    double sum = 0, squares = 0;
    ck_assert(same(value_of(sweep, 7134, 0), 1 + 2 * gough_random_uniform(7, 7134, 0)));
    ck_assert(same(value_of(sweep, 7134, 1), 2 + 0.5 * gough_random_normal(7, 7134, 1)));
    for (size_t run = 1; run <= 9000; run++) {
        const double yaw = value_of(sweep, run, 1), mass = value_of(sweep, run, 0);
        ck_assert(mass >= 1 && mass < 3);
        sum += yaw;
        squares += (yaw - 2) * (yaw - 2);
    }
    /* four deviations of what 9000 draws leave */
    ck_assert(fabs(sum / 9000 - 2) <= 4 * 0.5 / sqrt(9000));
    ck_assert(fabs(sqrt(squares / 9000) - 0.5) <= 4 * 0.5 / sqrt(18000));
    gough_sweep_free(sweep);
}
END_TEST

START_TEST(values_are_printed_so_that_they_read_back) {
    static const double values[] = {0.1, 1e300, -2.5e-310, 1.0 / 3, 1000, 0.30000000000000004, 0};
    char text[GOUGH_SWEEP_TEXT];
    for (size_t i = 0; i < sizeof values / sizeof values[0]; i++) {
        gough_sweep_print(values[i], text);
        ck_assert(same(strtod(text, NULL), values[i]));
    }
    gough_sweep_print(0.1, text);
    ck_assert_str_eq(text, "0.1");
    use_comma_locale();
    gough_sweep_print(0.5, text);
    use_plain_locale();
    ck_assert_str_eq(text, "0.5");
}
END_TEST

/* a duration that follows from a limit of the machine is found anew in each run, as when the study is read with this limit */
static const char *const limited = "motion: {moves: [{heave: 0.1, speed: 9, duration: least}, "
                                   "{yaw: 3, angular_speed: 900, duration: least}]}\n"
                                   "sweep: {keys: {platform.legs.max_speed: [0.1, 0.2, 0.3]}}\n";

/* All kinds of numbers, in files that give and do not give them. */
static const char *const everything =
    "motion: {moves: [{start: 0, duration: 1, heave: 0.1}], about: [0, 0, 0]}\n"
    "disturbance: {leg_force: [0, 0, t, 0, 0, 0], force: [0, sin(t), 0]}\n"
    "sweep:\n  runs: 40\n  seed: 3\n  keys:\n"
    "    load.mass: {uniform: [0.5, 2]}\n"
    "    load.inertia.2: {uniform: [0.1, 0.12]}\n"
    "    platform.height: {uniform: [0.9, 1.1]}\n"
    "    platform.legs.max_force: {uniform: [5, 6]}\n"
    "    gravity: {uniform: [0.5, 1]}\n"
    "    motion.about.3: {normal: [0, 0.1]}\n"
    "    motion.moves.1.duration: {uniform: [1, 2]}\n"
    "    motion.moves.1.roll: {normal: [0, 1]}\n"
    "    disturbance.leg_force.2: {normal: [0, 0.01]}\n"
    "    disturbance.vertical_force: {normal: [0, 0.01]}\n"
    "    control.stiffness: {normal: [20, 15]}\n"
    "    initial.yaw: {normal: [0, 1]}\n"
    "    simulation.duration: {uniform: [1, 2]}\n";

/* The study of a run read anew with its values as settings. */
static reading read_run(const char *text, const gough_sweep *sweep, size_t run) {
    enum { MOST = 20 };
    static char settings[MOST][120];
    const char *list[MOST + 1] = {NULL};
    double value[MOST];
    size_t keys;
    const gough_sweep_key *key = gough_sweep_keys(sweep, &keys);
    gough_sweep_values(sweep, run, value);
    for (size_t k = 0; k < keys; k++) {
        char number[GOUGH_SWEEP_TEXT];
        gough_sweep_print(value[k], number);
        snprintf(settings[k], sizeof settings[k], "%s=%s", key[k].path, number);
        list[k] = settings[k];
    }
    return read_bytes(text, strlen(text), list);
}

START_TEST(study_of_a_run_is_the_one_read_with_its_settings) {
    char text[4000];
    snprintf(text, sizeof text, "%s%s", good_study, everything);
    gough_sweep *sweep = sweep_of(everything);
    gough_sweep_maker *maker = gough_sweep_maker_new(sweep);
    int invalid = 0;
    ck_assert_ptr_nonnull(maker);
    for (size_t run = 40; run > 0; run--) { /* any order */
        const gough_study *made;
        gough_error error = {.message = ""};
        const gough_status status = gough_sweep_make(maker, run, &made, &error);
        reading whole = read_run(text, sweep, run);
        ck_assert_int_eq(status, whole.status);
        if (status == GOUGH_OK) {
            const gough_model *a = made->model, *b = whole.study->model;
            ck_assert(memcmp(&a->machine, &b->machine, sizeof a->machine) == 0);
            ck_assert(memcmp(&a->control, &b->control, sizeof a->control) == 0);
            ck_assert(memcmp(&a->initial, &b->initial, sizeof a->initial) == 0);
            ck_assert(memcmp(a->motion.move, b->motion.move, sizeof *a->motion.move) == 0);
            ck_assert(memcmp(a->motion.about, b->motion.about, sizeof a->motion.about) == 0);
            ck_assert(same(made->simulation.duration, whole.study->simulation.duration));
            for (int leg = 0; leg < GOUGH_LEGS; leg++) {
                double x[3], y[3];
                gough_formula_evaluate(&a->disturbance.leg_force[leg], 0.7, x);
                gough_formula_evaluate(&b->disturbance.leg_force[leg], 0.7, y);
                ck_assert(memcmp(x, y, sizeof x) == 0);
            }
        } else {
            invalid++; /* a stiffness below 0 */
            ck_assert_ptr_nonnull(strstr(error.message, "`control.stiffness` must be 0 or"));
            ck_assert_ptr_nonnull(strstr(whole.messages, error.message));
        }
        reading_free(&whole);
    }
    ck_assert_int_gt(invalid, 0);
    ck_assert_int_lt(invalid, 15);
    gough_sweep_maker_free(maker);
    gough_sweep_free(sweep);
}
END_TEST

START_TEST(least_durations_follow_swept_limits) {
    char text[4000];
    double before = INFINITY;
    snprintf(text, sizeof text, "%s%s", good_study, limited);
    gough_sweep *sweep = sweep_of(limited);
    gough_sweep_maker *maker = gough_sweep_maker_new(sweep);
    ck_assert_ptr_nonnull(maker);
    ck_assert(gough_sweep_touches(sweep, 0) & GOUGH_PART_MOTION);
    for (size_t run = 1; run <= 3; run++) {
        const gough_study *made;
        ck_assert_int_eq(gough_sweep_make(maker, run, &made, NULL), GOUGH_OK);
        reading whole = read_run(text, sweep, run);
        ck_assert_int_eq(whole.status, GOUGH_OK);
        const gough_move *a = made->model->motion.move, *b = whole.study->model->motion.move;
        for (int i = 0; i < 2; i++) {
            ck_assert(same(a[i].start, b[i].start));
            ck_assert(same(a[i].duration, b[i].duration));
        }
        ck_assert(a[0].duration < before);
        before = a[0].duration;
        reading_free(&whole);
    }
    gough_sweep_maker_free(maker);
    gough_sweep_free(sweep);
}
END_TEST

START_TEST(says_what_is_wrong_with_a_sweep) {
    refuse("sweep: {keys: {control.stifness: [1]}}\n",
           "study.yaml:8:16: error: `control.stifness` is not a key of a study; did you mean "
           "`control.stiffness`?");
    refuse("sweep: {keys: {control.feedforward: [1]}}\n", "is not a number (choice)");
    refuse("sweep: {keys: {load: [1]}}\n", "is not a number (mapping)");
    refuse("sweep: {keys: {sweep.seed: [1]}}\n", "is not a key of a study");
    refuse("sweep: {keys: {load.inertia: [1]}}\n", "vary its elements, numbered from 1");
    refuse("sweep: {keys: {load.inertia.4: [1]}}\n", "is not a key of a study");
    refuse("sweep: {keys: {load.inertia.1.1: [1]}}\n", "no list `load.inertia` with such");
    refuse("sweep: {keys: {control.stiffness.2: [1]}}\n", "no list `control.stiffness` with");
    refuse("sweep: {keys: {motion.moves.1.heave: [1]}}\n", "no list `motion.moves` with");
    refuse("sweep: {keys: {gravity: [1], gravity: [2]}}\n", "duplicate key `gravity`");
    refuse("control: {stiffness: [1, 1, 1, 1, 1, 1]}\n"
           "sweep: {keys: {control.stiffness: [1], control.stiffness.2: [1]}}\n",
           "set the same number");
    refuse("sweep: {keys: {load.mass: []}}\n", "must be a list of numbers");
    refuse("sweep: {keys: {load.mass: 5}}\n", "must be a list of numbers");
    refuse("sweep: {keys: {load.mass: {}}}\n", "must be a grid");
    refuse("sweep: {keys: {load.mass: [1, x]}}\n", "must be a number such as 1.5, found `x`");
    refuse("sweep: {keys: {load.mass: {from: 1, to: 2}}}\n",
           "`sweep.keys.load.mass.steps` is missing");
    refuse("sweep: {keys: {load.mass: {from: 1, to: 2, steps: 1}}}\n", "a whole number from 2");
    refuse("sweep: {keys: {load.mass: {from: 1, to: 2, stepps: 1}}}\n", "did you mean `steps`?");
    refuse("sweep: {keys: {load.mass: {from: 0, to: 2, steps: 3, scale: log}}}\n",
           "its ends must be greater than 0");
    refuse("sweep: {keys: {load.mass: {from: 1, uniform: [1, 2]}}}\n", "both `uniform` and `from`");
    refuse("sweep: {runs: 3, keys: {load.mass: {uniform: [2, 1]}}}\n", "[low, high], the lower");
    refuse("sweep: {runs: 3, keys: {load.mass: {normal: [2, -1]}}}\n", "the deviation 0 or");
    refuse("sweep: {keys: {load.mass: {normal: [2, 1]}}}\n", "`sweep.runs` is missing");
    refuse("sweep: {runs: 3, keys: {load.mass: [1, 2]}}\n",
           "only for sweeps of distributions; remove it");
    refuse("sweep: {keys: {load.mass: {from: 1, to: 2, steps: 100000}, gravity: {from: 1, to: 2, "
           "steps: 100000}}}\n",
           "the sweep has 1e+10 runs; at most 1e8");
    refuse("sweep: {keys: {}}\n", "`sweep.keys` must be a mapping such as");
    refuse("sweep: {seed: 1}\n", "`sweep.keys` is missing");
}
END_TEST

START_TEST(a_key_that_goes_not_with_the_file_is_an_error) {
    static const char text[] = "motion: {moves: [{start: 0, duration: 1, heave: 0.1}]}\n"
                               "sweep: {keys: {motion.roll: [1]}}\n";
    char study[2000], *messages = NULL;
    gough_sweep *sweep = NULL;
    snprintf(study, sizeof study, "%s%s", good_study, text);
    ck_assert_int_eq(
        gough_sweep_parse("study.yaml", study, strlen(study), NULL, 0, &sweep, &messages),
        GOUGH_ERROR_INPUT);
    ck_assert_ptr_nonnull(strstr(messages, "`motion` has both `roll` and `moves`"));
    gough_study_free_messages(messages);
    ck_assert_int_eq(
        gough_sweep_parse("study.yaml", good_study, strlen(good_study), NULL, 0, &sweep, &messages),
        GOUGH_ERROR_INPUT);
    ck_assert_ptr_nonnull(strstr(messages, "no section `sweep`"));
    gough_study_free_messages(messages);
}
END_TEST

START_TEST(settings_change_a_sweep) {
    static const gough_setting settings[] = {{"sweep.keys.control.stiffness", "[1, 2, 3]"},
                                             {"sweep.keys.load.mass.to", "5"},
                                             {"sweep.keys.gravity", ""}};
    char text[2000], *messages = NULL;
    gough_sweep *sweep = NULL;
    size_t keys;
    snprintf(text, sizeof text,
             "%ssweep: {keys: {gravity: [1, 2], load.mass: {from: 1, to: 2, steps: 5}}}\n",
             good_study);
    ck_assert_int_eq(
        gough_sweep_parse("study.yaml", text, strlen(text), settings, 3, &sweep, &messages),
        GOUGH_OK);
    ck_assert_uint_eq(gough_sweep_runs(sweep), 15);
    const gough_sweep_key *key = gough_sweep_keys(sweep, &keys);
    ck_assert_uint_eq(keys, 2);
    ck_assert_str_eq(key[0].path, "load.mass");
    ck_assert(same(value_of(sweep, 15, 0), 5));
    ck_assert_str_eq(key[1].path, "control.stiffness");
    gough_sweep_free(sweep);
}
END_TEST

START_TEST(a_sweep_says_what_it_is_made_of) {
    static const gough_setting settings[] = {{"load.mass", "3"}, {"sweep.seed", "77"}};
    char text[2000], *messages = NULL;
    gough_sweep *sweep = NULL;
    size_t count = 0;
    snprintf(text, sizeof text,
             "%ssweep: {keys: {control.stiffness: [1, 2], platform.height: [1.1, 1.3], "
             "disturbance.vertical_force: {uniform: [0, 1]}, simulation.duration: [1, 2]}}\n",
             good_study);
    ck_assert_msg(gough_sweep_parse("study.yaml", text, strlen(text), settings, 2, &sweep,
                                    &messages) == GOUGH_OK,
                  "%s", messages);
    /* the study as written, with the settings */
    const gough_study *study = gough_sweep_study(sweep);
    ck_assert(same(study->model->machine.load.mass, 3));
    ck_assert(study->swept);
    const gough_setting *given = gough_sweep_settings(sweep, &count);
    ck_assert_uint_eq(count, 2);
    ck_assert_str_eq(given[1].key, "sweep.seed");
    ck_assert_str_eq(given[1].value, "77");
    ck_assert_uint_eq(gough_sweep_seed(sweep), 77);

    static const unsigned touched[] = {GOUGH_SWEEP_CONTROL,
                                       GOUGH_SWEEP_MACHINE | GOUGH_SWEEP_HEIGHT,
                                       GOUGH_SWEEP_DISTURBANCE, GOUGH_SWEEP_SIMULATION};
    unsigned all = 0;
    gough_sweep_keys(sweep, &count);
    ck_assert_uint_eq(count, 4);
    for (size_t key = 0; key < 4; key++) {
        ck_assert_uint_eq(gough_sweep_touches(sweep, key), touched[key]);
        all |= touched[key];
    }
    ck_assert_uint_eq(gough_sweep_touches(sweep, 4), all);
    ck_assert_uint_eq(gough_sweep_touches(sweep, 99), all);
    gough_sweep_free(sweep);
}
END_TEST

START_TEST(noise_is_of_the_run_unless_the_study_names_one) {
    reading one = expect_good("disturbance: {noise: {leg_force: 0.1, interval: 0.5}}\n", NULL);
    reading named =
        expect_good("disturbance: {noise: {leg_force: 0.1, interval: 0.5, run: 0}}\n", NULL);
    ck_assert_uint_eq(gough_sweep_noise_run(one.study, 5), 5);
    ck_assert_uint_eq(gough_sweep_sampling_run(one.study, 5), 5);
    ck_assert_uint_eq(gough_sweep_noise_run(named.study, 5), 0);
    reading_free(&one);
    reading_free(&named);
}
END_TEST

/* ---- running it --------------------------------------------------------------------------------------------------- */

typedef struct rows {
    size_t count, stop_after;
    gough_outcome outcome[64];
} rows;

static int keep(void *context, const gough_sweep_row *row) {
    rows *r = context;
    ck_assert_uint_eq(row->run, r->count + 1);
    r->outcome[r->count++] = row->outcome;
    return r->count == r->stop_after;
}

START_TEST(rows_come_in_order_and_can_be_stopped) {
    gough_sweep *sweep =
        sweep_of("simulation: {duration: 1, method: rk4, step: 0.05}\n"
                 "sweep: {keys: {control.stiffness: {from: 1, to: 50, steps: 50}}}\n");
    gough_sweep_options options = gough_sweep_options_default();
    gough_error error = {.message = ""};
    rows one = {.count = 0}, three = {.count = 0}, stopped = {.stop_after = 20};
    options.threads = options.lanes = 1;
    ck_assert_int_eq(gough_sweep_run(sweep, &options, keep, &one, &error), GOUGH_OK);
    ck_assert_uint_eq(one.count, 50);
    options.threads = 3;
    options.lanes = 2;
    ck_assert_int_eq(gough_sweep_run(sweep, &options, keep, &three, &error), GOUGH_OK);
    ck_assert(memcmp(one.outcome, three.outcome, 50 * sizeof one.outcome[0]) == 0);
    ck_assert_int_eq(gough_sweep_run(sweep, &options, keep, &stopped, &error),
                     GOUGH_ERROR_NUMERICAL);
    ck_assert_uint_eq(stopped.count, 20);
    options.last = 51;
    ck_assert_int_eq(gough_sweep_run(sweep, &options, keep, &stopped, &error), GOUGH_ERROR_INPUT);
    gough_sweep_free(sweep);
}
END_TEST

int main(void) {
    make_comma_locale();
    const int status = SUITE_RUN(
        "study/sweep", 60, grids_have_their_ends_exactly,
        logarithmic_grids_have_equal_ratios_and_clean_decades, wide_grids_do_not_overflow,
        products_change_the_last_key_fastest, zipped_keys_go_side_by_side,
        draws_are_of_seed_run_and_key, values_are_printed_so_that_they_read_back,
        study_of_a_run_is_the_one_read_with_its_settings, least_durations_follow_swept_limits,
        says_what_is_wrong_with_a_sweep, a_key_that_goes_not_with_the_file_is_an_error,
        settings_change_a_sweep, a_sweep_says_what_it_is_made_of,
        noise_is_of_the_run_unless_the_study_names_one, rows_come_in_order_and_can_be_stopped);
    forget_comma_locale();
    return status;
}
