/* Wide boxes, where second and third order count: every term of a bound is asked for by some pose, and searches come as near to a
 * worst value in closed form as their boxes allow.
 * Label: standard. */
#define NUMBER_DOUBLE
#include <stdio.h>

#include "support/suite.h"
#include "workspace/ask.h"
#include "workspace/flight.h"
#include "workspace/polynomial.h"
#include "workspace/slope_parts.h"

static gough_box box_about(const double at[GOUGH_COMPONENTS], const double half[GOUGH_COMPONENTS]) {
    gough_box box;
    for (int c = 0; c < GOUGH_COMPONENTS; c++)
        box.least[c] = at[c] - half[c], box.greatest[c] = at[c] + half[c];
    return box;
}

static double distance_of(const double a[3], const double b[3]) {
    double square = 0;
    for (int k = 0; k < 3; k++) square += (a[k] - b[k]) * (a[k] - b[k]);
    return sqrt(square);
}

/* top joint v, or with v < 0 the point that the components move, base frame */
static void joint_at(const gough_model *model, const double pose[GOUGH_COMPONENTS], int v,
                     double q[3]) {
    const double *top = v < 0 ? model->motion.about : model->machine.platform.top[v];
    gough_state s;
    flight_state(model, pose, &s);
    for (int k = 0; k < 3; k++) {
        q[k] = s.position[k];
        for (int j = 0; j < 3; j++) q[k] += s.rotation[k][j] * top[j];
    }
}

/* how far the unit vector that moves farthest moves from one orientation to another */
static double swing_of(double R[3][3], double S[3][3]) {
    double trace = 0;
    for (int k = 0; k < 3; k++)
        for (int j = 0; j < 3; j++) trace += R[k][j] * S[k][j];
    return sqrt(fmax(0, 3 - trace));
}

/* σ and β of (space-2): where the pitch is near 90 degrees, roll and yaw turn about almost the same axis and add up; elsewhere they
 * do so the more, the farther the pitch is from the centre of the box */
START_TEST(angles_about_almost_the_same_axis_add_up) {
    gough_model *model = malloc(sizeof *model);
    dice d = {71};
    double far = 0, rest = 0;
    flight_machine(model);
    gough_reach reach = flight_reach(model);
    for (int n = 0; n < 800; n++) {
        const bool steep = n % 4 < 2;
        const double size = dice_between(&d, 0.05, 0.6), pitch = dice_between(&d, 1.3, 1.5);
        const double at[GOUGH_COMPONENTS] = {0,
                                             0,
                                             0,
                                             dice_between(&d, -3, 3),
                                             steep ? pitch : dice_between(&d, -1, 1),
                                             dice_between(&d, -3, 3)};
        const double half[GOUGH_COMPONENTS] = {0, 0, 0, size, steep ? n % 3 * 0.01 : size, size};
        const gough_box box = box_about(at, half);
        const vector x = {1, 0, 0};
        double centre[3][3];
        space s;
        box_view view;
        reach.order = n % 2 ? GOUGH_XYZ : GOUGH_ZYX;
        space_begin(&s, &reach);
        box_view_of(&s, &box, &view);
        gough_rotation_in_order(reach.order, at + GOUGH_ROLL, centre);
        const taylor_vector all = box_turned(&view, out_of(&view.R, x));
        for (int corner = 0; corner < 8; corner++) {
            double pose[GOUGH_COMPONENTS], R[3][3], off = 0;
            for (int c = 0; c < GOUGH_COMPONENTS; c++)
                pose[c] = c > 2 && corner >> (c - 3) & 1 ? box.least[c] : box.greatest[c];
            gough_rotation_in_order(reach.order, pose + GOUGH_ROLL, R);
            double xi[GOUGH_COMPONENTS] = {0};
            for (int c = 3; c < 6; c++) xi[c] = corner >> (c - 3) & 1 ? -1 : 1;
            for (int k = 0; k < 3; k++) {
                const double left = R[k][0] - polynomial_at(&all.x[k], xi);
                off += left * left;
            }
            const double swing = swing_of(R, centre);
            ck_assert_msg(sqrt(off) <= all.x[0].r, "box %d of seed 71: %g exceeds %g", n, sqrt(off),
                          all.x[0].r);
            ck_assert_msg(swing <= view.turn, "box %d of seed 71: %g exceeds %g", n, swing,
                          view.turn);
            rest = fmax(rest, sqrt(off) / all.x[0].r), far = fmax(far, swing / view.turn);
        }
    }
    printf("parts of the bounds that poses need: %.3f of the way, %.3f of the rest\n", far, rest);
    ck_assert(far > 0.9 && rest > 0.6);
    free(model);
}
END_TEST

