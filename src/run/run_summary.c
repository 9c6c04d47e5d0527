/* A run in a few numbers: what you need to size a leg. From rows alone, peaks are those of the rows and time integrals of fourth
 * order in their spacing; from looks at the motion between them, peaks and integrals are those of the motion. */
#define NUMBER_DOUBLE
#include <math.h>
#include <string.h>

#include "gough/dynamics.h"
#include "gough/simulate.h"
#include "plant/hexapod.h"
#include "run/peak.h"
#include "run/quadrature.h"
#include "run/returned.h"
#include "run/summary_limits.h"

/* columns of the window: time, then per leg the square of the force, the power, and what of it friction takes */
enum {
    WINDOW = QUADRATURE_ROWS,
    SQUARE = 1,
    POWER = SQUARE + GOUGH_LEGS,
    LOSS = POWER + GOUGH_LEGS,
    WINDOW_COLUMNS = LOSS + GOUGH_LEGS
};
_Static_assert(WINDOW_COLUMNS == sizeof((gough_summary *)0)->window_[0] / sizeof(double), "rows");

/* columns of the window of looks: time, six quantities of each leg, three of the whole machine, and four of each leg that those
 * of a machine without mass and friction in its legs lack */
enum {
    LOOK_LENGTH = 1,
    LOOK_RATE = LOOK_LENGTH + GOUGH_LEGS,
    LOOK_FORCE = LOOK_RATE + GOUGH_LEGS,
    LOOK_POWER = LOOK_FORCE + GOUGH_LEGS,
    LOOK_BASE = LOOK_POWER + GOUGH_LEGS,
    LOOK_TOP = LOOK_BASE + GOUGH_LEGS,
    LOOK_CONDITION = LOOK_TOP + GOUGH_LEGS,
    LOOK_POSITION,
    LOOK_HALF,     /* sine of half the angle, which lanes follow too */
    LOOK_EXTERNAL, /* power of the external loads */
    LOOK_PLAIN,
    LOOK_TOP_LOAD = LOOK_PLAIN,
    LOOK_BASE_LOAD = LOOK_TOP_LOAD + GOUGH_LEGS,
    LOOK_SIDE = LOOK_BASE_LOAD + GOUGH_LEGS,
    LOOK_LOSS = LOOK_SIDE + GOUGH_LEGS,
    LOOK_LIMITS =
        LOOK_LOSS + GOUGH_LEGS, /* what follows is for limits that not every machine has */
    LOOK_ACCELERATION = LOOK_LIMITS,
    LOOK_COMPONENT = LOOK_ACCELERATION + GOUGH_LEGS,
    LOOK_COLUMNS = LOOK_COMPONENT + 3 * GOUGH_COMPONENTS
};
_Static_assert(LOOK_COLUMNS == sizeof((gough_summary *)0)->look_[0] / sizeof(double), "window");

