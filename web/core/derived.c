/* Leg lengths, rates and condition numbers of many rows, by the library's functions for one pose. */
#include "derived.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gough/dynamics.h"
#include "reach.h"

/* 96 MiB of input; the page asks for fewer */
static const size_t most_rows = (size_t)1 << 20;

/* The module holds one table; this is it. */
static struct {
    size_t rows;
    double *in, *out;
} derived;

double *derived_input(size_t rows) {
    free(derived.in);
    derived.rows = rows;
    derived.in = rows > 0 && rows <= most_rows ? malloc(rows * DERIVED_IN * sizeof(double)) : NULL;
    return derived.in;
}

static void find_row(const gough_model *model, const double *in, double *out) {
    gough_state state = gough_state_home(&model->machine);
    /* without finite numbers the calls below write nothing */
    for (int i = 0; i < DERIVED_OUT; i++) out[i] = NAN;
    memcpy(state.position, in, sizeof state.position);
    gough_rotation_in_order(model->motion.order, in + 3, state.rotation);
    memcpy(state.velocity, in + 6, sizeof state.velocity);
    memcpy(state.angular_velocity, in + 9, sizeof state.angular_velocity);
    gough_leg_kinematics(&model->machine, &state, NULL, out, out + 6, NULL);
    gough_conditioning(&model->machine, &state, out + 12, NULL);
}

const double *derived_find(void) {
    const gough_model *model = live_model();
    free(derived.out);
    derived.out = NULL;
    if (!model || !derived.in) return NULL;
    derived.out = malloc(derived.rows * DERIVED_OUT * sizeof(double));
    for (size_t i = 0; derived.out && i < derived.rows; i++)
        find_row(model, derived.in + i * DERIVED_IN, derived.out + i * DERIVED_OUT);
    return derived.out;
}