/* (space-4): the rest of a length. Shifts at right angles to a leg ask for almost all of it. So do turns about a point of the leg's
 * line beyond the top joint, where both terms have the same sign. */
START_TEST(lengths_of_wide_boxes_need_their_second_order) {
    gough_model *model = malloc(sizeof *model);
    gough_error error = {0};
    dice d = {72};
    double need[2] = {0, 0}, third[2] = {0, 0};
    for (int n = 0; n < 400; n++) {
        const int turns = n % 2;
        double at[GOUGH_COMPONENTS] = {0}, half[GOUGH_COMPONENTS] = {0}, p0[3], n0[3];
        const double size = dice_between(&d, 0.02, 0.3);
        flight_machine(model);
        /* leg 1 in the plane across x, where roll turns it */
        gough_platform p = model->machine.platform;
        const gough_load load = model->machine.load;
        const double gravity[3] = {0, 0, -9.80665};
        p.base[0][0] = p.top[0][0] = dice_between(&d, 1, 2);
        p.base[0][1] += dice_between(&d, -0.5, 0.5);
        ck_assert_msg(gough_machine_init(&model->machine, &p, &load, gravity, &error) == GOUGH_OK,
                      "%s", error.message);
        joint_at(model, at, 0, p0);
        const double l = distance_of(p0, p.base[0]), part = dice_between(&d, -2, 2);
        for (int k = 0; k < 3; k++) n0[k] = (p0[k] - p.base[0][k]) / l;
        for (int k = 0; k < 3; k++) model->motion.about[k] = p.top[0][k] + turns * part * n0[k];
        if (turns)
            half[GOUGH_ROLL] = size;
        else
            half[1] = size * fabs(n0[2]), half[2] = size * fabs(n0[1]);
        const gough_box box = box_about(at, half);
        const gough_reach reach = flight_reach(model);
        space s;
        box_view view;
        space_begin(&s, &reach);
        box_view_of(&s, &box, &view);
        const taylor length = box_length(&view, 0);
        double bound[2];
        box_lengths(&view, 0, bound);
        for (int i = 0; i < 4; i++) {
            double pose[GOUGH_COMPONENTS] = {0}, q[3], first = length.c;
            const double xi[GOUGH_COMPONENTS] = {0, i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 1 ? 1 : -1};
            for (int c = 0; c < GOUGH_COMPONENTS; c++)
                pose[c] = xi[c] * half[c], first += xi[c] * length.g[c];
            joint_at(model, pose, 0, q);
            const double now = distance_of(q, p.base[0]),
                         off = fabs(now - polynomial_at(&length, xi));
            ck_assert_msg(off <= length.r, "box %d of seed 72: %g exceeds %g", n, off, length.r);
            ck_assert_msg(now >= bound[0] && now <= bound[1], "box %d of seed 72: %g", n, now);
            third[turns] = fmax(third[turns], off / length.r);
            /* what the bounds of second order allow above the slopes, and below them */
            const double slope = taylor_slope(&length);
            need[turns] = fmax(need[turns], (now - first) / (bound[1] - length.c - slope));
            need[turns] = fmax(need[turns], (first - now) / (length.c - bound[0] - slope));
        }
    }
    printf(
        "parts of what bounds allow that poses need: second order %.3f of shifts, %.3f of turns; "
        "third order %.3f, %.3f\n",
        need[0], need[1], third[0], third[1]);
    ck_assert(need[0] > 0.95 && need[1] > 0.9 && third[0] > 0.9 && third[1] > 0.1);
    free(model);
}
END_TEST

