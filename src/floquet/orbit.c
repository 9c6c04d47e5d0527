/* A state that comes back after a period, by Newton's method with the monodromy matrix as derivative; where that fails, from
 * stiffer and damped legs, whose motion is nearer to the program, to those asked for. Theory: docs/theory/floquet.md. */
#define NUMBER_DOUBLE
#include "floquet/orbit.h"

#include <lapacke.h>
#include <string.h>

#include "control/program_lack.h"
#include "kernel/real.h"
#include "plant/state.h"

enum { MOST_STEPS = 15, MOST_CHORDS = 12 };

/* Newton's step below which the state is found; and below which it may stay where rounding stops the steps from shrinking. In
 * tolerances of the stepper, in the units of ξ. */
static const double closed = 10, nearly_closed = 1e3;

/* a first step longer than this, in the same units, could lead to another motion than the one meant; and so could later ones that
 * do not become shorter at least by this factor */
static const double farthest = 0.5, shrinks = 0.8;

/* steps by the matrix of another state are worth taking only while each is shorter than the last by this factor */
static const double chord_shrinks = 0.3;

/* The way from legs (1 + STIFFER) times as stiff and with damping 2√(GM) to those asked for: at most so many motions on it, and the
 * least progress from one to the next. */
enum { STIFFER = 3, MOST_MOTIONS = 24 };
static const double least_progress = 1e-3;

/* of the steps on this way */
static const double rough_tolerance = 1e-9;

/* of the first way round with states, whose matrix only has to lead near the motion */
static const double first_tolerance = 1e-6;

/* e ← exp(θ) e, Rodrigues' formula; below 1e-4 sin x/x by its series, exact to rounding */
static vector turned(vector theta, vector e) {
    const double square = dot(theta, theta), x = real_root(square);
    const double a = x < 1e-4 ? 1 - square / 6 : real_sin(x) / x;
    const double half = x < 1e-4 ? 0.5 - square / 48 : real_sin(x / 2) / x;

    return add(
        e, add(scale(a, cross(theta, e)), scale(2 * half * half, cross(theta, cross(theta, e)))));
}

void orbit_change(const double y[MOTION], const double xi[GOUGH_LINEAR], double out[MOTION]) {
    coordinates x = coordinates_load(y), rate = coordinates_load(y + COORDINATES);
    const vector theta = vector_load(xi + 3);
    const vector omega = add(triad_angular_velocity(&x.q, &rate.q), vector_load(xi + 9));

    x.rho = add(x.rho, vector_load(xi));
    x.q = (triad){turned(theta, x.q.i), turned(theta, x.q.j), turned(theta, x.q.k)};
    rate = (coordinates){add(rate.rho, vector_load(xi + 6)), triad_rate(&x.q, omega)};
    coordinates_project(&x, &rate);
    coordinates_store(&x, out);
    coordinates_store(&rate, out + COORDINATES);
}

void orbit_difference(const double y[MOTION], const double z[MOTION], double xi[GOUGH_LINEAR]) {
    const coordinates x = coordinates_load(y), rate = coordinates_load(y + COORDINATES);
    const coordinates u = coordinates_load(z), other = coordinates_load(z + COORDINATES);
    const vector turn = add(add(cross(x.q.i, u.q.i), cross(x.q.j, u.q.j)), cross(x.q.k, u.q.k));

    vector_store(subtract(u.rho, x.rho), xi);
    vector_store(scale(0.5, turn), xi + 3);
    vector_store(subtract(other.rho, rate.rho), xi + 6);
    vector_store(subtract(angular_velocity_of(&u, &other), angular_velocity_of(&x, &rate)), xi + 9);
}

/* one way round from y: what is missing to closure; false where the way ends before */
static bool go_round(monodromy *m, const double y[STATE_SIZE], double missing[MONODROMY_ROWS],
                     gough_error *error) {
    double after[STATE_SIZE];

    memcpy(after, y, sizeof after);
    if (monodromy_of_motion(m, after, error) != GOUGH_OK) return false;
    orbit_difference(y, after, missing);
    for (int i = GOUGH_LINEAR; i < m->n; i++) {
        const int place = MOTION + m->kept[i - GOUGH_LINEAR];
        missing[i] = after[place] - y[place];
    }
    for (int i = 0; i < m->n; i++) missing[i] /= m->unit[i];
    return true;
}

