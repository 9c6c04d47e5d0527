/* The duration of a move from its limits: closed forms for limits of the move itself, and a search for those of the machine,
 * (motion-13). Times and lengths in units of the run, angles in radians, base frame. */
#define NUMBER_DOUBLE
#include "gough/dynamics.h"

#include <math.h>

#include "base/limits.h"
#include "gough/sizes.h"
#include "plant/platform_point.h"
#include "plant/program_motion.h"
#include "program/program_valid.h"

/* Limits of the machine, in this order: rate, second rate and drive force of each leg, velocity and acceleration of the
 * platform. */
enum { RATE, SECOND_RATE = 6, FORCE = 12, VELOCITY = 18, ACCELERATION = 24, QUANTITIES = 30 };

/* Intervals of the move. A parabola through three times misses a peak of its sixth derivatives by less than 1e-7 of it. */
enum { INTERVALS = 256 };

/* added to a duration that was found by search: more than what the parabolas may miss */
static const double MARGIN = 2e-6;

/* halvings of the interval in which the least duration lies: to 1e-9 of it */
enum { HALVINGS = 30, DOUBLINGS = 50 };

typedef struct trial {
    const gough_machine *machine;
    gough_motion motion;
    gough_move move[2]; /* one that ends in the pose before, and the move */
    double bound[QUANTITIES][2];
    bool forces; /* a drive force has a limit */
} trial;

/* the quantity that is farthest outside its limits, in parts of their width; inside if negative */
typedef struct excess {
    double share, time;
    int quantity; /* −1: the forces along the move cannot be computed */
} excess;

/* velocity and acceleration of the point that the limits are of */
static void platform_at(const gough_state *s, const gough_acceleration *a, const double about[3],
                        double value[QUANTITIES]) {
    const top_motion top = {s->position,         s->velocity, a->linear,
                            s->angular_velocity, a->angular,  (const double(*)[3])s->rotation};
    double point[3];

    platform_point(&top, about, point, &value[VELOCITY], &value[ACCELERATION]);
    for (int i = 0; i < 3; i++) {
        value[VELOCITY + 3 + i] = s->angular_velocity[i];
        value[ACCELERATION + 3 + i] = a->angular[i];
    }
}

/* all quantities at a time; false where they cannot be computed */
static bool values_at(const trial *r, const double about[3], double t, double value[QUANTITIES]) {
    gough_state state;
    gough_acceleration acceleration;
    gough_wrench wrench;
    double length[GOUGH_LEGS];

    gough_program(r->machine, &r->motion, t, &state, &acceleration);
    if (gough_leg_kinematics(r->machine, &state, &acceleration, length, &value[RATE],
                             &value[SECOND_RATE]) != GOUGH_OK)
        return false;
    platform_at(&state, &acceleration, about, value);
    for (int v = 0; v < GOUGH_LEGS; v++) value[FORCE + v] = 0;
    return !r->forces || (gough_external_wrench(r->machine, &state, t, &wrench) == GOUGH_OK &&
                          gough_inverse_dynamics(r->machine, &state, &acceleration, &wrench,
                                                 &value[FORCE], NULL) == GOUGH_OK);
}

static bool is_bound(const double bound[2]) { return isfinite(bound[0]) || isfinite(bound[1]); }

static void compare(excess *most, const double bound[2], int quantity, double value, double time) {
    const double width = isfinite(bound[1] - bound[0])
                             ? bound[1] - bound[0]
                             : fmax(1e-300, fabs(isfinite(bound[0]) ? bound[0] : bound[1]));
    const double share = fmax(value - bound[1], bound[0] - value) / width;
    if (most->quantity >= 0 && !(share > most->share)) return;
    *most = (excess){share, time, quantity};
}

/* what three values, a step apart, say about the extreme between them: the vertex of their parabola */
static void compare_vertex(excess *most, const double bound[2], int quantity, double a, double b,
                           double c, double time, double step) {
    const double slope = (c - a) / 2, bend = a - 2 * b + c;
    if (fabs(slope) < fabs(bend))
        compare(most, bound, quantity, b - slope * slope / (2 * bend), time - slope / bend * step);
}

