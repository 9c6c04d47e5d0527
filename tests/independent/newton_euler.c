/* Newton's and Euler's equations of a load on six massless legs; see newton_euler.h. */
#include "independent/newton_euler.h"

#include <math.h>
#include <string.h>

typedef newton_real real;

/* ---- vectors and matrices ---- */

static real inner(const real a[3], const real b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void outer(const real a[3], const real b[3], real out[3]) {
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* out = A v, or Aᵀ v */
static void times(real A[3][3], const real v[3], real out[3]) {
    for (int i = 0; i < 3; i++) out[i] = A[i][0] * v[0] + A[i][1] * v[1] + A[i][2] * v[2];
}

static void transposed_times(real A[3][3], const real v[3], real out[3]) {
    for (int i = 0; i < 3; i++) out[i] = A[0][i] * v[0] + A[1][i] * v[1] + A[2][i] * v[2];
}

/* x of A x = b by Gaussian elimination with partial pivoting, into b; returns the determinant of
 * A */
static real eliminate(real A[6][6], real b[6]) {
    real determinant = 1;
    for (int c = 0; c < 6; c++) {
        int best = c;
        for (int r = c + 1; r < 6; r++)
            if (fabsl(A[r][c]) > fabsl(A[best][c])) best = r;
        for (int k = 0; k < 6; k++) {
            const real swap = A[c][k];
            A[c][k] = A[best][k];
            A[best][k] = swap;
        }
        const real swap = b[c];
        b[c] = b[best];
        b[best] = swap;
        determinant *= best == c ? A[c][c] : -A[c][c];
        for (int r = c + 1; r < 6; r++) {
            const real factor = A[r][c] / A[c][c];
            for (int k = c; k < 6; k++) A[r][k] -= factor * A[c][k];
            b[r] -= factor * b[c];
        }
    }
    for (int r = 5; r >= 0; r--) {
        for (int k = r + 1; k < 6; k++) b[r] -= A[r][k] * b[k];
        b[r] /= A[r][r];
    }
    return determinant;
}

/* ---- attitude ---- */

/* Rotation of a quaternion that need not have length 1. */
static void rotation_of(const real q[4], real R[3][3]) {
    const real w = q[0], x = q[1], y = q[2], z = q[3];
    const real s = 2 / (w * w + x * x + y * y + z * z);
    R[0][0] = 1 - s * (y * y + z * z), R[0][1] = s * (x * y - w * z), R[0][2] = s * (x * z + w * y);
    R[1][0] = s * (x * y + w * z), R[1][1] = 1 - s * (x * x + z * z), R[1][2] = s * (y * z - w * x);
    R[2][0] = s * (x * z - w * y), R[2][1] = s * (y * z + w * x), R[2][2] = 1 - s * (x * x + y * y);
}

/* Quaternion of Rz(yaw) Ry(pitch) Rx(roll), as the product of three half turns. */
static void quaternion_of(real roll, real pitch, real yaw, real q[4]) {
    const real cr = cosl(roll / 2), sr = sinl(roll / 2), cp = cosl(pitch / 2), sp = sinl(pitch / 2);
    const real cy = cosl(yaw / 2), sy = sinl(yaw / 2);
    q[0] = cy * cp * cr + sy * sp * sr;
    q[1] = cy * cp * sr - sy * sp * cr;
    q[2] = cy * sp * cr + sy * cp * sr;
    q[3] = sy * cp * cr - cy * sp * sr;
}

/* ---- the program ---- */

/* Centre of mass, attitude and their derivatives that the program asks for; base axes. */
typedef struct target {
    real c[3], v[3], a[3], q[4], R[3][3], omega[3], alpha[3];
} target;

/* The axes of yaw, pitch and roll in base axes are z, Rz y and Rz Ry x; each turns with the
 * angles before it. */
static target target_at(const newton_euler *m, real t) {
    real p[6][3];
    target g;
    m->program(t, p);
    const real cz = cosl(p[5][0]), sz = sinl(p[5][0]), cy = cosl(p[4][0]), sy = sinl(p[4][0]);
    const real yaw_axis[3] = {0, 0, 1}, pitch_axis[3] = {-sz, cz, 0};
    const real roll_axis[3] = {cz * cy, sz * cy, -sy};
    quaternion_of(p[3][0], p[4][0], p[5][0], g.q);
    rotation_of(g.q, g.R);

    real by_yaw[3], by_two[3], pitch_turn[3], roll_turn[3];
    for (int i = 0; i < 3; i++) {
        by_yaw[i] = p[5][1] * yaw_axis[i];
        by_two[i] = by_yaw[i] + p[4][1] * pitch_axis[i];
        g.omega[i] = by_two[i] + p[3][1] * roll_axis[i];
    }
    outer(by_yaw, pitch_axis, pitch_turn);
    outer(by_two, roll_axis, roll_turn);
    for (int i = 0; i < 3; i++)
        g.alpha[i] = p[5][2] * yaw_axis[i] + p[4][2] * pitch_axis[i] + p[3][2] * roll_axis[i] +
                     p[4][1] * pitch_turn[i] + p[3][1] * roll_turn[i];

    /* centre of mass from the point that the program moves */
    real arm[3], local[3], turn[3], turn_turn[3], spin[3];
    for (int i = 0; i < 3; i++) local[i] = m->center[i] - m->about[i];
    times(g.R, local, arm);
    outer(g.omega, arm, turn);
    outer(g.omega, turn, turn_turn);
    outer(g.alpha, arm, spin);
    for (int i = 0; i < 3; i++) {
        const real home = m->about[i] + (i == 2 ? m->height : 0);
        g.c[i] = home + p[i][0] + arm[i];
        g.v[i] = p[i][1] + turn[i];
        g.a[i] = p[i][2] + spin[i] + turn_turn[i];
    }
    return g;
}

/* ---- legs ---- */

typedef struct leg {
    real arm[3]; /* top joint from the centre of mass, base axes */
    real n[3], length, rate;
} leg;

static void legs_in(const newton_euler *m, const real c[3], real R[3][3], const real v[3],
                    const real omega[3], leg legs[6]) {
    for (int k = 0; k < 6; k++) {
        leg *l = &legs[k];
        real local[3], turn[3], along[3];
        for (int i = 0; i < 3; i++) local[i] = m->top[k][i] - m->center[i];
        times(R, local, l->arm);
        outer(omega, l->arm, turn);
        for (int i = 0; i < 3; i++) along[i] = c[i] + l->arm[i] - m->base[k][i];
        l->length = sqrtl(inner(along, along));
        for (int i = 0; i < 3; i++) l->n[i] = along[i] / l->length;
        l->rate = inner(l->n, v) + inner(l->n, turn);
    }
}

/* Columns: the force and the moment about the centre of mass of a unit force in each leg. */
static void equations(const leg legs[6], real A[6][6]) {
    for (int k = 0; k < 6; k++) {
        real turn[3];
        outer(legs[k].arm, legs[k].n, turn);
        for (int i = 0; i < 3; i++) {
            A[i][k] = legs[k].n[i];
            A[i + 3][k] = turn[i];
        }
    }
}

/* Leg forces whose resultant is `force` and whose moment about the centre of mass is `moment`. */
static void balance(const leg legs[6], const real force[3], const real moment[3], real u[6]) {
    real A[6][6];
    equations(legs, A);
    for (int i = 0; i < 3; i++) {
        u[i] = force[i];
        u[i + 3] = moment[i];
    }
    eliminate(A, u);
}

/* Euler's equation: moment for a given angular acceleration, both in top axes */
static void euler_moment(const newton_euler *m, const real w[3], const real dw[3], real out[3]) {
    real J[3][3], Jw[3], Jdw[3], gyro[3];
    memcpy(J, m->inertia, sizeof J);
    times(J, w, Jw);
    times(J, dw, Jdw);
    outer(w, Jw, gyro);
    for (int i = 0; i < 3; i++) out[i] = Jdw[i] + gyro[i];
}

/* Program forces; and, for the vertical disturbance, the forces that have 1 along z as their
 * resultant. */
static void program_forces(const newton_euler *m, real t, leg legs[6], real force[6],
                           real lift[6]) {
    target g = target_at(m, t);
    real w[3], dw[3], local[3], moment[3], resultant[3];
    transposed_times(g.R, g.omega, w);
    transposed_times(g.R, g.alpha, dw);
    euler_moment(m, w, dw, local);
    times(g.R, local, moment);
    for (int i = 0; i < 3; i++) resultant[i] = m->mass * (g.a[i] - m->gravity[i]);
    legs_in(m, g.c, g.R, g.v, g.omega, legs);
    balance(legs, resultant, moment, force);
    if (lift != NULL) balance(legs, (const real[3]){0, 0, 1}, (const real[3]){0, 0, 0}, lift);
}

void newton_euler_program(const newton_euler *m, real t, real force[6], real length[6],
                          real rate[6]) {
    leg legs[6];
    program_forces(m, t, legs, force, NULL);
    for (int k = 0; k < 6; k++) {
        length[k] = legs[k].length;
        rate[k] = legs[k].rate;
    }
}

/* The control law with disturbances: forces of the legs, and force and moment on the load. */
static void forces_at(const newton_euler *m, real t, const leg legs[6], real u[6], real force[3],
                      real moment[3]) {
    leg wanted[6];
    real program[6], lift[6], vertical = 0;
    memset(u, 0, 6 * sizeof(real));
    memset(force, 0, 3 * sizeof(real));
    memset(moment, 0, 3 * sizeof(real));
    if (m->disturbance != NULL) m->disturbance(t, u, &vertical, force, moment);
    program_forces(m, t, wanted, program, lift);
    for (int k = 0; k < 6; k++) {
        if (m->feedforward) u[k] += program[k];
        u[k] += vertical * lift[k];
        u[k] += m->stiffness[k] * (wanted[k].length - legs[k].length);
        u[k] += m->damping[k] * (wanted[k].rate - legs[k].rate);
    }
}

/* ---- the equations of motion ---- */

/* dw of J dw = moment − w × J w, by Cramer's rule */
static void euler_acceleration(const newton_euler *m, const real w[3], const real moment[3],
                               real dw[3]) {
    real still[3] = {0, 0, 0}, gyro[3], right[3], cofactor[3];
    euler_moment(m, w, still, gyro);
    for (int i = 0; i < 3; i++) right[i] = moment[i] - gyro[i];
    const real *J0 = m->inertia[0], *J1 = m->inertia[1], *J2 = m->inertia[2];
    outer(J1, J2, cofactor);
    const real determinant = inner(J0, cofactor);
    /* J is symmetric, so its rows are its columns */
    dw[0] = inner(right, cofactor) / determinant;
    outer(J2, J0, cofactor);
    dw[1] = inner(right, cofactor) / determinant;
    outer(J0, J1, cofactor);
    dw[2] = inner(right, cofactor) / determinant;
}

static void derivative(const newton_euler *m, real t, const real s[NEWTON_STATES],
                       real out[NEWTON_STATES]) {
    const real *c = s, *q = s + 3, *v = s + 7, *w = s + 10;
    real R[3][3], omega[3], u[6], force[3], moment[3], local[3];
    leg legs[6];
    rotation_of(q, R);
    times(R, w, omega);
    legs_in(m, c, R, v, omega, legs);
    forces_at(m, t, legs, u, force, moment);
    for (int k = 0; k < 6; k++) {
        real turn[3];
        outer(legs[k].arm, legs[k].n, turn);
        for (int i = 0; i < 3; i++) {
            force[i] += u[k] * legs[k].n[i];
            moment[i] += u[k] * turn[i];
        }
    }

    for (int i = 0; i < 3; i++) {
        out[i] = v[i];
        out[7 + i] = m->gravity[i] + force[i] / m->mass;
    }
    out[3] = -(q[1] * w[0] + q[2] * w[1] + q[3] * w[2]) / 2;
    out[4] = (q[0] * w[0] + q[2] * w[2] - q[3] * w[1]) / 2;
    out[5] = (q[0] * w[1] + q[3] * w[0] - q[1] * w[2]) / 2;
    out[6] = (q[0] * w[2] + q[1] * w[1] - q[2] * w[0]) / 2;
    transposed_times(R, moment, local);
    euler_acceleration(m, w, local, out + 10);
}

/* Gragg's modified midpoint rule with n (even) substeps: its error is a series in h²/n². */
static void gragg(const newton_euler *m, real t, real h, int n, const real start[NEWTON_STATES],
                  real end[NEWTON_STATES]) {
    const real d = h / n;
    real before[NEWTON_STATES], now[NEWTON_STATES], slope[NEWTON_STATES];
    derivative(m, t, start, slope);
    for (int i = 0; i < NEWTON_STATES; i++) {
        before[i] = start[i];
        now[i] = start[i] + d * slope[i];
    }
    for (int k = 1; k < n; k++) {
        derivative(m, t + k * d, now, slope);
        for (int i = 0; i < NEWTON_STATES; i++) {
            const real next = before[i] + 2 * d * slope[i];
            before[i] = now[i];
            now[i] = next;
        }
    }
    derivative(m, t + h, now, slope);
    for (int i = 0; i < NEWTON_STATES; i++) end[i] = (before[i] + now[i] + d * slope[i]) / 2;
}

void newton_euler_step(const newton_euler *m, real t, real h, real state[NEWTON_STATES]) {
    enum { COLUMNS = 8 };
    real table[COLUMNS][NEWTON_STATES];
    /* Aitken and Neville's extrapolation to d² = 0, row by row in place */
    for (int row = 0; row < COLUMNS; row++) {
        gragg(m, t, h, 2 * (row + 1), state, table[row]);
        for (int column = row - 1; column >= 0; column--) {
            const real ratio = (real)(row + 1) / (real)(column + 1), weight = ratio * ratio - 1;
            for (int i = 0; i < NEWTON_STATES; i++)
                table[column][i] =
                    table[column + 1][i] + (table[column + 1][i] - table[column][i]) / weight;
        }
    }
    memcpy(state, table[0], sizeof table[0]);
    const real *q = state + 3;
    const real size = sqrtl(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (int i = 3; i < 7; i++) state[i] /= size;
}

/* ---- beginning and outcome ---- */

void newton_euler_start(const newton_euler *m, real state[NEWTON_STATES]) {
    target g = target_at(m, 0);
    memcpy(state, g.c, sizeof g.c);
    memcpy(state + 3, g.q, sizeof g.q);
    memcpy(state + 7, g.v, sizeof g.v);
    transposed_times(g.R, g.omega, state + 10);
}

newton_motion newton_euler_motion(const newton_euler *m, const real state[NEWTON_STATES]) {
    newton_motion out;
    real arm[3], turn[3];
    rotation_of(state + 3, out.rotation);
    times(out.rotation, state + 10, out.omega);
    times(out.rotation, m->center, arm);
    outer(out.omega, arm, turn);
    for (int i = 0; i < 3; i++) {
        out.position[i] = state[i] - arm[i];
        out.velocity[i] = state[7 + i] - turn[i];
    }
    return out;
}

void newton_euler_legs(const newton_euler *m, real t, const real state[NEWTON_STATES],
                       real length[6], real force[6]) {
    real R[3][3], omega[3], load_force[3], moment[3];
    leg legs[6];
    rotation_of(state + 3, R);
    times(R, state + 10, omega);
    legs_in(m, state, R, state + 7, omega, legs);
    forces_at(m, t, legs, force, load_force, moment);
    for (int k = 0; k < 6; k++) length[k] = legs[k].length;
}

real newton_euler_determinant(const newton_euler *m, const real state[NEWTON_STATES]) {
    real R[3][3], omega[3], A[6][6], unused[6] = {0, 0, 0, 0, 0, 0};
    leg legs[6];
    rotation_of(state + 3, R);
    times(R, state + 10, omega);
    legs_in(m, state, R, state + 7, omega, legs);
    equations(legs, A);
    return eliminate(A, unused);
}
