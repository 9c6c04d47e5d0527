/* All poses of six leg lengths: gough_poses_all(). Paths from a stored system to that of the machine (track.h), each end
 * certified by itself, (pose-4), in double and if need be in quadruple precision. Theory: docs/theory/pose.md. */
#define NUMBER_DOUBLE
#define SCALAR_COMPLEX
#include <stdbool.h>

#include "gough/pose.h"
#include "pose/frame.h"
#include "pose/point.h"
#include "pose/polish.h"
#include "pose/start_system.h"

/* most lanes in use; a build of which only narrow instances are instrumented sets it to 2 */
#ifndef GOUGH_WIDEST
#define GOUGH_WIDEST 8
#endif

/* systems from which paths are followed, one after the other while a doubt is left; corrections of Newton at an end */
enum { MIXINGS = 4, END_NEWTON = 8 };

/* |e·e| of |x|² = 1 below which a path that has no certified root ends at infinity */
static const double AT_INFINITY = 1e-3;
/* bounds of errors that double need not be improved on, in parts of the largest unknown; what |z| is at least of |re| + |im| */
static const double ROUNDED = 1e-15, MODULUS = 0.7;

/* A certified root in the chart in which its largest unknown is 1. */
typedef struct {
    scalar x[SOMA];
    int chart;
    double r; /* the root is within this of x */
    double u; /* and no other is within this */
    bool real;
} root;

typedef struct {
    const gough_machine *machine;
    const double *length;
    pose_frame frame;
    soma_legs legs;
    root root[GOUGH_POSES];
    int count;
} search;

/* ---- the system ---- */

/* (pose-2) with lengths */
static void rows_of_machine(search *s) {
    for (int v = 0; v < GOUGH_LEGS; v++) {
        const double l = s->length[v] / s->frame.scale;
        double b[3], a[3];
        pose_frame_joints(&s->frame, s->machine, v, b, a);
        soma_row(b, a, s->legs.row[v]);
        for (int n = 0; n < 4; n++) s->legs.row[v][n] -= l * l;
    }
    soma_legs_bound(&s->legs);
}

/* rows of one size at right angles; what matters is the space that they span */
static void orthonormal(const soma_legs *m, double row[SOMA_LEGS][PRODUCTS]) {
    for (int v = 0; v < SOMA_LEGS; v++) {
        memcpy(row[v], m->row[v], sizeof row[v]);
        for (int twice = 0; twice < 2; twice++) {
            double square = 0;
            for (int w = 0; w < v; w++) {
                double dot = 0;
                for (int n = 0; n < PRODUCTS; n++) dot += row[w][n] * row[v][n];
                for (int n = 0; n < PRODUCTS; n++) row[v][n] -= dot * row[w][n];
            }
            for (int n = 0; n < PRODUCTS; n++) square += row[v][n] * row[v][n];
            for (int n = 0; n < PRODUCTS; n++) row[v][n] /= sqrt(square);
        }
    }
}

/* The rows times a unitary matrix of Fourier, columns turned by the angle of 3 + 4i as often as the mixing says: other
 * paths to the same roots. */
static void mixed_system(const soma_legs *m, int mixing, path_system *to) {
    static const double cosine[6] = {1, 0.5, -0.5, -1, -0.5, 0.5};
    const double half = sqrt(3.0) / 2, sine[6] = {0, half, half, 0, -half, -half};
    double row[SOMA_LEGS][PRODUCTS];

    orthonormal(m, row);
    memset(to, 0, sizeof *to);
    for (int v = 0; v < SOMA_LEGS; v++) {
        for (int w = 0; w < SOMA_LEGS; w++) {
            scalar u = {cosine[v * w % 6] / sqrt(6.0), sine[v * w % 6] / sqrt(6.0)};
            for (int k = 0; k < mixing * w; k++) u = times(u, (scalar){0.6, 0.8});
            for (int n = 0; n < PRODUCTS; n++) {
                to->c[v][n][0] += u.re * row[w][n];
                to->c[v][n][1] += u.im * row[w][n];
            }
        }
    }
}

