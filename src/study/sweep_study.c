/* Studies with a sweep, and the study of each of its runs: a varied study with the values of the plan. */
#define _POSIX_C_SOURCE 200809L
#include "gough/sweep.h"

#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "study/design_plan.h"
#include "study/varied.h"

struct gough_sweep {
    study_arena arena;
    study_source source;
    gough_setting *settings; /* copies */
    size_t setting_count;
    study_plan plan;
    gough_sweep_key *key;
    gough_study *study;
};

struct gough_sweep_maker {
    const gough_sweep *sweep;
    study_varied *varied;
    double *value;
};

/* ---- reading ----------------------------------------------------------------------------------------------------- */

static bool copy_input(gough_sweep *sweep, const char *name, const char *text, size_t length,
                       const gough_setting *settings, size_t count) {
    sweep->settings =
        study_input_copy(&sweep->arena, name, text, length, settings, count, &sweep->source);
    sweep->setting_count = count;
    return !sweep->arena.exhausted;
}

/* A key that the file does not give may not go with what it gives: the first run tells. */
static void try_first_run(study_messages *messages, study_node *root, const gough_sweep *sweep) {
    bool any = false;
    for (size_t i = 0; i < sweep->plan.axes; i++) {
        bool made;
        study_plan_target(messages->arena, root, &sweep->plan.axis[i], &made);
        any = any || made;
    }
    gough_sweep_maker *maker = any ? gough_sweep_maker_new(sweep) : NULL;
    const gough_study *study;
    gough_error error;
    if (maker && gough_sweep_make(maker, 1, &study, &error) == GOUGH_ERROR_INPUT) {
        study_node *keys = study_node_child(study_node_child(root, "sweep"), "keys");
        study_node_say(messages, keys, study_node_place(keys, true),
                       "the first run of the sweep is invalid: %s", error.message);
    }
    gough_sweep_maker_free(maker);
}

static void read_sweep(study_messages *messages, gough_sweep *sweep) {
    study_design design;
    study_node *root =
        study_tree_read(messages, &sweep->source, sweep->settings, sweep->setting_count);
    if (!root) return;
    const study_node *section = study_node_child(root, "sweep");
    if (!section && !study_node_meant(root, "sweep"))
        study_say(messages, GOUGH_ERROR_INPUT, (study_place){&sweep->source, sweep->source.length},
                  "the study has no section `sweep`, such as\nsweep:\n  keys:\n    "
                  "control.stiffness: {from: 1, to: 1000, steps: 31, scale: log}");
    study_plan_make(messages, root, &sweep->plan);
    study_design_make(messages, root, &design); /* as in reading the study without its sweep */
    sweep->study = study_from_tree(messages, root, &sweep->source);
    if (!sweep->study || messages->count) return;
    sweep->study->swept = true;
    sweep->key = study_arena_take(&sweep->arena, sweep->plan.axes * sizeof *sweep->key);
    for (size_t i = 0; sweep->key && i < sweep->plan.axes; i++)
        sweep->key[i] = sweep->plan.axis[i].key;
    try_first_run(messages, root, sweep);
}

gough_status gough_sweep_parse(const char *name, const char *text, size_t length,
                               const gough_setting *settings, size_t setting_count,
                               gough_sweep **sweep, char **messages) {
    if (messages) *messages = NULL;
    gough_sweep *made = calloc(1, sizeof *made);
    if (!made) return GOUGH_ERROR_FILE;
    study_messages said = {.arena = &made->arena};
    if (copy_input(made, name, text, length, settings, setting_count)) read_sweep(&said, made);
    const gough_status status = study_messages_end(&said, messages);
    if (status == GOUGH_OK)
        *sweep = made;
    else
        gough_sweep_free(made);
    return status;
}

void gough_sweep_free(gough_sweep *sweep) {
    if (!sweep) return;
    gough_study_free(sweep->study);
    study_arena_free(&sweep->arena);
    free(sweep);
}

/* ---- what it is -------------------------------------------------------------------------------------------------- */

const gough_study *gough_sweep_study(const gough_sweep *sweep) { return sweep->study; }
size_t gough_sweep_runs(const gough_sweep *sweep) { return sweep->plan.runs; }
bool gough_sweep_zipped(const gough_sweep *sweep) { return sweep->plan.zipped; }
uint64_t gough_sweep_seed(const gough_sweep *sweep) { return sweep->plan.seed; }

const gough_sweep_key *gough_sweep_keys(const gough_sweep *sweep, size_t *count) {
    *count = sweep->plan.axes;
    return sweep->key;
}

void gough_sweep_values(const gough_sweep *sweep, size_t run, double *value) {
    study_plan_values(&sweep->plan, run, value);
}

unsigned gough_sweep_touches(const gough_sweep *sweep, size_t key) {
    if (key < sweep->plan.axes) return sweep->plan.axis[key].touches;
    return study_axes_touch(sweep->plan.axis, sweep->plan.axes);
}

const gough_setting *gough_sweep_settings(const gough_sweep *sweep, size_t *count) {
    *count = sweep->setting_count;
    return sweep->settings;
}

void gough_sweep_print(double value, char text[GOUGH_SWEEP_TEXT]) {
    const locale_t plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    const locale_t before = plain ? uselocale(plain) : (locale_t)0;
    for (int digits = 15;; digits++) {
        snprintf(text, GOUGH_SWEEP_TEXT, "%.*g", digits, value);
        if (digits == 17 || !(fabs(strtod(text, NULL) - value) > 0)) break;
    }
    if (!plain) return;
    uselocale(before);
    freelocale(plain);
}

/* ---- one run after the other ------------------------------------------------------------------------------------- */

gough_sweep_maker *gough_sweep_maker_new(const gough_sweep *sweep) {
    const study_plan *plan = &sweep->plan;
    gough_sweep_maker *maker = calloc(1, sizeof *maker);
    if (!maker) return NULL;
    maker->sweep = sweep;
    maker->value = calloc(plan->axes + 1, sizeof *maker->value);
    maker->varied = study_varied_new(&sweep->source, sweep->settings, sweep->setting_count,
                                     plan->axis, plan->axes);
    if (maker->value && maker->varied) return maker;
    gough_sweep_maker_free(maker);
    return NULL;
}

void gough_sweep_maker_free(gough_sweep_maker *maker) {
    if (!maker) return;
    study_varied_free(maker->varied);
    free(maker->value);
    free(maker);
}

gough_status gough_sweep_make(gough_sweep_maker *maker, size_t run, const gough_study **study,
                              gough_error *error) {
    study_plan_values(&maker->sweep->plan, run, maker->value);
    return study_varied_make(maker->varied, maker->value, study, error);
}

uint64_t gough_sweep_noise_run(const gough_study *study, size_t run) {
    return study->noise_run_given ? study->model->disturbance.noise.run : (uint64_t)run;
}

uint64_t gough_sweep_sampling_run(const gough_study *study, size_t run) {
    return study->sampling_run_given ? study->model->control.sampling.run : (uint64_t)run;
}
