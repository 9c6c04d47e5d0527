/* Multipliers about periodic heave programs: against the numbers of the paper's machine and against (stab-11), (stab-12),
 * integrated by another road; what must hold for every loop; refusals.
 * Label: standard.
 * Not sanitized: the same functions run under sanitizers in the tests of the command. */
#include <complex.h>
#include <stdio.h>
#include <stdlib.h>

#include "gough/floquet.h"
#include "support/machines.h"
#include "support/suite.h"

enum { N = GOUGH_LINEAR, Z = 2, VZ = 8 };

/* the paper's machine heaving by 0.2 sin t */
static gough_model *paper_model(double G, double D) {
    gough_model *model = calloc(1, sizeof *model);

    ck_assert(model != NULL);
    paper_machine(&model->machine);
    model->control.feedforward = true;
    set_gains(model, G, D);
    set_formula(&model->motion.formula[GOUGH_HEAVE], "0.2*sin(t)");
    return model;
}

static gough_floquet multipliers(const gough_model *model, double tolerance) {
    gough_error error = {0};
    gough_floquet f;

    ck_assert_msg(gough_floquet_multipliers(model, NULL, tolerance, &f, &error) == GOUGH_OK, "%s",
                  error.message);
    return f;
}

static double heave_trace(double G) {
    gough_model *model = paper_model(G, 0);
    const gough_floquet f = multipliers(model, 1e-11);

    free(model);
    return f.monodromy[Z][Z] + f.monodromy[VZ][VZ];
}

/* ---- the paper's machine ---- */

START_TEST(traces_of_the_papers_machine) {
    static const double known[][3] = {{0, 42.8326, 5e-5},
                                      {0.0817, 2.30856, 5e-6},
                                      {0.2, -1.731017, 5e-7},
                                      {1, 1.578140, 5e-7},
                                      {5, -1.716563, 5e-7}};

    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        const double trace = heave_trace(known[i][0]);
        ck_assert_msg(fabs(trace - known[i][1]) <= known[i][2], "G = %g: %.9g", known[i][0], trace);
    }
}
END_TEST

/* where the trace passes ±2, between two stiffnesses on either side, to 1e-7 */
static double tongue_edge(double low, double high, double trace) {
    const double side = heave_trace(low) - trace;

    ck_assert(side * (heave_trace(high) - trace) < 0);
    while (high - low > 1e-7) {
        const double middle = (low + high) / 2;
        if ((heave_trace(middle) - trace) * side > 0)
            low = middle;
        else
            high = middle;
    }
    return (low + high) / 2;
}

START_TEST(tongues_of_the_papers_machine) {
    static const double known[][4] = {{0.115, 0.118, -2, 0.11616},
                                      {0.190, 0.195, -2, 0.19283},
                                      {0.332, 0.335, 2, 0.33333},
                                      {0.366, 0.370, 2, 0.36773}};

    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        const double edge = tongue_edge(known[i][0], known[i][1], known[i][2]);
        ck_assert_msg(fabs(edge - known[i][3]) <= 5.1e-6, "%.8g, not %.5f", edge, known[i][3]);
    }
}
END_TEST

/* ---- (stab-11) by another road ---- */

typedef long double real;

/* A symmetric machine that heaves by amplitude · sin(rate t), all in closed form. x: displacement of the centre of the top
 * joints and rotation */
typedef struct {
    symmetric s;
    double Jx, Jz, amplitude, rate, G, D;
    real foot[GOUGH_LEGS][2],
        arm[GOUGH_LEGS][2]; /* top joint less base joint, and the top joint, horizontally */
} heaving;

/* solves M̄ a = f: heave and yaw alone, sway with tilt in two pairs */
static void accelerate(const heaving *p, const real f[6], real a[6]) {
    const real M = p->s.M, c = p->s.c, J = p->Jx;

    /* M (a_x + c α_y) = f_x, M c a_x + (J + M c²) α_y = f_θy; and −c for (y, θx) */
    a[4] = (f[4] - c * f[0]) / J;
    a[0] = f[0] / M - c * a[4];
    a[3] = (f[3] + c * f[1]) / J;
    a[1] = f[1] / M + c * a[3];
    a[2] = f[2] / M;
    a[5] = f[5] / p->Jz;
}

