/* Bounds over boxes by which worst values are searched, against single poses: how far the top turns, singular values by the
 * Jacobian of each pose, distances by points of the legs; how near bounds come to values that are found, and of which order
 * they are.
 * Label: standard.
 * Sanitized: campaign: it evaluates many poses. */
#define NUMBER_DOUBLE
#include <stdio.h>

#include "support/suite.h"
#include "workspace/clearance.h"
#include "workspace/flight.h"
#include "workspace/polynomial.h"
#include "workspace/slope_parts.h"
#include "workspace/stiff.h"

static void view_about(const gough_reach *reach, const double at[GOUGH_COMPONENTS], double size,
                       space *s, box_view *view, gough_box *box) {
    static const double half[GOUGH_COMPONENTS] = {0.2, 0.1, 0.2, 0.15, 0.2, 0.1};
    for (int c = 0; c < GOUGH_COMPONENTS; c++)
        box->least[c] = at[c] - size * half[c], box->greatest[c] = at[c] + size * half[c];
    space_begin(s, reach);
    box_view_of(s, box, view);
}

/* (space-2): of a vector that turns with the top, all poses of a box are within the rest of what second order says */
START_TEST(turned_vectors_are_within_their_bounds) {
    gough_model *model = malloc(sizeof *model);
    dice d = {51};
    double nearest = 0;
    flight_machine(model);
    for (int order = 0; order < 2; order++) {
        gough_reach reach = flight_reach(model);
        reach.order = order ? GOUGH_XYZ : GOUGH_ZYX;
        for (int n = 0; n < 300; n++) {
            /* poses close to a pitch of 90 degrees, too, where both other axes are parallel */
            const double at[GOUGH_COMPONENTS] = {0,
                                                 0,
                                                 0,
                                                 dice_between(&d, -3, 3),
                                                 dice_between(&d, -1.5, 1.5),
                                                 dice_between(&d, -3, 3)};
            const vector u = {dice_between(&d, -1, 1), dice_between(&d, -1, 1),
                              dice_between(&d, -1, 1)};
            gough_box box;
            box_view view;
            space s;
            view_about(&reach, at, dice_between(&d, 0.01, 3), &s, &view, &box);
            const taylor_vector all = box_turned(&view, out_of(&view.R, u));
            for (int i = 0; i < 40; i++) {
                double pose[GOUGH_COMPONENTS], R[3][3], xi[GOUGH_COMPONENTS], off = 0;
                flight_pick(&box, i % 2, &d, pose);
                gough_rotation_in_order(reach.order, pose + GOUGH_ROLL, R);
                for (int k = 0; k < GOUGH_COMPONENTS; k++)
                    xi[k] = (pose[k] - view.centre[k]) / view.half[k];
                for (int r = 0; r < 3; r++) {
                    const double x = R[r][0] * u.x + R[r][1] * u.y + R[r][2] * u.z -
                                     polynomial_at(&all.x[r], xi);
                    off += x * x;
                }
                ck_assert_msg(sqrt(off) <= all.x[0].r, "box %d of seed 51: %g exceeds %g", n,
                              sqrt(off), all.x[0].r);
                nearest = fmax(nearest, sqrt(off) / all.x[0].r);
            }
        }
    }
    printf("the greatest part of a bound that a pose needs: %.3f\n", nearest);
    ck_assert(nearest > 0.1);
    free(model);
}
END_TEST

