/* One row of a table from one moment of a run, for scalar number types. */
#ifndef GOUGH_RUN_ROW_H
#define GOUGH_RUN_ROW_H

#include "plant/joints.h"
#include "plant/roll_pitch_yaw.h"
#include "system/system.h"

static inline void row_vector(vector v, real *value, int column) {
    value[column] = v.x, value[column + 1] = v.y, value[column + 2] = v.z;
}

static inline void row_pose(const hexapod *h, int order, const coordinates *x, real *value,
                            int position, int angles) {
    vector point;
    triad R;

    top_of_coordinates(h, x, &point, &R);
    row_vector(point, value, position);
    rotation_angles(order, &R, value + angles);
}

/* velocities or accelerations of the top frame: of its origin, and angular */
static inline void row_rates(const hexapod *h, const coordinates *x, const coordinates *rate,
                             real *value, int linear, int angular) {
    vector point;
    triad ignored;

    top_of_coordinates(h, rate, &point, &ignored);
    row_vector(point, value, linear);
    row_vector(triad_angular_velocity(&x->q, &rate->q), value, angular);
}

/* to (−π, π] */
static inline real row_wrapped(real angle) {
    while (angle > REAL_PI) angle = angle - 2 * REAL_PI;
    while (angle <= -REAL_PI) angle = angle + 2 * REAL_PI;
    return angle;
}

static inline void row_deviation(const struct system *r, const wanted *s, real *value) {
    real program[6];

    row_pose(&r->h, (int)r->motion->order, &s->x[0], program, 0, 3);
    for (int c = 0; c < 3; c++) {
        value[GOUGH_EX + c] = value[GOUGH_X + c] - program[c];
        value[GOUGH_EROLL + c] = row_wrapped(value[GOUGH_ROLL_ANGLE + c] - program[3 + c]);
    }
}

static inline void row_reactions(const struct system *r, const wanted *s, const signals *m,
                                 int simulated, real *value) {
    const number zero = number_of(0);
    vector turn = simulated ? s->turn : (vector){zero, zero, zero};
    push p = r->traits & MOVING_MASS ? heavy_push(&r->h, &m->g, &m->rate, &m->acceleration, m->leg)
                                     : legs_push(&r->h, &m->g, m->leg);
    if (r->traits & EXTERNAL) {
        const push q = known_load_push(&s->external, &m->x.q);
        p = push_sum(&p, &q);
        turn = add(turn, known_load_couple(&s->external, &m->x.q));
    }
    const triad Q = push_generalised(&p, &m->x.q, turn);

    body_reactions(&r->h.load, &m->x.q, &m->rate.q, &Q, value + GOUGH_RXX);
}

static inline void row_joints(const struct system *r, const signals *m, real *value) {
    for (int v = 0; v < LEGS; v++) {
        const leg_joints j = joints_of_leg(&r->h, &m->g, v, &m->rate, &m->acceleration,
                                           r->traits & MOVING_MASS, m->leg[v]);
        value[GOUGH_H + v] = m->leg[v];
        row_vector(j.top, value, GOUGH_ON_TOP + 3 * v);
        row_vector(j.base, value, GOUGH_BY_BASE + 3 * v);
        value[GOUGH_S + v] = j.side;
    }
}

/* what holds the drives back */
static inline void row_held(const struct system *r, const signals *m, real *value) {
    const drive_signals *d = &m->loop;

    for (int v = 0; v < LEGS; v++) {
        value[GOUGH_SATURATED + v] =
            r->traits & LOOPED ? drive_held(&r->drives[v], d->asked[v], d->command[v], d->force[v])
                               : 0;
    }
}

/* commands and measured lengths */
static inline void row_loop(const struct system *r, const signals *m, real *value) {
    for (int v = 0; v < LEGS; v++) {
        const int sampled = r->traits & SAMPLED;
        value[GOUGH_U + v] = r->traits & LOOPED ? m->loop.command[v] : m->force[v];
        if (!r->options->actuators) continue;
        value[GOUGH_MEASURED + v] = sampled ? r->measured[v] : m->g.length[v];
    }
}

