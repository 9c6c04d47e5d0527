/* Studies with a sweep, and the study of each of its runs: the swept numbers are written into the tree of the file and the parts
 * of the model that they touch are built once more, by the same checks and the same code as in reading it. */
#define _POSIX_C_SOURCE 200809L
#include "gough/sweep.h"

#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "study/read.h"
#include "study/value.h"

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
    study_arena arena;
    study_node *root, **target;
    char (*text)[GOUGH_SWEEP_TEXT];
    double *value;
    gough_study *study;
    const char *folder;
    unsigned touches;
    bool failed; /* the run before: marks of what is wrong stand in the tree */
};

/* ---- reading ----------------------------------------------------------------------------------------------------- */

static bool copy_input(gough_sweep *sweep, const char *name, const char *text, size_t length,
                       const gough_setting *settings, size_t count) {
    study_arena *arena = &sweep->arena;
    const char *own_name = study_arena_copy(arena, name, strlen(name));
    const char *own_text = study_arena_copy(arena, text, length);
    sweep->settings = study_arena_take(arena, (count + 1) * sizeof *sweep->settings);
    if (arena->exhausted) return false;
    sweep->source = (study_source){own_name, own_text, length, 0, false};
    sweep->setting_count = count;
    for (size_t i = 0; i < count; i++) {
        const gough_setting *given = &settings[i];
        sweep->settings[i].key = study_arena_copy(arena, given->key, strlen(given->key));
        sweep->settings[i].value = study_arena_copy(arena, given->value, strlen(given->value));
    }
    return !arena->exhausted;
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
    study_node *root =
        study_tree_read(messages, &sweep->source, sweep->settings, sweep->setting_count);
    if (!root) return;
    const study_node *section = study_node_child(root, "sweep");
    if (!section && !study_node_meant(root, "sweep"))
        study_say(messages, GOUGH_ERROR_INPUT, (study_place){&sweep->source, sweep->source.length},
                  "the study has no section `sweep`, such as\nsweep:\n  keys:\n    "
                  "control.stiffness: {from: 1, to: 1000, steps: 31, scale: log}");
    study_plan_make(messages, root, &sweep->plan);
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
    unsigned all = 0;
    if (key < sweep->plan.axes) return sweep->plan.axis[key].touches;
    for (size_t i = 0; i < sweep->plan.axes; i++) all |= sweep->plan.axis[i].touches;
    return all;
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

/* The maker's own tree: that of the file, with a number wherever one is swept. */
static bool plant_tree(gough_sweep_maker *maker) {
    const gough_sweep *sweep = maker->sweep;
    study_messages said = {.arena = &maker->arena};
    maker->root = study_tree_read(&said, &sweep->source, sweep->settings, sweep->setting_count);
    if (!maker->root || said.count) return false;
    maker->folder = study_folder(&maker->arena, sweep->source.name);
    maker->study = study_from_tree(&said, maker->root, &sweep->source);
    const size_t axes = sweep->plan.axes;
    maker->target = study_arena_take(&maker->arena, axes * sizeof(study_node *));
    maker->text = study_arena_take(&maker->arena, axes * sizeof *maker->text);
    maker->value = study_arena_take(&maker->arena, axes * sizeof *maker->value);
    if (!maker->study || maker->arena.exhausted) return false;
    for (size_t i = 0; i < axes; i++) {
        bool made;
        study_node *target =
            study_plan_target(&maker->arena, maker->root, &sweep->plan.axis[i], &made);
        if (!target) return false;
        target->kind = STUDY_SCALAR;
        target->quoting = STUDY_PLAIN;
        target->in_flow = target->empty = false;
        target->first = target->last = NULL;
        target->count = 0;
        maker->target[i] = target;
    }
    return true;
}

gough_sweep_maker *gough_sweep_maker_new(const gough_sweep *sweep) {
    gough_sweep_maker *maker = calloc(1, sizeof *maker);
    if (!maker) return NULL;
    maker->sweep = sweep;
    maker->touches = gough_sweep_touches(sweep, sweep->plan.axes);
    if (plant_tree(maker)) return maker;
    gough_sweep_maker_free(maker);
    return NULL;
}

void gough_sweep_maker_free(gough_sweep_maker *maker) {
    if (!maker) return;
    gough_study_free(maker->study);
    study_arena_free(&maker->arena);
    free(maker);
}

static void clear_marks(study_node *node) {
    node->wrong = false;
    for (study_node *child = node->first; child; child = child->next) clear_marks(child);
}

/* Writes the swept numbers into the tree and checks them. */
static void write_values(gough_sweep_maker *maker, study_messages *said, size_t run) {
    const study_plan *plan = &maker->sweep->plan;
    study_plan_values(plan, run, maker->value);
    for (size_t i = 0; i < plan->axes; i++) {
        study_node *target = maker->target[i];
        gough_sweep_print(maker->value[i], maker->text[i]);
        target->text = maker->text[i];
        target->length = strlen(maker->text[i]);
        if (plan->axis[i].bound)
            study_check_number(said, target, plan->axis[i].bound);
        else
            study_check_formula(said, target);
    }
}

static void rebuild(gough_sweep_maker *maker, study_messages *said) {
    gough_study *study = maker->study;
    study_memory *memory = study->memory_;
    study_build build = {.messages = said,
                         .root = maker->root,
                         .folder = maker->folder,
                         .study = study,
                         .external = memory->external,
                         .record = &memory->record};
    study_model_rebuild(&build, maker->touches);
    memory->external = build.external;
    if (!(maker->touches & GOUGH_PART_MOTION)) return;
    free(memory->moves);
    free(memory->samples);
    memory->moves = build.moves;
    memory->samples = build.samples;
}

static gough_status check_run(const gough_study *study, gough_error *error) {
    const gough_status status = gough_simulation_check(study->model, &study->simulation, error);
    if (status && error) gough_error_say(error, &study->units);
    return status;
}

gough_status gough_sweep_make(gough_sweep_maker *maker, size_t run, const gough_study **study,
                              gough_error *error) {
    study_arena arena = {NULL, false};
    study_messages said = {.arena = &arena};
    if (maker->failed) clear_marks(maker->root);
    write_values(maker, &said, run);
    if (said.count == 0) rebuild(maker, &said);
    gough_status status = said.count ? said.status : GOUGH_OK;
    maker->failed = said.count > 0;
    if (said.count) gough_fail(error, status, "%s", study_messages_first(&said));
    if (arena.exhausted) status = gough_fail(error, GOUGH_ERROR_FILE, "out of memory");
    study_arena_free(&arena);
    if (status == GOUGH_OK &&
        maker->touches & (GOUGH_PART_MOTION | GOUGH_PART_CONTROL | GOUGH_PART_SIMULATION))
        status = check_run(maker->study, error);
    *study = maker->study;
    return status;
}

uint64_t gough_sweep_noise_run(const gough_study *study, size_t run) {
    return study->noise_run_given ? study->model->disturbance.noise.run : (uint64_t)run;
}

uint64_t gough_sweep_sampling_run(const gough_study *study, size_t run) {
    return study->sampling_run_given ? study->model->control.sampling.run : (uint64_t)run;
}