/* the move in a duration of the motion as it runs */
static excess excess_of(trial *r, const double about[3], double duration) {
    const double rate = r->motion.scaled ? r->motion.frequency : 1;
    const double start = r->move[1].start / rate, step = duration / INTERVALS;
    double value[3][QUANTITIES];
    excess most = {-INFINITY, start, -1};

    r->move[1].duration = duration * rate;
    for (int k = 0; k <= INTERVALS; k++) {
        const double t = start + k * step;
        double *now = value[k % 3];
        const double *a = value[(k + 1) % 3], *b = value[(k + 2) % 3];
        if (!values_at(r, about, t, now)) return (excess){INFINITY, t, -1};
        for (int q = 0; q < QUANTITIES; q++) {
            if (!is_bound(r->bound[q])) continue;
            if (!isfinite(now[q])) return (excess){INFINITY, t, -1};
            compare(&most, r->bound[q], q, now[q], t);
            if (k >= 2) compare_vertex(&most, r->bound[q], q, a[q], b[q], now[q], t - step, step);
        }
    }
    return most;
}

/* ---- limits of the move itself ---- */

static void take(gough_move_fit *fit, double duration, gough_move_limit limit, int which,
                 double time) {
    if (!(duration > fit->duration)) return;
    *fit = (gough_move_fit){duration, limit, which, time};
}

/* Closed forms, (motion-13), of the straight way of the point and of each angle by itself; `time` in parts of the duration. */
static void fit_itself(const gough_move *move, const double change[GOUGH_COMPONENTS],
                       gough_move_fit *fit) {
    const double way = sqrt(change[0] * change[0] + change[1] * change[1] + change[2] * change[2]);
    const double middle = 0.5, early = 0.5 - sqrt(1.0 / 12);

    take(fit, move_duration_by_speed(way, move->speed), GOUGH_MOVE_SPEED, -1, middle);
    take(fit, move_duration_by_acceleration(way, move->acceleration), GOUGH_MOVE_ACCELERATION, -1,
         early);
    for (int c = GOUGH_ROLL; c < GOUGH_COMPONENTS; c++) {
        const double turn = fabs(change[c]);
        take(fit, move_duration_by_speed(turn, move->angular_speed), GOUGH_MOVE_ANGULAR_SPEED, c,
             middle);
        take(fit, move_duration_by_acceleration(turn, move->angular_acceleration),
             GOUGH_MOVE_ANGULAR_ACCELERATION, c, early);
    }
}

/* ---- limits of the machine ---- */

static bool collect(trial *r, double about[3]) {
    const gough_limits l = gough_limits_of(r->machine, &r->motion);
    bool any = false;

    for (int v = 0; v < GOUGH_LEGS; v++) {
        for (int side = 0; side < 2; side++) {
            const double sign = side ? 1 : -1;
            r->bound[RATE + v][side] = sign * l.speed[v];
            r->bound[SECOND_RATE + v][side] = sign * l.acceleration[v];
            r->bound[FORCE + v][side] = l.force[v][side];
            r->bound[VELOCITY + v][side] = l.rate[v][side];
            r->bound[ACCELERATION + v][side] = l.second_rate[v][side];
        }
        r->forces = r->forces || is_bound(l.force[v]);
    }
    for (int k = 0; k < 3; k++) about[k] = l.about[k];
    for (int q = 0; q < QUANTITIES; q++) any = any || is_bound(r->bound[q]);
    return any;
}

static gough_move_limit limit_of(int quantity, int *which) {
    static const gough_move_limit limits[] = {GOUGH_MOVE_LEG_SPEED, GOUGH_MOVE_LEG_ACCELERATION,
                                              GOUGH_MOVE_LEG_FORCE, GOUGH_MOVE_PLATFORM_SPEED,
                                              GOUGH_MOVE_PLATFORM_ACCELERATION};
    *which = quantity % GOUGH_LEGS;
    return limits[quantity / GOUGH_LEGS];
}

