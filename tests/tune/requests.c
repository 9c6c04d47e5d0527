/* Requests for a tuning, with their memory and their answer. */
#include "tune/requests.h"

#include <stdlib.h>

#include "support/machines.h"

request request_new(double duration) {
    request r = {.model = calloc(1, sizeof *r.model),
                 .simulation = gough_simulation_default(),
                 .options = gough_tuning_options_default(),
                 .point = calloc(GOUGH_TUNING_POINTS, sizeof *r.point)};

    ck_assert(r.model != NULL && r.point != NULL);
    paper_machine(&r.model->machine);
    r.simulation.duration = duration;
    return r;
}

void request_drop(request *r) {
    free(r->model);
    free(r->point);
}

request request_pushed(double damping) {
    request r = request_new(12);

    set_gains(r.model, 0, damping);
    r.model->control.feedforward = true;
    for (int v = 0; v < GOUGH_LEGS; v++)
        set_formula(&r.model->disturbance.leg_force[v],
                    v == 0 ? "0.002*(1 - exp(-t))" : "0.001*(1 - exp(-t))");
    r.simulation.output_step = 0.1;
    r.options.deviation = 1e-3;
    r.options.threads = 1;
    return r;
}

gough_status request_ask(request *r, bool feedforward, gough_error *error) {
    size_t bytes;
    gough_status status = gough_tune_size(r->model, &r->options, &bytes, error);
    void *memory = status == GOUGH_OK ? aligned_alloc(64, (bytes + 63) / 64 * 64) : NULL;

    if (status != GOUGH_OK) return status;
    ck_assert(memory != NULL);
    status = gough_tune(r->model, &r->simulation, feedforward, &r->options, r->point, &r->tuning,
                        memory, error);
    free(memory);
    return status;
}

void request_find(request *r, bool feedforward) {
    gough_error error = {0};

    ck_assert_msg(request_ask(r, feedforward, &error) == GOUGH_OK, "%s", error.message);
}

double request_deviation(const request *r, double stiffness, double damping, double duration) {
    gough_model *model = malloc(sizeof *model);
    gough_simulation simulation = r->simulation;
    gough_summary summary;
    gough_end end;

    ck_assert(model != NULL);
    *model = *r->model;
    set_gains(model, stiffness, damping);
    simulation.duration = duration;
    simulation.summary = &summary;
    ck_assert_int_ne(gough_simulate(model, &simulation, NULL, NULL, &end, NULL), GOUGH_ERROR_INPUT);
    free(model);
    return end.cause == GOUGH_END_DONE ? summary.position_deviation : INFINITY;
}
