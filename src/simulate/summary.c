/* A run in a few numbers: what sizes a leg. Peaks are those of the rows; time integrals are of fourth order in the row spacing. */
#include <math.h>
#include <string.h>

#include "gough/dynamics.h"
#include "gough/simulate.h"
#include "simulate/quadrature.h"

/* columns of the window: time, then per leg the square of the force and the power */
enum { WINDOW = QUADRATURE_ROWS, SQUARE = 1, POWER = 1 + GOUGH_LEGS };

void gough_summary_begin(gough_summary *summary) {
    memset(summary, 0, sizeof *summary);
    for (int v = 0; v < GOUGH_LEGS; v++) {
        gough_leg_summary *leg = &summary->leg[v];
        leg->length_min = leg->force_min = leg->power_min = INFINITY;
        leg->length_max = leg->force_max = leg->power_max = -INFINITY;
    }
    summary->position_deviation = summary->angle_deviation = NAN;
    summary->drift = NAN;
}

/* larger of the two; a NaN stands for nothing yet on the left, and is passed over on the right */
static double larger(double a, double b) { return b > a || isnan(a) ? b : a; }

static double angle_between(const double a[3], const double b[3]) {
    const double c[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                         a[0] * b[1] - a[1] * b[0]};

    return atan2(sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]),
                 a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
}

/* leg v from base to top in a pose, base axes; and the same seen from the top */
static void leg_vector(const gough_machine *machine, const gough_state *state, int v,
                       double base_axes[3], double top_axes[3]) {
    for (int r = 0; r < 3; r++) {
        base_axes[r] = state->position[r] - machine->platform.base[v][r];
        for (int c = 0; c < 3; c++) {
            base_axes[r] += state->rotation[r][c] * machine->platform.top[v][c];
        }
    }
    for (int c = 0; c < 3; c++) {
        top_axes[c] = 0;
        for (int r = 0; r < 3; r++) top_axes[c] += state->rotation[r][c] * base_axes[r];
    }
}

static void add_swing(gough_summary *summary, const gough_machine *machine, const double *value) {
    const gough_state home = gough_state_home(machine);
    gough_state state = home;

    for (int c = 0; c < 3; c++) state.position[c] = value[GOUGH_X + c];
    gough_rotation_from_angles(value + GOUGH_ROLL_ANGLE, state.rotation);
    for (int v = 0; v < GOUGH_LEGS; v++) {
        double base[3], top[3], base_home[3], top_home[3];
        leg_vector(machine, &state, v, base, top);
        leg_vector(machine, &home, v, base_home, top_home);
        summary->leg[v].swing_base =
            larger(summary->leg[v].swing_base, angle_between(base, base_home));
        summary->leg[v].swing_top = larger(summary->leg[v].swing_top, angle_between(top, top_home));
    }
}

/* deviation in angle: the program's angles are those of the row less their deviation */
static void add_deviation(gough_summary *summary, const double *value) {
    double program[3], a[3][3], b[3][3], trace = 0, s[3] = {0, 0, 0};

    if (isnan(value[GOUGH_EX])) return;
    summary->position_deviation =
        larger(summary->position_deviation,
               sqrt(value[GOUGH_EX] * value[GOUGH_EX] + value[GOUGH_EY] * value[GOUGH_EY] +
                    value[GOUGH_EZ] * value[GOUGH_EZ]));
    for (int c = 0; c < 3; c++) {
        program[c] = value[GOUGH_ROLL_ANGLE + c] - value[GOUGH_EROLL + c];
    }
    gough_rotation_from_angles(value + GOUGH_ROLL_ANGLE, a);
    gough_rotation_from_angles(program, b);
    for (int c = 0; c < 3; c++) {
        for (int r = 0; r < 3; r++) trace += a[r][c] * b[r][c];
        s[0] += a[1][c] * b[2][c] - a[2][c] * b[1][c];
        s[1] += a[2][c] * b[0][c] - a[0][c] * b[2][c];
        s[2] += a[0][c] * b[1][c] - a[1][c] * b[0][c];
    }
    summary->angle_deviation = larger(
        summary->angle_deviation, atan2(sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]), trace - 1));
    summary->drift = larger(summary->drift, value[GOUGH_DRIFT]);
}