/* (space-19): a matrix of two rows and columns, both off-diagonal elements of which grow together, needs the loss b c */
START_TEST(singular_values_need_the_loss_of_both_sides) {
    dice d = {73};
    double near = 0;
    for (int n = 0; n < 200; n++) {
        const double value[6] = {
            5, 4.5, 4, 3.5, dice_between(&d, 1, 2), dice_between(&d, 0.3, 0.9)};
        const double b = dice_between(&d, 0, 0.5), c = n % 4 ? dice_between(&d, 0, 0.5) : b;
        stiff J;
        memset(&J, 0, sizeof J);
        J.most[1] = INFINITY;
        for (int i = 0; i < 6; i++) {
            J.row[i][i].c = J.column[i][i] = value[i];
            J.inverse[i][i] = 1 / value[i];
        }
        J.row[4][5].g[n % 6] = b, J.row[5][4].g[n % 6] = c;
        J.row[4][5].varies = J.row[5][4].varies = true;
        stiff_refine(&J, true);
        double least = INFINITY, most = 0;
        for (int i = 0; i < 1000; i++) {
            const double x = cos(i * pi / 1000), y = sin(i * pi / 1000);
            const double size = hypot(value[4] * x + b * y, c * x + value[5] * y);
            least = fmin(least, size), most = fmax(most, size);
        }
        ck_assert_msg(J.least[0] <= least && J.most[1] >= most, "matrix %d of seed 73: %g > %g", n,
                      J.least[0], least);
        near = fmax(near, J.least[0] / least);
    }
    printf("the greatest part of the least value that is certified: %.5f\n", near);
    ck_assert(near > 0.99);
}
END_TEST

/* (space-19): two equal least values, which the box parts in any direction of their plane: a polygon about a circle bounds them */
START_TEST(least_values_that_are_equal_part_in_any_direction) {
    dice d = {76};
    double near = 0;
    for (int n = 0; n < 200; n++) {
        const double value = dice_between(&d, 0.5, 1), size = dice_between(&d, 0.01, 0.2) * value,
                     angle = 2 * pi * n / 200, a = size * cos(angle), b = size * sin(angle);
        const double all[6] = {5, 4.5, 4, 3.5, value, value};
        stiff J;
        memset(&J, 0, sizeof J);
        J.most[1] = INFINITY;
        for (int i = 0; i < 6; i++) {
            J.row[i][i].c = J.column[i][i] = all[i];
            J.inverse[i][i] = 1 / all[i];
        }
        J.row[4][4].g[0] = a, J.row[5][5].g[0] = -a, J.row[4][5].g[0] = J.row[5][4].g[0] = b;
        for (int i = 4; i < 6; i++) J.row[i][4].varies = J.row[i][5].varies = true;
        stiff_refine(&J, false);
        /* the matrix value + size (cos, sin; sin, −cos) has the values value ± size */
        const double least = value - size;
        ck_assert_msg(J.least[0] <= least, "matrix %d of seed 76: %g > %g", n, J.least[0], least);
        near = fmax(near, J.least[0] / least);
    }
    printf("the greatest part of equal least values that is certified: %.5f\n", near);
    ck_assert(near > 0.98);
}
END_TEST

