/* The certified way of many poses over the number type of the including file: plain arrays of double outside, in blocks of
 * NUMBER_WIDTH. */
#include "pose/walk.h"
#include "support/walks.h"

static inline number walk_pack(const double (*from)[WALK_NUMBERS], int first, int at) {
    number x = number_of(0);

    for (int k = 0; k < NUMBER_WIDTH; k++) number_put(&x, k, from[first + k][at]);
    return x;
}

/* in: base and top joints, squares, widths, x; out: x and the numbers of the way */
static inline void walk_all(int count, const double (*in)[WALK_NUMBERS],
                            double (*out)[WALK_RESULTS]) {
    for (int first = 0; first < count; first += NUMBER_WIDTH) {
        number b[3], a[3], square[SOMA_LEGS], width[SOMA_LEGS], x[SOMA];
        soma_legs legs;
        soma_way way;
        int at = 0;

        for (int v = 0; v < SOMA_LEGS; v++) {
            for (int k = 0; k < 3; k++) b[k] = walk_pack(in, first, at++);
            for (int k = 0; k < 3; k++) a[k] = walk_pack(in, first, at++);
            square[v] = walk_pack(in, first, at++);
            width[v] = walk_pack(in, first, at++);
            soma_row(b, a, legs.row[v]);
        }
        soma_legs_bound(&legs);
        for (int k = 0; k < SOMA; k++) x[k] = walk_pack(in, first, at++);
        soma_walk(&legs, square, width, WALK_STEPS, x, &way);
        const number result[5] = {way.steps, way.reached, way.margin, way.error, way.unique};
        for (int k = 0; k < NUMBER_WIDTH; k++) {
            for (int i = 0; i < SOMA; i++) out[first + k][i] = number_lane(x[i], k);
            for (int i = 0; i < 5; i++) out[first + k][SOMA + i] = number_lane(result[i], k);
        }
    }
}