/* (stab-6) times (1 + z̈/g) */
static void geometric_force(const heaving *p, real h, real gravity, const real x[6], real f[6]) {
    const real R = p->s.R, r = p->s.r, cosine = cosl(p->s.delta), sine = sinl(p->s.delta);
    const real d2 = R * R + r * r - 2 * R * r * cosine, l2 = h * h + d2, q = r * r - r * R * cosine;
    const real W = p->s.M * gravity;
    const real tilt = -W / (2 * h) * (r * r * d2 / l2 - q) - W * p->s.c, cross = W * q / (2 * l2);

    f[0] = W / h * (l2 + h * h) / (2 * l2) * x[0] + cross * x[4];
    f[1] = W / h * (l2 + h * h) / (2 * l2) * x[1] - cross * x[3];
    f[2] = W / h * d2 / l2 * x[2];
    f[3] = -tilt * x[3] - cross * x[1];
    f[4] = -tilt * x[4] + cross * x[0];
    f[5] = W / h * (R * r * cosine - (R * r * sine) * (R * r * sine) / l2) * x[5];
}

/* −Jᵀ (G J x + D d(Jx)/dt), from the rows (n, a × n) and their rates under ḣ */
static void leg_force(const heaving *p, real h, real speed, const real x[6], const real v[6],
                      real f[6]) {
    for (int leg = 0; leg < GOUGH_LEGS; leg++) {
        const real *e = p->foot[leg], *a = p->arm[leg];
        const real l = sqrtl(e[0] * e[0] + e[1] * e[1] + h * h), growth = h * speed / (l * l);
        const real row[6] = {e[0] / l,     e[1] / l,      h / l,
                             a[1] * h / l, -a[0] * h / l, (a[0] * e[1] - a[1] * e[0]) / l};
        real length = 0, rate = 0;
        for (int i = 0; i < 6; i++) {
            /* of h/l: ḣ/l − h l̇/l², l̇ = h ḣ/l; of the others only l changes */
            const real direct = i == 2   ? speed / l
                                : i == 3 ? a[1] * speed / l
                                : i == 4 ? -a[0] * speed / l
                                         : 0;
            length += row[i] * x[i];
            rate += row[i] * v[i] + (direct - row[i] * growth) * x[i];
        }
        for (int i = 0; i < 6; i++) f[i] -= row[i] * (p->G * length + p->D * rate);
    }
}

static void slope(const heaving *p, real t, const real y[N], real out[N]) {
    const real z = p->amplitude * sinl(p->rate * t), h = p->s.h + z;
    const real speed = p->amplitude * p->rate * cosl(p->rate * t);
    real f[6];

    geometric_force(p, h, p->s.g - p->rate * p->rate * z, y, f);
    leg_force(p, h, speed, y, y + 6, f);
    for (int i = 0; i < 6; i++) out[i] = y[6 + i];
    accelerate(p, f, out + 6);
}

/* one step by Gragg's method, extrapolated to order 16 */
static void gragg(const heaving *p, real t, real H, real y[N]) {
    enum { ROWS = 8 };
    real table[ROWS][N];

    for (int row = 0; row < ROWS; row++) {
        const int parts = 2 * (row + 1);
        const real h = H / parts;
        real before[N], now[N], next[N], f[N];
        slope(p, t, y, f);
        for (int i = 0; i < N; i++) before[i] = y[i], now[i] = y[i] + h * f[i];
        for (int k = 1; k <= parts; k++) {
            slope(p, t + k * h, now, f);
            for (int i = 0; i < N; i++) {
                next[i] = before[i] + 2 * h * f[i];
                /* the smoothing step at the end */
                if (k == parts) next[i] = (before[i] + now[i] + h * f[i]) / 2;
                before[i] = now[i], now[i] = next[i];
            }
        }
        memcpy(table[row], now, sizeof now);
    }
    for (int order = 1; order < ROWS; order++) {
        for (int row = ROWS - 1; row >= order; row--) {
            const real ratio = (real)(row + 1) / (row + 1 - order);
            for (int i = 0; i < N; i++)
                table[row][i] += (table[row][i] - table[row - 1][i]) / (ratio * ratio - 1);
        }
    }
    memcpy(y, table[ROWS - 1], sizeof table[0]);
}

/* one column over the period */
static void carry(const heaving *p, real y[N]) {
    enum { STEPS = 60 };
    const real H = 2 * acosl(-1.0L) / p->rate / STEPS;

    for (int step = 0; step < STEPS; step++) gragg(p, step * H, H, y);
}

/* of the centre of mass from those of the top's centre: δr = δp + δθ × c, and so the velocities */
static void to_mass_center(double c, real y[N]) {
    for (int half = 0; half < N; half += 6) {
        y[half] += c * y[half + 4];
        y[half + 1] -= c * y[half + 3];
    }
}

