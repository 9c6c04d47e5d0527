/* A look at a group of runs at the end of a step, and the peaks of the curves through four of them. Text over the number type. */
#ifndef GOUGH_BATCH_LOOK_H
#define GOUGH_BATCH_LOOK_H

#include "batch/lane_runs_table.h"
#include "run/margins.h"
#include "run/peak.h"
#include "run/quadrature.h"

/* What most steps do not come to is apart from them. Laid out within, it would spread their memory over so much stack that loads
 * often had the place of an unrelated store in a page, for which processors make them wait. */
#define LANES_APART __attribute__((noinline)) static

/* columns of a look: of each leg |force|, |rate| and power, then the power that all legs deliver, the distance from the program
 * the size of the turn between them, and the largest |force|, |rate|, power and −power of any leg */
enum {
    LOOKS_FORCE = 0,
    LOOKS_SPEED = LEGS,
    LOOKS_POWER = 2 * LEGS,
    LOOKS_TOTAL = 3 * LEGS,
    LOOKS_DISTANCE,
    LOOKS_TURN,
    LOOKS_MOST_FORCE,
    LOOKS_MOST_SPEED,
    LOOKS_MOST_POWER,
    LOOKS_MOST_BRAKING,
    LOOKS_COLUMNS
};
_Static_assert((int)LOOKS_COLUMNS == (int)BATCH_LOOK, "a look, one lane of it");

/* second differences at a look, from the looks before and after it: the largest of any leg, and those of the deviations */
typedef struct {
    number force, speed, power, distance, turn;
} looks_bends;

struct sizing;

typedef struct {
    double time[QUADRATURE_ROWS]; /* the last looks, the latest last */
    number look[QUADRATURE_ROWS][LOOKS_COLUMNS];
    looks_bends before, bends; /* at the last look but two, and at the last but one */
    int newest;                /* the place of the latest, which goes round */
    int count;                 /* since a corner */
    number force, speed, distance, turn, drift;
    number power, braking; /* greatest of p and of −p, of any leg */
    number energy;
    struct sizing *sizing; /* what sizes the legs (sizing.h); NULL: not wanted */
} looks;

/* an interval between two looks: its polynomial as quadrature_fit() makes it, once it is wanted */
typedef struct {
    double c[QUADRATURE_ROWS][QUADRATURE_ROWS];
    int count, a, fitted;
    const number *row[QUADRATURE_ROWS]; /* the looks, the latest last */
    int middle;                         /* of four looks */
    int even;                           /* these equally far apart */
} looks_interval;

static inline void looks_begin(looks *l) {
    for (int i = 0; i < QUADRATURE_ROWS; i++) { /* rows of weight 0 must not be NaN */
        for (int c = 0; c < LOOKS_COLUMNS; c++) l->look[i][c] = number_of(0);
        l->time[i] = 0;
    }
    l->sizing = NULL;
    l->count = 0;
    l->newest = QUADRATURE_ROWS - 1;
    l->force = l->speed = l->distance = l->turn = l->drift = l->energy = number_of(0);
    l->power = l->braking = number_of(-HUGE_VAL);
    for (int i = 0; i < QUADRATURE_ROWS; i++) {
        for (int c = 0; c < LOOKS_COLUMNS; c++) l->look[i][c] = number_of(0);
    }
}

/* the look before `age` others */
static inline number *looks_back(looks *l, int age) {
    return l->look[((unsigned)l->newest - (unsigned)age) % QUADRATURE_ROWS];
}

/* How far a pose is from the program's: the distance of the top frame's origins, and |Q − Qᵖ|, which is √8 sin(θ/2) for an angle θ
 * between them. `center`: the centre of mass from that origin, central axes. */
static inline void looks_deviation(const coordinates *x, const coordinates *program, vector center,
                                   number *look) {
    const triad turn = {subtract(x->q.i, program->q.i), subtract(x->q.j, program->q.j),
                        subtract(x->q.k, program->q.k)};
    const vector apart = subtract(subtract(x->rho, program->rho), out_of(&turn, center));

    look[LOOKS_DISTANCE] = norm(apart);
    look[LOOKS_TURN] = number_root(dot(turn.i, turn.i) + dot(turn.j, turn.j) + dot(turn.k, turn.k));
}

