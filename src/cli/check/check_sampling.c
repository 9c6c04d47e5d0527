/* A sampled controller at home for reading: when it looks, between which gains it holds, what its commands are made of. */
#include "cli/check/check_sampling.h"

#include <math.h>

#include "cli/common/scale.h"

static double largest_of(const double value[GOUGH_LEGS]) {
    double largest = 0;
    for (int v = 0; v < GOUGH_LEGS; v++) largest = fmax(largest, value[v]);
    return largest;
}

/* A sampled controller at home. */
void print_sampling(const gough_study *study, const gough_units *unit, const sampled_view *view) {
    const gough_sampling *s = &study->model->control.sampling;
    const gough_sampled_rest *r = &view->rest;
    const char *time = unit_word(unit, GOUGH_UNIT_TIME), *force = unit_word(unit, GOUGH_UNIT_FORCE);
    if (!(s->period > 0)) return;
    printf("  sampling             every %.6g%s, commands act ",
           in_units(unit, GOUGH_UNIT_TIME, s->period), time);
    if (s->delay > 0)
        printf("%.6g%s later", in_units(unit, GOUGH_UNIT_TIME, s->delay), time);
    else
        printf("at once");
    if (view->found)
        printf(";\n                       as if they were %.6g%s late",
               in_units(unit, GOUGH_UNIT_TIME, r->effective_delay), time);
    printf("\n");
    sampled_view_print(stdout, study, unit, view);
    if (!view->found) return;
    printf("  at rest at home      largest multiplier |mu| = %.9g a sample: %s\n", r->radius,
           r->decaying ? "deviations die out"
           : r->stable ? "nothing grows"
                       : "deviations grow");
    printf(
        "  least mass           %.6g%s moves with a leg force, in the mode it moves most easily\n",
        in_units(unit, GOUGH_UNIT_MASS, r->mass), unit_word(unit, GOUGH_UNIT_MASS));
    if (largest_of(r->noise) > 0)
        printf("  noise of commands    %.6g%s RMS\n",
               in_units(unit, GOUGH_UNIT_FORCE, largest_of(r->noise)), force);
    if (largest_of(r->count) > 0)
        printf("  one count of length  moves a command by %.6g%s\n",
               in_units(unit, GOUGH_UNIT_FORCE, largest_of(r->count)), force);
}
