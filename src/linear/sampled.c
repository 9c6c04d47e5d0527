/* One sample as a matrix: the plant by the exponential of its matrix, the command that changes within the sample, the controller's
 * memory and the commands that wait; its multipliers. Theory: docs/theory/loop.md. */
#include "linear/sampled.h"

#include <complex.h>
#include <lapacke.h>
#include <math.h>
#include <string.h>

#include "linear/exponential.h"
#include "linear/linear.h"
#include "linear/mode.h"
#include "linear/symmetric.h"

enum { WORK = 64 * SAMPLED_ROWS, AUGMENTED = SAMPLED_PLANT + GOUGH_LEGS };

/* shares of a period within which a delay counts as whole periods */
static const double slack = 1e-9;

/* multipliers this close, relative to the largest, are one */
static const double same_value = 1e-9;

/* ---- the plant ---- */

/* J about the centre of mass */
static void lengths_of(const gough_machine *machine, const gough_state *state, double J[6][6]) {
    double c[3];

    gough_jacobian(machine, state, J);
    for (int r = 0; r < 3; r++) {
        c[r] = 0;
        for (int k = 0; k < 3; k++) c[r] += state->rotation[r][k] * machine->load.center_of_mass[k];
    }
    for (int v = 0; v < GOUGH_LEGS; v++) {
        for (int i = 0; i < 3; i++) {
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            J[v][3 + i] -= c[j] * J[v][k] - c[k] * J[v][j];
        }
    }
}

/* M̂⁻¹ Jᵀ: accelerations for each unit of a leg's force */
static bool pushes(double mass[6][6], double J[6][6], double out[FREEDOMS][GOUGH_LEGS]) {
    double a[36], x[36];
    lapack_int pivot[6];

    for (int i = 0; i < 6; i++) {
        for (int j = 0; j < 6; j++) {
            a[i + 6 * j] = mass[i][j];
            x[i + 6 * j] = J[j][i];
        }
    }
    if (LAPACKE_dgesv_work(LAPACK_COL_MAJOR, 6, 6, a, 6, pivot, x, 6) != 0) return false;
    for (int i = 0; i < 6; i++) {
        for (int v = 0; v < GOUGH_LEGS; v++) out[i][v] = x[i + 6 * v];
    }
    return true;
}

/* forces of the drives: inputs, or states with equations of their own */
static void add_drives(const gough_machine *machine, double push[FREEDOMS][GOUGH_LEGS],
                       sampled_plant *p) {
    for (int v = 0; v < GOUGH_LEGS; v++) {
        double change[2][3];
        const int order = sampled_drive_of(&machine->platform.actuators, v, change);
        const int force = GOUGH_LINEAR + v, rate = force + GOUGH_LEGS;

        p->n = GOUGH_LINEAR + GOUGH_LEGS * order;
        /* T_a or 2 ζ_a/ω_a: the force lags so far behind a slow command */
        if (order == 1) p->lag = fmax(p->lag, 1 / change[0][0]);
        if (order == 2) p->lag = fmax(p->lag, -change[1][2] / change[1][0]);
        for (int i = 0; i < FREEDOMS; i++) {
            if (order == 0)
                p->B[FREEDOMS + i][v] = push[i][v];
            else
                p->A[FREEDOMS + i][force] = push[i][v];
        }
        for (int k = 0; k < order; k++) {
            const int row = k == 0 ? force : rate;
            p->B[row][v] = change[k][0];
            p->A[row][force] = change[k][1];
            if (order == 2) p->A[row][rate] = change[k][2];
        }
    }
}

gough_status sampled_plant_of(const gough_machine *machine, const gough_motion *motion,
                              const gough_state *state, sampled_plant *plant, gough_error *error) {
    const gough_control forces = {.feedforward = true};
    const linear_loop constant = {machine, motion, &forces, false, 0, false};
    double push[FREEDOMS][GOUGH_LEGS];
    linear_matrix A;
    const char *wrong = linear_complex.matrix(&constant, 0, NULL, A);
    const gough_status status = linear_check(&constant, 0, NULL, A, wrong, error);

    if (status != GOUGH_OK) return status;
    memset(plant, 0, sizeof *plant);
    for (int i = 0; i < GOUGH_LINEAR; i++) memcpy(plant->A[i], A[i], sizeof A[i]);
    lengths_of(machine, state, plant->J);
    linear_mass(machine, state, plant->mass);
    if (!pushes(plant->mass, plant->J, push))
        return gough_fail(error, GOUGH_ERROR_NUMERICAL, "the mass of the platform is singular");
    add_drives(machine, push, plant);
    return GOUGH_OK;
}

