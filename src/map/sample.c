/* Multipliers of one monodromy matrix: what grows, and the phases of the first kind. Theory: docs/theory/floquet.md. */
#include "map/sample.h"

#include <lapacke.h>
#include <math.h>
#include <string.h>

#include "floquet/spectrum.h"

enum { N = GOUGH_LINEAR, WORK = 40 * GOUGH_LINEAR };

static const double pi = 3.14159265358979323846;

/* Multipliers on the circle this close to each other have no vectors of their own, only a space: its form tells how many of
 * either kind they are. Errors of Φ (1e-11, say) turn vectors by their ratio to the distance. */
static const double same_place = 3e-5;

/* Off the circle two equal real multipliers, of a machine that sways alike in two directions, come out as a conjugate pair by
 * rounding, which near an edge is the root of the errors of Φ: this close to the real axis a pair is taken for two real ones. */
static const double same_real = 3e-5;

/* elements of Φ up to this leave to multipliers near 1 more digits than they are asked for */
static const double moderate = 1e5;

/* through the factors of a larger Φ: parts magnitudes that differ by a factor of 10 */
enum { SWEEPS = 12 };

/* of what does not count, in a mode that does */
static const double other_share = 1e-3;

/* Multipliers with their vectors. */
typedef struct {
    double re[N], im[N];
    double complex vector[N][N];
} multipliers;

/* ---- the form ---- */

void symplectic_at(const gough_machine *machine, const gough_state *state, symplectic *form) {
    form->mass = machine->load.mass;
    linear_inertia(machine, state, form->inertia);
    for (int r = 0; r < 3; r++) {
        form->velocity[r] = state->angular_velocity[r];
        form->momentum[r] = 0;
        for (int c = 0; c < 3; c++)
            form->momentum[r] += form->inertia[r][c] * state->angular_velocity[c];
    }
    form->heavy = machine->platform.legs_have_mass;
    if (form->heavy) linear_complex.momenta(machine, state, form->change, form->momentum);
}