/* condition and determinant of gough_conditioning() give no single value; from the Jacobian: both by powers of JᵀJ */
static void values_at(const gough_model *model, const double pose[GOUGH_COMPONENTS],
                      double value[2]) {
    gough_state state;
    double J[GOUGH_LEGS][6], condition, determinant, x[6] = {1, 0.9, 1.1, -0.8, 0.7, 1.2}, size = 0;
    flight_state(model, pose, &state);
    gough_jacobian(&model->machine, &state, J);
    gough_conditioning(&model->machine, &state, &condition, &determinant);
    space s;
    const gough_reach reach = flight_reach(model);
    space_begin(&s, &reach);
    for (int n = 0; n < 400; n++) {
        double y[6] = {0}, z[6] = {0};
        for (int v = 0; v < 6; v++)
            for (int k = 0; k < 6; k++) y[v] += J[v][k] / (k < 3 ? 1 : s.h.reach) * x[k];
        for (int k = 0; k < 6; k++)
            for (int v = 0; v < 6; v++) z[k] += J[v][k] / (k < 3 ? 1 : s.h.reach) * y[v];
        size = 0;
        for (int k = 0; k < 6; k++) size += z[k] * z[k];
        size = sqrt(size);
        for (int k = 0; k < 6; k++) x[k] = z[k] / size;
    }
    value[1] = sqrt(size), value[0] = value[1] / condition;
}

/* (space-19): bounds of singular values hold in all poses; what they lose falls by four with each halving of the box */
START_TEST(singular_values_are_within_bounds_of_second_order) {
    gough_model *model = malloc(sizeof *model);
    dice d = {52};
    flight_machine(model);
    const gough_reach reach = flight_reach(model);
    for (int n = 0; n < 12; n++) {
        double at[GOUGH_COMPONENTS], lost[2] = {0, 0};
        for (int c = 0; c < GOUGH_COMPONENTS; c++) at[c] = dice_between(&d, -0.25, 0.25);
        for (int halving = 0; halving < 2; halving++) {
            double least = INFINITY, most = 0;
            taylor_vector way[LEGS];
            gough_box box;
            box_view view;
            space s;
            stiff J;
            view_about(&reach, at, halving ? 0.02 : 0.04, &s, &view, &box);
            for (int v = 0; v < LEGS; v++) way[v] = box_direction(&view, v);
            stiff_of(&s, &view, way, &J);
            stiff_refine(&J, true);
            for (int i = 0; i < 64; i++) {
                double pose[GOUGH_COMPONENTS], value[2];
                for (int c = 0; c < GOUGH_COMPONENTS; c++)
                    pose[c] = i >> c & 1 ? box.greatest[c] : box.least[c];
                values_at(model, pose, value);
                least = fmin(least, value[0]), most = fmax(most, value[1]);
            }
            ck_assert_msg(J.least[0] <= least * (1 + 1e-9) && J.most[1] >= most * (1 - 1e-9),
                          "box %d of seed 52: %g > %g or %g < %g", n, J.least[0], least, J.most[1],
                          most);
            lost[halving] = least - J.least[0];
        }
        ck_assert_msg(lost[1] < 0.35 * lost[0], "box %d of seed 52: %g of %g", n, lost[1], lost[0]);
    }
    free(model);
}
END_TEST

/* (space-16), (space-20): no two points of two legs are nearer in any pose than the bound says */
START_TEST(legs_are_as_far_apart_as_bounds_say) {
    gough_model *model = malloc(sizeof *model);
    dice d = {53};
    int sharp = 0;
    flight_machine(model);
    const gough_reach reach = flight_reach(model);
    for (int n = 0; n < 60; n++) {
        double at[GOUGH_COMPONENTS];
        taylor_vector way[LEGS];
        gough_box box;
        box_view view;
        space s;
        for (int c = 0; c < GOUGH_COMPONENTS; c++) at[c] = dice_between(&d, -0.4, 0.4);
        view_about(&reach, at, pow(10, dice_between(&d, -2, 0)), &s, &view, &box);
        for (int v = 0; v < LEGS; v++) way[v] = box_direction(&view, v);
        for (int v = 0; v < LEGS; v++) {
            const int w = (v + 1) % LEGS;
            double bound[2], least = INFINITY;
            clearance_of(&s, &view, way, v, w, INFINITY, bound);
            for (int i = 0; i < 3; i++) {
                double pose[GOUGH_COMPONENTS];
                flight_pick(&box, true, &d, pose);
                least = fmin(least, flight_distance(model, pose, v, w));
            }
            ck_assert_msg(bound[0] <= least + 1e-12, "box %d of seed 53: %g exceeds %g", n,
                          bound[0], least);
            sharp += bound[0] > 0.98 * least;
        }
    }
    printf("bounds within 2 %% of a distance: %d of 360\n", sharp);
    ck_assert(sharp > 200);
    free(model);
}
END_TEST