static void expected_monodromy(const heaving *p, real right[N][N]) {
    for (int j = 0; j < N; j++) {
        real y[N] = {0};
        y[j] = 1;
        to_mass_center(-p->s.c, y);
        carry(p, y);
        to_mass_center(p->s.c, y);
        for (int i = 0; i < N; i++) right[i][j] = y[i];
    }
}

static void take_joints(heaving *p, const gough_machine *machine) {
    for (int leg = 0; leg < GOUGH_LEGS; leg++) {
        for (int i = 0; i < 2; i++) {
            p->arm[leg][i] = machine->platform.top[leg][i];
            p->foot[leg][i] = p->arm[leg][i] - (real)machine->platform.base[leg][i];
        }
    }
}

/* elements in units of R and √(R/g), against the largest */
static double compare(const heaving *p, gough_floquet *f) {
    const double time = sqrt(p->s.R / p->s.g);
    const double unit[4] = {p->s.R, 1, p->s.R / time, 1 / time};
    double largest = 0, worst = 0;
    real right[N][N];

    expected_monodromy(p, right);
    for (int i = 0; i < N; i++) {
        for (int j = 0; j < N; j++) {
            const double ratio = unit[j / 3] / unit[i / 3];
            largest = fmax(largest, fabs((double)right[i][j]) * ratio);
            worst = fmax(worst, fabs(f->monodromy[i][j] - (double)right[i][j]) * ratio);
            ck_assert(isfinite(f->monodromy[i][j]));
        }
    }
    return worst / largest;
}

static void check_heaving(gough_model *model, heaving *p) {
    char text[80];
    gough_floquet f;
    double error;

    snprintf(text, sizeof text, "%.17g*sin(%.17g*t)", p->amplitude, p->rate);
    set_formula(&model->motion.formula[GOUGH_HEAVE], text);
    set_gains(model, p->G, p->D);
    model->control.feedforward = true;
    take_joints(p, &model->machine);
    f = multipliers(model, 0);
    error = compare(p, &f);
    ck_assert_msg(error <= 1e-11, "G = %g, D = %g: %g", p->G, p->D, error);
}

/* (stab-12) is the element (2, 2) of it */
START_TEST(all_modes_of_the_papers_machine_obey_the_closed_equations) {
    gough_model *model = paper_model(0, 0);
    heaving p = {.s = {1, 0.6, 0, 1, 1, 1, 0}, .Jx = 0.08, .Jz = 0.15, .amplitude = 0.2, .rate = 1};
    const double gain[][2] = {{0, 0}, {0.0817, 0}, {1, 0}, {5, 0}, {1, 0.3}, {0, 0.2}};

    p.s.delta = (60 - 10 - 6.4688478326275441) * pi / 180;
    for (size_t i = 0; i < sizeof gain / sizeof gain[0]; i++) {
        p.G = gain[i][0];
        p.D = gain[i][1];
        check_heaving(model, &p);
    }
    free(model);
}
END_TEST

START_TEST(random_symmetric_machines_obey_the_closed_equations) {
    dice d = {20240229};

    for (int n = 0; n < 8; n++) {
        gough_model *model = calloc(1, sizeof *model);
        heaving p = {.rate = 1};
        double scale;
        ck_assert(model != NULL);
        p.s = random_symmetric(&d, &model->machine);
        p.Jx = model->machine.load.inertia[0][0];
        p.Jz = model->machine.load.inertia[2][2];
        p.amplitude = dice_between(&d, 0.05, 0.25) * p.s.h;
        p.rate = dice_between(&d, 1, 3) * sqrt(p.s.g / p.s.h);
        scale = p.s.M * p.s.g / p.s.h;
        p.G = scale * dice_between(&d, 0, 2);
        p.D = n % 2 ? 0.2 * scale * dice_between(&d, 0, 1) / p.rate : 0;
        check_heaving(model, &p);
        free(model);
    }
}
END_TEST

/* ---- what must hold for every loop ---- */

/* six axes, a load without symmetry */
static gough_model *skew_model(double G, double D) {
    static const char *const text[GOUGH_COMPONENTS] = {"0.05*sin(t)", "0.04*sin(2*t + 0.4)",
                                                       "0.1*sin(t)",  "0.08*sin(2*t)",
                                                       "0.06*cos(t)", "0.1*sin(3*t + 1)"};
    gough_model *model = calloc(1, sizeof *model);

    ck_assert(model != NULL);
    skew_machine(&model->machine);
    model->control.feedforward = true;
    set_gains(model, G, D);
    for (int c = 0; c < GOUGH_COMPONENTS; c++) set_formula(&model->motion.formula[c], text[c]);
    return model;
}

