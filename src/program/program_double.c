/* The public face of programs in double precision: the texts of program.h compiled for double. */
#define NUMBER_DOUBLE
#include "program/angles.h"
#include "program/program.h"

static void hand_out(jet from, double to[3]) {
    to[0] = from.v;
    to[1] = from.d;
    to[2] = from.dd;
}

void gough_formula_evaluate(const gough_formula *formula, double t, double out[3]) {
    const bool fits = formula->count >= 0 && formula->count <= GOUGH_FORMULA_OPERATIONS;
    hand_out(fits ? formula_jet(formula, t) : (jet){NAN, NAN, NAN}, out);
}

void gough_motion_evaluate(const gough_motion *motion, double t,
                           double component[GOUGH_COMPONENTS][3]) {
    jet out[GOUGH_COMPONENTS];
    motion_components(motion, t, out);
    motion_base_angles(motion_frame(motion), out);
    for (int c = 0; c < GOUGH_COMPONENTS; c++) hand_out(out[c], component[c]);
}

const char *gough_component_name(int component) {
    static const char *const name[GOUGH_COMPONENTS] = {"surge", "sway",  "heave",
                                                       "roll",  "pitch", "yaw"};
    return component >= 0 && component < GOUGH_COMPONENTS ? name[component] : "";
}