static void cross_complex(const double complex a[3], const double complex b[3],
                          double complex out[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

/* δp = M δv, δL = J δω + δθ × L − J (δθ × ω), and with legs that have mass their derivatives */
static void momenta(const symplectic *f, const double complex xi[N], double complex p[6]) {
    double complex omega[3], L[3], turned[3], moved[3];

    for (int i = 0; i < 6 && f->heavy; i++) {
        p[i] = 0;
        for (int k = 0; k < N; k++) p[i] += f->change[i][k] * xi[k];
    }
    if (f->heavy) return;
    for (int i = 0; i < 3; i++) omega[i] = f->velocity[i], L[i] = f->momentum[i];
    cross_complex(xi + 3, L, turned);
    cross_complex(xi + 3, omega, moved);
    for (int i = 0; i < 3; i++) {
        p[i] = f->mass * xi[6 + i];
        p[3 + i] = turned[i];
        for (int j = 0; j < 3; j++) p[3 + i] += f->inertia[i][j] * (xi[9 + j] - moved[j]);
    }
}

double complex symplectic_product(const symplectic *f, const double complex xi[N],
                                  const double complex eta[N]) {
    double complex p[6], r[6], first[3], both[3], sum = 0;

    momenta(f, xi, p);
    momenta(f, eta, r);
    for (int i = 0; i < 6; i++) sum += conj(xi[i]) * r[i] - conj(p[i]) * eta[i];
    for (int i = 0; i < 3; i++) first[i] = conj(xi[3 + i]);
    cross_complex(first, eta + 3, both);
    for (int i = 0; i < 3; i++) sum -= f->momentum[i] * both[i];
    return -I * sum;
}

/* ---- what grows ---- */

bool sample_counts(const gough_mode *mode, unsigned modes) {
    double others = 0, all = 0;

    for (int k = 0; k < 4; k++) {
        all += mode->share[k];
        if (!(modes & 1U << k)) others += mode->share[k];
    }
    return modes == 0 || (all > 0 && others <= other_share);
}

void sample_begin(sample *s, double stiffness, unsigned modes) {
    memset(s, 0, sizeof *s);
    s->modes = modes;
    s->stiffness = stiffness;
    s->size = -INFINITY;
    s->stable = true;
}

void sample_add(sample *s, const double value[2], double size, double limit,
                const gough_mode *mode) {
    int place;

    if (!sample_counts(mode, s->modes)) return;
    if (size > s->size) {
        s->size = size;
        s->mode = *mode;
    }
    if (!(size > limit)) return;
    s->stable = false;
    if (value[1] < 0 || s->growers == N) return;
    for (place = s->growers++; place > 0 && s->grows[place - 1].size < size; place--)
        s->grows[place] = s->grows[place - 1];
    s->grows[place] = (grower){{value[0], value[1]}, size, *mode};
}

int grower_kind(const grower *g) { return g->value[1] > 0 ? 2 : g->value[0] < 0 ? 1 : 0; }

/* ---- phases ---- */

typedef struct {
    double angle; /* in (0, π) */
    double complex vector[N];
} turning;

/* the vectors of a cluster made orthogonal and of length 1; those that depend on the others are left out */
static int orthonormal(const turning *cluster, int count, double complex base[][N]) {
    int found = 0;

    for (int v = 0; v < count; v++) {
        double size = 0;
        memcpy(base[found], cluster[v].vector, sizeof base[found]);
        for (int sweep = 0; sweep < 2; sweep++) {
            for (int b = 0; b < found; b++) {
                double complex along = 0;
                for (int i = 0; i < N; i++) along += conj(base[b][i]) * base[found][i];
                for (int i = 0; i < N; i++) base[found][i] -= along * base[b][i];
            }
        }
        for (int i = 0; i < N; i++) size += creal(base[found][i] * conj(base[found][i]));
        size = sqrt(size);
        if (!(size > 1e-9)) continue;
        for (int i = 0; i < N; i++) base[found][i] /= size;
        found++;
    }
    return found;
}

/* how many multipliers of a cluster are of the first kind: positive eigenvalues of the form on their space */
static int first_kind(const symplectic *form, const turning *cluster, int count) {
    double complex base[N][N], h[N * N], work[WORK];
    double value[N], rwork[3 * N];
    const int found = orthonormal(cluster, count, base);
    int first = 0;

    for (int j = 0; j < found; j++) {
        for (int i = 0; i < found; i++)
            h[found * j + i] = symplectic_product(form, base[i], base[j]);
    }
    if (LAPACKE_zheev_work(LAPACK_COL_MAJOR, 'N', 'U', found, h, found, value, work, WORK, rwork) !=
        0)
        return count;
    for (int i = 0; i < found; i++) first += value[i] > 0;
    return first + (count - found + 1) / 2; /* one that coincides with another is its opposite */
}

static void put_phase(sample *s, int *count, double angle, bool off) {
    int place;

    if (*count == MODES) {
        s->phased = false;
        return;
    }
    if (angle >= 2 * pi) angle -= 2 * pi;
    for (place = (*count)++; place > 0 && s->phase[place - 1] > angle; place--) {
        s->phase[place] = s->phase[place - 1];
        s->off[place] = s->off[place - 1];
    }
    s->phase[place] = angle;
    s->off[place] = off;
}

/* (floquet-22) for what is on the circle, in (0, π) by rising angle, cluster by cluster */
static void put_turning(sample *s, const symplectic *form, const turning *t, int turnings,
                        int *count) {
    for (int from = 0, to; from < turnings; from = to) {
        int first;
        for (to = from + 1; to < turnings && t[to].angle - t[to - 1].angle < same_place;) to++;
        first = first_kind(form, t + from, to - from);
        for (int v = from; v < to; v++)
            put_phase(s, count, v - from < first ? t[v].angle : 2 * pi - t[v].angle, false);
    }
}

static void put_phases(sample *s, const symplectic *form, const multipliers *m) {
    turning t[MODES + 1];
    int turnings = 0, count = 0, positive = 0, negative = 0;

    s->phased = true;
    for (int i = 0; i < N; i++) {
        const double size = log(hypot(m->re[i], m->im[i])), angle = atan2(m->im[i], m->re[i]);
        int place;
        if (m->im[i] < 0) continue;
        if (!(m->im[i] > 0)) {
            positive += m->re[i] > 0;
            negative += m->re[i] < 0;
        } else if (size > GOUGH_GROWTH_LIMIT) {
            put_phase(s, &count, angle, true);
            put_phase(s, &count, 2 * pi - angle, true);
        } else if (size >= -GOUGH_GROWTH_LIMIT && turnings < MODES) {
            for (place = turnings++; place > 0 && t[place - 1].angle > angle; place--)
                t[place] = t[place - 1];
            t[place].angle = angle;
            memcpy(t[place].vector, m->vector[i], sizeof t[place].vector);
        }
    }
    for (int i = 0; i + 1 < positive; i += 2) put_phase(s, &count, 0, true);
    for (int i = 0; i + 1 < negative; i += 2) put_phase(s, &count, pi, true);
    put_turning(s, form, t, turnings, &count);
    if (count != MODES) s->phased = false;
}

/* ---- all of it ---- */

/* conjugate pairs that are two real multipliers: their vectors then are the real and the imaginary part */
static void split_pairs(multipliers *m) {
    for (int i = 0; i < N; i++) {
        const double re = m->re[i], im = m->im[i];
        if (fabs(im) > same_real * fabs(re) || !(fabs(im) > 0)) continue;
        if (fabs(log(hypot(re, im))) <= GOUGH_GROWTH_LIMIT) continue;
        for (int k = 0; k < N; k++)
            m->vector[i][k] = im > 0 ? creal(m->vector[i][k]) : cimag(m->vector[i][k]);
        m->im[i] = 0;
    }
}

static void fill(const gough_machine *machine, const symplectic *form, multipliers *m, sample *s) {
    split_pairs(m);
    for (int i = 0; i < N; i++) {
        const double value[2] = {m->re[i], m->im[i]}, size = log(hypot(value[0], value[1]));
        gough_mode mode;
        if (!(size > GOUGH_GROWTH_LIMIT) && !(size > s->size)) continue;
        mode_of(machine, m->vector[i], &mode);
        sample_add(s, value, size, GOUGH_GROWTH_LIMIT, &mode);
    }
    if (form) put_phases(s, form, m);
}

void sample_no_values(sample *s, double stiffness) {
    sample_begin(s, stiffness, s->modes);
    s->size = NAN;
    s->stable = false;
}

bool sample_monodromy(const gough_machine *machine, const symplectic *form, double stiffness,
                      unsigned modes, double *phi, sample *s) {
    double vectors[N * N], work[WORK];
    multipliers m;

    for (int i = 0; i < N * N; i++) {
        if (!(fabs(phi[i]) <= moderate)) return false;
    }
    sample_begin(s, stiffness, modes);
    if (LAPACKE_dgeev_work(LAPACK_COL_MAJOR, 'N', 'V', N, phi, N, m.re, m.im, NULL, N, vectors, N,
                           work, WORK) != 0) {
        sample_no_values(s, stiffness);
        return true;
    }
    /* LAPACK packs real and imaginary part of the vectors of a conjugate pair one after the other */
    for (int i = 0; i < N; i++) {
        const int real = m.im[i] < 0 ? i - 1 : i;
        for (int k = 0; k < N; k++) {
            m.vector[i][k] = vectors[N * real + k];
            if (m.im[i] > 0) m.vector[i][k] += I * vectors[N * (real + 1) + k];
            if (m.im[i] < 0) m.vector[i][k] -= I * vectors[N * (real + 1) + k];
        }
    }
    fill(machine, form, &m, s);
    return true;
}

void sample_factors(const gough_machine *machine, const symplectic *form, double stiffness,
                    unsigned modes, const double (*factor)[N * N], size_t count, sample *s) {
    spectrum found;
    multipliers m;

    sample_begin(s, stiffness, modes);
    if (spectrum_of_factors(factor[0], (size_t)N * N, N, count, SWEEPS, &found, NULL) != GOUGH_OK) {
        sample_no_values(s, stiffness);
        return;
    }
    for (int i = 0; i < N; i++) {
        m.re[i] = creal(found.value[i]);
        m.im[i] = cimag(found.value[i]);
        memcpy(m.vector[i], found.vector[i], sizeof m.vector[i]);
    }
    fill(machine, form, &m, s);
}
