/* What a search is asked for: defaults and checks. Theory: docs/theory/tuning.md. */
#include <math.h>

#include "base/quantity.h"
#include "gough/sizes.h"
#include "tune/tune.h"

gough_status gough_tuning_options_init(gough_tuning_options *options, size_t size) {
    if (size != sizeof *options) return gough_size_refuse(options, size);
    *options = (gough_tuning_options){.size = size,
                                      .angle_deviation = INFINITY,
                                      .damping_ratio = NAN,
                                      .margin = 0.02,
                                      .greatest = INFINITY};
    return GOUGH_OK;
}

static const double degrees = 180 / 3.14159265358979323846;

static gough_status check_numbers(const gough_tuning_options *o, gough_error *error) {
    if (gough_size_check(o->size, sizeof(gough_tuning_options), "gough_tuning_options", error) !=
        GOUGH_OK)
        return GOUGH_ERROR_INPUT;
    if (!(o->deviation > 0) || !isfinite(o->deviation))
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "the deviation allowed must be a finite number > 0, not %.9g" IN_LENGTH,
                          o->deviation);
    if (!(o->angle_deviation > 0))
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "the angle deviation allowed must be > 0, not %.9g" IN_DEGREES "°",
                          o->angle_deviation * degrees);
    if (!isnan(o->damping_ratio) && !(o->damping_ratio >= 0 && o->damping_ratio < 1))
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "the damping ratio must be at least 0 and less than 1, not %.9g",
                          o->damping_ratio);
    if (!(o->margin >= 0 && o->margin <= 0.5))
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "the margin must be from 0 to 0.5 (a fraction of G), not %.9g",
                          o->margin);
    if (!(o->least >= 0) || !isfinite(o->least) || !(o->greatest >= o->least))
        return gough_fail(
            error, GOUGH_ERROR_INPUT,
            "the search for the stiffness needs two numbers, 0 <= a < b, not %.9g" IN_STIFFNESS
            " and %.9g" IN_STIFFNESS,
            o->least, o->greatest);
    return GOUGH_OK;
}

static gough_status check_damping(const gough_model *model, const gough_tuning_options *options,
                                  gough_error *error) {
    bool matrix = false;

    for (int v = 0; v < GOUGH_LEGS && model->control.coupled; v++) {
        for (int w = 0; w < GOUGH_LEGS; w++) matrix |= fabs(model->control.cross_damping[v][w]) > 0;
    }
    if (!matrix || !isnan(options->damping_ratio)) return GOUGH_OK;
    return gough_fail_key(error, GOUGH_ERROR_INPUT, "control.damping",
                          "the search for the stiffness keeps the damping of each leg, which a "
                          "matrix does not have; give --damping-ratio, or a damping of one number "
                          "or six");
}

gough_status tune_check_options(const gough_model *model, const gough_tuning_options *options,
                                gough_error *error) {
    const gough_status status = check_numbers(options, error);

    return status == GOUGH_OK ? check_damping(model, options, error) : status;
}