/* (space-13): forces of a flat machine grow without bound as the top sinks, so that all their orders have one sign */
START_TEST(forces_of_a_flat_machine_need_their_third_order) {
    gough_model *model = malloc(sizeof *model);
    gough_error error = {0};
    dice d = {74};
    double need = 0;
    int bounded = 0;
    flight_machine(model);
    const gough_load load = model->machine.load;
    const double gravity[3] = {0, 0, -9.80665};
    for (int n = 0; n < 60; n++) {
        const double height = dice_between(&d, 0.05, 0.2), at[GOUGH_COMPONENTS] = {0};
        const gough_platform p =
            gough_platform_symmetric(2.5, 8 * pi / 180, 1.5, 10 * pi / 180, height);
        double half[GOUGH_COMPONENTS] = {0, 0, height * dice_between(&d, 0.2, 0.7), 0, 0, 0};
        if (n % 3 == 0) half[GOUGH_ROLL] = half[GOUGH_PITCH] = 0.02 * height;
        ck_assert_msg(gough_machine_init(&model->machine, &p, &load, gravity, &error) == GOUGH_OK,
                      "%s", error.message);
        const gough_box box = box_about(at, half);
        const gough_reach reach = flight_reach(model);
        const asked_parts parts = {true, false};
        taylor_vector way[LEGS];
        asked_of_leg asked[LEGS];
        space s;
        box_view view;
        stiff J;
        space_begin(&s, &reach);
        box_view_of(&s, &box, &view);
        for (int v = 0; v < LEGS; v++) way[v] = box_direction(&view, v);
        stiff_of(&s, &view, way, &J);
        if (stiff_side(&J) == 0) continue;
        asked_of(&s, &view, way, &J, parts, asked);
        bounded++;
        for (int i = 0; i < 8; i++) {
            double pose[GOUGH_COMPONENTS];
            flight_load one;
            flight_pick(&box, true, &d, pose);
            flight_draw(model, pose, true, &d, &one);
            for (int v = 0; v < LEGS; v++) {
                ck_assert_msg(one.force[v] <= asked[v].push.most &&
                                  -one.force[v] <= asked[v].pull.most,
                              "machine %d of seed 74: %g is not in %g to %g", n, one.force[v],
                              -asked[v].pull.most, asked[v].push.most);
                need = fmax(need, one.force[v] / asked[v].push.most);
            }
        }
    }
    printf("%d boxes, the greatest part of a bound that a force needs: %.3f\n", bounded, need);
    ck_assert(bounded > 20 && need > 0.6);
    free(model);
}
END_TEST

/* (space-21): with slopes and a rest, what is certainly outside, and certainly inside, is what points of the box say */
START_TEST(rests_count_against_parts_of_boxes) {
    dice d = {75};
    judge j = judge_begin();
    const taylor plain = {.g = {1}, .r = 0.25, .varies = true};
    /* in a quarter of the box on either side of the plane, the rest decides */
    judge_slope(&j, &plain, 0, 0, 1, GOUGH_BIND_LONGEST, 0);
    ck_assert(fabs(j.out - 0.375) < 1e-7 && fabs(j.in - 0.375) < 1e-7);
    for (int n = 0; n < 60; n++) {
        const double low = n % 2 ? dice_between(&d, 0, 0.2) : 0, high = n % 2 ? low * 0.5 : 0;
        enum { POINTS = 4000 };
        taylor m = taylor_of(dice_between(&d, -0.5, 0.5));
        int below = 0, above = 0;
        for (int k = 0; k < 4; k++) m.g[k] = dice_between(&d, -0.5, 0.5);
        m.r = dice_between(&d, 0, 0.2), m.varies = true;
        if (!(taylor_least(&m) - low < 0 && taylor_most(&m) - high > 0)) continue;
        for (int i = 0; i < POINTS; i++) {
            double x = m.c;
            for (int k = 0; k < 3; k++) x += m.g[k] * dice_between(&d, -1, 1);
            below += x + m.r + fabs(m.g[3]) < high;
            above += x - m.r - fabs(m.g[3]) > low;
        }
        j = judge_begin();
        judge_slope(&j, &m, low, high, 1, GOUGH_BIND_LONGEST, 0);
        ck_assert_msg(fabs(j.out - 1.0 * below / POINTS) < 0.035 &&
                          fabs(j.in - 1.0 * above / POINTS) < 0.035,
                      "limit %d of seed 75: %g is not %g, or %g is not %g", n, j.out,
                      1.0 * below / POINTS, j.in, 1.0 * above / POINTS);
    }
}
END_TEST

