/* The stability map: its points against multipliers found one by one, its intervals against Hill's equation and against fine grids,
 * and what it refuses. */
#include <stdio.h>

#include "analyse/sample.h"
#include "gough/batch.h"
#include "gough/map.h"
#include "support/machines.h"
#include "support/suite.h"

/* ---- maps to ask ---- */

typedef struct {
    gough_map_options options;
    gough_map map;
    size_t rows, points;
    gough_status status;
    gough_error error;
} atlas;

static gough_map_options over(double from, double to, size_t count) {
    gough_map_options o = gough_map_options_default();

    o.stiffness = (gough_map_range){from, to, count, false};
    return o;
}

static void find(atlas *a, const gough_model *model, const gough_map_options *options) {
    size_t bytes;
    void *memory;

    memset(a, 0, sizeof *a);
    a->options = *options;
    a->status = gough_map_size(model, options, &bytes, &a->error);
    if (a->status != GOUGH_OK) return;
    a->rows = gough_map_rows(options);
    a->points = a->rows * options->stiffness.count;
    a->map.point = calloc(a->points, sizeof *a->map.point);
    a->map.row = calloc(a->rows, sizeof *a->map.row);
    a->map.interval = calloc(a->rows * options->intervals, sizeof *a->map.interval);
    memory = aligned_alloc(64, (bytes + 63) / 64 * 64);
    ck_assert(a->map.point && a->map.row && a->map.interval && memory);
    a->status = gough_map_find(model, options, &a->map, memory, &a->error);
    free(memory);
}

static void find_all(atlas *a, const gough_model *model, const gough_map_options *options) {
    find(a, model, options);
    ck_assert_msg(a->status == GOUGH_OK, "%s", a->error.message);
    for (size_t r = 0; r < a->rows; r++)
        ck_assert_msg(a->map.row[r].error.status == GOUGH_OK, "row %zu: %s", r,
                      a->map.row[r].error.message);
}

static void drop(atlas *a) {
    free(a->map.point);
    free(a->map.row);
    free(a->map.interval);
}

static const gough_interval *interval(const atlas *a, size_t row, size_t i) {
    return &a->map.interval[row * a->options.intervals + i];
}

/* ---- studies ---- */

static gough_model *new_model(void) {
    gough_model *model = calloc(1, sizeof *model);

    ck_assert(model != NULL);
    model->control.feedforward = true;
    return model;
}

/* the paper's machine, heaving */
static gough_model *heaving(const char *heave) {
    gough_model *model = new_model();

    paper_machine(&model->machine);
    set_formula(&model->motion.formula[GOUGH_HEAVE], heave);
    return model;
}

/* a machine without symmetry, turning about all axes */
static gough_model *tumbling(void) {
    gough_model *model = new_model();

    skew_machine(&model->machine);
    set_formula(&model->motion.formula[GOUGH_SURGE], "0.1*cos(2*t)");
    set_formula(&model->motion.formula[GOUGH_HEAVE], "0.1*sin(t)");
    set_formula(&model->motion.formula[GOUGH_ROLL], "0.15*cos(t)");
    set_formula(&model->motion.formula[GOUGH_YAW], "0.2*sin(t + 1)");
    return model;
}

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
        for (int machine = 0; machine < 2; machine++) {
            gough_model *model = machine ? tumbling() : heaving("0.2*sin(t)*(1 - exp(-t/2))^2");
            const gough_map_options o = over(0, 3.1, 6);
            atlas a;
            set_gains(model, 0, damped ? 0.07 : 0);
            find_all(&a, model, &o);
            same_as_alone(model, &a);
            drop(&a);
            free(model);
        }
    }
}
END_TEST

START_TEST(points_are_good_for_stiff_legs_too) {
    gough_model *model = heaving("0.2*sin(t)");
    const gough_map_options o = over(0, 60, 3);
    atlas a;

    find_all(&a, model, &o);
    same_as_alone(model, &a);
    drop(&a);
    free(model);
}
END_TEST