/* y ← y ⊕ ξ */
static void change(const monodromy *m, const double xi[MONODROMY_ROWS], double y[STATE_SIZE]) {
    orbit_change(y, xi, y);
    for (int i = GOUGH_LINEAR; i < m->n; i++) y[MOTION + m->kept[i - GOUGH_LINEAR]] += xi[i];
}

static double largest_of(const monodromy *m, const double xi[MONODROMY_ROWS]) {
    double largest = 0;

    for (int i = 0; i < m->n; i++)
        if (!(fabs(xi[i]) <= largest)) largest = fabs(xi[i]);
    return largest <= largest ? largest : INFINITY;
}

/* (floquet-7): Newton's step (1 − Φ) ξ = missing, in the units of m; returns its size, INFINITY if 1 − Φ has no inverse */
static double newton_step(const monodromy *m, const double missing[MONODROMY_ROWS],
                          double xi[MONODROMY_ROWS]) {
    const int n = m->n;
    double a[MONODROMY_SIZE];
    lapack_int pivot[MONODROMY_ROWS];

    monodromy_product(m, a);
    for (int i = 0; i < n * n; i++) a[i] = (i % (n + 1) == 0 ? 1 : 0) - a[i];
    memcpy(xi, missing, (size_t)n * sizeof *xi);
    if (LAPACKE_dgesv_work(LAPACK_COL_MAJOR, n, 1, a, n, pivot, xi, n) != 0) return INFINITY;
    return largest_of(m, xi);
}

/* Further steps with the matrix found last, each of which takes a run without deviations: a small part of the work of one with
 * them. */
static void draw_near(monodromy *m, double before, double y[STATE_SIZE]) {
    double missing[MONODROMY_ROWS], xi[MONODROMY_ROWS];

    m->bare = true;
    for (int step = 0; step < MOST_CHORDS && go_round(m, y, missing, NULL); step++) {
        const double length = newton_step(m, missing, xi);
        if (length <= closed * m->tolerance || !(length <= chord_shrinks * before)) break;
        for (int i = 0; i < m->n; i++) xi[i] *= m->unit[i];
        change(m, xi, y);
        before = length;
    }
    m->bare = false;
}

/* The first of Newton's steps with states, by a matrix of few digits, which takes fewer steps than one of many. A motion that
 * closes to these digits is near already. */
static bool come_near(monodromy *m, double y[STATE_SIZE], gough_error *error) {
    const double tolerance = m->tolerance;
    double missing[MONODROMY_ROWS], xi[MONODROMY_ROWS], length;

    m->tolerance = fmax(tolerance, first_tolerance);
    const bool round = go_round(m, y, missing, error);
    m->tolerance = tolerance;
    if (!round) return false;
    if (largest_of(m, missing) <= first_tolerance) return true;
    length = newton_step(m, missing, xi);
    if (!(length <= farthest)) return false;
    for (int i = 0; i < m->n; i++) xi[i] *= m->unit[i];
    change(m, xi, y);
    draw_near(m, length, y);
    return true;
}

/* Newton's method from y, each step shorter than the one before it; whether it came to a motion that closes */
static bool close_motion(monodromy *m, double y[STATE_SIZE], gough_error *error) {
    double missing[MONODROMY_ROWS], xi[MONODROMY_ROWS], before = farthest / shrinks;
    const bool states = m->n > GOUGH_LINEAR;

    for (int step = 0; step < MOST_STEPS; step++) {
        double length;
        if (states && step == 0) {
            if (!come_near(m, y, error)) return false;
            continue;
        }
        if (!go_round(m, y, missing, error)) return false;
        /* the program itself: then 1 − Φ may well have no inverse */
        if (m->loop.whole && largest_of(m, missing) <= m->tolerance) return true;
        length = newton_step(m, missing, xi);
        if (length <= closed * m->tolerance) return true;
        if (!(length <= shrinks * before)) return length <= nearly_closed * m->tolerance;
        for (int i = 0; i < m->n; i++) xi[i] *= m->unit[i];
        change(m, xi, y);
        if (states) draw_near(m, length, y);
        before = length;
    }
    return false;
}

