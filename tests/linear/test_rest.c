/* The loop at rest: against the closed forms of the symmetric machine, against runs, and against what must hold for every
 * machine. */
#include <stdio.h>

#include "gough/linear.h"
#include "linear/planes.h"
#include "linear/rest_model.h"
#include "support/machines.h"
#include "support/suite.h"

enum { GEOMETRIES = 100 };

/* closed forms of the theory against what is found, relative to the largest number of the kind */
static const double closed = 1e-10;

/* ---- closed forms ---------------------------------------------------------------------------------------------- */

/* d², l² and q of the theory */
typedef struct {
    double d2, l2, q;
} lengths;

static lengths lengths_of(const symmetric *s) {
    const double d2 = s->R * s->R + s->r * s->r - 2 * s->R * s->r * cos(s->delta);

    return (lengths){d2, d2 + s->h * s->h, s->r * s->r - s->r * s->R * cos(s->delta)};
}

typedef double six[6][6];

static void symmetric_pair(six A, int i, int j, double value) { A[i][j] = A[j][i] = value; }

/* (stab-4), about the centre of the top joints */
static void closed_legs(const symmetric *s, six A) {
    const lengths n = lengths_of(s);
    const double along = s->R * s->r * sin(s->delta);

    memset(A, 0, sizeof(six));
    A[0][0] = A[1][1] = 3 * n.d2 / n.l2;
    A[2][2] = 6 * s->h * s->h / n.l2;
    A[3][3] = A[4][4] = 3 * s->r * s->r * s->h * s->h / n.l2;
    A[5][5] = 6 * along * along / n.l2;
    symmetric_pair(A, 0, 4, -3 * s->h * n.q / n.l2);
    symmetric_pair(A, 1, 3, 3 * s->h * n.q / n.l2);
}

/* (stab-6), about the centre of the top joints */
static void closed_geometric(const symmetric *s, six A) {
    const lengths n = lengths_of(s);
    const double Mg = s->M * s->g, along = s->R * s->r * sin(s->delta);

    memset(A, 0, sizeof(six));
    A[0][0] = A[1][1] = -Mg / s->h * (n.l2 + s->h * s->h) / (2 * n.l2);
    A[2][2] = -Mg / s->h * n.d2 / n.l2;
    A[3][3] = A[4][4] = -Mg / (2 * s->h) * (s->r * s->r * n.d2 / n.l2 - n.q) - Mg * s->c;
    A[5][5] = -Mg / s->h * (s->R * s->r * cos(s->delta) - along * along / n.l2);
    symmetric_pair(A, 0, 4, -Mg * n.q / (2 * n.l2));
    symmetric_pair(A, 1, 3, Mg * n.q / (2 * n.l2));
}

/* TᵀAT, the centre of mass being c above the centre of the top joints: s = δr + c × δθ */
static void to_center_of_mass(double c, six A) {
    six T = {{0}}, B;

    for (int i = 0; i < 6; i++) T[i][i] = 1;
    T[0][4] = -c;
    T[1][3] = c;
    for (int i = 0; i < 6; i++) {
        for (int j = 0; j < 6; j++) {
            B[i][j] = 0;
            for (int k = 0; k < 6; k++) {
                for (int l = 0; l < 6; l++) B[i][j] += T[k][i] * A[k][l] * T[l][j];
            }
        }
    }
    memcpy(A, B, sizeof(six));
}

static void same_matrix(six found, six right, const char *what, int geometry) {
    double largest = 0;

    for (int i = 0; i < 36; i++) largest = fmax(largest, fabs((&right[0][0])[i]));
    for (int i = 0; i < 6; i++) {
        for (int j = 0; j < 6; j++)
            near(found[i][j], right[i][j], closed * largest, what, geometry);
    }
}

/* roots γ of det(A + γ B) = 0 on (x, θ_y), the greater first; their difference without cancellation */
static void pencil(six A, six B, double root[2]) {
    const double a = B[0][0] * B[4][4] - B[0][4] * B[0][4],
                 b = A[0][0] * B[4][4] + A[4][4] * B[0][0] - 2 * A[0][4] * B[0][4],
                 c = A[0][0] * A[4][4] - A[0][4] * A[0][4];
    const double q = -0.5 * (b + copysign(sqrt(b * b - 4 * a * c), b));

    root[0] = fmax(q / a, c / q);
    root[1] = fmin(q / a, c / q);
}