/* what is seen at one moment */
static inline void looks_fill(const wanted *s, const signals *m, vector center,
                              number look[LOOKS_COLUMNS]) {
    number total = number_of(0), force = total, speed = total;
    number power = number_of(-HUGE_VAL), braking = power;

    looks_deviation(&m->x, &s->x[0], center, look);
    for (int v = 0; v < LEGS; v++) {
        const number p = m->force[v] * m->g.rate[v];
        look[LOOKS_FORCE + v] = number_magnitude(m->force[v]);
        look[LOOKS_SPEED + v] = number_magnitude(m->g.rate[v]);
        look[LOOKS_POWER + v] = p;
        total = total + p;
        force = number_larger(force, look[LOOKS_FORCE + v]);
        speed = number_larger(speed, look[LOOKS_SPEED + v]);
        power = number_larger(power, p);
        braking = number_larger(braking, -p);
    }
    look[LOOKS_TOTAL] = total;
    look[LOOKS_MOST_FORCE] = force;
    look[LOOKS_MOST_SPEED] = speed;
    look[LOOKS_MOST_POWER] = power;
    look[LOOKS_MOST_BRAKING] = braking;
}

static inline double looks_angle(double turn) {
    const double sine = turn / sqrt(8);

    return 2 * asin(sine < 1 ? sine : 1);
}

/* the larger where `heard` is 1, else what there is */
static inline number looks_raise(number heard, number x, number there) {
    const number larger = number_larger(there, x);

    return number_select(number_greater(heard, number_of(0.5)), larger, there);
}

/* adds weight · look of a column to the work where `heard` is 1 */
static inline void looks_integrate(looks *l, number heard, const double weight[QUADRATURE_ROWS]) {
    number sum = number_of(0);

    for (int i = 0; i < QUADRATURE_ROWS; i++) {
        sum = sum + number_of(weight[i]) * looks_back(l, QUADRATURE_ROWS - 1 - i)[LOOKS_TOTAL];
    }
    l->energy = number_select(number_greater(heard, number_of(0.5)), l->energy + sum, l->energy);
}

/* Whether the last looks, three or four, are equally far apart. */
static inline int looks_even(const looks *l, int count) {
    const double one = l->time[1] - l->time[0], two = l->time[2] - l->time[1],
                 three = l->time[3] - l->time[2];

    if (count == QUADRATURE_ROWS && !(fabs(one - two) <= 1e-6 * two)) return 0;
    return fabs(three - two) <= 1e-6 * two;
}

/* No value of the cubic through four looks equally far apart is greater than that between the middle two: with second differences
 * δ₁ and δ₂ there, the cubic is s(s − 1)/4 (δ₁ + δ₂) + s(s − 1)(s − ½)/6 (δ₂ − δ₁) off the chord, at most 0.0706 (|δ₁| + |δ₂|). */
static inline number looks_bound(const number y[QUADRATURE_ROWS]) {
    const number two = number_of(2);
    const number first = y[0] - two * y[1] + y[2], second = y[1] - two * y[2] + y[3];

    return number_larger(y[1], y[2]) +
           number_of(0.071) * (number_magnitude(first) + number_magnitude(second));
}

/* the second difference of the middle one of three looks */
static inline number looks_second(const number *a, const number *b, const number *c, int column) {
    return number_magnitude(a[column] - number_of(2) * b[column] + c[column]);
}

/* the largest one of all legs */
static inline number looks_bend(const number *a, const number *b, const number *c, int column) {
    number most = looks_second(a, b, c, column);

    KERNEL_UNROLL
    for (int v = 1; v < LEGS; v++) most = number_larger(most, looks_second(a, b, c, column + v));
    return most;
}

/* the second differences at the last look but one */
static inline looks_bends looks_bend_all(looks *l) {
    const number *a = looks_back(l, 2), *b = looks_back(l, 1), *c = looks_back(l, 0);

    return (looks_bends){looks_bend(a, b, c, LOOKS_FORCE), looks_bend(a, b, c, LOOKS_SPEED),
                         looks_bend(a, b, c, LOOKS_POWER), looks_second(a, b, c, LOOKS_DISTANCE),
                         looks_second(a, b, c, LOOKS_TURN)};
}

/* how far the polynomial of any leg may be above the peak so far, from the largest value and second difference of all legs */
static inline number looks_over(const number *one, const number *two, int column, number bends,
                                number peak) {
    return number_larger(one[column], two[column]) + bends - peak;
}