/* ---- over a period ---- */

static int whole_periods(double period, double delay, double *rest) {
    const double periods = delay / period, whole = floor(periods + slack);

    *rest = periods - whole > slack ? delay - whole * period : 0;
    return (int)whole;
}

int sampled_waiting(double period, double delay) {
    double rest;
    const int whole = whole_periods(period, delay, &rest);

    return whole + (rest > 0);
}

bool sampled_delay_fits(double period, double delay) {
    if (!(delay / period < 2 * SAMPLED_WAITING)) return false;
    return sampled_waiting(period, delay) <= SAMPLED_WAITING;
}

/* x ← F x + E u over a time, (loop-7) */
static bool advance(const sampled_plant *p, double time, double F[SAMPLED_PLANT][SAMPLED_PLANT],
                    double E[SAMPLED_PLANT][GOUGH_LEGS], bool *unsolved) {
    const int n = p->n, rows = n + GOUGH_LEGS;
    double A[AUGMENTED * AUGMENTED] = {0}, out[AUGMENTED * AUGMENTED];

    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++) A[rows * i + j] = time * p->A[i][j];
        for (int v = 0; v < GOUGH_LEGS; v++) A[rows * i + n + v] = time * p->B[i][v];
    }
    if (!exponential(rows, A, out, unsolved)) return false;
    for (int i = 0; i < n; i++) {
        memcpy(F[i], out + rows * i, (size_t)n * sizeof(double));
        memcpy(E[i], out + rows * i + n, GOUGH_LEGS * sizeof(double));
    }
    return true;
}

bool sampled_step_of(const sampled_plant *plant, double period, double delay, sampled_step *step) {
    double first[SAMPLED_PLANT][SAMPLED_PLANT], old[SAMPLED_PLANT][GOUGH_LEGS],
        second[SAMPLED_PLANT][SAMPLED_PLANT], rest;
    const int n = plant->n;

    step->n = n;
    step->whole = whole_periods(period, delay, &rest);
    step->parted = rest > 0;
    memset(step->before, 0, sizeof step->before);
    if (!step->parted) return advance(plant, period, step->keep, step->after, &step->unsolved);

    if (!advance(plant, rest, first, old, &step->unsolved)) return false;
    if (!advance(plant, period - rest, second, step->after, &step->unsolved)) return false;
    memset(step->keep, 0, sizeof step->keep);
    for (int i = 0; i < n; i++) {
        for (int k = 0; k < n; k++) {
            for (int j = 0; j < n; j++) step->keep[i][j] += second[i][k] * first[k][j];
            for (int v = 0; v < GOUGH_LEGS; v++) step->before[i][v] += second[i][k] * old[k][v];
        }
    }
    return true;
}

/* ---- the map ---- */

/* a row of the law on the state of the map: lengths and rates by J, memory by its place */
static void see(const sampled_plant *p, const sampled_law *law,
                const double by_input[SAMPLED_INPUTS], double *row) {
    int place = p->n;

    for (int v = 0; v < GOUGH_LEGS; v++) {
        for (int i = 0; i < FREEDOMS; i++) {
            row[i] += by_input[v] * p->J[v][i];
            row[FREEDOMS + i] += by_input[GOUGH_LEGS + v] * p->J[v][i];
        }
    }
    for (int m = 0; m < SAMPLED_MEMORY; m++) {
        if (law->used[m]) row[place++] += by_input[SAMPLED_SEEN + m];
    }
}

/* adds what the command given `age` samples ago does, the one of now being a function of the state */
static void add_command(double *row, const double *now, int n, int first, int age,
                        const double by_leg[GOUGH_LEGS]) {
    for (int v = 0; v < GOUGH_LEGS; v++) {
        if (age > 0) {
            row[first + GOUGH_LEGS * (age - 1) + v] += by_leg[v];
            continue;
        }
        for (int j = 0; j < n; j++) row[j] += by_leg[v] * now[n * v + j];
    }
}

