/* What a model asks of its machine in all poses: gough_reach_init(). */
#define NUMBER_DOUBLE
#include <math.h>
#include <string.h>

#include "base/limits.h"
#include "gough/sizes.h"
#include "workspace/certify.h"

bool reach_is_valid(const gough_reach *reach) {
    return reach->order == GOUGH_ZYX || reach->order == GOUGH_XYZ;
}

gough_status reach_refuse(gough_error *error) {
    return gough_fail_key(error, GOUGH_ERROR_INPUT, "motion.order",
                          "motion.order must be zyx or xyz");
}

/* "leg 3", or "" for what concerns no single leg */
static const char *leg_of(const gough_binding *binding) {
    static const char *const name[GOUGH_LEGS] = {" of leg 1", " of leg 2", " of leg 3",
                                                 " of leg 4", " of leg 5", " of leg 6"};
    switch (binding->bind) {
    case GOUGH_BIND_POSE:
    case GOUGH_BIND_SINGULAR:
    case GOUGH_BIND_SINGULAR_VALUE:
    case GOUGH_BIND_NONE:
        return "";
    default:
        return name[binding->which];
    }
}

gough_status reach_home_outside(const gough_binding *binding, gough_error *error) {
    static const char *const limit[GOUGH_BINDS] = {"no limit",
                                                   "the least length",
                                                   "the greatest length",
                                                   "the swing of the base joint",
                                                   "the swing of the top joint",
                                                   "the clearance",
                                                   "a limit of the platform's pose",
                                                   "the sign of the determinant",
                                                   "the least singular value",
                                                   "the greatest speed",
                                                   "the greatest acceleration",
                                                   "the greatest force",
                                                   "the least force"};
    return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                      "home itself is not allowed: %s%s is exceeded there", limit[binding->bind],
                      leg_of(binding));
}

/* three half widths */
static gough_status check_half(const double half[3], const char *key, gough_error *error) {
    for (int k = 0; k < 3; k++)
        if (!(half[k] >= 0 && half[k] < INFINITY))
            return gough_fail_key(error, GOUGH_ERROR_INPUT, key,
                                  "%s must have three numbers that are 0 or greater, not %g", key,
                                  half[k]);
    return GOUGH_OK;
}

static gough_status check_halves(const gough_workspace *w, gough_error *error) {
    const struct {
        const double *half;
        const char *key;
    } all[] = {{w->acceleration, "workspace.acceleration"},
               {w->angular_acceleration, "workspace.angular_acceleration"},
               {w->velocity, "workspace.velocity"},
               {w->angular_velocity, "workspace.angular_velocity"},
               {w->force, "workspace.force"},
               {w->moment, "workspace.moment"}};
    gough_status status = GOUGH_OK;
    for (size_t i = 0; i < sizeof all / sizeof *all && !status; i++)
        status = check_half(all[i].half, all[i].key, error);
    return status;
}

static gough_status check_asked(const gough_workspace *w, gough_error *error) {
    for (int k = 0; k < 3; k++)
        if (!isfinite(w->about[k]) || !isfinite(w->orientation[k]))
            return gough_fail_key(
                error, GOUGH_ERROR_INPUT,
                isfinite(w->about[k]) ? "workspace.orientation" : "workspace.about",
                "%s is not finite",
                isfinite(w->about[k]) ? "workspace.orientation" : "workspace.about");
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        static const char *const key[GOUGH_COMPONENTS] = {
            "workspace.box.surge", "workspace.box.sway",  "workspace.box.heave",
            "workspace.box.roll",  "workspace.box.pitch", "workspace.box.yaw"};
        if (w->box[c][0] <= 0 && w->box[c][1] >= 0 && isfinite(w->box[c][1] - w->box[c][0]))
            continue;
        return gough_fail_key(error, GOUGH_ERROR_INPUT, key[c],
                              "%s must contain home: its least value at most 0, its greatest at "
                              "least 0",
                              key[c]);
    }
    if (!(w->least_singular_value >= 0 && w->least_singular_value < INFINITY))
        return gough_fail_key(error, GOUGH_ERROR_INPUT, "workspace.least_singular_value",
                              "workspace.least_singular_value must be 0 or greater, not %g",
                              w->least_singular_value);
    return check_halves(w, error);
}

gough_status gough_reach_init(gough_reach *reach, size_t size, const gough_model *model,
                              gough_error *error) {
    const gough_workspace *w = &model->workspace;
    const gough_state home = gough_state_home(&model->machine);
    double condition, determinant;

    if (size != sizeof *reach) {
        gough_fail(error, GOUGH_ERROR_INPUT, "gough_reach has another size in the library");
        return gough_size_refuse(reach, size);
    }
    const gough_status status = check_asked(w, error);
    if (status) return status;
    if (model->motion.order != GOUGH_ZYX && model->motion.order != GOUGH_XYZ)
        return reach_refuse(error);
    gough_conditioning(&model->machine, &home, &condition, &determinant);
    if (!(condition < greatest_condition))
        return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                          "the machine is singular at home, from where its workspace begins: "
                          "condition %.3g",
                          condition);
    *reach = (gough_reach){.machine = &model->machine,
                           .order = model->motion.order,
                           .limits = gough_limits_of(&model->machine, &model->motion),
                           .asked = *w,
                           .side = determinant > 0 ? 1 : -1,
                           .most_tests = 400000};
    memcpy(reach->about, w->about_given ? w->about : model->motion.about, sizeof reach->about);
    return GOUGH_OK;
}
