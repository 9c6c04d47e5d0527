/* The library of the earlier edition, as far as its program needs it. */
#include "earlier.h"

gough_simulation gough_simulation_default(void) { return (gough_simulation){20, 0.05, {0}}; }
int gough_simulation_check(const void *model, const gough_simulation *simulation, void *error) {
    (void)model, (void)simulation, (void)error;
    return 0;
}
gough_formula gough_formula_constant(double value) { return (gough_formula){{value > 0}}; }