void sampled_map_of(const sampled_plant *plant, const sampled_step *step, const sampled_law *law,
                    sampled_map *map) {
    const int waiting = step->whole + step->parted;
    int n = plant->n, first;
    double now[GOUGH_LEGS * SAMPLED_ROWS] = {0}, *row = map->matrix;

    for (int m = 0; m < SAMPLED_MEMORY; m++) n += law->used[m];
    first = n;
    n += GOUGH_LEGS * waiting;
    map->n = n;
    memset(map->matrix, 0, (size_t)(n * n) * sizeof *map->matrix);
    for (int v = 0; v < GOUGH_LEGS; v++) see(plant, law, law->command[v], now + n * v);

    for (int i = 0; i < plant->n; i++, row += n) {
        memcpy(row, step->keep[i], (size_t)plant->n * sizeof *row);
        add_command(row, now, n, first, step->whole, step->after[i]);
        if (step->parted) add_command(row, now, n, first, step->whole + 1, step->before[i]);
    }
    for (int m = 0; m < SAMPLED_MEMORY; m++) {
        if (!law->used[m]) continue;
        see(plant, law, law->memory[m], row);
        row += n;
    }
    for (int age = 1; age <= waiting; age++) {
        for (int v = 0; v < GOUGH_LEGS; v++, row += n) {
            if (age == 1)
                memcpy(row, now + n * v, (size_t)n * sizeof *row);
            else
                row[first + GOUGH_LEGS * (age - 2) + v] = 1;
        }
    }
}

/* ---- multipliers ---- */

static bool finite(const double *value, int count) {
    for (int i = 0; i < count; i++) {
        if (!isfinite(value[i])) return false;
    }
    return true;
}

/* eigenvalues, and by columns eigenvectors as LAPACK packs them, or NULL; the matrix is read by columns: its transpose */
static bool eigenvalues(const sampled_map *map, bool by_columns, double *re, double *im,
                        double *right) {
    const int n = map->n;
    double a[SAMPLED_ROWS * SAMPLED_ROWS], work[WORK], none = 0;

    if (!finite(map->matrix, n * n)) return false;
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++) a[by_columns ? i + n * j : n * i + j] = map->matrix[n * i + j];
    }
    if (LAPACKE_dgeev_work(LAPACK_COL_MAJOR, 'N', right ? 'V' : 'N', n, a, n, re, im, &none, 1,
                           right ? right : &none, right ? n : 1, work, WORK) != 0)
        return false;
    return finite(re, n) && finite(im, n);
}

double sampled_radius(const sampled_map *map) {
    double re[SAMPLED_ROWS], im[SAMPLED_ROWS], radius = 0;

    if (!finite(map->matrix, map->n * map->n)) return (double)INFINITY;
    if (!eigenvalues(map, false, re, im, NULL)) return (double)NAN;
    for (int k = 0; k < map->n; k++) radius = fmax(radius, hypot(re[k], im[k]));
    return radius;
}

/* by falling magnitude; of one magnitude but for rounding that with the lesser frequency, and of a pair the positive one first */
static bool comes_before(double complex a, double complex b) {
    const double apart = cabs(a) - cabs(b);

    if (fabs(apart) > 1e-12 * cabs(b)) return apart > 0;
    const double turn = fabs(carg(a)) - fabs(carg(b));
    if (fabs(turn) > 1e-12) return turn < 0;
    return cimag(a) > cimag(b);
}

int sampled_multipliers(const gough_machine *machine, const sampled_map *map, int most,
                        gough_multiplier *multiplier) {
    double re[SAMPLED_ROWS], im[SAMPLED_ROWS], right[SAMPLED_ROWS * SAMPLED_ROWS];
    double complex value[SAMPLED_ROWS], shape[SAMPLED_ROWS][6];
    const int n = map->n;
    int order[SAMPLED_ROWS];
    double largest = 0;

    if (!eigenvalues(map, true, re, im, right)) return 0;
    for (int k = 0; k < n; k++) {
        int place = k;
        value[k] = re[k] + I * im[k];
        largest = fmax(largest, cabs(value[k]));
        for (; place > 0 && comes_before(value[k], value[order[place - 1]]); place--)
            order[place] = order[place - 1];
        order[place] = k;
    }
    if (most > n) most = n;
    for (int k = 0; k < most; k++) {
        /* of a pair the first column has the real part, the second the imaginary part of the shape */
        const int own = order[k], first = im[own] < 0 ? own - 1 : own;
        const double sign = im[own] > 0 ? 1 : im[own] < 0 ? -1 : 0;
        for (int i = 0; i < 6; i++) {
            const double other = first + 1 < n ? right[i + n * (first + 1)] : 0;
            shape[k][i] = right[i + n * first] + I * (sign * other);
        }
        multiplier[k].value[0] = re[own] + 0;
        multiplier[k].value[1] = im[own] + 0;
    }
    for (int k = 0; k < most; k++) value[k] = multiplier[k].value[0] + I * multiplier[k].value[1];
    mode_separate(machine, most, value, same_value * largest, shape);
    for (int k = 0; k < most; k++) mode_of(machine, shape[k], &multiplier[k].mode);
    return most;
}
