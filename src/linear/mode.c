/* Modes named by what moves: heave, yaw, sway–tilt … Theory: docs/theory/stability.md. */
#include "linear/mode.h"

#include <lapacke.h>
#include <math.h>
#include <string.h>

#include "base/assert.h"

enum { AXES = 6, KINDS = 4, MOST_SHAPES = GOUGH_LINEAR_MOST, WORK = 256 };

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
        mode->shape[a][0] = a == lead ? 1 : creal(ratio) + 0; /* no minus zero */
        mode->shape[a][1] = a == lead ? 0 : cimag(ratio) + 0;
    }
}

/* Numbers by which the axes are told apart, all different. Surge and pitch, sway and roll, which go together in a machine with
 * a plane of symmetry, lie on two sides of a gap. */
static const double mark[AXES] = {1, 2, 3, 2.25, 1.25, 4};

/* shapes that depend on each other to this extent span no space that could be told: eigenvalues of a defective matrix */
static const double least_independence = 1e-5;

/* (stab-16) as a form: Σ m_a p_a x̄_a y_a, p = 1 or the marks */
static double complex form(const gough_machine *machine, const double complex x[AXES],
                           const double complex y[AXES], const double *p) {
    double complex sum = 0;

    for (int a = 0; a < AXES; a++) {
        sum += inertia_of(machine, a) * (p != NULL ? p[a] : 1) * conj(x[a]) * y[a];
    }
    return sum;
}

/* Each shape of the space divided by its norm, and by columns the two forms between them. */
static void forms_of(const gough_machine *machine, int n, double complex (*x)[AXES],
                     double complex *marked, double complex *plain) {
    for (int i = 0; i < n; i++) {
        const double norm = sqrt(creal(form(machine, x[i], x[i], NULL)));
        for (int a = 0; a < AXES; a++) x[i][a] /= norm;
    }
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++) {
            marked[i + n * j] = form(machine, x[i], x[j], mark);
            plain[i + n * j] = form(machine, x[i], x[j], NULL);
        }
    }
}

/* the shapes of one space: those that make the form with the marks diagonal too */
static void separate_space(const gough_machine *machine, int n, double complex (*x)[AXES]) {
    double complex marked[AXES * AXES], plain[AXES * AXES], work[WORK], y[AXES][AXES];
    double s[AXES], real_work[3 * AXES];

    forms_of(machine, n, x, marked, plain);
    if (LAPACKE_zhegv_work(LAPACK_COL_MAJOR, 1, 'V', 'U', n, marked, n, plain, n, s, work, WORK,
                           real_work) != 0) {
        return;
    }
    for (int i = 0; i < n; i++) {
        if (!(creal(plain[i + n * i]) > least_independence)) return;
    }
    for (int i = 0; i < n; i++) {
        for (int a = 0; a < AXES; a++) {
            y[i][a] = 0;
            for (int j = 0; j < n; j++) y[i][a] += marked[j + n * i] * x[j][a];
        }
    }
    memcpy(x, y, (size_t)n * sizeof *y);
}

void mode_separate(const gough_machine *machine, int count, const double complex *value,
                   double tolerance, double complex (*shape)[6]) {
    bool taken[MOST_SHAPES] = {false};

    assert_true(count <= MOST_SHAPES);
    for (int i = 0; i < count; i++) {
        double complex space[MOST_SHAPES][AXES];
        int member[MOST_SHAPES], n = 0;

        for (int j = i; j < count; j++) {
            if (taken[j] || !(cabs(value[j] - value[i]) <= tolerance)) continue;
            taken[j] = true;
            memcpy(space[n], shape[j], sizeof space[n]);
            member[n++] = j;
        }
        if (n < 2 || n > AXES) continue;
        separate_space(machine, n, space);
        for (int j = 0; j < n; j++) memcpy(shape[member[j]], space[j], sizeof space[j]);
    }
}
