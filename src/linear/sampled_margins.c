/* Where a sampled loop at rest becomes unstable: edges of the stiffness, longest period and delay, the gains that reach furthest.
 * All of them are roots of the largest multiplier's magnitude less 1. Theory: docs/theory/loop.md. */
#include <math.h>
#include <string.h>

#include "linear/gain_pattern.h"
#include "linear/linear.h"
#include "linear/sampled.h"
#include "linear/symmetric.h"

enum { GRID = 72, BISECTIONS = 120, GOLDEN = 34, DAMPINGS = 16, PERIODS = 64 };

/* above a threshold by this part of it a loop is taken to be if anything holds there */
static const double just_above = 1e-6;

typedef struct {
    const gough_machine *machine;
    sampled_plant plant;
    gough_control control; /* as in the model */
    gain_pattern G, D;
    double stiffness, damping; /* of the model: G times this is its own */
    double ratio;              /* delay over period */
    double threshold; /* least stiffness of the pattern that holds a continuous loop, or 0 */
    double kappa;     /* not above κ_max of the pattern */
    double rate;      /* fastest of the plant itself */
    bool unsolved;    /* LAPACK failed somewhere: no result counts */
    sampled_step step;
    sampled_law law;
    sampled_map map;
} search;

/* ---- gains ----------------------------------------------------------------------------------------------------- */

static void set_gains(search *s, double stiffness, double damping) {
    gough_control *c = &s->control;

    gain_pattern_spread(&s->G, stiffness, c->stiffness, c->cross_stiffness);
    gain_pattern_spread(&s->D, damping, c->damping, c->cross_damping);
}

/* JᵀGJ of the pattern */
static void stiffness_of(const search *s, double K[FREEDOMS][FREEDOMS]) {
    memset(K, 0, sizeof(double[FREEDOMS][FREEDOMS]));
    for (int v = 0; v < GOUGH_LEGS; v++) {
        for (int w = 0; w < GOUGH_LEGS; w++) {
            const double G = v == w ? s->G.own[v] : s->G.cross[v][w];
            for (int i = 0; i < FREEDOMS; i++) {
                for (int j = 0; j < FREEDOMS; j++)
                    K[i][j] +=
                        0.5 * G *
                        (s->plant.J[v][i] * s->plant.J[w][j] + s->plant.J[v][j] * s->plant.J[w][i]);
            }
        }
    }
}

/* −M̂ A₂₁, made symmetric */
static void geometric_of(const search *s, double K[FREEDOMS][FREEDOMS]) {
    double found[FREEDOMS][FREEDOMS] = {{0}};

    for (int i = 0; i < FREEDOMS; i++) {
        for (int j = 0; j < FREEDOMS; j++) {
            for (int k = 0; k < FREEDOMS; k++)
                found[i][j] -= s->plant.mass[i][k] * s->plant.A[FREEDOMS + k][j];
        }
    }
    for (int i = 0; i < FREEDOMS; i++) {
        for (int j = 0; j < FREEDOMS; j++) K[i][j] = 0.5 * (found[i][j] + found[j][i]);
    }
}

/* threshold, κ and the plant's own rate: the scales of the search */
static void scales_of(search *s) {
    double K[FREEDOMS][FREEDOMS], geometric[FREEDOMS][FREEDOMS], gamma[FREEDOMS] = {0};
    double complex shape[FREEDOMS][6];
    double largest = 0;

    stiffness_of(s, K);
    geometric_of(s, geometric);
    s->kappa = symmetric_problem(K[0], s->plant.mass[0], gamma, shape);
    const bool definite = gamma[0] > 0; /* the least; without that the pattern has no threshold */
    const double found = definite ? symmetric_problem(geometric[0], K[0], gamma, shape) : 0;
    if (definite) s->threshold = fmax(0, -gamma[0]);
    largest = symmetric_problem(geometric[0], s->plant.mass[0], gamma, shape);
    s->unsolved = s->kappa < 0 || found < 0 || largest < 0;
    s->rate = sqrt(fmax(0, largest));
    for (int i = 0; i < FREEDOMS; i++)
        s->rate += fabs(s->plant.A[FREEDOMS + i][FREEDOMS + i]); /* of viscous friction */
}

