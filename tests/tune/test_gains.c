/* Gains that couple the legs: what they do to the motion itself, by differences of forward dynamics; closed forms of single modes;
 * the identity of Kalman, which holds for gains of least cost only; and refusals. */
#include <complex.h>

#include "gough/tune.h"
#include "support/machines.h"
#include "support/suite.h"

enum { N = GOUGH_LEGS };

/* ---- the motion with gains, without a matrix of the library ---- */

static void turn_by(const double w[3], const double R[3][3], double out[3][3]) {
    const double a = sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
    const double s = a > 0 ? sin(a) / a : 1, c = a > 0 ? (1 - cos(a)) / (a * a) : 0.5;
    const double W[3][3] = {{0, -w[2], w[1]}, {w[2], 0, -w[0]}, {-w[1], w[0], 0}};
    double E[3][3];

    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            E[i][j] = (i == j) + s * W[i][j];
            for (int k = 0; k < 3; k++) E[i][j] += c * W[i][k] * W[k][j];
        }
    }
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            out[i][j] = 0;
            for (int k = 0; k < 3; k++) out[i][j] += E[i][k] * R[k][j];
        }
    }
}

typedef struct {
    const gough_machine *machine;
    const gough_gains *gains;
    gough_state rest;
    double length[N], force[N];
} held;

/* rest in a pose, and the forces that hold it */
static held hold(const gough_model *model, const double *component, const gough_gains *gains) {
    held h = {.machine = &model->machine, .gains = gains};
    gough_motion still = {0};
    gough_acceleration none;

    for (int c = 0; c < GOUGH_COMPONENTS; c++)
        still.formula[c] = gough_formula_constant(component ? component[c] : 0);
    gough_program(h.machine, &still, 0, &h.rest, &none);
    ck_assert_int_eq(gough_inverse_dynamics(h.machine, &h.rest, &none, NULL, h.force, NULL),
                     GOUGH_OK);
    ck_assert_int_eq(gough_leg_kinematics(h.machine, &h.rest, NULL, h.length, NULL, NULL),
                     GOUGH_OK);
    return h;
}

/* the acceleration of the top frame's origin, and the angular one, in a state at `far` along (δp, δθ, δv, δω) */
static void acceleration_at(const held *h, const double along[12], double far, double out[6]) {
    gough_state state = h->rest;
    gough_acceleration a;
    double length[N], rate[N], force[N], w[3];

    for (int i = 0; i < 3; i++) {
        state.position[i] += far * along[i];
        w[i] = far * along[3 + i];
        state.velocity[i] = far * along[6 + i];
        state.angular_velocity[i] = far * along[9 + i];
    }
    turn_by(w, h->rest.rotation, state.rotation);
    gough_leg_kinematics(h->machine, &state, NULL, length, rate, NULL);
    for (int v = 0; v < N; v++) {
        force[v] = h->force[v];
        for (int u = 0; u < N; u++)
            force[v] += h->gains->stiffness[v][u] * (h->length[u] - length[u]) -
                        h->gains->damping[v][u] * rate[u];
    }
    ck_assert_int_eq(gough_forward_dynamics(h->machine, &state, force, NULL, &a), GOUGH_OK);
    for (int i = 0; i < 3; i++) out[i] = a.linear[i], out[3 + i] = a.angular[i];
}

/* its derivative there, by differences of sixth order */
static void derivative(const held *h, const double along[12], double step, double out[6]) {
    static const double weight[3] = {45, -9, 1};

    for (int i = 0; i < 6; i++) out[i] = 0;
    for (int k = 1; k <= 3; k++) {
        double above[6], below[6];
        acceleration_at(h, along, k * step, above);
        acceleration_at(h, along, -k * step, below);
        for (int i = 0; i < 6; i++) out[i] += weight[k - 1] * (above[i] - below[i]) / (60 * step);
    }
}

