/* A model and how to run it as one array of doubles, and back: what is handed to a program that shares no memory layout
 * with this one, such as the page's core.
 *
 * The array is what exchange_all() visits: the places of the table of fields in its order, then moves or recorded motion. One
 * text writes it and reads it. What follows from a field is not in it (the machine's constants, the spline of recorded motion,
 * which operands of a formula are constant); it is found anew by the functions that found it first, with the same bits. */
#define NUMBER_DOUBLE
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "gough/simulate.h"
#include "model/places.h"
#include "program/program.h"

enum {
    FORMAT = 4, /* changes if the same fields are written in another way */
    HEAD = 5,   /* format, doubles in all, moves, rows of recorded motion, external loads */
    ROW = 1 + GOUGH_COMPONENTS
};

/* The format of the array's head: FORMAT and the table's places, FNV-1a in 32 bits. With another field it is another number. */
static double format_number(void) {
    size_t count;
    const gough_place *place = gough_places(&count);
    uint32_t sum = 2166136261u ^ FORMAT;

    for (size_t i = 0; i < count; i++) {
        const unsigned part[3] = {place[i].owner, place[i].kind, (unsigned)place[i].count};
        for (int k = 0; k < 3; k++) sum = (sum ^ part[k]) * 16777619u;
    }
    return sum;
}

/* One pass over the array: reading where `from` is set, else writing, else (neither set) counting. */
typedef struct {
    const double *from;
    double *to;
    size_t at, count;
    gough_status status;
    gough_error *error;
} pass;

/* Moves, rows of recorded motion and external loads, and the memory of those read. */
typedef struct {
    size_t moves, rows, loads;
    gough_move *move;
    double *curvature;
    gough_external *load;
} extent;

/* the number just read is not what it should be */
static void refuse(pass *p, const char *wanted) {
    if (p->status != GOUGH_OK) return;
    p->status = gough_fail(p->error, GOUGH_ERROR_INPUT,
                           "the flat model is damaged: its number %zu must be %s, not %.17g", p->at,
                           wanted, p->from[p->at - 1]);
}

/* fields that have been read do not go together */
static void deny(pass *p, const char *sentence) {
    if (p->status != GOUGH_OK) return;
    p->status = gough_fail(p->error, GOUGH_ERROR_INPUT, "the flat model is damaged: %s", sentence);
}

/* any number at all; after a failure nothing is read any more and 0 stands for it */
static double exchange(pass *p, double x) {
    if (p->from == NULL) {
        if (p->to) p->to[p->at] = x;
        p->at++;
        return x;
    }
    if (p->status != GOUGH_OK) return 0;
    if (p->at == p->count) {
        p->status = gough_fail(p->error, GOUGH_ERROR_INPUT,
                               "the flat model is damaged: it ends after %zu numbers", p->count);
        return 0;
    }
    return p->from[p->at++];
}

/* finite numbers; INFINITY stands for no limit if that is the default */
static void exchange_numbers(pass *p, double *x, const gough_place *place) {
    for (size_t i = 0; i < place->count; i++) {
        const double taken = exchange(p, x[i]);
        const bool limit = isinf(place->usual[i > 0]);
        if (p->from == NULL) continue;
        if (isnan(taken) || (isinf(taken) && !limit)) refuse(p, limit ? "a limit" : "finite");
        x[i] = taken;
    }
}

/* a whole number from 0 to `most`, below 2^53 */
static double exchange_whole(pass *p, double x, double most) {
    x = exchange(p, x);
    if (p->from == NULL || (x >= 0 && x <= most && !(floor(x) < x))) return x;
    refuse(p, "a whole number in its range");
    return 0;
}

static int exchange_choice(pass *p, int x, int count) {
    return (int)exchange_whole(p, x, count - 1);
}

static void exchange_flags(pass *p, bool *x, size_t count) {
    for (size_t i = 0; i < count; i++) {
        const double taken = exchange_whole(p, x[i] ? 1 : 0, 1);
        if (p->from) x[i] = taken > 0;
    }
}

