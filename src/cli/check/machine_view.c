/* The machine at home: principal moments, singular values of the scaled Jacobian (legs-5). */
#include "cli/check/machine_view.h"
#include "cli/check/singular_values.h"

#include <math.h>

static double distance(const double a[3], const double b[3]) {
    return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                (a[2] - b[2]) * (a[2] - b[2]));
}

static void view_jacobian(const gough_machine *machine, machine_view *view) {
    const gough_state home = gough_state_home(machine);
    double A[6][6], V[6][6], value[6];
    gough_jacobian(machine, &home, A);
    for (int i = 0; i < 6; i++)
        for (int j = 3; j < 6; j++) A[i][j] /= view->arm;
    singular_values(A, V, value);

    int least = 0;
    for (int j = 1; j < 6; j++)
        if (value[j] < value[least]) least = j;
    view->least_singular = value[least];
    for (int i = 0; i < 6; i++) view->weakest[i] = V[i][least];

    /* moment columns were divided by the arm: three of them */
    gough_conditioning(machine, &home, &view->condition, &view->determinant);
    view->determinant *= view->arm * view->arm * view->arm;
}

/* S = [m₁c₁ + m₂(l − c₂)]/l of each leg, (mass-1) */
static void view_legs(const gough_machine *machine, machine_view *view) {
    const gough_leg_part *first = &machine->platform.cylinder, *second = &machine->platform.piston;
    for (int v = 0; v < GOUGH_LEGS; v++) {
        const double l = machine->home_length[v];
        view->leg_mass += first->mass[v] + second->mass[v];
        view->hanging +=
            (first->mass[v] * first->center[v] + second->mass[v] * (l - second->center[v])) / l;
    }
}

machine_view machine_view_of(const gough_machine *machine) {
    const gough_platform *platform = &machine->platform;
    machine_view view = {0};
    double centroid[3] = {0};
    for (int i = 0; i < GOUGH_LEGS; i++)
        for (int c = 0; c < 3; c++) centroid[c] += platform->top[i][c] / GOUGH_LEGS;
    for (int i = 0; i < GOUGH_LEGS; i++) {
        view.arm += distance(platform->top[i], (double[3]){0}) / GOUGH_LEGS;
        view.top_radius += distance(platform->top[i], centroid) / GOUGH_LEGS;
    }
    view_jacobian(machine, &view);
    view_legs(machine, &view);

    /* J_x = I_y + I_z and so on (body-2) */
    const double *I = machine->second_moments;
    for (int c = 0; c < 3; c++) view.moments[c] = I[(c + 1) % 3] + I[(c + 2) % 3];
    view.time_unit = machine->gravity_magnitude > 0
                         ? sqrt(machine->base_radius / machine->gravity_magnitude)
                         : NAN;
    return view;
}