static int falling(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;

    return x < y ? 1 : x > y ? -1 : 0;
}

/* γ of heave, yaw, and each of sway–tilt twice, falling */
static void closed_pencil(six A, six B, double root[6]) {
    double pair[2];

    pencil(A, B, pair);
    root[0] = root[1] = pair[0];
    root[2] = root[3] = pair[1];
    root[4] = -A[2][2] / B[2][2];
    root[5] = -A[5][5] / B[5][5];
    qsort(root, 6, sizeof root[0], falling);
}

START_TEST(stiffness_is_that_of_the_closed_forms) {
    dice d = {20261122};
    gough_model *model = new_model(0, 0);

    for (int k = 0; k < GEOMETRIES; k++) {
        const symmetric s = random_symmetric(&d, &model->machine);
        gough_rest rest = at_rest(model, NULL);
        six L, K;

        closed_legs(&s, L);
        to_center_of_mass(s.c, L);
        same_matrix(rest.legs, L, "JᵀJ", k);
        closed_geometric(&s, K);
        to_center_of_mass(s.c, K);
        same_matrix(rest.geometric, K, "K_geo", k);
        for (int v = 0; v < GOUGH_LEGS; v++) {
            const double F = s.M * s.g * sqrt(lengths_of(&s).l2) / (6 * s.h);
            near(rest.force[v], F, closed * F, "the force", k);
        }
        ck_assert(rest.asymmetry <= 1e-13);
    }
    free(model);
}
END_TEST

START_TEST(thresholds_are_those_of_the_closed_forms) {
    dice d = {4};
    gough_model *model = new_model(0, 0);
    int needless = 0;

    for (int k = 0; k < GEOMETRIES; k++) {
        const symmetric s = random_symmetric(&d, &model->machine);
        const lengths n = lengths_of(&s);
        const gough_rest rest = at_rest(model, NULL);
        const double Mg = s.M * s.g, along = sin(s.delta), heave = Mg * n.d2 / (6 * pow(s.h, 3)),
                     yaw = Mg / (6 * s.h) * (n.l2 * cos(s.delta) / (s.R * s.r * along * along) - 1);
        double root[6];
        six K, L;
        bool heaves = false, yaws = false;

        closed_geometric(&s, K);
        closed_legs(&s, L);
        closed_pencil(K, L, root); /* the same about every point */
        for (int m = 0; m < 6; m++) {
            const gough_threshold *t = &rest.threshold[m];
            near(t->stiffness, fmax(root[m], 0), closed * root[0], "a threshold", k);
            needless += root[m] < 0;
            if (strcmp(t->mode.name, "heave") == 0) {
                near(t->stiffness, heave, closed * root[0], "heave", k);
                heaves = true;
            } else if (strcmp(t->mode.name, "yaw") == 0) {
                near(t->stiffness, fmax(yaw, 0), closed * root[0], "yaw", k);
                yaws = true;
            }
        }
        ck_assert(heaves && yaws);
    }
    ck_assert_int_gt(needless, 0); /* else that case was not tried */
    free(model);
}
END_TEST

/* κ of K v = κ M̄ v from the closed forms, rising, with G JᵀJ; M̄ about the centre of the top joints */
static void closed_values(const symmetric *s, const gough_load *load, double G, double kappa[6]) {
    const double Mc = s->M * s->c;
    six K, L, mass = {{0}};

    closed_geometric(s, K);
    closed_legs(s, L);
    for (int i = 0; i < 6; i++) {
        for (int j = 0; j < 6; j++) K[i][j] += G * L[i][j];
    }
    mass[0][0] = mass[1][1] = mass[2][2] = s->M;
    mass[3][3] = mass[4][4] = load->inertia[0][0] + Mc * s->c;
    mass[5][5] = load->inertia[2][2];
    symmetric_pair(mass, 0, 4, Mc);
    symmetric_pair(mass, 1, 3, -Mc);
    closed_pencil(K, mass, kappa); /* γ = −κ falling */
    for (int k = 0; k < 6; k++) kappa[k] = -kappa[k];
}

