/* Studies with other numbers at some of their keys: see varied.h. */
#include "study/varied.h"

#include <stdlib.h>
#include <string.h>

#include "study/value.h"

/* The own tree: that of the file, with a number wherever one varies. */
static bool plant_tree(study_varied *varied, const study_source *source,
                       const gough_setting *settings, size_t setting_count) {
    study_messages said = {.arena = &varied->arena};
    varied->root = study_tree_read(&said, source, settings, setting_count);
    if (!varied->root || said.count) return false;
    varied->folder = study_folder(&varied->arena, source->name);
    varied->study = study_from_tree(&said, varied->root, source);
    const size_t axes = varied->axes;
    varied->target = study_arena_take(&varied->arena, axes * sizeof *varied->target);
    varied->text = study_arena_take(&varied->arena, axes * sizeof *varied->text);
    if (!varied->study || varied->arena.exhausted) return false;
    for (size_t i = 0; i < axes; i++) {
        bool made;
        study_node *target =
            study_plan_target(&varied->arena, varied->root, &varied->axis[i], &made);
        if (!target) return false;
        target->kind = STUDY_SCALAR;
        target->quoting = STUDY_PLAIN;
        target->in_flow = target->empty = false;
        target->first = target->last = NULL;
        target->count = 0;
        varied->target[i] = target;
    }
    return true;
}

unsigned study_axes_touch(const study_axis *axis, size_t axes) {
    unsigned all = 0;
    for (size_t i = 0; i < axes; i++) all |= axis[i].touches;
    return all;
}

study_varied *study_varied_new(const study_source *source, const gough_setting *settings,
                               size_t setting_count, const study_axis *axis, size_t axes) {
    study_varied *varied = calloc(1, sizeof *varied);
    if (!varied) return NULL;
    varied->axis = axis;
    varied->axes = axes;
    varied->touches = study_axes_touch(axis, axes);
    if (plant_tree(varied, source, settings, setting_count)) return varied;
    study_varied_free(varied);
    return NULL;
}

void study_varied_free(study_varied *varied) {
    if (!varied) return;
    gough_study_free(varied->study);
    study_arena_free(&varied->arena);
    free(varied);
}

static void clear_marks(study_node *node) {
    node->wrong = false;
    for (study_node *child = node->first; child; child = child->next) clear_marks(child);
}

/* Writes the numbers into the tree and checks them. */
static void write_values(study_varied *varied, study_messages *said, const double *value) {
    for (size_t i = 0; i < varied->axes; i++) {
        study_node *target = varied->target[i];
        gough_sweep_print(value[i], varied->text[i]);
        target->text = varied->text[i];
        target->length = strlen(varied->text[i]);
        if (varied->axis[i].bound)
            study_check_number(said, target, varied->axis[i].bound);
        else
            study_check_formula(said, target);
    }
}

static void rebuild(study_varied *varied, study_messages *said) {
    gough_study *study = varied->study;
    study_memory *memory = study->memory_;
    study_build build = {.messages = said,
                         .root = varied->root,
                         .folder = varied->folder,
                         .study = study,
                         .external = memory->external,
                         .record = &memory->record};
    study_model_rebuild(&build, varied->touches);
    memory->external = build.external;
    if (!(varied->touches & GOUGH_PART_MOTION)) return;
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

gough_status study_varied_make(study_varied *varied, const double *value, const gough_study **study,
                               gough_error *error) {
    study_arena arena = {NULL, false};
    study_messages said = {.arena = &arena};
    if (varied->failed) clear_marks(varied->root);
    write_values(varied, &said, value);
    if (said.count == 0) rebuild(varied, &said);
    gough_status status = said.count ? said.status : GOUGH_OK;
    varied->failed = said.count > 0;
    if (said.count) gough_fail(error, status, "%s", study_messages_first(&said));
    if (arena.exhausted) status = gough_fail(error, GOUGH_ERROR_FILE, "out of memory");
    study_arena_free(&arena);
    if (status == GOUGH_OK &&
        varied->touches & (GOUGH_PART_MOTION | GOUGH_PART_CONTROL | GOUGH_PART_SIMULATION))
        status = check_run(varied->study, error);
    *study = varied->study;
    return status;
}
