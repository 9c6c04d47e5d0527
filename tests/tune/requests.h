/* Requests for a tuning, with their memory and their answer. */
#ifndef TESTS_TUNE_REQUESTS_H
#define TESTS_TUNE_REQUESTS_H

#include "gough/tune.h"

typedef struct request {
    gough_model *model;
    gough_simulation simulation;
    gough_tuning_options options;
    gough_tuning_point *point;
    gough_tuning tuning;
} request;

/* The paper's machine at home, without gains, run for this time; request_drop() frees its memory. */
request request_new(double duration);
void request_drop(request *r);

/* The same with feed-forward and a damping, pushed by forces of the legs that come on slowly; few rows, one thread. */
request request_pushed(double damping);

/* Asks; request_find() insists on an answer. */
gough_status request_ask(request *r, bool feedforward, gough_error *error);
void request_find(request *r, bool feedforward);

/* The largest deviation of a run with these gains; infinite where it ends early. */
double request_deviation(const request *r, double stiffness, double damping, double duration);

#endif
