/* Warnings of gough check: what a valid study says that is probably not meant. */
#ifndef GOUGH_CLI_CHECK_WARNINGS_H
#define GOUGH_CLI_CHECK_WARNINGS_H

#include "cli/run/run_report.h"

/* Says them on standard error, one line each, in the study's units. */
void check_warnings(const char *verb, const gough_study *study, const gough_units *unit);

#endif