/* ---- the function whose roots are sought ----------------------------------------------------------------------- */

/* the largest |μ| minus 1 with the gains as they are set; positive if it cannot be computed */
static double excess(search *s) {
    sampled_law_of(&s->control, &s->law);
    sampled_map_of(&s->plant, &s->step, &s->law, &s->map);
    const double radius = sampled_radius(&s->map);
    s->unsolved |= isnan(radius);
    return isfinite(radius) ? radius - 1 : 1;
}

static double with_gains(search *s, double stiffness, double damping) {
    set_gains(s, stiffness, damping);
    return excess(s);
}

static bool set_times(search *s, double period, double delay) {
    s->control.sampling.period = period;
    s->control.sampling.delay = delay;
    const bool made = sampled_step_of(&s->plant, period, delay, &s->step);
    s->unsolved |= !made && s->step.unsolved;
    return made;
}

static double by_stiffness(search *s, double G) { return with_gains(s, G, s->damping); }

static double by_period(search *s, double T) {
    if (!set_times(s, T, s->ratio * T)) return 1;
    return with_gains(s, s->stiffness, s->damping);
}

static double by_delay(search *s, double delay) {
    if (!set_times(s, s->control.sampling.period, delay)) return 1;
    return with_gains(s, s->stiffness, s->damping);
}

typedef double quantity(search *s, double x);

/* Between a point where the quantity is negative and one where it is not: regula falsi (Illinois), every third step a bisection */
static double root(search *s, quantity *f, double inside, double outside) {
    double fi = f(s, inside), fo = f(s, outside);

    for (int k = 0; k < BISECTIONS && fabs(outside - inside) > 1e-14 * fabs(inside); k++) {
        double x = inside + (outside - inside) * (fi / (fi - fo));
        if (k % 3 == 2 || !(fabs(x - inside) < fabs(outside - inside)) ||
            !(fabs(x - outside) < fabs(outside - inside)))
            x = 0.5 * (inside + outside);
        const double fx = f(s, x);
        if (fx < 0) {
            inside = x, fi = fx;
            fo *= k % 3 == 1 ? 0.5 : 1;
        } else {
            outside = x, fo = fx;
            fi *= k % 3 == 1 ? 0.5 : 1;
        }
    }
    return 0.5 * (inside + outside);
}

/* ---- the window of stiffness ----------------------------------------------------------------------------------- */

/* no stable mode has a stiffness per mass beyond (2/T + λ)² */
static double utmost(const search *s) {
    const double T = s->control.sampling.period, w = 2 / T + s->rate;

    return 2 * w * w / s->kappa;
}

static int grid_of(const search *s, double G[GRID]) {
    const double top = utmost(s), special[] = {s->stiffness, s->threshold * (1 + just_above),
                                               1.001 * s->threshold, 1.03 * s->threshold};
    const int even = GRID - 1 - (int)(sizeof special / sizeof *special);
    int n = 0;

    G[n++] = 0;
    for (int k = 0; k < even; k++) G[n++] = top * pow(10, -7 * (1 - (double)k / (even - 1)));
    for (size_t k = 0; k < sizeof special / sizeof *special; k++) {
        int place = n;
        if (!(special[k] > 0 && special[k] < top)) continue;
        for (; place > 0 && G[place - 1] > special[k]; place--) G[place] = G[place - 1];
        G[place] = special[k];
        n++;
    }
    return n;
}

/* the least value of a quantity between two points, by golden section; returns where it is */
static double least(search *s, quantity *f, double a, double b, double *value) {
    const double share = 0.6180339887498949;
    double x = b - share * (b - a), y = a + share * (b - a), fx = f(s, x), fy = f(s, y);

    for (int k = 0; k < GOLDEN; k++) {
        if (fx < fy) {
            b = y, y = x, fy = fx;
            x = b - share * (b - a), fx = f(s, x);
        } else {
            a = x, x = y, fx = fy;
            y = a + share * (b - a), fy = f(s, y);
        }
    }
    *value = fmin(fx, fy);
    return fx < fy ? x : y;
}

