/* The verdict on a loop at rest, M̄ẍ + C ẋ + K x = 0, by the inertia of K: as C is not negative, as many eigenvalues λ grow as
 * K has negative ones, whatever the damping. Eigenvalues λ of a strongly damped loop differ so much in size that their signs
 * could not tell. Theory: docs/theory/stability.md. */
#include "linear/verdict.h"

#include <math.h>
#include <string.h>

#include "linear/mode.h"

/* a sum of stiffness and damping, each over its largest value, below this has neither */
static const double nothing = 1e-13;

/* real parts below this part of the largest |λ| are rounding */
static const double rounding = 1e-12;

/* values this close, relative to the largest, are one */
static const double same_value = 1e-9;

static void name_modes(const gough_machine *machine, int count, const double *value, double largest,
                       double complex shape[FREEDOMS][6], gough_rest *rest) {
    double complex at[FREEDOMS] = {0};

    for (int k = 0; k < count; k++) at[k] = value[k];
    mode_separate(machine, count, at, same_value * largest, shape);
    for (int k = 0; k < count; k++) mode_of(machine, shape[k], &rest->neutral_mode[k]);
}

/* The freedoms in which neither springs nor dampers act: the null space of K/‖K‖ + C/‖C‖, both not negative. */
static bool find_drift(const gough_machine *machine, const double *mass,
                       double K[FREEDOMS][FREEDOMS], double C[FREEDOMS][FREEDOMS],
                       const double size[2], gough_rest *rest) {
    double sum[FREEDOMS][FREEDOMS], sigma[FREEDOMS], largest;
    double complex shape[FREEDOMS][6];

    for (int i = 0; i < FREEDOMS; i++) {
        for (int j = 0; j < FREEDOMS; j++)
            sum[i][j] =
                (size[0] > 0 ? K[i][j] / size[0] : 0) + (size[1] > 0 ? C[i][j] / size[1] : 0);
    }
    largest = symmetric_problem(sum[0], mass, sigma, shape);
    if (largest < 0) return false;
    for (int k = 0; k < rest->neutral; k++) rest->drifting += sigma[k] <= nothing;
    if (rest->drifting > 0) name_modes(machine, rest->drifting, sigma, 1, shape, rest);
    return true;
}

static bool has_decay(const gough_rest *rest, const double damping[FREEDOMS], double most) {
    double largest = 0;

    if (rest->growing > 0 || rest->neutral > 0 || !(most > 0)) return false;
    for (int k = 0; k < GOUGH_LINEAR; k++) {
        const double *value = rest->eigenvalue[k].value;
        largest = fmax(largest, hypot(value[0], value[1]));
    }
    return damping[0] > nothing * most || rest->growth < -rounding * largest;
}

bool verdict_at_rest(const gough_machine *machine, const double *mass, double K[FREEDOMS][FREEDOMS],
                     double C[FREEDOMS][FREEDOMS], gough_rest *rest) {
    double kappa[FREEDOMS], damping[FREEDOMS], size[2];
    double complex shape[FREEDOMS][6], other[FREEDOMS][6];
    const double unit = machine->gravity_magnitude / machine->base_radius;

    size[0] = symmetric_problem(K[0], mass, kappa, shape);
    size[1] = symmetric_problem(C[0], mass, damping, other);
    if (size[0] < 0 || size[1] < 0) return false;

    rest->growing = rest->neutral = rest->drifting = 0;
    for (int k = 0; k < FREEDOMS; k++) {
        const bool falls = kappa[k] < -GOUGH_GROWTH_LIMIT * GOUGH_GROWTH_LIMIT * unit;
        rest->growing += falls;
        rest->neutral += !falls && !(kappa[k] > 0);
    }
    if (rest->neutral > 0)
        name_modes(machine, rest->neutral, kappa + rest->growing, size[0], shape + rest->growing,
                   rest);
    if (rest->neutral > 0 && rest->growing == 0 && !find_drift(machine, mass, K, C, size, rest)) {
        return false;
    }
    for (int k = rest->growing; k < GOUGH_LINEAR; k++) {
        double *value = rest->eigenvalue[k].value;
        if (value[0] > 0) value[0] = 0;
    }
    rest->growth = rest->eigenvalue[0].value[0];
    rest->stable = rest->growing == 0 && rest->drifting == 0;
    rest->decaying = has_decay(rest, damping, size[1]);
    return true;
}

void verdict_by_eigenvalues(const gough_machine *machine, gough_rest *rest) {
    const double unit = sqrt(machine->gravity_magnitude / machine->base_radius);
    double largest = 0;
    bool decays = true;

    for (size_t k = 0; k < rest->size; k++)
        largest = fmax(largest, hypot(rest->eigenvalue[k].value[0], rest->eigenvalue[k].value[1]));
    const double limit = fmax(GOUGH_GROWTH_LIMIT * unit, rounding * largest);
    rest->growing = rest->neutral = rest->drifting = 0;
    for (size_t k = 0; k < rest->size; k++) {
        gough_eigenvalue *e = &rest->eigenvalue[k];
        if (e->value[0] > limit) {
            rest->growing++;
            continue;
        }
        if (rest->neutral < FREEDOMS && hypot(e->value[0], e->value[1]) <= limit)
            rest->neutral_mode[rest->neutral++] = e->mode;
        decays = decays && e->value[0] < -rounding * largest;
        if (e->value[0] > 0) e->value[0] = 0;
    }
    rest->growth = rest->eigenvalue[0].value[0];
    rest->stable = rest->growing == 0;
    rest->decaying = rest->growing == 0 && rest->neutral == 0 && decays;
}