/* 64 bits as two halves, which doubles hold exactly */
static void exchange_bits(pass *p, uint64_t *x) {
    const double high = exchange_whole(p, (double)(*x >> 32), 0x1p32 - 1);
    const double low = exchange_whole(p, (double)(*x & 0xffffffffu), 0x1p32 - 1);

    if (p->from) *x = (uint64_t)high << 32 | (uint64_t)low;
}

/* ---- formulas ---- */

/* Whether the operations leave one value on a stack that they keep within its bounds; says of each which operands do not
 * depend on t, as the compiler does. */
static bool complete_formula(gough_formula *f) {
    bool constant[GOUGH_FORMULA_DEPTH];
    int top = 0;

    for (int i = 0; i < f->count; i++) {
        const int code = f->operation[i].code;
        int *flags = &f->operation[i].constant;

        *flags = 0;
        if (code < FORMULA_NEGATE) {
            if (top == GOUGH_FORMULA_DEPTH) return false;
            constant[top++] = code != FORMULA_TIME;
        } else if (code < FORMULA_ADD) {
            if (top < 1) return false;
            *flags = constant[top - 1] ? FORMULA_FIRST_CONSTANT : 0;
        } else {
            if (top < 2) return false;
            *flags = (constant[top - 2] ? FORMULA_FIRST_CONSTANT : 0) |
                     (constant[top - 1] ? FORMULA_SECOND_CONSTANT : 0);
            constant[top - 2] = constant[top - 2] && constant[top - 1];
            top--;
        }
    }
    return top == 1 || f->count == 0;
}

static void exchange_formula(pass *p, gough_formula *f) {
    const int count = exchange_choice(p, f->count, GOUGH_FORMULA_OPERATIONS + 1);

    if (p->from) f->count = count;
    for (int i = 0; i < count; i++) {
        const int code = exchange_choice(p, f->operation[i].code, FORMULA_RAMP + 1);
        if (p->from) f->operation[i].code = code;
        const double value = exchange(p, f->operation[i].value);
        if (p->from == NULL) continue;
        if (!isfinite(value)) refuse(p, "finite");
        f->operation[i].value = value;
    }
    if (p->from == NULL || p->status != GOUGH_OK || complete_formula(f)) return;
    p->status = gough_fail(p->error, GOUGH_ERROR_INPUT,
                           "the flat model is damaged: the operations before its number %zu make "
                           "no formula",
                           p->at + 1);
}

/* ---- the fields ---- */

static void exchange_place(pass *p, const gough_place *place, void *owner) {
    void *const value = (char *)owner + place->offset;

    switch (place->kind) {
    case GOUGH_KIND_NUMBER:
        exchange_numbers(p, value, place);
        break;
    case GOUGH_KIND_FORMULA:
        for (size_t i = 0; i < place->count; i++) exchange_formula(p, (gough_formula *)value + i);
        break;
    case GOUGH_KIND_FLAG:
        exchange_flags(p, value, place->count);
        break;
    case GOUGH_KIND_CHOICE: {
        const int taken = exchange_choice(p, *(int *)value, place->choices);
        if (p->from) *(int *)value = taken;
        break;
    }
    case GOUGH_KIND_WHOLE:
        exchange_bits(p, value);
        break;
    }
}

/* all fields of one struct, in the order of the table */
static void exchange_fields(pass *p, gough_owner owner, void *of) {
    size_t count;
    const gough_place *place = gough_places(&count);

    for (size_t i = 0; i < count; i++)
        if (place[i].owner == owner) exchange_place(p, &place[i], of);
}

/* doubles of one move; fields of moves have no formulas */
static size_t move_size(void) {
    gough_move move = {.start = 0};
    pass p = {.status = GOUGH_OK};

    exchange_fields(&p, GOUGH_OWNER_MOVE, &move);
    return p.at;
}

