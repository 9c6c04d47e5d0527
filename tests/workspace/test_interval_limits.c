/* Box tests of swing, clearance, the least singular value and forces against interval arithmetic with outward rounding (MPFI, 160
 * bits) in another formulation: rotations as products of matrices of intervals, directions as quotients, singular values by the
 * signs of pivots, forces by elimination, distances by points of both legs. What the one proves the other must not contradict.
 * Label: standard.
 * Not sanitized: the library of intervals is not ours, and test_boxes.c and test_demands.c run the same functions.
 * Libraries: mpfi mpfr gmp */
#include <mpfi.h>
#include <stdio.h>

#include "support/suite.h"
#include "workspace/flight.h"

/* loads: the weight, and six components of acceleration */
enum { BITS = 160, POOL = 20000, PARTS = 8, BOXES = 32, PIECES = 8, LOADS = 7 };

/* ---- intervals that are made by expressions; all are given back at once ---- */

typedef mpfi_ptr iv;

static mpfi_t pool[POOL];
static int used;

static iv fresh(void) {
    ck_assert(used < POOL);
    return pool[used++];
}
static iv between(double least, double greatest) {
    iv x = fresh();
    mpfi_interv_d(x, least, greatest);
    return x;
}
static iv number_of(double x) { return between(x, x); }
static iv add(iv a, iv b) {
    iv x = fresh();
    mpfi_add(x, a, b);
    return x;
}
static iv less(iv a, iv b) {
    iv x = fresh();
    mpfi_sub(x, a, b);
    return x;
}
static iv times(iv a, iv b) {
    iv x = fresh();
    mpfi_mul(x, a, b);
    return x;
}
static iv over(iv a, iv b) {
    iv x = fresh();
    mpfi_div(x, a, b);
    return x;
}
static iv square(iv a) {
    iv x = fresh();
    mpfi_sqr(x, a);
    return x;
}
static iv root(iv a) {
    iv x = fresh();
    mpfi_sqrt(x, a);
    return x;
}
static iv dot(iv a[3], iv b[3]) {
    return add(add(times(a[0], b[0]), times(a[1], b[1])), times(a[2], b[2]));
}
static void cross(iv a[3], iv b[3], iv out[3]) {
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        out[i] = less(times(a[j], b[k]), times(a[k], b[j]));
    }
}
static void product(iv A[3][3], iv B[3][3], iv C[3][3]) {
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            iv column[3] = {B[0][j], B[1][j], B[2][j]};
            C[i][j] = dot(A[i], column);
        }
}
static bool is_above(iv a, double limit) { return mpfi_cmp_d(a, limit) > 0; }
static bool is_below(iv a, double limit) { return mpfi_cmp_d(a, limit) < 0; }

/* ---- the machine in all poses of a box ---- */

typedef struct machine_iv {
    iv R[3][3], arm[GOUGH_LEGS][3], leg[GOUGH_LEGS][3], n[GOUGH_LEGS][3];
} machine_iv;

/* the rotation about an axis, 0 for x … 2 for z */
static void turn(int axis, iv angle, iv R[3][3]) {
    const int j = (axis + 1) % 3, k = (axis + 2) % 3;
    iv sine = fresh(), cosine = fresh();
    mpfi_sin(sine, angle), mpfi_cos(cosine, angle);
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) R[a][b] = number_of(a == axis && b == axis);
    R[j][j] = R[k][k] = cosine;
    R[k][j] = sine, R[j][k] = less(number_of(0), sine);
}

