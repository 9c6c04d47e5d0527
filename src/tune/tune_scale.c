/* The scales of the search: which forces there are to bear, and how fast the loop and the study change. Theory:
 * docs/theory/tuning.md. */
#include <math.h>

#include "tune/tune.h"

/* moments of the run at which forces are looked at */
enum { MOMENTS = 2000 };

/* the noise is hardly ever larger than this times its root mean square */
static const double noise_peak = 4;

static double value_at(const gough_formula *formula, double t) {
    double jet[3];

    gough_formula_evaluate(formula, t, jet);
    return isfinite(jet[0]) ? fabs(jet[0]) : 0;
}

static double largest_of(const double force[GOUGH_LEGS]) {
    double largest = 0;

    for (int v = 0; v < GOUGH_LEGS; v++) largest = fmax(largest, fabs(force[v]));
    return largest;
}

/* What the disturbances add up to, as one force: moments over the base radius. */
static double disturbance_at(const gough_model *model, double t) {
    const gough_disturbance *d = &model->disturbance;
    const double R = model->machine.base_radius;
    double leg = 0, load = value_at(&d->vertical_force, t);

    for (int v = 0; v < GOUGH_LEGS; v++) leg = fmax(leg, value_at(&d->leg_force[v], t));
    for (int i = 0; i < 3; i++) load += value_at(&d->force[i], t) + value_at(&d->moment[i], t) / R;
    return leg + load + noise_peak * (d->noise.leg_force + d->noise.force + d->noise.moment / R);
}

/* The largest force that a leg has to bear: that of the program, weight and inertia, and that of the disturbances. */
static double largest_force(const gough_model *model, double duration) {
    double largest = 0;

    for (int i = 0; i <= MOMENTS; i++) {
        const double t = duration * i / MOMENTS;
        double force[GOUGH_LEGS] = {0}, program = 0;
        gough_acceleration acceleration;
        gough_state state;

        gough_program(&model->machine, &model->motion, t, &state, &acceleration);
        gough_wrench known;
        if (gough_external_wrench(&model->machine, &state, t, &known) == GOUGH_OK &&
            gough_inverse_dynamics(&model->machine, &state, &acceleration, &known, force, NULL) ==
                GOUGH_OK)
            program = largest_of(force);
        largest = fmax(largest, program + disturbance_at(model, t));
    }
    return largest;
}

void tune_find_scales(tune *t) {
    const gough_machine *machine = &t->model->machine;
    const double M = machine->load.mass, R = machine->base_radius;
    const double weight = M * machine->gravity_magnitude, tau = t->simulation.output_step;
    const double force = largest_force(t->model, t->simulation.duration);
    double damping = 0;

    if (!t->ratio) damping = largest_of(t->model->control.damping);
    t->unit = fmax(weight, force) / R;
    /* no force at all: what moves the mass by its own size within the run */
    if (!(t->unit > 0)) t->unit = M / (t->simulation.duration * t->simulation.duration);
    t->settled = fmax(t->unit, fmax(damping / tau, M / (tau * tau)));
    t->furthest = fmax(1e3 * force / t->options->deviation, 1e2 * t->settled);
}
