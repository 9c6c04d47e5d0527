/* Kernels of one run alone, and our right-hand side for others' steppers. */
#define NUMBER_DOUBLE
#include "bench/kernels_text.h"

const kernel_width kernel_width_1 = KERNEL_WIDTH;

size_t kernel_rates_size(void) { return sizeof(run); }

void kernel_rates_begin(void *memory, const reference *ref, double state[24]) {
    static const gough_simulation options = {.constraints = GOUGH_BAUMGARTE, .baumgarte = {5, 5}};
    const run_lane lane = {.machine = &ref->model.machine,
                           .control = &ref->model.control,
                           .disturbance = &ref->model.disturbance};
    const hexapod *h = &((const run *)memory)->h;
    jet component[GOUGH_COMPONENTS];
    coordinates x[3];

    run_begin(memory, &ref->model.motion, &options, &lane);
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        component[c] = jet_constant(ref->model.initial.component[c]);
    }
    coordinates_of_motion(h, ref->model.machine.platform.height, ref->model.motion.about, component,
                          x);
    coordinates_store(&x[0], state);
    for (int i = COORDINATES; i < STATE; i++) state[i] = 0;
}

void kernel_rates(void *memory, double t, const double *y, double *rate) {
    run_rates(memory, t, y, rate);
}

const kernel_width *kernel_of(int lanes) {
    if (lanes > gough_batch_lanes()) return NULL;
    switch (lanes) {
    case 1:
        return &kernel_width_1;
    case 2:
        return &kernel_width_2;
#if defined(__x86_64__)
    case 4:
        return &kernel_width_4;
    case 8:
        return &kernel_width_8;
#endif
    default:
        return NULL;
    }
}
