/* gough_design(): checks of the request, the order of the searches, and what is told of them. Theory: docs/theory/design.md. */
#include "gough/design.h"

#include <math.h>
#include <string.h>

#include "base/quantity.h"
#include "design/settle.h"
#include "gough/sizes.h"

/* designs to try without a number, and more for each key; the share of CRS2, in percent; those of the rest follow;
 * boxes that the worst values, and each smaller box, may test */
enum {
    TRIES = 500,
    SHARE = 60,
    LEAST_TRIES = 10,
    ENVELOPE_TESTS = 80000,
    PART_TESTS = 20000,
    PART_HALVINGS = 12
};

/* first steps of the local searches: from the best of all, from the start, and from the best of both */
static const double STEP_BEST = 0.05, STEP_START = 0.15, STEP_LAST = 0.01;

gough_status gough_design_request_init(gough_design_request *request, size_t size) {
    if (size != sizeof *request) return gough_size_refuse(request, size);
    *request = (gough_design_request){.size = size, .telescope = NAN};
    request->weight[GOUGH_AIM_FORCE] = 1;
    return GOUGH_OK;
}

const char *gough_aim_name(gough_aim aim) {
    static const char *const name[GOUGH_AIMS] = {"force", "stroke", "speed", "footprint"};
    return (unsigned)aim < GOUGH_AIMS ? name[aim] : "unknown";
}

/* ---- checks ---- */

static gough_status check_keys(const gough_design_request *r, gough_error *error) {
    if (!r->make || r->keys < 1 || r->keys > GOUGH_DESIGN_KEYS)
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "a design needs a function that makes models, and 1 to %d numbers that "
                          "vary, not %zu",
                          GOUGH_DESIGN_KEYS, r->keys);
    for (size_t k = 0; k < r->keys; k++)
        if (!(r->least[k] < r->greatest[k]) || !isfinite(r->greatest[k] - r->least[k]) ||
            !isfinite(r->start[k]))
            return gough_fail(error, GOUGH_ERROR_INPUT,
                              "number %zu of the design must have a finite start, and two finite "
                              "bounds, the first below the second",
                              k + 1);
    return GOUGH_OK;
}

static gough_status check_request(const gough_design_request *r, gough_error *error) {
    double sum = 0;
    gough_status status =
        gough_size_check(r->size, sizeof(gough_design_request), "gough_design_request", error);
    if (!status) status = check_keys(r, error);
    if (status) return status;
    for (int k = 0; k < GOUGH_AIMS; k++) {
        if (!(r->weight[k] >= 0 && r->weight[k] < INFINITY)) sum = NAN;
        sum += r->weight[k];
    }
    if (!(sum > 0))
        return gough_fail_key(error, GOUGH_ERROR_INPUT, "design.minimize",
                              "design.minimize must have weights that are 0 or greater, and one "
                              "that is greater");
    if (!isnan(r->telescope) && !(r->telescope >= 0 && r->telescope < INFINITY))
        return gough_fail_key(error, GOUGH_ERROR_INPUT, "design.telescope",
                              "design.telescope must be 0 or greater, not %.9g" IN_LENGTH,
                              r->telescope);
    if (!(r->least_singular_value >= 0 && r->least_singular_value < INFINITY))
        return gough_fail_key(error, GOUGH_ERROR_INPUT, "design.least_singular_value",
                              "design.least_singular_value must be 0 or greater, not %.9g",
                              r->least_singular_value);
    if (r->evaluations && (r->evaluations < LEAST_TRIES || r->evaluations > 1000000))
        return gough_fail_key(error, GOUGH_ERROR_INPUT, "design.evaluations",
                              "design.evaluations must be from %d to 1000000, not %zu", LEAST_TRIES,
                              r->evaluations);
    return GOUGH_OK;
}

