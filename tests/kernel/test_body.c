/* Equations (1.4)–(1.6) and the multipliers against their own definitions, Newton–Euler and derivatives by an imaginary step.
 * Sanitized: campaign: all other programs evaluate the same texts under sanitizers. */
#define NUMBER_DOUBLE
#include <math.h>
#include <string.h>

#include "kernel/top.h"
#include "support/random.h"
#include "support/suite.h"

static vector random_vector(dice *d, double size) {
    return (vector){dice_between(d, -size, size), dice_between(d, -size, size),
                    dice_between(d, -size, size)};
}

/* an orthonormal triad, by projecting a random one near the identity after random turns */
static triad random_triad(dice *d) {
    triad q = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

    for (int n = 0; n < 30; n++) {
        const vector w = random_vector(d, 0.15);
        const triad turn = triad_rate(&q, w);
        q = (triad){add(q.i, turn.i), add(q.j, turn.j), add(q.k, turn.k)};
        triad_project(&q);
    }
    ck_assert(triad_violation(&q) <= 1e-15);
    return q;
}

static body random_body(dice *d) {
    const double mass = dice_between(d, 0.5, 3), x = dice_between(d, 0, 1);

    return body_of(mass, x, dice_between(d, 0.05, 1), dice_between(d, 0.05, 1));
}

/* (1.5) is Euler's J Ω̇ + Ω × JΩ = L on the body's axes, with ë = α × e + ω × (ω × e) */
START_TEST(triad_equation_is_eulers) {
    dice d = {21};

    for (int n = 0; n < 1000; n++) {
        const body b = random_body(&d);
        const triad q = random_triad(&d);
        const vector omega = random_vector(&d, 2), L = random_vector(&d, 2);
        const triad rate = triad_rate(&q, out_of(&q, omega));
        const triad a = triad_acceleration(&b, &q, &rate, L);
        const vector J = {b.Iy + b.Iz, b.Iz + b.Ix, b.Ix + b.Iy};
        const vector angular = {
            (L.x - (J.z - J.y) * omega.y * omega.z) / J.x,
            (L.y - (J.x - J.z) * omega.z * omega.x) / J.y,
            (L.z - (J.y - J.x) * omega.x * omega.y) / J.z,
        };
        const triad turn = triad_rate(&q, out_of(&q, angular));
        const triad centripetal = triad_rate(&rate, out_of(&q, omega));
        const double size = 10 / fmin(J.x, fmin(J.y, J.z));

        ck_assert(norm(subtract(a.i, add(turn.i, centripetal.i))) <= 1e-14 * size);
        ck_assert(norm(subtract(a.j, add(turn.j, centripetal.j))) <= 1e-14 * size);
        ck_assert(norm(subtract(a.k, add(turn.k, centripetal.k))) <= 1e-14 * size);
        /* and back to the moment by (2.4) */
        ck_assert(norm(subtract(body_moment(&b, &q, &rate, &a), L)) <= 1e-13 * size);
    }
}
END_TEST

/* Lagrange's equations of the first kind, I_a ë_a = Q_a + Σ Λ_ab e_b, hold with the Λ given, for forces at points and a moment */
START_TEST(multipliers_complete_lagranges_equations) {
    dice d = {22};

    for (int n = 0; n < 1000; n++) {
        const body b = random_body(&d);
        const triad q = random_triad(&d);
        const triad rate = triad_rate(&q, random_vector(&d, 2));
        const vector moment = random_vector(&d, 1);
        triad Q = {cross(scale(0.5, moment), q.i), cross(scale(0.5, moment), q.j),
                   cross(scale(0.5, moment), q.k)};
        vector L = onto(&q, moment);
        double r[6];

        for (int p = 0; p < 6; p++) {
            const vector point = random_vector(&d, 1), force = random_vector(&d, 1);
            Q.i = along(Q.i, point.x, force);
            Q.j = along(Q.j, point.y, force);
            Q.k = along(Q.k, point.z, force);
            L = add(L, cross(point, onto(&q, force)));
        }
        const triad a = triad_acceleration(&b, &q, &rate, L);
        body_reactions(&b, &q, &rate, &Q, r);
        vector left = scale(b.Ix, a.i);
        left = subtract(left, add(Q.i, along(along(scale(r[0], q.i), r[3], q.j), r[5], q.k)));
        ck_assert(norm(left) <= 1e-12);
        left = scale(b.Iy, a.j);
        left = subtract(left, add(Q.j, along(along(scale(r[3], q.i), r[1], q.j), r[4], q.k)));
        ck_assert(norm(left) <= 1e-12);
        left = scale(b.Iz, a.k);
        left = subtract(left, add(Q.k, along(along(scale(r[5], q.i), r[4], q.j), r[2], q.k)));
        ck_assert(norm(left) <= 1e-12);
    }
}
END_TEST

