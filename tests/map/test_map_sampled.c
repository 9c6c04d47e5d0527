/* Maps of sampled loops: at rest against the windows of the loop at rest and against closed forms; about a program point by point
 * against single analyses, and their edges against growth on both sides of them.
 * Label: standard.
 * Not sanitized: the same functions run under sanitizers in the tests of the command. */
#include "gough/linear.h"
#include "maps.h"
#include "support/machines.h"
#include "support/suite.h"

static gough_model *sampled(const char *heave, double period, double delay, double damping) {
    gough_model *model = map_heaving(heave);

    model->control.sampling.period = period;
    model->control.sampling.delay = delay;
    set_gains(model, 1, damping);
    return model;
}

/* the interval of a kind, of which there must be one */
static const gough_interval *only(const atlas *a, size_t row, gough_interval_kind kind) {
    const gough_interval *found = NULL;

    for (size_t i = 0; i < a->map.row[row].intervals; i++) {
        if (map_interval(a, row, i)->kind != kind) continue;
        ck_assert_msg(found == NULL, "row %zu has two intervals of the kind", row);
        found = map_interval(a, row, i);
    }
    ck_assert_msg(found != NULL, "row %zu lacks an interval of the kind", row);
    return found;
}

/* (loop-3): heave of the loop at rest holds for λ²/κ < G < D λ/tanh(λT/2), whatever the other modes do */
START_TEST(heave_at_rest_has_the_window_of_one_mode) {
    const double lambda = sqrt(0.328859), kappa = 4.026846; /* of heave, to the digits given */
    gough_model *model = sampled("0", 0.05, 0, 0.02);
    gough_map_options o = map_over(0.05, 0.9, 12);
    atlas a;

    o.axis = GOUGH_MAP_PERIOD;
    o.second = (gough_map_range){0.05, 0.2, 4, false};
    o.modes = GOUGH_MAP_HEAVE;
    map_find_all(&a, model, &o);
    for (size_t r = 0; r < a.rows; r++) {
        const double T = a.map.row[r].value;
        const gough_interval *below = only(&a, r, GOUGH_INTERVAL_STATIC);
        const gough_interval *above = only(&a, r, GOUGH_INTERVAL_OSCILLATION);
        ck_assert(a.map.row[r].period.resting && fabs(a.map.row[r].sampling - T) <= 0);
        ck_assert(fabs(below->to - lambda * lambda / kappa) <= 1e-6);
        /* a rate of growth up to 1e-7 counts as none, and it rises by κT/4 with G */
        ck_assert_msg(fabs(above->from - 0.02 * lambda / tanh(lambda * T / 2)) <= 3e-6,
                      "T %g: %.9g", T, above->from);
        ck_assert(above->cut && isnan(above->growth) && above->rate > 0);
        ck_assert_str_eq(above->mode.name, "heave");
    }
    map_drop(&a);
    free(model);
}
END_TEST

/* all modes, over period and delay: the edges of gough_sampled_margins_at_rest(), which finds them in another way */
START_TEST(at_rest_edges_are_those_of_the_margins) {
    for (int axis = GOUGH_MAP_PERIOD; axis <= GOUGH_MAP_DELAY; axis++) {
        gough_model *model = sampled("0", 0.05, 0.03, 0.3);
        gough_map_options o = map_over(0.5, 8, 16);
        atlas a;

        if (axis == GOUGH_MAP_PERIOD) model->control.sampling.velocity = GOUGH_VELOCITY_DIFFERENCE;
        o.axis = (gough_map_axis)axis;
        o.second = (gough_map_range){axis == GOUGH_MAP_PERIOD ? 0.02 : 0, 0.08, 4, false};
        map_find_all(&a, model, &o);
        for (size_t r = 0; r < a.rows; r++) {
            gough_sampling *s = &model->control.sampling;
            const double value = a.map.row[r].value;
            gough_sampled_margins m;
            double top = 0, bottom = INFINITY;
            if (axis == GOUGH_MAP_PERIOD) s->delay *= value / s->period;
            *(axis == GOUGH_MAP_PERIOD ? &s->period : &s->delay) = value;
            ck_assert_int_eq(gough_sampled_margins_at_rest(model, NULL, &m, NULL), GOUGH_OK);
            ck_assert(m.open);
            for (size_t i = 0; i < a.map.row[r].intervals; i++) {
                const gough_interval *one = map_interval(&a, r, i);
                if (one->kind == GOUGH_INTERVAL_STATIC) top = fmax(top, one->to);
                if (one->kind == GOUGH_INTERVAL_OSCILLATION) bottom = fmin(bottom, one->from);
            }
            ck_assert(fabs(top - m.lower.stiffness) <= 1e-6 * 8);
            ck_assert_msg(m.upper.stiffness > 8 ? isinf(bottom)
                                                : fabs(bottom - m.upper.stiffness) <= 1e-6 * 8,
                          "axis %d, %g: %.9g, not %.9g", axis, value, bottom, m.upper.stiffness);
        }
        map_drop(&a);
        free(model);
    }
}
END_TEST

