/* One right-hand side and one inverse dynamics of many poses over the number type of the including file: the same texts, plain
 * arrays of double outside. Poses come in blocks of NUMBER_WIDTH. */
#include "control/law.h"
#include "plant/forward.h"
#include "plant/hexapod.h"
#include "plant/inverse.h"
#include "plant/state.h"
#include "support/kernel.h"

static inline void evaluate(const gough_machine *machine, int count, double (*state)[24],
                            double (*acceleration)[12], double (*out)[KERNEL_RESULTS]) {
    hexapod h;

    hexapod_of_machine(&h, machine);
    for (int first = 0; first < count; first += NUMBER_WIDTH) {
        number y[24], a[12], rate[12], u[6], wrench[1][6];
        coordinates x, v, acc, wanted;
        const vector none = {number_of(0), number_of(0), number_of(0)};
        elimination e;
        legs g;

        for (int i = 0; i < 24; i++) {
            y[i] = number_of(0);
            for (int k = 0; k < NUMBER_WIDTH; k++) number_put(&y[i], k, state[first + k][i]);
        }
        for (int i = 0; i < 12; i++) {
            a[i] = number_of(0);
            for (int k = 0; k < NUMBER_WIDTH; k++) number_put(&a[i], k, acceleration[first + k][i]);
        }
        x = coordinates_load(y);
        v = coordinates_load(y + 12);
        wanted = coordinates_load(a);
        coordinates_project(&x, &v);
        legs_at(&h, &x, &g);
        legs_rates(&h, &v, &g);
        required_wrench(&h, &x, &v, &wanted, none, none, wrench[0]);
        e = leg_forces_of(&h, &x, &g, wrench, 1);
        for (int n = 0; n < LEGS; n++) {
            u[n] = law_force(wrench[0][n], number_of(20), number_of(3), number_of(1.3), g.rate[n],
                             g.length[n], number_of(0));
        }
        acc = forward_dynamics(&h, &x, &v, &g, 0, u, &none, &none);
        triad_stabilise(&h.load, &x.q, &v.q, number_of(1), number_of(2), &acc.q);
        coordinates_store(&acc, rate);
        for (int k = 0; k < NUMBER_WIDTH; k++) {
            double *o = out[first + k];
            for (int i = 0; i < 12; i++) o[i] = number_lane(rate[i], k);
            for (int n = 0; n < 6; n++) o[12 + n] = number_lane(wrench[0][n], k);
            o[18] = number_lane(e.determinant, k);
            o[19] = number_lane(triad_violation(&x.q), k);
            o[20] = number_lane(legs_condition(&h, &x, &g), k);
        }
    }
}

/* of pairs a, b: the larger and the smaller, the one chosen by a > b, and whether that is so in any lane */
static inline void choose(int count, const double *a, const double *b, double (*out)[4]) {
    for (int first = 0; first < count; first += NUMBER_WIDTH) {
        number x = number_of(0), y = x;

        for (int k = 0; k < NUMBER_WIDTH; k++) {
            number_put(&x, k, a[first + k]);
            number_put(&y, k, b[first + k]);
        }
        const mask m = number_greater(x, y);
        const number larger = number_larger(x, y), smaller = number_smaller(x, y);
        const number chosen = number_select(m, number_of(1), number_of(2));
        for (int k = 0; k < NUMBER_WIDTH; k++) {
            double *o = out[first + k];
            o[0] = number_lane(larger, k);
            o[1] = number_lane(smaller, k);
            o[2] = number_lane(chosen, k);
            o[3] = number_any(m) ? 1 : 0;
        }
    }
}