/* each constraint under Baumgarte's terms obeys g̈ = −2αġ − β²g to first order in g */
START_TEST(stabilisation_pulls_each_constraint_back) {
    const double alpha = 3, beta = 5, small = 1e-7;
    dice d = {23};

    for (int n = 0; n < 200; n++) {
        const body b = random_body(&d);
        triad q = random_triad(&d);
        triad rate = triad_rate(&q, random_vector(&d, 0.5)), a;
        const vector *e[3] = {&q.i, &q.j, &q.k}, *de[3] = {&rate.i, &rate.j, &rate.k},
                     *dde[3] = {&a.i, &a.j, &a.k};
        triad plain;
        const vector *p[3] = {&plain.i, &plain.j, &plain.k};

        q.i = along(q.i, small, random_vector(&d, 1));
        q.j = along(q.j, small, random_vector(&d, 1));
        rate.k = along(rate.k, small, random_vector(&d, 1));
        plain = a = triad_acceleration(&b, &q, &rate, (vector){0.3, -0.2, 0.1});
        triad_stabilise(&b, &q, &rate, alpha, beta, &a);
        for (int i = 0; i < 3; i++) {
            for (int j = 0; j <= i; j++) {
                const double g = dot(*e[i], *e[j]) - (i == j);
                const double dg = dot(*e[i], *de[j]) + dot(*de[i], *e[j]);
                const double added = dot(*e[i], *dde[j]) + dot(*dde[i], *e[j]) - dot(*e[i], *p[j]) -
                                     dot(*p[i], *e[j]);
                ck_assert(fabs(added + 2 * alpha * dg + beta * beta * g) <= 1e-11);
            }
        }
    }
}
END_TEST

/* the nearest triad is the orthogonal factor of the polar decomposition: Q = E S with S symmetric */
START_TEST(projection_is_the_polar_factor) {
    dice d = {24};

    for (int n = 0; n < 1000; n++) {
        const triad start = random_triad(&d);
        triad q = start, away;

        q.i = add(q.i, random_vector(&d, 0.02));
        q.j = add(q.j, random_vector(&d, 0.02));
        q.k = add(q.k, random_vector(&d, 0.02));
        away = q;
        triad_project(&q);
        ck_assert(triad_violation(&q) <= 1e-15);
        ck_assert(fabs(dot(q.i, away.j) - dot(q.j, away.i)) <= 1e-15);
        ck_assert(fabs(dot(q.j, away.k) - dot(q.k, away.j)) <= 1e-15);
        ck_assert(fabs(dot(q.k, away.i) - dot(q.i, away.k)) <= 1e-15);
        ck_assert(dot(cross(q.i, q.j), q.k) > 0);
    }
}
END_TEST

/* however far the triad was, a projection leaves round-off, and it says how far that was */
START_TEST(projection_reaches_round_off_from_everywhere) {
    dice d = {28};

    for (int n = 0; n < 20000; n++) {
        const double size = pow(10, dice_between(&d, -16, -1.3));
        triad q = random_triad(&d);
        double before;
        q.i = add(q.i, random_vector(&d, size));
        q.k = add(q.k, random_vector(&d, size));
        before = triad_violation(&q);
        ck_assert(!(fabs(triad_project(&q) - before) > 0));
        ck_assert_msg(triad_violation(&q) <= 1e-15, "%g -> %g", before, triad_violation(&q));
    }
}
END_TEST