void gough_summary_begin(gough_summary *summary) {
    memset(summary, 0, sizeof *summary);
    for (int v = 0; v < GOUGH_LEGS; v++) {
        gough_leg_summary *leg = &summary->leg[v];
        leg->length_min = leg->force_min = leg->power_min = INFINITY;
        leg->length_max = leg->force_max = leg->power_max = -INFINITY;
        leg->saturated = leg->saturated_at = NAN;
        leg->sample_error = leg->sample_error_at = NAN;
    }
    summary->held_[0] = NAN;
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

static void find_swing(const gough_machine *machine, gough_order order, const double *value,
                       double at_base[GOUGH_LEGS], double at_top[GOUGH_LEGS]) {
    const gough_state home = gough_state_home(machine);
    gough_state state = home;

    for (int c = 0; c < 3; c++) state.position[c] = value[GOUGH_X + c];
    gough_rotation_in_order(order, value + GOUGH_ROLL_ANGLE, state.rotation);
    for (int v = 0; v < GOUGH_LEGS; v++) {
        double base[3], top[3], base_home[3], top_home[3];
        leg_vector(machine, &state, v, base, top);
        leg_vector(machine, &home, v, base_home, top_home);
        at_base[v] = angle_between(base, base_home);
        at_top[v] = angle_between(top, top_home);
    }
}

/* deviation in position, and in angle: the program's angles are those of the row less their deviation */
static void find_deviation(gough_order order, const double *value, double *position,
                           double *angle) {
    double program[3], a[3][3], b[3][3], trace = 0, s[3] = {0, 0, 0};

    *position = *angle = NAN;
    if (isnan(value[GOUGH_EX])) return;
    *position = sqrt(value[GOUGH_EX] * value[GOUGH_EX] + value[GOUGH_EY] * value[GOUGH_EY] +
                     value[GOUGH_EZ] * value[GOUGH_EZ]);
    for (int c = 0; c < 3; c++) {
        program[c] = value[GOUGH_ROLL_ANGLE + c] - value[GOUGH_EROLL + c];
    }
    gough_rotation_in_order(order, value + GOUGH_ROLL_ANGLE, a);
    gough_rotation_in_order(order, program, b);
    for (int c = 0; c < 3; c++) {
        for (int r = 0; r < 3; r++) trace += a[r][c] * b[r][c];
        s[0] += a[1][c] * b[2][c] - a[2][c] * b[1][c];
        s[1] += a[2][c] * b[0][c] - a[0][c] * b[2][c];
        s[2] += a[0][c] * b[1][c] - a[1][c] * b[0][c];
    }
    *angle = atan2(sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]), trace - 1);
}

/* peaks up to a moment, whose swing and deviation are given */
static void take_peaks(gough_summary *summary, const double *value,
                       const double at_base[GOUGH_LEGS], const double at_top[GOUGH_LEGS],
                       double position, double angle) {
    for (int v = 0; v < GOUGH_LEGS; v++) {
        gough_leg_summary *leg = &summary->leg[v];
        leg->speed = fmax(leg->speed, fabs(value[GOUGH_DL + v]));
        leg->force_min = fmin(leg->force_min, value[GOUGH_F + v]);
        leg->force_max = fmax(leg->force_max, value[GOUGH_F + v]);
        leg->power_min = fmin(leg->power_min, value[GOUGH_P + v]);
        leg->power_max = fmax(leg->power_max, value[GOUGH_P + v]);
        if (summary->brief_) continue;
        leg->length_min = fmin(leg->length_min, value[GOUGH_L + v]);
        leg->length_max = fmax(leg->length_max, value[GOUGH_L + v]);
        leg->swing_base = fmax(leg->swing_base, at_base[v]);
        leg->swing_top = fmax(leg->swing_top, at_top[v]);
    }
    if (value[GOUGH_CONDITION] > summary->condition) {
        summary->condition = value[GOUGH_CONDITION];
        summary->condition_time = value[GOUGH_T];
    }
    if (isnan(position)) return;
    summary->position_deviation = larger(summary->position_deviation, position);
    summary->angle_deviation = larger(summary->angle_deviation, angle);
    summary->drift = larger(summary->drift, value[GOUGH_DRIFT]);
}

/* ---- forces of the joints ---- */

/* Whether a row or look has them, and they are others than the drive forces. */
static bool has_joints(const gough_machine *machine, const double *value) {
    return !isnan(value[GOUGH_H]) &&
           (machine->platform.legs_have_mass || machine_has_friction(machine));
}

/* what friction takes of the power of leg v, (mass-7) */
static double power_lost(const double *value, int v) {
    return (value[GOUGH_F + v] - value[GOUGH_H + v]) * value[GOUGH_DL + v];
}

