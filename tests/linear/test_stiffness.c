/* Stiffness at rest against differences of the forces of legs, weight and external loads, computed here from joints and points; and
 * where a loop comes to rest that does not know its loads. */
#include <stdlib.h>

#include "gough/gough.h"
#include "support/machines.h"
#include "support/suite.h"

static void cross_add(const double a[3], const double b[3], double out[3]) {
    for (int i = 0; i < 3; i++)
        out[i] += a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

/* R turned by a small vector about base axes, to third order */
static void turn(const double w[3], double R[3][3]) {
    for (int c = 0; c < 3; c++) {
        const double e[3] = {R[0][c], R[1][c], R[2][c]};
        double first[3] = {0}, second[3] = {0}, third[3] = {0};
        cross_add(w, e, first);
        cross_add(w, first, second);
        cross_add(w, second, third);
        for (int r = 0; r < 3; r++) R[r][c] += first[r] + second[r] / 2 + third[r] / 6;
    }
}

static void place(const gough_state *s, const double point[3], double out[3]) {
    for (int r = 0; r < 3; r++) {
        out[r] = s->position[r];
        for (int c = 0; c < 3; c++) out[r] += s->rotation[r][c] * point[c];
    }
}

/* force and moment about a point of the base frame, in a pose: springs G about the lengths l0 with the forces u0, weight, loads */
static void wrench_of(const gough_model *model, const gough_state *s, const double l0[6],
                      const double u0[6], const double about[3], double out[6]) {
    const gough_machine *m = &model->machine;
    double force[3], point[3], arm[3];

    memset(out, 0, sizeof(double[6]));
    for (int v = 0; v < GOUGH_LEGS; v++) {
        double leg[3], l = 0;
        place(s, m->platform.top[v], point);
        for (int i = 0; i < 3; i++)
            leg[i] = point[i] - m->platform.base[v][i], l += leg[i] * leg[i];
        l = sqrt(l);
        const double u = u0[v] + model->control.stiffness[v] * (l0[v] - l);
        for (int i = 0; i < 3; i++) {
            force[i] = u * leg[i] / l;
            out[i] += force[i];
            arm[i] = point[i] - about[i];
        }
        cross_add(arm, force, out + 3);
    }
    place(s, m->load.center_of_mass, point);
    for (int i = 0; i < 3; i++) {
        force[i] = m->load.mass * m->gravity[i];
        out[i] += force[i];
        arm[i] = point[i] - about[i];
    }
    cross_add(arm, force, out + 3);
    for (size_t n = 0; n < m->externals; n++) {
        const gough_external *e = &m->external[n];
        double jet[3];
        place(s, e->at, point);
        for (int i = 0; i < 3; i++) {
            force[i] = 0;
            for (int c = 0; c < 3; c++) {
                gough_formula_evaluate(&e->force[c], 0, jet);
                force[i] += (e->turns ? s->rotation[i][c] : i == c) * jet[0];
            }
            out[i] += force[i];
            arm[i] = point[i] - about[i];
        }
        cross_add(arm, force, out + 3);
    }
}

static gough_model *new_model(gough_external load[2]) {
    static const double gain[GOUGH_LEGS] = {20, 30, 40, 35, 25, 30};
    gough_model *model = calloc(1, sizeof *model);

    skew_machine(&model->machine);
    model->control.feedforward = true;
    memcpy(model->control.stiffness, gain, sizeof gain);
    memcpy(model->motion.about, (double[3]){0.1, 0.05, -0.2}, sizeof model->motion.about);
    for (int n = 0; n < 2; n++) {
        load[n] = (gough_external){.at = {0.1, -0.2 * n, 0.3}, .at_given = true};
        load[n].force[n] = gough_formula_constant(-0.5);
        load[n].force[2] = gough_formula_constant(0.7);
    }
    ck_assert(gough_machine_set_external(&model->machine, load, 2, NULL) == GOUGH_OK);
    return model;
}

START_TEST(stiffness_is_the_derivative_of_the_wrench) {
    static const double component[6] = {0.05, -0.03, 0.1, 0.1, -0.05, 0.2}, h = 1e-5;
    static gough_external load[2];
    gough_model *model = new_model(load);

    for (int way = 0; way < 2; way++) {
        gough_stiffness s;
        double about[3], worst = 0;
        load[1].turns = way == 1; /* a force that turns with the top: no symmetry */
        ck_assert(gough_stiffness_at_rest(model, component, &s, NULL) == GOUGH_OK);
        place(&s.state, model->motion.about, about);
        for (int j = 0; j < 6; j++) {
            double side[2][6];
            for (int k = 0; k < 2; k++) {
                const double step = k ? -h : h;
                double w[3] = {0, 0, 0}, now[3];
                gough_state there = s.state;
                if (j >= 3) w[j - 3] = step;
                turn(w, there.rotation);
                place(&there, model->motion.about, now);
                for (int i = 0; i < 3; i++)
                    there.position[i] += about[i] - now[i] + (i == j ? step : 0);
                wrench_of(model, &there, s.length, s.force, about, side[k]);
            }
            for (int i = 0; i < 6; i++)
                worst = fmax(worst, fabs(s.total[i][j] + (side[0][i] - side[1][i]) / (2 * h)));
        }
        /* differences of the second order in h, of elements up to 170 */
        ck_assert_msg(worst < 2e-7, "%g", worst);
        ck_assert(s.firm);
        for (int i = 0; i < 6; i++) {
            for (int j = 0; j < 6; j++) {
                double one = 0;
                for (int k = 0; k < 6; k++) one += s.total[i][k] * s.compliance[k][j];
                ck_assert(fabs(one - (i == j)) < 1e-12);
                ck_assert(fabs(s.total[i][j] - s.control[i][j] - s.geometric[i][j]) < 1e-13);
            }
        }
    }
    free(model);
}
END_TEST

/* without gains there is no compliance */
START_TEST(open_loop_has_no_compliance) {
    static gough_external load[2];
    gough_model *model = new_model(load);
    gough_stiffness s;

    set_gains(model, 0, 0);
    ck_assert(gough_stiffness_at_rest(model, NULL, &s, NULL) == GOUGH_OK);
    ck_assert(!s.firm && isnan(s.compliance[2][2]));
    free(model);
}
END_TEST

/* a loop that does not know a small load sags by compliance times load; stability finds that rest, and the run ends there */
START_TEST(unknown_load_sags_by_the_compliance) {
    static gough_external load[2];
    gough_model *model = new_model(load);
    gough_simulation run = gough_simulation_default();
    gough_summary summary;
    gough_stiffness bare;
    gough_rest rest;
    gough_end end;
    double shift[3];

    gough_machine_set_external(&model->machine, NULL, 0, NULL);
    ck_assert(gough_stiffness_at_rest(model, NULL, &bare, NULL) == GOUGH_OK);
    load[0].force[0] = gough_formula_constant(0);
    load[0].force[2] = gough_formula_constant(-1e-4);
    memcpy(load[0].at, model->motion.about, sizeof load[0].at);
    gough_machine_set_external(&model->machine, load, 1, NULL);
    model->control.ignores_external = true;
    ck_assert(gough_stability_at_rest(model, NULL, &rest, NULL) == GOUGH_OK);
    place(&rest.state, model->motion.about, shift);
    shift[2] -= model->machine.platform.height;
    for (int i = 0; i < 3; i++) {
        shift[i] -= model->motion.about[i];
        /* to first order in a load that moves the top by a hundred-thousandth */
        ck_assert_msg(fabs(shift[i] + 1e-4 * bare.compliance[i][2]) < 1e-9, "%d: %g", i, shift[i]);
    }
    ck_assert(shift[2] < -5e-7);

    set_gains(model, 30, 20);
    gough_machine_set_external(&model->machine, load, 1, NULL);
    ck_assert(gough_stability_at_rest(model, NULL, &rest, NULL) == GOUGH_OK);
    run.duration = 60;
    run.tolerance = 1e-12;
    run.summary = &summary;
    ck_assert(gough_simulate(model, &run, NULL, NULL, &end, NULL) == GOUGH_OK);
    double away = 0;
    for (int i = 0; i < 3; i++) {
        const double d = rest.state.position[i] - (i == 2 ? model->machine.platform.height : 0);
        away += d * d;
    }
    ck_assert(fabs(summary.position_deviation - sqrt(away)) < 0.05 * sqrt(away));
    free(model);
}
END_TEST

START_TEST(loads_without_potential_are_refused_at_rest) {
    static gough_external load[2];
    gough_model *model = new_model(load);
    gough_error error = {.message = ""};
    gough_rest rest;

    ck_assert(gough_stability_at_rest(model, NULL, &rest, &error) == GOUGH_OK);
    load[1].turns = true;
    ck_assert(gough_stability_at_rest(model, NULL, &rest, &error) == GOUGH_ERROR_INPUT);
    ck_assert(strstr(error.message, "load 2 turns with the top") != NULL);
    free(model);
}
END_TEST

int main(void) {
    return SUITE_RUN("stiffness", 10, stiffness_is_the_derivative_of_the_wrench,
                     open_loop_has_no_compliance, unknown_load_sags_by_the_compliance,
                     loads_without_potential_are_refused_at_rest);
}
