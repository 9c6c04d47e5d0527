/* Keeps a platform within what its legs can do: gough_limiter_sample(). Theory: docs/theory/cueing.md. */
#define NUMBER_DOUBLE
#include <math.h>
#include <string.h>

#include "cueing/nearest_rates.h"
#include "gough/cueing.h"
#include "gough/sizes.h"
#include "kernel/solve.h"

/* steps of gough_pose_from_lengths() at most: one sample moves the platform little */
enum { POSE_STEPS = 8 };

static gough_status check_bounds(const gough_leg_bounds *b, gough_error *error) {
    bool good = true;
    for (int v = 0; v < GOUGH_LEGS; v++)
        good &= b->length[v][0] >= 0 && b->length[v][1] > b->length[v][0] &&
                isfinite(b->length[v][1]) && b->speed[v] > 0 && b->acceleration[v] > 0 &&
                isfinite(b->acceleration[v]);
    if (good) return GOUGH_OK;
    return gough_fail(error, GOUGH_ERROR_INPUT,
                      "each leg needs a least and a greatest length, a greatest speed and a "
                      "greatest acceleration above 0");
}

gough_status gough_limiter_begin(gough_limiter *limiter, size_t size, const gough_machine *machine,
                                 const gough_leg_bounds *bounds, const double about[3],
                                 double weight, double gain, double period, const gough_state *pose,
                                 gough_error *error) {
    if (size != sizeof *limiter) return gough_size_refuse(limiter, size);
    gough_status status = check_bounds(bounds, error);
    if (status) return status;
    bool good = weight > 0 && isfinite(weight) && period > 0 && isfinite(period) && gain >= 0 &&
                gain * period < 1;
    for (int i = 0; i < 3; i++) good &= isfinite(about[i]);
    if (!good)
        return gough_fail(
            error, GOUGH_ERROR_INPUT,
            "a limiter needs a weight and a period above 0, and a gain from 0 to below "
            "one over the period");
    *limiter = (gough_limiter){.machine = machine,
                               .bounds = *bounds,
                               .weight = weight,
                               .gain = gain,
                               .period = period,
                               .state = *pose};
    memcpy(limiter->about, about, sizeof limiter->about);
    status = gough_leg_kinematics(machine, pose, NULL, limiter->length, NULL, NULL);
    if (status) return gough_fail(error, status, "the matrix of the pose is not a rotation");
    for (int v = 0; v < GOUGH_LEGS; v++)
        if (!(limiter->length[v] >= bounds->length[v][0] &&
              limiter->length[v] <= bounds->length[v][1]))
            return gough_fail(error, GOUGH_ERROR_INPUT,
                              "leg %d is not within its stroke where the platform rests", v + 1);
    return GOUGH_OK;
}

/* (cue-8), (cue-9): the greatest rate at the end of a step from which a leg can still stop before it is `room` longer,
 * without being longer within the step; rates count in the direction of the bound */
static double greatest_rate(double rate, double room, double most, double acceleration, double h) {
    const double half = 0.5 * acceleration * h;
    const double root = half * half + acceleration * (2 * room - h * rate);
    double y = fmin(fmin(most, rate + 2 * half), sqrt(fmax(0, root)) - half);
    /* a leg that turns round within the step is longest before its end */
    if (y < 0 && rate > 0 && room > 0) y = fmin(y, rate - rate * rate * h / (2 * room));
    return y;
}

/* The bounds of the next rates. Braking is always within them; where rounding makes them contradict each other, the leg brakes. */
static void next_bounds(const gough_limiter *q, double least[RATES], double greatest[RATES]) {
    for (int v = 0; v < GOUGH_LEGS; v++) {
        const double rate = q->rate[v], change = q->bounds.acceleration[v] * q->period;
        const double up = q->bounds.length[v][1] - q->length[v],
                     down = q->length[v] - q->bounds.length[v][0];
        const double brake = rate - copysign(fmin(change, fabs(rate)), rate);
        greatest[v] = greatest_rate(rate, fmax(0, up), q->bounds.speed[v],
                                    q->bounds.acceleration[v], q->period);
        least[v] = -greatest_rate(-rate, fmax(0, down), q->bounds.speed[v],
                                  q->bounds.acceleration[v], q->period);
        greatest[v] = fmax(greatest[v], rate - change);
        least[v] = fmin(least[v], rate + change);
        if (least[v] > greatest[v])
            least[v] = greatest[v] = fmin(fmax(brake, greatest[v]), least[v]);
    }
}

/* (cue-10): H = J⁻ᵀ W J⁻¹ with the Jacobian of the point's motion */
static bool metric(const gough_limiter *q, double H[RATES][RATES]) {
    double J[RATES][RATES], inverse[RATES][RATES] = {{0}}, arm[3];
    if (gough_jacobian(q->machine, &q->state, J)) return false;
    for (int i = 0; i < 3; i++)
        arm[i] = q->state.rotation[i][0] * q->about[0] + q->state.rotation[i][1] * q->about[1] +
                 q->state.rotation[i][2] * q->about[2];
    for (int v = 0; v < RATES; v++) {
        double *n = J[v];
        for (int i = 0; i < 3; i++) {
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            n[3 + i] += n[j] * arm[k] - n[k] * arm[j];
        }
        inverse[v][v] = 1;
    }
    /* inverse[k] becomes column k of J⁻¹ */
    (void)solve_six(J, inverse, RATES);
    bool good = true;
    for (int a = 0; a < RATES; a++)
        for (int b = 0; b < RATES; b++) {
            H[a][b] = 0;
            for (int i = 0; i < RATES; i++)
                H[a][b] += (i < 3 ? 1 : q->weight) * inverse[a][i] * inverse[b][i];
            good &= isfinite(H[a][b]);
        }
    return good;
}

gough_status gough_limiter_sample(gough_limiter *limiter, const double wanted_length[GOUGH_LEGS],
                                  const double wanted_rate[GOUGH_LEGS], bool limited[GOUGH_LEGS],
                                  gough_error *error) {
    double wanted[RATES], least[RATES], greatest[RATES], H[RATES][RATES], y[RATES];
    gough_limiter next = *limiter;
    bool within = true;
    next_bounds(limiter, least, greatest);
    for (int v = 0; v < RATES; v++) {
        wanted[v] = wanted_rate[v] + limiter->gain * (wanted_length[v] - limiter->length[v]);
        if (!isfinite(wanted[v]))
            return gough_fail(error, GOUGH_ERROR_INPUT,
                              "wanted lengths and rates must be finite numbers");
        within &= wanted[v] >= least[v] && wanted[v] <= greatest[v];
    }
    memcpy(y, wanted, sizeof y);
    if (!within) {
        if (!metric(limiter, H))
            return gough_fail(error, GOUGH_ERROR_NUMERICAL, "the pose is singular");
        nearest_rates(H, wanted, least, greatest, y);
    }
    for (int v = 0; v < RATES; v++) {
        next.rate[v] = y[v];
        next.length[v] += 0.5 * limiter->period * (limiter->rate[v] + y[v]);
        next.length[v] =
            fmin(limiter->bounds.length[v][1], fmax(limiter->bounds.length[v][0], next.length[v]));
        if (limited) limited[v] = !within && (y[v] <= least[v] || y[v] >= greatest[v]);
    }
    const gough_status status = gough_pose_from_lengths(limiter->machine, next.length, POSE_STEPS,
                                                        &next.state, NULL, error);
    if (status == GOUGH_OK) *limiter = next;
    return status;
}
