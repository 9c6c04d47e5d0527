/* One sample of the run's own loop over complex numbers: the controller looks, commands act one after the other, drives and
 * platform move by dop853. An imaginary step in each number before comes out as its derivatives. Counts are taken for lengths;
 * where a drive cannot follow, its command stays. Theory: docs/theory/loop.md. */
#define NUMBER_COMPLEX
#include "floquet/sampled_flow.h"

#include <string.h>

#include "integrate/dop853.h"
#include "linear/displace.h"
#include "system/loop.h"

enum { MOST_PARTS = 4096 };

static const gough_disturbance undisturbed;

/* what the program wants at a time */
typedef struct {
    bool known;
    real time;
    wanted value;
} recalled;

/* the loop as the texts of a run know it */
typedef struct {
    gough_simulation options;
    gough_control control;
    struct system r;
    loop l;
    dop853 work;
    bool
        holds; /* commands are held, and nothing else depends on time: the program is not asked for */
    recalled
        look[2]; /* of the two times that the controller looks at, which all directions share */
    int next;
} passage;

/* the system's `provide` */
static void recall(struct system *r, real t) {
    passage *p = r->provider;

    if (p->holds) return;
    for (int i = 0; i < 2; i++) {
        if (!p->look[i].known || p->look[i].time < t || p->look[i].time > t) continue;
        r->now = p->look[i].value;
        return;
    }
    wanted_evaluate(r, t, &r->now);
    p->look[p->next] = (recalled){true, t, r->now};
    p->next = 1 - p->next;
}

static void begin(passage *p, const linear_loop *linear) {
    const system_lane lane = {
        .machine = linear->machine, .control = &p->control, .disturbance = &undisturbed};

    p->options = gough_simulation_default();
    p->options.constraints = GOUGH_NONE;
    p->control = *linear->control;
    p->control.sampling.noise = p->control.sampling.resolution = 0;
    system_begin(&p->r, linear->motion, &p->options, &lane);
    system_take_dry_friction_off(&p->r);
    p->holds = false;
    p->look[0].known = p->look[1].known = false;
    p->next = 0;
    p->r.provide = recall;
    p->r.provider = p;
    memset(&p->l, 0, sizeof p->l);
    sampler_put(&p->l.rule, 0, &p->control);
}

/* the state of a loop as complex numbers */
typedef struct {
    number y[STATE_SIZE], waiting[SAMPLED_WAITING][LEGS];
    sampler_memory memory;
} complex_state;

static void memory_load(const double from[SAMPLED_MEMORY], sampler_memory *m) {
    for (int v = 0; v < LEGS; v++) {
        m->error[v] = from[v];
        m->rate[v] = from[LEGS + v];
        m->integral[v] = from[2 * LEGS + v];
    }
}

static number *memory_at(sampler_memory *m, int place) {
    number *const part[3] = {m->error, m->rate, m->integral};

    return &part[place / LEGS][place % LEGS];
}

static void load(const passage *p, const sampled_layout *layout, const sampled_state *from,
                 complex_state *s) {
    for (int i = 0; i < p->r.states; i++) s->y[i] = from->y[i];
    memory_load(from->memory, &s->memory);
    for (int k = 0; k < layout->waiting; k++) {
        for (int v = 0; v < LEGS; v++) s->waiting[k][v] = from->waiting[k][v];
    }
}

/* a part of a period with one command, in as many equal steps as the tolerance asks for; *parts: how many they were last */
static void act(passage *p, const number command[LEGS], double t, double time, double tolerance,
                int *parts, number y[STATE_SIZE]) {
    const int n = p->r.states;
    const double length = p->r.lane[0].machine->base_radius;
    number now[STATE_SIZE], out[STATE_SIZE];
    real size[STATE_SIZE];

    for (int i = 0; i < n; i++) size[i] = i < COORDINATES ? length : 1;
    for (int v = 0; v < LEGS; v++) p->r.held[v] = command[v];
    p->holds = !(p->r.traits & EXTERNAL);
    p->r.valid = 0;
    for (;; *parts *= 2) {
        real error = 0;
        memcpy(now, y, (size_t)n * sizeof *now);
        for (int k = 0; k < *parts; k++) {
            const double h = time / *parts;
            system_rates(&p->r, t + k * h, now, p->work.slope[0]);
            dop853_step(&p->work, system_rates, &p->r, n, t + k * h, h, now, out);
            const real found = dop853_error(&p->work, n, h, now, out, size, tolerance);
            if (!(found <= error)) error = found;
            memcpy(now, out, (size_t)n * sizeof *now);
        }
        /* derivatives take the steps that the motion itself has taken */
        if (!(tolerance > 0) || error <= 1 || *parts >= MOST_PARTS) break;
    }
    memcpy(y, now, (size_t)n * sizeof *now);
    p->holds = false;
    p->r.valid = 0;
}

