/* The nearest of some names to what was typed. */
#ifndef GOUGH_REPORT_NEAREST_H
#define GOUGH_REPORT_NEAREST_H

#include <stddef.h>

/* Index of the name with the least number of insertions, deletions and replacements to @p text, or -1 if none is within
 * a third of its length (at least 2). Names end at a space. */
int nearest_name(const char *text, const char *const *names, size_t count);

#endif
