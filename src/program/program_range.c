/* Range of each component of a program: the extremes of the motion, however far apart the rows of a table are. A cell of time
 * passes no row and no corner of the program, and each formula is slow on it (appointments.h). In a cell, rates are evaluated at
 * quarters. Where a rate changes its sign, the extreme is at its root. Where it only comes near zero, its own extreme, a root of
 * the second derivative, tells whether it changes its sign twice. Theory: docs/theory/steppers.md.
 *
 * Of a record about turned axes, roll, pitch and yaw are functions of its angles, which are not slow where pitch is close to ±90°:
 * there a cell is halved until roll and yaw change little from quarter to quarter. */
#define NUMBER_DOUBLE
#include <string.h>

#include "base/quantity.h"
#include "program/angles.h"
#include "program/appointments.h"
#include "program/program.h"
#include "program/program_valid.h"

/* parts of a cell; iterations of a root, more than any root takes */
enum { RANGE_PARTS = 4, RANGE_ITERATIONS = 60 };

/* a root is good to this part of its bracket: enough for a corner, where the extreme is as good as the root */
static const double range_bracket = 1e-12;

/* Halvings of a cell at most, and the largest change of roll or yaw from quarter to quarter, so that whole turns between them are
 * known. Only a pitch of exactly ±90°, where roll and yaw jump, needs all of the halvings. */
enum { RANGE_HALVINGS = 40 };
static const double range_turn = 0.75;

typedef struct {
    const gough_motion *motion;
    angle_frame frame; /* what the angles of the motion are */
    double angle[3];   /* roll, pitch, yaw at a time, for the whole turns of those nearby */
    double *least, *greatest;
    double bad; /* a time at which a component is not finite; NAN: none so far */
    int component;
} range;

static void range_take(range *r, int c, double value) {
    if (!isfinite(value)) return;
    r->least[c] = fmin(r->least[c], value);
    r->greatest[c] = fmax(r->greatest[c], value);
}

/* about turned axes: roll, pitch and yaw, with the whole turns that are nearest to those in r->angle */
static void range_turn_back(const range *r, jet component[GOUGH_COMPONENTS]) {
    if (r->frame.axes == NULL) return;
    motion_base_angles(r->frame, component);
    for (int a = 0; a < 3; a++) {
        double *angle = &component[GOUGH_ROLL + a].v;
        *angle -= 2 * REAL_PI * rint((*angle - r->angle[a]) / (2 * REAL_PI));
    }
}

static void range_near(range *r, const jet component[GOUGH_COMPONENTS]) {
    for (int a = 0; a < 3; a++) r->angle[a] = component[GOUGH_ROLL + a].v;
}

/* takes the components at a time in */
static void range_note(range *r, double t, const jet component[GOUGH_COMPONENTS]) {
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        const jet *x = &component[c];
        if (r->frame.axes == NULL && (!isfinite(x->v) || !isfinite(x->d) || !isfinite(x->dd))) {
            if (isfinite(r->bad)) return;
            r->bad = t;
            r->component = c;
        }
        range_take(r, c, x->v);
    }
}

/* on the way to an extreme, which may be a point of |t|: no derivative is asked for there */
static jet range_at(range *r, int c, double t) {
    jet component[GOUGH_COMPONENTS];

    motion_components(r->motion, t, component);
    range_turn_back(r, component);
    range_take(r, c, component[c].v);
    return component[c];
}

static double range_rate(jet x, int order) { return order == 1 ? x.d : x.dd; }

/* The root of a derivative of component c between two times at which its signs differ, by the Illinois rule: false position,
 * where an end that stays twice counts half. Each value on the way is taken in. */
static jet range_root(range *r, int c, int order, double low, double at_low, double high,
                      double at_high, double *t) {
    const double width = range_bracket * (high - low);
    jet x = {0};

    for (int i = 0; i < RANGE_ITERATIONS && high - low > width; i++) {
        const double even = (low + high) / 2;
        const double line = low + (high - low) * (at_low / (at_low - at_high));
        *t = i % 3 < 2 && line > low && line < high ? line : even;
        x = range_at(r, c, *t);
        const double value = range_rate(x, order);
        if (!isfinite(value) || !(fabs(value) > 0)) return x;
        if ((value > 0) == (at_low > 0)) {
            low = *t;
            at_low = value;
            at_high /= 2;
        } else {
            high = *t;
            at_high = value;
            at_low /= 2;
        }
    }
    return x;
}

