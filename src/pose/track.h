/* Paths of the homotopy (pose-8) over a number type, a lane for each: Taylor's series of order 8, then two corrections of Newton in
 * projective space. No function of libm but roots, so that a path has the same bits in every lane. */
#include <string.h>

#define SCALAR_COMPLEX
#define ROWS_COMPLEX
#include "pose/eight.h"
#include "pose/track_table.h"

/* 32 steps a path; order 6 takes 40; order 10 takes 31, each of which costs more */
enum { ORDER = 8, STEPS_MOST = 800 };

/* the last term of the series at the end of a step; the first correction; the second, as it is and as part of the first */
static const double SERIES_ERROR = 1e-4, FIRST_MOST = 1e-2, SECOND_MOST = 1e-5, SECOND_FINE = 1e-9,
                    SECOND_PART = 1e-3;
/* steps and distances from the end below which a path is left */
static const double STEP_LEAST = 1e-13, LEFT_LEAST = 1e-10;
/* Near the end, a path on which |e·e| of |x| = 1 is smaller leads to infinity: a pose there were 10⁶ machines away. Its root is not
 * simple, so that it would come nearer by ever shorter steps only. */
static const double AWAY = 1e-13, NEAR_END = 0.1;

typedef struct {
    coefficient c[PATH_ROWS][PRODUCTS];
} rows;

/* lanes at work */
typedef struct {
    scalar x[SOMA]; /* |x| = 1 */
    number left;    /* 1 − s */
    number last;    /* length of the last step, or what stands for it */
    number turned;  /* |e·e|² */
} walkers;

/* C(s) = C¹ − (1 − s)(C¹ − C⁰) */
static inline void rows_at(const path_system *from, const path_system *to, number left, rows *r) {
    for (int v = 0; v < PATH_ROWS; v++) {
        for (int n = 0; n < PRODUCTS; n++) {
            const double *a = from->c[v][n], *b = to->c[v][n];
            r->c[v][n] = (scalar){number_of(b[0]) - left * number_of(b[0] - a[0]),
                                  number_of(b[1]) - left * number_of(b[1] - a[1])};
        }
    }
}

/* the Jacobian with x* below, which keeps corrections across x, factored; and the values of the equations */
static inline void path_jacobian(const rows *r, const scalar x[SOMA], eight *f,
                                 scalar value[SOMA]) {
    for (int v = 0; v < PATH_ROWS; v++) soma_gradient(r->c[v], x, f->a[v]);
    soma_study(x, f->a[6]);
    for (int v = 0; v < 7; v++) value[v] = multiple(number_of(0.5), soma_dot(f->a[v], x, SOMA));
    for (int k = 0; k < SOMA; k++) f->a[7][k] = conjugate(x[k]);
    value[7] = scalar_of(number_of(0));
    eight_factor(f);
}

/* (pose-8): J x_k = −[½ C Σ 2y(x_i, x_{k−i}) + ½ (C¹ − C⁰) Σ 2y of the order below; Σ e_i·g_{k−i}; 0] */
static inline void path_series(const path_system *from, const path_system *to, const rows *r,
                               const eight *f, scalar term[ORDER + 1][SOMA]) {
    const number half = number_of(0.5);
    const scalar zero = scalar_of(number_of(0));
    scalar below[PRODUCTS], sum[PRODUCTS];

    for (int n = 0; n < PRODUCTS; n++) below[n] = zero;
    soma_products(term[0], term[0], below);
    for (int k = 1; k <= ORDER; k++) {
        scalar *const x = term[k];
        for (int n = 0; n < PRODUCTS; n++) sum[n] = zero;
        for (int i = 1; 2 * i < k; i++) soma_products(term[i], term[k - i], sum);
        for (int n = 0; n < PRODUCTS; n++) sum[n] = plus(sum[n], sum[n]);
        if (k % 2 == 0) soma_products(term[k / 2], term[k / 2], sum);

        for (int v = 0; v < PATH_ROWS; v++) {
            scalar s = zero;
            for (int n = 0; n < PRODUCTS; n++) {
                const double *a = from->c[v][n], *b = to->c[v][n];
                const scalar d = {number_of(b[0] - a[0]), number_of(b[1] - a[1])};
                s = plus(s, plus(times(r->c[v][n], sum[n]), times(d, below[n])));
            }
            x[v] = multiple(-half, s);
        }
        x[6] = x[7] = zero;
        for (int i = 1; i < k; i++) x[6] = minus(x[6], soma_dot(term[i], term[k - i] + 4, 4));
        eight_solve(f, x);

        for (int n = 0; n < PRODUCTS; n++) below[n] = zero;
        soma_products(term[0], x, below);
        for (int n = 0; n < PRODUCTS; n++) below[n] = plus(sum[n], plus(below[n], below[n]));
    }
}

static inline number path_size(const scalar x[SOMA]) {
    number most = magnitude(x[0]);

    for (int k = 1; k < SOMA; k++) most = number_larger(most, magnitude(x[k]));
    return most;
}

