/* A model and how to run it as one array of doubles, and back: what is handed to a program that shares no memory layout
 * with this one, such as the page's core.
 *
 * The array is what exchange_all() visits, in its order: one text writes it and reads it. What follows from a field is not
 * in it (the machine's constants, the spline of recorded motion, which operands of a formula are constant) and is found
 * anew by the functions that found it first, so that it has the same bits. */
#define NUMBER_DOUBLE
#include <math.h>
#include <string.h>

#include "gough/simulate.h"
#include "model/program.h"

enum {
    FORMAT = 2,
    HEAD = 4, /* format, doubles in all, moves, rows of recorded motion */
    /* least that a move and a row take: their counts cannot exceed the array's */
    MOVE = 2 + 2 * GOUGH_COMPONENTS,
    ROW = 1 + GOUGH_COMPONENTS
};

/* One pass over the array: reading where `from` is set, else writing, else (neither set) counting. */
typedef struct {
    const double *from;
    double *to;
    size_t at, count;
    gough_status status;
    gough_error *error;
} pass;

/* Moves and rows of recorded motion, and the memory of those read. */
typedef struct {
    size_t moves, rows;
    gough_move *move;
    double *curvature;
} extent;

/* the number just read is not what it should be */
static void refuse(pass *p, const char *wanted) {
    if (p->status != GOUGH_OK) return;
    p->status = gough_fail(p->error, GOUGH_ERROR_INPUT,
                           "the flat model is damaged: its number %zu must be %s, not %.17g", p->at,
                           wanted, p->from[p->at - 1]);
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

static void exchange_numbers(pass *p, double *x, int count) {
    for (int i = 0; i < count; i++) {
        const double taken = exchange(p, x[i]);
        if (p->from == NULL) continue;
        if (!isfinite(taken)) refuse(p, "finite");
        x[i] = taken;
    }
}

/* INFINITY stands for no limit */
static void exchange_limit(pass *p, double *x) {
    const double taken = exchange(p, *x);
    if (p->from == NULL) return;
    if (isnan(taken)) refuse(p, "a limit");
    *x = taken;
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

static void exchange_flags(pass *p, bool *x, int count) {
    for (int i = 0; i < count; i++) {
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
        exchange_numbers(p, &f->operation[i].value, 1);
    }
    if (p->from == NULL || p->status != GOUGH_OK || complete_formula(f)) return;
    p->status = gough_fail(p->error, GOUGH_ERROR_INPUT,
                           "the flat model is damaged: the operations before its number %zu make "
                           "no formula",
                           p->at + 1);
}

static void exchange_formulas(pass *p, gough_formula *f, int count) {
    for (int i = 0; i < count; i++) exchange_formula(p, &f[i]);
}

/* ---- the parts of a model ---- */

static void exchange_machine(pass *p, gough_machine *m) {
    gough_platform platform = m->platform;
    gough_load load = m->load;
    double gravity[3] = {m->gravity[0], m->gravity[1], m->gravity[2]};

    exchange_numbers(p, platform.base[0], GOUGH_LEGS * 3);
    exchange_numbers(p, platform.top[0], GOUGH_LEGS * 3);
    exchange_numbers(p, &platform.height, 1);
    exchange_numbers(p, &platform.base_radius, 1);
    exchange_limit(p, &platform.length_min);
    exchange_limit(p, &platform.length_max);
    exchange_limit(p, &platform.speed_max);
    exchange_limit(p, &platform.force_max);
    exchange_numbers(p, &load.mass, 1);
    exchange_numbers(p, load.center_of_mass, 3);
    exchange_numbers(p, load.inertia[0], 9);
    exchange_numbers(p, gravity, 3);
    if (p->from && p->status == GOUGH_OK) {
        p->status = gough_machine_init(m, &platform, &load, gravity, p->error);
    }
}

/* those read go into `moves`, one after the other in time */
static void exchange_moves(pass *p, gough_motion *motion, size_t count, gough_move *moves) {
    double before = -INFINITY;

    for (size_t i = 0; i < count && p->status == GOUGH_OK; i++) {
        gough_move move = {.start = 0};
        if (p->from == NULL) move = motion->move[i];
        exchange_numbers(p, &move.start, 1);
        if (p->from && move.start < before) refuse(p, "no earlier than the end of the move before");
        exchange_numbers(p, &move.duration, 1);
        if (p->from && !(move.duration > 0)) refuse(p, "a duration > 0");
        exchange_numbers(p, move.target, GOUGH_COMPONENTS);
        exchange_flags(p, move.given, GOUGH_COMPONENTS);
        before = move.start + move.duration;
        if (p->from) moves[i] = move;
    }
    if (p->from) motion->move = moves, motion->moves = count;
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
    *samples = (gough_samples){rows, p->from + p->at, p->from + p->at + rows, curvature};
    p->at += rows + values;
    p->status = gough_samples_prepare(samples, curvature + values, p->error);
}

static void exchange_motion(pass *p, gough_motion *m, const extent *e) {
    const int kind = exchange_choice(p, (int)m->kind, GOUGH_MOTION_SAMPLES + 1);

    if (p->from) {
        m->kind = (gough_motion_kind)kind;
        if ((e->moves > 0 && kind != GOUGH_MOTION_MOVES) ||
            (e->rows > 0) != (kind == GOUGH_MOTION_SAMPLES)) {
            refuse(p, "the kind of motion that has the moves or rows of the head");
        }
    }
    exchange_numbers(p, m->about, 3);
    exchange_numbers(p, &m->angle_unit, 1);
    exchange_numbers(p, &m->period, 1);
    exchange_flags(p, &m->scaled, 1);
    exchange_numbers(p, &m->amplitude, 1);
    exchange_numbers(p, &m->frequency, 1);
    if (p->from && m->scaled && !(m->frequency > 0)) refuse(p, "a factor > 0");
    exchange_formulas(p, m->formula, GOUGH_COMPONENTS);
    exchange_moves(p, m, e->moves, e->move);
    exchange_samples(p, &m->samples, e->rows, e->curvature);
}

static void exchange_noise(pass *p, gough_noise *n, double duration) {
    exchange_numbers(p, &n->leg_force, 1);
    exchange_numbers(p, &n->force, 1);
    exchange_numbers(p, &n->moment, 1);
    exchange_numbers(p, &n->interval, 1);
    /* knots are counted; more than these are a mistake, and another million runs of them end below 2^63 */
    if (p->from && (n->leg_force > 0 || n->force > 0 || n->moment > 0) &&
        !(n->interval > 0 && duration / n->interval < 0x1p40)) {
        refuse(p, "an interval > 0 and no tiny part of the run");
    }
    exchange_bits(p, &n->seed);
    exchange_bits(p, &n->run);
}

static void exchange_disturbance(pass *p, gough_disturbance *d, double duration) {
    exchange_formulas(p, d->leg_force, GOUGH_LEGS);
    exchange_formula(p, &d->vertical_force);
    exchange_formulas(p, d->force, 3);
    exchange_formulas(p, d->moment, 3);
    exchange_noise(p, &d->noise, duration);
}

static void exchange_control(pass *p, gough_control *c) {
    exchange_flags(p, &c->feedforward, 1);
    exchange_numbers(p, c->stiffness, GOUGH_LEGS);
    exchange_numbers(p, c->damping, GOUGH_LEGS);
}

static void exchange_initial(pass *p, gough_initial *i) {
    exchange_numbers(p, i->component, GOUGH_COMPONENTS);
    exchange_flags(p, i->given, GOUGH_COMPONENTS);
    exchange_numbers(p, i->velocity, 3);
    exchange_numbers(p, i->angular_velocity, 3);
    exchange_flags(p, &i->velocity_given, 1);
    exchange_flags(p, &i->angular_velocity_given, 1);
}

static void exchange_simulation(pass *p, gough_simulation *s) {
    exchange_numbers(p, &s->duration, 1);
    exchange_numbers(p, &s->output_step, 1);
    const int method = exchange_choice(p, (int)s->method, GOUGH_METHODS);
    exchange_numbers(p, &s->step, 1);
    exchange_numbers(p, &s->max_step, 1);
    exchange_numbers(p, &s->tolerance, 1);
    const int constraints = exchange_choice(p, (int)s->constraints, GOUGH_BAUMGARTE + 1);
    exchange_numbers(p, s->baumgarte, 2);
    const int precision = exchange_choice(p, (int)s->precision, GOUGH_QUADRUPLE + 1);
    exchange_flags(p, &s->reactions, 1);
    if (p->from == NULL) return;
    s->method = (gough_method)method;
    s->constraints = (gough_constraints)constraints;
    s->precision = (gough_precision)precision;
}

/* Everything, after the head. Where the pass does not read, it changes nothing. */
static void exchange_all(pass *p, gough_model *model, gough_simulation *simulation,
                         const extent *e) {
    exchange_simulation(p, simulation);
    exchange_machine(p, &model->machine);
    exchange_motion(p, &model->motion, e);
    exchange_control(p, &model->control);
    exchange_disturbance(p, &model->disturbance, simulation->duration);
    exchange_initial(p, &model->initial);
}

/* ---- the public face ---- */

/* only the moves or rows of the motion's own kind travel */
static extent extent_of(const gough_motion *motion) {
    extent e = {0, 0, NULL, NULL};

    if (motion->kind == GOUGH_MOTION_MOVES) e.moves = motion->moves;
    if (motion->kind == GOUGH_MOTION_SAMPLES) e.rows = motion->samples.count;
    return e;
}

size_t gough_model_flat_size(const gough_model *model) {
    const extent e = extent_of(&model->motion);
    const gough_simulation any = gough_simulation_default();
    pass p = {.at = HEAD, .status = GOUGH_OK};

    exchange_all(&p, (gough_model *)model, (gough_simulation *)&any, &e);
    return p.at;
}

void gough_model_flatten(const gough_model *model, const gough_simulation *simulation,
                         double *flat) {
    const extent e = extent_of(&model->motion);
    pass p = {.to = flat, .at = HEAD, .status = GOUGH_OK};

    exchange_all(&p, (gough_model *)model, (gough_simulation *)simulation, &e);
    flat[0] = FORMAT;
    flat[1] = (double)p.at;
    flat[2] = (double)e.moves;
    flat[3] = (double)e.rows;
}

/* the head of an array to be read */
static gough_status read_head(const double *flat, size_t count, extent *e, gough_error *error) {
    pass p = {.from = flat, .count = count, .status = GOUGH_OK, .error = error};
    const double format = exchange(&p, 0), all = exchange(&p, 0);

    if (p.status == GOUGH_OK && !(format >= FORMAT && format <= FORMAT)) {
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "the flat model has the format %.9g; this program reads format %d",
                          format, FORMAT);
    }
    if (p.status == GOUGH_OK && !(all >= (double)count && all <= (double)count)) {
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "the flat model is damaged: it has %zu numbers and claims %.9g", count,
                          all);
    }
    e->moves = (size_t)exchange_whole(&p, 0, floor((double)count / MOVE));
    e->rows = (size_t)exchange_whole(&p, 0, floor((double)count / ROW));
    return p.status;
}