static const gough_model *some_model(dice *d, int which) {
    static gough_model model;

    memset(&model, 0, sizeof model);
    if (which % 3 == 0)
        random_symmetric(d, &model.machine);
    else if (which % 3 == 1)
        skew_machine(&model.machine);
    else
        paper_machine(&model.machine);
    if (which % 2) give_legs(&model.machine, LEGS_HEAVY | LEGS_VISCOUS, d);
    return &model;
}

static void some_pose(dice *d, const gough_machine *machine, double component[GOUGH_COMPONENTS]) {
    for (int c = 0; c < GOUGH_COMPONENTS; c++)
        component[c] = dice_between(d, -0.1, 0.1) * (c < 3 ? machine->base_radius : 1);
}

/* what vanishes is measured by the accelerations in units of the top's: ω² times the displacement */
START_TEST(every_displacement_comes_back_as_one_oscillator) {
    dice d = {9};

    for (int n = 0; n < 24; n++) {
        const gough_model *model = some_model(&d, n);
        const double R = model->machine.base_radius,
                     own = sqrt(model->machine.gravity_magnitude / R);
        const double F = own * dice_between(&d, 0.3, 3), zeta = n % 4 ? dice_between(&d, 0, 1) : 1;
        const double omega = 2 * pi * F;
        double component[GOUGH_COMPONENTS];
        gough_gains gains;
        gough_error error = {0};

        some_pose(&d, &model->machine, component);
        ck_assert_msg(gough_gains_by_poles(model, n % 5 ? component : NULL, F, zeta, &gains,
                                           &error) == GOUGH_OK,
                      "%s", error.message);
        const held h = hold(model, n % 5 ? component : NULL, &gains);
        for (int axis = 0; axis < 12; axis++) {
            double along[12] = {0}, a[6];
            const bool rate = axis >= 6, angle = axis % 6 >= 3;
            along[axis] = rate ? omega : 1;
            derivative(&h, along, 1e-2 * (angle ? 1 : R), a);
            for (int i = 0; i < 6; i++) {
                const double wanted = i == axis % 6 ? -omega * omega * (rate ? 2 * zeta : 1) : 0;
                const double unit = omega * omega * (i < 3 ? R : 1) / (angle ? 1 : R);
                ck_assert_msg(fabs(a[i] - wanted) <= 1e-8 * unit,
                              "machine %d, axis %d, %d: %.12g, not %.12g", n, axis, i, a[i],
                              wanted);
            }
        }
        for (int k = 0; k < 12; k++) {
            const double im = omega * sqrt(1 - zeta * zeta);
            ck_assert_msg(fabs(gains.pole[k].value[0] + zeta * omega) <= 1e-9 * omega &&
                              fabs(fabs(gains.pole[k].value[1]) - im) <= 1e-9 * omega,
                          "machine %d: pole %d is %.15g %.15g", n, k, gains.pole[k].value[0],
                          gains.pole[k].value[1]);
        }
    }
}
END_TEST

