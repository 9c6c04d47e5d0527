/* How long the determinant of a pose need not be computed: while nothing is asked for, no pose changes its side or is nearly
 * singular. Another road: gough_conditioning() of each pose. */
#define NUMBER_DOUBLE
#include "batch/watch.h"

#include <stdio.h>

#include "support/machines.h"
#include "support/random.h"
#include "support/suite.h"

enum { MACHINES = 100, WAYS = 40, STEPS = 60 };

/* position and rotation vector */
typedef struct {
    double c[6];
} place;

/* a machine whose joints lie anywhere, of legs about as long as the base is wide */
static void any_machine(dice *d, gough_machine *machine) {
    const double gravity[3] = {0, 0, -1};
    const gough_load load = {.mass = 1, .inertia = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    gough_platform p = gough_platform_symmetric(1, 0.3, 0.6, 0.3, 1.2);
    gough_error error = {0};

    for (int v = 0; v < GOUGH_LEGS; v++) {
        for (int c = 0; c < 3; c++) {
            p.base[v][c] += dice_between(d, -0.3, 0.3);
            p.top[v][c] += dice_between(d, -0.3, 0.3);
        }
    }
    ck_assert_msg(gough_machine_init(machine, &p, &load, gravity, &error) == GOUGH_OK, "%s",
                  error.message);
}

static place any_place(dice *d, double shift, double turn) {
    place p;

    for (int c = 0; c < 6; c++) p.c[c] = dice_between(d, -1, 1) * (c < 3 ? shift : turn);
    return p;
}

/* rotation of a rotation vector, by its axis and angle */
static gough_state state_at(const gough_machine *machine, const place *p) {
    const double *w = p->c + 3, angle = sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
    const double s = angle > 0 ? sin(angle) / angle : 1;
    const double k = angle > 0 ? (1 - cos(angle)) / (angle * angle) : 0.5;
    const double cross[3][3] = {{0, -w[2], w[1]}, {w[2], 0, -w[0]}, {-w[1], w[0], 0}};
    gough_state state = gough_state_home(machine);

    for (int r = 0; r < 3; r++) {
        state.position[r] += p->c[r];
        for (int c = 0; c < 3; c++)
            state.rotation[r][c] = (r == c ? cos(angle) : 0) + s * cross[r][c] + k * w[r] * w[c];
    }
    return state;
}

static coordinates coordinates_at(const hexapod *h, const gough_state *state) {
    const double(*r)[3] = state->rotation;
    const triad R = {
        {r[0][0], r[1][0], r[2][0]}, {r[0][1], r[1][1], r[2][1]}, {r[0][2], r[1][2], r[2][2]}};

    return coordinates_of_top(h, (vector){0, 0, 0}, vector_of(state->position), &R);
}

/* Along straight ways from random poses, as far as nothing is asked for, or to the end. Returns how far, of 1; *crossed: how many
 * of the ways went through a singular pose later. */
static double walk(const gough_machine *machine, dice *d, int *crossed) {
    const place from = any_place(d, 0.5, 1), by = any_place(d, 0.8, 1.6);
    const gough_state first = state_at(machine, &from);
    double condition, determinant, before, held = 0;
    bool silent = true, passed = false;
    pose_watch w;
    hexapod h;
    legs g;

    hexapod_of_machine(&h, machine);
    coordinates x = coordinates_at(&h, &first);
    legs_at(&h, &x, &g);
    gough_conditioning(machine, &first, &condition, &before);
    watch_begin(&w, &h);
    watch_set(&w, &x, &g, before);
    for (int n = 1; n <= STEPS; n++) {
        /* fine steps first: in a walk of equal steps hardly any would be within what is allowed */
        const double part = pow((double)n / STEPS, 3);
        place there = from;
        for (int c = 0; c < 6; c++) there.c[c] += part * by.c[c];
        const gough_state state = state_at(machine, &there);
        gough_conditioning(machine, &state, &condition, &determinant);
        x = coordinates_at(&h, &state);
        legs_at(&h, &x, &g);
        silent = silent && !watch_moved(&w, &x, &g, 1);
        if (silent) {
            held = part;
            ck_assert_msg(determinant * before > 0 && condition < 1e8,
                          "determinant %g, then %g; condition %g", before, determinant, condition);
        }
        passed = passed || !(determinant * before > 0);
    }
    *crossed += passed;
    return held;
}

START_TEST(nothing_happens_while_nothing_is_asked_for) {
    dice d = {41};
    double sum = 0;
    int crossed = 0;

    for (int n = 0; n < MACHINES; n++) {
        gough_machine machine;
        any_machine(&d, &machine);
        for (int k = 0; k < WAYS; k++) sum += walk(&machine, &d, &crossed);
    }
    printf("%.2g of each way on average; %d of %d ways pass a singular pose\n",
           sum / (MACHINES * WAYS), crossed, MACHINES * WAYS);
    ck_assert_msg(sum > 5e-4 * MACHINES * WAYS && crossed > MACHINES, "%g and %d", sum, crossed);
}
END_TEST

/* a pose that is nearly singular is asked about wherever it goes, and so is what is not a number */
START_TEST(what_is_nearly_singular_is_always_asked_about) {
    dice d = {42};
    gough_machine machine;
    pose_watch w;
    hexapod h;
    legs g;

    any_machine(&d, &machine);
    hexapod_of_machine(&h, &machine);
    const place home = {{0}};
    const gough_state state = state_at(&machine, &home);
    coordinates x = coordinates_at(&h, &state);
    legs_at(&h, &x, &g);
    watch_begin(&w, &h);
    watch_set(&w, &x, &g, 1e-9);
    ck_assert(watch_moved(&w, &x, &g, 1));
    ck_assert(!watch_moved(&w, &x, &g, 0));
    watch_set(&w, &x, &g, 1);
    ck_assert(!watch_moved(&w, &x, &g, 1));
    g.n[3].y = NAN;
    ck_assert(watch_moved(&w, &x, &g, 1));
}
END_TEST

int main(void) {
    return SUITE_RUN("watch", 60, nothing_happens_while_nothing_is_asked_for,
                     what_is_nearly_singular_is_always_asked_about);
}