/* (space-21): the part of a cube below a plane is that of points drawn from it, and exactly that of prisms and corners */
START_TEST(parts_below_planes_are_those_of_points) {
    dice d = {55};
    const double one[3] = {2, 0, 0}, two[3] = {1, 0, -1}, three[3] = {1, -1, 1};
    ck_assert(fabs(part_below(one, 1) - 0.75) < 1e-12);
    ck_assert(fabs(part_below(two, -1) - 0.125) < 1e-12);
    ck_assert(fabs(part_below(three, -2) - 1.0 / 48) < 1e-12);
    ck_assert(fabs(part_below(three, 0) - 0.5) < 1e-12);
    for (int n = 0; n < 40; n++) {
        double g[3], below = 0;
        const double t = dice_between(&d, -1.5, 1.5);
        for (int k = 0; k < 3; k++) g[k] = n % 4 == k ? 0 : dice_between(&d, -1, 1);
        for (int i = 0; i < 10000; i++) {
            double sum = 0;
            for (int k = 0; k < 3; k++) sum += g[k] * dice_between(&d, -1, 1);
            below += sum < t;
        }
        ck_assert_msg(fabs(part_below(g, t) - below / 10000) < 0.025, "plane %d of seed 55", n);
    }
}
END_TEST

/* (space-21): with limits of force, the bounds of a volume lie within 20 % and hold what is drawn */
START_TEST(bounds_of_a_volume_hold_with_forces) {
    gough_model *model = malloc(sizeof *model);
    const double level[3] = {0, 0, 0};
    dice d = {56};
    gough_volume volume;
    double inside = 0;
    flight_demands(model);
    memset(&model->workspace, 0, sizeof model->workspace);
    for (int v = 0; v < GOUGH_LEGS; v++) {
        model->machine.platform.legs.diameter[v] = 0;
        model->machine.platform.legs.force[v][0] = 0.2 * model->machine.platform.legs.force[v][0];
        model->machine.platform.legs.force[v][1] = 0.6 * model->machine.platform.legs.force[v][1];
    }
    const gough_reach reach = flight_reach(model);
    ck_assert(gough_workspace_volume(&reach, level, &volume, NULL) == GOUGH_OK);
    printf("volume %g, %g to %g, %zu boxes\n", volume.value, volume.least, volume.greatest,
           volume.tests);
    ck_assert(volume.least >= 0.8 * volume.greatest);
    for (int i = 0; i < 40000; i++) {
        double pose[GOUGH_COMPONENTS] = {0, 0, 0, 0, 0, 0};
        flight_load load;
        for (int k = 0; k < 3; k++) pose[k] = dice_between(&d, -2.5, 2.5);
        if (flight_excess(model, &reach, pose) > 0) continue;
        flight_draw(model, pose, true, &d, &load);
        inside += flight_over(&reach, &load) <= 0;
    }
    /* three deviations of such a count */
    const double value = inside / 40000 * 125, error = 3 * sqrt(inside) / 40000 * 125;
    ck_assert_msg(value > volume.least - error && value < volume.greatest + error, "%g ± %g", value,
                  error);
    free(model);
}
END_TEST

/* (space-18): over a box as large as a simulator moves in, bounds of all values come within 2 % of values found by a
 * dense search, which finds nothing worse */