/* min((SERIES_ERROR/|x_8|)^(1/8), ½|x_7|/|x_8|, 4 last, left) */
static inline number path_step(const walkers *w, scalar term[ORDER + 1][SOMA]) {
    const number nothing = number_of(1e-300);
    const number inverse = number_of(1) / (path_size(term[ORDER]) + nothing);
    const number ratio = number_of(0.5) * path_size(term[ORDER - 1]) * inverse;
    number h = number_of(SERIES_ERROR) * inverse;

    h = number_root(number_root(number_root(h)));
    h = number_smaller(h, ratio);
    h = number_smaller(h, number_of(4) * w->last);
    return number_smaller(h, w->left);
}

static inline void path_normalise(scalar x[SOMA]) {
    number square = square_magnitude(x[0]);

    for (int k = 1; k < SOMA; k++) square = square + square_magnitude(x[k]);
    const number inverse = number_of(1) / number_root(square);
    for (int k = 0; k < SOMA; k++) x[k] = multiple(inverse, x[k]);
}

/* a correction of Newton, and its size */
static inline number path_correct(const rows *r, scalar x[SOMA]) {
    scalar d[SOMA];
    eight f;

    path_jacobian(r, x, &f, d);
    eight_solve(&f, d);
    for (int k = 0; k < SOMA; k++) x[k] = minus(x[k], d[k]);
    return path_size(d);
}

/* one step of all lanes; a step that is refused leaves its lane where it is, with a quarter of the step to try next */
static inline void path_advance(const path_system *from, const path_system *to, walkers *w) {
    const number one = number_of(1), zero = number_of(0);
    scalar term[ORDER + 1][SOMA], value[SOMA], z[SOMA];
    rows r;
    eight f;

    rows_at(from, to, w->left, &r);
    path_jacobian(&r, w->x, &f, value);
    memcpy(term[0], w->x, sizeof w->x);
    path_series(from, to, &r, &f, term);

    const number h = path_step(w, term), left = w->left - h;
    memcpy(z, term[ORDER], sizeof z);
    for (int k = ORDER - 1; k >= 0; k--) {
        for (int i = 0; i < SOMA; i++) z[i] = plus(term[k][i], multiple(h, z[i]));
    }
    path_normalise(z);
    rows_at(from, to, left, &r);
    const number first = path_correct(&r, z), second = path_correct(&r, z);
    path_normalise(z);

    /* comparisons are false where a number is NaN */
    const number fine = number_select(number_greater(number_of(SECOND_FINE), second), one, zero);
    const number better =
        number_select(number_greater(number_of(SECOND_PART) * first, second), one, fine);
    const number small =
        number_select(number_greater(number_of(SECOND_MOST), second), better, zero);
    const number good = number_select(number_greater(number_of(FIRST_MOST), first), small, zero);
    const mask accepted = number_greater(good, zero);
    for (int k = 0; k < SOMA; k++) w->x[k] = scalar_select(accepted, z[k], w->x[k]);
    w->left = number_select(accepted, left, w->left);
    w->last = number_select(accepted, h, number_of(0.0625) * h);
    w->turned = square_magnitude(soma_dot(w->x, w->x, 4));
}

static inline void path_put(walkers *w, int lane, const path_point *p) {
    for (int k = 0; k < SOMA; k++) {
        number_put(&w->x[k].re, lane, p->x[k][0]);
        number_put(&w->x[k].im, lane, p->x[k][1]);
    }
    number_put(&w->left, lane, 1);
    number_put(&w->last, lane, 0.05);
}

static inline void path_take(const walkers *w, int lane, path_end *end) {
    for (int k = 0; k < SOMA; k++) {
        end->at.x[k][0] = number_lane(w->x[k].re, lane);
        end->at.x[k][1] = number_lane(w->x[k].im, lane);
    }
    end->left = number_lane(w->left, lane);
}

/* a lane takes the next path when its own ends; a lane without one still computes, and its results are ignored */
static inline void path_track(const path_system *from, const path_system *to,
                              const path_point *start, int count, path_end *end) {
    int path[NUMBER_WIDTH], next = 0, working = 0;
    walkers w;

    for (int k = 0; k < SOMA; k++) w.x[k] = scalar_of(number_of(0));
    w.left = w.last = w.turned = number_of(0);
    for (int lane = 0; lane < NUMBER_WIDTH; lane++) {
        path[lane] = next < count ? next++ : -1;
        path_put(&w, lane, &start[path[lane] < 0 ? 0 : path[lane]]);
        if (path[lane] >= 0) end[path[lane]].steps = 0, working++;
    }
    while (working > 0) {
        path_advance(from, to, &w);
        for (int lane = 0; lane < NUMBER_WIDTH; lane++) {
            if (path[lane] < 0) continue;
            path_end *e = &end[path[lane]];
            const double left = number_lane(w.left, lane), last = number_lane(w.last, lane);
            const int away = left < NEAR_END && number_lane(w.turned, lane) < AWAY * AWAY;
            if (left > LEFT_LEAST && last > STEP_LEAST / 16 && !away && ++e->steps < STEPS_MOST)
                continue;
            path_take(&w, lane, e);
            path[lane] = next < count ? next++ : -1;
            working--;
            if (path[lane] < 0) continue;
            path_put(&w, lane, &start[path[lane]]);
            end[path[lane]].steps = 0, working++;
        }
    }
}
