/* (design-6): what keeps a design from being better: numbers at their bounds, and limits that have little to spare. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "design/settle.h"

/* a number this near to a bound, in parts of its range, is at it */
static const double AT_BOUND = 1e-3;
/* and a limit with less than this part of its size to spare keeps the design from being better */
static const double LITTLE = 0.01;

/* The most there are: numbers, eight limits of each leg and its clearance, six of the platform, two of singular poses, the
 * telescope. */
_Static_assert(GOUGH_DESIGN_KEYS + 9 * GOUGH_LEGS + GOUGH_COMPONENTS + 3 <= GOUGH_DESIGN_ACTIVES,
               "room for all reasons");

static gough_active *add(gough_design_result *result, gough_active_kind kind) {
    assert_true(result->actives < GOUGH_DESIGN_ACTIVES);
    gough_active *a = &result->active[result->actives++];
    *a = (gough_active){.kind = kind};
    return a;
}

static void add_keys(const gough_design_request *r, const candidate *c,
                     gough_design_result *result) {
    for (size_t k = 0; k < r->keys; k++) {
        const double part = (c->value[k] - r->least[k]) / (r->greatest[k] - r->least[k]);
        if (part > AT_BOUND && part < 1 - AT_BOUND) continue;
        gough_active *a = add(result, part < 0.5 ? GOUGH_ACTIVE_LEAST : GOUGH_ACTIVE_GREATEST);
        a->key = k;
    }
}

/* Limits that ease all others do not hide: each kind is asked with more to spare by itself. */
static void add_limits(const demand *d, const gough_reach *reach, gough_design_result *result) {
    for (int kind = GOUGH_BIND_NONE + 1; kind < GOUGH_BINDS; kind++) {
        double part[GOUGH_BINDS] = {0};
        part[kind] = -LITTLE;
        const gough_reach tight = reach_eased(reach, part);
        bool told[GOUGH_LEGS] = {false};
        for (size_t i = 0; i < d->poses; i++) {
            gough_binding binding;
            if (pose_is_allowed(&tight, d->pose[i], &binding)) continue;
            if ((int)binding.bind != kind || told[binding.which]) continue;
            gough_active *a = add(result, GOUGH_ACTIVE_LIMIT);
            told[binding.which] = true;
            a->binding = binding;
            memcpy(a->pose, d->pose[i], sizeof a->pose);
        }
    }
}

void design_actives(search *s, const candidate *c, gough_design_result *result) {
    const gough_model *model = search_model(s, c->value);
    const score *found = &c->score;
    gough_reach reach;
    result->actives = 0;
    add_keys(s->demand.request, c, result);
    if (!model || reach_of_design(&s->demand, model, &reach, NULL)) return;
    add_limits(&s->demand, &reach, result);
    if (telescope_lacks(s->demand.request, found->shortest, found->longest) > -LITTLE)
        (void)add(result, GOUGH_ACTIVE_TELESCOPE);
}

const char *gough_active_name(gough_active_kind kind) {
    static const char *const name[GOUGH_ACTIVE_KINDS] = {"least", "greatest", "limit", "telescope"};
    return (unsigned)kind < GOUGH_ACTIVE_KINDS ? name[kind] : "unknown";
}
