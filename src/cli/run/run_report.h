/* What a run leaves in a few numbers, for reading and as JSON, in the units of the output. */
#ifndef GOUGH_CLI_RUN_REPORT_H
#define GOUGH_CLI_RUN_REPORT_H

#include <jansson.h>
#include <stdio.h>

#include "gough/gough.h"

/* Limits that the program exceeds. */
typedef struct crossing_list {
    gough_crossing *list;
    size_t count, room;
    bool incomplete; /* there was no memory for all */
} crossing_list;

typedef struct run_report {
    const char *verb;
    bool simulated;
    const gough_study *study;
    gough_units units;
    gough_summary summary;        /* scaled to the output's units, angles in degrees */
    gough_end end;                /* time, limit and sentence in the output's units */
    gough_statistics statistics;  /* its rate and time in the output's units */
    crossing_list crossings;      /* scaled; forces only */
    double stroke[GOUGH_LEGS][2]; /* least and greatest length, scaled; 0 and INFINITY: none */
    double
        holds_from[GOUGH_LEGS];  /* drive forces that hold the legs at rest at home, scaled; NaN: */
    double holds_to[GOUGH_LEGS]; /* none can */
    const char *const *output;   /* where the tables went; "-" among them */
    size_t outputs;
    bool all; /* each excess of a limit is listed */
} run_report;

/* Runs the study of a report, `simulated` or not, whose numbers are then in units of the run; rows go into `result` too, which
 * may be NULL. Without memory for them it is GOUGH_ERROR_FILE. */
struct command_line;
gough_status run_report_fill(run_report *report, const struct command_line *line,
                             gough_result *result, gough_error *error);

/* Turns the numbers of a run into the output's units. */
void run_report_scale(run_report *report);

/* The end of a run that is not scaled yet, its sentence in the output's units. */
gough_end run_report_end(const run_report *report);

void run_report_print(FILE *stream, const run_report *report);

/* Remarks, if it is so, that stability and not the tolerance kept the steps of a run short. */
void remark_stiffness(const char *verb, const run_report *report);

/* The summary as JSON, and printed on standard output. Returns 0, or -1 when out of memory or the output cannot be written. */
json_t *run_report_json(const run_report *report);
int run_report_print_json(const run_report *report);

#endif