/* ---- (space-18): a leg is shortest where the yaw brings its top joint over its base joint. Legs 1, 3 and 5 have this yaw at
 * one side of home, legs 2, 4 and 6 at the other side. ---- */

static const double HEIGHT = 1, BASE = 1, TOP = 0.7, TWIST = 25;

static void twisted_machine(gough_model *model) {
    const gough_platform p =
        gough_platform_symmetric(BASE, 20 * pi / 180, TOP, 15 * pi / 180, HEIGHT);
    const gough_load load = {.mass = 1, .inertia = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    const double gravity[3] = {0, 0, -1};
    gough_error error = {0};
    memset(model, 0, sizeof *model);
    ck_assert_msg(gough_machine_init(&model->machine, &p, &load, gravity, &error) == GOUGH_OK, "%s",
                  error.message);
}

static void search_yaw(const gough_model *model, const double yaw[2], double depth, size_t tests,
                       gough_envelope *e) {
    gough_reach reach = flight_reach(model);
    const double twist = TWIST * pi / 180; /* from base joint 1 to top joint 1 at home */
    const gough_box box = {{0, 0, -depth, 0, 0, yaw[0] * twist},
                           {0, 0, depth, 0, 0, yaw[1] * twist}};
    reach.most_tests = tests;
    /* forces may have no bound after so few boxes; the other values have one */
    ck_assert(gough_workspace_envelope(&reach, &box, e, NULL) != GOUGH_ERROR_INPUT);
}

/* steps lead to the worst pose, although no box is split and the pose is near neither a corner nor the centre */
START_TEST(steps_find_a_worst_pose_between_corners) {
    gough_model *model = malloc(sizeof *model);
    twisted_machine(model);
    for (int n = 0; n < 6; n++) {
        const double yaw[2] = {-0.2 + 0.05 * n, 1.5 + 0.07 * n}, shortest = hypot(0.9, BASE - TOP);
        gough_envelope e;
        search_yaw(model, yaw, 0.1, 16, &e);
        const gough_extreme *x = &e.of[GOUGH_WORST_SHORTEST];
        ck_assert_msg(fabs(x->sampled - shortest) < 1e-6 * shortest, "%.9g is not %.9g", x->sampled,
                      shortest);
        ck_assert(x->bound <= shortest);
    }
    free(model);
}
END_TEST

/* no step leads from the worst corner to the worst pose; the bound holds there, as the box with the worst bound is split first */
START_TEST(boxes_find_a_worst_pose_that_steps_miss) {
    gough_model *model = malloc(sizeof *model);
    twisted_machine(model);
    for (int n = 0; n < 6; n++) {
        const double yaw[2] = {-2.3 - 0.03 * n, 0.85}, shortest = hypot(HEIGHT, BASE - TOP);
        gough_envelope e;
        search_yaw(model, yaw, 0, 16, &e);
        const gough_extreme *x = &e.of[GOUGH_WORST_SHORTEST];
        ck_assert(x->sampled > shortest * (1 + 1e-3) && x->bound < shortest);
        search_yaw(model, yaw, 0, 16 * 120, &e);
        ck_assert_msg(x->bound <= shortest && x->bound > shortest * (1 - 1.2e-4),
                      "box %d: %.9g is no bound near %.9g", n, x->bound, shortest);
        printf("box %d: %.9g, %.9g, %.9g\n", n, x->bound, shortest, x->sampled);
    }
    free(model);
}
END_TEST

int main(void) {
    return SUITE_RUN(
        "wide", 60, angles_about_almost_the_same_axis_add_up,
        lengths_of_wide_boxes_need_their_second_order, singular_values_need_the_loss_of_both_sides,
        least_values_that_are_equal_part_in_any_direction,
        forces_of_a_flat_machine_need_their_third_order, rests_count_against_parts_of_boxes,
        steps_find_a_worst_pose_between_corners, boxes_find_a_worst_pose_that_steps_miss);
}