START_TEST(eigenvalues_are_those_of_the_closed_forms) {
    dice d = {7};
    gough_model *model = new_model(0, 0);

    for (int k = 0; k < 2 * GEOMETRIES; k++) {
        const symmetric s = random_symmetric(&d, &model->machine);
        const double G = k % 2 ? dice_between(&d, 0, 2) * s.M * s.g / s.R : 0;
        double kappa[6], right[12][2] = {{0}}, largest;
        int grow = 0, swing = 0;
        gough_rest rest;

        set_gains(model, G, 0);
        rest = at_rest(model, NULL);
        closed_values(&s, &model->machine.load, G, kappa);
        for (int m = 0; m < 6; m++) grow += kappa[m] < 0;
        for (int m = 0; m < 6; m++) {
            const double root = sqrt(fabs(kappa[m]));
            if (kappa[m] < 0) {
                right[m][0] = root;
                right[11 - m][0] = -root;
            } else {
                right[grow + swing][1] = root;
                right[grow + swing + 1][1] = -root;
                swing += 2;
            }
        }
        largest = sqrt(fmax(fabs(kappa[0]), fabs(kappa[5])));
        ck_assert(k % 2 || fabs(rest.growth - right[0][0]) <= closed * largest);
        ck_assert_int_eq(rest.stable, grow == 0);
        for (int m = 0; m < 12; m++) {
            near(rest.eigenvalue[m].value[0], right[m][0], closed * largest, "a growth rate", k);
            near(rest.eigenvalue[m].value[1], right[m][1], closed * largest, "a frequency", k);
            /* exactly real or exactly imaginary, which −0.0 is too */
            ck_assert(fmin(fabs(rest.eigenvalue[m].value[0]), fabs(rest.eigenvalue[m].value[1])) <=
                      0);
        }
    }
    free(model);
}
END_TEST

/* (stab-7), to which damping adds λ D 6h²/(M l²): a quadratic equation; yaw likewise */
START_TEST(damped_heave_and_yaw_are_those_of_the_closed_forms) {
    dice d = {11};
    gough_model *model = new_model(0, 0);

    for (int k = 0; k < GEOMETRIES; k++) {
        const symmetric s = random_symmetric(&d, &model->machine);
        const double G = dice_between(&d, 0, 2) * s.M * s.g / s.R,
                     D = dice_between(&d, 0.01, 2) * s.M * sqrt(s.g / s.R);
        const int axis[2] = {2, 5};
        gough_rest rest;
        six K, L;

        set_gains(model, G, D);
        rest = at_rest(model, NULL);
        closed_geometric(&s, K);
        closed_legs(&s, L);
        for (int m = 0; m < 2; m++) {
            const int a = axis[m];
            const double inertia = m ? model->machine.load.inertia[2][2] : s.M;
            const double b = D * L[a][a] / inertia, c = (K[a][a] + G * L[a][a]) / inertia;
            int found = 0;
            for (int e = 0; e < 12; e++) {
                const double re = rest.eigenvalue[e].value[0], im = rest.eigenvalue[e].value[1];
                if (strcmp(rest.eigenvalue[e].mode.name, m ? "yaw" : "heave") != 0) continue;
                near(re * re - im * im + b * re + c, 0, closed * (b * b + fabs(c)), "a damped mode",
                     k);
                near(2 * re * im + b * im, 0, closed * (b * b + fabs(c)), "a damped mode", k);
                found++;
            }
            ck_assert_int_eq(found, 2);
        }
    }
    free(model);
}
END_TEST

/* ---- modes ----------------------------------------------------------------------------------------------------- */

