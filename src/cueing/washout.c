/* The classical washout filter, sample by sample: gough_cueing_sample(). Theory: docs/theory/cueing.md. Units: any consistent set;
 * axes of the vehicle and of the platform are forward, left, up. */
#include "gough/cueing.h"

#include <math.h>
#include <string.h>

#include "cueing/linear_filter.h"
#include "gough/sizes.h"

static const double TURN = 6.283185307179586477; /* 2π */

/* the pitch at which the filter ends, in radians: the rates of the angles grow as 1/cos(pitch) */
static const double STEEPEST = 80 / 57.295779513082320877;

/* ---- parameters -------------------------------------------------------------------------------------------------- */

gough_status gough_washout_init(gough_washout *washout, size_t size, double gravity,
                                double second) {
    if (size != sizeof *washout) return gough_size_refuse(washout, size);
    const double radian = 1 / (TURN * second); /* one radian a second in cycles per unit of time */
    *washout = (gough_washout){
        .gravity = gravity,
        .force_gain = {0.5, 0.5, 0.5},
        .rate_gain = {0.5, 0.5, 0.5},
        .force_limit = INFINITY,
        .rate_limit = INFINITY,
        .frequency = {2.5 * radian, 2.5 * radian, 4 * radian},
        .damping_ratio = {1, 1, 1},
        .washout = {0.25 * radian, 0.25 * radian, 0.25 * radian},
        .turn_frequency = {radian, radian, radian},
        .turn_damping_ratio = {0, 0, 0},
        .tilt_frequency = {5 * radian, 5 * radian},
        .tilt_damping_ratio = {1, 1},
        .tilt_rate = 3 / 57.295779513082320877 / second,
        .tilt_angle = TURN / 4,
    };
    return GOUGH_OK;
}

static bool all_above(const double *number, int count, double least, bool itself) {
    bool good = true;
    for (int i = 0; i < count; i++)
        good &= isfinite(number[i]) && (number[i] > least || (itself && number[i] >= least));
    return good;
}

gough_status gough_washout_check(const gough_washout *w, gough_error *error) {
    const char *flaw = NULL;
    if (!all_above(&w->gravity, 1, 0, false))
        flaw = "gravity must be above 0; without it nothing can be felt by leaning";
    else if (!all_above(w->force_gain, 3, 0, true) || !all_above(w->rate_gain, 3, 0, true))
        flaw = "the gains of forces and rates must be 0 or above";
    else if (!(w->force_limit > 0) || !(w->rate_limit > 0))
        flaw = "the limits of forces and rates must be above 0";
    else if (!all_above(w->frequency, 3, 0, false) || !all_above(w->washout, 3, 0, false))
        flaw = "the frequencies of the translation must be above 0";
    else if (!all_above(w->damping_ratio, 3, 0, false))
        flaw = "the damping ratios of the translation must be above 0";
    else if (!all_above(w->turn_frequency, 3, 0, false))
        flaw = "the frequencies of the rotation must be above 0";
    else if (!all_above(w->turn_damping_ratio, 3, 0, true))
        flaw =
            "the damping ratios of the rotation must be above 0; without one it is of first order";
    else if (!all_above(w->tilt_frequency, 2, 0, false) ||
             !all_above(w->tilt_damping_ratio, 2, 0, false))
        flaw = "frequencies and damping ratios of leaning must be above 0";
    else if (!(w->tilt_rate > 0))
        flaw = "the greatest rate of leaning must be above 0";
    else if (!(w->tilt_angle > 0) || w->tilt_angle > TURN / 4)
        flaw = "the greatest angle of leaning must be above 0 and at most a quarter turn";
    return flaw ? gough_fail(error, GOUGH_ERROR_INPUT, "%s", flaw) : GOUGH_OK;
}

/* ---- the filters ------------------------------------------------------------------------------------------------- */

