/* Durations of moves from limits, (motion-13), against the program computed at 20001 times of each move: no limit is exceeded, and
 * one is reached. */
#include "gough/dynamics.h"
#include "support/machines.h"
#include "support/suite.h"

static const uint64_t seed = 20261201;

/* The parts of their limits that a move uses, each the greatest over its times; force from the middle of its range. */
typedef struct used {
    double speed, acceleration, force, velocity, second;
} used;

static void widen(double *most, double value) {
    if (!(value <= *most)) *most = value;
}

static used use_of(const gough_machine *machine, const gough_motion *motion, size_t index) {
    enum { TIMES = 20000 };
    const gough_limits l = gough_limits_of(machine, motion);
    const gough_move *move = &motion->move[index];
    used most = {0};

    for (int k = 0; k <= TIMES; k++) {
        const double t = move->start + move->duration * k / TIMES;
        double length[6], rate[6], second[6], force[6], component[6][3];
        gough_state s;
        gough_acceleration a;
        gough_program(machine, motion, t, &s, &a);
        gough_motion_evaluate(motion, t, component);
        ck_assert(gough_leg_kinematics(machine, &s, &a, length, rate, second) == GOUGH_OK);
        ck_assert(gough_inverse_dynamics(machine, &s, &a, NULL, force, NULL) == GOUGH_OK);
        for (int v = 0; v < 6; v++) {
            const double middle = (l.force[v][0] + l.force[v][1]) / 2;
            const double half = (l.force[v][1] - l.force[v][0]) / 2;
            widen(&most.speed, fabs(rate[v]) / l.speed[v]);
            widen(&most.acceleration, fabs(second[v]) / l.acceleration[v]);
            if (isfinite(half)) widen(&most.force, fabs(force[v] - middle) / half);
            if (v >= 3)
                continue; /* of the point of the motion, the derivatives of the program itself */
            widen(&most.velocity, component[v][1] / l.rate[v][1]);
            widen(&most.second, component[v][2] / l.second_rate[v][1]);
        }
    }
    return most;
}

static double greatest(const used *u) {
    double most = 0;
    widen(&most, u->speed);
    widen(&most, u->acceleration);
    widen(&most, u->force);
    widen(&most, u->velocity);
    widen(&most, u->second);
    return most;
}

/* two moves at random, the first of a given duration */
static void random_moves(dice *d, gough_move move[2]) {
    memset(move, 0, 2 * sizeof *move);
    move[0].duration = 1;
    move[1].start = 1.5;
    move[1].least = true;
    for (int c = 0; c < 6; c++) {
        move[0].given[c] = dice_between(d, 0, 1) < 0.5;
        move[1].given[c] = c == 2 || dice_between(d, 0, 1) < 0.7;
        move[0].target[c] = dice_between(d, -0.08, 0.08);
        move[1].target[c] = dice_between(d, -0.08, 0.08);
    }
}

START_TEST(least_duration_reaches_a_limit_and_exceeds_none) {
    dice d = {seed};
    int seen[GOUGH_MOVE_LIMITS] = {0};

    for (int i = 0; i < 24; i++) {
        gough_machine machine;
        gough_move move[2];
        gough_move_fit fit;
        gough_error error = {.message = ""};
        skew_machine(&machine);
        random_moves(&d, move);
        gough_motion motion = {.kind = GOUGH_MOTION_MOVES,
                               .move = move,
                               .moves = 2,
                               .about = {0.1, -0.2, 0.3},
                               .order = i % 2 ? GOUGH_XYZ : GOUGH_ZYX};
        for (int v = 0; v < 6; v++) {
            if (i % 3 == 0) machine.platform.legs.speed[v] = dice_between(&d, 0.1, 0.5);
            if (i % 3 == 1) machine.platform.legs.acceleration[v] = dice_between(&d, 0.2, 2);
            if (i % 3 == 2) {
                machine.platform.legs.force[v][0] = -0.6;
                machine.platform.legs.force[v][1] = dice_between(&d, 0.8, 1.2);
            }
        }
        const gough_status status = gough_move_find(&machine, &motion, 1, &fit, sizeof fit, &error);
        ck_assert_msg(status == GOUGH_OK, "seed %llu run %d: %s", (unsigned long long)seed, i,
                      error.message);
        move[1].duration = fit.duration;
        const used u = use_of(&machine, &motion, 1);
        const double most = greatest(&u);
        /* the margin is 2e-6 of the duration, and twice that of an acceleration */
        ck_assert_msg(most <= 1 && most >= 1 - 1e-5, "seed %llu run %d, limit %d: %.9g of it used",
                      (unsigned long long)seed, i, fit.limit, most);
        seen[fit.limit]++;
    }
    ck_assert_int_eq(seen[GOUGH_MOVE_LEG_SPEED], 8);
    ck_assert_int_eq(seen[GOUGH_MOVE_LEG_ACCELERATION], 8);
    ck_assert_int_eq(seen[GOUGH_MOVE_LEG_FORCE], 8);
}
END_TEST