/* the library's own matrix of the loop, by imaginary steps through the equations of runs: A₂₁ = −ω², A₂₂ = −2ζω */
START_TEST(the_linearised_loop_is_six_equal_oscillators) {
    dice d = {12};

    for (int n = 0; n < 24; n++) {
        static gough_model model;
        model = *some_model(&d, n);
        const double R = model.machine.base_radius, own = sqrt(model.machine.gravity_magnitude / R),
                     F = own * dice_between(&d, 0.3, 3), zeta = dice_between(&d, 0, 1);
        double component[GOUGH_COMPONENTS], A[12][12];
        gough_gains gains;
        gough_error error = {0};

        some_pose(&d, &model.machine, component);
        for (int c = 0; c < GOUGH_COMPONENTS; c++)
            model.motion.formula[c] = gough_formula_constant(component[c]);
        ck_assert_int_eq(gough_gains_by_poles(&model, component, F, zeta, &gains, NULL), GOUGH_OK);
        model.control.feedforward = true;
        gough_gains_apply(&gains, &model.control);
        ck_assert_msg(gough_linearise(&model, 0, NULL, 12, A[0], &error) == GOUGH_OK, "%s",
                      error.message);
        for (int i = 0; i < 12; i++) {
            for (int j = 0; j < 12; j++) {
                const double omega = 2 * pi * F;
                const double wanted = i < 6        ? j == i + 6
                                      : j == i - 6 ? -omega * omega
                                      : j == i     ? -2 * zeta * omega
                                                   : 0;
                const double unit = (i < 6   ? 1
                                     : j < 6 ? omega * omega
                                             : omega) *
                                    (i % 6 < 3 ? R : 1) / (j % 6 < 3 ? R : 1);
                ck_assert_msg(fabs(A[i][j] - wanted) <= 1e-10 * unit,
                              "machine %d: [%d][%d] is %.15g, not %.15g", n, i, j, A[i][j], wanted);
            }
        }
    }
}
END_TEST

/* G as a number for the legs' pattern v, an eigenvector: v G v / v v, and how far G v is from it */
static double gain_of(double G[N][N], const double v[N], double *apart) {
    double sum = 0, product[N];

    *apart = 0;
    for (int i = 0; i < N; i++) {
        product[i] = 0;
        for (int j = 0; j < N; j++) product[i] += G[i][j] * v[j];
        sum += v[i] * product[i] / N;
    }
    for (int i = 0; i < N; i++) *apart = fmax(*apart, fabs(product[i] - sum * v[i]));
    return sum;
}

START_TEST(one_mode_has_the_gains_of_its_closed_form) {
    static const double pattern[2][N] = {{1, 1, 1, 1, 1, 1}, {1, -1, 1, -1, 1, -1}};
    dice d = {31};

    for (int n = 0; n < 200; n++) {
        static gough_model model;
        const symmetric s = random_symmetric(&d, &model.machine);
        const double d2 = s.R * s.R + s.r * s.r - 2 * s.R * s.r * cos(s.delta), l2 = s.h * s.h + d2,
                     across = s.R * s.r * sin(s.delta);
        const double Jz = model.machine.load.inertia[2][2];
        /* what a pattern of forces of size 1 in each leg does to lengths, and growth */
        const double mobility[2] = {6 * s.h * s.h / (l2 * s.M), 6 * across * across / (l2 * Jz)};
        const double growth[2] = {s.g * d2 / (s.h * l2),
                                  s.M * s.g / s.h *
                                      (s.R * s.r * cos(s.delta) - across * across / l2) / Jz};
        const double unit = s.M * s.g / s.R, time = sqrt(s.R / s.g);
        const double q1 = n % 10 ? unit * unit * pow(10, dice_between(&d, -4, 6)) : 0,
                     q2 = n % 10 ? unit * unit * time * time * pow(10, dice_between(&d, -4, 4)) : 0;
        gough_gains gains;
        gough_error error = {0};
        const gough_status status = gough_gains_by_lqr(&model, NULL, q1, q2, &gains, &error);

        if (n % 10 == 0 && status == GOUGH_ERROR_NUMERICAL) continue; /* not every mode grows */
        ck_assert_msg(status == GOUGH_OK, "%d: %s", n, error.message);
        ck_assert(gains.residual <= 1e-12);
        for (int m = 0; m < 2; m++) {
            const double k = mobility[m], a = growth[m];
            const double k1 = a + sqrt(a * a + q1 * k * k), k2 = sqrt(2 * k1 + q2 * k * k);
            double apart[2];
            const double G = gain_of(gains.stiffness, pattern[m], &apart[0]),
                         D = gain_of(gains.damping, pattern[m], &apart[1]);
            ck_assert_msg(fabs(G - k1 / k) <= 1e-9 * gains.stiffness[0][0] &&
                              apart[0] <= 1e-9 * gains.stiffness[0][0],
                          "%d, mode %d: G = %.12g, not %.12g", n, m, G, k1 / k);
            ck_assert_msg(fabs(D - k2 / k) <= 1e-9 * gains.damping[0][0] &&
                              apart[1] <= 1e-9 * gains.damping[0][0],
                          "%d, mode %d: D = %.12g, not %.12g", n, m, D, k2 / k);
        }
    }
}
END_TEST

