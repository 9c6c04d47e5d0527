/* Studies with a section `design`: the request, models for numbers of the search, and the text of the study with other numbers. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "study/design_plan.h"
#include "study/rewritten.h"

struct gough_design_study {
    study_arena arena;
    study_source source;
    gough_setting *settings; /* copies */
    size_t setting_count;
    study_design plan;
    gough_study *study;
    study_varied *varied;
};

static bool copy_input(gough_design_study *design, const char *name, const char *text,
                       size_t length, const gough_setting *settings, size_t count) {
    design->settings =
        study_input_copy(&design->arena, name, text, length, settings, count, &design->source);
    design->setting_count = count;
    return !design->arena.exhausted;
}

static void read_design(study_messages *messages, gough_design_study *design) {
    study_plan sweep;
    study_node *root =
        study_tree_read(messages, &design->source, design->settings, design->setting_count);
    if (!root) return;
    if (!study_node_child(root, "design") && !study_node_meant(root, "design"))
        study_say(messages, GOUGH_ERROR_INPUT,
                  (study_place){&design->source, design->source.length},
                  "the study has no section `design`, such as\ndesign:\n  vary:\n    "
                  "platform.top.radius: [0.8, 1.9]\n  minimize: force");
    study_design_make(messages, root, &design->plan);
    study_plan_make(messages, root, &sweep); /* as in reading the study without its design */
    design->study = study_from_tree(messages, root, &design->source);
    if (!design->study || messages->count) return;
    design->study->swept = study_node_child(root, "sweep") != NULL;
    design->varied = study_varied_new(&design->source, design->settings, design->setting_count,
                                      design->plan.axis, design->plan.keys);
    if (!design->varied) messages->arena->exhausted = true;
}

gough_status gough_design_study_parse(const char *name, const char *text, size_t length,
                                      const gough_setting *settings, size_t setting_count,
                                      gough_design_study **design, char **messages) {
    if (messages) *messages = NULL;
    gough_design_study *made = calloc(1, sizeof *made);
    if (!made) return GOUGH_ERROR_FILE;
    study_messages said = {.arena = &made->arena};
    if (copy_input(made, name, text, length, settings, setting_count)) read_design(&said, made);
    const gough_status status = study_messages_end(&said, messages);
    if (status == GOUGH_OK)
        *design = made;
    else
        gough_design_study_free(made);
    return status;
}

void gough_design_study_free(gough_design_study *design) {
    if (!design) return;
    study_varied_free(design->varied);
    gough_study_free(design->study);
    study_arena_free(&design->arena);
    free(design);
}

const gough_study *gough_design_study_own(const gough_design_study *design) {
    return design->study;
}

const gough_design_key *gough_design_study_keys(const gough_design_study *design, size_t *count) {
    *count = design->plan.keys;
    return design->plan.key;
}

static gough_status make_model(void *context, const double *value, const gough_model **model,
                               gough_error *error) {
    gough_design_study *design = context;
    const gough_study *study = NULL;
    const gough_status status = study_varied_make(design->varied, value, &study, error);
    if (!status) *model = study->model;
    return status;
}

gough_status gough_design_study_request(gough_design_study *design, gough_design_request *request,
                                        size_t size) {
    const study_design *plan = &design->plan;
    const gough_status status = gough_design_request_init(request, size);
    if (status) return status;
    request->keys = plan->keys;
    for (size_t k = 0; k < plan->keys; k++) {
        request->least[k] = plan->key[k].least;
        request->greatest[k] = plan->key[k].greatest;
        request->start[k] = plan->key[k].start;
    }
    request->make = make_model;
    request->context = design;
    memcpy(request->weight, plan->weight, sizeof request->weight);
    request->telescope =
        isnan(plan->telescope)
            ? NAN
            : gough_unit_read(&design->study->units, GOUGH_UNIT_LENGTH, plan->telescope);
    request->least_singular_value = plan->least_singular_value;
    request->seed = plan->seed;
    request->evaluations = plan->evaluations;
    return GOUGH_OK;
}

gough_status gough_design_study_text(gough_design_study *design, const double *value,
                                     const char **text, gough_error *error) {
    const gough_study *study;
    *text = NULL;
    const gough_status status = study_varied_make(design->varied, value, &study, error);
    if (status) return status;
    gough_error why = {.status = GOUGH_OK};
    *text = study_rewritten(&design->arena, &design->source, design->settings,
                            design->setting_count, design->varied, &why);
    if (*text) return GOUGH_OK;
    return gough_fail(error, why.status, "%s", why.message);
}