/* of each pair of sway–tilt modes one moves surge and pitch alone, the other sway and roll */
static void clean(const gough_mode *mode, int *pairs) {
    const double tolerance = 1e-9;
    double size[6];

    for (int a = 0; a < 6; a++) size[a] = hypot(mode->shape[a][0], mode->shape[a][1]);
    ck_assert(isfinite(size[0] + size[1] + size[2] + size[3] + size[4] + size[5]));
    if (strcmp(mode->name, "sway–tilt") != 0) return;
    ck_assert_msg((size[0] > tolerance) == (size[4] > tolerance), "surge %g, pitch %g", size[0],
                  size[4]);
    ck_assert((size[1] > tolerance) == (size[3] > tolerance));
    ck_assert_msg((size[0] > tolerance) != (size[1] > tolerance), "surge %g, sway %g", size[0],
                  size[1]);
    *pairs += 1;
}

START_TEST(equal_modes_are_told_apart) {
    static const double gains[4][2] = {{0, 0}, {0.4, 0}, {2, 0}, {2, 0.7}};
    gough_model *model = new_model(0, 0);

    paper_machine(&model->machine);
    for (int g = 0; g < 4; g++) {
        int pairs = 0;
        gough_rest rest;
        set_gains(model, gains[g][0], gains[g][1]);
        rest = at_rest(model, NULL);
        for (int e = 0; e < 12; e++) clean(&rest.eigenvalue[e].mode, &pairs);
        ck_assert_int_eq(pairs, 8);
        for (int m = 0; m < 6; m++) clean(&rest.threshold[m].mode, &pairs);
        ck_assert_int_eq(pairs, 12);
    }
    free(model);
}
END_TEST

/* ---- what holds for every machine ------------------------------------------------------------------------------- */

/* (stab-5), at home and displaced with the top level */
START_TEST(trace_theorem_holds_for_any_joints_in_two_planes) {
    dice d = {3};
    gough_model *model = new_model(0.1, 0);
    int tried = 0;

    for (int k = 0; k < GEOMETRIES; k++) {
        const double component[GOUGH_COMPONENTS] = {0.05, -0.1, 0.07, 0, 0, 0.1},
                     tilted[GOUGH_COMPONENTS] = {0, 0, 0, 0.01, 0, 0};
        double h, Mg;
        gough_rest rest;

        if (!random_machine(&d, &model->machine, &h)) continue;
        tried++;
        Mg = model->machine.load.mass * model->machine.gravity_magnitude;
        rest = at_rest(model, NULL);
        near(rest.trace_theorem, -2 * Mg / h, 1e-14 * Mg / h, "the theorem", k);
        near(rest.trace, -2 * Mg / h, closed * Mg / h, "the trace", k);
        rest = at_rest(model, component);
        near(rest.trace_theorem, -2 * Mg / (h + 0.07), 1e-14 * Mg / h, "the theorem", k);
        near(rest.trace, -2 * Mg / (h + 0.07), closed * Mg / h, "the trace", k);
        set_gains(model, 0, 0);
        ck_assert(!at_rest(model, NULL).stable); /* and so some mode grows */
        rest = at_rest(model, tilted);
        ck_assert(isnan(rest.trace_theorem) && isfinite(rest.trace));
    }
    ck_assert_int_gt(tried, GEOMETRIES / 4);
    free(model);
}
END_TEST

