/* A bar on a terminal for work over a second. */
#ifndef GOUGH_CLI_PROGRESS_H
#define GOUGH_CLI_PROGRESS_H

#include <stdbool.h>

typedef struct progress {
    bool wanted, shown;
    const char *verb;
    double whole;         /* duration of the run, or how many there are */
    double first;         /* what is done already at the beginning */
    const char *counted;  /* "runs", of which the rate is shown; NULL: none */
    double started, last; /* of the clock, seconds */
} progress;

progress progress_begin(const char *verb, double whole, bool quiet);
void progress_update(progress *progress, double done);
void progress_end(progress *progress);

#endif