START_TEST(same_bits_in_all_lanes_and_threads) {
    gough_model *model = tumbling();
    gough_map_options o = over(0, 2, 11);
    atlas first;

    o.axis = GOUGH_MAP_DAMPING;
    o.second = (gough_map_range){0, 0.1, 3, false};
    o.lanes = o.threads = 1;
    find_all(&first, model, &o);
    for (o.lanes = 2; o.lanes <= gough_batch_lanes(); o.lanes *= 2) {
        atlas other;
        o.threads = o.lanes == 4 ? 3 : 2;
        find_all(&other, model, &o);
        for (size_t i = 0; i < first.points; i++) {
            const gough_map_point *p = &first.map.point[i], *q = &other.map.point[i];
            ck_assert(memcmp(&p->growth, &q->growth, sizeof p->growth) == 0);
            ck_assert(memcmp(&p->rate, &q->rate, sizeof p->rate) == 0);
            ck_assert(strcmp(p->mode, q->mode) == 0 && p->stable == q->stable);
        }
        for (size_t r = 0; r < first.rows; r++) {
            ck_assert(first.map.row[r].intervals == other.map.row[r].intervals);
            for (size_t i = 0; i < first.map.row[r].intervals; i++) {
                const gough_interval *p = interval(&first, r, i), *q = interval(&other, r, i);
                ck_assert(memcmp(&p->from, &q->from, sizeof p->from) == 0);
                ck_assert(memcmp(&p->to, &q->to, sizeof p->to) == 0);
                ck_assert(memcmp(&p->growth, &q->growth, sizeof p->growth) == 0);
            }
        }
        drop(&other);
    }
    drop(&first);
    free(model);
}
END_TEST

/* ---- intervals ---- */

/* trace of the monodromy matrix of (stab-12), by the classical Runge-Kutta method; heave 0.2 sin t */
static double hill_trace(double G) {
    enum { STEPS = 1500 };
    const double h = 2 * pi / STEPS, d2 = 0.49;
    double y[2][2] = {{1, 0}, {0, 1}};

    for (int k = 0; k < STEPS; k++) {
        double f[3];
        for (int i = 0; i < 3; i++) {
            const double s = 0.2 * sin((k + 0.5 * i) * h), z = 1 + s, l2 = z * z + d2;
            f[i] = (1 - s) * d2 / (z * l2) - 6 * G * z * z / l2;
        }
        for (int c = 0; c < 2; c++) {
            const double x = y[c][0], v = y[c][1];
            const double a1 = f[0] * x, x2 = x + h / 2 * v, v2 = v + h / 2 * a1;
            const double a2 = f[1] * x2, x3 = x + h / 2 * v2, v3 = v + h / 2 * a2;
            const double a3 = f[1] * x3, x4 = x + h * v3, v4 = v + h * a3, a4 = f[2] * x4;
            y[c][0] = x + h / 6 * (v + 2 * v2 + 2 * v3 + v4);
            y[c][1] = v + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
        }
    }
    return y[0][0] + y[1][1];
}

static double hill_edge(double inside, double outside) {
    for (int i = 0; i < 40; i++) {
        const double middle = 0.5 * (inside + outside);
        *(fabs(hill_trace(middle)) > 2 ? &inside : &outside) = middle;
    }
    return outside;
}

/* a grid of 5000 points, on which the narrowest tongue below G = 2, 5.3e-4 wide, cannot be missed */
START_TEST(intervals_of_heave_are_those_of_hills_equation) {
    enum { FINE = 5000 };
    gough_model *model = heaving("0.2*sin(t)*(1 - exp(-t/2))^2");
    const gough_map_options o = over(0, 2, 5);
    double expected[12][2];
    int count = 0, seen = 0;
    bool inside = true;
    atlas a;

    expected[0][0] = 0;
    for (int i = 1; i <= FINE; i++) {
        const double G = 2.0 * i / FINE, before = 2.0 * (i - 1) / FINE;
        const bool now = fabs(hill_trace(G)) > 2;
        if (now && !inside) expected[count][0] = hill_edge(G, before);
        if (!now && inside) expected[count++][1] = hill_edge(before, G);
        inside = now;
    }
    ck_assert_int_eq(count, 6);

    find_all(&a, model, &o);
    for (size_t i = 0; i < a.map.row[0].intervals; i++) {
        const gough_interval *v = interval(&a, 0, i);
        if (strcmp(v->mode.name, "heave") != 0) continue;
        ck_assert(seen < count);
        ck_assert_msg(fabs(v->from - expected[seen][0]) <= 1e-8, "from %.12g, not %.12g", v->from,
                      expected[seen][0]);
        ck_assert_msg(fabs(v->to - expected[seen][1]) <= 1e-8, "to %.12g, not %.12g", v->to,
                      expected[seen][1]);
        ck_assert(v->kind == (seen == 0       ? GOUGH_INTERVAL_STATIC
                              : seen % 2 == 1 ? GOUGH_INTERVAL_MINUS
                                              : GOUGH_INTERVAL_PLUS));
        ck_assert(v->modes == 1 && !v->cut);
        ck_assert(fabs(2 * cosh(log(v->growth)) - fabs(hill_trace(v->stiffness))) <= 1e-7);
        seen++;
    }
    ck_assert_int_eq(seen, count);
    ck_assert(fabs(expected[1][0] - 0.11616) <= 5e-6 && fabs(expected[1][1] - 0.19283) <= 5e-6);
    ck_assert(fabs(expected[2][0] - 0.33333) <= 5e-6 && fabs(expected[2][1] - 0.36773) <= 5e-6);
    drop(&a);
    free(model);
}
END_TEST