/* the derivatives of the program itself: 15/8 and 10/√3 of the way */
START_TEST(closed_forms_are_the_peaks_of_the_program) {
    gough_machine machine;
    gough_move move = {.start = 2, .target = {0.03, 0, 0.04}, .given = {true, false, true}};
    gough_motion motion = {.kind = GOUGH_MOTION_MOVES, .move = &move, .moves = 1};
    gough_move_fit fit;

    paper_machine(&machine);
    for (int kind = 0; kind < 2; kind++) {
        double most = 0, c[6][3];
        move.speed = kind == 0 ? 0.2 : 0;
        move.acceleration = kind == 1 ? 0.3 : 0;
        ck_assert(gough_move_find(&machine, &motion, 0, &fit, sizeof fit, NULL) == GOUGH_OK);
        ck_assert_int_eq(fit.limit, kind == 0 ? GOUGH_MOVE_SPEED : GOUGH_MOVE_ACCELERATION);
        move.duration = fit.duration;
        for (int k = 0; k <= 2000; k++) {
            gough_motion_evaluate(&motion, 2 + fit.duration * k / 2000, c);
            widen(&most, hypot(c[0][kind + 1], c[2][kind + 1]));
        }
        const double limit = kind == 0 ? move.speed : move.acceleration;
        ck_assert_msg(fabs(most / limit - 1) <= 1e-6, "%d: %.12g of %g", kind, most, limit);
        gough_motion_evaluate(&motion, fit.time, c); /* where it is said to be reached */
        ck_assert(fabs(hypot(c[0][kind + 1], c[2][kind + 1]) / limit - 1) <= 1e-12);
    }
}
END_TEST

/* limits of the platform at another point than that of the motion: heave of a point at the distance 0.5 while the top pitches */
START_TEST(platform_limits_are_those_of_their_point) {
    gough_machine machine;
    gough_move move = {.target = {[GOUGH_PITCH] = 0.1}, .given = {[GOUGH_PITCH] = true}};
    gough_motion motion = {.kind = GOUGH_MOTION_MOVES, .move = &move, .moves = 1};
    gough_move_fit fit;
    double most = 0;

    paper_machine(&machine);
    move.least = true;
    machine.platform.limits.speed[GOUGH_HEAVE][0] = -0.02;
    machine.platform.limits.speed[GOUGH_HEAVE][1] = 0.02;
    machine.platform.limits.about[0] = 0.5;
    machine.platform.limits.about_given = true;
    ck_assert(gough_move_find(&machine, &motion, 0, &fit, sizeof fit, NULL) == GOUGH_OK);
    ck_assert_int_eq(fit.limit, GOUGH_MOVE_PLATFORM_SPEED);
    ck_assert_int_eq(fit.which, GOUGH_HEAVE);
    move.duration = fit.duration;
    for (int k = 0; k <= 20000; k++) { /* z = −0.5 sin θ */
        double c[6][3];
        gough_motion_evaluate(&motion, fit.duration * k / 20000, c);
        widen(&most, fabs(0.5 * cos(c[GOUGH_PITCH][0]) * c[GOUGH_PITCH][1]) / 0.02);
    }
    ck_assert_msg(most <= 1 && most >= 1 - 1e-5, "%.9g of the limit", most);
}
END_TEST

/* the motion runs twice as fast as its moves are given */
START_TEST(a_faster_motion_keeps_the_limits_as_it_runs) {
    gough_machine machine;
    gough_move move = {.target = {0, 0, 0.1}, .given = {false, false, true}, .speed = 0.2};
    gough_motion motion = {
        .kind = GOUGH_MOTION_MOVES, .move = &move, .moves = 1, .amplitude = 1, .frequency = 2};
    gough_move_fit fit;

    paper_machine(&machine);
    for (int least = 0; least < 2; least++) {
        motion.scaled = true;
        move.least = least > 0;
        for (int v = 0; v < 6 && least > 0; v++) { /* a limit on one side only */
            machine.platform.legs.force[v][0] = -INFINITY;
            machine.platform.legs.force[v][1] = 0.26;
        }
        ck_assert(gough_move_find(&machine, &motion, 0, &fit, sizeof fit, NULL) == GOUGH_OK);
        if (least == 0) ck_assert(fabs(fit.duration - 2 * 0.9375) < 1e-14);
        if (least > 0) ck_assert(fit.duration >= 2 * 0.9375 - 1e-14);
    }
}
END_TEST

START_TEST(what_no_duration_keeps_is_refused) {
    gough_machine machine;
    gough_move move = {.target = {0, 0, 0.1}, .given = {false, false, true}, .least = true};
    gough_motion motion = {.kind = GOUGH_MOTION_MOVES, .move = &move, .moves = 1};
    gough_move_fit fit;
    gough_error error = {.message = ""};

    paper_machine(&machine);
    ck_assert(gough_move_find(&machine, &motion, 0, &fit, sizeof fit, &error) == GOUGH_ERROR_INPUT);
    ck_assert(strstr(error.message, "no limit bounds this move"));
    for (int v = 0; v < 6; v++) {
        machine.platform.legs.force[v][0] = -0.1;
        machine.platform.legs.force[v][1] = 0.1; /* less than the weight needs */
    }
    ck_assert(gough_move_find(&machine, &motion, 0, &fit, sizeof fit, &error) == GOUGH_ERROR_INPUT);
    ck_assert(strstr(error.message, "is outside its limits however long the move takes"));
    ck_assert(gough_move_find(&machine, &motion, 0, &fit, sizeof fit - 8, &error) ==
              GOUGH_ERROR_INPUT);
    ck_assert(gough_move_find(&machine, &motion, 1, &fit, sizeof fit, &error) == GOUGH_ERROR_INPUT);
    ck_assert(strstr(error.message, "there is no move 2"));
    motion.kind = GOUGH_MOTION_FORMULAS;
    ck_assert(gough_move_find(&machine, &motion, 0, &fit, sizeof fit, &error) == GOUGH_ERROR_INPUT);
    ck_assert(strstr(error.message, "there is no move 1"));
}
END_TEST

int main(void) {
    return SUITE_RUN(
        "plant/least_duration", 30, least_duration_reaches_a_limit_and_exceeds_none,
        closed_forms_are_the_peaks_of_the_program, platform_limits_are_those_of_their_point,
        a_faster_motion_keeps_the_limits_as_it_runs, what_no_duration_keeps_is_refused);
}