/* those read go into `moves`, one after the other in time */
static void exchange_moves(pass *p, gough_motion *motion, size_t count, gough_move *moves) {
    double before = -INFINITY;

    for (size_t i = 0; i < count && p->status == GOUGH_OK; i++) {
        gough_move move = {.start = 0};
        if (p->from == NULL) move = motion->move[i];
        exchange_fields(p, GOUGH_OWNER_MOVE, &move);
        if (p->from && move.start < before) deny(p, "moves must follow one another in time");
        if (p->from && !(move.duration > 0)) deny(p, "the duration of a move must be > 0");
        before = move.start + move.duration;
        if (p->from) moves[i] = move;
    }
    if (p->from) motion->move = moves, motion->moves = count;
}

static void exchange_loads(pass *p, gough_machine *machine, size_t count, gough_external *loads) {
    for (size_t i = 0; i < count && p->status == GOUGH_OK; i++) {
        gough_external written = {.at_given = false}, *load = p->from ? &loads[i] : &written;
        if (p->from)
            *load = written;
        else
            *load = machine->external[i];
        exchange_fields(p, GOUGH_OWNER_EXTERNAL, load);
    }
    if (p->from && p->status == GOUGH_OK)
        p->status = gough_machine_set_external(machine, loads, count, p->error);
}

/* Those read stay in the array; their spline is made in `curvature`, with scratch memory behind it. */
static void exchange_samples(pass *p, gough_samples *samples, size_t rows, double *curvature) {
    const size_t values = rows * GOUGH_COMPONENTS;

    if (rows == 0) return;
    if (p->from == NULL) {
        for (size_t i = 0; i < rows; i++) (void)exchange(p, samples->time[i]);
        for (size_t i = 0; i < values; i++) (void)exchange(p, samples->value[i]);
        return;
    }
    if (p->status != GOUGH_OK) return;
    if (p->count - p->at < rows + values) {
        p->status = gough_fail(p->error, GOUGH_ERROR_INPUT,
                               "the flat model is damaged: it ends within its recorded motion");
        return;
    }
    samples->count = rows;
    samples->time = p->from + p->at;
    samples->value = p->from + p->at + rows;
    samples->curvature = curvature;
    p->at += rows + values;
    p->status = gough_samples_prepare(samples, curvature + values, p->error);
}

/* Rules between fields that no other check of the library knows. */
static void check_fields(pass *p, const gough_model *model, double duration, const extent *e) {
    const gough_motion *m = &model->motion;
    const gough_noise *n = &model->disturbance.noise;

    if ((e->moves > 0 && m->kind != GOUGH_MOTION_MOVES) ||
        (e->rows > 0) != (m->kind == GOUGH_MOTION_SAMPLES)) {
        deny(p, "its motion must be of the kind that has the moves or rows of its head");
    }
    if (m->scaled && !(m->frequency > 0)) deny(p, "the frequency of its motion must be > 0");
    /* knots are counted; more than these are a mistake, and another million runs of them end below 2^63 */
    if ((n->leg_force > 0 || n->force > 0 || n->moment > 0) &&
        !(n->interval > 0 && duration / n->interval < 0x1p40)) {
        deny(p, "the interval of its noise must be > 0 and not a tiny part of the run");
    }
}

static void complete_machine(pass *p, gough_machine *machine) {
    const gough_machine read = *machine;

    if (p->status != GOUGH_OK) return;
    p->status = gough_machine_init(machine, &read.platform, &read.load, read.gravity, p->error);
}

/* Everything, after the head. Where the pass does not read, it changes nothing. */
static void exchange_all(pass *p, gough_model *model, gough_simulation *simulation,
                         const extent *e) {
    exchange_fields(p, GOUGH_OWNER_MODEL, model);
    exchange_fields(p, GOUGH_OWNER_SIMULATION, simulation);
    if (p->from) {
        check_fields(p, model, simulation->duration, e);
        complete_machine(p, &model->machine);
    }
    exchange_loads(p, &model->machine, e->loads, e->load);
    exchange_moves(p, &model->motion, e->moves, e->move);
    exchange_samples(p, &model->motion.samples, e->rows, e->curvature);
}

