/* Newton's and Euler's equations of thirteen rigid bodies with the reactions of their joints; see thirteen_bodies.h. */
#include "independent/thirteen_bodies.h"

#include <math.h>
#include <string.h>

/* Columns of a leg's block, after 26 times the number of the leg: accelerations of both parts,
 * reactions, force in the rod, second rate of the length. The rows are the equations in the same
 * order: Newton and Euler of both parts, the constraint of each reaction, the rod's acceleration,
 * the leg force. The load comes after the legs, then the leg forces, then the right side. */
enum {
    OF_CYLINDER = 0,
    OF_PISTON = 6,
    BASE_JOINT = 12,
    TOP_JOINT = 15,
    TILT = 18, /* torques between the parts: same axis, no relative spin */
    SIDE = 21, /* forces between the parts across the axis */
    SPIN = 23, /* torque that keeps the cylinder from turning about its axis */
    ROD = 24,
    STRETCH = 25,
    BLOCK = 26,
    OF_LOAD = 6 * BLOCK,
    UNKNOWNS = OF_LOAD + 6,
    LEG_FORCE = UNKNOWNS,
    RIGHT = LEG_FORCE + 6,
    WIDTH
};

typedef double equations[UNKNOWNS][WIDTH];

/* ---- vectors and matrices ---- */