static void machine_of(const gough_model *model, const gough_box *box, machine_iv *m) {
    const gough_platform *p = &model->machine.platform;
    iv one[3][3][3], both[3][3];
    for (int k = 0; k < 3; k++) turn(k, between(box->least[3 + k], box->greatest[3 + k]), one[k]);
    product(one[2], one[1], both);
    product(both, one[0], m->R);
    for (int v = 0; v < GOUGH_LEGS; v++) {
        for (int i = 0; i < 3; i++) {
            iv b[3] = {number_of(p->top[v][0]), number_of(p->top[v][1]), number_of(p->top[v][2])};
            m->arm[v][i] = dot(m->R[i], b);
            iv at =
                add(between(box->least[i], box->greatest[i]), number_of(i == 2 ? p->height : 0));
            m->leg[v][i] = less(add(at, m->arm[v][i]), number_of(p->base[v][i]));
        }
        iv length = root(dot(m->leg[v], m->leg[v]));
        for (int i = 0; i < 3; i++) m->n[v][i] = over(m->leg[v][i], length);
    }
}

/* Of a limit: 1 if it is proved to be kept in all poses of a box, −1 if it is exceeded in all of them, else 0. */
typedef struct question {
    const gough_model *model;
    const gough_reach *reach;
    machine_iv home;
    int leg, other; /* of a swing; of a clearance; of a force */
    int kept;       /* intervals made for home, which stay */
} question;
typedef int prover(const question *q, const gough_box *box);

static int swing_is_kept(const question *q, const gough_box *box) {
    const int v = q->leg;
    machine_iv m;
    machine_of(q->model, box, &m);
    iv turned[3], n0[3];
    for (int i = 0; i < 3; i++) n0[i] = q->home.n[v][i];
    for (int i = 0; i < 3; i++) turned[i] = dot(m.R[i], n0);
    iv base = dot(m.n[v], n0), top = dot(m.n[v], turned), limit[2];
    for (int i = 0; i < 2; i++) {
        limit[i] = number_of(i ? q->reach->limits.top_swing[v] : q->reach->limits.base_swing[v]);
        mpfi_cos(limit[i], limit[i]);
    }
    if (mpfi_cmp(base, limit[0]) > 0 && mpfi_cmp(top, limit[1]) > 0) return 1;
    return mpfi_cmp(add(base, number_of(1e-11)), limit[0]) < 0 ||
                   mpfi_cmp(add(top, number_of(1e-11)), limit[1]) < 0
               ? -1
               : 0;
}

/* the square of the distance of parts of two legs */
static iv distance_of(const question *q, const machine_iv *m, iv s, iv t) {
    const gough_platform *p = &q->model->machine.platform;
    iv way[3];
    for (int i = 0; i < 3; i++) {
        iv a = add(number_of(p->base[q->leg][i]), times(s, m->leg[q->leg][i])),
           b = add(number_of(p->base[q->other][i]), times(t, m->leg[q->other][i]));
        way[i] = less(a, b);
    }
    return add(add(square(way[0]), square(way[1])), square(way[2]));
}

static int clearance_is_kept(const question *q, const gough_box *box) {
    const double *d = q->reach->limits.diameter;
    const double thick = 0.5 * (d[q->leg] + d[q->other]);
    bool apart = true;
    machine_iv m;
    machine_of(q->model, box, &m);
    const int before = used;
    for (int i = 0; i < PIECES * PIECES; i++, used = before) {
        const int at = i / PIECES;
        const double s = i % PIECES, t = at;
        iv far = distance_of(q, &m, between(s / PIECES, (s + 1) / PIECES),
                             between(t / PIECES, (t + 1) / PIECES));
        iv near = distance_of(q, &m, number_of(s / (PIECES - 1)), number_of(t / (PIECES - 1)));
        if (is_below(near, thick * thick * (1 - 1e-11))) return -1;
        apart &= is_above(far, thick * thick);
    }
    return apart;
}

/* rows: the direction of a leg, and its moment about the top frame's origin */
static void jacobian_of(const machine_iv *m, double size, iv J[6][6]) {
    for (int v = 0; v < GOUGH_LEGS; v++) {
        iv arm[3], n[3], moment[3];
        for (int i = 0; i < 3; i++) arm[i] = m->arm[v][i], n[i] = m->n[v][i];
        cross(arm, n, moment);
        for (int i = 0; i < 3; i++) J[v][i] = n[i], J[v][3 + i] = over(moment[i], number_of(size));
    }
}

