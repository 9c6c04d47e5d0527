/* (design-5): certificates for designs of a search. Where one fails, its pose joins those that designs are compared at, or all
 * limits are asked with more to spare, and the next search starts there. Theory: docs/theory/design.md. */
#include "design/settle.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ROUNDS = 24, MENDING_TRIES = 20, MENDINGS = 3, COARSE = 3, FINE = 6 };

/* what is to spare of a limit first where a certificate gives up, and the most; then it is doubled */
static const double SPARE = 0.01, MOST_SPARE = 0.35;
/* the least singular value is asked to be larger by this factor, and at first at least this; 1 is the greatest there is */
static const double MORE_SINGULAR_VALUE = 1.5, FIRST_SINGULAR_VALUE = 0.05;
/* boxes that the certificate of one design may test */
static const size_t MOST_TESTS = 150000;
/* first steps of a search that only mends */
static const double MENDING_STEP = 0.03;
/* part of the objective that rounding may cost */
static const double ROUNDING_COST = 1e-3;

/* (design-4): lengths between a least and what a telescope makes of it; the least is between the one found and the one needed for
 * the greatest found, so that both ends have something to spare */
static void add_telescope(const search *s, const score *found, gough_reach *reach) {
    const double needed = 0.5 * (found->longest + s->demand.request->telescope);
    const double least = 0.5 * (found->shortest + needed);
    if (isnan(s->demand.request->telescope)) return;
    for (int v = 0; v < GOUGH_LEGS; v++) {
        double *length = reach->limits.length[v];
        length[0] = fmax(length[0], least);
        length[1] = fmin(length[1], 2 * least - s->demand.request->telescope);
    }
}

gough_status design_certify(search *s, const candidate *c, gough_reach *reach,
                            gough_certificate *certificate) {
    const gough_model *model = search_model(s, c->value);
    *certificate = (gough_certificate){.verdict = GOUGH_UNDECIDED};
    if (!model) return GOUGH_ERROR_INPUT;
    const gough_status status = reach_of_design(&s->demand, model, reach, NULL);
    if (status) return status;
    add_telescope(s, &c->score, reach);
    reach->most_tests = MOST_TESTS;
    return gough_box_certify(reach, &s->demand.box, certificate, NULL);
}

/* A limit at which the certificate gave up is asked with more to spare; false: there is no more to ask for. */
static bool spare_more(demand *d, const gough_reach *reach, gough_bind kind) {
    if (kind == GOUGH_BIND_SINGULAR || kind == GOUGH_BIND_SINGULAR_VALUE) {
        const double before = fmax(d->singular_value, reach->asked.least_singular_value);
        d->singular_value = fmax(before * MORE_SINGULAR_VALUE, FIRST_SINGULAR_VALUE);
        return d->singular_value <= 1;
    }
    d->spare[kind] = fmax(2 * d->spare[kind], SPARE);
    return d->spare[kind] <= MOST_SPARE;
}

/* The next search asks for what the last certificate lacked. */
static bool ask_for_more(demand *d, const gough_reach *reach, const gough_certificate *c) {
    if (d->poses < DESIGN_POSES) {
        double *pose = d->pose[d->poses];
        memcpy(pose, c->pose, sizeof c->pose);
        if (search_worst_pose(reach, &d->box, pose) > 0) {
            d->poses++;
            return true;
        }
    }
    return spare_more(d, reach, c->binding.bind);
}

bool design_settle(search *s, gough_design_result *result) {
    const size_t tries = s->expected / 10 + MENDING_TRIES * s->demand.request->keys;
    for (int i = 0; i < ROUNDS && s->best.there && !s->stopped; i++) {
        const candidate tried = s->best;
        gough_reach reach;
        if (design_certify(s, &tried, &reach, &result->certificate)) return false;
        result->tests += result->certificate.tests;
        if (result->certificate.verdict == GOUGH_INSIDE) return true;
        if (!ask_for_more(&s->demand, &reach, &result->certificate)) return false;
        s->best.there = s->nearest.there = false;
        search_from(s, tried.value, MENDING_STEP, tries);
        for (int more = 0; more < MENDINGS && !s->kept && !s->stopped; more++)
            search_from(s, search_best(s)->value, more ? MENDING_STEP : 4 * MENDING_STEP, tries);
    }
    return false;
}

/* ---- rounding ---- */

/* The nearest number with some digits of its range; in its units it then has few decimals. */
static double rounded(const gough_design_request *r, size_t key, double value, int digits) {
    const double range = r->greatest[key] - r->least[key];
    const int decimals = digits - 1 - (int)floor(log10(range));
    const double ten = pow(10, abs(decimals));
    const double round =
        decimals >= 0 ? nearbyint(value * ten) / ten : nearbyint(value / ten) * ten;
    return fmin(fmax(round, r->least[key]), r->greatest[key]);
}

void design_round(search *s, gough_design_result *result) {
    const gough_design_request *r = s->demand.request;
    const candidate exact = s->best;
    for (int digits = COARSE; digits <= FINE && !s->stopped; digits++) {
        candidate c = {.there = true};
        gough_certificate certificate;
        gough_reach reach;
        for (size_t k = 0; k < r->keys; k++) c.value[k] = rounded(r, k, exact.value[k], digits);
        s->best.there = false;
        search_try(s, c.value);
        const bool good =
            s->best.there && s->best.score.objective <= exact.score.objective * (1 + ROUNDING_COST);
        c.score = s->best.score;
        if (!good || design_certify(s, &c, &reach, &certificate)) continue;
        result->tests += certificate.tests;
        if (certificate.verdict != GOUGH_INSIDE) continue;
        result->certificate = certificate;
        s->best = c;
        return;
    }
    s->best = exact;
}
