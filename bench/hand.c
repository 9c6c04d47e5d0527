/* A hand-written right-hand side of the reference machine in heave. */
#include "bench/hand.h"

#include <math.h>

hand hand_of(const reference *r) {
    const gough_machine *m = &r->model.machine;
    hand h = {.height = m->platform.height,
              .mass = m->load.mass,
              .gravity = m->gravity_magnitude,
              .stiffness = r->model.control.stiffness[0]};

    for (int v = 0; v < 6; v++) {
        for (int c = 0; c < 3; c++) {
            h.base[v][c] = m->platform.base[v][c];
            h.top[v][c] = m->platform.top[v][c];
        }
    }
    const double x = h.base[0][0] - h.top[0][0], y = h.base[0][1] - h.top[0][1];
    h.distance2 = x * x + y * y;
    for (int c = 0; c < 3; c++) h.J[c] = m->load.inertia[c][c];
    const gough_leg_part *part[2] = {&m->platform.cylinder, &m->platform.piston};
    for (int i = 0; i < 2; i++) {
        double *to = i == 0 ? h.cylinder : h.piston;
        to[0] = part[i]->mass[0], to[1] = part[i]->center[0], to[2] = part[i]->inertia[0];
    }
    h.reflected = m->platform.reflected_mass[0];
    h.heavy = m->platform.legs_have_mass;
    return h;
}

/* The mass that moves with the heave, half its change with the height, and what of the legs' mass hangs on the top: kinetic energy
 * of the legs ½ Σ (μ l̇² + I φ̇²) with l̇ = z ż/l and the leg's turn φ̇ = d ż/l² */
static void moving_mass(const hand *h, double z, double l, double *mass, double *slope,
                        double *hanging) {
    const double *one = h->cylinder, *two = h->piston, d2 = h->distance2;
    const double along = two[0] + h->reflected, reach = l - two[1], l2 = l * l;
    const double turn = one[2] + one[0] * one[1] * one[1] + two[2] + two[0] * reach * reach;

    *mass = 6 * (along * z * z / l2 + turn * d2 / (l2 * l2));
    *slope = 3 * (2 * along * z * d2 / (l2 * l2) +
                  d2 * z * (2 * two[0] * reach / (l2 * l2 * l) - 4 * turn / (l2 * l2 * l2)));
    *hanging = 6 * (two[0] + (one[0] * one[1] - two[0] * two[1]) * d2 / (l2 * l));
}

void hand_program(const hand *h, double t, double *length, double *force) {
    /* z = h₀ + 0.2 s p², s = sin t, p = 1 − e, e = exp(−t/2) */
    const double s = sin(t), c = cos(t), e = exp(-t / 2), p = 1 - e;
    const double z = h->height + 0.2 * s * p * p;
    const double second = 0.2 * (-s * p * p + 2 * c * p * e + s * (0.5 * e * e - 0.5 * p * e));
    const double l = sqrt(z * z + h->distance2);

    *length = l;
    double weight = h->mass * (second + h->gravity);
    if (h->heavy) {
        const double first = 0.2 * (c * p * p + s * p * e);
        double mass, slope, hanging;
        moving_mass(h, z, l, &mass, &slope, &hanging);
        weight += mass * second + slope * first * first + hanging * h->gravity;
    }
    *force = weight * l / (6 * z);
}

void hand_quaternion(const double angles[3], double q[4]) {
    const double a = cos(angles[0] / 2), b = cos(angles[1] / 2), c = cos(angles[2] / 2);
    const double x = sin(angles[0] / 2), y = sin(angles[1] / 2), z = sin(angles[2] / 2);

    q[0] = a * b * c + x * y * z;
    q[1] = x * b * c - a * y * z;
    q[2] = a * y * c + x * b * z;
    q[3] = a * b * z - x * y * c;
}

void hand_matrix(const double q[4], double R[3][3]) {
    const double n = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], s = 2 / n;
    const double xx = s * q[1] * q[1], yy = s * q[2] * q[2], zz = s * q[3] * q[3];
    const double xy = s * q[1] * q[2], yz = s * q[2] * q[3], zx = s * q[3] * q[1];
    const double wx = s * q[0] * q[1], wy = s * q[0] * q[2], wz = s * q[0] * q[3];

    R[0][0] = 1 - yy - zz, R[0][1] = xy - wz, R[0][2] = zx + wy;
    R[1][0] = xy + wz, R[1][1] = 1 - xx - zz, R[1][2] = yz - wx;
    R[2][0] = zx - wy, R[2][1] = yz + wx, R[2][2] = 1 - xx - yy;
}

void hand_begin(const reference *r, double y[HAND_STATE]) {
    const double *off = r->model.initial.component;

    for (int i = 0; i < HAND_STATE; i++) y[i] = 0;
    for (int c = 0; c < 3; c++) y[c] = off[c];
    y[2] += r->model.machine.platform.height;
    hand_quaternion(off + GOUGH_ROLL, y + 3);
}

void hand_rates(const hand *h, double t, const double *y, double *rate) {
    const double *q = y + 3, *velocity = y + 7, *w = y + 10;
    double R[3][3], F[3] = {0, 0, -h->mass * h->gravity}, M[3] = {0, 0, 0}, l0, f0;

    hand_program(h, t, &l0, &f0);
    hand_matrix(q, R);
    for (int v = 0; v < 6; v++) {
        double arm[3], s[3], length2 = 0;
        for (int c = 0; c < 3; c++) {
            arm[c] = R[c][0] * h->top[v][0] + R[c][1] * h->top[v][1] + R[c][2] * h->top[v][2];
            s[c] = y[c] + arm[c] - h->base[v][c];
            length2 += s[c] * s[c];
        }
        const double l = sqrt(length2), u = (f0 + h->stiffness * (l0 - l)) / l;
        for (int c = 0; c < 3; c++) F[c] += u * s[c];
        M[0] += u * (arm[1] * s[2] - arm[2] * s[1]);
        M[1] += u * (arm[2] * s[0] - arm[0] * s[2]);
        M[2] += u * (arm[0] * s[1] - arm[1] * s[0]);
    }
    for (int c = 0; c < 3; c++) {
        rate[c] = velocity[c];
        rate[7 + c] = F[c] / h->mass;
    }
    rate[3] = -0.5 * (q[1] * w[0] + q[2] * w[1] + q[3] * w[2]);
    rate[4] = 0.5 * (q[0] * w[0] + q[2] * w[2] - q[3] * w[1]);
    rate[5] = 0.5 * (q[0] * w[1] + q[3] * w[0] - q[1] * w[2]);
    rate[6] = 0.5 * (q[0] * w[2] + q[1] * w[1] - q[2] * w[0]);

    /* Euler's equations in the body's axes */
    double m[3];
    for (int c = 0; c < 3; c++) m[c] = R[0][c] * M[0] + R[1][c] * M[1] + R[2][c] * M[2];
    rate[10] = (m[0] - (h->J[2] - h->J[1]) * w[1] * w[2]) / h->J[0];
    rate[11] = (m[1] - (h->J[0] - h->J[2]) * w[2] * w[0]) / h->J[1];
    rate[12] = (m[2] - (h->J[1] - h->J[0]) * w[0] * w[1]) / h->J[2];
}
