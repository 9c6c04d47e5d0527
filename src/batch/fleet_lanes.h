/* A group of plants side by side, one a lane: fixed steps under commands that are held, constraints kept, limits compared at the
 * end of each step. A lane that has ended is still computed, but keeps its state. Text over the number type. */
#ifndef GOUGH_BATCH_FLEET_LANES_H
#define GOUGH_BATCH_FLEET_LANES_H

#include <string.h>

#include "batch/fleet_lanes_table.h"
#include "integrate/march.h"
#include "run/margins.h"
#include "system/problem.h"
#include "system/system.h"

typedef struct {
    int count;
    int own;                 /* it has a system of its own */
    int ended[NUMBER_WIDTH]; /* gough_fleet_state */
    int fresh[NUMBER_WIDTH]; /* there has been no command since the plant was put into its state */
    number moving;           /* 1 in lanes that move, else 0 */
    number side;             /* signs of the determinants in the states that plants were put into */
    number y[STATE_SIZE];    /* states */
} plants;

/* a group with the system that it uses */
typedef struct {
    plants *p;
    struct system *r;
} moved;

/* sizes in memory, whose parts are aligned to 64 bytes */
enum {
    PLANTS_SIZE = (sizeof(plants) + 63) / 64 * 64,
    SYSTEM_SIZE = (sizeof(struct system) + 63) / 64 * 64
};

static inline plants *plants_at(const fleet_memory *memory, size_t group) {
    return (plants *)(void *)(memory->group + group * PLANTS_SIZE);
}

static inline struct system *plants_system(const fleet_memory *memory, size_t group) {
    return (struct system *)(void *)(memory->system + group * SYSTEM_SIZE);
}

/* nothing depends on time: legs are not disturbed, and the wrench is set for each call */
static inline void plants_provide(struct system *r, real t) { (void)r, (void)t; }

static inline void plants_build(struct system *r, const fleet_parts *parts,
                                const gough_machine *const machine[NUMBER_WIDTH]) {
    system_lane lane[NUMBER_WIDTH];

    for (int i = 0; i < NUMBER_WIDTH; i++)
        lane[i] = (system_lane){machine[i], &parts->control, &parts->disturbance, 0, 0};
    system_begin(r, &parts->motion, &parts->options, lane);
    r->provide = plants_provide;
    for (int v = 0; v < LEGS; v++) r->now.force[v] = r->now.shake[v] = number_of(0);
    r->now.push = r->now.turn = (vector){number_of(0), number_of(0), number_of(0)};
}

static inline void plants_share(void *alike, const fleet_parts *parts,
                                const gough_machine *machine) {
    const gough_machine *all[NUMBER_WIDTH];

    for (int i = 0; i < NUMBER_WIDTH; i++) all[i] = machine;
    plants_build(alike, parts, all);
}

/* the legs of a state, with their rates, and the forces of the drives: what limits of lengths, rates and forces need */
static inline void plants_legs(const moved *g, signals *m) {
    const number *y = g->p->y;

    m->x = coordinates_load(y);
    m->rate = coordinates_load(y + COORDINATES);
    legs_at(&g->r->h, &m->x, &m->g);
    legs_rates(&g->r->h, &m->rate, &m->g);
    signals_forces(g->r, &g->r->now, &m->g, y, &m->loop, m->force);
}

/* a lane of a group into a state */
static inline void plants_set(const moved *g, int lane, const gough_state *state) {
    plants *p = g->p;
    const hexapod *h = &g->r->h;
    number y[STATE_SIZE];
    signals m;
    const double(*q)[3] = state->rotation;
    const double column[3][3] = {
        {q[0][0], q[1][0], q[2][0]}, {q[0][1], q[1][1], q[2][1]}, {q[0][2], q[1][2], q[2][2]}};
    const triad R = {vector_of(column[0]), vector_of(column[1]), vector_of(column[2])};
    const vector origin = {number_of(0), number_of(0), number_of(0)};
    coordinates x = coordinates_of_top(h, origin, vector_of(state->position), &R);
    coordinates v =
        rates_of_top(h, &x, vector_of(state->velocity), vector_of(state->angular_velocity));

    (void)coordinates_project(&x, &v);
    coordinates_store(&x, y);
    coordinates_store(&v, y + COORDINATES);
    for (int i = 0; i < MOTION; i++) number_put(&p->y[i], lane, number_lane(y[i], lane));
    for (int i = MOTION; i < g->r->states; i++) number_put(&p->y[i], lane, 0);
    p->ended[lane] = GOUGH_FLEET_MOVES;
    p->fresh[lane] = 1;
    number_put(&p->moving, lane, 1);
    plants_legs(g, &m);
    const number side = limits_pose(g->r, &m).determinant;
    number_put(&p->side, lane, number_lane(side, lane) < 0 ? -1 : 1);
}

