/* A fleet: checks, memory, and groups of plants distributed over threads. */
#include "gough/fleet.h"

#include <math.h>
#include <stdatomic.h>
#include <stdint.h>
#include <string.h>

#include "base/assert.h"
#include "base/crew.h"
#include "batch/fleet_lanes_table.h"
#include "gough/batch.h"
#include "plant/can_move.h"
#include "plant/rotation_valid.h"

/* the beginning of a fleet's memory; its groups follow */
typedef struct {
    fleet_parts parts;
    const struct fleet_width *width;
    const gough_machine *kind; /* of the first plant, which all others are like */
    size_t count, groups;
} fleet;

enum { ALIGNMENT = 64 };
static size_t rounded(size_t bytes) { return (bytes + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT; }

static const struct fleet_width *fleet_width(void) {
    switch (gough_batch_lanes()) {
#if defined(__x86_64__)
    case 8:
        return &fleet_width_8;
    case 4:
        return &fleet_width_4;
#endif
    case 2:
        return &fleet_width_2;
    default:
        return &fleet_width_1;
    }
}

/* the shared system, states, systems of their own */
static fleet_memory fleet_places(fleet *f) {
    char *alike = (char *)f + rounded(sizeof *f), *group = alike + f->width->system_size;

    return (fleet_memory){group, group + f->groups * f->width->group_size, alike};
}

size_t gough_fleet_size(size_t count) {
    const struct fleet_width *width = fleet_width();
    const size_t lanes = (size_t)width->lanes;

    return rounded(sizeof(fleet)) + width->system_size +
           (count + lanes - 1) / lanes * (width->group_size + width->system_size);
}

/* ---- checks ---- */

/* whether two machines may stand in lanes of one group: what chooses equations is the same */
static int machines_alike(const gough_machine *a, const gough_machine *b) {
    const gough_actuators *one = &a->platform.actuators, *two = &b->platform.actuators;

    if (a->platform.height < b->platform.height || a->platform.height > b->platform.height)
        return 0;
    for (int v = 0; v < GOUGH_LEGS; v++) {
        if ((one->time_constant[v] > 0) != (two->time_constant[v] > 0)) return 0;
    }
    return a->platform.legs_have_mass == b->platform.legs_have_mass && one->kind == two->kind;
}

static gough_status check_machine(const gough_machine *machine, const gough_machine *kind,
                                  size_t plant, gough_error *error) {
    if (machine->externals > 0)
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "the machine of plant %zu has external loads, which depend on time; a "
                          "fleet takes machines without them, and a wrench for each call",
                          plant);
    if (!machines_alike(machine, kind))
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "the machine of plant %zu differs from that of plant 0 in its height at "
                          "home, in whether its legs have mass, or in the kind of its drives; all "
                          "plants of a fleet must be alike in these",
                          plant);
    return machine_can_move(machine, error);
}

static gough_status check_steps(const gough_simulation *s, gough_error *error) {
    if (!(s->step > 0 && s->step < INFINITY))
        return gough_fail_key(error, GOUGH_ERROR_INPUT, "simulation.step",
                              "simulation.step must be > 0: a fleet moves in fixed steps");
    if (s->method == GOUGH_RK4 || s->method == GOUGH_DOP853) return GOUGH_OK;
    return gough_fail_key(error, GOUGH_ERROR_INPUT, "simulation.method",
                          "simulation.method must be rk4 or dop853: a fleet moves by these");
}

/* ---- its life ---- */

/* whether a machine is the one that groups share, by address or by content */
static int is_shared(const fleet *f, const gough_machine *machine) {
    return machine == f->kind || memcmp(machine, f->kind, sizeof *machine) == 0;
}

static void begin_groups(fleet *f, const gough_machine *const *machine) {
    const size_t lanes = (size_t)f->width->lanes;
    const fleet_memory memory = fleet_places(f);

    if (f->groups == 0) return;
    f->width->share((char *)f + rounded(sizeof *f), &f->parts, f->kind);
    for (size_t g = 0; g < f->groups; g++) {
        const size_t rest = f->count - g * lanes, count = rest < lanes ? rest : lanes;
        int own = 0;
        for (size_t i = 0; i < count; i++) own |= !is_shared(f, machine[g * lanes + i]);
        f->width->begin(&memory, g, &f->parts, machine + g * lanes, (int)count, own);
    }
}