size_t gough_model_flat_memory(const double *flat, size_t count) {
    extent e = {0, 0, NULL, NULL};

    if (read_head(flat, count, &e, NULL) != GOUGH_OK) return 0;
    return e.moves * sizeof(gough_move) +
           (e.rows * GOUGH_COMPONENTS + gough_samples_scratch(e.rows)) * sizeof(double);
}

gough_status gough_model_unflatten(gough_model *model, gough_simulation *simulation, void *memory,
                                   const double *flat, size_t count, gough_error *error) {
    pass p = {.from = flat, .at = HEAD, .count = count, .error = error};
    extent e = {0, 0, NULL, NULL};

    memset(model, 0, sizeof *model);
    *simulation = gough_simulation_default();
    p.status = read_head(flat, count, &e, error);
    if (p.status != GOUGH_OK) return p.status;
    /* one of the two is missing, or the array is refused */
    e.move = memory;
    e.curvature = memory;
    exchange_all(&p, model, simulation, &e);
    if (p.status == GOUGH_OK && p.at != count) {
        p.status =
            gough_fail(error, GOUGH_ERROR_INPUT,
                       "the flat model is damaged: it continues after its %zu numbers", p.at);
    }
    if (p.status == GOUGH_OK) p.status = gough_simulation_check(model, simulation, error);
    return p.status;
}
