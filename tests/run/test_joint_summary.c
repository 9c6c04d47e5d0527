/* What a summary says of joints, friction and braking against rows close together, energies of whole machines and integrals in
 * closed form. */
#include <stdlib.h>

#include "gough/dynamics.h"
#include "support/machines.h"
#include "support/suite.h"

static const uint64_t SEED = 7;

/* legs with mass, and with friction that moves reach often; up, round and down again */
static gough_model *moving_machine(int legs) {
    gough_model *model = calloc(1, sizeof *model);
    dice d = {SEED};

    skew_machine(&model->machine);
    if (legs) give_legs(&model->machine, legs, &d);
    set_formula(&model->motion.formula[GOUGH_HEAVE], "0.2*ramp(t, 6)");
    set_formula(&model->motion.formula[GOUGH_YAW], "0.15*sin(pi*t/2)*ramp(t, 3)*ramp(8 - t, 3)");
    model->control.feedforward = true;
    set_gains(model, 200, 20);
    return model;
}

typedef struct {
    const gough_machine *machine;
    gough_summary rows;              /* by gough_summary_add() */
    double top[6], base[6], side[6]; /* the greatest of the rows */
} watched;

static int watch(void *context, const gough_row *row) {
    watched *w = context;

    gough_summary_add(&w->rows, w->machine, row);
    for (int v = 0; v < 6; v++) {
        const double *t = &row->value[GOUGH_ON_TOP + 3 * v],
                     *b = &row->value[GOUGH_BY_BASE + 3 * v];
        w->top[v] = fmax(w->top[v], hypot(hypot(t[0], t[1]), t[2]));
        w->base[v] = fmax(w->base[v], hypot(hypot(b[0], b[1]), b[2]));
        w->side[v] = fmax(w->side[v], row->value[GOUGH_S + v]);
    }
    return 0;
}

static gough_summary run(const gough_model *model, double step, bool simulated, watched *w) {
    gough_simulation s = gough_simulation_default();
    gough_summary summary;
    gough_error error = {.message = ""};
    gough_end end;

    memset(w, 0, sizeof *w);
    w->machine = &model->machine;
    gough_summary_begin(&w->rows);
    s.duration = 8;
    s.output_step = step;
    s.tolerance = 1e-11;
    s.summary = &summary;
    s.joints = true;
    ck_assert_msg((simulated
                       ? gough_simulate(model, &s, watch, w, &end, &error)
                       : gough_forces(model, &s, watch, w, NULL, NULL, &end, &error)) == GOUGH_OK,
                  "%s", error.message);
    gough_summary_end(&w->rows);
    return summary;
}

/* peaks of a summary with rows far apart are those of rows so close that they miss nothing */
START_TEST(peaks_of_joints_are_those_of_the_motion) {
    gough_model *model = moving_machine(LEGS_HEAVY | LEGS_VISCOUS);
    for (int simulated = 0; simulated < 2; simulated++) {
        watched close, far;
        run(model, 0.002, simulated, &close);
        const gough_summary s = run(model, 0.5, simulated, &far);
        bool between = false;
        for (int v = 0; v < 6; v++) {
            const gough_leg_summary *leg = &s.leg[v];
            ck_assert(fabs(leg->top_load - close.top[v]) <= 2e-5 * close.top[v]);
            ck_assert(fabs(leg->base_load - close.base[v]) <= 2e-5 * close.base[v]);
            ck_assert(fabs(leg->side_load - close.side[v]) <= 1e-4 * close.side[v]);
            between |= far.top[v] < leg->top_load * (1 - 1e-4);
        }
        ck_assert(between); /* rows so far apart miss a peak */
    }
    free(model);
}
END_TEST

/* potential energy of load and legs in a pose at rest: the load's centre of mass, the cylinders', the pistons' */
static double potential(const gough_machine *m, const gough_state *s) {
    const gough_platform *p = &m->platform;
    double sum = 0, length[6], x[3], J[6][6];

    gough_leg_kinematics(m, s, NULL, length, NULL, NULL);
    gough_jacobian(m, s, J);
    for (int r = 0; r < 3; r++) {
        x[r] = s->position[r];
        for (int c = 0; c < 3; c++) x[r] += s->rotation[r][c] * m->load.center_of_mass[c];
        sum -= m->load.mass * m->gravity[r] * x[r];
    }
    for (int v = 0; v < 6; v++) {
        for (int r = 0; r < 3; r++) {
            const double n = J[v][r], b = p->base[v][r];
            sum -= p->cylinder.mass[v] * m->gravity[r] * (b + p->cylinder.center[v] * n);
            sum -= p->piston.mass[v] * m->gravity[r] * (b + (length[v] - p->piston.center[v]) * n);
        }
    }
    return sum;
}