static double determinant(double A[N][N]) {
    double det = 1;

    for (int k = 0; k < N; k++) {
        int p = k;
        for (int i = k + 1; i < N; i++)
            if (fabs(A[i][k]) > fabs(A[p][k])) p = i;
        for (int j = 0; j < N; j++) {
            const double keep = A[k][j];
            A[k][j] = A[p][j], A[p][j] = keep;
        }
        det *= p == k ? A[k][k] : -A[k][k];
        for (int i = k + 1; i < N; i++) {
            const double part = A[i][k] / A[k][k];
            for (int j = k; j < N; j++) A[i][j] -= part * A[k][j];
        }
    }
    return det;
}

/* Poles that are mirrored have the product of those they mirror: on all six axes det(JᵀGJ + K_geo) = det(−K_geo). For a mode by
 * itself that is twice its threshold. */
START_TEST(without_weights_the_stiffness_left_is_that_which_was_lacking) {
    for (int skew = 0; skew < 2; skew++) {
        static gough_model model;
        double J[N][N], resisting[N][N], lacking[N][N];
        gough_gains gains;
        gough_rest rest;

        memset(&model, 0, sizeof model);
        paper_machine(&model.machine);
        if (skew) {
            gough_platform p = model.machine.platform;
            const gough_load load = {.mass = 1.3,
                                     .inertia = {{0.11, 0.01, 0}, {0.01, 0.14, 0}, {0, 0, 0.2}}};
            const double gravity[3] = {0, 0, -1};
            ck_assert(gough_machine_init(&model.machine, &p, &load, gravity, NULL) == GOUGH_OK);
        }
        model.control.feedforward = true;
        ck_assert_int_eq(gough_stability_at_rest(&model, NULL, &rest, NULL), GOUGH_OK);
        ck_assert_int_eq(rest.growing, 6);
        ck_assert_int_eq(gough_gains_by_lqr(&model, NULL, 0, 0, &gains, NULL), GOUGH_OK);
        gough_jacobian(&model.machine, &rest.state, J);
        for (int i = 0; i < N; i++) {
            for (int j = 0; j < N; j++) {
                lacking[i][j] = -rest.geometric[i][j];
                resisting[i][j] = rest.geometric[i][j];
                for (int v = 0; v < N; v++)
                    for (int w = 0; w < N; w++)
                        resisting[i][j] += J[v][i] * gains.stiffness[v][w] * J[w][j];
            }
        }
        const double left = determinant(resisting), lacked = determinant(lacking);
        ck_assert_msg(fabs(left - lacked) <= 1e-9 * lacked, "%.15g, not %.15g", left, lacked);
    }
}
END_TEST

