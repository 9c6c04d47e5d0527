/* What a sweep leaves in a few numbers, for reading and as JSON. */
#ifndef GOUGH_CLI_SWEEP_REPORT_H
#define GOUGH_CLI_SWEEP_REPORT_H

#include <jansson.h>
#include <stdio.h>

#include "cli/common/verb.h"
#include "gough/gough.h"

typedef struct sweep_report {
    const char *verb, *title;
    const gough_sweep *sweep; /* NULL: of merged shards, whose study is not read */
    gough_sweep_summary summary;
    gough_units units;         /* of the output */
    double time;               /* seconds that it took */
    const char *const *output; /* where the tables went */
    size_t outputs;
} sweep_report;

/* The summary on standard output, or on standard error if a table goes there; or as JSON. */
gough_status sweep_tell(const command_line *line, const sweep_report *report);

/* Returns 0, or -1 where the output cannot be written. */
int sweep_print_run_json(const gough_sweep *sweep, size_t run, const double *value);

/* "control.stiffness=10, load.mass=2" of a run. */
void sweep_name_values(const gough_sweep *sweep, size_t run, char *text, size_t size);

/* Whether the noise of a run is selected by its number, so that the run alone needs to be told it. */
bool sweep_numbers_noise(const gough_sweep *sweep);

/* The same for noise and jitter of a sampled controller. */
bool sweep_numbers_samples(const gough_sweep *sweep);

/* What a study would run, for gough check. */
void sweep_describe(const gough_sweep *sweep);
json_t *sweep_object(const gough_sweep *sweep);

#endif
