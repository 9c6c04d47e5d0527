/* Intervals of stiffness in which a mode grows: against Hill's equation, fine grids and thresholds.
 * Label: standard.
 * Not sanitized: the same functions run under sanitizers in the tests of the command. */
#include "maps.h"
#include "support/machines.h"
#include "support/suite.h"

/* trace of the monodromy matrix of (stab-12), by the classical Runge-Kutta method; heave 0.2 sin ωt */
static double hill_trace(double G, double omega) {
    enum { STEPS = 1200 };
    const double h = 2 * pi / omega / STEPS, d2 = 0.49;
    double y[2][2] = {{1, 0}, {0, 1}};

    for (int k = 0; k < STEPS; k++) {
        double f[3];
        for (int i = 0; i < 3; i++) {
            const double s = 0.2 * sin((k + 0.5 * i) * h * omega), z = 1 + s, l2 = z * z + d2;
            f[i] = (1 - omega * omega * s) * d2 / (z * l2) - 6 * G * z * z / l2;
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

static double hill_edge(double inside, double outside, double omega) {
    for (int i = 0; i < 40; i++) {
        const double middle = 0.5 * (inside + outside);
        *(fabs(hill_trace(middle, omega)) > 2 ? &inside : &outside) = middle;
    }
    return outside;
}

typedef struct {
    double edge[20][2];
    int count;
} tongues;

/* by a grid of 20000 points, those that end below `top` */
static tongues hill_tongues(double top, double omega) {
    enum { FINE = 20000 };
    tongues t = {.edge[0][0] = 0, .count = 0};
    bool inside = true;

    for (int i = 1; i <= FINE; i++) {
        const double G = top * i / FINE, before = top * (i - 1) / FINE;
        const bool now = fabs(hill_trace(G, omega)) > 2;
        if (now && !inside) t.edge[t.count][0] = hill_edge(G, before, omega);
        if (!now && inside) t.edge[t.count++][1] = hill_edge(before, G, omega);
        inside = now;
    }
    return t;
}

static void heave_is_hills(const atlas *a, const tongues *t, double omega) {
    int seen = 0;

    for (size_t i = 0; i < a->map.row[0].intervals; i++) {
        const gough_interval *v = map_interval(a, 0, i);
        if (strcmp(v->mode.name, "heave") != 0 || v->to - v->from < 1e-4) continue;
        ck_assert(seen < t->count);
        ck_assert_msg(fabs(v->from - t->edge[seen][0]) <= 1e-8, "from %.12g, not %.12g", v->from,
                      t->edge[seen][0]);
        ck_assert_msg(fabs(v->to - t->edge[seen][1]) <= 1e-8, "to %.12g, not %.12g", v->to,
                      t->edge[seen][1]);
        ck_assert(v->kind == (seen == 0       ? GOUGH_INTERVAL_STATIC
                              : seen % 2 == 1 ? GOUGH_INTERVAL_MINUS
                                              : GOUGH_INTERVAL_PLUS));
        ck_assert(v->modes == 1 && !v->cut);
        ck_assert(fabs(log(v->growth) - acosh(fabs(hill_trace(v->stiffness, omega)) / 2)) <= 1e-6);
        seen++;
    }
    ck_assert_int_eq(seen, t->count);
}

/* the narrowest below G = 2 is 5.3e-4 wide, more than the step of the grid */
START_TEST(intervals_of_heave_are_those_of_hills_equation) {
    gough_model *model = map_heaving("0.2*sin(t)*(1 - exp(-t/2))^2");
    const gough_map_options o = map_over(0, 2, 5);
    const tongues t = hill_tongues(2, 1);
    atlas a;

    ck_assert_int_eq(t.count, 6);
    map_find_all(&a, model, &o);
    heave_is_hills(&a, &t, 1);
    ck_assert(fabs(t.edge[1][0] - 0.11616) <= 5e-6 && fabs(t.edge[1][1] - 0.19283) <= 5e-6);
    ck_assert(fabs(t.edge[2][0] - 0.33333) <= 5e-6 && fabs(t.edge[2][1] - 0.36773) <= 5e-6);
    map_drop(&a);
    free(model);
}
END_TEST

/* Yaw grows 1e15 times in a period of 8π, heave by less than twice in some of its tongues. The first is 2e-5 above the threshold,
 * for which the grid is fine. */
START_TEST(what_grows_little_is_seen_beside_what_grows_beyond_all_digits) {
    gough_model *model = map_heaving("0.2*sin(t/4)");
    const gough_map_options o = map_over(0, 0.3, 5);
    const tongues t = hill_tongues(0.3, 0.25);
    atlas a;

    ck_assert(t.count >= 7);
    map_find_all(&a, model, &o);
    ck_assert(a.map.point[0].growth > 1e15);
    heave_is_hills(&a, &t, 0.25);
    map_drop(&a);
    free(model);
}
END_TEST

/* whether some interval holds a stiffness; 0 near an edge, where a point may be on either side */
static int held(const atlas *a, size_t row, double G, double margin) {
    int inside = -1;

    for (size_t i = 0; i < a->map.row[row].intervals; i++) {
        const gough_interval *v = map_interval(a, row, i);
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
    for (int machine = 0; machine < 3; machine++) {
        gough_model *model = machine ? map_tumbling() : map_heaving("0.2*sin(t)");
        const gough_map_options o = map_over(0, 4, machine == 2 ? 1001 : 4001);
        dice d = {47};
        atlas a;
        if (machine == 2) give_legs(&model->machine, LEGS_HEAVY, &d);
        map_find_all(&a, model, &o);
        points_agree_with_intervals(&a);
        ck_assert(a.map.row[0].intervals > 20);
        ck_assert(a.map.row[0].intervals_missed == 0);
        map_drop(&a);
        free(model);
    }
}
END_TEST

START_TEST(no_damped_point_contradicts_the_intervals) {
    gough_model *model = map_tumbling();
    gough_map_options o = map_over(0, 4, 801);
    atlas a;

    o.axis = GOUGH_MAP_DAMPING;
    o.second = (gough_map_range){0.001, 0.02, 3, false};
    map_find_all(&a, model, &o);
    points_agree_with_intervals(&a);
    ck_assert(a.map.row[0].intervals > a.map.row[2].intervals);
    map_drop(&a);
    free(model);
}
END_TEST

/* the same intervals whatever the grid, none of its points in the narrow ones */
START_TEST(narrow_intervals_are_found_on_a_grid_of_five_points) {
    gough_model *model = map_heaving("0.2*sin(t)");
    const gough_map_options coarse = map_over(0, 2, 5), fine = map_over(0, 2, 333);
    int narrow = 0;
    atlas a, b;

    map_find_all(&a, model, &coarse);
    map_find_all(&b, model, &fine);
    ck_assert(a.map.row[0].intervals == b.map.row[0].intervals);
    for (size_t i = 0; i < a.map.row[0].intervals; i++) {
        const gough_interval *v = map_interval(&a, 0, i), *w = map_interval(&b, 0, i);
        ck_assert(fabs(v->from - w->from) <= 1e-9 && fabs(v->to - w->to) <= 1e-9);
        ck_assert(v->kind == w->kind && strcmp(v->mode.name, w->mode.name) == 0);
        narrow += v->to - v->from < 0.002;
    }
    ck_assert_msg(narrow >= 8, "%d", narrow);
    map_drop(&a);
    map_drop(&b);
    free(model);
}
END_TEST

/* damped: sought where the undamped loop grows */
START_TEST(narrow_damped_intervals_are_found_on_a_grid_of_five_points) {
    gough_model *model = map_heaving("0.2*sin(t)");
    const gough_map_options coarse = map_over(0, 2, 5), fine = map_over(0, 2, 4001);
    int narrow = 0;
    atlas a, b;

    for (int v = 0; v < GOUGH_LEGS; v++) model->control.damping[v] = 3e-5;
    map_find_all(&a, model, &coarse);
    map_find_all(&b, model, &fine);
    ck_assert(a.map.row[0].intervals == b.map.row[0].intervals);
    for (size_t i = 0; i < a.map.row[0].intervals; i++) {
        const gough_interval *v = map_interval(&a, 0, i), *w = map_interval(&b, 0, i);
        ck_assert(fabs(v->from - w->from) <= 1e-9 && fabs(v->to - w->to) <= 1e-9);
        narrow += v->to - v->from < 0.0005;
    }
    ck_assert_msg(narrow >= 1, "%d of %zu", narrow, a.map.row[0].intervals);
    map_drop(&a);
    map_drop(&b);
    free(model);
}
END_TEST

/* a range that begins inside: edges beyond it are found, and the end of the range is told from an edge */
START_TEST(edges_outside_the_range_are_told) {
    gough_model *model = map_heaving("0.2*sin(t)");
    const gough_map_options o = map_over(0.15, 0.35, 3);
    int whole = 0, cut = 0;
    atlas a;

    map_find_all(&a, model, &o);
    for (size_t i = 0; i < a.map.row[0].intervals; i++) {
        const gough_interval *v = map_interval(&a, 0, i);
        ck_assert(v->to >= 0.15 && v->from <= 0.35);
        ck_assert(v->stiffness >= 0.15 && v->stiffness <= 0.35);
        if (strcmp(v->mode.name, "heave") != 0) continue;
        whole += fabs(v->from - 0.11616) <= 5e-6 && fabs(v->to - 0.19283) <= 5e-6 && !v->cut;
        cut += fabs(v->from - 0.33333) <= 5e-6 && fabs(v->to - 0.35) <= 1e-12 && v->cut;
    }
    ck_assert(whole == 1 && cut == 1);
    map_drop(&a);
    free(model);
}
END_TEST

START_TEST(without_motion_there_are_thresholds_and_nothing_else) {
    gough_model *model = map_heaving("0.2*sin(t)");
    gough_map_options o = map_over(0, 2, 9);
    gough_rest rest;
    atlas a;

    ck_assert(gough_stability_at_rest(model, NULL, &rest, NULL) == GOUGH_OK);
    o.axis = GOUGH_MAP_AMPLITUDE;
    o.second = (gough_map_range){0, 1e-9, 2, false};
    map_find_all(&a, model, &o);
    ck_assert(a.map.row[0].period.resting && !a.map.row[1].period.resting);
    ck_assert(isnan(a.map.point[0].growth) && a.map.point[0].rate > 0);
    for (size_t r = 0; r < 2; r++) {
        int modes = 0;
        for (size_t i = 0; i < a.map.row[r].intervals; i++) {
            const gough_interval *v = map_interval(&a, r, i);
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
    map_drop(&a);
    free(model);
}
END_TEST

START_TEST(damping_closes_tongues) {
    gough_model *model = map_heaving("0.2*sin(t)");
    gough_map_options o = map_over(0, 2, 5);
    double width = INFINITY;
    atlas a;

    o.axis = GOUGH_MAP_DAMPING;
    o.second = (gough_map_range){0, 0.1, 5, false};
    map_find_all(&a, model, &o);
    for (size_t r = 0; r < a.rows; r++) {
        double sum = 0;
        for (size_t i = 0; i < a.map.row[r].intervals; i++) {
            const gough_interval *v = map_interval(&a, r, i);
            if (v->kind != GOUGH_INTERVAL_STATIC) sum += (v->to - v->from) * v->modes;
        }
        ck_assert_msg(sum < width, "row %zu: %g after %g", r, sum, width);
        width = sum;
    }
    ck_assert(a.map.row[4].intervals < a.map.row[0].intervals / 2);
    map_drop(&a);
    free(model);
}
END_TEST

int main(void) {
    return SUITE_RUN("intervals", 120, intervals_of_heave_are_those_of_hills_equation,
                     what_grows_little_is_seen_beside_what_grows_beyond_all_digits,
                     no_point_of_a_fine_grid_contradicts_the_intervals,
                     no_damped_point_contradicts_the_intervals,
                     narrow_intervals_are_found_on_a_grid_of_five_points,
                     narrow_damped_intervals_are_found_on_a_grid_of_five_points,
                     edges_outside_the_range_are_told,
                     without_motion_there_are_thresholds_and_nothing_else, damping_closes_tongues);
}