static double size_of(const gough_model *model) {
    double sum = 0;
    for (int v = 0; v < GOUGH_LEGS; v++) {
        const double *b = model->machine.platform.top[v];
        sum += sqrt(b[0] * b[0] + b[1] * b[1] + b[2] * b[2]) / GOUGH_LEGS;
    }
    return sum;
}

/* JᵀJ − λ² has pivots above 0 only if all singular values exceed λ, and one below 0 if one of them is less */
static int value_is_kept(const question *q, const gough_box *box) {
    const double least = q->reach->asked.least_singular_value;
    iv J[6][6], G[6][6];
    machine_iv m;
    machine_of(q->model, box, &m);
    jacobian_of(&m, size_of(q->model), J);
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++) {
            G[i][j] = number_of(i == j ? -least * least : 0);
            for (int v = 0; v < 6; v++) G[i][j] = add(G[i][j], times(J[v][i], J[v][j]));
        }
    for (int k = 0; k < 6; k++) {
        if (is_below(G[k][k], -1e-11)) return -1;
        if (!is_above(G[k][k], 0)) return 0;
        for (int i = k + 1; i < 6; i++)
            for (int j = k + 1; j < 6; j++)
                G[i][j] = less(G[i][j], over(times(G[i][k], G[k][j]), G[k][k]));
    }
    return 1;
}

/* a matrix near the inverse of the transposed one at the middle of its intervals, by Gauss and Jordan */
static void near_inverse(iv J[6][6], double to[6][6]) {
    double A[6][12];
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++) A[i][j] = mpfi_get_d(J[j][i]), A[i][6 + j] = i == j;
    for (int k = 0; k < 6; k++) {
        int pivot = k;
        for (int i = k; i < 6; i++)
            if (fabs(A[i][k]) > fabs(A[pivot][k])) pivot = i;
        for (int j = 0; j < 12; j++) {
            const double swap = A[k][j];
            A[k][j] = A[pivot][j], A[pivot][j] = swap;
        }
        for (int i = 0; i < 6; i++) {
            const double part = i == k ? 1 - 1 / A[k][k] : A[i][k] / A[k][k];
            for (int j = 11; j >= k; j--) A[i][j] -= part * A[k][j];
        }
    }
    for (int i = 0; i < 6; i++) memcpy(to[i], A[i] + 6, sizeof to[i]);
}

/* (Σ f n, Σ f arm × n) = each of the wrenches, by elimination after a multiplication that brings the matrix near 1; false where a
 * pivot may be 0 */
static bool forces_of(iv J[6][6], iv wrench[6][LOADS], iv f[6][LOADS]) {
    iv A[6][6 + LOADS];
    double Y[6][6];
    near_inverse(J, Y);
    for (int i = 0; i < 6; i++) {
        for (int j = 0; j < 6 + LOADS; j++) {
            A[i][j] = number_of(0);
            for (int m = 0; m < 6; m++) {
                iv own = j < 6 ? J[j][m] : wrench[m][j - 6];
                A[i][j] = add(A[i][j], times(number_of(Y[i][m]), own));
            }
        }
    }
    for (int k = 0; k < 6; k++) {
        if (mpfi_has_zero(A[k][k])) return false;
        for (int i = k + 1; i < 6; i++) {
            iv part = over(A[i][k], A[k][k]);
            for (int j = k + 1; j < 6 + LOADS; j++) A[i][j] = less(A[i][j], times(part, A[k][j]));
        }
    }
    for (int e = 0; e < LOADS; e++)
        for (int k = 5; k >= 0; k--) {
            f[k][e] = A[k][6 + e];
            for (int j = k + 1; j < 6; j++) f[k][e] = less(f[k][e], times(A[k][j], f[j][e]));
            f[k][e] = over(f[k][e], A[k][k]);
        }
    return true;
}