/* the mode that neither grows nor decays at an edge */
static void name_edge(search *s, double stiffness, gough_sampled_edge *edge) {
    gough_multiplier first;

    edge->stiffness = stiffness;
    by_stiffness(s, stiffness);
    if (!isfinite(stiffness)) return;
    if (sampled_multipliers(s->machine, &s->map, 1, &first) < 1) {
        s->unsolved = true;
        return;
    }
    edge->mode = first.mode;
    edge->frequency = fabs(atan2(first.value[1], first.value[0])) / s->control.sampling.period;
    if (edge->frequency * s->control.sampling.period < 1e-6) edge->frequency = 0;
}

static void window(search *s, gough_sampled_margins *m) {
    double G[GRID], f[GRID], inside;
    const int n = grid_of(s, G);
    int best = 0, low, high;

    for (int k = 0; k < n; k++) {
        f[k] = by_stiffness(s, G[k]);
        if (f[k] < f[best]) best = k;
    }
    for (int k = 0; k < n; k++)
        if (f[k] < 0 && !(fabs(G[k] - s->stiffness) > 0)) best = k;
    inside = G[best];
    if (!(f[best] < 0)) {
        double value;
        inside = least(s, by_stiffness, G[best > 0 ? best - 1 : 0],
                       G[best + 1 < n ? best + 1 : best], &value);
        if (!(value < 0)) return;
    }
    for (low = best; low >= 0 && (f[low] < 0 || !(G[low] < inside)); low--) continue;
    for (high = best; high < n && (f[high] < 0 || !(G[high] > inside)); high++) continue;
    m->open = true;
    name_edge(s, low < 0 ? 0 : root(s, by_stiffness, inside, G[low]), &m->lower);
    name_edge(s, high == n ? (double)INFINITY : root(s, by_stiffness, inside, G[high]), &m->upper);
}

/* ---- margins of period and delay ------------------------------------------------------------------------------- */

/* the largest T, by steps of a factor up or down from the model's own until the sign changes */
static double longest_period(search *s, double T) {
    const double factor = 1.15;
    bool holds = by_period(s, T) < 0;

    for (int k = 0; k < PERIODS; k++) {
        const double next = holds ? T * factor : T / factor;
        if ((by_period(s, next) < 0) != holds)
            return holds ? root(s, by_period, T, next) : root(s, by_period, next, T);
        T = next;
    }
    return (double)NAN;
}

static double longest_delay(search *s, double T, double delay) {
    const bool holds = by_delay(s, delay) < 0;
    const double step = 0.5 * T;

    if (!holds && !(by_delay(s, 0) < 0)) return (double)NAN;
    if (!holds) return root(s, by_delay, 0, delay);
    while (sampled_delay_fits(T, delay + step)) {
        if (!(by_delay(s, delay + step) < 0)) return root(s, by_delay, delay, delay + step);
        delay += step;
    }
    return (double)INFINITY;
}

/* ---- the best gains -------------------------------------------------------------------------------------------- */

/* logarithm of the damping, at the stiffness that is kept in `stiffness` */
static double by_damping(search *s, double log_damping) {
    return with_gains(s, s->stiffness, exp(log_damping));
}

/* the least largest |μ| that a damping gives at a stiffness, less 1, and that damping */
static double best_of_dampings(search *s, double stiffness, double *damping) {
    const double high = log(2 * (2 / s->control.sampling.period + s->rate) / s->kappa);
    const double step = log(1e4) / (DAMPINGS - 1);
    double value[DAMPINGS], least_value;
    int best = 0;

    s->stiffness = stiffness;
    for (int k = 0; k < DAMPINGS; k++) {
        value[k] = by_damping(s, high - step * k);
        if (value[k] < value[best]) best = k;
    }
    const double middle = high - step * best;
    *damping = exp(least(s, by_damping, middle - step, middle + step, &least_value));
    return least_value;
}

