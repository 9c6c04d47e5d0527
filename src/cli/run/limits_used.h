/* How much of each limit of the legs a run uses, in the units of the output: for reading and as JSON. */
#ifndef GOUGH_CLI_LIMITS_USED_H
#define GOUGH_CLI_LIMITS_USED_H

#include "cli/run/run_report.h"

/* of each leg: length, speed, force, acceleration, swings; of each component of the platform two for each derivative */
enum { MOST_LIMITS = (8 + 6) * GOUGH_LEGS };

/* One limit of one leg or of the platform over a run. */
typedef struct limit_use {
    int leg;          /* 1 … 6; 0: of the platform */
    int component;    /* 1 … 6; 0: of a leg */
    gough_cause kind; /* the cause of an end at this limit */
    bool least;       /* a least value, other than that of a length */
    double limit;     /* of the study */
    double
        worst; /* the value nearest to the limit, or furthest beyond: length, |speed| or force … */
    double
        share; /* of the limit used; over 1 where it is exceeded; not finite: the limit is 0, or of another sign */
    size_t count; /* how many times it is exceeded */
    double enter; /* when it is exceeded first; NaN: never */
    double
        leave; /* when it is met again after the last time; NaN: not before the end, or never exceeded */
    double worst_time; /* of an excess; NaN: never exceeded */
} limit_use;

/* What a limit of this cause and component (0: of a leg) measures; a length for causes that are no limit. */
gough_unit limit_unit(gough_cause cause, int component);

/* The words for the message of an end in these units. */
gough_end_words limit_words(const gough_units *units);

/* Time and limit of an end in the units of the output; its sentence stays. */
void end_scale(gough_end *end, const gough_units *units);

/* Those that the study gives, kind by kind; returns how many. The report is scaled. */
int limits_used(const run_report *report, limit_use use[MOST_LIMITS]);

/* One line for each leg and kind that is exceeded, and for each kind that is met by all legs; `all`: each excess too. */
void limits_print(FILE *stream, const run_report *report, bool all);

#endif
