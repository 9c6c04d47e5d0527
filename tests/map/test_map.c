/* The stability map: its points against multipliers found one by one, lanes, threads, and what it refuses.
 * Label: standard.
 * Not sanitized: the same functions run under sanitizers in the tests of the command. */
#include "gough/batch.h"
#include "map/sample.h"
#include "maps.h"
#include "support/machines.h"
#include "support/suite.h"

/* ---- points ---- */

static void same_as_alone(gough_model *model, const atlas *a) {
    for (size_t i = 0; i < a->points; i++) {
        const double G = gough_map_value(&a->options.stiffness, i);
        const gough_map_point *p = &a->map.point[i];
        gough_floquet floquet;
        gough_error error = {0};
        for (int v = 0; v < GOUGH_LEGS; v++) model->control.stiffness[v] = G;
        ck_assert_msg(gough_floquet_multipliers(model, NULL, 0, &floquet, &error) == GOUGH_OK, "%s",
                      error.message);
        ck_assert_msg(fabs(p->growth - floquet.growth) <= 1e-8 * floquet.growth,
                      "G = %g: growth %.12g, alone %.12g", G, p->growth, floquet.growth);
        ck_assert(fabs(p->rate - log(floquet.growth) / floquet.period) <= 1e-8);
        ck_assert(p->stable == floquet.stable);
        if (!p->stable) ck_assert_str_eq(p->mode, floquet.multiplier[0].mode.name);
    }
}

START_TEST(points_are_the_multipliers_found_one_by_one) {
    for (int damped = 0; damped < 2; damped++) {
        for (int machine = 0; machine < 3; machine++) {
            gough_model *model =
                machine ? map_tumbling() : map_heaving("0.2*sin(t)*(1 - exp(-t/2))^2");
            const gough_map_options o = map_over(0, 3.1, 6);
            dice d = {29};
            atlas a;
            if (machine == 2)
                give_legs(&model->machine, LEGS_HEAVY | (damped ? LEGS_VISCOUS : 0), &d);
            set_gains(model, 0, damped ? 0.07 : 0);
            map_find_all(&a, model, &o);
            same_as_alone(model, &a);
            map_drop(&a);
            free(model);
        }
    }
}
END_TEST

START_TEST(points_are_good_for_stiff_and_for_viscous_legs_too) {
    for (int viscous = 0; viscous < 2; viscous++) {
        gough_model *model = map_heaving("0.2*sin(t)");
        const gough_map_options o = map_over(0, viscous ? 2 : 60, 3);
        atlas a;
        set_gains(model, 0, viscous ? 20 : 0);
        map_find_all(&a, model, &o);
        same_as_alone(model, &a);
        map_drop(&a);
        free(model);
    }
}
END_TEST

START_TEST(same_bits_in_all_lanes_and_threads) {
    gough_model *model = map_tumbling();
    gough_map_options o = map_over(0, 2, 11);
    atlas first;

    o.axis = GOUGH_MAP_DAMPING;
    o.second = (gough_map_range){0, 0.1, 3, false};
    o.lanes = o.threads = 1;
    map_find_all(&first, model, &o);
    for (o.lanes = 2; o.lanes <= gough_batch_lanes(); o.lanes *= 2) {
        atlas other;
        o.threads = o.lanes == 4 ? 3 : 2;
        map_find_all(&other, model, &o);
        for (size_t i = 0; i < first.points; i++) {
            const gough_map_point *p = &first.map.point[i], *q = &other.map.point[i];
            ck_assert(memcmp(&p->growth, &q->growth, sizeof p->growth) == 0);
            ck_assert(memcmp(&p->rate, &q->rate, sizeof p->rate) == 0);
            ck_assert(strcmp(p->mode, q->mode) == 0 && p->stable == q->stable);
        }
        for (size_t r = 0; r < first.rows; r++) {
            ck_assert(first.map.row[r].intervals == other.map.row[r].intervals);
            for (size_t i = 0; i < first.map.row[r].intervals; i++) {
                const gough_interval *p = map_interval(&first, r, i),
                                     *q = map_interval(&other, r, i);
                ck_assert(memcmp(&p->from, &q->from, sizeof p->from) == 0);
                ck_assert(memcmp(&p->to, &q->to, sizeof p->to) == 0);
                ck_assert(memcmp(&p->growth, &q->growth, sizeof p->growth) == 0);
            }
        }
        map_drop(&other);
    }
    map_drop(&first);
    free(model);
}
END_TEST