/* The box of the start's model. */
static gough_status find_box(search *s, gough_error *error) {
    const gough_design_request *r = s->demand.request;
    const gough_model *model = NULL;
    const gough_status status = r->make(r->context, r->start, &model, error);
    double size = 0;
    if (status) return status;
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        const double *range = model->workspace.box[c];
        if (!(range[0] <= 0 && range[1] >= 0 && isfinite(range[1] - range[0]))) size = NAN;
        s->demand.box.least[c] = range[0], s->demand.box.greatest[c] = range[1];
        size += range[1] - range[0];
    }
    if (size > 0) return GOUGH_OK;
    return gough_fail_key(error, GOUGH_ERROR_INPUT, "workspace.box",
                          "workspace.box is missing or is no box about home: it is the "
                          "requirement that a design must meet");
}

/* Values of the start; aims of several are measured in them. */
static gough_status find_start(search *s, gough_design_result *result, gough_error *error) {
    const gough_design_request *r = s->demand.request;
    int aims = 0;
    score own;
    for (int k = 0; k < GOUGH_AIMS; k++) s->demand.unit[k] = 1, aims += r->weight[k] > 0;
    score_of(&s->demand, search_model(s, r->start), &own);
    s->evaluations++;
    for (int k = 0; k < GOUGH_AIMS; k++) {
        if (!(r->weight[k] > 0)) continue;
        result->aim[k][0] = isfinite(own.aim[k]) ? own.aim[k] : NAN;
        if (aims > 1) s->demand.unit[k] = own.aim[k];
        if (own.aim[k] > 0 && isfinite(own.aim[k])) continue;
        if (k == GOUGH_AIM_FORCE && aims == 1 && !(own.aim[k] <= 0)) continue;
        return gough_fail_key(error, GOUGH_ERROR_INPUT, "design.minimize",
                              "design.minimize: the %s of the study as written %s, so that there "
                              "is nothing to compare with",
                              gough_aim_name((gough_aim)k),
                              own.aim[k] <= 0 ? k == GOUGH_AIM_SPEED
                                                    ? "is 0, as it has no workspace.velocity and "
                                                      "no workspace.angular_velocity"
                                                    : "is 0"
                                              : "is not finite, as a pose is singular");
    }
    double sum = 0;
    for (int k = 0; k < GOUGH_AIMS; k++)
        if (r->weight[k] > 0) sum += r->weight[k] * own.aim[k] / s->demand.unit[k];
    result->objective[0] = isfinite(sum) ? sum : NAN;
    result->start_meets = own.excess <= NO_EXCESS;
    s->whole = isfinite(sum) && sum > 0 ? sum : 1;
    return GOUGH_OK;
}

/* ---- the search ---- */

static void search_everywhere(search *s) {
    const gough_design_request *r = s->demand.request;
    const size_t all = s->expected * SHARE / 100, rest = (s->expected - all) / 5;
    search_all(s, r->start, all);
    if (s->best.there && s->best.score.objective > 0) s->whole = s->best.score.objective;
    const candidate first = *search_best(s);
    search_from(s, first.value, STEP_BEST, 2 * rest);
    search_from(s, r->start, STEP_START, 2 * rest);
    const candidate second = *search_best(s);
    search_from(s, second.value, STEP_LAST, rest);
}

static void tell(search *s, const candidate *c, gough_design_result *result) {
    const gough_design_request *r = s->demand.request;
    memcpy(result->value, c->value, sizeof result->value);
    for (int k = 0; k < GOUGH_AIMS; k++)
        if (r->weight[k] > 0 && isfinite(c->score.aim[k])) result->aim[k][1] = c->score.aim[k];
    if (isfinite(c->score.objective)) result->objective[1] = c->score.objective;
    result->evaluations = s->evaluations;
    for (int kind = 0; kind < GOUGH_BINDS; kind++)
        if (s->demand.spare[kind] > DESIGN_SPARE) result->spare[kind] = s->demand.spare[kind];
    result->singular_value = fmax(r->least_singular_value, s->demand.singular_value);
}