/* What a load needs in all poses of a box: at rest under its weight, and with one acceleration of 1 in each component. */
static void wrenches_of(const question *q, const machine_iv *m, iv wrench[6][LOADS]) {
    const gough_load *load = &q->model->machine.load;
    iv center[3];
    for (int i = 0; i < 3; i++) {
        iv c[3], row[3];
        for (int k = 0; k < 3; k++) c[k] = number_of(load->center_of_mass[k]), row[k] = m->R[i][k];
        center[i] = dot(row, c);
    }
    for (int e = 0; e < LOADS; e++) {
        iv angular[3], force[3], moment[3];
        for (int i = 0; i < 3; i++) angular[i] = number_of(e == 4 + i);
        cross(angular, center, force);
        for (int i = 0; i < 3; i++) {
            const double along = e == 0 ? -q->model->machine.gravity[i] : e == 1 + i;
            force[i] = times(number_of(load->mass), add(force[i], number_of(along)));
        }
        cross(center, force, moment);
        for (int i = 0; i < 3; i++) {
            wrench[i][e] = force[i], wrench[3 + i][e] = moment[i];
            /* R I Rᵀ, its column of the axis that turns faster */
            for (int k = 0; k < 3 && e > 3; k++)
                for (int j = 0; j < 3; j++) {
                    iv own = times(number_of(load->inertia[k][j]), m->R[e - 4][j]);
                    wrench[3 + i][e] = add(wrench[3 + i][e], times(m->R[i][k], own));
                }
        }
    }
}

/* the greatest force over all accelerations: every pose has this much at least, and this much at most */
static int force_is_kept(const question *q, const gough_box *box) {
    const double limit = q->reach->limits.force[q->leg][1];
    const gough_workspace *w = &q->reach->asked;
    iv J[6][6], wrench[6][LOADS], f[6][LOADS];
    machine_iv m;
    machine_of(q->model, box, &m);
    jacobian_of(&m, 1, J);
    wrenches_of(q, &m, wrench);
    if (!forces_of(J, wrench, f)) return 0;
    iv sum = f[q->leg][0];
    for (int e = 1; e < LOADS; e++) {
        iv size = fresh();
        mpfi_abs(size, f[q->leg][e]);
        const double asked = e < 4 ? w->acceleration[e - 1] : w->angular_acceleration[e - 4];
        sum = add(sum, times(size, number_of(asked)));
    }
    return is_below(sum, limit) ? 1 : is_above(sum, limit * (1 + 1e-11)) ? -1 : 0;
}

/* parts of a box: bit 0 if the limit is proved to be kept in all poses of one of them, bit 1 if it is proved to be exceeded in all
 * poses of one */
static int prove_parts(const question *q, prover *prove, const gough_box *box, int *left) {
    int side = 0;
    used = q->kept;
    const int whole = prove(q, box);
    if (whole) return whole > 0 ? 1 : 2;
    if (--*left <= 0) return 0;
    for (int c = 1; c < GOUGH_COMPONENTS; c++)
        if (box->greatest[c] - box->least[c] > box->greatest[side] - box->least[side]) side = c;
    gough_box half[2] = {*box, *box};
    half[0].greatest[side] = half[1].least[side] = 0.5 * (box->least[side] + box->greatest[side]);
    const int one = prove_parts(q, prove, &half[0], left);
    return one | prove_parts(q, prove, &half[1], left);
}

/* ---- questions: a limit so near to what the centre of a box has that it may be kept or exceeded ---- */

typedef enum kind { SWING, CLEARANCE, VALUE, FORCE, KINDS } kind;
static prover *const provers[KINDS] = {swing_is_kept, clearance_is_kept, value_is_kept,
                                       force_is_kept};

static gough_box centre_of(const gough_box *box) {
    gough_box one;
    for (int c = 0; c < GOUGH_COMPONENTS; c++)
        one.least[c] = one.greatest[c] = 0.5 * (box->least[c] + box->greatest[c]);
    return one;
}

