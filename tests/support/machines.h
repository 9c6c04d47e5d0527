/* Machines and models for tests. Frames and units as in gough/model.h. */
#ifndef TESTS_SUPPORT_MACHINES_H
#define TESTS_SUPPORT_MACHINES_H

#include <check.h>
#include <math.h>
#include <string.h>

#include "gough/model.h"
#include "gough/simulate.h"
#include "support/random.h"

static const double pi = 3.14159265358979323846;

/* The paper's example as a six-axis machine: h = 1, d = 0.7 */
static inline void paper_machine(gough_machine *machine) {
    const double gravity[3] = {0, 0, -1};
    gough_platform platform =
        gough_platform_symmetric(1, 10 * pi / 180, 0.6, 6.4688478326275441 * pi / 180, 1);
    gough_load load = {.mass = 1, .inertia = {{0.08, 0, 0}, {0, 0.08, 0}, {0, 0, 0.15}}};
    gough_error error = {0};

    ck_assert_msg(gough_machine_init(machine, &platform, &load, gravity, &error) == GOUGH_OK, "%s",
                  error.message);
}

/* A load with an offset centre of mass and a full tensor on the same joints as a wider symmetric machine */
static inline void skew_machine(gough_machine *machine) {
    const double gravity[3] = {0.1, -0.05, -1};
    gough_platform platform = gough_platform_symmetric(1, 15 * pi / 180, 0.6, 15 * pi / 180, 1.2);
    gough_load load = {.mass = 1.3,
                       .center_of_mass = {0.05, -0.03, 0.12},
                       .inertia = {{0.11, 0.01, -0.02}, {0.01, 0.14, 0.015}, {-0.02, 0.015, 0.2}}};
    gough_error error = {0};

    ck_assert_msg(gough_machine_init(machine, &platform, &load, gravity, &error) == GOUGH_OK, "%s",
                  error.message);
}

/* legs of different weight, each with another centre of mass, reflected mass and friction; the machine is initialised anew */
enum { LEGS_HEAVY = 1, LEGS_VISCOUS = 2, LEGS_DRY = 4 };

static inline void give_legs(gough_machine *machine, int what, dice *d) {
    gough_platform p = machine->platform;
    const gough_load load = machine->load;
    const double M = load.mass, R = machine->base_radius, g = machine->gravity_magnitude;
    const double speed = sqrt(g * R),
                 gravity[3] = {machine->gravity[0], machine->gravity[1], machine->gravity[2]};
    gough_error error = {0};

    for (int v = 0; v < GOUGH_LEGS; v++) {
        if (what & LEGS_HEAVY) {
            p.cylinder.mass[v] = M * dice_between(d, 0.02, 0.1);
            p.cylinder.center[v] = R * dice_between(d, -0.1, 0.5);
            p.cylinder.inertia[v] = M * R * R * dice_between(d, 0.001, 0.01);
            p.piston.mass[v] = M * dice_between(d, 0.01, 0.06);
            p.piston.center[v] = R * dice_between(d, 0.1, 0.5);
            p.piston.inertia[v] = M * R * R * dice_between(d, 0.001, 0.005);
            p.reflected_mass[v] = M * dice_between(d, 0, 0.3);
        }
        if (what & LEGS_VISCOUS) p.friction.viscous[v] = M * g / speed * dice_between(d, 0.1, 0.5);
        if (!(what & LEGS_DRY)) continue;
        p.friction.coulomb[v] = M * g * dice_between(d, 0.01, 0.03);
        p.friction.breakaway[v] = p.friction.coulomb[v] * dice_between(d, 1, 1.5);
        p.friction.stribeck_speed[v] = speed * dice_between(d, 0.01, 0.03);
        p.friction.smoothing_speed[v] = 0.01 * speed;
        p.friction.efficiency[v] = dice_between(d, 0.7, 1);
    }
    ck_assert_msg(gough_machine_init(machine, &p, &load, gravity, &error) == GOUGH_OK, "%s",
                  error.message);
}

static inline void set_formula(gough_formula *formula, const char *text) {
    gough_error error = {0};

    ck_assert_msg(gough_formula_compile(formula, text, strlen(text), NULL, &error) == GOUGH_OK,
                  "%s: %s", text, error.message);
}

static inline void set_gains(gough_model *model, double stiffness, double damping) {
    for (int v = 0; v < GOUGH_LEGS; v++) {
        model->control.stiffness[v] = stiffness;
        model->control.damping[v] = damping;
    }
}

/* all six axes of the program moving, angles in radians */
static inline void set_all_axes(gough_model *model) {
    static const char *const text[GOUGH_COMPONENTS] = {
        "0.05*sin(t)",     "0.04*sin(1.3*t + 0.4)", "0.1*sin(0.9*t)*(1 - exp(-t/2))",
        "0.08*sin(1.1*t)", "0.06*cos(0.8*t)",       "0.1*sin(0.7*t + 1)"};

    for (int c = 0; c < GOUGH_COMPONENTS; c++) set_formula(&model->motion.formula[c], text[c]);
}

/* a symmetric machine with everything random, for closed forms. Radii R and r, delta the angle between the joints of a leg */
typedef struct {
    double R, r, delta, h, M, g, c;
} symmetric;

static inline symmetric random_symmetric(dice *d, gough_machine *machine) {
    symmetric s = {.R = dice_between(d, 0.5, 2),
                   .h = dice_between(d, 0.4, 2),
                   .M = dice_between(d, 0.5, 1000),
                   .g = dice_between(d, 1, 12),
                   .c = dice_between(d, -0.3, 0.6)};
    const double a = dice_between(d, 2, 28) * pi / 180, b = dice_between(d, 2, 28) * pi / 180;
    const double inertia = s.M * dice_between(d, 0.05, 0.2);
    const double gravity[3] = {0, 0, -s.g};
    gough_platform platform;
    gough_load load = {.mass = s.M, .center_of_mass = {0, 0, s.c}};
    gough_error error = {0};

    s.r = s.R * dice_between(d, 0.3, 0.95);
    s.delta = pi / 3 - a - b;
    platform = gough_platform_symmetric(s.R, a, s.r, b, s.h);
    load.inertia[0][0] = load.inertia[1][1] = inertia;
    load.inertia[2][2] = 1.6 * inertia;
    ck_assert_msg(gough_machine_init(machine, &platform, &load, gravity, &error) == GOUGH_OK, "%s",
                  error.message);
    return s;
}

#endif