gough_status gough_fleet_begin(void *memory, const gough_machine *const *machine, size_t count,
                               const gough_simulation *simulation, gough_error *error) {
    fleet *f = memory;

    assert_true((uintptr_t)memory % ALIGNMENT == 0);
    gough_status status = check_steps(simulation, error);
    for (size_t i = 0; i < count && status == GOUGH_OK; i++)
        status = check_machine(machine[i], machine[0], i, error);
    if (status != GOUGH_OK) return status;

    memset(f, 0, sizeof *f);
    f->parts.options = gough_simulation_default();
    f->parts.options.method = simulation->method;
    f->parts.options.step = simulation->step;
    f->parts.control.sampling.period = simulation->step; /* commands are held */
    f->width = fleet_width();
    f->count = count;
    f->kind = count > 0 ? machine[0] : NULL;
    f->groups = (count + (size_t)f->width->lanes - 1) / (size_t)f->width->lanes;
    begin_groups(f, machine);
    return GOUGH_OK;
}

gough_status gough_fleet_put(void *memory, size_t plant, const gough_machine *machine,
                             const gough_state *state, gough_error *error) {
    fleet *f = memory;
    const size_t lanes = (size_t)f->width->lanes;

    if (plant >= f->count)
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "there is no plant %zu: the fleet has %zu, counted from 0", plant,
                          f->count);
    if (!is_rotation(state->rotation))
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "the matrix of the state of plant %zu is not a rotation", plant);
    if (machine) {
        const gough_status status = check_machine(machine, f->kind, plant, error);
        if (status != GOUGH_OK) return status;
    }
    const fleet_memory places = fleet_places(f);
    f->width->put(&places, plant / lanes, &f->parts, (int)(plant % lanes), machine, state);
    return GOUGH_OK;
}

/* ---- moving ---- */

enum { GROUPS_AT_ONCE = 128 }; /* at most: each time a thread copies what groups share */

typedef struct {
    fleet *f;
    fleet_memory memory;
    const fleet_call *call;
    size_t chunk;       /* groups that a thread takes at once */
    atomic_size_t next; /* group that no thread has begun */
} moving;

typedef struct {
    moving *all;
} mover;

static void *move_groups(void *member) {
    moving *m = ((mover *)member)->all;
    const fleet *f = m->f;

    for (;;) {
        const size_t first = atomic_fetch_add(&m->next, m->chunk);
        if (first >= f->groups) return NULL;
        const size_t last = first + m->chunk < f->groups ? first + m->chunk : f->groups;
        f->width->move(&m->memory, &f->parts, m->call, first, last);
    }
}

gough_status gough_fleet_move(void *memory, long long steps, const double *command,
                              const double *wrench, int threads, gough_state *state, double *length,
                              double *rate, unsigned char *ended, gough_error *error) {
    fleet *f = memory;
    const fleet_call call = {steps, command, wrench, state, length, rate, ended};
    moving all = {.f = f, .memory = fleet_places(f), .call = &call};
    mover member[CREW_MOST];

    if (steps < 1)
        return gough_fail(error, GOUGH_ERROR_INPUT, "a fleet moves by 1 step or more, not by %lld",
                          steps);
    size_t movers = (size_t)crew_threads(threads);
    if (movers > f->groups) movers = f->groups > 0 ? f->groups : 1;
    const size_t share = f->groups / (movers > 1 ? 4 * movers : 1) + 1;
    all.chunk = share < GROUPS_AT_ONCE ? share : GROUPS_AT_ONCE;
    atomic_init(&all.next, 0);
    for (size_t i = 0; i < movers; i++) member[i].all = &all;
    crew_work(member, sizeof member[0], (int)movers, move_groups);
    return GOUGH_OK;
}