/* Whether any peak may lie between look a of the last four and the next, by the polynomial through the last `count` looks, three or
 * four, which are equally far apart. Where not, which is almost always, looks_peaks() need not ask each column: no bound there is
 * greater, rounding included. Between the middle two of four looks the bound is that of looks_bound(). Between the first two or
 * the last two the cubic is s(s − 1)/2 δ₁ + s(s − 1)(s − 2)/6 (δ₂ − δ₁) off the chord, δ₁ being the nearer second difference: at
 * most (1/8 + 0.0642) |δ₁| + 0.0642 |δ₂|. The parabola through three looks is at most 1/8 |δ| off. */
static inline int looks_any(looks *l, int count, int a) {
    const looks_bends *before = &l->before, *b = &l->bends;
    const number *one = looks_back(l, QUADRATURE_ROWS - 1 - a);
    const number *two = looks_back(l, QUADRATURE_ROWS - 2 - a);
    const number share = number_of(count == QUADRATURE_ROWS && a == 1 ? 0.071 : 0.19);
    const number more = number_of(count == QUADRATURE_ROWS ? 1 : 0);
    number most =
        looks_over(one, two, LOOKS_MOST_FORCE, share * (more * before->force + b->force), l->force);

    most = number_larger(most, looks_over(one, two, LOOKS_MOST_SPEED,
                                          share * (more * before->speed + b->speed), l->speed));
    const number power = share * (more * before->power + b->power);
    most = number_larger(most, looks_over(one, two, LOOKS_MOST_POWER, power, l->power));
    most = number_larger(most, looks_over(one, two, LOOKS_MOST_BRAKING, power, l->braking));
    most = number_larger(most,
                         looks_over(one, two, LOOKS_DISTANCE,
                                    share * (more * before->distance + b->distance), l->distance));
    most = number_larger(
        most, looks_over(one, two, LOOKS_TURN, share * (more * before->turn + b->turn), l->turn));
    return number_any(number_greater(most, number_of(0)));
}

/* Whether the polynomial of one of some columns may be above the peak in a lane. Where looks in the middle of four do not turn,
 * peak_between() finds nothing. All columns are asked at once, without a branch for each, which mostly settles it. */
static inline int looks_reach(const looks_interval *f, int column, int columns, number sign,
                              number peak) {
    const number none = number_of(0), all = number_of(1);
    number most = none;

    if (!f->middle) return 1;
    for (int c = column; c < column + columns; c++) {
        number y[QUADRATURE_ROWS];
        for (int i = 0; i < QUADRATURE_ROWS; i++) y[i] = sign * f->row[i][c];
        const number bends = (y[1] - y[0]) * (y[3] - y[2]);
        const number over = f->even ? looks_bound(y) - peak : all;
        most = number_larger(most, number_select(number_greater(none, bends), over, none));
    }
    return number_any(number_greater(most, none));
}

/* Raises a peak to those of some columns between look a and the next, in the lanes where the polynomial may be above it, whatever
 * the others do. */
static inline void looks_peaks_of(looks *l, number heard, int column, int columns, number sign,
                                  looks_interval *f, number *peak) {
    const number half = number_of(0.5), none = number_of(0);
    number y[QUADRATURE_ROWS], s;

    if (!looks_reach(f, column, columns, sign, *peak)) return;
    for (int c = column; c < column + columns; c++) {
        number near = heard;
        for (int i = 0; i < QUADRATURE_ROWS; i++) y[i] = f->row[i][c];
        if (f->middle) {
            const number bends = (y[1] - y[0]) * (y[3] - y[2]);
            near = number_select(number_greater(none, bends), heard, none);
        }
        if (!number_any(number_greater(near, half))) continue;
        for (int i = 0; i < QUADRATURE_ROWS; i++) y[i] = sign * y[i];
        if (f->even) near = number_select(number_greater(looks_bound(y), *peak), near, none);
        if (f->even && !number_any(number_greater(near, half))) continue;
        if (!f->fitted) quadrature_fit(l->time, f->count, f->a, f->c);
        f->fitted = 1;
        const number value =
            peak_between(y, (const double(*)[QUADRATURE_ROWS])f->c, f->count, f->a, &s);
        const number turned = number_select(number_greater(s, none), near, none);
        *peak = looks_raise(turned, value, *peak);
    }
}

#endif
