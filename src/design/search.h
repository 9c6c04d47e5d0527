/* Searches through designs by NLopt. Theory: docs/theory/design.md. */
#ifndef GOUGH_DESIGN_SEARCH_H
#define GOUGH_DESIGN_SEARCH_H

#include "design/score.h"

/* A design. */
typedef struct candidate {
    bool there;
    double value[GOUGH_DESIGN_KEYS];
    score score;
} candidate;

typedef struct search {
    demand demand;
    double whole; /* the objective that counts as 1 beside an excess */
    double
        penalty; /* weight of an excess beside the objective; larger after a search whose least merit exceeds a limit */
    double least_merit; /* of the present search */
    bool kept;          /* the design with the least merit keeps the requirement */
    candidate best,
        nearest; /* of those that keep the requirement, and the one that comes nearest to it */
    size_t evaluations, expected;
    bool stopped;
    gough_error refused; /* why the last values made no model */
} search;

/* The best design that keeps the requirement, or the nearest to it. */
static inline const candidate *search_best(const search *s) {
    return s->best.there ? &s->best : &s->nearest;
}

/* The model of a design; NULL: its numbers make no model. */
const gough_model *search_model(search *s, const double *value);

/* Tries a design and keeps it if it is the best; its merit, which searches make least. */
double search_try(search *s, const double *value);

/* Through all designs and a given one: CRS2, of the seed of the request. */
void search_all(search *s, const double *value, size_t evaluations);

/* From a design, or the nearest within bounds, with first steps of a part of each range: SBPLX. */
void search_from(search *s, const double *value, double step, size_t evaluations);

/* From a pose of the box to one near it that exceeds a limit most; by which part of its size, below 0 if no limit is exceeded. */
double search_worst_pose(const gough_reach *reach, const gough_box *box,
                         double pose[GOUGH_COMPONENTS]);

#endif