static double by_best_stiffness(search *s, double log_stiffness) {
    return best_of_dampings(s, exp(log_stiffness), &s->damping);
}

/* at the threshold, of a period */
static double by_limit(search *s, double log_period) {
    const double T = exp(log_period);
    double damping;

    if (!set_times(s, T, s->ratio * T)) return 1;
    return best_of_dampings(s, s->threshold * (1 + just_above), &damping);
}

/* with fewer digits than an edge: the function is a minimum itself */
static double coarse_root(search *s, quantity *f, double inside, double outside) {
    while (outside - inside > 1e-7 || inside - outside > 1e-7) {
        const double middle = 0.5 * (inside + outside);
        if (f(s, middle) < 0)
            inside = middle;
        else
            outside = middle;
    }
    return 0.5 * (inside + outside);
}

static void best_gains(search *s, gough_sampled_margins *m) {
    const double top = log(utmost(s)), step = log(2);
    double low = log(fmax(s->threshold * (1 + just_above), 1e-6 * utmost(s)));

    m->best_stiffness = m->best_damping = (double)NAN;
    if (!(by_best_stiffness(s, low) < 0)) return;
    while (low + step < top && by_best_stiffness(s, low + step) < 0) low += step;
    m->best_stiffness = exp(coarse_root(s, by_best_stiffness, low, low + step));
    by_best_stiffness(s, log(m->best_stiffness));
    m->best_damping = s->damping;
}

static double period_limit(search *s, double T) {
    double here = log(T);
    const double step = log(1.5);
    const bool holds = by_limit(s, here) < 0;

    for (int k = 0; k < PERIODS; k++) {
        const double next = here + (holds ? step : -step);
        if ((by_limit(s, next) < 0) != holds)
            return exp(holds ? coarse_root(s, by_limit, here, next)
                             : coarse_root(s, by_limit, next, here));
        here = next;
    }
    return (double)NAN;
}

/* ---- all of it ------------------------------------------------------------------------------------------------- */

static void find(search *s, gough_sampled_margins *m) {
    const double T = s->control.sampling.period, delay = s->control.sampling.delay;
    const double G = s->stiffness, D = s->damping;

    m->damping = D;
    if (set_times(s, T, delay)) window(s, m);
    m->longest_period = longest_period(s, T);
    set_times(s, T, delay);
    m->longest_delay = longest_delay(s, T, delay);

    memset(s->control.integral, 0, sizeof s->control.integral);
    if (set_times(s, T, delay)) best_gains(s, m);
    if (s->threshold > 0) m->period_limit = period_limit(s, T);
    s->stiffness = G, s->damping = D;
}

gough_status gough_sampled_margins_at_rest(const gough_model *model,
                                           const double component[GOUGH_COMPONENTS],
                                           gough_sampled_margins *margins, gough_error *error) {
    search s = {.machine = &model->machine};
    gough_state state;
    const gough_sampled_edge none = {.stiffness = NAN, .frequency = NAN, .mode = {.name = "none"}};
    gough_status status;

    memset(margins, 0, sizeof *margins);
    margins->lower = margins->upper = none;
    margins->longest_period = margins->longest_delay = (double)NAN;
    margins->best_stiffness = margins->best_damping = margins->period_limit = (double)NAN;
    status = sampled_rest_of(model, component, &s.plant, &s.control, &state, error);
    if (status != GOUGH_OK) return status;
    s.stiffness =
        gain_pattern_of(s.control.stiffness, (const double(*)[6])s.control.cross_stiffness,
                        s.control.coupled, &s.G);
    s.damping = gain_pattern_of(s.control.damping, (const double(*)[6])s.control.cross_damping,
                                s.control.coupled, &s.D);
    s.ratio = s.control.sampling.delay / s.control.sampling.period;
    scales_of(&s);
    if (s.kappa > 0) find(&s, margins);
    if (!s.unsolved) return GOUGH_OK;
    return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                      "could not compute the window of stiffness and the margins of the sampled "
                      "loop at rest: LAPACK did not solve one of its problems");
}