static void set_limit(kind k, question *q, gough_reach *reach, const gough_box *box, double off) {
    const gough_box one = centre_of(box);
    gough_envelope e;
    *reach = flight_reach(q->model);
    for (int v = 0; v < GOUGH_LEGS; v++) {
        reach->limits.length[v][0] = 0, reach->limits.length[v][1] = INFINITY;
        reach->limits.base_swing[v] = reach->limits.top_swing[v] = INFINITY;
    }
    ck_assert(gough_workspace_envelope(reach, &one, &e, NULL) == GOUGH_OK);
    if (k == SWING) {
        q->leg = e.of[GOUGH_WORST_TOP_SWING].leg;
        reach->limits.top_swing[q->leg] = e.of[GOUGH_WORST_TOP_SWING].sampled * off;
        reach->limits.base_swing[q->leg] = e.of[GOUGH_WORST_BASE_SWING].sampled * 2;
    } else if (k == CLEARANCE) {
        const double d = e.of[GOUGH_WORST_CLEARANCE].sampled / off;
        q->leg = e.of[GOUGH_WORST_CLEARANCE].leg;
        q->other = (q->leg + 1) % GOUGH_LEGS;
        reach->limits.diameter[q->leg] = reach->limits.diameter[q->other] = d;
    } else if (k == VALUE) {
        reach->asked.least_singular_value = e.of[GOUGH_WORST_SINGULAR_VALUE].sampled / off;
    } else {
        q->leg = e.of[GOUGH_WORST_PUSH].leg;
        reach->limits.force[q->leg][1] = e.of[GOUGH_WORST_PUSH].sampled * off;
    }
}

START_TEST(intervals_contradict_no_box) {
    static const char *const name[KINDS] = {"swing", "clearance", "least singular value", "force"};
    gough_model *model = malloc(sizeof *model);
    const gough_box home = {{0}, {0}};
    int proved[KINDS][2] = {{0}}, decided[KINDS] = {0};
    question q = {.model = model};
    gough_reach reach;
    dice d = {63};
    for (int i = 0; i < POOL; i++) mpfi_init2(pool[i], BITS);
    flight_machine(model);
    model->workspace =
        (gough_workspace){.acceleration = {3, 2, 4}, .angular_acceleration = {1, 1.5, 1}};
    for (int n = 0; n < KINDS * BOXES; n++) {
        const kind k = (kind)(n % KINDS);
        const double size = pow(10, dice_between(&d, -4, k == FORCE ? -2.5 : -1.7));
        gough_box box;
        for (int c = 0; c < GOUGH_COMPONENTS; c++) {
            const double at = dice_between(&d, -0.3, 0.3), half = size * dice_between(&d, 0.1, 0.4);
            box.least[c] = at - half, box.greatest[c] = at + half;
        }
        set_limit(k, &q, &reach, &box, 1 + size * dice_between(&d, -25, 25));
        used = 0;
        q.reach = &reach;
        int left = PARTS;
        const gough_verdict verdict = gough_box_test(&reach, &box, NULL);
        machine_of(model, &home, &q.home);
        q.kept = used;
        const int parts = prove_parts(&q, provers[k], &box, &left);
        ck_assert_msg(!(verdict == GOUGH_INSIDE && parts & 2) &&
                          !(verdict == GOUGH_OUTSIDE && parts & 1),
                      "%s, box %d of seed 63", name[k], n);
        proved[k][0] += parts & 1, proved[k][1] += parts >> 1;
        decided[k] += parts != 0 && verdict != GOUGH_UNDECIDED;
    }
    for (int k = 0; k < KINDS; k++) {
        printf("%s: parts proved to keep the limit %d, to exceed it %d; boxes decided by both %d\n",
               name[k], proved[k][0], proved[k][1], decided[k]);
        ck_assert(proved[k][0] > 6 && proved[k][1] > 6 && decided[k] > 12);
    }
    for (int i = 0; i < POOL; i++) mpfi_clear(pool[i]);
    free(model);
}
END_TEST

int main(void) { return SUITE_RUN("interval_limits", 120, intervals_contradict_no_box); }
