/* The general study, in the library's words and in those of the second formulation; see
 * studies.h. */
#include "independent/studies.h"

#include <check.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* each component is amplitude·sin(rate t + phase)·(1 − e^(−t/2))², lengths and radians */
static const double AMPLITUDE[6] = {0.08, 0.06, 0.1, 0.12, 0.1, 0.2};
static const double RATE[6] = {1.1, 0.9, 1, 1.3, 0.7, 0.8};
static const double PHASE[6] = {0.3, 1.6, 0, 1, 1.8, 0.4};

static void program(newton_real t, newton_real component[6][3]) {
    const newton_real e = expl(-t / 2), w = 1 - e;
    const newton_real rise[3] = {w * w, w * e, e * e - e / 2};
    for (int c = 0; c < 6; c++) {
        const newton_real a = AMPLITUDE[c], r = RATE[c], angle = r * t + (newton_real)PHASE[c];
        const newton_real wave[3] = {a * sinl(angle), a * r * cosl(angle),
                                     -a * r * r * sinl(angle)};
        component[c][0] = wave[0] * rise[0];
        component[c][1] = wave[1] * rise[0] + wave[0] * rise[1];
        component[c][2] = wave[2] * rise[0] + 2 * wave[1] * rise[1] + wave[0] * rise[2];
    }
}

/* each disturbance is size·sin(rate t + phase): on the legs, the vertical force, force and
 * moment on the load */
enum { VERTICAL = 6, FORCE = 7, MOMENT = 10, DISTURBANCES = 13 };
static const double SIZE[DISTURBANCES] = {0.01, -0.02, 0.015, 0.01, 0.005, -0.01, 0.05,
                                          0.03, 0.02,  -0.04, 0.01, -0.02, 0.015};
static const double PACE[DISTURBANCES] = {2,   1.5, 1,   0.5, 2.5, 1.25, 3,
                                          1.2, 1.7, 0.6, 1.5, 0.8, 2.1};
static const double START[DISTURBANCES] = {0, 1, 2, 3, 0.5, 1.5, 1.2, 0.2, 0.4, 0.6, 0.8, 1, 1.1};

void general_disturbance(newton_real t, newton_real leg[6], newton_real *vertical,
                         newton_real force[3], newton_real moment[3]) {
    newton_real value[DISTURBANCES];
    for (int i = 0; i < DISTURBANCES; i++) {
        const newton_real angle = (newton_real)PACE[i] * t + (newton_real)START[i];
        value[i] = (newton_real)SIZE[i] * sinl(angle);
    }
    memcpy(leg, value, 6 * sizeof(newton_real));
    *vertical = value[VERTICAL];
    memcpy(force, value + FORCE, 3 * sizeof(newton_real));
    memcpy(moment, value + MOMENT, 3 * sizeof(newton_real));
}

static gough_formula sine(double size, double rate, double phase, const char *times) {
    char text[200];
    gough_formula f;
    gough_error error = {.message = ""};
    sprintf(text, "%.17g*sin(%.17g*t + %.17g)%s", size, rate, phase, times);
    const gough_status status = gough_formula_compile(&f, text, strlen(text), NULL, &error);
    ck_assert_msg(status == GOUGH_OK, "%s: %s", text, error.message);
    return f;
}

/* joints near those of a symmetric hexapod, each moved off its place, none in a plane with the
 * others */
static gough_platform crooked_platform(void) {
    gough_platform p = gough_platform_symmetric(1, 0.2, 0.6, 0.15, 1.1);
    for (int n = 0; n < GOUGH_LEGS; n++) {
        for (int a = 0; a < 3; a++) {
            p.base[n][a] += 0.08 * sin(3 * n + 2 * a + 1);
            p.top[n][a] += 0.05 * cos(2 * n + 5 * a);
        }
    }
    return p;
}

static gough_load crooked_load(void) {
    return (gough_load){
        .mass = 1.25,
        .center_of_mass = {0.05, -0.04, 0.12},
        .inertia = {{0.11, 0.012, -0.008}, {0.012, 0.09, 0.015}, {-0.008, 0.015, 0.14}}};
}

static void widen(newton_real *to, const double *from, int count) {
    for (int i = 0; i < count; i++) to[i] = (newton_real)from[i];
}

static void second_formulation(newton_euler *s, const gough_model *m, bool feedforward) {
    const gough_platform *p = &m->machine.platform;
    const gough_load *load = &m->machine.load;
    widen(s->base[0], p->base[0], 18);
    widen(s->top[0], p->top[0], 18);
    widen(&s->height, &p->height, 1);
    widen(&s->mass, &load->mass, 1);
    widen(s->center, load->center_of_mass, 3);
    widen(s->inertia[0], load->inertia[0], 9);
    widen(s->gravity, m->machine.gravity, 3);
    widen(s->about, m->motion.about, 3);
    widen(s->stiffness, m->control.stiffness, 6);
    widen(s->damping, m->control.damping, 6);
    s->feedforward = feedforward;
    s->program = program;
    s->disturbance = general_disturbance;
}

void general_study(gough_model *model, newton_euler *second, bool feedforward, double stiffness,
                   double damping) {
    memset(model, 0, sizeof *model);
    const gough_platform p = crooked_platform();
    const gough_load load = crooked_load();
    const double gravity[3] = {0.05, -0.02, -1};
    gough_error error = {.message = ""};
    const gough_status status = gough_machine_init(&model->machine, &p, &load, gravity, &error);
    ck_assert_msg(status == GOUGH_OK, "%s", error.message);

    model->motion.about[0] = 0.1, model->motion.about[1] = -0.05, model->motion.about[2] = 0.3;
    for (int c = 0; c < 6; c++)
        model->motion.formula[c] = sine(AMPLITUDE[c], RATE[c], PHASE[c], "*(1 - exp(-t/2))^2");

    model->control.feedforward = feedforward;
    gough_disturbance *d = &model->disturbance;
    for (int n = 0; n < GOUGH_LEGS; n++) {
        model->control.stiffness[n] = stiffness * (1 + 0.1 * n);
        model->control.damping[n] = damping * (1 - 0.05 * n);
        d->leg_force[n] = sine(SIZE[n], PACE[n], START[n], "");
    }
    d->vertical_force = sine(SIZE[VERTICAL], PACE[VERTICAL], START[VERTICAL], "");
    for (int a = 0; a < 3; a++) {
        d->force[a] = sine(SIZE[FORCE + a], PACE[FORCE + a], START[FORCE + a], "");
        d->moment[a] = sine(SIZE[MOMENT + a], PACE[MOMENT + a], START[MOMENT + a], "");
    }
    if (second != NULL) second_formulation(second, model, feedforward);
}
