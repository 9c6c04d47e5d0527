/* Ctrl-C, SIGTERM and SIGHUP: what is kept is said, and the process ends by the signal. Results are written complete or not at
 * all by other means (src/table/output.c), so that the handler has nothing to undo. */
#define _GNU_SOURCE
#include <signal.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/common/interrupt.h"

enum { LONGEST = 1000 };

/* Two sentences, so that one is whole at any time. */
static char sentence[2][LONGEST];
static volatile sig_atomic_t current;

static void say_and_end(int number) {
    const char *text = sentence[current];
    (void)!write(STDERR_FILENO, text, strlen(text));
    raise(number); /* by the default action, which SA_RESETHAND has put back */
}

static void watch(void) {
    struct sigaction action = {.sa_handler = say_and_end,
                               .sa_flags = (int)(SA_RESETHAND | SA_NODEFER)};
    struct sigaction before;
    sigemptyset(&action.sa_mask);
    const int numbers[] = {SIGINT, SIGTERM, SIGHUP};
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++)
        if (sigaction(numbers[i], NULL, &before) == 0 && before.sa_handler == SIG_DFL)
            sigaction(numbers[i], &action, NULL);
}

void interrupt_says(const char *verb, const char *format, ...) {
    const int next = 1 - current;
    const char *terminal = getenv("TERM");
    const bool bar = isatty(STDERR_FILENO) && terminal && strcmp(terminal, "dumb") != 0;
    char text[LONGEST - 60];
    va_list list;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    snprintf(sentence[next], LONGEST, "%sgough %.30s: %s\n", bar ? "\r\033[K" : "", verb, text);
    current = next;
    watch();
}

void interrupt_outputs(const char *verb, const char *const *output, size_t count, size_t written) {
    char list[600] = "";
    if (written == 0) {
        interrupt_says(verb, "stopped before the end; nothing was written");
        return;
    }
    for (size_t i = 0, used = 0; i < count && used < sizeof list; i++)
        used += (size_t)snprintf(list + used, sizeof list - used, "%s%s %s", i ? ", " : "",
                                 output[i], i < written ? "is complete" : "was not written");
    interrupt_says(verb, "stopped: %s", list);
}
