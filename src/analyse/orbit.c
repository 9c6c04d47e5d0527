/* A state that comes back after a period, by Newton's method with the monodromy matrix as derivative; where that fails, from stiffer
 * legs, whose motion is nearer to the program, down to those asked for. Theory: docs/theory/floquet.md. */
#define NUMBER_DOUBLE
#include "analyse/orbit.h"

#include <lapacke.h>
#include <string.h>

#include "dynamics/state.h"
#include "kernel/real.h"

enum { N = GOUGH_LINEAR, MOST_STEPS = 15, HALVINGS = 5 };

/* the state comes back up to this, in the units of ξ; Newton's last step squares what is left before it */
static const double closed = 1e-12, nearly_closed = 1e-10;

/* the largest step, in the same units: beyond it the linear equations say nothing */
static const double farthest = 0.5;

/* e ← exp(θ) e, Rodrigues' formula; below 1e-4 sin x/x by its series, exact to rounding */
static vector turned(vector theta, vector e) {
    const double square = dot(theta, theta), x = real_root(square);
    const double a = x < 1e-4 ? 1 - square / 6 : real_sin(x) / x;
    const double half = x < 1e-4 ? 0.5 - square / 48 : real_sin(x / 2) / x;

    return add(
        e, add(scale(a, cross(theta, e)), scale(2 * half * half, cross(theta, cross(theta, e)))));
}

/* the state y changed by ξ */
static void change(const double y[LINEAR_STATE], const double xi[N], double out[LINEAR_STATE]) {
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

/* ξ from y to z, in the units of m; of the rotation between them, its axis times the sine of its angle */
static double difference(const monodromy *m, const double y[LINEAR_STATE],
                         const double z[LINEAR_STATE], double xi[N]) {
    const coordinates x = coordinates_load(y), rate = coordinates_load(y + COORDINATES);
    const coordinates u = coordinates_load(z), other = coordinates_load(z + COORDINATES);
    const vector turn = add(add(cross(x.q.i, u.q.i), cross(x.q.j, u.q.j)), cross(x.q.k, u.q.k));
    double largest = 0;

    vector_store(subtract(u.rho, x.rho), xi);
    vector_store(scale(0.5, turn), xi + 3);
    vector_store(subtract(other.rho, rate.rho), xi + 6);
    vector_store(
        subtract(triad_angular_velocity(&u.q, &other.q), triad_angular_velocity(&x.q, &rate.q)),
        xi + 9);
    for (int i = 0; i < N; i++) {
        xi[i] /= m->unit[i];
        if (!(fabs(xi[i]) <= largest)) largest = fabs(xi[i]);
    }
    return largest;
}

/* one way round from y: what is missing to closure, and its size; INFINITY where the way ends before */
static double go_round(monodromy *m, const double y[LINEAR_STATE], double missing[N],
                       gough_error *error) {
    double after[LINEAR_STATE];

    memcpy(after, y, sizeof after);
    if (monodromy_of_motion(m, after, error) != GOUGH_OK) return INFINITY;
    return difference(m, y, after, missing);
}

/* (floquet-7): Newton's step (1 − Φ) ξ = missing, in the units of m; returns its size */
static double newton_step(const monodromy *m, const double missing[N], double xi[N]) {
    double a[MONODROMY_SIZE], largest = 0;
    lapack_int pivot[N];

    monodromy_product(m, a);
    for (int i = 0; i < MONODROMY_SIZE; i++) a[i] = (i % (N + 1) == 0 ? 1 : 0) - a[i];
    memcpy(xi, missing, sizeof(double[N]));
    if (LAPACKE_dgesv_work(LAPACK_COL_MAJOR, N, 1, a, N, pivot, xi, N) != 0) return INFINITY;
    for (int i = 0; i < N; i++)
        if (!(fabs(xi[i]) <= largest)) largest = fabs(xi[i]);
    return largest;
}

/* Newton's method from y; whether it came to a motion that closes */
static bool close_motion(monodromy *m, double y[LINEAR_STATE], gough_error *error) {
    double missing[N], xi[N], trial[LINEAR_STATE], before = INFINITY;
    double left = go_round(m, y, missing, error);

    for (int step = 0; step < MOST_STEPS && left < INFINITY; step++) {
        double length, part;
        /* done where closed, or where rounding leaves no more to gain */
        if (left <= closed || (left <= nearly_closed && !(left < 0.5 * before))) return true;
        length = newton_step(m, missing, xi);
        if (!(length < INFINITY)) return false;
        before = left;
        part = length > farthest ? farthest / length : 1;
        for (int halving = 0; halving <= HALVINGS; halving++, part /= 2) {
            double scaled[N];
            for (int i = 0; i < N; i++) scaled[i] = part * xi[i] * m->unit[i];
            change(y, scaled, trial);
            left = go_round(m, trial, missing, error);
            if (left < before || left <= nearly_closed) break;
        }
        if (!(left < before || left <= nearly_closed)) return false;
        memcpy(y, trial, sizeof trial);
    }
    return left <= nearly_closed;
}

static gough_status none_found(const monodromy *m, gough_error *error) {
    gough_error why = {0};
    double y[LINEAR_STATE], missing[N];
    gough_acceleration acceleration;
    gough_state state;

    gough_program(m->loop.machine, m->loop.motion, m->start, &state, &acceleration);
    monodromy_unfold(m->loop.machine, &state, y);
    monodromy again = *m;
    if (go_round(&again, y, missing, &why) < INFINITY) why.message[0] = '\0';
    return gough_fail(
        error, GOUGH_ERROR_NUMERICAL,
        "without feed-forward no periodic motion was found near the program: the legs "
        "may be too weak to carry the load along it%s%.200s; raise control.stiffness, "
        "or set control.feedforward to program",
        why.message[0] != '\0' ? " (from the program's state: " : "",
        why.message[0] != '\0' ? why.message : "");
}

gough_status orbit_find(monodromy *m, double y[LINEAR_STATE], gough_error *error) {
    static const double stiffer[] = {32, 16, 8, 5, 3.2, 2.2, 1.6, 1.25, 1.1, 1.03, 1};
    const gough_control *asked = m->loop.control;
    gough_acceleration acceleration;
    gough_control control = *asked;
    gough_error why = {0};
    gough_state state;

    gough_program(m->loop.machine, m->loop.motion, m->start, &state, &acceleration);
    monodromy_unfold(m->loop.machine, &state, y);
    if (close_motion(m, y, &why)) return GOUGH_OK;
    if (why.status == GOUGH_ERROR_INPUT) {
        if (error != NULL) *error = why;
        return GOUGH_ERROR_INPUT;
    }

    monodromy_unfold(m->loop.machine, &state, y);
    m->loop.control = &control;
    for (size_t i = 0; i < sizeof stiffer / sizeof stiffer[0]; i++) {
        for (int v = 0; v < GOUGH_LEGS; v++)
            control.stiffness[v] = stiffer[i] * asked->stiffness[v];
        if (close_motion(m, y, &why)) continue;
        m->loop.control = asked;
        return none_found(m, error);
    }
    m->loop.control = asked;
    return GOUGH_OK;
}
