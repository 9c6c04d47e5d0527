/* What gough tune has found: a choice for each setting of the feed-forward, and its curve; for reading, as JSON and as table. */
#ifndef GOUGH_CLI_TUNE_REPORT_H
#define GOUGH_CLI_TUNE_REPORT_H

#include <stdio.h>

#include "gough/gough.h"

/* Numbers are in the units of the output once tune_scale() has seen them; angles then in degrees. */
typedef struct tune_choice {
    bool feedforward;
    gough_tuning tuning;
    gough_tuning_point *point; /* of the curve, room for GOUGH_TUNING_POINTS */
} tune_choice;

typedef struct tune_report {
    const char *verb;
    const gough_study *study;
    gough_units units;
    gough_tuning_options asked;
    tune_choice choice[2];
    int choices;
} tune_report;

/* Turns the numbers into the output's units. */
void tune_scale(tune_report *report);

void tune_print(FILE *stream, const tune_report *report);

/* how many points of the curve were judged in each of the ways of gough_tuning_judged */
enum { TUNE_JUDGED = GOUGH_TUNING_ALONG + 1 };
void tune_count_judged(const tune_choice *choice, size_t judged[TUNE_JUDGED]);

/* One JSON object on standard output. Returns 0, or -1 where it cannot be written. */
int tune_print_json(const tune_report *report);

/* The curves as one table: a row for each point, with the G named among them; NULL if out of memory. */
gough_table *tune_table(const tune_report *report);

#endif
