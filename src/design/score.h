/* What a design is worth: by how much it misses the requirement, and the values of its aims, at some poses of the required box.
 * Theory: docs/theory/design.md. */
#ifndef GOUGH_DESIGN_SCORE_H
#define GOUGH_DESIGN_SCORE_H

#include "gough/design.h"

enum {
    DESIGN_CORNERS = 1 << GOUGH_COMPONENTS,
    DESIGN_MENDED = 40, /* poses that certificates may add */
    DESIGN_POSES = DESIGN_CORNERS + 1 + DESIGN_MENDED
};

/* Excesses that no easing of a limit makes good; those of singular poses are counted from the first. */
static const double EXCESS_SINGULAR = 100, EXCESS_SINGULAR_HOME = 1000, EXCESS_NO_MODEL = 2000;

/* Part of the size of each limit that is always to be spare, and the excess that then counts as none. */
static const double DESIGN_SPARE = 2e-6, NO_EXCESS = 1e-6;

/* The requirement, once for all designs. */
typedef struct demand {
    const gough_design_request *request;
    gough_box box;
    double pose[DESIGN_POSES]
               [GOUGH_COMPONENTS]; /* corners, centre, and those that certificates have added */
    size_t poses;
    double spare[GOUGH_BINDS]; /* part of the size of each limit that is to be spare */
    double singular_value;     /* least one that is asked for */
    double unit[GOUGH_AIMS];   /* of the aims in the objective */
} demand;

typedef struct score {
    double excess; /* (design-2): 0 if the limits are kept, with what is to be spare */
    double aim[GOUGH_AIMS];
    double objective; /* (design-3) */
    double shortest, longest;
} score;

/* The corners of a box that are not equal, and its centre. */
void demand_poses(demand *d);

/* Limits with a part of the size of each more room, by gough_bind. */
gough_reach reach_eased(const gough_reach *reach, const double part[GOUGH_BINDS]);

/* The limits of a machine with those of the request. */
gough_status reach_of_design(const demand *d, const gough_model *model, gough_reach *reach,
                             gough_error *error);

/* Whether a pose keeps the limits. */
bool pose_is_allowed(const gough_reach *reach, const double pose[GOUGH_COMPONENTS],
                     gough_binding *binding);

/* The least part by which limits must be eased for a pose, less what is to be spare; `low` if less is enough, INFINITY if none
 * helps. */
double ease_needed(const double spare[GOUGH_BINDS], const gough_reach *reach,
                   const double pose[GOUGH_COMPONENTS], double low);

/* (design-4): the part of the greatest length that a telescope lacks; -INFINITY: legs need not telescope. */
double telescope_lacks(const gough_design_request *request, double shortest, double longest);

/* Values and excess of a design, the model of which may be NULL. */
void score_of(const demand *d, const gough_model *model, score *s);

#endif
