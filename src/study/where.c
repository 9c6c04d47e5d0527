/* Where the keys of a study stand, kept for errors that are found when it runs. */
#include "study/where.h"

#include <stdio.h>
#include <string.h>

#include "study/read.h"
#include "study/value.h"

struct study_where {
    study_where *next;
    const char *path;    /* "motion.heave" */
    const char *setting; /* "--set motion.heave"; NULL: in the file */
    size_t offset;       /* there */
};

static study_where *keep(study_arena *arena, const study_node *node, study_where *list) {
    const study_source *source = node->place.source;
    study_where *where = study_arena_take(arena, sizeof *where);
    if (!where) return list;
    where->next = list;
    where->path = study_node_path(arena, node);
    where->offset = study_node_place(node, node->empty).offset;
    if (source->setting)
        where->setting = study_arena_copy(arena, source->name, strlen(source->name));
    return where;
}

study_where *study_where_keep(study_arena *arena, const study_node *root) {
    study_where *list = NULL;
    const study_node *node = root;
    /* down, then right, then up; of long lists, as of moves, no sentence names an element */
    for (;;) {
        if (node != root) list = keep(arena, node, list);
        if (node->first && !(node->kind == STUDY_LIST && node->count > GOUGH_LEGS)) {
            node = node->first;
            continue;
        }
        while (node != root && !node->next) node = node->parent;
        if (node == root) return list;
        node = node->next;
    }
}

static const study_where *find(const study_where *list, const char *path, size_t length) {
    for (; list; list = list->next)
        if (strlen(list->path) == length && memcmp(list->path, path, length) == 0) return list;
    return NULL;
}

size_t gough_study_place(const gough_study *study, const char *sentence, char *place, size_t size) {
    const study_memory *memory = study->memory_;
    size_t length = strspn(sentence, "abcdefghijklmnopqrstuvwxyz_.0123456789");
    const study_where *where = NULL;
    while (length > 0 && memory) {
        where = find(memory->where, sentence, length);
        if (where) break;
        /* an element that the study does not give by itself: its list, its mapping */
        while (length > 0 && sentence[--length] != '.') continue;
    }
    if (size > 0) place[0] = '\0';
    if (!where) return 0;
    if (where->setting) return (size_t)snprintf(place, size, "%s", where->setting);
    const study_source file = {study->name, study->text, strlen(study->text), 0, false, 0, 0};
    size_t line, column;
    study_place_find((study_place){&file, where->offset}, &line, &column);
    return (size_t)snprintf(place, size, "%s:%zu:%zu", study->name, line, column);
}