/* Whether a direction moves the platform or its drives before the next sample: not so the memory, where the command that depends on
 * it acts later, and commands that wait longer. */
static bool acts(const sampled_layout *layout, int direction) {
    const int memory = direction - GOUGH_LINEAR - layout->drive,
              waiting = direction - (layout->n - LEGS * layout->waiting);

    if (memory < 0) return true;
    if (waiting < 0) return layout->whole == 0;
    return waiting / LEGS == layout->whole || waiting / LEGS == layout->whole - 1;
}

/* A sample and the period after it; steps: of the two parts of the period. With an end of the period that is known only the
 * controller's own numbers change. */
static void pass(passage *p, const sampled_layout *layout, double t, double tolerance, int steps[2],
                 const complex_state *end, complex_state *s) {
    number(*command)[LEGS] = p->l.queue;
    legs g;

    loop_legs(&p->r, s->y, &g);
    p->l.memory = s->memory;
    p->l.fresh = 0;
    p->l.clock.sample = 0;
    loop_look(&p->r, &p->l, t, &g);
    for (int v = 0; v < LEGS; v++) command[0][v] = drive_takes(&p->r.drives[v], command[0][v]);
    s->memory = p->l.memory;
    if (end != NULL) memcpy(s->y, end->y, sizeof s->y);
    if (end == NULL && layout->rest > 0)
        act(p, s->waiting[layout->whole], t, layout->rest, tolerance, &steps[0], s->y);
    if (end == NULL)
        act(p, layout->whole > 0 ? s->waiting[layout->whole - 1] : command[0], t + layout->rest,
            layout->period - layout->rest, tolerance, &steps[1], s->y);
    for (int k = layout->waiting - 1; k > 0; k--)
        memcpy(s->waiting[k], s->waiting[k - 1], sizeof s->waiting[k]);
    if (layout->waiting > 0) memcpy(s->waiting[0], command[0], sizeof s->waiting[0]);
}

/* one number of a deviation, as so many imaginary steps */
static void deviate(const sampled_layout *layout, int direction, double amount, complex_state *s) {
    coordinates x = coordinates_load(s->y), rate = coordinates_load(s->y + COORDINATES);
    int place = direction - GOUGH_LINEAR;

    if (direction < GOUGH_LINEAR) {
        displace_by(amount, direction, &x, &rate);
        coordinates_store(&x, s->y);
        coordinates_store(&rate, s->y + COORDINATES);
        return;
    }
    if (place < layout->drive) {
        s->y[MOTION + place] += I * imaginary_step * amount;
        return;
    }
    place -= layout->drive;
    for (int m = 0; m < SAMPLED_MEMORY; m++) {
        if (layout->used[m] && place-- == 0) {
            *memory_at(&s->memory, m) += I * imaginary_step * amount;
            return;
        }
    }
    s->waiting[place / LEGS][place % LEGS] += I * imaginary_step * amount;
}

/* the deviation that an imaginary step has become; apart: from one of its numbers to the next in the array */
static void read_out(const sampled_layout *layout, complex_state *s, int apart, double *deviation) {
    const coordinates x = coordinates_load(s->y), rate = coordinates_load(s->y + COORDINATES);
    const triad *q = &x.q;
    const triad real_part = {{creal(q->i.x), creal(q->i.y), creal(q->i.z)},
                             {creal(q->j.x), creal(q->j.y), creal(q->j.z)},
                             {creal(q->k.x), creal(q->k.y), creal(q->k.z)}};
    const vector turn =
        add(add(cross(real_part.i, imaginary(q->i)), cross(real_part.j, imaginary(q->j))),
            cross(real_part.k, imaginary(q->k)));
    number xi[GOUGH_LINEAR];
    int row = 0;

    vector_store(imaginary(x.rho), xi);
    vector_store(scale(0.5, turn), xi + 3);
    vector_store(imaginary(rate.rho), xi + 6);
    vector_store(imaginary(triad_angular_velocity(q, &rate.q)), xi + 9);
    for (; row < GOUGH_LINEAR; row++) deviation[apart * row] = creal(xi[row]);
    for (int i = 0; i < layout->drive; i++, row++)
        deviation[apart * row] = cimag(s->y[MOTION + i]) / imaginary_step;
    for (int m = 0; m < SAMPLED_MEMORY; m++) {
        if (!layout->used[m]) continue;
        deviation[apart * row++] = cimag(*memory_at(&s->memory, m)) / imaginary_step;
    }
    for (int i = 0; i < LEGS * layout->waiting; i++, row++)
        deviation[apart * row] = cimag(s->waiting[i / LEGS][i % LEGS]) / imaginary_step;
}