/* A window of stiffness narrower than the steps of the grid lies between two points; growth falls towards it from both. */
START_TEST(a_narrow_window_is_found) {
    gough_model *model = sampled("0", 0.17, 0.17, 0.4);
    gough_sampled_margins m;
    atlas a;

    ck_assert_int_eq(gough_sampled_margins_at_rest(model, NULL, &m, NULL), GOUGH_OK);
    ck_assert(m.open && m.upper.stiffness - m.lower.stiffness < 0.15);
    const gough_map_options o = map_over(0.2, 1.4, 5); /* steps of 0.3 */
    map_find_all(&a, model, &o);
    for (size_t i = 0; i < a.points; i++) ck_assert(!a.map.point[i].stable);
    double bottom = INFINITY;
    for (size_t i = 0; i < a.map.row[0].intervals; i++) {
        const gough_interval *one = map_interval(&a, 0, i);
        if (one->kind == GOUGH_INTERVAL_OSCILLATION) bottom = fmin(bottom, one->from);
    }
    ck_assert_msg(fabs(bottom - m.upper.stiffness) <= 1e-5, "%.9g, not %.9g", bottom,
                  m.upper.stiffness);
    map_drop(&a);
    free(model);
}
END_TEST

/* In one period of the program: the largest multiplier of heave in a single analysis. 0: heave is not among those listed; NaN: the
 * analysis finds no motion. */
static double growth_of_heave(gough_model *model, double stiffness) {
    gough_sampled_floquet f;
    double most = 0;

    for (int v = 0; v < GOUGH_LEGS; v++) model->control.stiffness[v] = stiffness;
    if (gough_floquet_sampled(model, NULL, &f, NULL) != GOUGH_OK) return NAN;
    const double *largest = f.multiplier[0].value, *least = f.multiplier[f.listed - 1].value;
    ck_assert(hypot(least[0], least[1]) > 1e-9 * hypot(largest[0], largest[1]));
    for (size_t k = 0; k < f.listed; k++) {
        const gough_multiplier *m = &f.multiplier[k];
        if (strcmp(m->mode.name, "heave") == 0) most = fmax(most, hypot(m->value[0], m->value[1]));
    }
    return pow(most, 1 / (double)f.periods);
}

/* Heave grows on one side of an edge of an interval, and not on the other, where `outside` points: -1 or 1. Where the motion ends
 * at the edge there is nothing on the other side; a multiplier then comes to 1 as the root of the distance. */
static void check_edge(gough_model *model, double edge, double outside) {
    const double beyond = growth_of_heave(model, edge + outside * 1e-4),
                 near = growth_of_heave(model, edge - outside * 1e-4),
                 farther = growth_of_heave(model, edge - outside * 2e-4);

    ck_assert(near > 1 && farther > near);
    if (beyond > 0 && beyond <= 1) return;
    ck_assert_msg(isnan(beyond), "beyond the edge at %.9g heave grows by %.9g", edge, beyond);
    ck_assert_msg(fabs((farther - 1) / (near - 1) - sqrt(2)) <= 0.1,
                  "no motion beyond %.9g, but growth falls from %.9g to %.9g towards it", edge,
                  farther, near);
}

/* Points are those of single analyses, with the periods that fit; an edge lies where growth passes 1. */
START_TEST(along_a_program_points_and_edges) {
    gough_model *model = sampled("0.2*sin(t)", 2 * pi / 16, 0.3, 0.05);
    gough_map_options o = map_over(0.05, 0.25, 9);
    atlas a;

    size_t compared = 0;

    model->control.sampling.preview = 0.4;
    o.axis = GOUGH_MAP_PERIOD;
    o.second =
        (gough_map_range){2 * pi / 20, 3 * pi / 20, 2, false}; /* 20 samples; 40 in 3 periods */
    o.modes = GOUGH_MAP_HEAVE;
    map_find_all(&a, model, &o);
    for (size_t r = 0; r < 2; r++) {
        const double T = a.map.row[r].value;
        ck_assert_int_eq((int)a.map.row[r].periods, r == 0 ? 1 : 3);
        ck_assert(fabs(a.map.row[r].sampling - T) <= 1e-12);
        model->control.sampling.delay = 0.3 * T / (2 * pi / 16);
        model->control.sampling.preview = 0.4 * T / (2 * pi / 16);
        model->control.sampling.period = T;
        for (size_t i = 0; i < o.stiffness.count; i++) {
            const gough_map_point *p = &a.map.point[r * o.stiffness.count + i];
            const double right = growth_of_heave(model, gough_map_value(&o.stiffness, i));
            ck_assert_int_eq(isnan(p->growth), !(right > 0));
            if (!(right > 0)) continue;
            compared++;
            ck_assert_msg(fabs(p->growth - right) <= 1e-8 * right, "%.12g, not %.12g", p->growth,
                          right);
            ck_assert(fabs(p->rate - log(right) / (2 * pi)) <= 1e-8);
            ck_assert_int_eq(p->stable, right <= 1);
        }
        ck_assert_uint_ge(a.map.row[r].intervals, 1);
        for (size_t i = 0; i < a.map.row[r].intervals; i++) {
            const gough_interval *one = map_interval(&a, r, i);
            if (one->from > 0.05) check_edge(model, one->from, -1);
            if (!one->cut) check_edge(model, one->to, 1);
        }
    }
    ck_assert_uint_ge(compared, 13); /* of 18; the others grow by less than 1e-9 of what another
                                        mode grows by */
    map_drop(&a);
    free(model);
}
END_TEST