START_TEST(without_weights_growth_is_mirrored) {
    static const double pattern[2][N] = {{1, 1, 1, 1, 1, 1}, {1, -1, 1, -1, 1, -1}};
    static const char *const name[2] = {"heave", "yaw"};
    static gough_model model;
    gough_gains gains, near;
    gough_rest rest;

    paper_machine(&model.machine);
    model.control.feedforward = true;
    ck_assert_int_eq(gough_stability_at_rest(&model, NULL, &rest, NULL), GOUGH_OK);
    ck_assert_int_eq(gough_gains_by_lqr(&model, NULL, 0, 0, &gains, NULL), GOUGH_OK);
    ck_assert_int_eq(rest.growing, 6);
    for (int k = 0; k < 6; k++) {
        /* each twice; those that grow fastest are the first ones of the loop, and the last ones of its mirror */
        const double growth = rest.eigenvalue[k].value[0];
        for (int i = 0; i < 2; i++) {
            const double *pole = gains.pole[11 - 2 * k - i].value;
            ck_assert_msg(fabs(pole[0] + growth) <= 1e-9 && fabs(pole[1]) <= 1e-9,
                          "%.15g %.15g, not %.15g", pole[0], pole[1], -growth);
        }
    }
    for (int m = 0; m < 2; m++) {
        double apart;
        const double G = gain_of(gains.stiffness, pattern[m], &apart);
        int k = 0;
        while (strcmp(rest.threshold[k].mode.name, name[m]) != 0) k++;
        ck_assert(fabs(G - 2 * rest.threshold[k].stiffness) <= 1e-12 && apart <= 1e-12);
    }
    /* and small weights come near it */
    ck_assert_int_eq(gough_gains_by_lqr(&model, NULL, 1e-10, 1e-10, &near, NULL), GOUGH_OK);
    for (int i = 0; i < N; i++) {
        for (int j = 0; j < N; j++)
            ck_assert(fabs(near.stiffness[i][j] - gains.stiffness[i][j]) <= 1e-7);
    }
}
END_TEST

/* S⁻¹, Γ and Δ from gains of two frequencies without damping, (tune-6) */
typedef struct {
    double inertia[N][N], geometric[N][N], viscous[N][N];
} plant;

static plant plant_of(const gough_model *model, const double *component, double F) {
    const double omega = 2 * pi * F;
    gough_gains low, high;
    plant p;

    ck_assert_int_eq(gough_gains_by_poles(model, component, F, 0, &low, NULL), GOUGH_OK);
    ck_assert_int_eq(gough_gains_by_poles(model, component, 2 * F, 0, &high, NULL), GOUGH_OK);
    for (int i = 0; i < N; i++) {
        for (int j = 0; j < N; j++) {
            p.inertia[i][j] = (high.stiffness[i][j] - low.stiffness[i][j]) / (3 * omega * omega);
            p.geometric[i][j] = omega * omega * p.inertia[i][j] - low.stiffness[i][j];
            p.viscous[i][j] = -low.damping[i][j];
        }
    }
    return p;
}

/* (Y + K)ᴴ(Y + K) = YᴴY + (q₁ + ω²q₂) 1 at every ω, with Y = −ω²S⁻¹ + iωΔ + Γ, K = G + iωD */
START_TEST(gains_of_least_cost_obey_kalmans_identity) {
    dice d = {77};

    for (int n = 0; n < 60; n++) {
        const gough_model *model = some_model(&d, n);
        const gough_machine *m = &model->machine;
        const double own = sqrt(m->gravity_magnitude / m->base_radius),
                     unit = m->load.mass * own * own;
        const double q1 = unit * unit * pow(10, dice_between(&d, -2, 6)),
                     q2 = unit * unit / (own * own) * pow(10, dice_between(&d, -2, 4));
        double component[GOUGH_COMPONENTS];
        gough_gains gains;
        gough_error error = {0};

        some_pose(&d, m, component);
        ck_assert_msg(gough_gains_by_lqr(model, component, q1, q2, &gains, &error) == GOUGH_OK,
                      "%d: %s", n, error.message);
        ck_assert(gains.residual <= 1e-12);
        for (int k = 0; k < 12; k++) ck_assert(gains.pole[k].value[0] < 0);
        const plant p = plant_of(model, component, own / 6);
        for (double omega = 0; omega < 300 * own; omega = 3 * omega + 0.1 * own) {
            double complex Y[N][N], Z[N][N];
            for (int i = 0; i < N; i++) {
                for (int j = 0; j < N; j++) {
                    Y[i][j] = p.geometric[i][j] - omega * omega * p.inertia[i][j] +
                              I * omega * p.viscous[i][j];
                    Z[i][j] = Y[i][j] + gains.stiffness[i][j] + I * omega * gains.damping[i][j];
                }
            }
            for (int i = 0; i < N; i++) {
                for (int j = 0; j < N; j++) {
                    double complex apart = i == j ? -(q1 + omega * omega * q2) : 0;
                    double size = cabs(apart);
                    for (int k = 0; k < N; k++) {
                        apart += conj(Z[k][i]) * Z[k][j] - conj(Y[k][i]) * Y[k][j];
                        size += cabs(Z[k][i]) * cabs(Z[k][j]) + cabs(Y[k][i]) * cabs(Y[k][j]);
                    }
                    ck_assert_msg(cabs(apart) <= 1e-9 * size, "%d at %.3g: %.3g of %.3g", n, omega,
                                  cabs(apart), size);
                }
            }
        }
    }
}
END_TEST

