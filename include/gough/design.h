/** @file design.h
 *  A better machine: numbers of a model that may vary between bounds are chosen so that a required box of poses is certified with
 *  its motions and loads, and so that forces, strokes, speeds or the footprint of the machine are least. Theory:
 *  docs/theory/design.md. In libgough-analyse.
 *
 *  How the numbers make a model is the caller's: the search calls a function of the caller. gough/study.h has that of study files.
 *  Aims are in the units of the model. An error argument may be NULL.
 *
 *  Accuracy: the certificate encloses errors of rounding, as gough_box_certify() does. That no better design exists is not proved.
 *  Overlap: outputs must not overlap inputs.
 *  Threads: every function may be called from several threads at once, on distinct outputs and with distinct contexts. The
 *  search draws random numbers by NLopt (nlopt_srand()), whose generator belongs to the calling thread.
 */
#ifndef GOUGH_DESIGN_H
#define GOUGH_DESIGN_H

#include "gough/workspace.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    GOUGH_DESIGN_KEYS = 32,   /**< most numbers that may vary */
    GOUGH_DESIGN_ACTIVES = 96 /**< most reasons that are reported */
};

/** What a design makes small. Values are the worst at the corners and the centre of the required box, and at poses of it where
 *  earlier designs of the search exceeded a limit. */
typedef enum gough_aim {
    GOUGH_AIM_FORCE, /**< greatest drive force of a leg, pushing or pulling, for the motions and loads asked for */
    GOUGH_AIM_STROKE, /**< greatest length of a leg less the least length of a leg, all legs being alike */
    GOUGH_AIM_SPEED, /**< greatest rate of a leg, for the velocities asked for */
    GOUGH_AIM_FOOTPRINT, /**< greatest horizontal distance of a joint from the z axis of the base, at home */
    GOUGH_AIMS           /**< number of values */
} gough_aim;

/** Fixed word for a gough_aim: "force", "stroke", "speed", "footprint". Other values give "unknown". */
GOUGH_API const char *gough_aim_name(gough_aim aim);

/** Makes the model of some values of the numbers that vary.
 *  @param context     of the request
 *  @param value       one for each number
 *  @param[out] model  set on GOUGH_OK; it may be used until the next call
 *  @return GOUGH_OK; another status if no valid machine has these values: the search then tries others. */
typedef gough_status gough_design_maker(void *context, const double *value,
                                        const gough_model **model, gough_error *error);

/** What is asked for; start from gough_design_request_default(). The required box with its motions and loads is the
 *  gough_workspace of the model that the start makes; the limits are those of each model. */
typedef struct gough_design_request {
    size_t size; /**< of this struct in bytes, from gough_design_request_default(), or 0 */
    size_t keys; /**< how many numbers vary, 1 to GOUGH_DESIGN_KEYS */
    double least[GOUGH_DESIGN_KEYS];    /**< of each number; finite */
    double greatest[GOUGH_DESIGN_KEYS]; /**< above the least, and finite */
    double start
        [GOUGH_DESIGN_KEYS]; /**< a design to compare with and to search from; it may lie outside the bounds */
    gough_design_maker *make; /**< makes models */
    void *context;            /**< passed to `make` */
    /** Weights >= 0, not all 0. With several aims, each is divided by its value at the start before it is weighted. */
    double weight[GOUGH_AIMS];
    double
        telescope; /**< dead length of a telescoping leg, >= 0: twice the least length less this must be at least the greatest
                           length, all legs being alike; NaN: legs need not telescope */
    double
        least_singular_value; /**< of poses of the box, >= 0, in addition to that of the model's gough_workspace */
    uint32_t seed; /**< of the search; the same request with the same seed gives the same bits */
    size_t
        evaluations; /**< models that the search tries; 0: 500, and 500 more for each number. Mending what the certificate
                             refuses and rounding take further ones, a tenth of it each time */
    /** Called occasionally with the part of the work that is done, 0 to 1; nonzero stops. May be NULL. */
    int (*progress)(void *context, double part);
    void *progress_context; /**< passed to progress */
} gough_design_request;