/* from rest to rest, the drives give the difference of height and what friction takes, (mass-7) */
START_TEST(energies_balance) {
    static const int LEGS[] = {0, LEGS_HEAVY, LEGS_VISCOUS, LEGS_HEAVY | LEGS_VISCOUS | LEGS_DRY};
    for (int kind = 0; kind < 8; kind++) {
        gough_model *model = moving_machine(LEGS[kind / 2]);
        const bool simulated = kind & 1, dry = LEGS[kind / 2] & LEGS_DRY;
        gough_state first, last;
        gough_acceleration a;
        watched w;
        double given[2] = {0, 0}, lost[2] = {0, 0};
        gough_program(&model->machine, &model->motion, 0, &first, &a);
        gough_program(&model->machine, &model->motion, 8, &last, &a);
        const double lift = potential(&model->machine, &last) - potential(&model->machine, &first);
        const gough_summary s = run(model, 0.02, simulated, &w);
        for (int v = 0; v < 6; v++) {
            given[0] += s.leg[v].energy, lost[0] += s.leg[v].friction_loss;
            given[1] += w.rows.leg[v].energy, lost[1] += w.rows.leg[v].friction_loss;
            ck_assert(s.leg[v].friction_loss >= 0 && s.leg[v].returned_energy >= 0);
            ck_assert(s.leg[v].energy + s.leg[v].returned_energy >= 0);
            const double peak = fmax(s.leg[v].force_max, -s.leg[v].force_min);
            if (LEGS[kind / 2] == 0) ck_assert(fabs(s.leg[v].top_load - peak) <= 0);
            if (LEGS[kind / 2] == 0) ck_assert(fabs(s.leg[v].base_load - peak) <= 0);
            ck_assert((LEGS[kind / 2] & LEGS_VISCOUS) ? s.leg[v].friction_loss > 1e-3
                                                      : !(s.leg[v].friction_loss > 0));
        }
        for (int i = 0; i < 2; i++) {
            /* the steep part of dry friction lies between rows */
            const double slack = dry ? (i ? 1e-3 : 1e-5) : 1e-6;
            ck_assert_msg(fabs(given[i] - lost[i] - lift) <= slack * lift,
                          "kind %d, %s: %.10g given, %.10g lost, %.10g lifted", kind,
                          i ? "rows" : "looks", given[i], lost[i], lift);
        }
        free(model);
    }
}
END_TEST

/* loads that are sines, whose peak lies between looks: a cubic misses it by h⁴/24 at most */
START_TEST(peaks_of_joints_lie_between_looks) {
    gough_model *model = moving_machine(LEGS_HEAVY);
    const double h = 0.05, slack = pow(h, 4) / 24;
    gough_summary s;
    gough_row row = {.quad = NULL};

    gough_summary_begin(&s);
    for (int k = 0; k < 6; k++) {
        const double load = sin(pi / 2 + (k - 2.4) * h);
        for (int c = 0; c < GOUGH_COLUMNS; c++) row.value[c] = 0;
        row.value[GOUGH_X] = row.value[GOUGH_EX] = NAN;
        row.value[GOUGH_T] = k * h;
        row.value[GOUGH_ON_TOP + 1] = -load;
        row.value[GOUGH_BY_BASE + 2] = 2 * load;
        row.value[GOUGH_S] = 3 * load;
        gough_summary_look(&s, &model->machine, &row, true);
    }
    gough_summary_end(&s);
    ck_assert(fabs(s.leg[0].top_load - 1) <= slack);
    ck_assert(fabs(s.leg[0].base_load - 2) <= 2 * slack);
    ck_assert(fabs(s.leg[0].side_load - 3) <= 3 * slack);
    ck_assert(!(s.leg[1].top_load > 0));
    free(model);
}
END_TEST

/* power sin t: 2 comes back in each turn. By looks, and by rows alone, whose last interval is cut short */
static double returned(double h, int looks, bool rows) {
    gough_machine machine;
    gough_summary s;
    gough_row row;

    paper_machine(&machine);
    gough_summary_begin(&s);
    for (int k = 0; k < looks; k++) {
        for (int c = 0; c < GOUGH_COLUMNS; c++) row.value[c] = NAN;
        for (int c = GOUGH_T; c < GOUGH_EX; c++) row.value[c] = 0;
        row.value[GOUGH_T] = k * h;
        row.value[GOUGH_P] = sin(k * h);
        if (rows)
            gough_summary_add(&s, &machine, &row);
        else
            gough_summary_look(&s, &machine, &row, true);
    }
    gough_summary_end(&s);
    return s.leg[0].returned_energy;
}

START_TEST(returned_energy_is_the_negative_part_of_the_power) {
    for (int rows = 0; rows < 2; rows++) {
        double error[2];
        for (int k = 0; k < 2; k++) {
            const int looks = k ? 61 : 31;
            const double h = 10 * pi / 3 / (looks - 1); /* to 5π/3·2: into the second turn */
            const double want = 2 + 0; /* sin is positive from 2π to 3π, negative to 10π/3 */
            const double rest = cos(10 * pi / 3 - 3 * pi) - 1; /* −∫ from 3π to 10π/3 */
            error[k] = fabs(returned(h, looks, rows) - want + rest);
        }
        ck_assert(error[1] <= 1e-4 && error[0] / error[1] > 8);
    }
}
END_TEST

/* two and three rows: their chords, of which the part below 0 is a triangle */
START_TEST(few_rows_return_the_part_of_their_chords) {
    const double high = sin(2.5), low = -sin(5.0);
    const double want = 2.5 * low * low / (high + low) / 2;
    ck_assert(fabs(returned(2.5, 3, true) - want) <= 1e-14);
    ck_assert(!(returned(2.5, 2, true) > 0));
}
END_TEST

int main(void) {
    return SUITE_RUN("run/joint_summary", 60, peaks_of_joints_are_those_of_the_motion,
                     peaks_of_joints_lie_between_looks, energies_balance,
                     returned_energy_is_the_negative_part_of_the_power,
                     few_rows_return_the_part_of_their_chords);
}