void sampled_begin(const linear_loop *linear, const sampled_layout *layout, double t,
                   sampled_state *state) {
    passage p;

    const real preview = linear->control->sampling.preview;

    begin(&p, linear);
    memset(state, 0, sizeof *state);
    for (int k = 1; k <= layout->waiting; k++) {
        const wanted *s = system_wanted(&p.r, t - k * layout->period + preview);
        for (int v = 0; v < LEGS; v++) state->waiting[k - 1][v] = creal(s->force[v]);
    }
    const wanted *s = system_wanted(&p.r, t);
    number y[MOTION];
    coordinates_store(&s->x[0], y);
    coordinates_store(&s->x[1], y + COORDINATES);
    for (int i = 0; i < MOTION; i++) state->y[i] = creal(y[i]);
    for (int i = 0; i < layout->drive && i < LEGS; i++) state->y[MOTION + i] = creal(s->force[i]);
}

/* whether the platform is at a place at all: one that has fallen may have reached none */
static bool is_somewhere(const passage *p, const complex_state *s) {
    bool finite = true;

    for (int i = 0; i < p->r.states; i++) finite = finite && real_finite(creal(s->y[i]));
    return finite;
}

/* the real state after a sample, its triad and the rates of it made proper again */
static void keep(const passage *p, const sampled_layout *layout, complex_state *after,
                 sampled_state *state) {
    coordinates x = coordinates_load(after->y), rate = coordinates_load(after->y + COORDINATES);

    (void)coordinates_project(&x, &rate);
    coordinates_store(&x, after->y);
    coordinates_store(&rate, after->y + COORDINATES);
    for (int i = 0; i < p->r.states; i++) state->y[i] = creal(after->y[i]);
    for (int m = 0; m < SAMPLED_MEMORY; m++)
        state->memory[m] = creal(*memory_at(&after->memory, m));
    for (int i = 0; i < LEGS * layout->waiting; i++)
        state->waiting[i / LEGS][i % LEGS] = creal(after->waiting[i / LEGS][i % LEGS]);
}

const char *sampled_flow(const linear_loop *linear, const sampled_layout *layout, double t,
                         double tolerance, sampled_state *state, double *deviation, size_t *steps) {
    complex_state after, there;
    int parts[2] = {1, 1};
    passage p;

    begin(&p, linear);
    load(&p, layout, state, &after);
    pass(&p, layout, t, tolerance, parts, NULL, &after);
    *steps += (size_t)parts[1] + (layout->rest > 0 ? (size_t)parts[0] : 0);
    const bool derived = deviation != NULL && is_somewhere(&p, &after);
    for (int i = 0; i < layout->n * layout->n && deviation != NULL && !derived; i++)
        deviation[i] = NAN;
    for (int column = 0; derived && column < layout->n; column++) {
        load(&p, layout, state, &there);
        deviate(layout, column, 1, &there);
        pass(&p, layout, t, 0, parts, acts(layout, column) ? NULL : &after, &there);
        read_out(layout, &there, layout->n, deviation + column);
    }
    keep(&p, layout, &after, state);
    return p.r.fault.what;
}

const char *sampled_carry(const linear_loop *linear, const sampled_layout *layout, double t,
                          double tolerance, sampled_state *state, double *deviation) {
    complex_state after, there;
    int parts[2] = {1, 1};
    passage p;

    begin(&p, linear);
    load(&p, layout, state, &after);
    load(&p, layout, state, &there);
    pass(&p, layout, t, tolerance, parts, NULL, &after);
    for (int i = 0; i < layout->n; i++) deviate(layout, i, deviation[i], &there);
    pass(&p, layout, t, 0, parts, NULL, &there);
    read_out(layout, &there, 1, deviation);
    keep(&p, layout, &after, state);
    return p.r.fault.what;
}
