/* A user's program: one machine, the forces that hold it at rest. */
#include <gough/gough.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

int main(void) {
    const gough_platform platform = gough_platform_symmetric(1.0, 0.2, 0.6, 0.1, 1.0);
    const gough_load load = {.mass = 1.0, .inertia = {{0.08, 0, 0}, {0, 0.08, 0}, {0, 0, 0.15}}};
    gough_machine machine;
    gough_error error = {0};
    double force[GOUGH_LEGS];
    if (gough_machine_init(&machine, &platform, &load, (double[3]){0, 0, -1}, &error) != GOUGH_OK) {
        fprintf(stderr, "%s\n", error.message);
        return 1;
    }
    const gough_state home = gough_state_home(&machine);
    const gough_acceleration rest = {{0}, {0}};
    if (gough_inverse_dynamics(&machine, &home, &rest, NULL, force, NULL) != GOUGH_OK) return 1;
    if (strcmp(gough_version(), GOUGH_VERSION) != 0) return 1;
    printf("%.12f\n", force[0] * 6.0 * machine.platform.height / machine.home_length[0]);
    return 0;
}