static path_tracker *widest_tracker(void) {
#if defined(__x86_64__)
    const int f = __builtin_cpu_supports("avx512f"), dq = __builtin_cpu_supports("avx512dq");
    if (GOUGH_WIDEST >= 8 && f && dq && __builtin_cpu_supports("avx512vl"))
        return path_track_8; /* unreachable: a processor takes only one way */
    const int avx2 = __builtin_cpu_supports("avx2");
    if (GOUGH_WIDEST >= 4 && avx2)
        return path_track_4; /* unreachable: a processor takes only one way */
#endif
    return path_track_2;
}

/* ---- ends ---- */

/* the chart of the largest unknown; its |e·e| of |x|² = 1 is returned */
static double take_chart(const path_point *p, root *z) {
    double largest = 0, square = 0;
    scalar ee = scalar_of(0);

    for (int k = 0; k < SOMA; k++) {
        z->x[k] = (scalar){p->x[k][0], p->x[k][1]};
        const double size = square_magnitude(z->x[k]);
        square += size;
        if (k < 4) ee = plus(ee, times(z->x[k], z->x[k]));
        if (size > largest) largest = size, z->chart = k;
    }
    const scalar inverse = reciprocal(z->x[z->chart]);
    for (int k = 0; k < SOMA; k++) z->x[k] = times(z->x[k], inverse);
    z->x[z->chart] = scalar_of(1);
    return sqrt(square_magnitude(ee)) / square;
}

static void end_newton(const soma_legs *m, root *z) {
    double last = 1;

    for (int n = 0; n < END_NEWTON && last > 1e-14 && last < 2; n++) {
        scalar d[SOMA];
        eight f;
        soma_jacobian(m, z->x, z->chart, f.a, d);
        d[7] = minus(d[7], scalar_of(1));
        eight_factor(&f);
        eight_solve(&f, d);
        for (int k = 0; k < SOMA; k++) z->x[k] = minus(z->x[k], d[k]);
        z->x[z->chart] = scalar_of(1);
        last = soma_largest(d);
    }
}

/* (pose-4): r and u; false if they are not certain */
static bool certify(double epsilon, double kappa, double beta, root *z) {
    const double sure = 1 - epsilon, under = sure * sure - 4 * beta * kappa;

    if (!(sure > 0 && under > 0)) return false;
    z->r = 2 * beta / (sure + sqrt(under));
    z->u = sure / (2 * kappa);
    return true;
}

/* How much work a certificate is given: where a path stopped early and seems to end at infinity, double precision is enough. */
typedef enum { DOUBLE_ONLY, IF_NEEDED, BEST } effort;

/* r and u at x, which quadruple precision moves if double cannot certify it, or not as well as is asked for */
static bool certify_at(const search *s, effort how, root *z) {
    soma_point p;
    pose_root q = {.chart = z->chart};
    double beta = 0;

    soma_point_at(&s->legs, z->x, z->chart, &p);
    p.value[7] = scalar_of(0);
    for (int i = 0; i < SOMA; i++)
        beta = larger_or_nan(beta, magnitude(soma_dot(p.Y[i], p.value, SOMA)));
    const double largest = soma_largest(z->x);
    beta += p.size * p.rounding * largest * largest;
    if (certify(p.epsilon, p.kappa, beta, z) && !(how == BEST && z->r > ROUNDED)) return true;

    if (how == DOUBLE_ONLY || !(p.epsilon < 1)) return false;
    q.size = p.size;
    for (int i = 0; i < SOMA; i++) {
        q.x[i][0] = z->x[i].re, q.x[i][1] = z->x[i].im;
        for (int k = 0; k < SOMA; k++) q.Y[i][k][0] = p.Y[i][k].re, q.Y[i][k][1] = p.Y[i][k].im;
    }
    pose_polish(s->machine, &s->frame, s->length, &q);
    if (!certify(p.epsilon + 2 * p.kappa * q.far, p.kappa, q.beta, z)) return false;
    for (int k = 0; k < SOMA; k++) z->x[k] = (scalar){q.x[k][0], q.x[k][1]};
    z->r += q.off, z->u -= q.off;
    return z->u > z->r;
}