START_TEST(twice_the_frequency_is_the_faster_program) {
    gough_model *model = map_heaving("0.1*sin(t)"), *faster = map_heaving("0.1*sin(2*t)");
    gough_map_options o = map_over(0, 2, 7);
    const gough_map_options alone = o;
    atlas a, b;

    o.axis = GOUGH_MAP_FREQUENCY;
    o.second = (gough_map_range){1, 2, 2, true};
    map_find_all(&a, model, &o);
    map_find_all(&b, faster, &alone);
    ck_assert(fabs(a.map.row[1].period.period - pi) <= 1e-12);
    for (size_t i = 0; i < b.points; i++)
        ck_assert(fabs(a.map.point[7 + i].rate - b.map.point[i].rate) <= 1e-10);
    map_drop(&a);
    map_drop(&b);
    free(model);
    free(faster);
}
END_TEST

START_TEST(without_feedforward_points_are_those_of_the_motion_found) {
    gough_model *model = map_heaving("0.05*sin(t)");
    const gough_map_options o = map_over(2, 4, 3);
    atlas a;

    model->control.feedforward = false;
    map_find_all(&a, model, &o);
    same_as_alone(model, &a);
    map_drop(&a);
    free(model);
}
END_TEST

/* the motion of a controller that ignores the legs depends on the stiffness too; so does its pose at rest */
START_TEST(points_are_those_of_a_controller_that_ignores_the_legs) {
    for (int resting = 0; resting < 2; resting++) {
        gough_model *model = map_heaving(resting ? "0" : "0.05*sin(t)");
        const gough_map_options o = map_over(4, 8, 3);
        dice d = {29};
        atlas a;

        give_legs(&model->machine, LEGS_HEAVY, &d);
        model->control.ignores_legs = true;
        map_find_all(&a, model, &o);
        ck_assert_msg(a.map.row[0].error.status == GOUGH_OK, "%s", a.map.row[0].error.message);
        if (!resting) same_as_alone(model, &a);
        for (size_t i = 0; i < a.points && resting; i++) {
            gough_rest rest;
            set_gains(model, gough_map_value(&o.stiffness, i), 0);
            ck_assert(gough_stability_at_rest(model, NULL, &rest, NULL) == GOUGH_OK);
            ck_assert(fabs(a.map.point[i].rate - rest.growth) <= 1e-12);
        }
        map_drop(&a);
        free(model);
    }
}
END_TEST

/* ---- what it rests on ---- */

/* (floquet-22): Φᵀ Ω Φ = Ω over a period of all six axes, elements of Ω up to 1.3 */
static void check_form(int legs) {
    gough_model *model = map_tumbling();
    dice d = {31};
    gough_acceleration acceleration;
    gough_floquet f;
    gough_state state;
    symplectic form;
    double complex column[GOUGH_LINEAR][GOUGH_LINEAR], unit[GOUGH_LINEAR][GOUGH_LINEAR];

    if (legs) give_legs(&model->machine, legs, &d);
    set_gains(model, 3, 0);
    ck_assert(gough_floquet_multipliers(model, NULL, 0, &f, NULL) == GOUGH_OK);
    gough_program(&model->machine, &model->motion, f.start, &state, &acceleration);
    symplectic_at(&model->machine, &state, &form);
    for (int i = 0; i < GOUGH_LINEAR; i++) {
        for (int j = 0; j < GOUGH_LINEAR; j++) {
            column[i][j] = f.monodromy[j][i];
            unit[i][j] = i == j;
        }
    }
    for (int i = 0; i < GOUGH_LINEAR; i++) {
        for (int j = 0; j < GOUGH_LINEAR; j++) {
            const double complex after = symplectic_product(&form, column[i], column[j]);
            const double complex before = symplectic_product(&form, unit[i], unit[j]);
            ck_assert_msg(cabs(after - before) <= 1e-9, "%d %d: %g", i, j, cabs(after - before));
        }
    }
    free(model);
}

START_TEST(undamped_motion_keeps_its_symplectic_form) {
    check_form(0);
    check_form(LEGS_HEAVY);
}
END_TEST

/* ---- ends ---- */

static int stop_half_way(void *context, double done) {
    double *last = context;

    ck_assert(done >= *last && done <= 1);
    *last = done;
    return done > 0.5;
}

START_TEST(progress_stops_it) {
    gough_model *model = map_heaving("0.2*sin(t)");
    gough_map_options o = map_over(0, 2, 5);
    double last = 0;
    atlas a;

    o.axis = GOUGH_MAP_AMPLITUDE;
    o.second = (gough_map_range){0.1, 1, 8, false};
    o.progress = stop_half_way;
    o.context = &last;
    o.threads = 1;
    map_find(&a, model, &o);
    ck_assert_int_eq(a.status, GOUGH_ERROR_NUMERICAL);
    ck_assert_msg(strstr(a.error.message, "stopped") != NULL, "%s", a.error.message);
    ck_assert(last > 0.5 && last < 0.8);
    ck_assert(a.map.row[0].error.status == GOUGH_OK);
    ck_assert(a.map.row[7].error.status == GOUGH_ERROR_NUMERICAL && isnan(a.map.point[39].rate));
    map_drop(&a);
    free(model);
}
END_TEST