static void check_pairs(const gough_model *model) {
    const gough_floquet f = multipliers(model, 0);
    double product = 1;

    ck_assert_msg(f.determinant_defect <= 1e-9, "%g", f.determinant_defect);
    ck_assert_msg(f.pair_defect <= 1e-9, "%g", f.pair_defect);
    ck_assert(fabs(f.determinant - 1) <= 1e-9);
    for (int k = 0; k < N; k++) {
        const double size = hypot(f.multiplier[k].value[0], f.multiplier[k].value[1]);
        product *= size;
        ck_assert(size <= f.growth);
        ck_assert(k == 0 || size <= (1 + 1e-8) * hypot(f.multiplier[k - 1].value[0],
                                                       f.multiplier[k - 1].value[1]));
        ck_assert(f.multiplier[k].mode.name[0] != '\0');
    }
    /* each by itself: the small ones have digits of their own */
    ck_assert_msg(fabs(product - 1) <= 1e-9, "%.17g", product);
    ck_assert(f.stable == (f.growth <= 1 + 1e-7));
}

START_TEST(undamped_multipliers_come_in_pairs) {
    const double stiffness[] = {0, 0.05, 0.2, 1, 5, 40};
    dice d = {43};

    for (size_t i = 0; i < sizeof stiffness / sizeof stiffness[0]; i++) {
        gough_model *paper = paper_model(stiffness[i], 0), *skew = skew_model(stiffness[i], 0);
        check_pairs(paper);
        check_pairs(skew);
        skew->control.stiffness[2] *= 1.7; /* legs need not be alike */
        check_pairs(skew);
        give_legs(&skew->machine, LEGS_HEAVY, &d);
        check_pairs(skew);
        free(paper);
        free(skew);
    }
}
END_TEST

/* growth by 1e40 in a period of 20π leaves the pairs their digits */
START_TEST(pairs_hold_where_growth_is_enormous) {
    gough_model *model = paper_model(0, 0);
    gough_floquet f;

    set_all_axes(model);
    f = multipliers(model, 0);
    ck_assert_msg(fabs(f.period - 20 * pi) <= 1e-12, "%.17g", f.period);
    ck_assert_msg(f.growth > 1e35, "%g", f.growth);
    ck_assert_msg(f.pair_defect <= 1e-9, "%g", f.pair_defect);
    ck_assert_msg(f.determinant_defect <= 1e-9, "%g", f.determinant_defect);
    free(model);
}
END_TEST

/* Liouville: ∫ tr A by the trapezoidal rule, exact beyond all orders for a periodic function */
START_TEST(damping_shrinks_volumes_by_the_trace) {
    const double gain[][2] = {{1, 0.1}, {1, 1}, {0, 0.5}, {20, 2}};

    for (size_t i = 0; i < sizeof gain / sizeof gain[0]; i++) {
        enum { POINTS = 200 };
        gough_model *model = skew_model(gain[i][0], gain[i][1]);
        const gough_floquet f = multipliers(model, 0);
        double trace = 0, A[N][N];
        gough_error error;
        for (int k = 0; k < POINTS; k++) {
            ck_assert(gough_linearise(model, f.start + f.period * k / POINTS, NULL, GOUGH_LINEAR,
                                      A[0], &error) == GOUGH_OK);
            for (int j = 0; j < N; j++) trace += A[j][j] * f.period / POINTS;
        }
        ck_assert_msg(fabs(log(f.determinant) - trace) <= 1e-9, "%.17g, not %.17g",
                      log(f.determinant), trace);
        ck_assert_msg(f.determinant_defect <= 1e-9, "%g", f.determinant_defect);
        ck_assert(isnan(f.pair_defect));
        free(model);
    }
}
END_TEST

/* a program twice as fast with everything else scaled by the time is the same machine */
START_TEST(frequency_and_amplitude_scale_the_program) {
    gough_model *model = paper_model(0.4, 0.05), *scaled = paper_model(0.4, 0.05);
    gough_floquet f, g;

    set_formula(&model->motion.formula[GOUGH_HEAVE], "0.15*sin(2.5*t)");
    set_formula(&scaled->motion.formula[GOUGH_HEAVE], "0.3*sin(t)");
    scaled->motion.scaled = true;
    scaled->motion.amplitude = 0.5;
    scaled->motion.frequency = 2.5;
    f = multipliers(model, 0);
    g = multipliers(scaled, 0);
    ck_assert(fabs(f.period - g.period) <= 1e-15);
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) ck_assert(fabs(f.monodromy[i][j] - g.monodromy[i][j]) <= 1e-12);
    free(model);
    free(scaled);
}
END_TEST

