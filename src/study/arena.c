/* Memory of one reading: blocks in a list, cut from front to back and freed together. */
#include "study/arena.h"

#include <stdalign.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

struct study_block {
    study_block *older;
    size_t used, size;
    alignas(max_align_t) unsigned char bytes[];
};

enum { LEAST_BLOCK = 16384 };

static study_block *new_block(study_arena *arena, size_t least) {
    const size_t size = least > LEAST_BLOCK ? least : LEAST_BLOCK;
    study_block *block = calloc(1, sizeof *block + size);
    if (!block) {
        arena->exhausted = true;
        return NULL;
    }
    block->size = size;
    block->older = arena->block;
    arena->block = block;
    return block;
}

void *study_arena_take(study_arena *arena, size_t size) {
    const size_t unit = alignof(max_align_t);
    if (size > SIZE_MAX / 2) {
        arena->exhausted = true;
        return NULL;
    }
    size = (size + unit - 1) / unit * unit;
    study_block *block = arena->block;
    if (!block || block->size - block->used < size) block = new_block(arena, size);
    if (!block) return NULL;
    void *piece = block->bytes + block->used;
    block->used += size;
    return piece;
}

char *study_arena_copy(study_arena *arena, const char *text, size_t length) {
    char *copy = study_arena_take(arena, length + 1);
    if (copy && length) memcpy(copy, text, length);
    return copy;
}

void study_arena_free(study_arena *arena) {
    for (study_block *block = arena->block; block;) {
        study_block *older = block->older;
        free(block);
        block = older;
    }
    arena->block = NULL;
}