static gough_status deny_slow(gough_error *error, size_t index, const excess *most) {
    if (most->quantity < 0)
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "`motion.moves.%zu.duration` cannot be found: the leg forces cannot be "
                          "computed along the move, whose path may pass a singular pose",
                          index + 1);
    if (most->quantity < FORCE || most->quantity >= VELOCITY)
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "`motion.moves.%zu.duration` cannot be found: a limit of speed or "
                          "acceleration leaves no room for rest; let it include 0",
                          index + 1);
    return gough_fail(error, GOUGH_ERROR_INPUT,
                      "`motion.moves.%zu.duration` cannot be found: the force of leg %d is outside "
                      "its limits however long the move takes; change these limits or the "
                      "target",
                      index + 1, most->quantity - FORCE + 1);
}

static gough_status deny_free(gough_error *error, size_t index) {
    return gough_fail(
        error, GOUGH_ERROR_INPUT,
        "`motion.moves.%zu.duration` cannot be found: no limit bounds this move; give "
        "a number, or limits of what it changes",
        index + 1);
}

/* A duration that does not keep the limits, and one that does, are brought together. */
static gough_status search(trial *r, size_t index, const double about[3], gough_move_fit *fit,
                           gough_error *error) {
    double low = fit->duration > 0 ? fit->duration : 1, high = low;
    excess most = excess_of(r, about, low), now = most;

    if (fit->duration > 0 && most.share <= 0) return GOUGH_OK;
    for (int i = 0; now.share > 0; i++) {
        if (i == DOUBLINGS) return deny_slow(error, index, &now);
        low = high, most = now;
        high *= 2, now = excess_of(r, about, high);
    }
    for (int i = 0; !(most.share > 0); i++) {
        if (i == DOUBLINGS) return deny_free(error, index);
        high = low;
        low /= 2, most = excess_of(r, about, low);
    }
    for (int i = 0; i < HALVINGS; i++) {
        const double middle = 0.5 * (low + high);
        now = excess_of(r, about, middle);
        if (now.share > 0)
            low = middle, most = now;
        else
            high = middle;
    }
    if (most.quantity < 0) return deny_slow(error, index, &most);
    fit->duration = high * (1 + MARGIN);
    fit->limit = limit_of(most.quantity, &fit->which);
    fit->time = most.time;
    return GOUGH_OK;
}

/* the way of each component in the motion as it runs, and the move alone with the pose before it */
static void begin(trial *r, const gough_machine *machine, const gough_motion *motion, size_t index,
                  double change[GOUGH_COMPONENTS]) {
    const gough_move *move = &motion->move[index];
    const double factor = motion->scaled ? motion->amplitude : 1;

    *r = (trial){.machine = machine, .motion = *motion};
    r->move[0] = (gough_move){.start = move->start - 1, .duration = 1};
    r->move[1] = *move;
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        r->move[0].given[c] = true;
        for (size_t i = 0; i < index; i++)
            if (motion->move[i].given[c]) r->move[0].target[c] = motion->move[i].target[c];
        change[c] = move->given[c] ? factor * (move->target[c] - r->move[0].target[c]) : 0;
    }
    r->motion.move = r->move;
    r->motion.moves = 2;
}

gough_status gough_move_find(const gough_machine *machine, const gough_motion *motion, size_t index,
                             gough_move_fit *fit, size_t size, gough_error *error) {
    const double rate = motion->scaled ? motion->frequency : 1;
    double change[GOUGH_COMPONENTS], about[3];
    gough_move_fit found = {.which = -1};
    trial r;
    gough_status status = gough_size_check(size, sizeof *fit, "gough_move_fit", error);

    if (status == GOUGH_OK) status = motion_check(motion, error);
    if (status != GOUGH_OK) return status;
    if (motion->kind != GOUGH_MOTION_MOVES || index >= motion->moves)
        return gough_fail_key(error, GOUGH_ERROR_INPUT, "motion.moves",
                              "motion: there is no move %zu", index + 1);
    begin(&r, machine, motion, index, change);
    fit_itself(&r.move[1], change, &found);
    found.time = r.move[1].start / rate + found.time * found.duration;
    if (r.move[1].least && collect(&r, about)) {
        status = search(&r, index, about, &found, error);
        if (status != GOUGH_OK) return status;
    }
    if (!(found.duration > 0)) return deny_free(error, index);
    found.duration *= rate;
    *fit = found;
    return GOUGH_OK;
}