/* ---- modes ---- */

START_TEST(modes_of_the_papers_machine_are_named) {
    gough_model *model = paper_model(0.15, 0);
    const gough_floquet f = multipliers(model, 0);
    int heave = 0, yaw = 0, sway = 0;

    for (int k = 0; k < N; k++) {
        const gough_mode *mode = &f.multiplier[k].mode;
        heave += strcmp(mode->name, "heave") == 0;
        yaw += strcmp(mode->name, "yaw") == 0;
        sway += mode->share[0] + mode->share[2] > 1 - 1e-6;
    }
    ck_assert_msg(heave == 2 && yaw == 2 && sway == 8, "%d %d %d", heave, yaw, sway);
    ck_assert_str_eq(f.multiplier[0].mode.name, "yaw");
    free(model);
}
END_TEST

/* ---- refusals ---- */

static void refuses(const gough_model *model, const gough_period *period, double tolerance,
                    gough_status status, const char *words) {
    gough_error error = {0};
    gough_floquet f;

    ck_assert_msg(gough_floquet_multipliers(model, period, tolerance, &f, &error) == status,
                  "%s passes or fails otherwise: %s", words, error.message);
    ck_assert_msg(strstr(error.message, words) != NULL, "'%s' is not in: %s", words, error.message);
}

START_TEST(says_what_is_wrong) {
    gough_model *model = paper_model(1, 0);
    const gough_period endless = {false, 0, INFINITY}, resting = {true, 3, 0};

    refuses(model, &resting, 0, GOUGH_ERROR_INPUT, "at rest from t = 3");
    refuses(model, &endless, 0, GOUGH_ERROR_INPUT, "positive and finite");
    for (int i = 0; i < 3; i++) {
        const gough_period wrong = {false, i == 2 ? NAN : 0, i == 0 ? 0 : i == 1 ? NAN : 6};
        gough_sampled_floquet sampled;
        gough_error error = {0};
        refuses(model, &wrong, 0, GOUGH_ERROR_INPUT, "positive and finite");
        model->control.sampling.period = 0.01;
        ck_assert_int_eq(gough_floquet_sampled(model, &wrong, &sampled, &error), GOUGH_ERROR_INPUT);
        ck_assert_ptr_nonnull(strstr(error.message, "positive and finite"));
        model->control.sampling.period = 0;
    }
    refuses(model, NULL, 0.5, GOUGH_ERROR_INPUT, "between 1e-15 and 0.001");
    refuses(model, NULL, NAN, GOUGH_ERROR_INPUT, "tolerance");
    set_formula(&model->motion.formula[GOUGH_HEAVE], "0.1*ramp(t, 5)");
    refuses(model, NULL, 0, GOUGH_ERROR_INPUT, "at rest from t = 5");
    set_formula(&model->motion.formula[GOUGH_HEAVE], "0.1*t");
    refuses(model, NULL, 0, GOUGH_ERROR_INPUT, "neither comes to rest");
    set_formula(&model->motion.formula[GOUGH_HEAVE], "1.2*sin(t)"); /* through the base */
    refuses(model, NULL, 0, GOUGH_ERROR_NUMERICAL, "singular pose");
    set_formula(&model->motion.formula[GOUGH_HEAVE], "0");
    set_formula(&model->motion.formula[GOUGH_YAW], "2*sin(t)");
    refuses(model, NULL, 0, GOUGH_ERROR_NUMERICAL, "singular pose");
    /* just up to it: steps get short without end */
    set_formula(&model->motion.formula[GOUGH_YAW], "1.5707963267948966*sin(t)");
    refuses(model, NULL, 0, GOUGH_ERROR_NUMERICAL, "singular pose");
    free(model);
}
END_TEST

START_TEST(says_that_legs_are_too_stiff) {
    gough_model *model = paper_model(1e12, 0);

    refuses(model, NULL, 1e-6, GOUGH_ERROR_NUMERICAL, "steps");
    free(model);
}
END_TEST

int main(void) {
    return SUITE_RUN(
        "floquet", 120, traces_of_the_papers_machine, tongues_of_the_papers_machine,
        all_modes_of_the_papers_machine_obey_the_closed_equations,
        random_symmetric_machines_obey_the_closed_equations, undamped_multipliers_come_in_pairs,
        pairs_hold_where_growth_is_enormous, damping_shrinks_volumes_by_the_trace,
        frequency_and_amplitude_scale_the_program, modes_of_the_papers_machine_are_named,
        says_what_is_wrong, says_that_legs_are_too_stiff);
}