static double inner(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void outer(const double a[3], const double b[3], double out[3]) {
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static void times(const double A[3][3], const double v[3], double out[3]) {
    for (int i = 0; i < 3; i++) out[i] = inner(A[i], v);
}

/* w × (w × r) */
static void centripetal(const double w[3], const double r[3], double out[3]) {
    double turn[3];
    outer(w, r, turn);
    outer(w, turn, out);
}

/* Gaussian elimination with partial pivoting over the unknowns' columns; columns that a pivot's row
 * does not have are left alone. Solution in x. */
static void eliminate(equations A, double x[UNKNOWNS]) {
    for (int c = 0; c < UNKNOWNS; c++) {
        int best = c, has[WIDTH], count = 0;
        for (int r = c + 1; r < UNKNOWNS; r++)
            if (fabs(A[r][c]) > fabs(A[best][c])) best = r;
        for (int k = c; k < WIDTH; k++) {
            const double swap = A[c][k];
            A[c][k] = A[best][k];
            A[best][k] = swap;
            if (A[c][k] != 0) has[count++] = k;
        }
        for (int r = c + 1; r < UNKNOWNS; r++) {
            if (A[r][c] == 0) continue;
            const double factor = A[r][c] / A[c][c];
            for (int k = 0; k < count; k++) A[r][has[k]] -= factor * A[c][has[k]];
        }
    }
    for (int r = UNKNOWNS - 1; r >= 0; r--) {
        x[r] = A[r][RIGHT];
        for (int k = r + 1; k < UNKNOWNS; k++) x[r] -= A[r][k] * x[k];
        x[r] /= A[r][r];
    }
}

/* ---- the motion of the bodies ---- */

typedef struct leg_axis {
    double n[3], omega[3]; /* direction from base to top; a leg does not spin about it */
    double length, rate;
} leg_axis;

/* The load from the state, whose acceleration is not known yet; joint is relative to the centre. */
static void place_load(const thirteen_bodies *m, const gough_state *s, rigid_body *load,
                       double joint[6][3]) {
    double arm[3], turn[3], half[3][3];
    load->mass = m->load.mass;
    times(s->rotation, m->load.center_of_mass, arm);
    outer(s->angular_velocity, arm, turn);
    for (int i = 0; i < 3; i++) {
        load->x[i] = s->position[i] + arm[i];
        load->v[i] = s->velocity[i] + turn[i];
        load->omega[i] = s->angular_velocity[i];
    }
    for (int k = 0; k < 6; k++) {
        times(s->rotation, m->platform.top[k], joint[k]);
        for (int i = 0; i < 3; i++) joint[k][i] -= arm[i];
    }
    /* R J Rᵀ, J symmetric */
    for (int i = 0; i < 3; i++) times(m->load.inertia, s->rotation[i], half[i]);
    for (int i = 0; i < 3; i++) times(s->rotation, half[i], load->inertia[i]);
}

static leg_axis axis_of(const double base[3], const double top[3], const double velocity[3]) {
    leg_axis g;
    double along[3], across[3];
    for (int i = 0; i < 3; i++) along[i] = top[i] - base[i];
    g.length = sqrt(inner(along, along));
    for (int i = 0; i < 3; i++) g.n[i] = along[i] / g.length;
    g.rate = inner(g.n, velocity);
    for (int i = 0; i < 3; i++) across[i] = (velocity[i] - g.rate * g.n[i]) / g.length;
    outer(g.n, across, g.omega);
    return g;
}

/* A part of a leg whose joint is at `joint` and moves with `velocity`; `out` is its centre of mass
 * from there along n. Its inertia about the axis is 0: spin and its acceleration are 0, so it would
 * multiply nothing, and the matrix stays regular because the constraint SPIN determines the
 * acceleration. */
static rigid_body place_part(double mass, double inertia, double out, const double joint[3],
                             const double velocity[3], const leg_axis *g) {
    rigid_body b = {.mass = mass};
    double turn[3];
    outer(g->omega, g->n, turn);
    for (int i = 0; i < 3; i++) {
        b.x[i] = joint[i] + out * g->n[i];
        b.v[i] = velocity[i] + out * turn[i];
        b.omega[i] = g->omega[i];
        for (int j = 0; j < 3; j++) b.inertia[i][j] = inertia * ((i == j) - g->n[i] * g->n[j]);
    }
    return b;
}

static void place(const thirteen_bodies *m, const gough_state *s, bodies_instant *now,
                  leg_axis axis[6], double joint[6][3]) {
    const gough_platform *p = &m->platform;
    const double still[3] = {0, 0, 0};
    memset(now, 0, sizeof *now);
    rigid_body *load = &now->body[LOAD];
    place_load(m, s, load, joint);
    for (int k = 0; k < 6; k++) {
        double top[3], velocity[3];
        outer(load->omega, joint[k], velocity);
        for (int i = 0; i < 3; i++) {
            top[i] = load->x[i] + joint[k][i];
            velocity[i] += load->v[i];
        }
        axis[k] = axis_of(p->base[k], top, velocity);
        now->length[k] = axis[k].length;
        now->rate[k] = axis[k].rate;
        now->body[CYLINDER + k] = place_part(p->cylinder.mass[k], p->cylinder.inertia[k],
                                             p->cylinder.center[k], p->base[k], still, &axis[k]);
        now->body[PISTON + k] = place_part(p->piston.mass[k], p->piston.inertia[k],
                                           -p->piston.center[k], top, velocity, &axis[k]);
    }
}

/* ---- the equations ---- */

/* m a = m g + …, I α = −ω × I ω + …, for the body whose accelerations are in columns `at` */
static void newton_and_euler(equations A, int at, const rigid_body *b, const double gravity[3]) {
    double spin[3], gyro[3];
    times(b->inertia, b->omega, spin);
    outer(b->omega, spin, gyro);
    for (int i = 0; i < 3; i++) {
        A[at + i][at + i] = b->mass;
        A[at + i][RIGHT] = b->mass * gravity[i];
        for (int j = 0; j < 3; j++) A[at + 3 + i][at + 3 + j] = b->inertia[i][j];
        A[at + 3 + i][RIGHT] = -gyro[i];
    }
}

/* Puts into row `row` the acceleration along e of the point r (from the centre) fixed to a body, times sign. The reaction with the
 * same number is a force along e on that body at that point, times sign. */
static void at_point(equations A, int row, int body, double sign, const double e[3],
                     const double r[3], const double omega[3]) {
    double lever[3], known[3];
    outer(r, e, lever);
    centripetal(omega, r, known);
    for (int i = 0; i < 3; i++) {
        A[row][body + i] += sign * e[i];
        A[row][body + 3 + i] += sign * lever[i];
        A[body + i][row] -= sign * e[i];
        A[body + 3 + i][row] -= sign * lever[i];
    }
    A[row][RIGHT] -= sign * inner(e, known);
}

/* As at_point(), for the angular acceleration about e and a torque. */
static void about_axis(equations A, int row, int body, double sign, const double e[3]) {
    for (int i = 0; i < 3; i++) {
        A[row][body + 3 + i] += sign * e[i];
        A[body + 3 + i][row] -= sign * e[i];
    }
}

/* two unit vectors across n */
static void across(const double n[3], double e[2][3]) {
    const double pick[3] = {fabs(n[0]) < 0.6, fabs(n[0]) >= 0.6, 0};
    outer(n, pick, e[0]);
    const double size = sqrt(inner(e[0], e[0]));
    for (int i = 0; i < 3; i++) e[0][i] /= size;
    outer(n, e[0], e[1]);
}

/* The piston's centre slides along the cylinder's axis: its acceleration less that of the point of the cylinder below it, less
 * Coriolis' 2 ω × l̇ n, has no part across the axis, and l̈ along it. */
static void guide(equations A, int at, const rigid_body *cylinder, const rigid_body *piston,
                  const leg_axis *g) {
    static const double here[3] = {0, 0, 0};
    double e[3][3], below[3], coriolis[3];
    across(g->n, e);
    memcpy(e[2], g->n, sizeof e[2]);
    outer(g->omega, g->n, coriolis);
    for (int i = 0; i < 3; i++) {
        below[i] = piston->x[i] - cylinder->x[i];
        coriolis[i] *= 2 * g->rate;
    }
    const int row[3] = {at + SIDE, at + SIDE + 1, at + ROD};
    for (int i = 0; i < 3; i++) {
        at_point(A, row[i], at + OF_PISTON, 1, e[i], here, g->omega);
        at_point(A, row[i], at + OF_CYLINDER, -1, e[i], below, g->omega);
        A[row[i]][RIGHT] += inner(e[i], coriolis);
    }
    A[at + ROD][at + STRETCH] = -1;
}

static void one_leg(equations A, int k, const thirteen_bodies *m, const bodies_instant *now,
                    const leg_axis *g, const double joint[3]) {
    static const double axis[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const int at = BLOCK * k;
    const rigid_body *cylinder = &now->body[CYLINDER + k], *piston = &now->body[PISTON + k];
    double to_base[3], to_top[3];
    for (int i = 0; i < 3; i++) {
        to_base[i] = m->platform.base[k][i] - cylinder->x[i];
        to_top[i] = now->body[LOAD].x[i] + joint[i] - piston->x[i];
    }
    newton_and_euler(A, at + OF_CYLINDER, cylinder, m->gravity);
    newton_and_euler(A, at + OF_PISTON, piston, m->gravity);
    for (int i = 0; i < 3; i++) {
        at_point(A, at + BASE_JOINT + i, at + OF_CYLINDER, 1, axis[i], to_base, g->omega);
        at_point(A, at + TOP_JOINT + i, at + OF_PISTON, -1, axis[i], to_top, g->omega);
        at_point(A, at + TOP_JOINT + i, OF_LOAD, 1, axis[i], joint, now->body[LOAD].omega);
        about_axis(A, at + TILT + i, at + OF_PISTON, 1, axis[i]);
        about_axis(A, at + TILT + i, at + OF_CYLINDER, -1, axis[i]);
    }
    guide(A, at, cylinder, piston, g);
    about_axis(A, at + SPIN, at + OF_CYLINDER, 1, g->n);

    /* force in the rod = F − m_r l̈ */
    A[at + STRETCH][at + ROD] = 1;
    A[at + STRETCH][at + STRETCH] = m->platform.reflected_mass[k];
    A[at + STRETCH][LEG_FORCE + k] = -1;
}

static void assemble(equations A, const thirteen_bodies *m, const gough_wrench *external,
                     const bodies_instant *now, const leg_axis axis[6], double joint[6][3]) {
    memset(A, 0, sizeof(equations));
    newton_and_euler(A, OF_LOAD, &now->body[LOAD], m->gravity);
    for (int i = 0; external != NULL && i < 3; i++) {
        A[OF_LOAD + i][RIGHT] += external->force[i];
        A[OF_LOAD + 3 + i][RIGHT] += external->moment[i];
    }
    for (int k = 0; k < 6; k++) one_leg(A, k, m, now, &axis[k], joint[k]);
}

/* Six columns that are known go to the right side. */
static void know(equations A, int column, const double value[6]) {
    for (int r = 0; r < UNKNOWNS; r++)
        for (int i = 0; i < 6; i++) A[r][RIGHT] -= A[r][column + i] * value[i];
    for (int r = 0; r < UNKNOWNS; r++)
        for (int i = 0; i < 6; i++) A[r][column + i] = 0;
}

/* x without the load and the leg forces, which the callers know */
static void take(const double x[UNKNOWNS], bodies_instant *now) {
    for (int k = 0; k < 6; k++) {
        const double *leg = x + k * BLOCK;
        for (int i = 0; i < 3; i++) {
            now->body[CYLINDER + k].a[i] = leg[OF_CYLINDER + i];
            now->body[CYLINDER + k].alpha[i] = leg[OF_CYLINDER + 3 + i];
            now->body[PISTON + k].a[i] = leg[OF_PISTON + i];
            now->body[PISTON + k].alpha[i] = leg[OF_PISTON + 3 + i];
            now->on_leg[k][i] = leg[BASE_JOINT + i];
            now->on_top[k][i] = leg[TOP_JOINT + i];
        }
        now->rod[k] = leg[ROD];
        now->second_rate[k] = leg[STRETCH];
    }
}

/* ---- friction, (mass-12), (mass-13) ---- */

/* s(v), which is 0 at rest and ±1 at speed */
static double sign_at(const thirteen_bodies *m, int k, double v) {
    const gough_friction *f = &m->platform.friction;
    double v0 = f->smoothing_speed[k];
    if (!(v0 > 0) && f->stribeck_speed[k] > 0) v0 = f->stribeck_speed[k] / 20;
    if (!(v0 > 0)) v0 = sqrt(sqrt(inner(m->gravity, m->gravity)) * m->platform.base_radius) / 1000;
    return v / hypot(v, v0);
}

/* the drive force of a leg whose force is F */
static double drive_for(const thirteen_bodies *m, int k, double F, double v) {
    const gough_friction *f = &m->platform.friction;
    const double loss = fabs(F) * (1 / f->efficiency[k] - 1);
    double dry = f->coulomb[k];
    if (f->breakaway[k] > f->coulomb[k]) {
        const double slip = v / f->stribeck_speed[k];
        dry += (f->breakaway[k] - f->coulomb[k]) / (1 + slip * slip);
    }
    return F + (dry + loss) * sign_at(m, k, v) + f->viscous[k] * v;
}

/* the leg force under a drive force, which increases with it: by halving an interval */
static double force_under(const thirteen_bodies *m, int k, double u, double v) {
    const double loss = 1 / m->platform.friction.efficiency[k] - 1;
    if (loss >= 1) return NAN; /* the drive locks itself */
    /* |u − dry| ≥ |F|(1 − loss) */
    const double reach = (fabs(u) + fabs(drive_for(m, k, 0, v))) / (1 - loss);
    double low = -reach, high = reach;
    for (;;) {
        const double middle = low / 2 + high / 2;
        if (middle <= low || middle >= high) return middle;
        if (drive_for(m, k, middle, v) < u)
            low = middle;
        else
            high = middle;
    }
}

/* ---- both directions ---- */

void bodies_lengths(const thirteen_bodies *m, const gough_state *state, double length[6],
                    double rate[6]) {
    bodies_instant now;
    leg_axis axis[6];
    double joint[6][3];
    place(m, state, &now, axis, joint);
    memcpy(length, now.length, sizeof now.length);
    memcpy(rate, now.rate, sizeof now.rate);
}

void bodies_forward(const thirteen_bodies *m, const gough_state *state, const double drive[6],
                    const gough_wrench *external, bodies_instant *out) {
    equations A;
    leg_axis axis[6];
    double joint[6][3], x[UNKNOWNS], arm[3], inward[3], turn[3];
    place(m, state, out, axis, joint);
    for (int k = 0; k < 6; k++) {
        out->drive[k] = drive[k];
        out->force[k] = force_under(m, k, drive[k], out->rate[k]);
    }
    assemble(A, m, external, out, axis, joint);
    know(A, LEG_FORCE, out->force);
    eliminate(A, x);
    take(x, out);

    rigid_body *load = &out->body[LOAD];
    memcpy(load->a, x + OF_LOAD, sizeof load->a);
    memcpy(load->alpha, x + OF_LOAD + 3, sizeof load->alpha);
    for (int i = 0; i < 3; i++) arm[i] = state->position[i] - load->x[i];
    outer(load->alpha, arm, turn);
    centripetal(load->omega, arm, inward);
    for (int i = 0; i < 3; i++) {
        out->top.linear[i] = load->a[i] + turn[i] + inward[i];
        out->top.angular[i] = load->alpha[i];
    }
}

void bodies_inverse(const thirteen_bodies *m, const gough_state *state,
                    const gough_acceleration *acceleration, const gough_wrench *external,
                    bodies_instant *out) {
    equations A;
    leg_axis axis[6];
    double joint[6][3], x[UNKNOWNS], arm[3], inward[3], turn[3], known[6];
    place(m, state, out, axis, joint);
    out->top = *acceleration;
    rigid_body *load = &out->body[LOAD];
    for (int i = 0; i < 3; i++) arm[i] = load->x[i] - state->position[i];
    outer(acceleration->angular, arm, turn);
    centripetal(load->omega, arm, inward);
    for (int i = 0; i < 3; i++) {
        known[i] = load->a[i] = acceleration->linear[i] + turn[i] + inward[i];
        known[3 + i] = load->alpha[i] = acceleration->angular[i];
    }

    /* the leg forces take the columns of the load's accelerations */
    assemble(A, m, external, out, axis, joint);
    know(A, OF_LOAD, known);
    for (int r = 0; r < UNKNOWNS; r++) {
        for (int i = 0; i < 6; i++) {
            A[r][OF_LOAD + i] = A[r][LEG_FORCE + i];
            A[r][LEG_FORCE + i] = 0;
        }
    }
    eliminate(A, x);
    take(x, out);
    for (int k = 0; k < 6; k++) {
        out->force[k] = x[OF_LOAD + k];
        out->drive[k] = drive_for(m, k, out->force[k], out->rate[k]);
    }
}

/* ---- laws for all bodies together ---- */

/* Adds a term to the sum and its size to the scale. */
static void add(double sum[3], double *scale, double sign, const double term[3]) {
    for (int i = 0; i < 3; i++) sum[i] += sign * term[i];
    *scale += sqrt(inner(term, term));
}

void bodies_momentum(const thirteen_bodies *m, const gough_wrench *external,
                     const bodies_instant *now, double momentum[3], double angular[3]) {
    double scale = 0, moments = 0, term[3], moment[3], other[3], spin[3];
    memset(momentum, 0, 3 * sizeof(double));
    memset(angular, 0, 3 * sizeof(double));
    for (int n = 0; n < BODIES; n++) {
        const rigid_body *b = &now->body[n];
        for (int i = 0; i < 3; i++) term[i] = b->mass * (b->a[i] - m->gravity[i]);
        outer(b->x, term, moment);
        add(momentum, &scale, 1, term);
        add(angular, &moments, 1, moment);
        times(b->inertia, b->alpha, moment);
        times(b->inertia, b->omega, spin);
        outer(b->omega, spin, other);
        add(angular, &moments, 1, moment);
        add(angular, &moments, 1, other);
    }
    for (int k = 0; k < 6; k++) {
        outer(m->platform.base[k], now->on_leg[k], moment);
        add(momentum, &scale, -1, now->on_leg[k]);
        add(angular, &moments, -1, moment);
    }
    if (external != NULL) {
        outer(now->body[LOAD].x, external->force, moment);
        add(momentum, &scale, -1, external->force);
        add(angular, &moments, -1, moment);
        add(angular, &moments, -1, external->moment);
    }
    for (int i = 0; i < 3; i++) {
        momentum[i] /= scale;
        angular[i] /= moments;
    }
}

double bodies_energy_rate(const thirteen_bodies *m, const bodies_instant *now) {
    double rate = 0;
    for (int n = 0; n < BODIES; n++) {
        const rigid_body *b = &now->body[n];
        double spin[3];
        times(b->inertia, b->omega, spin);
        /* İ ω = ω × I ω does no work */
        rate += b->mass * inner(b->v, b->a) + inner(spin, b->alpha);
        rate -= b->mass * inner(b->v, m->gravity);
    }
    for (int k = 0; k < 6; k++)
        rate += m->platform.reflected_mass[k] * now->rate[k] * now->second_rate[k];
    return rate;
}