/* singular values of a matrix built from known ones, and the condition of one that is nearly singular */
START_TEST(singular_values_are_those_put_in) {
    const double want[6] = {3, 2, 1, 0.5, 1e-3, 1e-9};
    dice d = {25};

    for (int n = 0; n < 100; n++) {
        double m[6][6] = {{0}}, high, low;
        for (int i = 0; i < 6; i++) m[i][i] = want[i];
        /* random plane rotations from both sides change no singular value */
        for (int k = 0; k < 60; k++) {
            const int p = (int)dice_between(&d, 0, 6),
                      q = (p + 1 + (int)dice_between(&d, 0, 5)) % 6;
            const double t = dice_between(&d, -3, 3), c = cos(t), s = sin(t);
            for (int i = 0; i < 6; i++) {
                double *x = k % 2 ? &m[i][p] : &m[p][i], *y = k % 2 ? &m[i][q] : &m[q][i];
                const double u = *x, v = *y;
                *x = c * u - s * v;
                *y = s * u + c * v;
            }
        }
        singular_values(m, &high, &low);
        ck_assert(fabs(high - 3) <= 1e-14);
        /* the rotations themselves blur the least value by round-off of the greatest */
        ck_assert(fabs(low - 1e-9) <= 3e-15);
    }
}
END_TEST

/* six equations with a zero on every diagonal place need their rows exchanged */
START_TEST(elimination_exchanges_rows) {
    dice d = {26};

    for (int n = 0; n < 1000; n++) {
        double m[6][6], copy[6][6], b[2][6], want[2][6];
        elimination e;
        for (int i = 0; i < 6; i++) {
            for (int j = 0; j < 6; j++) m[i][j] = i == j ? 0 : dice_between(&d, -1, 1);
            for (int k = 0; k < 2; k++) want[k][i] = dice_between(&d, -1, 1);
        }
        memcpy(copy, m, sizeof m);
        for (int k = 0; k < 2; k++) {
            for (int i = 0; i < 6; i++) {
                b[k][i] = 0;
                for (int j = 0; j < 6; j++) b[k][i] += m[i][j] * want[k][j];
            }
        }
        e = solve_six(m, b, 2);
        ck_assert(isfinite(e.determinant));
        for (int k = 0; k < 2; k++) {
            for (int i = 0; i < 6; i++) {
                double left = 0, right = 0;
                for (int j = 0; j < 6; j++) {
                    left += copy[i][j] * b[k][j];
                    right += copy[i][j] * want[k][j];
                }
                ck_assert(fabs(left - right) <= 1e-13 * fmax(1, fabs(b[k][i])));
            }
        }
    }
}
END_TEST

/* no height: the legs of a symmetric machine lie in a plane, three equations of six are empty */
START_TEST(determinant_of_a_singular_matrix_is_zero) {
    dice d = {27};

    for (int n = 0; n < 100; n++) {
        const int empty = n % 6;
        double m[6][6], b[1][6] = {{1, 1, 1, 1, 1, 1}};
        elimination e;
        for (int i = 0; i < 6; i++) {
            for (int j = 0; j < 6; j++) m[i][j] = j == empty ? 0 : dice_between(&d, -1, 1);
        }
        e = solve_six(m, b, 1);
        ck_assert(fabs(e.determinant) <= 0);
        ck_assert(fabs(e.pivot_ratio) <= 0);
        ck_assert(!isfinite(b[0][0] + b[0][1] + b[0][2] + b[0][3] + b[0][4] + b[0][5]));
    }
}
END_TEST

int main(void) {
    return SUITE_RUN("body", 30, triad_equation_is_eulers, multipliers_complete_lagranges_equations,
                     stabilisation_pulls_each_constraint_back, projection_is_the_polar_factor,
                     projection_reaches_round_off_from_everywhere, singular_values_are_those_put_in,
                     elimination_exchanges_rows, determinant_of_a_singular_matrix_is_zero);
}
