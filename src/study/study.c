/* Study files: bytes in, validated model out. Guard, parse, override, check against the table of keys, build. */
#include "gough/study.h"

#include <stdlib.h>
#include <string.h>

#include "study/check.h"
#include "study/design_plan.h"
#include "study/overrides.h"
#include "study/read.h"
#include "study/source.h"
#include "study/where.h"

static char *duplicate(const char *text, size_t length) {
    char *copy = malloc(length + 1);
    if (!copy) return NULL;
    if (length) memcpy(copy, text, length);
    copy[length] = '\0';
    return copy;
}

void gough_study_free(gough_study *study) {
    if (!study) return;
    study_memory *memory = study->memory_;
    if (memory) {
        free(memory->moves);
        free(memory->external);
        free(memory->samples);
        study_arena_free(&memory->places);
    }
    free(memory);
    free(study->model);
    free(study->title);
    free(study->text);
    free(study->name);
    free(study->samples);
    free(study);
}

void gough_study_free_messages(char *messages) { free(messages); }

/* An empty study with all its memory; NULL if out of memory. */
static gough_study *new_study(const study_source *source) {
    gough_study *study = calloc(1, sizeof *study);
    if (!study) return NULL;
    study->memory_ = calloc(1, sizeof(study_memory));
    study->model = calloc(1, sizeof *study->model);
    study->name = duplicate(source->name, strlen(source->name));
    study->text = duplicate(source->text, source->length);
    if (study->memory_ && study->model && study->name && study->text) return study;
    gough_study_free(study);
    return NULL;
}

/* The guarded and parsed text; NULL with what is wrong said. */
static study_node *read_tree(study_messages *messages, const study_source *source) {
    const size_t mark = source->length >= 3 && memcmp(source->text, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0;
    if (!study_source_guard(messages, source, mark)) return NULL;
    study_node *root = study_tree_parse(messages, source, mark);
    if (messages->count == 0 && (!root || root->empty))
        study_say(messages, GOUGH_ERROR_INPUT, (study_place){source, source->length},
                  "the study is empty; `gough example` prints one to start from");
    return messages->count ? NULL : root;
}

const char *study_folder(study_arena *arena, const char *name) {
    const char *slash = study_is_descriptor(name) ? NULL : strrchr(name, '/');
    return slash ? study_arena_copy(arena, name, (size_t)(slash + 1 - name)) : "";
}

static void build_study(study_messages *messages, const study_node *root, gough_study *study) {
    const study_node *title = study_node_child(root, "title");
    const bool given = title && title->kind == STUDY_SCALAR;
    const char *folder = study_folder(messages->arena, study->name);
    study_memory *memory = study->memory_;
    study_build build = {.messages = messages,
                         .root = root,
                         .folder = folder ? folder : "",
                         .study = study,
                         .record = &memory->record};
    study_model_build(&build);
    memory->moves = build.moves;
    memory->external = build.external;
    memory->samples = build.samples;
    if (messages->count == 0) memory->where = study_where_keep(&memory->places, root);
    if (memory->places.exhausted) messages->arena->exhausted = true;
    study->title = duplicate(given ? title->text : "", given ? title->length : 0);
    if (build.samples_path)
        study->samples = duplicate(build.samples_path, strlen(build.samples_path));
    if (!study->title || (build.samples_path && !study->samples)) messages->arena->exhausted = true;
}

gough_setting *study_input_copy(study_arena *arena, const char *name, const char *text,
                                size_t length, const gough_setting *settings, size_t count,
                                study_source *source) {
    const char *own_name = study_arena_copy(arena, name, strlen(name));
    const char *own_text = study_arena_copy(arena, text, length);
    gough_setting *own = study_arena_take(arena, (count + 1) * sizeof *own);
    if (arena->exhausted) return NULL;
    *source = (study_source){own_name, own_text, length, 0, false, 0, 0};
    for (size_t i = 0; i < count; i++) {
        own[i].key = study_arena_copy(arena, settings[i].key, strlen(settings[i].key));
        own[i].value = study_arena_copy(arena, settings[i].value, strlen(settings[i].value));
    }
    return own;
}

study_node *study_tree_read(study_messages *messages, const study_source *source,
                            const gough_setting *settings, size_t setting_count) {
    study_node *root = read_tree(messages, source);
    if (!root) return NULL;
    for (size_t i = 0; i < setting_count; i++)
        study_setting_apply(messages, root, &settings[i], 2 + (int)i);
    study_check(messages, root);
    return root;
}

gough_study *study_from_tree(study_messages *messages, study_node *root,
                             const study_source *source) {
    gough_study *study = new_study(source);
    if (study)
        build_study(messages, root, study);
    else
        messages->arena->exhausted = true;
    return study;
}

/* All steps on a text that outlives the messages. */
static gough_study *read_study(study_messages *messages, const study_source *source,
                               const gough_setting *settings, size_t setting_count) {
    study_plan plan;
    study_design design;
    study_node *root = study_tree_read(messages, source, settings, setting_count);
    if (!root) return NULL;
    study_plan_make(messages, root, &plan);
    study_design_make(messages, root, &design);
    gough_study *study = study_from_tree(messages, root, source);
    if (study) study->swept = study_node_child(root, "sweep") != NULL;
    return study;
}

/* Writes what was said, and gives the study away where nothing was. */
static gough_status finish(study_messages *said, gough_study *made, gough_study **study,
                           char **messages) {
    const gough_status status = study_messages_end(said, messages);
    if (status == GOUGH_OK)
        *study = made;
    else
        gough_study_free(made);
    study_arena_free(said->arena);
    return status;
}

gough_status gough_study_parse(const char *name, const char *text, size_t length,
                               const gough_setting *settings, size_t setting_count,
                               gough_study **study, char **messages) {
    study_arena arena = {NULL, false};
    study_messages said = {.arena = &arena};
    gough_study *made = NULL;
    const char *copy = study_arena_copy(&arena, text, length);
    const study_source source = {name, copy, length, 0, false, 0, 0};
    if (copy) made = read_study(&said, &source, settings, setting_count);
    return finish(&said, made, study, messages);
}

gough_status gough_study_read(const char *path, const gough_setting *settings, size_t setting_count,
                              gough_study **study, char **messages) {
    study_arena arena = {NULL, false};
    study_messages said = {.arena = &arena};
    const study_source file = {.name = strcmp(path, "-") == 0 ? "standard input" : path};
    size_t length = 0;
    char *text =
        study_source_read(&said, (study_place){&file, 0}, path, STUDY_MOST_BYTES + 3, &length);
    if (!text) return finish(&said, NULL, study, messages);
    const gough_status status =
        gough_study_parse(file.name, text, length, settings, setting_count, study, messages);
    free(text);
    study_arena_free(&arena);
    return status;
}