/* (cue-2): w''' = a − (2ζω + ω_b) w'' − (ω² + 2ζω ω_b) w' − ω² ω_b w */
static void translation_rows(const gough_washout *w, int axis, double row[3]) {
    const double frequency = TURN * w->frequency[axis], slow = TURN * w->washout[axis];
    const double damping = 2 * w->damping_ratio[axis] * frequency;
    row[0] = -frequency * frequency * slow;
    row[1] = -(frequency * frequency + damping * slow);
    row[2] = -(damping + slow);
}

/* w'' = u − 2ζω w' − ω² w */
static void second_order(double cycles, double damping_ratio, double row[2]) {
    const double frequency = TURN * cycles;
    row[0] = -frequency * frequency;
    row[1] = -2 * damping_ratio * frequency;
}

gough_status gough_cueing_begin(gough_cueing *cueing, size_t size, const gough_washout *washout,
                                double period, gough_error *error) {
    if (size != sizeof *cueing) return gough_size_refuse(cueing, size);
    const gough_status status = gough_washout_check(washout, error);
    if (status) return status;
    if (!(period > 0) || !isfinite(period))
        return gough_fail(error, GOUGH_ERROR_INPUT, "the time between samples must be above 0");
    *cueing = (gough_cueing){.washout = *washout, .period = period};
    bool good = true;
    for (int axis = 0; axis < 3; axis++) {
        double row[3];
        translation_rows(washout, axis, row);
        good &= linear_filter_begin(&cueing->translation[axis], 3, row, period);
        if (washout->turn_damping_ratio[axis] > 0) {
            second_order(washout->turn_frequency[axis], washout->turn_damping_ratio[axis], row);
            good &= linear_filter_begin(&cueing->rotation[axis], 2, row, period);
        } else {
            row[0] = -TURN * washout->turn_frequency[axis];
            good &= linear_filter_begin(&cueing->rotation[axis], 1, row, period);
        }
        if (axis == 2) continue;
        second_order(washout->tilt_frequency[axis], washout->tilt_damping_ratio[axis], row);
        good &= linear_filter_begin(&cueing->lean[axis], 2, row, period);
    }
    if (good) return GOUGH_OK;
    return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                      "the filter cannot be stepped in double precision: its frequencies are too "
                      "high or too low for this time between samples");
}

/* ---- one sample -------------------------------------------------------------------------------------------------- */

static double clamp(double x, double most, bool *limited) {
    if (fabs(x) <= most) return x;
    *limited = true;
    return copysign(most, x);
}

/* what the platform shall make felt: gains and limits; force without gravity */
static void wanted(const gough_washout *w, const double force[3], const double rate[3],
                   double wish[3], double turn[3], bool *limited) {
    for (int i = 0; i < 3; i++) {
        const double own = force[i] - (i == 2 ? w->gravity : 0);
        wish[i] = clamp(w->force_gain[i] * own, w->force_limit, limited);
        turn[i] = clamp(w->rate_gain[i] * rate[i], w->rate_limit, limited);
    }
}

/* (cue-2): a = R (f̃ + g e_z) − g e_z */
static void base_acceleration(double R[3][3], const double wish[3], double gravity, double a[3]) {
    for (int i = 0; i < 3; i++)
        a[i] = R[i][0] * wish[0] + R[i][1] * wish[1] + R[i][2] * (wish[2] + gravity) -
               (i == 2 ? gravity : 0);
}

/* (cue-3): rates of roll, pitch and yaw from those about the body's axes */
static void angle_rates(const double angle[3], const double turn[3], double rate[3]) {
    const double s = sin(angle[0]), c = cos(angle[0]);
    const double both = turn[1] * s + turn[2] * c;
    rate[0] = turn[0] + both * tan(angle[1]);
    rate[1] = turn[1] * c - turn[2] * s;
    rate[2] = both / cos(angle[1]);
}