/* whether some interval holds a stiffness; 0 near an edge, where a point may be on either side */
static int held(const atlas *a, size_t row, double G, double margin) {
    int inside = -1;

    for (size_t i = 0; i < a->map.row[row].intervals; i++) {
        const gough_interval *v = interval(a, row, i);
        if (fabs(G - v->from) <= margin || fabs(G - v->to) <= margin) return 0;
        if (G > v->from && G < v->to) inside = 1;
    }
    return inside;
}

static void points_agree_with_intervals(const atlas *a) {
    const size_t count = a->options.stiffness.count;

    for (size_t i = 0; i < a->points; i++) {
        const double G = gough_map_value(&a->options.stiffness, i % count);
        const int inside = held(a, i / count, G, 1e-8);
        if (inside == 0) continue;
        ck_assert_msg((inside > 0) == !a->map.point[i].stable,
                      "row %zu, G = %.9g: growth %.12g, %s an interval", i / count, G,
                      a->map.point[i].growth, inside > 0 ? "in" : "not in");
    }
}

START_TEST(no_point_of_a_fine_grid_contradicts_the_intervals) {
    for (int machine = 0; machine < 2; machine++) {
        gough_model *model = machine ? tumbling() : heaving("0.2*sin(t)");
        const gough_map_options o = over(0, 4, 4001);
        atlas a;
        find_all(&a, model, &o);
        points_agree_with_intervals(&a);
        ck_assert(a.map.row[0].intervals > 20);
        ck_assert(a.map.row[0].intervals_missed == 0);
        drop(&a);
        free(model);
    }
}
END_TEST

START_TEST(no_damped_point_contradicts_the_intervals) {
    gough_model *model = tumbling();
    gough_map_options o = over(0, 4, 801);
    atlas a;

    o.axis = GOUGH_MAP_DAMPING;
    o.second = (gough_map_range){0.001, 0.02, 3, false};
    find_all(&a, model, &o);
    points_agree_with_intervals(&a);
    ck_assert(a.map.row[0].intervals > a.map.row[2].intervals);
    drop(&a);
    free(model);
}
END_TEST

/* the same intervals whatever the grid, none of its points in the narrow ones */
START_TEST(narrow_intervals_are_found_on_a_grid_of_five_points) {
    gough_model *model = heaving("0.2*sin(t)");
    const gough_map_options coarse = over(0, 2, 5), fine = over(0, 2, 333);
    int narrow = 0;
    atlas a, b;

    find_all(&a, model, &coarse);
    find_all(&b, model, &fine);
    ck_assert(a.map.row[0].intervals == b.map.row[0].intervals);
    for (size_t i = 0; i < a.map.row[0].intervals; i++) {
        const gough_interval *v = interval(&a, 0, i), *w = interval(&b, 0, i);
        ck_assert(fabs(v->from - w->from) <= 1e-9 && fabs(v->to - w->to) <= 1e-9);
        ck_assert(v->kind == w->kind && strcmp(v->mode.name, w->mode.name) == 0);
        narrow += v->to - v->from < 0.002;
    }
    ck_assert_msg(narrow >= 8, "%d", narrow);
    drop(&a);
    drop(&b);
    free(model);
}
END_TEST