static double size_of(const double *v) { return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/* Peaks up to a row or look that has them, whose loads and loss go to load[0 … 3] of each leg as in the window of looks. */
static void take_joints(gough_summary *summary, const double *value, double load[4 * GOUGH_LEGS]) {
    for (int v = 0; v < GOUGH_LEGS; v++) {
        gough_leg_summary *leg = &summary->leg[v];
        load[v] = size_of(value + GOUGH_ON_TOP + 3 * v);
        load[GOUGH_LEGS + v] = size_of(value + GOUGH_BY_BASE + 3 * v);
        load[2 * GOUGH_LEGS + v] = value[GOUGH_S + v];
        load[3 * GOUGH_LEGS + v] = power_lost(value, v);
        leg->top_load = fmax(leg->top_load, load[v]);
        leg->base_load = fmax(leg->base_load, load[GOUGH_LEGS + v]);
        leg->side_load = fmax(leg->side_load, load[2 * GOUGH_LEGS + v]);
    }
}

/* what limits ask for, at a moment; look: the newest, or NULL */
static void take_limits(gough_summary *summary, const gough_machine *machine, const double *value,
                        double *look) {
    double component[3][GOUGH_COMPONENTS], acceleration[GOUGH_LEGS];

    if (!summary->limited_ || isnan(value[GOUGH_X])) return;
    summary_limits_row(machine, summary->order, summary->about_, value, component, acceleration);
    for (int v = 0; v < GOUGH_LEGS; v++) {
        gough_leg_summary *leg = &summary->leg[v];
        leg->acceleration = fmax(leg->acceleration, fabs(acceleration[v]));
    }
    for (int order = 0; order < 3; order++) {
        for (int c = 0; c < GOUGH_COMPONENTS; c++) {
            double *range = summary->component[order][c];
            range[0] = fmin(range[0], component[order][c]);
            range[1] = fmax(range[1], component[order][c]);
        }
    }
    if (look == NULL) return;
    memcpy(look + LOOK_ACCELERATION, acceleration, sizeof acceleration);
    memcpy(look + LOOK_COMPONENT, component, sizeof component);
}

static void count_row(gough_summary *summary, double t) {
    if (summary->rows == 0) summary->first_time = t;
    summary->last_time = t;
    summary->rows++;
}

/* ---- rows alone ---- */

/* adds ∫ over one interval of the window, h · Σ weight · value, to the legs' squares and energies; fit: its polynomial */
static void add_interval(gough_summary *summary, double h, const double weight[WINDOW],
                         const double fit[WINDOW][WINDOW]) {
    double curve[WINDOW];

    for (int v = 0; v < GOUGH_LEGS; v++) {
        double square = 0, power = 0, loss = 0;
        for (int i = 0; i < WINDOW; i++) {
            square += weight[i] * summary->window_[i][SQUARE + v];
            power += weight[i] * summary->window_[i][POWER + v];
            loss += weight[i] * summary->window_[i][LOSS + v];
            curve[i] = summary->window_[i][POWER + v];
        }
        summary->square_[v] += h * square;
        summary->leg[v].energy += h * power;
        summary->leg[v].friction_loss += h * loss;
        summary->leg[v].returned_energy += returned_energy(fit, h, curve);
    }
}

/* the same with the cubic through all rows of the window, from row a */
static void add_cubic(gough_summary *summary, double h, const double weight[WINDOW], int a) {
    double fit[WINDOW][WINDOW], time[WINDOW];

    for (int i = 0; i < WINDOW; i++) time[i] = summary->window_[i][0];
    quadrature_fit(time, WINDOW, a, fit);
    add_interval(summary, h, weight, (const double(*)[WINDOW])fit);
}

static void add_to_window(gough_summary *summary, const double *value) {
    double *newest = summary->window_[WINDOW - 1];

    memmove(summary->window_[0], summary->window_[1], (WINDOW - 1) * sizeof summary->window_[0]);
    newest[0] = value[GOUGH_T];
    for (int v = 0; v < GOUGH_LEGS; v++) {
        newest[SQUARE + v] = value[GOUGH_F + v] * value[GOUGH_F + v];
        newest[POWER + v] = value[GOUGH_P + v];
        newest[LOSS + v] = summary->joints_ ? power_lost(value, v) : 0;
    }
    if (summary->rows < WINDOW) return;
    const double h = (newest[0] - summary->window_[0][0]) / (WINDOW - 1);
    if (summary->rows == WINDOW) add_cubic(summary, h, quadrature_first, 0);
    add_cubic(summary, h, quadrature_middle, 1);
}

void gough_summary_add(gough_summary *summary, const gough_machine *machine, const gough_row *row) {
    const double *value = row->value;
    double at_base[GOUGH_LEGS], at_top[GOUGH_LEGS], position, angle, load[4 * GOUGH_LEGS];

    count_row(summary, value[GOUGH_T]);
    summary_saturation(summary, value);
    summary->joints_ = has_joints(machine, value);
    if (summary->joints_) take_joints(summary, value, load);
    find_swing(machine, summary->order, value, at_base, at_top);
    find_deviation(summary->order, value, &position, &angle);
    take_peaks(summary, value, at_base, at_top, position, angle);
    take_limits(summary, machine, value, NULL);
    add_to_window(summary, value);
}

static void end_rows(gough_summary *summary) {
    if (summary->rows >= WINDOW) {
        add_cubic(summary,
                  (summary->window_[WINDOW - 1][0] - summary->window_[0][0]) / (WINDOW - 1),
                  quadrature_last, WINDOW - 2);
    } else if (summary->rows >= 2) {
        /* too few rows for a cubic: the trapezium between the two or three there are */
        for (size_t i = WINDOW - summary->rows; i + 1 < WINDOW; i++) {
            double weight[WINDOW] = {0, 0, 0, 0}, chord[WINDOW][WINDOW] = {{0}};
            weight[i] = weight[i + 1] = 0.5;
            chord[i][0] = chord[i + 1][1] = 1;
            chord[i][1] = -1;
            add_interval(summary, summary->window_[i + 1][0] - summary->window_[i][0], weight,
                         (const double(*)[WINDOW])chord);
        }
    }
}

/* ---- looks at the motion, rows among them ---- */

/* an interval between two looks: its polynomial as quadrature_fit() makes it, once it is wanted */
typedef struct {
    double c[WINDOW][WINDOW], time[WINDOW], h; /* h: from look a to the next */
    int count, a;
    bool made;
    double
        bends[LOOK_COLUMNS]; /* of each column: below 0 where it may turn between the two looks */
} interval;

static void fit(interval *f) {
    if (!f->made) f->h = quadrature_fit(f->time, f->count, f->a, f->c);
    f->made = true;
}

/* Where looks in the middle of four do not turn, peak_between() finds nothing. All columns at once, without a branch for each. */
static void find_bends(const gough_summary *summary, interval *f) {
    const double(*look)[LOOK_COLUMNS] = summary->look_;
    const bool middle = f->count == WINDOW && f->a == 1;
    const int columns = summary->limited_  ? LOOK_COLUMNS
                        : summary->joints_ ? LOOK_LIMITS
                                           : LOOK_PLAIN;

    for (int c = 0; c < columns && !middle; c++) f->bends[c] = -1;
    for (int c = 0; c < columns && middle; c++)
        f->bends[c] = (look[1][c] - look[0][c]) * (look[3][c] - look[2][c]);
}

/* the energy that leg v returns from look a to the next, whose net energy is `net` */
static double returned_between(const gough_summary *summary, interval *f, int v, double net) {
    const int column = LOOK_POWER + v;
    const double one = summary->look_[f->a][column], two = summary->look_[f->a + 1][column];
    double y[WINDOW];

    /* a power that keeps its sign at the looks and does not turn between them keeps it there too */
    if (!(f->bends[column] < 0) && one >= 0 && two >= 0) return 0;
    if (!(f->bends[column] < 0) && one <= 0 && two <= 0) return -net;
    fit(f);
    for (int i = 0; i < WINDOW; i++) y[i] = summary->look_[i][column];
    return returned_energy((const double(*)[WINDOW])f->c, f->h, y);
}

/* adds ∫ from look a to the next of the polynomial through the last `count` looks */
static void integrate(gough_summary *summary, interval *f) {
    const bool whole = !summary->brief_;
    double weight[WINDOW];

    if (f->count == WINDOW && f->a == 1) {
        quadrature_weigh_middle(f->time, weight);
    } else {
        quadrature_weigh(f->time, f->count, f->a, weight);
    }
    for (int v = 0; v < GOUGH_LEGS; v++) {
        gough_leg_summary *leg = &summary->leg[v];
        double net = 0;
        for (int i = WINDOW - f->count; i < WINDOW; i++) {
            const double *look = summary->look_[i], force = look[LOOK_FORCE + v];
            if (whole) summary->square_[v] += weight[i] * force * force;
            if (summary->joints_) leg->friction_loss += weight[i] * look[LOOK_LOSS + v];
            leg->energy += weight[i] * look[LOOK_POWER + v];
            net += weight[i] * look[LOOK_POWER + v];
        }
        if (whole) leg->returned_energy += returned_between(summary, f, v, net);
    }
    for (int i = WINDOW - f->count; i < WINDOW; i++)
        summary->external_work += weight[i] * summary->look_[i][LOOK_EXTERNAL];
}

/* The extreme of a column between the two looks, with its place in *s. A column that does not turn there has the value at look a
 * and the place 0. */
static double extreme_of(const gough_summary *summary, interval *f, int column, double *s) {
    double y[WINDOW];

    *s = 0;
    if (!(f->bends[column] < 0)) return summary->look_[f->a][column];
    fit(f);
    for (int i = 0; i < WINDOW; i++) y[i] = summary->look_[i][column];
    const double value = peak_between(y, (const double(*)[WINDOW])f->c, f->count, f->a, s);
    if (!(*s > 0 && isfinite(value))) *s = 0;
    return *s > 0 ? value : y[f->a];
}

/* 2 arcsin x is at most π x */
static const double most_angle = 3.15;

/* friction jumps where one of its differences between neighbouring looks is so many times the next greatest */
static const double friction_jump = 4;

/* Whether friction of leg v jumps among four looks, as where the leg turns round: a cubic through its drive forces then swings
 * although the force does not, and is no witness of a peak. */
static bool friction_jumps(const gough_summary *summary, const interval *f, int v) {
    double before = NAN, most = 0, next = 0;

    for (int i = 0; i < WINDOW && summary->joints_ && f->count == WINDOW; i++) {
        const double *look = summary->look_[i];
        const double taken = look[LOOK_LOSS + v] / look[LOOK_RATE + v];
        const double difference = fabs(taken - before);
        before = taken;
        if (difference > most) {
            next = most;
            most = difference;
        } else if (difference > next) {
            next = difference;
        }
    }
    return most > friction_jump * next;
}

/* the same of the loads of the joints */
static void take_load_extremes(gough_summary *summary, interval *f) {
    double s, x;

    for (int v = 0; v < GOUGH_LEGS; v++) {
        gough_leg_summary *leg = &summary->leg[v];
        x = extreme_of(summary, f, LOOK_TOP_LOAD + v, &s);
        if (s > 0) leg->top_load = fmax(leg->top_load, x);
        x = extreme_of(summary, f, LOOK_BASE_LOAD + v, &s);
        if (s > 0) leg->base_load = fmax(leg->base_load, x);
        x = extreme_of(summary, f, LOOK_SIDE + v, &s);
        if (s > 0) leg->side_load = fmax(leg->side_load, x);
    }
}

/* the same of what limits ask for */
static void take_limit_extremes(gough_summary *summary, interval *f) {
    double *const component = &summary->component[0][0][0];
    double s, x;

    for (int v = 0; v < GOUGH_LEGS; v++) {
        gough_leg_summary *leg = &summary->leg[v];
        x = extreme_of(summary, f, LOOK_ACCELERATION + v, &s);
        if (s > 0) leg->acceleration = fmax(leg->acceleration, fabs(x));
    }
    for (int c = 0; c < 3 * GOUGH_COMPONENTS; c++) {
        x = extreme_of(summary, f, LOOK_COMPONENT + c, &s);
        if (s > 0) component[2 * c] = fmin(component[2 * c], x);
        if (s > 0) component[2 * c + 1] = fmax(component[2 * c + 1], x);
    }
}

/* Extremes between the two looks; the looks themselves are among the peaks already. */
static void take_extremes(gough_summary *summary, interval *f) {
    double s, x;

    for (int v = 0; v < GOUGH_LEGS; v++) {
        gough_leg_summary *leg = &summary->leg[v];
        const bool smooth = !friction_jumps(summary, f, v);
        x = extreme_of(summary, f, LOOK_FORCE + v, &s);
        if (s > 0 && smooth) leg->force_min = fmin(leg->force_min, x);
        if (s > 0 && smooth) leg->force_max = fmax(leg->force_max, x);
        x = extreme_of(summary, f, LOOK_POWER + v, &s);
        if (s > 0 && smooth) leg->power_min = fmin(leg->power_min, x);
        if (s > 0 && smooth) leg->power_max = fmax(leg->power_max, x);
        x = extreme_of(summary, f, LOOK_RATE + v, &s);
        if (s > 0) leg->speed = fmax(leg->speed, fabs(x));
        if (summary->brief_) continue;
        x = extreme_of(summary, f, LOOK_LENGTH + v, &s);
        if (s > 0) leg->length_min = fmin(leg->length_min, x);
        if (s > 0) leg->length_max = fmax(leg->length_max, x);
        x = extreme_of(summary, f, LOOK_BASE + v, &s);
        if (s > 0) leg->swing_base = fmax(leg->swing_base, x);
        x = extreme_of(summary, f, LOOK_TOP + v, &s);
        if (s > 0) leg->swing_top = fmax(leg->swing_top, x);
    }
    x = extreme_of(summary, f, LOOK_POSITION, &s);
    if (x > summary->position_deviation) summary->position_deviation = x;
    x = extreme_of(summary, f, LOOK_HALF, &s);
    if (most_angle * x > summary->angle_deviation)
        summary->angle_deviation = fmax(summary->angle_deviation, 2 * asin(fmin(1, x)));
    if (summary->brief_) return;
    x = extreme_of(summary, f, LOOK_CONDITION, &s);
    if (x > summary->condition) {
        summary->condition = x;
        summary->condition_time = summary->look_[f->a][0] + s * f->h;
    }
    if (summary->limited_) take_limit_extremes(summary, f);
}

/* integrals and extremes from look a to the next, by the polynomial through the last `count` looks */
static void sum_up(gough_summary *summary, int count, int a) {
    interval f = {.count = count, .a = a, .h = 0, .made = false};

    for (int i = 0; i < WINDOW; i++) f.time[i] = summary->look_[i][0];
    find_bends(summary, &f);
    integrate(summary, &f);
    if (count < 3) return;
    take_extremes(summary, &f);
    if (summary->joints_) take_load_extremes(summary, &f);
}

/* where the last interval has no look after it */
static void sum_up_last(gough_summary *summary) {
    const int count = summary->looks_ < WINDOW ? (int)summary->looks_ : WINDOW;

    if (count == 3) sum_up(summary, 3, 1);
    if (count >= 2) sum_up(summary, count, WINDOW - 2);
}

/* how far a leg's length goes between two rows beyond both of them, and how fast its rate changes */
static void watch_rows(gough_summary *summary, bool is_row) {
    const double *newest = summary->look_[WINDOW - 1], *before = summary->look_[WINDOW - 2];

    for (int v = 0; v < GOUGH_LEGS; v++) {
        const double length = newest[LOOK_LENGTH + v];
        double *range = summary->between_[v];
        if (summary->looks_ > 1) {
            const double change = newest[LOOK_RATE + v] - before[LOOK_RATE + v];
            summary->acceleration_ =
                fmax(summary->acceleration_, fabs(change) / (newest[0] - before[0]));
        }
        range[0] = fmin(range[0], length);
        range[1] = fmax(range[1], length);
        if (!is_row) continue;
        if (summary->rows > 1) {
            const double low = fmin(range[2], length), high = fmax(range[2], length);
            const double beyond = fmax(low - range[0], range[1] - high);
            if (beyond > summary->between_rows) {
                summary->between_rows = beyond;
                summary->between_leg = v + 1;
            }
        }
        range[0] = range[1] = range[2] = length;
    }
}

void gough_summary_look(gough_summary *summary, const gough_machine *machine, const gough_row *row,
                        bool is_row) {
    const double *value = row->value;
    double *newest = summary->look_[WINDOW - 1], *at_base, *at_top, angle;

    if (is_row) count_row(summary, value[GOUGH_T]);
    if (summary->looks_ > 0 &&
        !(value[GOUGH_T] - newest[0] > quadrature_same_time * fabs(value[GOUGH_T]))) {
        if (is_row && !summary->brief_) watch_rows(summary, true);
        return; /* seen already */
    }
    if (summary->span_ <= 0 && summary->looks_ == 0) summary->origin_ = value[GOUGH_T];
    summary->span_ = value[GOUGH_T] - summary->origin_;
    memmove(summary->look_[0], summary->look_[1], (WINDOW - 1) * sizeof summary->look_[0]);
    newest[0] = value[GOUGH_T];
    for (int v = 0; v < GOUGH_LEGS; v++) {
        newest[LOOK_LENGTH + v] = value[GOUGH_L + v];
        newest[LOOK_RATE + v] = value[GOUGH_DL + v];
        newest[LOOK_FORCE + v] = value[GOUGH_F + v];
        newest[LOOK_POWER + v] = value[GOUGH_P + v];
        newest[LOOK_BASE + v] = newest[LOOK_TOP + v] = NAN;
    }
    at_base = newest + LOOK_BASE;
    at_top = newest + LOOK_TOP;
    if (!summary->brief_ && !isnan(value[GOUGH_X]))
        find_swing(machine, summary->order, value, at_base, at_top);
    newest[LOOK_CONDITION] = value[GOUGH_CONDITION];
    find_deviation(summary->order, value, &newest[LOOK_POSITION], &angle);
    newest[LOOK_HALF] = sin(angle / 2);
    newest[LOOK_EXTERNAL] =
        summary->brief_ ? 0 : summary_external_power(machine, summary->order, value);
    take_peaks(summary, value, at_base, at_top, newest[LOOK_POSITION], angle);
    summary->joints_ = has_joints(machine, value);
    if (summary->joints_) take_joints(summary, value, newest + LOOK_TOP_LOAD);
    take_limits(summary, machine, value, newest);
    summary_saturation(summary, value);
    summary->looks_++;
    if (!summary->brief_) watch_rows(summary, is_row);
    if (summary->looks_ == WINDOW) sum_up(summary, WINDOW, 0);
    if (summary->looks_ >= WINDOW) sum_up(summary, WINDOW, 1);
}

void gough_summary_corner(gough_summary *summary) {
    if (summary->looks_ < 2) return;
    sum_up_last(summary);
    summary->looks_ = 1;
}

void gough_summary_jump(gough_summary *summary) {
    if (summary->looks_ >= 2) sum_up_last(summary);
    summary->looks_ = 0;
}

void gough_summary_end(gough_summary *summary) {
    const bool looked = summary->looks_ > 0;
    const double span = looked ? summary->span_ : summary->last_time - summary->first_time;

    if (looked) {
        sum_up_last(summary);
    } else {
        end_rows(summary);
    }
    for (int v = 0; v < GOUGH_LEGS; v++) {
        gough_leg_summary *leg = &summary->leg[v];
        const double newest = fmax(fabs(leg->force_min), fabs(leg->force_max));
        if (span > 0 && leg->saturated > 0) leg->saturated = fmin(1, leg->saturated / span);
        leg->rms_force = span > 0 ? sqrt(fmax(0, summary->square_[v] / span)) : newest;
        if (!summary->joints_) leg->top_load = leg->base_load = newest;
    }
    if (summary->between_leg == 0 || !(summary->acceleration_ > 0)) return;
    /* chords of a curve with this curvature miss it by at most a hundredth of the stroke */
    double stroke = 0;
    for (int v = 0; v < GOUGH_LEGS; v++)
        stroke = fmax(stroke, summary->leg[v].length_max - summary->leg[v].length_min);
    summary->drawing_step = sqrt(0.08 * stroke / summary->acceleration_);
}