START_TEST(a_control_takes_the_gains_as_they_are) {
    static gough_model model;
    gough_gains gains;
    gough_control control = {.feedforward = true, .integral = {3, 3, 3, 3, 3, 3}};

    skew_machine(&model.machine);
    ck_assert_int_eq(gough_gains_by_lqr(&model, NULL, 10, 3, &gains, NULL), GOUGH_OK);
    gough_gains_apply(&gains, &control);
    ck_assert(control.coupled && control.feedforward && control.integral[5] > 2);
    for (int i = 0; i < N; i++) {
        for (int j = 0; j < N; j++) {
            const double G = i == j ? control.stiffness[i] : control.cross_stiffness[i][j],
                         D = i == j ? control.damping[i] : control.cross_damping[i][j];
            ck_assert(fabs(G - gains.stiffness[i][j]) <= 0);
            ck_assert(fabs(D - gains.damping[i][j]) <= 0);
        }
        ck_assert(fabs(control.cross_stiffness[i][i]) <= 0);
        ck_assert(fabs(control.cross_damping[i][i]) <= 0);
    }
}
END_TEST

/* about the centre of mass a loop by poles resists as ω² times mass and inertia, (tune-6) */
START_TEST(what_resists_a_displacement_is_the_mass_times_the_square_of_the_frequency) {
    static gough_model model;
    const double F = 0.7, square = 4 * pi * pi * F * F;
    gough_gains gains;
    gough_stiffness s;

    skew_machine(&model.machine);
    const gough_load *load = &model.machine.load;
    memcpy(model.motion.about, load->center_of_mass, sizeof model.motion.about);
    ck_assert_int_eq(gough_gains_by_poles(&model, NULL, F, 0.5, &gains, NULL), GOUGH_OK);
    model.control.feedforward = true;
    gough_gains_apply(&gains, &model.control);
    ck_assert_int_eq(gough_stiffness_at_rest(&model, NULL, &s, NULL), GOUGH_OK);
    ck_assert(s.firm);
    for (int i = 0; i < 6; i++) {
        for (int j = 0; j < 6; j++) {
            const double mass =
                i < 3 ? (i == j ? load->mass : 0) : (j < 3 ? 0 : load->inertia[i - 3][j - 3]);
            ck_assert_msg(fabs(s.total[i][j] - square * mass) <= 1e-10 * square,
                          "[%d][%d]: %.12g, not %.12g", i, j, s.total[i][j], square * mass);
        }
    }
}
END_TEST

static void refuses(gough_status status, gough_status wanted, const gough_error *error,
                    const char *words) {
    ck_assert_int_eq(status, wanted);
    ck_assert_msg(strstr(error->message, words) != NULL, "'%s'", error->message);
}