/* Whether a summary looks at the joints of a run: of legs without mass and friction it knows them from the drive forces. */
static inline int row_joints_summed(const struct system *r) {
    return r->options->summary && !r->options->summary->brief_ &&
           r->traits & (MOVING_MASS | FRICTION);
}

/* whether a summary counts the times in which drives are held back */
static inline int row_held_summed(const struct system *r) {
    return r->options->summary && !r->options->summary->brief_;
}

/* how much of a row is wanted: velocities and accelerations, and the condition number, are else 0 */
enum { ROW_BRIEF, ROW_RATES, ROW_WHOLE };

/* Fills a row. simulated: with deviation and drift, which the forces of a program do not have. */
static inline void row_fill(const struct system *r, const wanted *s, real t, const signals *m,
                            int simulated, int much, real drift, real value[GOUGH_COLUMNS]) {
    for (int c = 0; c < GOUGH_COLUMNS; c++) value[c] = (real)NAN;
    value[GOUGH_T] = t;
    row_pose(&r->h, (int)r->motion->order, &m->x, value, GOUGH_X, GOUGH_ROLL_ANGLE);
    for (int c = GOUGH_VX; c < GOUGH_L && much == ROW_BRIEF; c++) value[c] = 0;
    if (much >= ROW_RATES) {
        row_rates(&r->h, &m->x, &m->rate, value, GOUGH_VX, GOUGH_WX);
        row_rates(&r->h, &m->x, &m->acceleration, value, GOUGH_AX, GOUGH_ALX);
    }
    for (int v = 0; v < LEGS; v++) {
        value[GOUGH_L + v] = m->g.length[v];
        value[GOUGH_DL + v] = m->g.rate[v];
        value[GOUGH_F + v] = m->force[v];
        value[GOUGH_P + v] = m->force[v] * m->g.rate[v];
    }
    value[GOUGH_CONDITION] = much == ROW_WHOLE ? legs_condition(&r->h, &m->x, &m->g) : 0;
    if (simulated) {
        row_deviation(r, s, value);
        value[GOUGH_DRIFT] = drift;
    }
    if (simulated && r->options->commands + r->options->actuators) row_loop(r, m, value);
    if (simulated && (r->options->actuators || row_held_summed(r))) row_held(r, m, value);
    if (r->options->reactions) row_reactions(r, s, m, simulated, value);
    if (r->options->joints || row_joints_summed(r)) row_joints(r, m, value);
}

/* whether every number that the row should have is finite */
static inline int row_finite(const struct system *r, int simulated,
                             const real value[GOUGH_COLUMNS]) {
    for (int c = 0; c < GOUGH_COLUMNS; c++) {
        if (real_finite(value[c])) continue;
        if (gough_column_filled(c, simulated, r->options)) return 0;
    }
    return 1;
}

/* takes a row, or a moment between rows, into a summary */
static inline void row_sum(const real value[GOUGH_COLUMNS], gough_summary *summary,
                           const gough_machine *machine, int is_row) {
    gough_row row = {.quad = NULL};

    for (int c = 0; c < GOUGH_COLUMNS; c++) row.value[c] = (double)value[c];
    gough_summary_look(summary, machine, &row, is_row);
}

/* hands the row on, without what only the summary asked for; nonzero: the sink asks to stop */
static inline int row_send(const struct system *r, const real value[GOUGH_COLUMNS], gough_sink sink,
                           void *context) {
    gough_row row = {.quad = NULL};
    real sent[GOUGH_COLUMNS];

    if (sink == NULL) return 0;
    for (int c = 0; c < GOUGH_COLUMNS; c++) sent[c] = value[c];
    for (int c = GOUGH_H; c <= GOUGH_S_LAST && !r->options->joints; c++) sent[c] = (real)NAN;
    for (int v = 0; v < LEGS && !r->options->actuators; v++) sent[GOUGH_SATURATED + v] = (real)NAN;
    for (int c = 0; c < GOUGH_COLUMNS; c++) row.value[c] = (double)sent[c];
#if defined(NUMBER_QUAD)
    row.quad = sent;
#endif
    return sink(context, &row);
}

#endif
