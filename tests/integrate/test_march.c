/* The time loop alone, on systems that are no platform: any number of unknowns, steps divided at appointments, a shorter last step,
 * adaptive steps up to a rule's end, rejected ones made again. */
#define NUMBER_DOUBLE
#include <math.h>

#include "integrate/march.h"
#include "support/suite.h"

/* ---- a row of oscillators: y' = v, v' = −k² y, and for an odd number of unknowns one more, z' = −z ---- */

typedef struct {
    int n;
    int calls;
} oscillators;

static void rates(void *context, real t, const number *y, number *rate) {
    oscillators *o = context;

    (void)t;
    o->calls++;
    for (int i = 0; i + 1 < o->n; i += 2) {
        const double k = 1 + i / 2;
        rate[i] = y[i + 1];
        rate[i + 1] = -k * k * y[i];
    }
    if (o->n % 2) rate[o->n - 1] = -y[o->n - 1];
}

static void start(int n, double *y) {
    for (int i = 0; i < n; i++) y[i] = i % 2 == 0;
}

static double error_at(int n, double t, const double *y) {
    double worst = 0;

    for (int i = 0; i < n; i++) {
        const double k = 1 + i / 2;
        const double right = n % 2 && i == n - 1 ? exp(-t)
                             : i % 2 == 0        ? cos(k * t)
                                                 : -k * sin(k * t);
        ck_assert(isfinite(y[i])); /* a maximum would pass over what is not a number */
        worst = fmax(worst, fabs(y[i] - right));
    }
    return worst;
}

/* ---- fixed steps ---- */

enum { MOST = 64 };
typedef struct {
    march m;
    march_problem problem;
    dop853 work;
    rattle_state turning; /* not moved */
    double y[STEPPER_SIZE];
    double corner[4]; /* no part may pass these */
    int corners;
    double begin[MOST], end[MOST], length[MOST];
    int moves, stop_after;
} fixed;

static double part_end(void *clock, double t, double end, double length) {
    const fixed *f = clock;

    (void)length;
    for (int i = 0; i < f->corners; i++)
        if (f->corner[i] > t && f->corner[i] < end) return f->corner[i];
    return end;
}

static int move(void *context, long long k, int part) {
    fixed *f = context;
    double rate[STEPPER_SIZE], raw[STEPPER_SIZE];

    (void)k, (void)part;
    rates(f->problem.context, f->m.t0, f->y, rate);
    (void)march_step(&f->m, &f->problem, &f->work, &f->turning, f->y, rate, raw);
    for (int i = 0; i < f->problem.n; i++) f->y[i] = raw[i];
    if (f->moves < MOST) {
        f->begin[f->moves] = f->m.t0;
        f->end[f->moves] = f->m.t1;
        f->length[f->moves] = f->m.h;
    }
    return ++f->moves == f->stop_after ? 7 : 0;
}

static void set_up(fixed *f, oscillators *o, int method, double length, double until) {
    *f = (fixed){.m = {.method = method, .length = length, .until = until, .part = part_end}};
    f->m.clock = f;
    f->problem = (march_problem){.n = o->n, .rates = rates, .context = o};
    start(o->n, f->y);
}

static double fixed_error(int n, int method, double length) {
    oscillators o = {n, 0};
    fixed f;

    set_up(&f, &o, method, length, 2);
    ck_assert_int_eq(march_fixed(&f.m, 0, fixed_steps(2, length), move, &f), 0);
    ck_assert(fabs(f.m.t1 - 2) < 1e-14);
    return error_at(n, 2, f.y);
}

START_TEST(any_number_of_unknowns_has_the_order_of_the_method) {
    static const int count[] = {1, 2, 3, 5, 7};

    for (size_t i = 0; i < sizeof count / sizeof *count; i++) {
        const double rk4 = fixed_error(count[i], MARCH_RK4, 0.05),
                     finer = fixed_error(count[i], MARCH_RK4, 0.025);
        ck_assert_msg(rk4 / finer > 13 && rk4 / finer < 19, "%d unknowns: order of rk4, ratio %g",
                      count[i], rk4 / finer);
        const double coarse = fixed_error(count[i], MARCH_DOP853, 0.4),
                     fine = fixed_error(count[i], MARCH_DOP853, 0.2);
        ck_assert_msg(coarse / fine > 150, "%d unknowns: order of dop853, ratio %g", count[i],
                      coarse / fine);
    }
}
END_TEST