/* adds ∫ over one interval of the window, h · Σ weight · value, to the legs' squares and energies */
static void add_interval(gough_summary *summary, double h, const double weight[WINDOW]) {
    for (int v = 0; v < GOUGH_LEGS; v++) {
        double square = 0, power = 0;
        for (int i = 0; i < WINDOW; i++) {
            square += weight[i] * summary->window_[i][SQUARE + v];
            power += weight[i] * summary->window_[i][POWER + v];
        }
        summary->square_[v] += h * square;
        summary->leg[v].energy += h * power;
    }
}

static void add_to_window(gough_summary *summary, const double *value) {
    double *newest = summary->window_[WINDOW - 1];

    memmove(summary->window_[0], summary->window_[1], (WINDOW - 1) * sizeof summary->window_[0]);
    newest[0] = value[GOUGH_T];
    for (int v = 0; v < GOUGH_LEGS; v++) {
        newest[SQUARE + v] = value[GOUGH_F + v] * value[GOUGH_F + v];
        newest[POWER + v] = value[GOUGH_P + v];
    }
    if (summary->rows < WINDOW) return;
    const double h = (newest[0] - summary->window_[0][0]) / (WINDOW - 1);
    if (summary->rows == WINDOW) add_interval(summary, h, quadrature_first);
    add_interval(summary, h, quadrature_middle);
}

void gough_summary_add(gough_summary *summary, const gough_machine *machine, const gough_row *row) {
    const double *value = row->value;

    if (summary->rows == 0) summary->first_time = value[GOUGH_T];
    summary->last_time = value[GOUGH_T];
    summary->rows++;
    for (int v = 0; v < GOUGH_LEGS; v++) {
        gough_leg_summary *leg = &summary->leg[v];
        leg->length_min = fmin(leg->length_min, value[GOUGH_L + v]);
        leg->length_max = fmax(leg->length_max, value[GOUGH_L + v]);
        leg->speed = fmax(leg->speed, fabs(value[GOUGH_DL + v]));
        leg->force_min = fmin(leg->force_min, value[GOUGH_F + v]);
        leg->force_max = fmax(leg->force_max, value[GOUGH_F + v]);
        leg->power_min = fmin(leg->power_min, value[GOUGH_P + v]);
        leg->power_max = fmax(leg->power_max, value[GOUGH_P + v]);
    }
    if (value[GOUGH_CONDITION] > summary->condition) {
        summary->condition = value[GOUGH_CONDITION];
        summary->condition_time = value[GOUGH_T];
    }
    add_swing(summary, machine, value);
    add_deviation(summary, value);
    add_to_window(summary, value);
}

void gough_summary_end(gough_summary *summary) {
    const double span = summary->last_time - summary->first_time;

    if (summary->rows >= WINDOW) {
        add_interval(summary,
                     (summary->window_[WINDOW - 1][0] - summary->window_[0][0]) / (WINDOW - 1),
                     quadrature_last);
    } else if (summary->rows >= 2) {
        /* too few rows for a cubic: the trapezium between the two or three there are */
        for (size_t i = WINDOW - summary->rows; i + 1 < WINDOW; i++) {
            double weight[WINDOW] = {0, 0, 0, 0};
            weight[i] = weight[i + 1] = 0.5;
            add_interval(summary, summary->window_[i + 1][0] - summary->window_[i][0], weight);
        }
    }
    for (int v = 0; v < GOUGH_LEGS; v++) {
        gough_leg_summary *leg = &summary->leg[v];
        const double newest = fmax(fabs(leg->force_min), fabs(leg->force_max));
        leg->rms_force = span > 0 ? sqrt(fmax(0, summary->square_[v] / span)) : newest;
    }
}