/* K_geo + G JᵀJ of an asymmetric machine, turned and displaced: symmetric, and what the matrix has. Two roads to JᵀJ. */
START_TEST(stiffness_of_any_machine_is_symmetric_and_linear_in_the_gain) {
    static const double component[GOUGH_COMPONENTS] = {0.1, -0.05, 0.07, 0.1, -0.15, 0.2};
    gough_model *model = new_model(3, 0.5);
    gough_rest rest;
    double jacobian[6][6], A[12][12], G = 3;
    gough_state *s = &rest.state;
    gough_error error;

    skew_machine(&model->machine);
    rest = at_rest(model, component);
    ck_assert_msg(rest.asymmetry <= 1e-14, "%g", rest.asymmetry);
    gough_jacobian(&model->machine, s, jacobian);
    for (int v = 0; v < 6; v++) {
        /* about the centre of mass: ω rows lose c × n */
        const double *n = jacobian[v], *c = model->machine.load.center_of_mass;
        double at[3] = {0, 0, 0}, m[3];
        for (int i = 0; i < 3; i++) {
            for (int j = 0; j < 3; j++) at[i] += s->rotation[i][j] * c[j];
        }
        m[0] = at[1] * n[2] - at[2] * n[1];
        m[1] = at[2] * n[0] - at[0] * n[2];
        m[2] = at[0] * n[1] - at[1] * n[0];
        for (int i = 0; i < 3; i++) jacobian[v][3 + i] -= m[i];
    }
    ck_assert(gough_linearise(model, 0, s, GOUGH_LINEAR, A[0], &error) == GOUGH_OK);
    for (int i = 0; i < 6; i++) {
        for (int j = 0; j < 6; j++) {
            double sum = 0;
            for (int v = 0; v < 6; v++) sum += jacobian[v][i] * jacobian[v][j];
            near(rest.legs[i][j], sum, 1e-13, "JᵀJ", i);
            ck_assert(fabs(rest.geometric[i][j] - rest.geometric[j][i]) <= 0);
            if (i >= 3) continue;
            near(-1.3 * rest.matrix[6 + i][j], rest.geometric[i][j] + G * rest.legs[i][j], 1e-13,
                 "K", i);
            near(-1.3 * rest.matrix[6 + i][6 + j], 0.5 * rest.legs[i][j], 1e-13, "C", i);
        }
    }
    free(model);
}
END_TEST

START_TEST(nothing_moves_without_gravity_and_springs) {
    const double none[3] = {0, 0, 0};
    gough_model *model = new_model(0, 0);
    gough_platform platform = gough_platform_symmetric(1, 0.2, 0.6, 0.2, 1);
    gough_load load = {.mass = 1, .inertia = {{0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.15}}};
    gough_error error;

    ck_assert(gough_machine_init(&model->machine, &platform, &load, none, &error) == GOUGH_OK);
    for (int forward = 0; forward < 2; forward++) {
        gough_rest rest;
        model->control.feedforward = forward;
        rest = at_rest(model, NULL);
        ck_assert(!rest.stable && rest.growing == 0 && rest.neutral == 6 && rest.drifting == 6);
        ck_assert(!rest.decaying && fabs(rest.growth) <= 0 && fabs(rest.trace_theorem) <= 0);
        for (int k = 0; k < 12; k++) ck_assert(fabs(rest.eigenvalue[k].value[1]) <= 0);
        for (int k = 0; k < 6; k++)
            ck_assert(fabs(rest.threshold[k].stiffness) <= 0 && rest.threshold[k].neutral);
    }
    free(model);
}
END_TEST

/* three legs with springs and no weight: three freedoms are held, three are free, whatever the rounding of the large numbers */
START_TEST(free_freedoms_do_not_grow_by_rounding) {
    const double none[3] = {0, 0, 0};
    gough_model *model = new_model(0, 0);
    gough_machine *machine = &model->machine;
    gough_error error;
    gough_rest rest;

    skew_machine(machine);
    ck_assert(gough_machine_init(machine, &machine->platform, &machine->load, none, &error) ==
              GOUGH_OK);
    for (int v = 0; v < 3; v++) model->control.stiffness[2 * v] = 1e6;
    rest = at_rest(model, NULL);
    ck_assert(!rest.stable && rest.growing == 0 && rest.drifting == 3 && fabs(rest.growth) <= 0);
    for (int k = 0; k < 12; k++) {
        const double frequency = fabs(rest.eigenvalue[k].value[1]);
        ck_assert(k < 6 ? frequency <= 0 : frequency > 100);
    }
    free(model);
}
END_TEST

/* just under the least stiffness one mode grows, just over none does */
START_TEST(the_largest_threshold_is_where_the_loop_becomes_stable) {
    gough_model *model = new_model(0, 0);
    double threshold;

    skew_machine(&model->machine);
    threshold = at_rest(model, NULL).threshold[0].stiffness;
    ck_assert(threshold > 0.1);
    set_gains(model, threshold * (1 - 1e-9), 0);
    ck_assert(!at_rest(model, NULL).stable);
    set_gains(model, threshold * (1 + 1e-9), 0);
    ck_assert(at_rest(model, NULL).stable);
    for (int k = 0; k < 5; k++) {
        int growing = 0;
        gough_rest rest = at_rest(model, NULL);
        set_gains(model, 0.5 * (rest.threshold[k].stiffness + rest.threshold[k + 1].stiffness), 0);
        rest = at_rest(model, NULL);
        for (int e = 0; e < 12; e++) growing += rest.eigenvalue[e].value[0] > 0;
        ck_assert_int_eq(growing, k + 1);
    }
    free(model);
}
END_TEST

