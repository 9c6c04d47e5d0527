/* The machine and the runs that all figures are taken from. */
#include "bench/reference.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gough/gough.h"

static const double degree = 3.14159265358979323846 / 180;

static void must(gough_status status, const gough_error *error) {
    if (status == GOUGH_OK) return;
    fprintf(stderr, "bench: %s\n", error->message);
    exit(70);
}

static void give_mass(gough_platform *p) {
    for (int v = 0; v < GOUGH_LEGS; v++) {
        p->cylinder.mass[v] = 0.05;
        p->cylinder.center[v] = 0.35;
        p->cylinder.inertia[v] = 0.002;
        p->piston.mass[v] = 0.03;
        p->piston.center[v] = 0.35;
        p->piston.inertia[v] = 0.0012;
        p->reflected_mass[v] = 0.1;
    }
}

static void make_model(gough_model *model, bool heavy) {
    static const char heave[] = "0.2*sin(t)*(1 - exp(-t/2))^2";
    static const double off[GOUGH_COMPONENTS] = {0.02, -0.015, 0.01, 0.03, -0.02, 0.04};
    const double gravity[3] = {0, 0, -1};
    gough_platform platform = gough_platform_symmetric(1, 15 * degree, 0.6, 15 * degree, 1.2);
    const gough_load load = {.mass = 1, .inertia = {{0.08, 0, 0}, {0, 0.08, 0}, {0, 0, 0.15}}};
    gough_error error = {0};

    memset(model, 0, sizeof *model);
    if (heavy) give_mass(&platform);
    must(gough_machine_init(&model->machine, &platform, &load, gravity, &error), &error);
    must(gough_formula_compile(&model->motion.formula[GOUGH_HEAVE], heave, sizeof heave - 1, NULL,
                               &error),
         &error);
    model->control.feedforward = true;
    for (int v = 0; v < GOUGH_LEGS; v++) model->control.stiffness[v] = 50;
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        model->initial.given[c] = true;
        model->initial.component[c] = off[c];
    }
}

static int keep_last(void *context, const gough_row *row) {
    memcpy(context, row->value, sizeof row->value);
    return 0;
}

static void simulate(const reference *r, const gough_simulation *s, double row[GOUGH_COLUMNS]) {
    gough_error error = {0};
    gough_end end;

    must(gough_simulate(&r->model, s, keep_last, row, &end, &error), &error);
}

void reference_begin(reference *r, double duration, bool heavy) {
    gough_simulation s;
    double row[GOUGH_COLUMNS];

    make_model(&r->model, heavy);
    r->duration = duration;
    for (int i = 0; i < REFERENCE_RUNS; i++) {
        r->initial[i] = r->model.initial;
        for (int c = 0; c < GOUGH_COMPONENTS; c++) {
            r->initial[i].component[c] *=
                1 + 0.5 * gough_random_uniform(1, (uint64_t)i, (uint64_t)c);
        }
        if (i == 0) r->initial[i] = r->model.initial;
        r->run[i] = (gough_batch_run){.machine = &r->model.machine,
                                      .control = &r->model.control,
                                      .disturbance = &r->model.disturbance,
                                      .initial = &r->initial[i]};
    }
    s = reference_simulation(r, GOUGH_DOP853, 0, 1e-15);
    s.precision = GOUGH_QUADRUPLE;
    simulate(r, &s, row);
    memcpy(r->position, row + GOUGH_X, sizeof r->position);
    memcpy(r->angles, row + GOUGH_ROLL_ANGLE, sizeof r->angles);
    gough_rotation_from_angles(r->angles, r->rotation);
}

double reference_error(const reference *r, const double position[3], const double angles[3]) {
    double worst = 0;

    for (int c = 0; c < 3; c++) {
        const double a = fabs(position[c] - r->position[c]), b = fabs(angles[c] - r->angles[c]);
        if (!(a <= worst)) worst = a;
        if (!(b <= worst)) worst = b;
    }
    return worst;
}

double reference_error_matrix(const reference *r, const double position[3], double rotation[3][3]) {
    double angles[3];

    gough_angles_from_rotation(rotation, angles);
    return reference_error(r, position, angles);
}

gough_simulation reference_simulation(const reference *r, gough_method method, long n,
                                      double tolerance) {
    gough_simulation s = gough_simulation_default();

    s.duration = s.output_step = r->duration;
    s.method = method;
    s.tolerance = tolerance;
    s.step = 0;
    if (n > 0) {
        /* rows about each 0.05, or each step where those are longer */
        long steps = (long)floor(0.05 * (double)n / r->duration);
        if (steps < 1) steps = 1;
        const long rows = (n + steps - 1) / steps;
        s.output_step = r->duration / (double)rows;
        s.step = s.output_step / (double)steps;
    }
    return s;
}

gough_simulation reference_rows(const reference *r, gough_method method, double step) {
    gough_simulation s = gough_simulation_default();

    s.duration = r->duration;
    s.output_step = 0.05;
    s.method = method;
    s.step = step;
    return s;
}

double reference_alone(const reference *r, const gough_simulation *s) {
    double row[GOUGH_COLUMNS];

    simulate(r, s, row);
    return reference_error(r, row + GOUGH_X, row + GOUGH_ROLL_ANGLE);
}
