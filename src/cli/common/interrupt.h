/* Ctrl-C, SIGTERM and SIGHUP. */
#ifndef GOUGH_CLI_INTERRUPT_H
#define GOUGH_CLI_INTERRUPT_H

#include <stddef.h>

/* From here on these signals say this sentence, about what is kept, before they end the process. */
void interrupt_says(const char *verb, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
/* The sentence about outputs, of which the first `written` are complete. */
void interrupt_outputs(const char *verb, const char *const *output, size_t count, size_t written);

#endif
