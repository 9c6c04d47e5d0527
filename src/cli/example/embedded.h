/* The examples, carried inside the command; the build generates the table from the files in examples/. */
#ifndef GOUGH_CLI_EMBEDDED_H
#define GOUGH_CLI_EMBEDDED_H

#include <stddef.h>

typedef struct embedded_file {
    const char *name; /* as in examples/: "heave.yaml" */
    const char *text; /* terminated */
    size_t length;
} embedded_file;

/* in order of name; an entry without a name ends it */
extern const embedded_file embedded_files[];

#endif