/* ---- messages --------------------------------------------------------------------------------------------------- */

static void refused(const gough_model *model, const double *component, gough_status status,
                    const char *part, const char *other) {
    gough_rest rest;
    gough_error error = {0};

    ck_assert_int_eq(gough_stability_at_rest(model, component, &rest, &error), status);
    ck_assert_msg(strstr(error.message, part) != NULL, "%s", error.message);
    ck_assert_msg(strstr(error.message, other) != NULL, "%s", error.message);
}

START_TEST(poses_that_nothing_holds_are_refused) {
    const double flat[GOUGH_COMPONENTS] = {0, 0, -1, 0, 0, 0},
                 turned[GOUGH_COMPONENTS] = {0.1, 0, 0, 0, 0, pi / 2},
                 nearly[GOUGH_COMPONENTS] = {0, 0, 0, 0, 0, 87.5 * pi / 180},
                 undefined[GOUGH_COMPONENTS] = {0, 0, 0, NAN, 0, 0};
    gough_model *model = new_model(1, 0);

    paper_machine(&model->machine);
    refused(model, flat, GOUGH_ERROR_NUMERICAL, "singular", "(heave -1)");
    refused(model, turned, GOUGH_ERROR_NUMERICAL, "singular", "(surge 0.1, yaw 90°)");
    refused(model, undefined, GOUGH_ERROR_INPUT, "roll", "not finite");
    model->control.feedforward = false;
    refused(model, flat, GOUGH_ERROR_NUMERICAL, "singular", "(heave -1)");
    set_gains(model, 16, 0);
    refused(model, nearly, GOUGH_ERROR_NUMERICAL, "beyond a singular pose", "(yaw 87.5°)");
    set_gains(model, 0.05, 0);
    refused(model, NULL, GOUGH_ERROR_NUMERICAL, "no equilibrium", "(home)");
    set_gains(model, 0, 0);
    refused(model, NULL, GOUGH_ERROR_NUMERICAL, "no equilibrium", "0 %");
    model->control.stiffness[2] = 100; /* one leg alone */
    refused(model, NULL, GOUGH_ERROR_NUMERICAL, "no equilibrium", "control.stiffness");
    free(model);
}
END_TEST

/* a platform of 1e-45 units, beyond what complex steps resolve: said, not answered */
START_TEST(numbers_without_meaning_are_refused) {
    const double gravity[3] = {0, 0, -1};
    gough_model *model = new_model(1, 0);
    gough_platform platform = gough_platform_symmetric(1e-45, 0.2, 0.6e-45, 0.1, 1e-45);
    gough_load load = {.mass = 1, .inertia = {{1e-91, 0, 0}, {0, 1e-91, 0}, {0, 0, 1e-91}}};
    gough_error error;

    ck_assert(gough_machine_init(&model->machine, &platform, &load, gravity, &error) == GOUGH_OK);
    refused(model, NULL, GOUGH_ERROR_NUMERICAL, "differ too much", "units");
    free(model);
}
END_TEST

int main(void) {
    return SUITE_RUN(
        "rest", 60, stiffness_is_that_of_the_closed_forms, thresholds_are_those_of_the_closed_forms,
        eigenvalues_are_those_of_the_closed_forms,
        damped_heave_and_yaw_are_those_of_the_closed_forms, equal_modes_are_told_apart,
        trace_theorem_holds_for_any_joints_in_two_planes,
        stiffness_of_any_machine_is_symmetric_and_linear_in_the_gain,
        nothing_moves_without_gravity_and_springs, free_freedoms_do_not_grow_by_rounding,
        the_largest_threshold_is_where_the_loop_becomes_stable,
        poses_that_nothing_holds_are_refused, numbers_without_meaning_are_refused);
}