/* a range that begins inside: edges beyond it are found, and the end of the range is told from an edge */
START_TEST(edges_outside_the_range_are_told) {
    gough_model *model = heaving("0.2*sin(t)");
    const gough_map_options o = over(0.15, 0.35, 3);
    int whole = 0, cut = 0;
    atlas a;

    find_all(&a, model, &o);
    for (size_t i = 0; i < a.map.row[0].intervals; i++) {
        const gough_interval *v = interval(&a, 0, i);
        ck_assert(v->to >= 0.15 && v->from <= 0.35);
        ck_assert(v->stiffness >= 0.15 && v->stiffness <= 0.35);
        if (strcmp(v->mode.name, "heave") != 0) continue;
        whole += fabs(v->from - 0.11616) <= 5e-6 && fabs(v->to - 0.19283) <= 5e-6 && !v->cut;
        cut += fabs(v->from - 0.33333) <= 5e-6 && fabs(v->to - 0.35) <= 1e-12 && v->cut;
    }
    ck_assert(whole == 1 && cut == 1);
    drop(&a);
    free(model);
}
END_TEST

START_TEST(without_motion_there_are_thresholds_and_nothing_else) {
    gough_model *model = heaving("0.2*sin(t)");
    gough_map_options o = over(0, 2, 9);
    gough_rest rest;
    atlas a;

    ck_assert(gough_stability_at_rest(model, NULL, &rest, NULL) == GOUGH_OK);
    o.axis = GOUGH_MAP_AMPLITUDE;
    o.second = (gough_map_range){0, 1e-9, 2, false};
    find_all(&a, model, &o);
    ck_assert(a.map.row[0].period.resting && !a.map.row[1].period.resting);
    ck_assert(isnan(a.map.point[0].growth) && a.map.point[0].rate > 0);
    for (size_t r = 0; r < 2; r++) {
        int modes = 0;
        for (size_t i = 0; i < a.map.row[r].intervals; i++) {
            const gough_interval *v = interval(&a, r, i);
            double nearest = INFINITY;
            ck_assert_msg(v->kind == GOUGH_INTERVAL_STATIC, "%s at %.9g",
                          gough_interval_kind_name(v->kind), v->from);
            for (int k = 0; k < 6; k++)
                nearest = fmin(nearest, fabs(rest.threshold[k].stiffness - v->to));
            ck_assert_msg(nearest <= 1e-8, "%.12g is %g off", v->to, nearest);
            modes += v->modes;
        }
        ck_assert_int_eq(modes, 6);
    }
    ck_assert(a.map.row[1].meetings > 20); /* tongues that have closed */
    drop(&a);
    free(model);
}
END_TEST

START_TEST(damping_closes_tongues) {
    gough_model *model = heaving("0.2*sin(t)");
    gough_map_options o = over(0, 2, 5);
    double width = INFINITY;
    atlas a;

    o.axis = GOUGH_MAP_DAMPING;
    o.second = (gough_map_range){0, 0.1, 5, false};
    find_all(&a, model, &o);
    for (size_t r = 0; r < a.rows; r++) {
        double sum = 0;
        for (size_t i = 0; i < a.map.row[r].intervals; i++) {
            const gough_interval *v = interval(&a, r, i);
            if (v->kind != GOUGH_INTERVAL_STATIC) sum += (v->to - v->from) * v->modes;
        }
        ck_assert_msg(sum < width, "row %zu: %g after %g", r, sum, width);
        width = sum;
    }
    ck_assert(a.map.row[4].intervals < a.map.row[0].intervals / 2);
    drop(&a);
    free(model);
}
END_TEST

START_TEST(twice_the_frequency_is_the_faster_program) {
    gough_model *model = heaving("0.1*sin(t)"), *faster = heaving("0.1*sin(2*t)");
    gough_map_options o = over(0, 2, 7);
    const gough_map_options alone = o;
    atlas a, b;

    o.axis = GOUGH_MAP_FREQUENCY;
    o.second = (gough_map_range){1, 2, 2, true};
    find_all(&a, model, &o);
    find_all(&b, faster, &alone);
    ck_assert(fabs(a.map.row[1].period.period - pi) <= 1e-12);
    for (size_t i = 0; i < b.points; i++)
        ck_assert(fabs(a.map.point[7 + i].rate - b.map.point[i].rate) <= 1e-10);
    drop(&a);
    drop(&b);
    free(model);
    free(faster);
}
END_TEST

