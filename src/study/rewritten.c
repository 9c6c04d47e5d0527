/* Writes numbers and settings into the text of a study where its own numbers stand, and reads the result again: a text that would
 * not mean the same is not given away. */
#include "study/rewritten.h"

#include <stdlib.h>
#include <string.h>

#include "study/source.h"
#include "study/swept_number.h"

/* Bytes of the file, and what takes their place. */
typedef struct edit {
    size_t begin, end;
    const char *text;
} edit;

typedef struct editor {
    study_arena *arena;
    const study_source *source;
    study_node *root; /* of the file without settings, unchecked */
    edit *edit;
    size_t edits;
    gough_error *error;
} editor;

/* Replaces the value of a node that is a plain scalar of the file; a later replacement of the same value counts. */
static bool replace(editor *e, const study_node *node, const char *text) {
    if (!node || node->kind != STUDY_SCALAR || node->quoting != STUDY_PLAIN || node->empty)
        return false;
    edit *at = NULL;
    for (size_t i = 0; i < e->edits && !at; i++)
        if (e->edit[i].begin == node->place.offset) at = &e->edit[i];
    if (!at) at = &e->edit[e->edits++];
    *at = (edit){node->place.offset, node->end, text};
    return true;
}

/* A setting's node; below design.vary the rest of its path is one key. */
static study_node *node_of(editor *e, const char *path) {
    static const char vary[] = "design.vary.";
    if (strncmp(path, vary, sizeof vary - 1) == 0)
        return study_node_child(study_node_at(e->root, "design.vary"), path + sizeof vary - 1);
    return study_node_named(e->arena, e->root, path);
}

static bool edit_all(editor *e, const gough_setting *settings, size_t setting_count,
                     const study_varied *varied) {
    for (size_t i = 0; i < varied->axes; i++) {
        const char *path = varied->axis[i].key.path;
        (void)replace(e, study_node_named(e->arena, e->root, path), varied->text[i]);
    }
    for (size_t i = 0; i < setting_count; i++) {
        bool chosen = false;
        for (size_t k = 0; k < varied->axes; k++)
            chosen |= strcmp(varied->axis[k].key.path, settings[i].key) == 0;
        if (chosen ||
            (*settings[i].value && replace(e, node_of(e, settings[i].key), settings[i].value)))
            continue;
        gough_fail(e->error, GOUGH_ERROR_INPUT,
                   "the study cannot be written with --set %s: the file has no such key with a "
                   "single value; write it into the file",
                   settings[i].key);
        return false;
    }
    return true;
}

static int by_begin(const void *a, const void *b) {
    const edit *one = a, *other = b;
    return one->begin < other->begin ? -1 : one->begin > other->begin;
}

static char *join(editor *e) {
    const study_source *s = e->source;
    size_t length = s->length + 1, from = 0, to = 0;
    qsort(e->edit, e->edits, sizeof *e->edit, by_begin);
    for (size_t i = 0; i < e->edits; i++) length += strlen(e->edit[i].text);
    char *text = study_arena_take(e->arena, length);
    for (size_t i = 0; text && i < e->edits; i++) {
        const edit *one = &e->edit[i];
        memcpy(text + to, s->text + from, one->begin - from);
        to += one->begin - from;
        memcpy(text + to, one->text, strlen(one->text));
        to += strlen(one->text);
        from = one->end;
    }
    if (text) memcpy(text + to, s->text + from, s->length - from);
    return text;
}

static bool is_same(const study_node *a, const study_node *b) {
    if (a->kind != b->kind || a->count != b->count) return false;
    if (a->kind == STUDY_SCALAR)
        return a->length == b->length && memcmp(a->text, b->text, a->length) == 0;
    for (a = a->first, b = b->first; a; a = a->next, b = b->next)
        if ((a->key && strcmp(a->key->text, b->key->text) != 0) || !is_same(a, b)) return false;
    return true;
}

static study_node *parse(study_arena *arena, const study_source *source) {
    study_messages said = {.arena = arena};
    const size_t mark = source->length >= 3 && memcmp(source->text, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0;
    if (!study_source_guard(&said, source, mark)) return NULL;
    study_node *root = study_tree_parse(&said, source, mark);
    return said.count ? NULL : root;
}

const char *study_rewritten(study_arena *arena, const study_source *source,
                            const gough_setting *settings, size_t setting_count,
                            const study_varied *varied, gough_error *error) {
    editor e = {.arena = arena, .source = source, .error = error};
    e.root = parse(arena, source);
    e.edit = study_arena_take(arena, (varied->axes + setting_count) * sizeof *e.edit);
    if (!e.root || !e.edit) {
        gough_fail(error, GOUGH_ERROR_FILE, "out of memory");
        return NULL;
    }
    if (!edit_all(&e, settings, setting_count, varied)) return NULL;
    char *text = join(&e);
    const study_source made = {source->name, text, text ? strlen(text) : 0, 0, false, 0, 0};
    const study_node *root = text ? parse(arena, &made) : NULL;
    if (root && is_same(root, varied->root)) return text;
    if (arena->exhausted)
        gough_fail(error, GOUGH_ERROR_FILE, "out of memory");
    else
        gough_fail(error, GOUGH_ERROR_INPUT,
                   "the study cannot be written with these settings: its text would mean something "
                   "else; write the values of --set into the file");
    return NULL;
}
