/* How much of each limit of the legs a run uses, in the units of the output: for reading and as JSON. */
#ifndef GOUGH_CLI_LIMITS_USED_H
#define GOUGH_CLI_LIMITS_USED_H

#include "cli/run/run_report.h"

enum { LIMIT_KINDS = 4, MOST_LIMITS = LIMIT_KINDS * GOUGH_LEGS };

/* One limit of one leg over a run. */
typedef struct limit_use {
    int leg;          /* 1 … 6 */
    gough_cause kind; /* GOUGH_END_LEG_SHORT, _LONG, _SPEED or _FORCE */
    double limit;     /* of the study */
    double worst; /* the value nearest to the limit, or furthest beyond: length, |speed| or force */
    double share; /* of the limit used; over 1 where it is exceeded */
    size_t count; /* how many times it is exceeded */
    double enter; /* when it is exceeded first; NaN: never */
    double
        leave; /* when it is met again after the last time; NaN: not before the end, or never exceeded */
    double worst_time; /* of an excess; NaN: never exceeded */
} limit_use;

/* What a limit of this cause measures; a length for causes that are no limit. */
gough_unit limit_unit(gough_cause cause);

/* Those that the study gives, kind by kind; returns how many. The report is scaled. */
int limits_used(const run_report *report, limit_use use[MOST_LIMITS]);

/* One line for each leg and kind that is exceeded, and for each kind that is met by all legs; `all`: each excess too. */
void limits_print(FILE *stream, const run_report *report, bool all);

#endif