/* (cue-4): the angle for which gravity gives the force of the low pass, approached no faster than the limit */
static void lean(gough_cueing *q, int axis, double wish, bool *limited) {
    const gough_washout *w = &q->washout;
    const double frequency = TURN * w->tilt_frequency[axis];
    linear_filter_take(&q->lean[axis], wish);
    const double force = frequency * frequency * q->lean[axis].state[0];
    const double most = sin(w->tilt_angle);
    const double sine = fmin(most, fmax(-most, force / w->gravity));
    /* forward is felt nose up, which is a negative pitch; left is felt leaning right, a positive roll */
    const int angle = axis == 0 ? 1 : 0;
    const double goal = axis == 0 ? -asin(sine) : asin(sine);
    q->tilt[angle] += clamp(goal - q->tilt[angle], w->tilt_rate * q->period, limited);
}

/* (cue-7): Rᵀ (w''' + g e_z) */
static void feel(const gough_cueing *q, gough_cue *cue) {
    double R[3][3];
    gough_rotation_from_angles(q->angle, R);
    for (int i = 0; i < 3; i++)
        cue->felt[i] = R[0][i] * cue->acceleration[0] + R[1][i] * cue->acceleration[1] +
                       R[2][i] * (cue->acceleration[2] + q->washout.gravity);
}

static void take(gough_cueing *q, const double wish[3], const double turn[3], gough_cue *cue) {
    double R[3][3], a[3], rate[3];
    gough_rotation_from_angles(q->angle, R);
    base_acceleration(R, wish, q->washout.gravity, a);
    angle_rates(q->angle, turn, rate);
    for (int axis = 0; axis < 3; axis++) {
        gough_linear_filter *t = &q->translation[axis], *r = &q->rotation[axis];
        double row[3];
        linear_filter_take(t, a[axis]);
        linear_filter_take(r, rate[axis]);
        translation_rows(&q->washout, axis, row);
        cue->component[axis] = t->state[1];
        cue->velocity[axis] = t->state[2];
        cue->acceleration[axis] =
            a[axis] + row[0] * t->state[0] + row[1] * t->state[1] + row[2] * t->state[2];
    }
    for (int axis = 0; axis < 2; axis++) lean(q, axis, wish[axis], &cue->limited);
    for (int axis = 0; axis < 3; axis++) {
        const gough_linear_filter *r = &q->rotation[axis];
        q->angle[axis] = r->state[r->states - 1] + (axis < 2 ? q->tilt[axis] : 0);
        cue->component[GOUGH_ROLL + axis] = q->angle[axis];
    }
    memcpy(cue->tilt, q->tilt, sizeof cue->tilt);
    feel(q, cue);
}

gough_status gough_cueing_sample(gough_cueing *cueing, const double force[3], const double rate[3],
                                 gough_cue *cue, gough_error *error) {
    double wish[3], turn[3];
    gough_cueing after = *cueing;
    for (int i = 0; i < 3; i++)
        if (!isfinite(force[i]) || !isfinite(rate[i]))
            return gough_fail(error, GOUGH_ERROR_INPUT,
                              "forces and rates of the vehicle must be finite numbers");
    *cue = (gough_cue){.limited = false};
    wanted(&cueing->washout, force, rate, wish, turn, &cue->limited);
    take(&after, wish, turn, cue);
    if (!(fabs(after.angle[1]) < STEEPEST))
        return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                          "the pitch comes to 80 degrees or more: lower the gains of rates or "
                          "forces, or give limits");
    *cueing = after;
    return GOUGH_OK;
}

void gough_specific_force_at(const double force[3], const double rate[3],
                             const double acceleration[3], const double arm[3], double out[3]) {
    const double along =
        rate[0] * arm[0] + rate[1] * arm[1] + rate[2] * arm[2]; /* ω × (ω × r) = ω (ω·r) − r ω² */
    const double square = rate[0] * rate[0] + rate[1] * rate[1] + rate[2] * rate[2];
    double at[3];
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const double turning = acceleration[j] * arm[k] - acceleration[k] * arm[j];
        at[i] = force[i] + turning + rate[i] * along - arm[i] * square;
    }
    memcpy(out, at, sizeof at);
}