/* heave from 1 down to 0: all legs in one plane */
START_TEST(rows_without_values_say_why) {
    gough_model *model = map_heaving("0.2*sin(t)");
    gough_map_options o = map_over(0, 2, 3);
    atlas a;

    o.axis = GOUGH_MAP_AMPLITUDE;
    o.second = (gough_map_range){1, 5, 2, false};
    map_find(&a, model, &o);
    ck_assert_msg(a.status == GOUGH_OK, "%s", a.error.message);
    ck_assert(a.map.row[0].error.status == GOUGH_OK && a.map.row[0].intervals > 0);
    ck_assert(a.map.row[1].error.status == GOUGH_ERROR_NUMERICAL);
    ck_assert_msg(strstr(a.map.row[1].error.message, "singular") != NULL, "%s",
                  a.map.row[1].error.message);
    ck_assert(isnan(a.map.point[3].rate) && !a.map.point[3].stable);
    map_drop(&a);

    /* through it and back between the looks at the condition */
    set_formula(&model->motion.formula[GOUGH_HEAVE], "1.01*sin(t + 0.2)");
    o = map_over(0, 2, 3);
    map_find(&a, model, &o);
    ck_assert(a.status == GOUGH_OK && a.map.row[0].error.status == GOUGH_ERROR_NUMERICAL);
    ck_assert_msg(strstr(a.map.row[0].error.message, "singular") != NULL, "%s",
                  a.map.row[0].error.message);
    map_drop(&a);

    set_formula(&model->motion.formula[GOUGH_YAW], "0.1*t");
    o = map_over(0, 2, 3);
    map_find(&a, model, &o);
    ck_assert(a.status == GOUGH_OK && a.map.row[0].error.status == GOUGH_ERROR_INPUT);
    map_drop(&a);
    free(model);
}
END_TEST

START_TEST(refuses_axes_without_values) {
    gough_model *model = map_heaving("0.2*sin(t)");
    gough_map_options o[8];
    static const char *const word[8] = {"stiffness", "stiffness", "stiffness", "frequency",
                                        "damping",   "lanes",     "above 0",   "too large"};

    for (int i = 0; i < 8; i++) o[i] = map_over(0, 2, 3);
    o[0].stiffness.count = 0;
    o[1].stiffness.from = NAN;
    o[2].stiffness.to = -1;
    o[3].axis = GOUGH_MAP_FREQUENCY;
    o[3].second = (gough_map_range){0, 1, 2, false};
    o[4].axis = GOUGH_MAP_DAMPING;
    o[4].second = (gough_map_range){0, 1, 2, true};
    o[5].lanes = 3;
    o[6].stiffness = (gough_map_range){0, 0, 1, false};
    o[7].axis = GOUGH_MAP_DAMPING;
    o[7].second = (gough_map_range){0, 1, (size_t)1 << 31, false};
    for (int i = 0; i < 8; i++) {
        gough_error error = {0};
        size_t bytes;
        ck_assert_int_eq(gough_map_size(model, &o[i], &bytes, &error), GOUGH_ERROR_INPUT);
        ck_assert_msg(strstr(error.message, word[i]) != NULL, "%d: %s", i, error.message);
    }
    free(model);
}
END_TEST

START_TEST(values_of_an_axis_meet_its_ends) {
    const gough_map_range line = {0.1, 0.7, 4, false}, ratio = {0.1, 100, 4, true};

    ck_assert(fabs(gough_map_value(&line, 1) - 0.3) <= 1e-15);
    ck_assert(fabs(gough_map_value(&ratio, 1) - 1) <= 1e-15);
    ck_assert(!(gough_map_value(&line, 3) < 0.7) && !(gough_map_value(&line, 3) > 0.7));
    ck_assert(!(gough_map_value(&ratio, 3) < 100) && !(gough_map_value(&ratio, 3) > 100));
}
END_TEST

int main(void) {
    return SUITE_RUN("map", 120, points_are_the_multipliers_found_one_by_one,
                     points_are_good_for_stiff_and_for_viscous_legs_too,
                     same_bits_in_all_lanes_and_threads, twice_the_frequency_is_the_faster_program,
                     without_feedforward_points_are_those_of_the_motion_found,
                     points_are_those_of_a_controller_that_ignores_the_legs,
                     undamped_motion_keeps_its_symplectic_form, progress_stops_it,
                     rows_without_values_say_why, refuses_axes_without_values,
                     values_of_an_axis_meet_its_ends);
}