START_TEST(bounds_come_near_values_found) {
    gough_model *model = malloc(sizeof *model);
    dice d = {54};
    gough_envelope envelope;
    gough_box box;
    flight_demands(model);
    const gough_reach reach = flight_reach(model);
    for (int c = 0; c < GOUGH_COMPONENTS; c++) box.least[c] = -0.07, box.greatest[c] = 0.07;
    ck_assert(gough_workspace_envelope(&reach, &box, &envelope, NULL) == GOUGH_OK);
    const gough_extreme *e = envelope.of;
    for (int i = 0; i < GOUGH_WORSTS; i++) {
        const double apart = fabs(e[i].bound - e[i].sampled) / fmax(1e-9, fabs(e[i].sampled));
        printf("%s: %g, %g\n", gough_worst_name(i), e[i].bound, e[i].sampled);
        if (!(fabs(e[i].sampled) <= 0))
            ck_assert_msg(apart < 0.02, "%s: %g and %g", gough_worst_name(i), e[i].bound,
                          e[i].sampled);
    }
    for (int i = 0; i < 4000; i++) {
        double pose[GOUGH_COMPONENTS], value[2];
        flight_load load;
        flight_pick(&box, i % 2, &d, pose);
        flight_draw(model, pose, true, &d, &load);
        for (int v = 0; v < GOUGH_LEGS; v++) {
            ck_assert(load.force[v] <= e[GOUGH_WORST_PUSH].bound);
            ck_assert(load.force[v] >= e[GOUGH_WORST_PULL].bound);
            ck_assert(fabs(load.rate[v]) <= e[GOUGH_WORST_SPEED].bound);
            ck_assert(fabs(load.second_rate[v]) <= e[GOUGH_WORST_ACCELERATION].bound);
        }
        if (i % 40 > 0) continue;
        values_at(model, pose, value);
        ck_assert(value[0] >= e[GOUGH_WORST_SINGULAR_VALUE].bound);
        ck_assert(value[1] / value[0] <= e[GOUGH_WORST_CONDITION].bound);
        ck_assert(value[0] >= e[GOUGH_WORST_SINGULAR_VALUE].sampled * (1 - 1e-9));
    }
    free(model);
}
END_TEST

/* two legs that cross have no clearance: the bound is 0, not −0, and so is the value found, not a rounding */
START_TEST(clearance_of_crossing_legs_is_zero) {
    gough_model *model = malloc(sizeof *model);
    const gough_box box = {{0, 0, -0.01, 0, 0, 0}, {0, 0, 0.01, 0, 0, 0}};
    const double gravity[3] = {0, 0, -9.80665};
    gough_envelope envelope;
    gough_error error = {0};
    flight_machine(model);
    gough_platform p = model->machine.platform;
    const gough_load load = model->machine.load;
    for (int v = 0; v < 2; v++) {
        p.base[v][0] = v ? 0.5 : -0.5, p.top[v][0] = -p.base[v][0];
        p.base[v][1] = p.top[v][1] = -1.5;
    }
    ck_assert_msg(gough_machine_init(&model->machine, &p, &load, gravity, &error) == GOUGH_OK, "%s",
                  error.message);
    const gough_reach reach = flight_reach(model);
    ck_assert_msg(gough_workspace_envelope(&reach, &box, &envelope, &error) == GOUGH_OK, "%s",
                  error.message);
    const gough_extreme *x = &envelope.of[GOUGH_WORST_CLEARANCE];
    ck_assert_msg(fabs(x->bound) <= 0 && fabs(x->sampled) <= 0, "%g, %g", x->bound, x->sampled);
    ck_assert(!signbit(x->bound) && !signbit(x->sampled));
    free(model);
}
END_TEST

int main(void) {
    return SUITE_RUN("workspace", 240, turned_vectors_are_within_their_bounds,
                     singular_values_are_within_bounds_of_second_order,
                     legs_are_as_far_apart_as_bounds_say, parts_below_planes_are_those_of_points,
                     bounds_of_a_volume_hold_with_forces, bounds_come_near_values_found,
                     clearance_of_crossing_legs_is_zero);
}