static gough_status tell_found(search *s, gough_design_result *result) {
    const candidate c = s->best;
    gough_reach reach;
    result->found = true;
    tell(s, &c, result);
    design_actives(s, &c, result);
    if (reach_of_design(&s->demand, search_model(s, c.value), &reach, NULL)) return GOUGH_OK;
    reach.most_tests = ENVELOPE_TESTS;
    result->bounded =
        gough_workspace_envelope(&reach, &s->demand.box, &result->envelope, NULL) == GOUGH_OK;
    return GOUGH_OK;
}

/* The largest part of the box that is certified, by halving. */
static double certified_part(const gough_reach *reach, const gough_box *box,
                             gough_design_result *result) {
    gough_reach few = *reach;
    double low = 0, high = 1;
    few.most_tests = PART_TESTS;
    for (int i = 0; i < PART_HALVINGS; i++) {
        const double part = 0.5 * (low + high);
        gough_certificate c;
        gough_box smaller;
        for (int k = 0; k < GOUGH_COMPONENTS; k++)
            smaller.least[k] = part * box->least[k], smaller.greatest[k] = part * box->greatest[k];
        if (gough_box_certify(&few, &smaller, &c, NULL)) break;
        result->tests += c.tests;
        if (c.verdict == GOUGH_INSIDE)
            low = part;
        else
            high = part;
    }
    return low;
}

/* The design that comes nearest, and what it misses. */
static gough_status tell_missing(search *s, gough_design_result *result, gough_error *error) {
    const candidate c = *search_best(s);
    gough_reach reach;
    tell(s, &c, result);
    if (s->stopped) return gough_fail(error, GOUGH_ERROR_NUMERICAL, "the search was stopped");
    result->excess = c.score.excess < EXCESS_SINGULAR ? fmax(c.score.excess, 0) : INFINITY;
    if (!(c.score.excess < EXCESS_NO_MODEL))
        return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                          "no numbers within the bounds make a valid machine: %s",
                          s->refused.message);
    design_actives(s, &c, result);
    result->telescope_fails = telescope_lacks(s->demand.request, c.score.shortest,
                                              c.score.longest) >= 0.99 * result->excess;
    if (design_certify(s, &c, &reach, &result->certificate) == GOUGH_OK)
        result->scale = certified_part(&reach, &result->box, result);
    if (!(result->excess > 0))
        return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                          "workspace.box could not be certified: the nearest numbers keep all "
                          "limits at the poses that are compared, but the proof needs more boxes "
                          "than the search may test; ask for a larger "
                          "design.least_singular_value or a smaller box");
    if (!(result->excess < INFINITY))
        return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                          "no numbers within the bounds meet workspace.box: a pose of it is "
                          "singular, or lies beyond a singular pose, with all that were tried");
    return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                      "no numbers within the bounds meet workspace.box: the nearest exceed a limit "
                      "by %.3g %% of its size",
                      100 * result->excess);
}

gough_status gough_design(const gough_design_request *request, gough_design_result *result,
                          gough_error *error) {
    search s = {.demand = {.request = request}, .whole = 1};
    gough_status status = check_request(request, error);
    memset(result, 0, sizeof *result);
    for (int k = 0; k < GOUGH_AIMS; k++) result->aim[k][0] = result->aim[k][1] = NAN;
    result->objective[0] = result->objective[1] = NAN;
    result->certificate.verdict = GOUGH_UNDECIDED;
    if (!status) status = find_box(&s, error);
    if (status) return status;
    for (int kind = 0; kind < GOUGH_BINDS; kind++) s.demand.spare[kind] = DESIGN_SPARE;
    result->box = s.demand.box;
    demand_poses(&s.demand);
    s.expected = request->evaluations ? request->evaluations : TRIES * (request->keys + 1);
    status = find_start(&s, result, error);
    if (status) return status;
    search_everywhere(&s);
    if (!design_settle(&s, result)) return tell_missing(&s, result, error);
    design_round(&s, result);
    return s.stopped ? tell_missing(&s, result, error) : tell_found(&s, result);
}
