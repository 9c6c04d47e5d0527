/* Forces at the joints of the legs and what holds them at rest: balances of whole bodies, legs without mass, slow motion either
 * way. tests/independent/test_thirteen_bodies.c has the same forces from another formulation. */
#include "gough/dynamics.h"
#include "support/machines.h"
#include "support/suite.h"

static const double g = 9.80665;

/* a symmetric machine with six legs of their own */
static gough_machine heavy_machine(bool mass, bool rough) {
    const double gravity[3] = {0, 0, -9.80665};
    gough_load load = {.mass = 1050,
                       .center_of_mass = {0.12, -0.04, 0.55},
                       .inertia = {{410, 8, -35}, {8, 520, 12}, {-35, 12, 460}}};
    gough_platform p = gough_platform_symmetric(1.5, 0.14, 1.1, 0.14, 2.0);
    gough_error error = {.message = ""};
    gough_machine machine;

    for (int v = 0; v < GOUGH_LEGS; v++) {
        if (mass) {
            p.cylinder.mass[v] = 50 + 5 * v;
            p.cylinder.center[v] = 0.5 + 0.02 * v;
            p.cylinder.inertia[v] = 7;
            p.piston.mass[v] = 30 - v;
            p.piston.center[v] = 0.7;
            p.piston.inertia[v] = 5;
            p.reflected_mass[v] = 140;
        }
        if (rough) {
            p.friction.coulomb[v] = 100 + 10 * v;
            p.friction.breakaway[v] = 180 + 5 * v;
            p.friction.stribeck_speed[v] = 10;
            p.friction.smoothing_speed[v] = 1e-9;
            p.friction.efficiency[v] = 0.4 + 0.1 * v;
        }
    }
    ck_assert_msg(gough_machine_init(&machine, &p, &load, gravity, &error) == GOUGH_OK, "%s",
                  error.message);
    return machine;
}

static gough_state tilted(const gough_machine *machine) {
    const double angles[3] = {0.1, -0.15, 0.2};
    gough_state s = gough_state_home(machine);

    s.position[0] = 0.1;
    s.position[2] += 0.05;
    gough_rotation_from_angles(angles, s.rotation);
    return s;
}

/* at rest the top joints bear the load, those of the base all that stands on them; about the origin of the base too */
START_TEST(joints_bear_the_weight) {
    const gough_machine machine = heavy_machine(true, true);
    const gough_acceleration none = {{0, 0, 0}, {0, 0, 0}};
    const gough_state s = tilted(&machine);
    double leg[6], top[6][3], base[6][3], side[6], length[6];
    double on_top[3] = {0, 0, 0}, on_base[3] = {0, 0, 0}, about[3] = {0, 0, 0}, weight = 1050 * g;

    ck_assert_int_eq(gough_joint_forces(&machine, &s, &none, NULL, leg, top, base, side), GOUGH_OK);
    gough_leg_kinematics(&machine, &s, NULL, length, NULL, NULL);
    for (int v = 0; v < 6; v++) {
        const gough_platform *p = &machine.platform;
        const double *b = p->base[v];
        double joint[3], n[3];
        for (int r = 0; r < 3; r++) {
            joint[r] = s.position[r];
            for (int c = 0; c < 3; c++) joint[r] += s.rotation[r][c] * p->top[v][c];
            n[r] = (joint[r] - b[r]) / length[v];
            on_top[r] += top[v][r];
            on_base[r] += base[v][r];
        }
        weight += (p->cylinder.mass[v] + p->piston.mass[v]) * g;
        /* moments about the base joint of all that the leg bears: −top force, and its own weight */
        const double lever = p->cylinder.mass[v] * p->cylinder.center[v] +
                             p->piston.mass[v] * (length[v] - p->piston.center[v]);
        about[0] = n[1] * lever * -g - length[v] * (n[1] * top[v][2] - n[2] * top[v][1]);
        about[1] = -n[0] * lever * -g - length[v] * (n[2] * top[v][0] - n[0] * top[v][2]);
        about[2] = -length[v] * (n[0] * top[v][1] - n[1] * top[v][0]);
        for (int r = 0; r < 3; r++) ck_assert(fabs(about[r]) <= 1e-9);
        /* what the guides give the piston holds its own weight and what the top does to it across the leg */
        const double across = p->piston.mass[v] * g;
        double force[3] = {top[v][0], top[v][1], top[v][2] + across}, along = 0, sum = 0;
        for (int r = 0; r < 3; r++) along += force[r] * n[r];
        for (int r = 0; r < 3; r++) sum += pow(force[r] - along * n[r], 2);
        ck_assert(fabs(side[v] - sqrt(sum)) <= 1e-9 && side[v] > 1);
    }
    for (int r = 0; r < 3; r++) {
        ck_assert(fabs(on_top[r] - (r == 2 ? 1050 * g : 0)) <= 1e-9);
        ck_assert(fabs(on_base[r] - (r == 2 ? weight : 0)) <= 1e-9);
    }
}
END_TEST