/* The paper's tongues are those of the continuous loop, in which heave has no damping, (floquet-23); samples as short as this do
 * not widen them. */
START_TEST(short_samples_keep_the_tongue) {
    gough_model *model = sampled("0.2*sin(t)", 2 * pi / 200, 0, 0.015);
    gough_map_options o = map_over(0.1, 0.21, 12), bare = o;
    atlas a, b;

    model->control.sampling.preview = pi / 200;
    o.modes = bare.modes = GOUGH_MAP_HEAVE;
    map_find_all(&a, model, &o);
    set_gains(model, 1, 0);
    memset(&model->control.sampling, 0, sizeof model->control.sampling);
    map_find_all(&b, model, &bare);
    const gough_interval *found = only(&a, 0, GOUGH_INTERVAL_MINUS);
    const gough_interval *right = only(&b, 0, GOUGH_INTERVAL_MINUS);
    ck_assert(found->from > right->from && found->from < right->from + 1e-3);
    ck_assert(found->to < right->to && found->to > right->to - 1e-3);
    ck_assert_uint_eq(b.map.row[0].intervals, 1); /* the other modes do not count */
    map_drop(&a);
    map_drop(&b);
    free(model);
}
END_TEST

/* the same bits whoever computes a row; a row without values has its reason, and the others have theirs */
START_TEST(threads_and_rows_without_values) {
    gough_model *model = sampled("0.1*sin(t)", 0.2, 0, 0.3);
    gough_map_options o = map_over(0.5, 2, 4);
    atlas a, b;

    o.axis = GOUGH_MAP_DELAY;
    o.second = (gough_map_range){0, 3, 2, false}; /* 3 is more than 12 periods */
    o.threads = 1;
    map_find(&a, model, &o);
    o.threads = 3;
    map_find(&b, model, &o);
    ck_assert(a.status == GOUGH_OK && b.status == GOUGH_OK);
    ck_assert_mem_eq(a.map.point, b.map.point, a.points * sizeof *a.map.point);
    ck_assert_mem_eq(a.map.row, b.map.row, sizeof *a.map.row);
    ck_assert(fabs(a.map.row[0].sampling - 2 * pi / 31) <= 1e-12);
    ck_assert_msg(strstr(a.map.row[1].error.message, "12 periods") != NULL, "%s",
                  a.map.row[1].error.message);
    ck_assert(isnan(a.map.point[4].rate) && isfinite(a.map.point[3].rate));
    map_drop(&a);
    map_drop(&b);
    free(model);
}
END_TEST

static void refuses(const gough_model *model, const gough_map_options *o, const char *words) {
    gough_error error = {0};
    size_t bytes;

    ck_assert_int_eq(gough_map_size(model, o, &bytes, &error), GOUGH_ERROR_INPUT);
    ck_assert_msg(strstr(error.message, words) != NULL, "%s", error.message);
}

START_TEST(refuses_what_cannot_be_mapped) {
    gough_model *model = sampled("0", 0.05, 0, 0.3);
    gough_map_options o = map_over(1, 2, 3);

    o.modes = 16;
    refuses(model, &o, "16 is no sum of sway 1");
    o.modes = 0;
    model->control.coupled = false;
    model->control.sampling.period = 0;
    o.axis = GOUGH_MAP_DELAY;
    o.second = (gough_map_range){0, 1, 2, false};
    refuses(model, &o, "needs a sampled controller");
    o.axis = GOUGH_MAP_PERIOD;
    refuses(model, &o, "above 0");
    free(model);
}
END_TEST

int main(void) {
    return SUITE_RUN("map/sampled", 240, heave_at_rest_has_the_window_of_one_mode,
                     at_rest_edges_are_those_of_the_margins, a_narrow_window_is_found,
                     along_a_program_points_and_edges, short_samples_keep_the_tongue,
                     threads_and_rows_without_values, refuses_what_cannot_be_mapped);
}