static double largest_imaginary(const root *z) {
    double most = 0;

    for (int k = 0; k < SOMA; k++) most = fmax(most, fabs(z->x[k].im));
    return most;
}

/* e·e of the root itself is not 0: it is a pose */
static bool has_rotation(const root *z) {
    double sum = 0;

    for (int k = 0; k < 4; k++) sum += magnitude(z->x[k]);
    return MODULUS * magnitude(soma_dot(z->x, z->x, 4)) > 2 * z->r * sum + 4 * z->r * z->r + 1e-15;
}

/* The root at the end of a path, certified; and whether it is real: the equations are real, so that a root within a ball about a
 * real point in which it is alone is its own conjugate. Returns false where a root cannot be certified. */
static bool end_root(const search *s, const path_end *end, root *z) {
    const bool infinite = take_chart(&end->at, z) < AT_INFINITY && end->left > 0;

    end_newton(&s->legs, z);
    z->real = false;
    if (!certify_at(s, infinite ? DOUBLE_ONLY : IF_NEEDED, z)) return false;
    if (!has_rotation(z) && !certify_at(s, BEST, z)) return false;
    if (!(largest_imaginary(z) > z->r)) {
        for (int k = 0; k < SOMA; k++) z->x[k].im = 0;
        if (!certify_at(s, BEST, z)) return false;
        z->real = true;
    }
    return has_rotation(z);
}

/* whether two certified roots are certainly two: some a_i b_j − a_j b_i is not 0 */
static bool distinct(const root *a, const root *b) {
    for (int i = 0; i < SOMA; i++) {
        for (int j = 0; j < i; j++) {
            const scalar minor = minus(times(a->x[i], b->x[j]), times(a->x[j], b->x[i]));
            const double error = a->r * (magnitude(b->x[i]) + magnitude(b->x[j]) + 2 * b->r) +
                                 b->r * (magnitude(a->x[i]) + magnitude(a->x[j])) + 1e-15;
            if (MODULUS * magnitude(minor) > error) return true;
        }
    }
    return false;
}

/* adds a root unless it may be one that is known; returns whether it did */
static bool add_root(search *s, const root *z) {
    for (int i = 0; i < s->count; i++)
        if (!distinct(&s->root[i], z)) return false;
    if (s->count == GOUGH_POSES) return false;
    s->root[s->count++] = *z;
    return true;
}

/* the conjugate of a root is a root, as certain as itself */
static void add_conjugates(search *s) {
    for (int i = 0, count = s->count; i < count; i++) {
        root z = s->root[i];
        if (z.real) continue;
        for (int k = 0; k < SOMA; k++) z.x[k] = conjugate(z.x[k]);
        add_root(s, &z);
    }
}

/* ---- poses ---- */

/* (pose-9), (pose-10): with |e| of the chart */
static void pose_of_root(const search *s, const root *z, gough_pose *pose) {
    gough_state state = gough_state_home(s->machine);
    double x[SOMA], square = 0;

    for (int k = 0; k < SOMA; k++) x[k] = z->x[k].re;
    for (int k = 0; k < 4; k++) square += x[k] * x[k];
    const double size = sqrt(square), rounding = 8 * REAL_EPSILON;
    const double distance = pose_of_soma(&s->frame, x, state.position, state.rotation);
    pose_errors(&s->frame, z->r / size + rounding * (1 + distance), distance, &pose->position_error,
                &pose->angle_error);
    pose_unique(&s->frame, z->u / (size * (2 + z->u)), distance, &pose->unique_position,
                &pose->unique_angle);
    pose->position_error += rounding * pose_norm(s->frame.base);
    memcpy(pose->position, state.position, sizeof state.position);
    memcpy(pose->rotation, state.rotation, sizeof state.rotation);
    gough_conditioning(s->machine, &state, &pose->condition, &pose->determinant);
}