/* ---- the public face ---- */

/* only the moves or rows of the motion's own kind travel */
static extent extent_of(const gough_model *model) {
    const gough_motion *motion = &model->motion;
    extent e = {.loads = model->machine.externals};

    if (motion->kind == GOUGH_MOTION_MOVES) e.moves = motion->moves;
    if (motion->kind == GOUGH_MOTION_SAMPLES) e.rows = motion->samples.count;
    return e;
}

size_t gough_model_flat_size(const gough_model *model) {
    const extent e = extent_of(model);
    const gough_simulation any = gough_simulation_default();
    pass p = {.at = HEAD, .status = GOUGH_OK};

    exchange_all(&p, (gough_model *)model, (gough_simulation *)&any, &e);
    return p.at;
}

void gough_model_flatten(const gough_model *model, const gough_simulation *simulation,
                         double *flat) {
    const extent e = extent_of(model);
    pass p = {.to = flat, .at = HEAD, .status = GOUGH_OK};

    exchange_all(&p, (gough_model *)model, (gough_simulation *)simulation, &e);
    flat[0] = format_number();
    flat[1] = (double)p.at;
    flat[2] = (double)e.moves;
    flat[3] = (double)e.rows;
    flat[4] = (double)e.loads;
}

/* the head of an array to be read */
static gough_status read_head(const double *flat, size_t count, extent *e, gough_error *error) {
    pass p = {.from = flat, .count = count, .status = GOUGH_OK, .error = error};
    const double known = format_number();
    const double format = exchange(&p, 0), all = exchange(&p, 0);

    if (p.status == GOUGH_OK && !(format >= known && format <= known)) {
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "the flat model has the format %.10g; this program reads format %.10g",
                          format, known);
    }
    if (p.status == GOUGH_OK && !(all >= (double)count && all <= (double)count)) {
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "the flat model is damaged: it has %zu numbers and claims %.9g", count,
                          all);
    }
    e->moves = (size_t)exchange_whole(&p, 0, floor((double)count / (double)move_size()));
    e->rows = (size_t)exchange_whole(&p, 0, floor((double)count / ROW));
    e->loads = (size_t)exchange_whole(&p, 0, GOUGH_EXTERNALS);
    return p.status;
}

size_t gough_model_flat_memory(const double *flat, size_t count) {
    extent e = {.loads = 0};

    if (read_head(flat, count, &e, NULL) != GOUGH_OK) return 0;
    return e.loads * sizeof(gough_external) + e.moves * sizeof(gough_move) +
           (e.rows * GOUGH_COMPONENTS + gough_samples_scratch(e.rows)) * sizeof(double);
}

gough_status gough_model_unflatten(gough_model *model, gough_simulation *simulation, void *memory,
                                   const double *flat, size_t count, gough_error *error) {
    pass p = {.from = flat, .at = HEAD, .count = count, .error = error};
    extent e = {.loads = 0};

    memset(model, 0, sizeof *model);
    *simulation = gough_simulation_default();
    p.status = read_head(flat, count, &e, error);
    if (p.status != GOUGH_OK) return p.status;
    /* after the loads; one of these two is missing, or the array is refused */
    e.load = memory;
    e.move = (gough_move *)(void *)(e.load + e.loads);
    e.curvature = (double *)(void *)(e.load + e.loads);
    exchange_all(&p, model, simulation, &e);
    assert_true(p.at <= count);
    if (p.status == GOUGH_OK && p.at != count) {
        p.status =
            gough_fail(error, GOUGH_ERROR_INPUT,
                       "the flat model is damaged: it continues after its %zu numbers", p.at);
    }
    if (p.status == GOUGH_OK) p.status = gough_simulation_check(model, simulation, error);
    return p.status;
}
