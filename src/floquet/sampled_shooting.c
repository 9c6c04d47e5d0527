/* The periodic motion of a sampled loop sought for many stiffnesses: the derivative of each sample about the program is a linear
 * function of the stiffness, since errors and so commands do not depend on it there. With these derivatives the states before all
 * samples are corrected together until each sample leads to the next state, (loop-12). Theory: docs/theory/loop.md. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "floquet/sampled_orbit.h"

enum { MOST_STEPS = 30 };

/* in the units of a deviation: a correction below which the motion is found, and beyond which it would lead elsewhere; each must be
 * shorter than the last by a factor */
static const double closed = 1e-11, farthest = 0.5, shrinks = 0.6;

/* Of all samples, one after the other. */
struct sampled_table {
    size_t samples;
    int n;
    bool filled;
    double *base,
        *slope; /* n × n: a sample's derivative at G = 0, and what each unit of G adds to it */
    double *missing;   /* n: from the next state to where a sample leads */
    sampled_state *at; /* before each sample */
};

static size_t rounded(size_t bytes) { return (bytes + 63) / 64 * 64; }

static size_t matrices(size_t samples, int n) {
    return rounded(samples * (size_t)(n * n) * sizeof(double));
}

size_t sampled_table_size(size_t samples, int n) {
    return rounded(sizeof(sampled_table)) + 2 * matrices(samples, n) +
           rounded(samples * (size_t)n * sizeof(double)) + rounded(samples * sizeof(sampled_state));
}

sampled_table *sampled_table_begin(size_t samples, int n, void *memory) {
    sampled_table *t = memory;
    char *next = (char *)memory + rounded(sizeof *t);

    t->samples = samples;
    t->n = n;
    t->filled = false;
    t->base = (double *)(void *)next;
    next += matrices(samples, n);
    t->slope = (double *)(void *)next;
    next += matrices(samples, n);
    t->missing = (double *)(void *)next;
    next += rounded(samples * (size_t)n * sizeof(double));
    t->at = (sampled_state *)(void *)next;
    next += rounded(samples * sizeof(sampled_state));
    assert_true(next <= (char *)memory + sampled_table_size(samples, n));
    return t;
}

static double time_of(const sampled_orbit *o, size_t sample) {
    return o->start + (double)sample * o->layout.period;
}

static void set_stiffness(sampled_orbit *o, const double stiffness[GOUGH_LEGS]) {
    memcpy(o->control.stiffness, stiffness, sizeof o->control.stiffness);
}

/* derivatives of all samples about the program, for G = 0 and for a G that makes them change by about as much as they are */
static bool fill(sampled_orbit *o, sampled_table *t) {
    const size_t size = (size_t)(t->n * t->n);
    /* forces over lengths, in the units of a deviation */
    const gough_machine *machine = o->loop.machine;
    const double unit = machine->load.mass * o->unit[6] * o->unit[6] /
                        (machine->base_radius * machine->base_radius);
    double own[GOUGH_LEGS], gains[2][GOUGH_LEGS] = {{0}};
    const char *wrong = NULL;

    memcpy(own, o->control.stiffness, sizeof own);
    for (int v = 0; v < GOUGH_LEGS; v++) gains[1][v] = unit;
    for (size_t k = 0; k < t->samples && wrong == NULL; k++) {
        double *const part[2] = {t->base + k * size, t->slope + k * size};
        for (int i = 0; i < 2 && wrong == NULL; i++) {
            sampled_state state;
            size_t steps = 0;
            sampled_begin(&o->loop, &o->layout, time_of(o, k), &state);
            set_stiffness(o, gains[i]);
            wrong = sampled_flow(&o->loop, &o->layout, time_of(o, k), sampled_tolerance, &state,
                                 part[i], &steps);
        }
        for (size_t e = 0; e < size; e++) part[1][e] = (part[1][e] - part[0][e]) / unit;
    }
    set_stiffness(o, own);
    return wrong == NULL;
}

/* y ← M y of a sample, for a stiffness */
static void pass_on(const sampled_table *t, size_t sample, double stiffness, double *y) {
    const size_t n = (size_t)t->n;
    const double *base = t->base + sample * n * n, *slope = t->slope + sample * n * n;
    double out[SAMPLED_ROWS];

    for (size_t i = 0; i < n; i++) {
        out[i] = 0;
        for (size_t j = 0; j < n; j++)
            out[i] += (base[n * i + j] + stiffness * slope[n * i + j]) * y[j];
    }
    memcpy(y, out, n * sizeof *y);
}

/* the product of all, column by column */
static void compose(const sampled_table *t, double stiffness, sampled_map *map) {
    const int n = t->n;
    double column[SAMPLED_ROWS];

    map->n = n;
    for (int j = 0; j < n; j++) {
        for (int i = 0; i < n; i++) column[i] = i == j;
        for (size_t k = 0; k < t->samples; k++) pass_on(t, k, stiffness, column);
        for (int i = 0; i < n; i++) map->matrix[n * i + j] = column[i];
    }
}

/* where samples lead, from the states as they are */
static bool look(sampled_orbit *o, sampled_table *t) {
    for (size_t k = 0; k < t->samples; k++) {
        sampled_state after = t->at[k];
        if (sampled_flow(&o->loop, &o->layout, time_of(o, k), sampled_tolerance, &after, NULL,
                         &o->steps) != NULL)
            return false;
        sampled_compare(&o->layout, &t->at[(k + 1) % t->samples], &after,
                        t->missing + k * (size_t)t->n);
    }
    return true;
}

/* corrects all states; returns the size of the largest correction in the units of a deviation */
static double correct(sampled_orbit *o, sampled_table *t, double stiffness) {
    const size_t n = (size_t)t->n;
    double step[SAMPLED_ROWS] = {0}, largest = 0;

    for (size_t k = 0; k < t->samples; k++) {
        pass_on(t, k, stiffness, step);
        for (size_t i = 0; i < n; i++) step[i] += t->missing[k * n + i];
    }
    if (!(sampled_newton_step(o, step) <= farthest)) return INFINITY;
    for (size_t k = 0; k < t->samples; k++) {
        for (size_t i = 0; i < n; i++) {
            const double size = fabs(step[i]) / o->unit[i];
            if (!(size <= largest)) largest = size;
        }
        sampled_change(&o->layout, step, &t->at[k]);
        pass_on(t, k, stiffness, step);
        for (size_t i = 0; i < n; i++) step[i] += t->missing[k * n + i];
    }
    return largest;
}

bool sampled_shoot(sampled_orbit *o, sampled_state *state) {
    sampled_table *t = o->table;
    const double stiffness = o->control.stiffness[0];
    double before = farthest / shrinks;

    if (!t->filled && !fill(o, t)) return false;
    t->filled = true;
    compose(t, stiffness, &o->map);
    if (!sampled_factor(o)) return false;
    for (size_t k = 0; k < t->samples; k++)
        sampled_begin(&o->loop, &o->layout, time_of(o, k), &t->at[k]);
    for (int step = 0; step < MOST_STEPS; step++) {
        if (!look(o, t)) return false;
        const double size = correct(o, t, stiffness);
        if (!(size <= shrinks * before)) return false;
        if (size <= closed) {
            *state = t->at[0];
            return true;
        }
        before = size;
    }
    return false;
}