/* component c between two times */
static void range_between(range *r, int c, double t, jet x, double u, jet y) {
    double turn = t, root;

    if (x.d * y.d < 0) {
        (void)range_root(r, c, 1, t, x.d, u, y.d, &root);
        return;
    }
    /* a rate whose magnitude falls from the one and rises to the other */
    if (!(x.d * x.dd < 0 && y.d * y.dd > 0)) return;
    const jet m = range_root(r, c, 2, t, x.dd, u, y.dd, &turn);
    if (!(x.d * m.d < 0)) return;
    (void)range_root(r, c, 1, t, x.d, turn, m.d, &root);
    (void)range_root(r, c, 1, turn, m.d, u, y.d, &root);
}

/* whether roll and yaw change little from quarter to quarter; always of other motions than records about turned axes */
static bool range_resolved(const range *r, jet component[RANGE_PARTS + 1][GOUGH_COMPONENTS]) {
    for (int k = 0; r->frame.axes && k < RANGE_PARTS; k++)
        for (int c = GOUGH_ROLL; c < GOUGH_COMPONENTS; c++)
            if (fabs(component[k + 1][c].v - component[k][c].v) > range_turn) return false;
    return true;
}

static void range_cell(range *r, double from, double to, int halvings) {
    jet component[RANGE_PARTS + 1][GOUGH_COMPONENTS];
    formula_row rows[GOUGH_COMPONENTS];
    double t[RANGE_PARTS + 1], before[3];

    for (int k = 0; k <= RANGE_PARTS; k++) t[k] = from + (to - from) * k / RANGE_PARTS;
    t[RANGE_PARTS] = to;
    memcpy(before, r->angle, sizeof before);
    motion_components_at(r->motion, RANGE_PARTS + 1, t, rows);
    for (int k = 0; k <= RANGE_PARTS; k++) {
        motion_components_of(rows, k, component[k]);
        range_turn_back(r, component[k]);
        range_near(r, component[k]);
    }
    if (halvings > 0 && !range_resolved(r, component)) {
        memcpy(r->angle, before, sizeof before);
        range_cell(r, from, t[RANGE_PARTS / 2], halvings - 1);
        range_cell(r, t[RANGE_PARTS / 2], to, halvings - 1);
        return;
    }
    for (int k = 0; k <= RANGE_PARTS; k++) range_note(r, t[k], component[k]);
    if (isfinite(r->bad)) return;
    for (int k = 0; k < RANGE_PARTS; k++) {
        range_near(r, component[k]);
        for (int c = 0; c < GOUGH_COMPONENTS; c++)
            range_between(r, c, t[k], component[k][c], t[k + 1], component[k + 1][c]);
    }
    range_near(r, component[RANGE_PARTS]);
}

gough_status gough_motion_range(const gough_motion *motion, double duration, double output_step,
                                double least[GOUGH_COMPONENTS], double greatest[GOUGH_COMPONENTS],
                                gough_error *error) {
    range r = {.motion = motion,
               .frame = motion_frame(motion),
               .least = least,
               .greatest = greatest,
               .bad = NAN};
    appointments when;
    double t = 0;
    const gough_status checked = motion_check(motion, error);

    for (int c = 0; c < GOUGH_COMPONENTS; c++) least[c] = INFINITY, greatest[c] = -INFINITY;
    if (checked != GOUGH_OK) return checked;
    appointments_begin(&when, motion, NULL, NULL, 0, duration, output_step);
    for (long long row = 1; t < duration && !isfinite(r.bad);) {
        const double stop = fmin((double)row * output_step, duration);
        const double corner = fmin(appointments_corner(&when, t), stop);
        const double h = appointments_step(&when, t, corner - t, 1);
        const double to = h < corner - t && t + h > t ? t + h : corner;
        if (to > t) range_cell(&r, t, to, RANGE_HALVINGS);
        if (!(to < stop)) row++;
        t = to > t ? to : t;
    }
    if (!isfinite(r.bad)) return GOUGH_OK;
    return gough_fail(error, GOUGH_ERROR_INPUT,
                      "motion.%s (value or derivatives) is not finite at t = %.9g" IN_TIME,
                      gough_component_name(r.component), r.bad);
}
