/* How much of a small oscillating force is felt, (cue-6). Theory: docs/theory/cueing.md. */
#include <complex.h>
#include <math.h>

#include "gough/cueing.h"

static const double TURN = 6.283185307179586477; /* 2π */

/* frequencies that are looked at first, evenly over the logarithm, and how far beyond those of the filters; halvings after that */
enum { LOOKS = 2000, SECTIONS = 80 };
static const double BEYOND = 1e4;

/* H = P (1 − L) + L of x and y; H = P of z, with the high pass P = s³/((s² + 2ζωs + ω²)(s + ω_b)) and the low pass L */
static double complex felt_gain(const gough_washout *w, int axis, double frequency) {
    const double complex s = I * TURN * frequency;
    const double own = TURN * w->frequency[axis], slow = TURN * w->washout[axis];
    const double complex high =
        s * s * s / ((s * s + 2 * w->damping_ratio[axis] * own * s + own * own) * (s + slow));
    if (axis == 2) return high;
    const double tilt = TURN * w->tilt_frequency[axis];
    const double complex low =
        tilt * tilt / (s * s + 2 * w->tilt_damping_ratio[axis] * tilt * s + tilt * tilt);
    return high * (1 - low) + low;
}

static gough_status check_axis(const gough_washout *washout, int axis, gough_error *error) {
    if (axis < 0 || axis > 2)
        return gough_fail(error, GOUGH_ERROR_INPUT, "axis %d: axes are 0 (x), 1 (y) and 2 (z)",
                          axis);
    return gough_washout_check(washout, error);
}

gough_status gough_washout_gain(const gough_washout *washout, int axis, double frequency,
                                double gain[2], gough_error *error) {
    const gough_status status = check_axis(washout, axis, error);
    if (status) return status;
    if (!(frequency >= 0) || !isfinite(frequency))
        return gough_fail(error, GOUGH_ERROR_INPUT, "the frequency must be 0 or above");
    const double complex felt = felt_gain(washout, axis, frequency);
    gain[0] = creal(felt), gain[1] = cimag(felt);
    return GOUGH_OK;
}

/* the least magnitude between two logarithms of frequencies, by the golden section */
static gough_felt_gain narrow(const gough_washout *w, int axis, double below, double above) {
    static const double golden = 0.61803398874989484820;
    double x[2] = {above - golden * (above - below), below + golden * (above - below)}, y[2];
    for (int i = 0; i < 2; i++) y[i] = cabs(felt_gain(w, axis, exp(x[i])));
    for (int i = 0; i < SECTIONS; i++) {
        const int keep = y[0] < y[1] ? 0 : 1, drop = 1 - keep;
        if (keep == 0)
            above = x[1];
        else
            below = x[0];
        x[drop] = x[keep], y[drop] = y[keep];
        x[keep] = keep == 0 ? above - golden * (above - below) : below + golden * (above - below);
        y[keep] = cabs(felt_gain(w, axis, exp(x[keep])));
    }
    return (gough_felt_gain){fmin(y[0], y[1]), exp(y[0] < y[1] ? x[0] : x[1])};
}

gough_status gough_washout_felt(const gough_washout *washout, int axis, gough_felt_gain *gain,
                                gough_error *error) {
    const gough_status status = check_axis(washout, axis, error);
    if (status) return status;
    *gain = (gough_felt_gain){0, 0};
    if (axis == 2) return GOUGH_OK; /* a constant force is not felt at all */
    const double own[3] = {washout->frequency[axis], washout->washout[axis],
                           washout->tilt_frequency[axis]};
    const double first = log(fmin(own[0], fmin(own[1], own[2])) / BEYOND);
    const double step = (log(fmax(own[0], fmax(own[1], own[2])) * BEYOND) - first) / LOOKS;
    int best = 0;
    double least = INFINITY;
    for (int i = 0; i <= LOOKS; i++) {
        const double here = cabs(felt_gain(washout, axis, exp(first + i * step)));
        if (here < least) least = here, best = i;
    }
    *gain = narrow(washout, axis, first + (best - 1) * step, first + (best + 1) * step);
    return GOUGH_OK;
}
