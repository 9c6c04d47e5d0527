/* External loads of the machine at a time, (law-4), each lane's own. Text over the number type. Theory:
 * docs/theory/control.md. */
#ifndef GOUGH_SYSTEM_EXTERNAL_H
#define GOUGH_SYSTEM_EXTERNAL_H

#include "system/parts.h"

static inline void wanted_blame(struct system *r, const char *what, real t) {
    if (r->fault.what == NULL || t < r->fault.time) r->fault = (wanted_fault){what, t};
}

/* where what disturbs the legs is summed up */
static inline number *wanted_shake(const struct system *r, wanted *s) {
    return r->traits & APART ? s->shake : s->force;
}

#define EXTERNAL_FORMULA(n, what)                                                                  \
    "external." #n "." what ".1", "external." #n "." what ".2", "external." #n "." what ".3"
#define EXTERNAL_FORMULAS(n)                                                                       \
    { EXTERNAL_FORMULA(n, "force"), EXTERNAL_FORMULA(n, "moment") }
static const char *const external_name[GOUGH_EXTERNALS][6] = {
    EXTERNAL_FORMULAS(1), EXTERNAL_FORMULAS(2), EXTERNAL_FORMULAS(3), EXTERNAL_FORMULAS(4),
    EXTERNAL_FORMULAS(5), EXTERNAL_FORMULAS(6), EXTERNAL_FORMULAS(7), EXTERNAL_FORMULAS(8)};

/* the six formulas of load n: force, then moment */
static inline const gough_formula *external_formula(const gough_machine *m, int n, int c) {
    const gough_external *e = &m->external[n];

    return c < 3 ? &e->force[c] : &e->moment[c - 3];
}

/* formula c of load n, a time in each lane; where lanes share loads and time, evaluated once */
static inline number external_value(struct system *r, int n, int c, const real *t) {
    number all = number_of(0);
    real value = 0;

    for (int i = 0; i < NUMBER_WIDTH; i++) {
        const int same = i > 0 && r->lane[i].machine->external == r->lane[0].machine->external &&
                         !(t[i] < t[0]) && !(t[i] > t[0]);
        if (!same) {
            value = formula_jet(external_formula(r->lane[i].machine, n, c), t[i]).v;
            if (!real_finite(value)) wanted_blame(r, external_name[n][c], t[i]);
        }
        number_put(&all, i, value);
    }
    return all;
}

/* their sum, with a time in each lane */
static inline known_load external_loads(struct system *r, const real t[NUMBER_WIDTH]) {
    known_load all = known_load_none();

    for (int n = 0; n < r->externals; n++) {
        number f[6];
        for (int c = 0; c < 6; c++) f[c] = r->external_share * external_value(r, n, c, t);
        known_load_add(&all, &r->h, r->external_turns[n], r->external_arm[n],
                       (vector){f[0], f[1], f[2]}, (vector){f[3], f[4], f[5]});
    }
    return all;
}

/* the same at one time in all lanes */
static inline void wanted_external(struct system *r, real t, wanted *s) {
    real times[NUMBER_WIDTH];

    if (r->externals == 0) return;
    for (int i = 0; i < NUMBER_WIDTH; i++) times[i] = t;
    s->external = external_loads(r, times);
}

#endif