START_TEST(says_why_there_are_no_gains) {
    static gough_model model;
    double flat[GOUGH_COMPONENTS] = {0};
    gough_gains gains;
    gough_error error = {0};

    paper_machine(&model.machine);
    refuses(gough_gains_by_poles(&model, NULL, 0, 0.5, &gains, &error), GOUGH_ERROR_INPUT, &error,
            "greater than 0");
    refuses(gough_gains_by_poles(&model, NULL, NAN, 0.5, &gains, &error), GOUGH_ERROR_INPUT, &error,
            "greater than 0");
    refuses(gough_gains_by_poles(&model, NULL, 1, 1.1, &gains, &error), GOUGH_ERROR_INPUT, &error,
            "from 0 to 1, not 1.1");
    refuses(gough_gains_by_poles(&model, NULL, 1, NAN, &gains, &error), GOUGH_ERROR_INPUT, &error,
            "from 0 to 1");
    refuses(gough_gains_by_lqr(&model, NULL, -1, 1, &gains, &error), GOUGH_ERROR_INPUT, &error,
            "errors of length must be 0 or more");
    refuses(gough_gains_by_lqr(&model, NULL, 1, INFINITY, &gains, &error), GOUGH_ERROR_INPUT,
            &error, "errors of the rate must be 0 or more");
    refuses(gough_gains_by_poles(&model, NULL, 1e200, 1, &gains, &error), GOUGH_ERROR_NUMERICAL,
            &error, "differ too much in size");
    flat[GOUGH_YAW] = pi / 2;
    refuses(gough_gains_by_poles(&model, flat, 1, 1, &gains, &error), GOUGH_ERROR_NUMERICAL, &error,
            "singular");
    refuses(gough_gains_by_lqr(&model, flat, 1, 1, &gains, &error), GOUGH_ERROR_NUMERICAL, &error,
            "singular");
}
END_TEST

/* hanging, all modes oscillate without end: nothing has to be done, and no gains of least cost make them die out */
START_TEST(without_weights_what_oscillates_is_refused) {
    static gough_model model;
    const double up[3] = {0, 0, 1}, weightless[3] = {0, 0, 0};
    gough_gains gains;
    gough_error error = {0};

    paper_machine(&model.machine);
    const gough_platform platform = model.machine.platform;
    const gough_load load = model.machine.load;
    ck_assert_int_eq(gough_machine_init(&model.machine, &platform, &load, up, NULL), GOUGH_OK);
    refuses(gough_gains_by_lqr(&model, NULL, 0, 0, &gains, &error), GOUGH_ERROR_NUMERICAL, &error,
            "neither grows nor decays");
    ck_assert_int_eq(gough_gains_by_lqr(&model, NULL, 0, 1e-4, &gains, NULL), GOUGH_OK);
    ck_assert_int_eq(gough_machine_init(&model.machine, &platform, &load, weightless, NULL),
                     GOUGH_OK);
    refuses(gough_gains_by_lqr(&model, NULL, 0, 0, &gains, &error), GOUGH_ERROR_NUMERICAL, &error,
            "neither grows nor decays");
    /* a displacement that costs nothing stays */
    refuses(gough_gains_by_lqr(&model, NULL, 0, 1, &gains, &error), GOUGH_ERROR_NUMERICAL, &error,
            "neither grows nor decays");
    ck_assert_int_eq(gough_gains_by_lqr(&model, NULL, 1, 0, &gains, NULL), GOUGH_OK);
}
END_TEST

int main(void) {
    return SUITE_RUN("gains", 60, every_displacement_comes_back_as_one_oscillator,
                     the_linearised_loop_is_six_equal_oscillators,
                     one_mode_has_the_gains_of_its_closed_form, without_weights_growth_is_mirrored,
                     without_weights_the_stiffness_left_is_that_which_was_lacking,
                     gains_of_least_cost_obey_kalmans_identity,
                     a_control_takes_the_gains_as_they_are,
                     what_resists_a_displacement_is_the_mass_times_the_square_of_the_frequency,
                     says_why_there_are_no_gains, without_weights_what_oscillates_is_refused);
}
