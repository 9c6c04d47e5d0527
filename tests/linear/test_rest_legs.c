/* The loop at rest with legs that have mass: the trace theorem, and a machine worked out by hand. */
#include <stdio.h>

#include "gough/linear.h"
#include "linear/planes.h"
#include "linear/rest_model.h"
#include "support/machines.h"
#include "support/suite.h"

enum { GEOMETRIES = 100 };

/* closed forms of the theory against what is found, relative to the largest number of the kind */
static const double closed = 1e-10;

/* (mass-16): what of the legs' mass hangs on the top counts as load */
START_TEST(trace_theorem_holds_with_legs_that_have_mass) {
    dice d = {3};
    gough_model *model = new_model(0.1, 0);
    int tried = 0;

    for (int k = 0; k < GEOMETRIES; k++) {
        double h, mass, l[GOUGH_LEGS];
        gough_state home;
        gough_rest rest;

        if (!random_machine(&d, &model->machine, &h)) continue;
        give_legs(&model->machine, LEGS_HEAVY, &d);
        tried++;
        const gough_platform *p = &model->machine.platform;
        home = gough_state_home(&model->machine);
        gough_leg_kinematics(&model->machine, &home, NULL, l, NULL, NULL);
        mass = model->machine.load.mass;
        for (int v = 0; v < GOUGH_LEGS; v++) {
            mass += (p->cylinder.mass[v] * p->cylinder.center[v] +
                     p->piston.mass[v] * (l[v] - p->piston.center[v])) /
                    l[v];
        }
        const double right = -2 * mass * model->machine.gravity_magnitude / h;
        rest = at_rest(model, NULL);
        near(rest.trace_theorem, right, -1e-13 * right, "the theorem", k);
        near(rest.trace, right, -closed * right, "the trace", k);
        ck_assert(rest.asymmetry < closed);
    }
    ck_assert_int_gt(tried, GEOMETRIES / 4);
    free(model);
}
END_TEST

/* a machine worked out by hand: R = 1, r = 0.6, 40° between the joints of a leg, h = 1; digits to the last */
static void sample_machine(gough_machine *machine, double part, double reflected) {
    gough_platform p = gough_platform_symmetric(1, 10 * pi / 180, 0.6, 10 * pi / 180, 1);
    const double gravity[3] = {0, 0, -1};
    gough_load load = {.mass = 1,
                       .center_of_mass = {0, 0, 0.2},
                       .inertia = {{0.12, 0, 0}, {0, 0.12, 0}, {0, 0, 0.18}}};

    for (int v = 0; v < GOUGH_LEGS; v++) {
        p.cylinder.mass[v] = 0.05 * part;
        p.cylinder.inertia[v] = 0.002 * part;
        p.piston.mass[v] = 0.03 * part;
        p.piston.inertia[v] = 0.0012 * part;
        p.cylinder.center[v] = p.piston.center[v] = 0.35;
        p.reflected_mass[v] = reflected;
    }
    ck_assert_int_eq(gough_machine_init(machine, &p, &load, gravity, NULL), GOUGH_OK);
}

START_TEST(a_machine_with_legs_has_the_digits_worked_out_for_it) {
    static const struct {
        double part, reflected, force, least[3], square[4];
    } sample[] = {
        {0,
         0,
         0.200051845,
         {0.0734578, 0.5753337, 1.0671475},
         {0.3059155, 0.6926334, 1.9799234, 3.0926561}},
        {1,
         0,
         0.238202586,
         {0.0928186, 0.6909296, 1.2774677},
         {0.3319543, 0.7322642, 1.8467974, 2.6199482}},
        {1,
         0.2,
         0.238202586,
         {0.0928186, 0.6909296, 1.2774677},
         {0.1935283, 0.5810715, 1.203452, 1.48348}},
    };
    gough_model *model = new_model(0, 0);

    for (int k = 0; k < 3; k++) {
        sample_machine(&model->machine, sample[k].part, sample[k].reflected);
        const gough_rest rest = at_rest(model, NULL);
        for (int v = 0; v < GOUGH_LEGS; v++)
            near(rest.force[v], sample[k].force, 6e-10, "force", k);
        /* falling: twice sway and tilt, yaw, twice the other sway and tilt, heave */
        const int which[3] = {5, 2, 0};
        for (int i = 0; i < 3; i++)
            near(rest.threshold[which[i]].stiffness, sample[k].least[i], 6e-8, "least G", k);
        static const int growing[4] = {5, 4, 2, 1};
        for (int i = 0; i < 4; i++) {
            const double rate = rest.eigenvalue[growing[i]].value[0];
            near(rate * rate, sample[k].square[i], 6e-8, "square of a growth rate", k);
        }
    }
    free(model);
}
END_TEST

int main(void) {
    return SUITE_RUN("rest_legs", 60, trace_theorem_holds_with_legs_that_have_mass,
                     a_machine_with_legs_has_the_digits_worked_out_for_it);
}