/* without mass, both ends bear the leg force along the leg, whatever the motion; the drive gives friction besides */
START_TEST(legs_without_mass_push_along_themselves) {
    const gough_acceleration a = {{1, -2, 3}, {0.4, 0.5, -0.6}};
    const gough_wrench external = {{100, 200, -300}, {50, 60, 70}};

    for (int rough = 0; rough < 2; rough++) {
        const gough_machine machine = heavy_machine(false, rough), smooth = heavy_machine(false, 0);
        gough_state s = tilted(&machine);
        double leg[6], top[6][3], base[6][3], side[6], force[6], J[6][6];
        s.velocity[0] = 0.3;
        s.angular_velocity[1] = 0.4;
        ck_assert_int_eq(gough_joint_forces(&machine, &s, &a, &external, leg, top, base, side),
                         GOUGH_OK);
        ck_assert_int_eq(gough_inverse_dynamics(&smooth, &s, &a, &external, force, NULL), GOUGH_OK);
        gough_jacobian(&machine, &s, J);
        for (int v = 0; v < 6; v++) {
            ck_assert(!(fabs(leg[v] - force[v]) > 1e-12 * fabs(force[v])) && !(side[v] > 0));
            for (int r = 0; r < 3; r++) {
                ck_assert(fabs(top[v][r] - force[v] * J[v][r]) <= 1e-9);
                ck_assert(fabs(base[v][r] - top[v][r]) <= 0);
            }
        }
    }
}
END_TEST

/* what moves the legs slowly up and down, with friction at its most, is where they begin to move */
START_TEST(slow_motion_begins_where_holding_ends) {
    const gough_machine machine = heavy_machine(true, true), smooth = heavy_machine(true, false);
    const gough_acceleration none = {{0, 0, 0}, {0, 0, 0}};
    gough_state s = gough_state_home(&machine);
    double force[6], low[6], high[6], up[6], down[6], still[6];

    s.velocity[1] = 7; /* is not looked at */
    ck_assert_int_eq(gough_holding_forces(&machine, &s, NULL, force, low, high), GOUGH_OK);
    ck_assert_int_eq(gough_holding_forces(&machine, &s, NULL, force, NULL, NULL), GOUGH_OK);
    s.velocity[1] = 0;
    s.velocity[2] = 1e-5;
    ck_assert_int_eq(gough_inverse_dynamics(&machine, &s, &none, NULL, up, NULL), GOUGH_OK);
    s.velocity[2] = -1e-5;
    ck_assert_int_eq(gough_inverse_dynamics(&machine, &s, &none, NULL, down, NULL), GOUGH_OK);
    s.velocity[2] = 0;
    ck_assert_int_eq(gough_inverse_dynamics(&smooth, &s, &none, NULL, still, NULL), GOUGH_OK);
    for (int v = 0; v < 6; v++) {
        ck_assert(fabs(force[v] - still[v]) <= 1e-9);
        ck_assert(fabs(up[v] - high[v]) <= 1e-4 && fabs(down[v] - low[v]) <= 1e-4);
        /* screws of an efficiency up to a half hold the load by themselves */
        ck_assert((low[v] < 0) == (v < 2) && high[v] > force[v]);
    }
}
END_TEST

START_TEST(poses_that_carry_nothing_are_refused) {
    const gough_machine machine = heavy_machine(true, true);
    const gough_acceleration none = {{0, 0, 0}, {0, 0, 0}};
    const double quarter[3] = {0, 0, 1.5707963267948966};
    gough_state s = gough_state_home(&machine);
    double leg[6], low[6], high[6];

    gough_rotation_from_angles(
        quarter, s.rotation); /* legs of the symmetric machine in line with the others */
    ck_assert_int_eq(gough_joint_forces(&machine, &s, &none, NULL, leg, NULL, NULL, NULL),
                     GOUGH_ERROR_NUMERICAL);
    ck_assert_int_eq(gough_holding_forces(&machine, &s, NULL, leg, low, high),
                     GOUGH_ERROR_NUMERICAL);
    s.rotation[0][0] += 1;
    leg[0] = low[0] = high[0] = 7;
    ck_assert_int_eq(gough_joint_forces(&machine, &s, &none, NULL, leg, NULL, NULL, NULL),
                     GOUGH_ERROR_INPUT);
    ck_assert_int_eq(gough_holding_forces(&machine, &s, NULL, leg, low, high), GOUGH_ERROR_INPUT);
    ck_assert(leg[0] >= 7 && leg[0] <= 7 && low[0] >= 7 && low[0] <= 7);
}
END_TEST

int main(void) {
    return SUITE_RUN("plant/joints", 60, joints_bear_the_weight,
                     legs_without_mass_push_along_themselves, slow_motion_begins_where_holding_ends,
                     poses_that_carry_nothing_are_refused);
}
