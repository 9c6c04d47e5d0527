/* What the command does when memory runs out. */
#ifndef GOUGH_CLI_MEMORY_H
#define GOUGH_CLI_MEMORY_H

#include <stddef.h>

/* Says so and ends the process with GOUGH_ERROR_FILE; nothing half done is left. */
_Noreturn void out_of_memory(void);
/* malloc() that does not return without memory. */
void *allocate(size_t size);
/* The same for realloc(). */
void *reallocate(void *old, size_t size);

#endif