/* distance from home */
static double from_home(const search *s, const gough_pose *pose) {
    const double height = s->machine->platform.height;
    const double d[3] = {pose->position[0], pose->position[1], pose->position[2] - height};
    double trace = 0, skew[3], radius = 0;

    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        trace += pose->rotation[k][k];
        skew[k] = pose->rotation[j][i] - pose->rotation[i][j];
    }
    for (int v = 0; v < GOUGH_LEGS; v++) {
        const double *top = s->machine->platform.top[v], *c = s->frame.top;
        radius += pose_norm((const double[3]){top[0] - c[0], top[1] - c[1], top[2] - c[2]}) / 6;
    }
    return pose_norm(d) + radius * atan2(pose_norm(skew), trace - 1);
}

/* the real poses in order of their distance from home; the sum of the signs of their determinants is returned */
static int put_poses(const search *s, gough_pose pose[GOUGH_POSES], int *count) {
    double distance[GOUGH_POSES];
    int sum = 0;

    *count = 0;
    for (int i = 0; i < s->count; i++) {
        gough_pose p;
        if (!s->root[i].real) continue;
        pose_of_root(s, &s->root[i], &p);
        const double d = from_home(s, &p);
        int at = (*count)++;
        for (; at > 0 && distance[at - 1] > d; at--) {
            distance[at] = distance[at - 1];
            pose[at] = pose[at - 1];
        }
        distance[at] = d, pose[at] = p;
        sum += (p.determinant > 0) - (p.determinant < 0);
    }
    return sum;
}

/* ---- all of them ---- */

/* Follows the paths once; false if a doubt is left. */
static bool follow_paths(search *s, int mixing, gough_poses *found) {
    path_end end[PATHS];
    path_system to;
    const int known = s->count;
    int added = 0, reached = 0;

    mixed_system(&s->legs, mixing, &to);
    widest_tracker()(&start_system, &to, start_root, PATHS, end);
    found->infinite = found->singular = 0;
    for (int i = 0; i < PATHS; i++) {
        root z;
        found->steps += end[i].steps;
        if (end_root(s, &end[i], &z)) {
            reached++;
            added += add_root(s, &z);
        } else if (take_chart(&end[i].at, &z) < AT_INFINITY) {
            found->infinite++;
        } else {
            found->singular++;
        }
    }
    /* two paths at one root, or a root without its conjugate: one was missed */
    const int sure = s->count;
    add_conjugates(s);
    return found->singular == 0 && (known > 0 || added == reached) && sure == s->count;
}

static gough_status nothing_found(const gough_poses *found, gough_error *error) {
    if (found->complete == GOUGH_COMPLETE_NO)
        return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                          "no real pose with these lengths could be certified, and %d of 40 paths "
                          "ended in doubt: the poses may be singular, or form a curve",
                          found->singular);
    return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                      "no pose of this machine has these lengths: all %d are complex",
                      found->nonreal);
}

gough_status gough_poses_all(const gough_machine *machine, const double length[GOUGH_LEGS],
                             gough_pose pose[GOUGH_POSES], gough_poses *found, gough_error *error) {
    const gough_status status = pose_check_lengths(length, error);
    search s = {.machine = machine, .length = length};
    gough_poses f = {.real = 0};
    bool settled = false;

    if (status) return status;
    s.frame = pose_frame_of(machine, length);
    rows_of_machine(&s);
    while (!settled && s.count < GOUGH_POSES && f.mixings < MIXINGS) {
        settled = follow_paths(&s, f.mixings++, &f);
        settled = put_poses(&s, pose, &f.real) == 0 && settled;
    }
    f.nonreal = s.count - f.real;
    if (s.count == GOUGH_POSES)
        f.complete = GOUGH_COMPLETE_PROVED, f.infinite = f.singular = 0;
    else if (settled && s.count + f.infinite == GOUGH_POSES)
        f.complete = GOUGH_COMPLETE_COUNTED;
    else
        f.singular = GOUGH_POSES - s.count - f.infinite;
    *found = f;
    return f.real > 0 ? GOUGH_OK : nothing_found(&f, error);
}

const char *gough_completeness_name(gough_completeness complete) {
    switch (complete) {
    case GOUGH_COMPLETE_NO:
        return "no";
    case GOUGH_COMPLETE_COUNTED:
        return "counted";
    case GOUGH_COMPLETE_PROVED:
        return "proved";
    case GOUGH_COMPLETENESSES:
        break;
    }
    return "unknown";
}