START_TEST(steps_end_at_appointments_and_at_the_duration) {
    static const double end[] = {0.25, 0.5, 0.6, 0.7, 0.75, 1, 1.1};
    oscillators o = {3, 0};
    fixed f;

    set_up(&f, &o, MARCH_DOP853, 0.25, 1.1);
    f.corner[0] = 0.6, f.corner[1] = 0.7;
    f.corners = 2;
    ck_assert_int_eq(fixed_steps(1.1, 0.25), 5);
    ck_assert_int_eq(march_fixed(&f.m, 0, 5, move, &f), 0);
    ck_assert_int_eq(f.moves, 7);
    double before = 0;
    for (int i = 0; i < 7; i++) {
        ck_assert(!(f.end[i] < end[i]) && !(f.end[i] > end[i]));
        ck_assert(fabs(f.length[i] - (end[i] - before)) < 1e-15);
        before = end[i];
    }
    ck_assert(error_at(3, 1.1, f.y) < 1e-9);
}
END_TEST

START_TEST(a_value_other_than_0_ends_the_loop) {
    oscillators o = {2, 0};
    fixed f;

    set_up(&f, &o, MARCH_RK4, 0.25, 10);
    f.stop_after = 3;
    ck_assert_int_eq(march_fixed(&f.m, 0, 40, move, &f), 7);
    ck_assert_int_eq(f.moves, 3);
}
END_TEST

START_TEST(steps_begin_at_the_origin) {
    oscillators o = {2, 0};
    fixed f;

    set_up(&f, &o, MARCH_RK4, 0.5, HUGE_VAL);
    f.m.origin = 3;
    ck_assert_int_eq(march_fixed(&f.m, 2, 4, move, &f), 0);
    ck_assert_int_eq(f.moves, 2);
    ck_assert(fabs(f.begin[0] - 4) < 1e-15 && fabs(f.end[0] - 4.5) < 1e-15);
    ck_assert(fabs(f.begin[1] - 4.5) < 1e-15 && fabs(f.end[1] - 5) < 1e-15);
}
END_TEST

/* ---- adaptive steps ---- */

typedef struct {
    oscillators o;
    dop853 work;
    double t, end, y[STEPPER_SIZE], rate[STEPPER_SIZE], raw[STEPPER_SIZE], h, tolerance;
    int kept, rejected, longest;
} adaptive;

static double length_of(void *context, double wish, int rejected) {
    adaptive *a = context;

    a->rejected += rejected;
    if (!(a->t < a->end)) return 0;
    return fmin(wish, a->end - a->t);
}

static double attempt(void *context, double length) {
    adaptive *a = context;
    double size[STEPPER_SIZE];

    for (int i = 0; i < a->o.n; i++) size[i] = 1;
    a->h = length;
    rates(&a->o, a->t, a->y, a->work.slope[0]);
    dop853_step(&a->work, rates, &a->o, a->o.n, a->t, length, a->y, a->raw);
    return dop853_error(&a->work, a->o.n, length, a->y, a->raw, size, a->tolerance);
}

static int keep(void *context) {
    adaptive *a = context;

    a->t = a->h < a->end - a->t ? a->t + a->h : a->end;
    for (int i = 0; i < a->o.n; i++) a->y[i] = a->raw[i];
    a->kept++;
    return 0;
}

START_TEST(adaptive_steps_meet_the_tolerance_and_the_end) {
    static const march_rules rules = {length_of, attempt, keep};
    int before = 0;

    for (double tolerance = 1e-6; tolerance > 1e-13; tolerance /= 100) {
        adaptive a = {.o = {7, 0}, .end = 10, .tolerance = tolerance};
        double wish = 5; /* too long: it is rejected */
        start(7, a.y);
        march_adaptive(&rules, &a, &wish);
        ck_assert(!(a.t < 10) && !(a.t > 10));
        ck_assert_int_ge(a.rejected, 1);
        ck_assert_int_gt(a.kept, before);
        ck_assert_int_eq(a.o.calls, 12 * (a.kept + a.rejected));
        ck_assert_msg(error_at(7, 10, a.y) < 100 * tolerance, "%g at a tolerance of %g",
                      error_at(7, 10, a.y), tolerance);
        ck_assert(wish > 0 && isfinite(wish));
        before = a.kept;
    }
}
END_TEST

int main(void) {
    return SUITE_RUN("march", 60, any_number_of_unknowns_has_the_order_of_the_method,
                     steps_end_at_appointments_and_at_the_duration,
                     a_value_other_than_0_ends_the_loop, steps_begin_at_the_origin,
                     adaptive_steps_meet_the_tolerance_and_the_end);
}
