/* Memory of one reading: many small pieces that live and die together. */
#ifndef STUDY_ARENA_H
#define STUDY_ARENA_H

#include <stdbool.h>
#include <stddef.h>

typedef struct study_block study_block;

typedef struct study_arena {
    study_block *block;
    bool exhausted; /* an allocation failed: whatever was built is incomplete */
} study_arena;

/* Zeroed memory aligned for any type; NULL, with `exhausted` set, if out of memory. */
void *study_arena_take(study_arena *arena, size_t size);

/* A terminated copy of length bytes; NULL as above. */
char *study_arena_copy(study_arena *arena, const char *text, size_t length);

void study_arena_free(study_arena *arena);

#endif