/* (floquet-8): the legs at `share` of the way from those asked for, at 0 */
static gough_control eased(const monodromy *m, const gough_control *asked, double share) {
    gough_control control = *asked;

    for (int v = 0; v < GOUGH_LEGS; v++) {
        const double G = asked->stiffness[v];
        control.stiffness[v] = G * (1 + STIFFER * share);
        control.damping[v] += share * 2 * sqrt(G * m->loop.machine->load.mass);
    }
    return control;
}

/* from eased legs to those asked for, in steps half as long where they fail; y begins at the program */
static bool ease(monodromy *m, const gough_control *asked, double y[STATE_SIZE]) {
    const double tolerance = m->tolerance;
    double held = 1, share = 1, begin[STATE_SIZE];
    bool found = false;
    gough_error why;

    for (int motion = 0; motion < MOST_MOTIONS; motion++) {
        const gough_control control = eased(m, asked, share);
        m->loop.control = &control;
        m->tolerance = share > 0 ? fmax(tolerance, rough_tolerance) : tolerance;
        memcpy(begin, y, sizeof begin);
        if (close_motion(m, y, &why)) {
            found = true;
            held = share;
            if (!(share > 0)) break;
            share = share > 0.02 ? share / 3 : 0;
        } else {
            if (!found || held - share < least_progress) break;
            memcpy(y, begin, sizeof begin);
            share = (held + share) / 2;
        }
    }
    m->loop.control = asked;
    m->tolerance = tolerance;
    return found && !(held > 0);
}

/* the state in which the program begins the period */
static void begin_at_program(const monodromy *m, double y[STATE_SIZE]) {
    gough_acceleration acceleration;
    gough_state state;

    gough_program(m->loop.machine, m->loop.motion, m->start, &state, &acceleration);
    monodromy_unfold(m->loop.machine, &state, y);
    linear_complex.settle(&m->loop, m->start, y);
}

/* of a loop that would keep its program but for its drives */
static gough_status say_drives(const monodromy *m, gough_error *error) {
    const bool lags = m->loop.machine->platform.actuators.kind == GOUGH_ACTUATOR_LAG;

    return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                      "with drives that %s no periodic motion was found near the program: %s, or "
                      "the program excites the platform at a natural frequency; %s "
                      "control.damping, or use %s drives",
                      lags ? "lag" : "have limits",
                      lags ? "the lag takes all damping from the loop"
                           : "the limits do not leave the forces that the program needs",
                      lags ? "reduce control.stiffness, add" : "change control.stiffness or",
                      lags ? "faster" : "stronger");
}

gough_status orbit_find(monodromy *m, double y[STATE_SIZE], gough_error *error) {
    const gough_control *asked = m->loop.control;
    gough_error why = {.message = ""};
    const program_lack lack = program_lack_of(m->loop.machine, asked, true);
    double stiffness = 0;

    for (int v = 0; v < GOUGH_LEGS; v++) stiffness += asked->stiffness[v];
    if (!(stiffness > 0) && !asked->feedforward && !asked->coupled)
        return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                          "without feed-forward and stiffness the legs have no force; give "
                          "control.stiffness, or set control.feedforward to program");
    begin_at_program(m, y);
    if (close_motion(m, y, &why)) return GOUGH_OK;
    if (why.status == GOUGH_ERROR_INPUT)
        return gough_fail(error, GOUGH_ERROR_INPUT, "%s", why.message);

    /* what drives cannot give to a program they cannot give to stiffer legs either */
    const bool kept = gough_keeps_program(m->loop.machine, asked, true);
    begin_at_program(m, y);
    if (!(kept && m->n == GOUGH_LINEAR) && ease(m, asked, y)) return GOUGH_OK;
    if (kept) return say_drives(m, error);
    return gough_fail(
        error, GOUGH_ERROR_NUMERICAL,
        "%s no periodic motion was found near the program: the legs are too weak "
        "to carry the load along it, or it excites the platform at a natural frequency; increase "
        "control.stiffness, add control.damping, or set %s",
        lack.how, lack.cure);
}
