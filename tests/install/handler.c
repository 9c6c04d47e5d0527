/* A user's program with a bug: it gives gough_batch() memory that is not aligned. With -DHANDLER it has a handler of its own. */
#include <gough/gough.h>
#include <stdio.h>
#include <stdlib.h>

#ifdef HANDLER
void gough_assertion_failed(const char *file, int line, const char *condition) {
    printf("%s, %s: %s\n", file, line > 0 ? "a line" : "no line", condition);
    fflush(stdout);
    _Exit(7);
}
#endif

int main(void) {
    static gough_model model;
    static gough_outcome outcome;
    static _Alignas(64) char memory[1 << 23];
    const gough_platform platform = gough_platform_symmetric(1.0, 0.2, 0.6, 0.1, 1.0);
    const gough_load load = {.mass = 1.0, .inertia = {{0.08, 0, 0}, {0, 0.08, 0}, {0, 0, 0.15}}};
    const gough_simulation simulation = gough_simulation_default();
    const gough_batch_run run = {
        &model.machine, &model.control, &model.disturbance, &model.initial, 1, 0};
    gough_batch_options options = gough_batch_options_default();
    options.lanes = options.threads = 1;
    if (gough_batch_size(&options) + 16 > sizeof memory) return 2;
    if (gough_machine_init(&model.machine, &platform, &load, (double[3]){0, 0, -1}, NULL)) return 3;
    if (gough_batch(&model.motion, &simulation, &run, 1, &options, &outcome, memory, NULL))
        return 4;
    puts("aligned");
    fflush(stdout);
    return (int)gough_batch(&model.motion, &simulation, &run, 1, &options, &outcome, memory + 16,
                            NULL);
}
