/* Angles of recorded motion about turned axes, (motion-10). Roll, pitch and yaw cannot follow a motion close to a pitch of
 * ±90°. About axes that are turned by a constant rotation F the same motion has other angles, R = F Rz Ry Rx Fᵀ, whose own pole
 * is where the axis R F e_x is parallel to F e_z. Of a fixed set of F the one is taken whose pole is farthest from all rows. */
#define NUMBER_DOUBLE
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "program/angles.h"

/* The candidates are quaternions of whole numbers: 40 with numbers up to 1 in magnitude, among them all exchanges of axes, and
 * 272 up to 2. */
enum { FEW = 1, ALL = 2, CANDIDATES = 272 };

/* the few are enough if one keeps all rows at least 30° away from its pole: sin 60° */
static const double far_enough = 0.866;

/* a later candidate must be better by this to be taken: which one it is must not depend on rounding */
static const double better = 1e-6;

typedef struct {
    double axes[4];
    double x[3], z[3]; /* F e_x, F e_z */
    double nearest;    /* largest |F e_z · R F e_x| so far: the sine of the second angle */
} candidate;

static void fill(candidate *c, const int q[4]) {
    double F[3][3];
    *c = (candidate){.axes = {q[0], q[1], q[2], q[3]}, .nearest = 0};
    rotation_of_axes(c->axes, F);
    for (int r = 0; r < 3; r++) c->x[r] = F[r][0], c->z[r] = F[r][2];
}

/* whether a quaternion is the one of its multiples that is taken: the first number that is not 0 is positive, and not all are
 * even, so that 0 is not taken */
static int chosen(const int q[4]) {
    int odd = 0, first = 0;
    for (int i = 3; i >= 0; i--) {
        odd |= q[i] % 2;
        if (q[i] != 0) first = q[i];
    }
    return first > 0 && odd != 0;
}

/* the largest magnitude of its numbers */
static int reach_of(const int q[4]) {
    int most = 0;
    for (int i = 0; i < 4; i++) {
        const int size = q[i] < 0 ? -q[i] : q[i];
        most = size > most ? size : most;
    }
    return most;
}

/* all with numbers up to `reach`, smaller ones first: (1, 1, 1, 1), which exchanges the axes cyclically, is the very first */
static int list_candidates(int reach, candidate list[CANDIDATES]) {
    int count = 0;
    for (int size = 1; size <= reach; size++) {
        const int side = 2 * size + 1;
        for (int code = 0; code < side * side * side * side; code++) {
            int q[4], rest = code;
            for (int i = 3; i >= 0; i--, rest /= side) q[i] = size - rest % side;
            if (!chosen(q) || reach_of(q) != size) continue;
            assert_true(count < CANDIDATES);
            fill(&list[count++], q);
        }
    }
    return count;
}

static void rotation_of_row(const double *value, size_t row, double half_turn, jet R[3][3]) {
    const double *angle = value + row * GOUGH_COMPONENTS + GOUGH_ROLL;
    jet a[3];
    for (int i = 0; i < 3; i++) a[i] = jet_constant(angle[i] * (REAL_PI / half_turn));
    rotation_jets(a[0], a[1], a[2], R);
}

/* the sine of the second angle of a rotation about the axes of a candidate */
static double sine(const candidate *c, const jet R[3][3]) {
    double sum = 0;
    for (int r = 0; r < 3; r++)
        sum += c->z[r] * (R[r][0].v * c->x[0] + R[r][1].v * c->x[1] + R[r][2].v * c->x[2]);
    return fabs(sum);
}

static const candidate *best_of(size_t count, const double *value, double half_turn, int candidates,
                                candidate list[CANDIDATES]) {
    const candidate *best = list;
    for (size_t i = 0; i < count; i++) {
        jet R[3][3];
        rotation_of_row(value, i, half_turn, R);
        for (int k = 0; k < candidates; k++) {
            const double near = sine(&list[k], (const jet(*)[3])R);
            if (near > list[k].nearest) list[k].nearest = near;
        }
    }
    for (int k = 1; k < candidates; k++)
        if (list[k].nearest < best->nearest - better) best = &list[k];
    return best;
}

double gough_samples_axes(size_t count, const double *value, double half_turn, double axes[4]) {
    candidate list[CANDIDATES];
    const candidate *best = best_of(count, value, half_turn, list_candidates(FEW, list), list);
    if (best->nearest > far_enough)
        best = best_of(count, value, half_turn, list_candidates(ALL, list), list);
    memcpy(axes, best->axes, sizeof best->axes);
    return acos(fmin(1, best->nearest)) * (half_turn / REAL_PI);
}

void gough_samples_turn(size_t count, double *value, double half_turn, const double axes[4]) {
    const double back[4] = {axes[0], -axes[1], -axes[2], -axes[3]}; /* Fᵀ R F */
    for (size_t i = 0; i < count; i++) {
        double *angle = value + i * GOUGH_COMPONENTS + GOUGH_ROLL;
        jet R[3][3], turned[3];
        rotation_of_row(value, i, half_turn, R);
        rotation_turn(back, R);
        rotation_angle_jets((const jet(*)[3])R, turned);
        for (int a = 0; a < 3; a++) angle[a] = turned[a].v * (half_turn / REAL_PI);
    }
}
