/* Our right-hand side for others' steppers. Text over double, compiled for each width of registers as the library's own run is,
 * so that both have the same instructions. */
#include "bench/rates.h"
#include "system/system.h"

static void rates_begin(void *memory, const reference *ref, double state[24]) {
    static const gough_simulation options = {.constraints = GOUGH_BAUMGARTE, .baumgarte = {5, 5}};
    const system_lane lane = {.machine = &ref->model.machine,
                              .control = &ref->model.control,
                              .disturbance = &ref->model.disturbance};
    const hexapod *h = &((const struct system *)memory)->h;
    jet component[GOUGH_COMPONENTS];
    coordinates x[3];

    system_begin(memory, &ref->model.motion, &options, &lane);
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        component[c] = jet_constant(ref->model.initial.component[c]);
    }
    coordinates_of_motion(h, ref->model.machine.platform.height, ref->model.motion.about,
                          motion_frame(&ref->model.motion), component, x);
    coordinates_store(&x[0], state);
    for (int i = COORDINATES; i < MOTION; i++) state[i] = 0;
}

static void rates(void *memory, double t, const double *y, double *rate) {
    system_rates(memory, t, y, rate);
}

#define RATES_WIDTH                                                                                \
    { sizeof(struct system), rates_begin, rates }