static inline void plants_put(const fleet_memory *memory, size_t group, const fleet_parts *parts,
                              int lane, const gough_machine *machine, const gough_state *state) {
    plants *p = plants_at(memory, group);
    struct system *own = plants_system(memory, group), local;

    if (machine) {
        const gough_machine *all[NUMBER_WIDTH];
        const struct system *r = p->own ? own : (const struct system *)(const void *)memory->alike;
        for (int i = 0; i < NUMBER_WIDTH; i++) all[i] = i == lane ? machine : r->lane[i].machine;
        plants_build(own, parts, all);
        p->own = 1;
    }
    if (!p->own) memcpy(&local, memory->alike, sizeof local);
    const moved g = {p, p->own ? own : &local};
    plants_set(&g, lane, state);
}

static inline void plants_begin(const fleet_memory *memory, size_t group, const fleet_parts *parts,
                                const gough_machine *const *machine, int count, int own) {
    plants *p = plants_at(memory, group);
    const gough_machine *all[NUMBER_WIDTH];

    for (int i = 0; i < NUMBER_WIDTH; i++) all[i] = machine[i < count ? i : count - 1];
    p->count = count;
    p->own = own;
    if (own) plants_build(plants_system(memory, group), parts, all);
    for (int i = 0; i < STATE_SIZE; i++) p->y[i] = number_of(0);
    for (int i = 0; i < NUMBER_WIDTH; i++) {
        const gough_state home = gough_state_home(all[i]);
        plants_put(memory, group, parts, i, NULL, &home);
    }
}

/* commands and wrenches of the lanes, from this call on */
static inline void plants_take(const moved *g, const fleet_call *call, size_t first) {
    plants *p = g->p;
    struct system *r = g->r;
    number wrench[6];

    for (int v = 0; v < LEGS; v++) {
        number asked = number_of(0);
        wrench[v] = number_of(0);
        for (int i = 0; i < NUMBER_WIDTH; i++) {
            const size_t plant = first + (size_t)(i < p->count ? i : p->count - 1);
            number_put(&asked, i, call->command[LEGS * plant + (size_t)v]);
            if (call->wrench) number_put(&wrench[v], i, call->wrench[6 * plant + (size_t)v]);
        }
        r->held[v] = drive_takes(&r->drives[v], asked);
        r->unmet[v] = asked - r->held[v];
        for (int i = 0; i < NUMBER_WIDTH && r->drive.count > 0; i++)
            if (p->fresh[i]) number_put(&p->y[r->drive.at + v], i, number_lane(r->held[v], i));
    }
    for (int i = 0; i < NUMBER_WIDTH; i++) p->fresh[i] = 0;
    r->loaded = call->wrench != NULL;
    r->now.push = vector_load(wrench);
    r->now.turn = vector_load(wrench + 3);
    r->valid = 0;
}

/* lanes where something is not as it must be end, each for a reason */
static inline void plants_end(plants *p, number fine, gough_fleet_state why) {
    for (int i = 0; i < NUMBER_WIDTH; i++) {
        if (number_lane(fine, i) > 0 || p->ended[i] != GOUGH_FLEET_MOVES) continue;
        p->ended[i] = (int)why;
        number_put(&p->moving, i, 0);
    }
}

