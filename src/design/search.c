/* (design-5): merit of a design, and the searches of NLopt through the cube of all designs. Theory: docs/theory/design.md. */
#include "design/search.h"

#include <math.h>
#include <nlopt.h>
#include <string.h>

/* weight of an excess beside the objective, in parts of it: mostly well above what easing a limit by its size can win; where it is
 * not, as for a range of lengths far wider than the strokes, it grows by a factor up to the most */
static const double PENALTY = 100, MORE_PENALTY = 10, MOST_PENALTY = 1e6;
/* objectives beyond this are as bad as this: near singular poses they have no bound */
static const double MOST = 1e3;
/* designs closer than this part of a range count as one */
static const double SAME = 1e-7;

/* of searches for a pose: steps in parts of the box, and what a limit may have to spare where they have a slope */
enum { POSE_TRIES = 200 };
static const double POSE_SAME = 1e-5, POSE_STEP = 0.02, POSE_SPARE = 0.05;

static bool is_better(const candidate *a, const score *s) {
    return !a->there || s->objective < a->score.objective;
}

const gough_model *search_model(search *s, const double *value) {
    const gough_design_request *r = s->demand.request;
    const gough_model *model = NULL;
    return r->make(r->context, value, &model, &s->refused) ? NULL : model;
}

double search_try(search *s, const double *value) {
    const gough_design_request *r = s->demand.request;
    candidate tried = {.there = true};
    memcpy(tried.value, value, r->keys * sizeof *value);
    score_of(&s->demand, search_model(s, value), &tried.score);
    s->evaluations++;
    if (tried.score.excess <= NO_EXCESS && is_better(&s->best, &tried.score)) s->best = tried;
    if (!s->nearest.there || tried.score.excess < s->nearest.score.excess) s->nearest = tried;
    if (r->progress && s->evaluations % 16 == 0) {
        const double part = (double)s->evaluations / (double)s->expected;
        if (r->progress(r->progress_context, fmin(part, 1))) s->stopped = true;
    }
    const double objective = tried.score.objective / s->whole;
    const double merit = (objective < MOST ? objective : MOST) +
                         fmax(s->penalty, PENALTY) * fmax(tried.score.excess, 0);
    if (merit < s->least_merit) s->least_merit = merit, s->kept = tried.score.excess <= NO_EXCESS;
    return merit;
}

typedef struct call {
    search *search;
    nlopt_opt nlopt;
} call;

static double merit(unsigned count, const double *x, double *gradient, void *data) {
    const call *c = data;
    const gough_design_request *r = c->search->demand.request;
    double value[GOUGH_DESIGN_KEYS];
    (void)gradient;
    for (unsigned k = 0; k < count; k++) /* the greatest exactly */
        value[k] = x[k] < 1 ? r->least[k] + (r->greatest[k] - r->least[k]) * x[k] : r->greatest[k];
    const double found = search_try(c->search, value);
    if (c->search->stopped) nlopt_force_stop(c->nlopt);
    return found;
}

/* Whatever ends a search, its best designs are kept as they are tried. */
static void run(search *s, nlopt_algorithm algorithm, const double *value, double step,
                size_t evaluations) {
    const gough_design_request *r = s->demand.request;
    const unsigned count = (unsigned)r->keys;
    double x[GOUGH_DESIGN_KEYS], least;
    call c = {s, s->stopped || evaluations == 0 ? NULL : nlopt_create(algorithm, count)};
    if (!c.nlopt) return;
    nlopt_set_min_objective(c.nlopt, merit, &c);
    nlopt_set_lower_bounds1(c.nlopt, 0);
    nlopt_set_upper_bounds1(c.nlopt, 1);
    nlopt_set_maxeval(c.nlopt, (int)evaluations);
    nlopt_set_xtol_abs1(c.nlopt, SAME);
    if (step > 0) nlopt_set_initial_step1(c.nlopt, step);
    for (unsigned k = 0; k < count; k++)
        x[k] = fmin(fmax((value[k] - r->least[k]) / (r->greatest[k] - r->least[k]), 0), 1);
    s->least_merit = INFINITY, s->kept = false;
    nlopt_optimize(c.nlopt, x, &least);
    nlopt_destroy(c.nlopt);
    /* (design-5): a design that exceeds a limit must not have the least merit */
    if (!s->kept) s->penalty = fmin(fmax(s->penalty, PENALTY) * MORE_PENALTY, MOST_PENALTY);
}

void search_all(search *s, const double *value, size_t evaluations) {
    nlopt_srand(s->demand.request->seed);
    run(s, NLOPT_GN_CRS2_LM, value, 0, evaluations);
}

void search_from(search *s, const double *value, double step, size_t evaluations) {
    run(s, NLOPT_LN_SBPLX, value, step, evaluations);
}

/* ---- poses ---- */

typedef struct pose_call {
    const gough_reach *reach;
    const gough_box *box;
} pose_call;

static void pose_at(const gough_box *box, const double *x, double pose[GOUGH_COMPONENTS]) {
    for (int c = 0; c < GOUGH_COMPONENTS; c++)
        pose[c] =
            x[c] < 1 ? box->least[c] + (box->greatest[c] - box->least[c]) * x[c] : box->greatest[c];
}

static double ease_at(unsigned count, const double *x, double *gradient, void *data) {
    static const double nothing[GOUGH_BINDS] = {0};
    const pose_call *c = data;
    double pose[GOUGH_COMPONENTS];
    (void)count, (void)gradient;
    pose_at(c->box, x, pose);
    return fmin(ease_needed(nothing, c->reach, pose, -POSE_SPARE), MOST);
}

double search_worst_pose(const gough_reach *reach, const gough_box *box,
                         double pose[GOUGH_COMPONENTS]) {
    pose_call c = {reach, box};
    nlopt_opt nlopt = nlopt_create(NLOPT_LN_SBPLX, GOUGH_COMPONENTS);
    double x[GOUGH_COMPONENTS], most = -POSE_SPARE;
    if (!nlopt) return most;
    for (int k = 0; k < GOUGH_COMPONENTS; k++) {
        const double width = box->greatest[k] - box->least[k];
        x[k] = width > 0 ? (pose[k] - box->least[k]) / width : 0;
    }
    nlopt_set_max_objective(nlopt, ease_at, &c);
    nlopt_set_lower_bounds1(nlopt, 0);
    nlopt_set_upper_bounds1(nlopt, 1);
    nlopt_set_maxeval(nlopt, POSE_TRIES);
    nlopt_set_xtol_abs1(nlopt, POSE_SAME);
    nlopt_set_initial_step1(nlopt, POSE_STEP);
    nlopt_optimize(nlopt, x, &most);
    nlopt_destroy(nlopt);
    pose_at(box, x, pose);
    return most;
}
