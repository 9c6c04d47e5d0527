/* Whether external loads repeat with the period of a program: what is linearised about it is periodic only then. Theory:
 * docs/theory/floquet.md. */
#include "floquet/loads.h"

#include <math.h>

#include "base/quantity.h"
#include "gough/model.h"

/* moments of a period, spread by the golden ratio */
enum { MOMENTS = 64 };
static const double golden = 0.61803398874989485;

/* values this close, relative to the largest, are the same */
static const double same = 1e-9;

static double value_at(const gough_formula *formula, double t) {
    double jet[3];

    gough_formula_evaluate(formula, t, jet);
    return jet[0];
}

static bool repeats(const gough_formula *formula, const gough_period *p, bool constant) {
    double largest = 0, apart = 0;

    for (int k = 0; k < MOMENTS; k++) {
        const double t = p->start + p->period * (k * golden - floor(k * golden));
        const double one = value_at(formula, t);
        const double other = value_at(formula, constant ? p->start : t + p->period);
        largest = fmax(largest, fmax(fabs(one), fabs(other)));
        apart = isfinite(one - other) ? fmax(apart, fabs(one - other)) : INFINITY;
    }
    return apart <= same * largest;
}

/* the number of the first load that does not repeat, or that varies; 0: none */
static size_t first_that_does_not(const gough_machine *machine, const gough_period *period,
                                  bool constant) {
    for (size_t n = 0; n < machine->externals; n++) {
        const gough_external *e = &machine->external[n];
        for (int c = 0; c < 3; c++) {
            if (!repeats(&e->force[c], period, constant) ||
                !repeats(&e->moment[c], period, constant))
                return n + 1;
        }
    }
    return 0;
}

gough_status loads_check(const gough_machine *machine, const gough_period *period,
                         gough_error *error) {
    const size_t load = first_that_does_not(machine, period, false);

    if (load == 0) return GOUGH_OK;
    return gough_fail_key(error, GOUGH_ERROR_INPUT, "external",
                          "external: load %zu does not repeat with the period %.9g" IN_TIME
                          " of the program, so there are no multipliers; simulate "
                          "instead",
                          load, period->period);
}

bool loads_constant(const gough_machine *machine, const gough_period *period) {
    return first_that_does_not(machine, period, true) == 0;
}
