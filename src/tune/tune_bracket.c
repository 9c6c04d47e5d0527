/* Between two points of the curve: the least G that meets what is asked, on a grid of quarters of quarters. Theory:
 * docs/theory/tuning.md. */
#include <math.h>

#include "tune/tune.h"

/* G is bracketed to this, relative */
static const double width = 1e-4;

/* The curve is nearly a power of G between two of its points: so often the place where it meets what is asked is guessed, and only
 * the ends of the grid's cell there are run. */
enum { GUESSES = 4, INSIDE = 3 };

/* two G of the grid; and two points that were run, the greatest that was found not to do and the least above it that does */
typedef struct {
    double fails, does;
} cell;
typedef struct {
    gough_tuning_point fails, does;
} known;

static double quarter(const cell *c, int i) {
    return c->fails * pow(c->does / c->fails, (i + 1.0) / (INSIDE + 1));
}

static bool is_narrow(const cell *c) { return !(c->does > c->fails * (1 + width)); }

/* the quarter of a cell in which the curve meets what is asked, if it does so from G = border on and as is known */
static cell narrowed(const cell *c, const known *k, double border) {
    cell in = *c;

    for (int i = 0; i < INSIDE; i++) {
        const double stiffness = quarter(c, i);
        if (stiffness >= k->does.stiffness ||
            (stiffness > k->fails.stiffness && stiffness >= border)) {
            in.does = stiffness;
            break;
        }
        in.fails = stiffness;
    }
    return in;
}

/* Runs those of rising G that nothing is known about, up to the first that does. */
static gough_status run_unknown(tune *t, known *k, const double *stiffness, int count,
                                gough_error *error) {
    gough_tuning_point point[INSIDE];
    double unknown[INSIDE];
    size_t runs = 0;
    gough_status status = GOUGH_OK;

    for (int i = 0; i < count; i++) {
        if (stiffness[i] > k->fails.stiffness && stiffness[i] < k->does.stiffness)
            unknown[runs++] = stiffness[i];
    }
    if (runs > 0) status = tune_evaluate(t, unknown, runs, point, error);
    for (size_t i = 0; i < runs && status == GOUGH_OK; i++) {
        if (tune_meets(t, &point[i])) {
            k->does = point[i];
            break;
        }
        k->fails = point[i];
    }
    t->tuning->stiffness = k->does.stiffness;
    t->tuning->fails = k->fails.stiffness;
    return status;
}

/* how much of what is asked a run takes */
static double share(const tune *t, const gough_tuning_point *p) {
    return fmax(p->position_deviation / t->options->deviation,
                p->angle_deviation / t->options->angle_deviation);
}

/* The G at which the power law through both points meets the accuracy. NaN if there is no such law, for example because a run
 * ended early. */
static double guess(const tune *t, const known *k) {
    const double above = log(share(t, &k->fails)), below = log(share(t, &k->does));
    const double ratio = k->does.stiffness / k->fails.stiffness;

    if (k->fails.cause != GOUGH_END_DONE || !isfinite(above) || !(above > below)) return NAN;
    return k->fails.stiffness * pow(ratio, above / (above - below));
}

gough_status tune_refine(tune *t, gough_tuning_point *fails, gough_tuning_point *does,
                         gough_error *error) {
    cell whole = {fails->stiffness, does->stiffness};
    known k = {*fails, *does};
    gough_status status = GOUGH_OK;

    for (int i = 0; i < GUESSES && status == GOUGH_OK; i++) {
        const double border = guess(t, &k);
        cell c = whole;
        if (isnan(border)) break;
        while (!is_narrow(&c)) c = narrowed(&c, &k, border);
        const double ends[] = {c.fails, c.does};
        status = run_unknown(t, &k, ends, 2, error);
    }
    while (!is_narrow(&whole) && status == GOUGH_OK) {
        double inside[INSIDE];
        for (int i = 0; i < INSIDE; i++) inside[i] = quarter(&whole, i);
        status = run_unknown(t, &k, inside, INSIDE, error);
        whole = narrowed(&whole, &k, INFINITY);
    }
    *fails = k.fails;
    *does = k.does;
    return status;
}
