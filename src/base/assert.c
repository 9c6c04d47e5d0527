/* What happens when an assertion fails, unless the program has a function of this name. */
#include "base/assert.h"

__attribute__((weak)) void gough_assertion_failed(const char *file, int line,
                                                  const char *condition) {
    (void)file, (void)line, (void)condition;
    abort();
}