START_TEST(without_feedforward_points_are_those_of_the_motion_found) {
    gough_model *model = heaving("0.05*sin(t)");
    const gough_map_options o = over(2, 4, 3);
    atlas a;

    model->control.feedforward = false;
    find_all(&a, model, &o);
    same_as_alone(model, &a);
    drop(&a);
    free(model);
}
END_TEST

/* ---- what it rests on ---- */

/* (floquet-22): Φᵀ Ω Φ = Ω over a period of all six axes, elements of Ω up to 1.3 */
START_TEST(undamped_motion_keeps_its_symplectic_form) {
    gough_model *model = tumbling();
    gough_acceleration acceleration;
    gough_floquet f;
    gough_state state;
    symplectic form;
    double complex column[GOUGH_LINEAR][GOUGH_LINEAR], unit[GOUGH_LINEAR][GOUGH_LINEAR];

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
END_TEST

/* ---- ends ---- */

static int stop_half_way(void *context, double done) {
    double *last = context;

    ck_assert(done >= *last && done <= 1);
    *last = done;
    return done > 0.5;
}

START_TEST(progress_stops_it) {
    gough_model *model = heaving("0.2*sin(t)");
    gough_map_options o = over(0, 2, 5);
    double last = 0;
    atlas a;

    o.axis = GOUGH_MAP_AMPLITUDE;
    o.second = (gough_map_range){0.1, 1, 8, false};
    o.progress = stop_half_way;
    o.context = &last;
    o.threads = 1;
    find(&a, model, &o);
    ck_assert_int_eq(a.status, GOUGH_ERROR_NUMERICAL);
    ck_assert_msg(strstr(a.error.message, "stopped") != NULL, "%s", a.error.message);
    ck_assert(last > 0.5 && last < 0.8);
    ck_assert(a.map.row[0].error.status == GOUGH_OK);
    ck_assert(a.map.row[7].error.status == GOUGH_ERROR_NUMERICAL && isnan(a.map.point[39].rate));
    drop(&a);
    free(model);
}
END_TEST

/* heave from 1 down to 0: all legs in one plane */
START_TEST(rows_without_values_say_why) {
    gough_model *model = heaving("0.2*sin(t)");
    gough_map_options o = over(0, 2, 3);
    atlas a;

    o.axis = GOUGH_MAP_AMPLITUDE;
    o.second = (gough_map_range){1, 5, 2, false};
    find(&a, model, &o);
    ck_assert_msg(a.status == GOUGH_OK, "%s", a.error.message);
    ck_assert(a.map.row[0].error.status == GOUGH_OK && a.map.row[0].intervals > 0);
    ck_assert(a.map.row[1].error.status == GOUGH_ERROR_NUMERICAL);
    ck_assert_msg(strstr(a.map.row[1].error.message, "singular") != NULL, "%s",
                  a.map.row[1].error.message);
    ck_assert(isnan(a.map.point[3].rate) && !a.map.point[3].stable);
    drop(&a);

    set_formula(&model->motion.formula[GOUGH_YAW], "0.1*t");
    o = over(0, 2, 3);
    find(&a, model, &o);
    ck_assert(a.status == GOUGH_OK && a.map.row[0].error.status == GOUGH_ERROR_INPUT);
    drop(&a);
    free(model);
}
END_TEST

START_TEST(refuses_axes_without_values) {
    gough_model *model = heaving("0.2*sin(t)");
    gough_map_options o[8];
    static const char *const word[8] = {"stiffness", "stiffness", "stiffness", "frequency",
                                        "damping",   "lanes",     "above 0",   "fewer"};

    for (int i = 0; i < 8; i++) o[i] = over(0, 2, 3);
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
    return SUITE_RUN(
        "map", 120, points_are_the_multipliers_found_one_by_one, points_are_good_for_stiff_legs_too,
        same_bits_in_all_lanes_and_threads, intervals_of_heave_are_those_of_hills_equation,
        no_point_of_a_fine_grid_contradicts_the_intervals,
        no_damped_point_contradicts_the_intervals,
        narrow_intervals_are_found_on_a_grid_of_five_points, edges_outside_the_range_are_told,
        without_motion_there_are_thresholds_and_nothing_else, damping_closes_tongues,
        twice_the_frequency_is_the_faster_program,
        without_feedforward_points_are_those_of_the_motion_found,
        undamped_motion_keeps_its_symplectic_form, progress_stops_it, rows_without_values_say_why,
        refuses_axes_without_values, values_of_an_axis_meet_its_ends);
}