/* one step of all lanes from rates at its beginning; those of its end are filled if `more` steps follow */
static inline void plants_step(const moved *g, const march *step, dop853 *work,
                               number rate[STATE_SIZE], int more, signals *m) {
    plants *p = g->p;
    struct system *r = g->r;
    const march_problem problem = system_problem(r);
    const number zero = number_of(0), one = number_of(1);
    const mask moving = number_greater(p->moving, number_of(0.5));
    number raw[STATE_SIZE], sum = zero;
    rattle_state unused;

    (void)march_step(step, &problem, work, &unused, p->y, rate, raw);
    coordinates x = coordinates_load(raw), v = coordinates_load(raw + COORDINATES);
    (void)coordinates_project(&x, &v);
    coordinates_store(&x, raw);
    coordinates_store(&v, raw + COORDINATES);
    for (int i = 0; i < r->states; i++) {
        sum = sum + number_magnitude(raw[i]);
        p->y[i] = number_select(moving, raw[i], p->y[i]);
    }
    if (more || r->limits.kinds >> LIMIT_ACCELERATION) {
        system_signals(r, step->t1, p->y, m);
        signals_rates(r, m, rate);
    } else {
        plants_legs(g, m);
    }
    plants_end(p, number_select(number_greater(number_of(1e300), sum), one, zero),
               GOUGH_FLEET_NOT_FINITE);
    plants_end(p, number_select(number_greater(zero, limits_least(r, m)), zero, one),
               GOUGH_FLEET_LIMIT);
}

/* a lane's numbers to their places */
static inline void plants_show_lane(const plants *p, const fleet_call *call, size_t plant, int lane,
                                    const number shown[18], const legs *g) {
    if (call->ended) call->ended[plant] = (unsigned char)p->ended[lane];
    for (int v = 0; call->length && v < LEGS; v++)
        call->length[LEGS * plant + (size_t)v] = number_lane(g->length[v], lane);
    for (int v = 0; call->rate && v < LEGS; v++)
        call->rate[LEGS * plant + (size_t)v] = number_lane(g->rate[v], lane);
    if (!call->state) return;
    gough_state *s = &call->state[plant];
    for (int c = 0; c < 3; c++) {
        s->position[c] = number_lane(shown[c], lane);
        s->velocity[c] = number_lane(shown[12 + c], lane);
        s->angular_velocity[c] = number_lane(shown[15 + c], lane);
        for (int k = 0; k < 3; k++) s->rotation[k][c] = number_lane(shown[3 + 3 * c + k], lane);
    }
}

static inline void plants_show(const moved *g, const fleet_call *call, size_t first,
                               const signals *m) {
    const hexapod *h = &g->r->h;
    number shown[18];
    vector point;
    triad R, ignored;

    top_of_coordinates(h, &m->x, &point, &R);
    vector_store(point, shown);
    vector_store(R.i, shown + 3);
    vector_store(R.j, shown + 6);
    vector_store(R.k, shown + 9);
    top_of_coordinates(h, &m->rate, &point, &ignored);
    vector_store(point, shown + 12);
    vector_store(triad_angular_velocity(&m->x.q, &m->rate.q), shown + 15);
    for (int i = 0; i < g->p->count; i++)
        plants_show_lane(g->p, call, first + (size_t)i, i, shown, &m->g);
}

static inline void plants_go(const moved *g, const march *step, const fleet_call *call,
                             size_t first) {
    plants *p = g->p;
    const number zero = number_of(0), one = number_of(1);
    number rate[STATE_SIZE];
    dop853 work;
    signals m;

    plants_take(g, call, first);
    system_rates(g->r, 0, p->y, rate);
    for (long long k = 0; k < call->steps; k++)
        plants_step(g, step, &work, rate, k + 1 < call->steps, &m);

    const elimination e = limits_pose(g->r, &m);
    number fine = number_select(number_greater(p->side * e.determinant, zero), one, zero);
    fine = number_select(number_greater(e.pivot_ratio, number_of(suspicious_pivots)), fine, zero);
    plants_end(p, fine, GOUGH_FLEET_SINGULAR);
    plants_show(g, call, first, &m);
}

static inline void plants_move(const fleet_memory *memory, const fleet_parts *parts,
                               const fleet_call *call, size_t first, size_t last) {
    const double h = parts->options.step;
    const march step = {.method = parts->options.method == GOUGH_RK4 ? MARCH_RK4 : MARCH_DOP853,
                        .t0 = 0,
                        .h = h,
                        .t1 = h};
    struct system alike; /* commands change it, in each thread by itself */

    memcpy(&alike, memory->alike, sizeof alike);
    for (size_t group = first; group < last; group++) {
        plants *p = plants_at(memory, group);
        const moved g = {p, p->own ? plants_system(memory, group) : &alike};
        plants_go(&g, &step, call, group * NUMBER_WIDTH);
    }
}

#define FLEET_WIDTH                                                                                \
    { NUMBER_WIDTH, PLANTS_SIZE, SYSTEM_SIZE, plants_share, plants_begin, plants_put, plants_move }

#endif