/** Fills in the defaults: no number varies and no function is set yet; least force, no telescope, seed 0.
 *  @param size  sizeof(gough_design_request)
 *  @return as gough_platform_init() */
GOUGH_API gough_status gough_design_request_init(gough_design_request *request, size_t size);

/** The request that gough_design_request_init() fills in. */
static inline gough_design_request gough_design_request_default(void) {
    gough_design_request request;
    (void)gough_design_request_init(&request, sizeof request);
    return request;
}

/** What keeps a design from being better. */
typedef enum gough_active_kind {
    GOUGH_ACTIVE_LEAST,     /**< a number is at its least value */
    GOUGH_ACTIVE_GREATEST,  /**< a number is at its greatest value */
    GOUGH_ACTIVE_LIMIT,     /**< a limit of the machine has less than 1 % to spare */
    GOUGH_ACTIVE_TELESCOPE, /**< the telescope has less than 1 % of the greatest length to spare */
    GOUGH_ACTIVE_KINDS      /**< number of values */
} gough_active_kind;

/** Fixed word for a gough_active_kind: "least", "greatest", "limit", "telescope". Other values give "unknown". */
GOUGH_API const char *gough_active_name(gough_active_kind kind);

/** One of these reasons. */
typedef struct gough_active {
    gough_active_kind kind;        /**< which */
    size_t key;                    /**< the number, from 0; else 0 */
    gough_binding binding;         /**< the limit; else GOUGH_BIND_NONE */
    double pose[GOUGH_COMPONENTS]; /**< the pose where the limit is nearest; else home */
} gough_active;

/** What a search has found. */
typedef struct gough_design_result {
    bool found;       /**< the box is certified */
    bool start_meets; /**< the start keeps all limits at the poses that are compared */
    double value
        [GOUGH_DESIGN_KEYS]; /**< the numbers; if `found` is false, those that come nearest to the requirement */
    double objective
        [2]; /**< of the start and of these numbers: the aim, or the weighted sum of several; NaN: not finite */
    double aim[GOUGH_AIMS]
              [2]; /**< of the start and of these numbers; NaN: not asked for, or not finite */
    gough_box box; /**< required, radians */
    gough_certificate certificate; /**< of that box with these numbers */
    double
        excess; /**< by which part of its size the worst limit is exceeded, 0 if `found`; INFINITY: there is a singular pose,
                        or no model */
    double scale; /**< if `found` is false: the largest part of the box that is certified, 0 to 1 */
    bool
        telescope_fails; /**< if `found` is false: the telescope is what is exceeded, not the certificate's limit */
    /** For the certificate, the search left this part of the size of each limit to spare, by gough_bind; 0 if it held without. */
    double spare[GOUGH_BINDS];
    double singular_value;                     /**< and asked for this least singular value */
    size_t actives;                            /**< how many reasons follow */
    gough_active active[GOUGH_DESIGN_ACTIVES]; /**< numbers first, then limits */
    bool bounded;                              /**< the envelope has bounds */
    gough_envelope envelope;                   /**< worst values over the box, if `found` */
    size_t evaluations;                        /**< models that were tried */
    size_t tests;                              /**< boxes that the certificates tested */
} gough_design_result;

/** Searches for the design with the least objective that keeps the required box, and certifies the box, (design-1) … (design-5).
 *  @param[out] result  filled if the status is GOUGH_OK or GOUGH_ERROR_NUMERICAL
 *  @return GOUGH_OK if a design is found; GOUGH_ERROR_NUMERICAL with a sentence if no design was found, or the search
 *          was stopped; GOUGH_ERROR_INPUT with a sentence if the request is out of range, the box is a single pose, or an
 *          aim cannot be computed for the start.
 *
 *  The design is certified; that it is the best is likely, not proved. Numbers are rounded to four to six digits of
 *  their range where that keeps the certificate and costs less than 0.1 % of the objective. Allocates what NLopt needs. */
GOUGH_API gough_status gough_design(const gough_design_request *request,
                                    gough_design_result *result, gough_error *error);

#ifdef __cplusplus
}
#endif
#endif
