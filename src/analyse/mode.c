/* Modes named by what moves: heave, yaw, sway–tilt … Theory: docs/theory/stability.md. */
#include "analyse/mode.h"

#include <math.h>
#include <string.h>

enum { AXES = 6, KINDS = 4 };

/* sway, heave, tilt or yaw: the kind of motion of each of δr, δθ */
static const int kind_of[AXES] = {0, 0, 1, 2, 2, 3};
static const char *const kind_name[KINDS] = {"sway", "heave", "tilt", "yaw"};

/* a kind of motion with less than this share does not name the mode */
static const double least_share = 1e-3;

/* shares within this of each other count as equal, so that rounding does not choose the phase */
static const double same_share = 1e-9;

/* mass, and the moments of inertia about the axes that are the base's at home */
static double inertia_of(const gough_machine *machine, int axis) {
    return axis < 3 ? machine->load.mass : machine->load.inertia[axis - 3][axis - 3];
}

/* |s_a|² m_a, and their sum: scaled by the largest element first, lest a square vanish or overflow */
static double energies(const gough_machine *machine, const double complex shape[AXES],
                       double energy[AXES]) {
    double largest = 0, sum = 0;

    for (int a = 0; a < AXES; a++) largest = fmax(largest, cabs(shape[a]));
    for (int a = 0; a < AXES; a++) {
        const double size = cabs(shape[a]) / largest;
        energy[a] = size * size * inertia_of(machine, a);
        sum += energy[a];
    }
    return sum;
}

/* the axis with the largest share, the first of those alike */
static int leading(const double energy[AXES]) {
    double largest = 0;
    int a = 0;

    for (int b = 0; b < AXES; b++) largest = fmax(largest, energy[b]);
    while (energy[a] < (1 - same_share) * largest) a++;
    return a;
}

static void name_of(const double share[KINDS], char name[GOUGH_MODE_NAME]) {
    name[0] = '\0';
    for (int k = 0; k < KINDS; k++) {
        if (!(share[k] > least_share)) continue;
        if (name[0] != '\0') strcat(name, "–");
        strcat(name, kind_name[k]);
    }
}

void mode_of(const gough_machine *machine, const double complex shape[6], gough_mode *mode) {
    double energy[AXES];
    const double sum = energies(machine, shape, energy);
    int lead;

    memset(mode, 0, sizeof *mode);
    strcpy(mode->name, "none");
    if (!(sum > 0 && isfinite(sum))) return;

    for (int a = 0; a < AXES; a++) mode->share[kind_of[a]] += energy[a] / sum;
    name_of(mode->share, mode->name);

    lead = leading(energy);
    for (int a = 0; a < AXES; a++) {
        const double complex ratio = shape[a] / shape[lead];
        mode->shape[a][0] = a == lead ? 1 : creal(ratio);
        mode->shape[a][1] = a == lead ? 0 : cimag(ratio);
    }
}
